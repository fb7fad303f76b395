// Statements.

#include "compiler/codegen/emitter.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// Ranges of CASE up to this size are written as single labels.
constexpr std::int64_t kMaxRange = 32;
constexpr std::int64_t kMaxLabels = 1024;
/// g++ nests `else if`; longer chains of ELSIF are flattened.
constexpr std::size_t kMaxElseIf = 64;

} // namespace

void Emitter::block(Block block) {
  // A `goto` must not cross the temporaries of the statements between it and its label.
  const bool labelled = std::any_of(block.begin(), block.end(), [](const Stmt *s) {
    return s->kind == StmtKind::label && as<LabelStmt>(s)->used;
  });
  for (const Stmt *s : block) {
    const bool alone = labelled && s->kind != StmtKind::label && s->kind != StmtKind::empty;
    if (alone) {
      w_.line() << '{';
      end();
      open();
    }
    statement(s);
    if (alone) {
      close();
      w_.line() << '}';
      end();
    }
  }
}

void Emitter::statement(const Stmt *s) {
  switch (s->kind) {
  case StmtKind::empty:
    return;
  case StmtKind::jump:
    jump(as<JumpStmt>(s));
    return;
  case StmtKind::label:
    label(as<LabelStmt>(s));
    return;
  case StmtKind::tryS:
    tryStatement(as<TryStmt>(s));
    return;
  case StmtKind::assign:
    assign(as<AssignStmt>(s));
    return;
  case StmtKind::call:
    callStatement(as<CallStmt>(s));
    return;
  case StmtKind::ifS:
    ifStatement(as<IfStmt>(s));
    return;
  case StmtKind::caseS:
    caseStatement(as<CaseStmt>(s));
    return;
  case StmtKind::forS:
  case StmtKind::whileS:
  case StmtKind::repeatS:
    loop(s);
    return;
  case StmtKind::exit:
    if (leaveTry(s))
      return;
    begin(s->span);
    if (loops_.back().isDouble || loops_.back().switches > 0) { // `break` would not leave it all
      loops_.back().labelled = true;
      w_ << "goto exit__" << loops_.back().id << ';';
    } else {
      w_ << "break;";
    }
    end();
    return;
  case StmtKind::continueS:
    if (leaveTry(s))
      return;
    begin(s->span);
    w_ << "continue;";
    end();
    return;
  case StmtKind::returnS:
    if (leaveTry(s))
      return;
    begin(s->span);
    if (usesBudget_) // a RETURN in front of the first loop has used nothing
      w_ << "budget__.done(" << ctx() << "); ";
    if (!loopLocals_.empty())
      w_ << context_ << ".save(); ";
    w_ << "return";
    if (pou_->result != nullptr) {
      used_.insert(pou_->result);
      w_ << ' ' << mangle(pou_->result->name.text);
    }
    w_ << ';';
    end();
    return;
  }
}

// -----------------------------------------------------------------------------------------------------
// assignments

namespace {

/// Does finding the variable read others: an index, a pointer?
bool isComputedPlace(const Expr *target) {
  while (true) {
    switch (target->kind) {
    case ExprKind::index:
    case ExprKind::deref:
      return true;
    case ExprKind::member:
      target = as<MemberExpr>(target)->base;
      continue;
    default:
      return false;
    }
  }
}

/// A whole array or structure in a UNION or behind a pointer may share some of its bytes with the
/// value.
bool mayOverlap(const Expr *target) {
  if (target->type->kind != TypeKind::array && target->type->kind != TypeKind::structure)
    return false;
  while (true) {
    switch (target->kind) {
    case ExprKind::deref:
      return true;
    case ExprKind::index:
      target = as<IndexExpr>(target)->base;
      if (target->type != nullptr && target->type->kind == TypeKind::pointer)
        return true;
      continue;
    case ExprKind::member: {
      const Type *base = as<MemberExpr>(target)->base->type;
      if (base != nullptr && base->kind == TypeKind::structure && typeAs<StructType>(base)->isUnion)
        return true;
      target = as<MemberExpr>(target)->base;
      continue;
    }
    default:
      return false;
    }
  }
}

} // namespace

void Emitter::storeTo(std::string_view target, const Type *type, const Expr *value) {
  if (type->kind == TypeKind::reference) {
    w_ << target << " = ";
    address(value);
    w_ << ';';
    return;
  }
  if (isString(type) && stringInto(target, value))
    return;
  if (isString(type) && isString(value->type) &&
      (value->constant != nullptr || value->type != type)) {
    w_ << "::stride::assign(" << target << ", ";
    if (value->constant != nullptr)
      quoted(*value->constant, type->kind == TypeKind::wstring);
    else
      raw(value);
    w_ << ");";
    return;
  }
  // Copying a block copies no binding of its in-outs: the target keeps its own.
  const bool bindings = c_.layouts.hasBindings(type);
  w_ << (bindings ? "::stride::assignBound(" : "") << target << (bindings ? ", " : " = ");
  if (type->kind == TypeKind::functionBlock && isInstance(value->type) && value->type != type) {
    raw(value); // the part of a block that it extends
    const std::string path =
        pathToBase(typeAs<PouType>(value->type)->symbol, typeAs<PouType>(type)->symbol);
    w_ << '.' << std::string_view(path).substr(0, path.size() - 1);
  } else if (bindings && value->type == type) {
    raw(value); // only what assign__ takes of it is copied
  } else {
    valueAs(value, type);
  }
  w_ << (bindings ? ");" : ";");
}

void Emitter::store(const Expr *target, const Expr *value) {
  if (writtenProperty(target) != nullptr) {
    propertySet(target, [&] { valueAs(value, target->type); });
    return;
  }
  const bool isBit = isBitPlace(target);
  const Expr *stored = isBit ? bitOwner(target) : target;
  const bool ordered = ((effects(target) & effectCalls) != 0 && effects(value) != effectNone) ||
                       ((effects(value) & effectCalls) != 0 && isComputedPlace(stored));
  if (isBit) {
    if (ordered && isBitField(target)) { // what it is a bit of is found first
      const std::string to = placeText(target);
      const std::size_t dot = to.rfind('.');
      const std::string name = temporary("to");
      w_ << "{ auto &" << name << " = " << to.substr(0, dot) << "; " << name << to.substr(dot)
         << " = ";
      valueAs(value, target->type);
      w_ << "; }";
      return;
    }
    const bool bind = ordered && stored != target;
    const std::string name = bind ? temporary("to") : std::string();
    if (bind) {
      w_ << "{ auto &" << name << " = ";
      place(stored);
      w_ << "; ";
    }
    bitStore(target, name, [&] { valueAs(value, target->type); });
    w_ << (bind ? " }" : "");
    return;
  }
  if (ordered) { // the place is found first
    const std::string name = temporary("to");
    w_ << (isShared(target) ? "{ const auto " : "{ auto &") << name << " = " << writableText(target)
       << "; ";
    storeTo(name, target->type, value);
    w_ << " }";
    return;
  }
  if (isString(target->type)) {
    storeTo(placeText(target), target->type, value);
    return;
  }
  writing_ = true;
  const std::string to = writableText(target);
  writing_ = false;
  if (mayOverlap(target) && !c_.layouts.hasBindings(target->type)) {
    includes_.complete(target->type);
    w_ << "::stride::copy(" << to << ", ";
    valueAs(value, target->type);
    w_ << ");";
    return;
  }
  storeTo(to, target->type, value);
}

/// Finds the places of `a[i] := p^.b := value` once, from left to right, before the value.
bool Emitter::findPlaces(const AssignStmt *s) {
  for (const Expr *target : s->targets) {
    const Expr *at = isBitPlace(target) ? bitOwner(target) : target;
    while (at->kind == ExprKind::member)
      at = as<MemberExpr>(at)->base;
    if (at->kind != ExprKind::index && at->kind != ExprKind::deref)
      continue;
    const std::string name = temporary("to");
    w_ << (found_.empty() ? "{ " : "") << "auto &" << name << " = ";
    writing_ = true;
    const std::string text = placeText(at);
    writing_ = false;
    w_ << text << "; ";
    found_.emplace(at, name);
  }
  return !found_.empty();
}

void Emitter::assign(const AssignStmt *s) {
  begin(s->span);
  const Expr *last = s->targets.back();
  switch (s->op) {
  case AssignOp::reference:
    slot(last);
    w_ << " = ";
    addressAs(s->value, last->type);
    w_ << ';';
    break;
  case AssignOp::set:
  case AssignOp::reset: {
    const std::string_view set = s->op == AssignOp::set ? "true" : "false";
    w_ << "if (";
    condition(s->value);
    w_ << ") { ";
    for (const Expr *target : s->targets) {
      if (isBitPlace(target)) {
        bitStore(target, {}, [&] { w_ << set; });
        w_ << ' ';
      } else if (writtenProperty(target) != nullptr) {
        propertySet(target, [&] { w_ << set; });
        w_ << ' ';
      } else {
        w_ << writableText(target) << " = " << set << "; ";
      }
    }
    w_ << '}';
    break;
  }
  case AssignOp::assign: {
    const bool found = s->targets.size() > 1 && findPlaces(s);
    store(last, s->value);
    for (std::size_t i = s->targets.size() - 1; i-- > 0;) {
      w_ << ' ';
      const Expr *from = s->targets[i + 1];
      const std::size_t start = w_.size();
      raw(from);
      const std::string source = w_.cut(start);
      outputTo(s->targets[i], source, from->type, s->span);
    }
    found_.clear();
    w_ << (found ? " }" : "");
    break;
  }
  }
  end();
}

void Emitter::callStatement(const CallStmt *s) {
  if (s->expr->kind != ExprKind::call)
    return;
  const auto *call = as<CallExpr>(s->expr);
  begin(s->span);
  switch (call->resolved) {
  case Callee::function:
  case Callee::method:
    functionCall(call, true);
    break;
  case Callee::functionBlock:
  case Callee::program:
    instanceCall(call, s->span);
    break;
  case Callee::builtin:
    if (call->builtin == Builtin::deleteT) {
      deleteObject(call);
      break;
    }
    w_ << "static_cast<void>(";
    builtin(call);
    w_ << ");";
    break;
  case Callee::unresolved:
    break;
  }
  end();
}

// -------------------------------------------------------------------------------------------------------
// selection

void Emitter::ifStatement(const IfStmt *s) {
  const bool flat = s->branches.size() > kMaxElseIf;
  const std::string behind = flat ? temporary("endif") : std::string();
  for (std::size_t i = 0; i < s->branches.size(); ++i) {
    const IfBranch &branch = s->branches[i];
    begin(i == 0 ? s->span : branch.condition->span);
    w_ << (i == 0 || flat ? "if (" : "} else if (");
    condition(branch.condition);
    w_ << ") {";
    end();
    open();
    block(branch.body);
    if (flat) {
      w_.line() << "goto " << behind << ';';
      end();
    }
    close();
    if (flat) {
      w_.line() << '}';
      end();
    }
  }
  if (flat) {
    block(s->elseBody);
    close();
    w_.line() << behind << ":;";
    end();
    open();
    return;
  }
  if (!s->elseBody.empty()) {
    w_.line() << "} else {";
    end();
    open();
    block(s->elseBody);
    close();
  }
  w_.line() << '}';
  end();
}

void Emitter::caseStatement(const CaseStmt *s) {
  std::int64_t labels = 0;
  bool small = true;
  for (const CaseBranch &branch : s->branches) {
    for (const CaseLabel &label : branch.labels) {
      std::int64_t width = 0;
      if (label.high != nullptr && __builtin_sub_overflow(label.high->constant->integer,
                                                          label.low->constant->integer, &width))
        width = kMaxRange;
      small = small && width >= 0 && width < kMaxRange; // negative: an empty or a huge range
      labels += small ? width + 1 : 0;
    }
  }
  if (small &&
      (labels <= kMaxLabels || labels <= 4 * static_cast<std::int64_t>(s->branches.size())))
    caseSwitch(s);
  else
    caseChain(s);
}

void Emitter::caseSwitch(const CaseStmt *s) {
  begin(s->span);
  w_ << "switch (";
  value(s->selector);
  w_ << ") {";
  end();
  if (!loops_.empty())
    ++loops_.back().switches;
  const Type *type = s->selector->type;
  for (const CaseBranch &branch : s->branches) {
    for (std::size_t i = 0; i < branch.labels.size(); ++i) {
      const CaseLabel &label = branch.labels[i];
      const std::int64_t low = label.low->constant->integer;
      const std::int64_t high = label.high == nullptr ? low : label.high->constant->integer;
      for (std::int64_t v = low;; ++v) {
        begin(label.span);
        w_ << "case ";
        if (v == low)
          valueAs(label.low, type);
        else
          number(v, type);
        w_ << (i + 1 == branch.labels.size() && v == high ? ": {" : ":");
        end();
        if (v == high)
          break;
      }
    }
    open();
    block(branch.body);
    w_.line() << "break;";
    end();
    close();
    w_.line() << '}';
    end();
  }
  w_.line() << "default: {";
  end();
  open();
  block(s->elseBody);
  w_.line() << "break;";
  end();
  close();
  w_.line() << '}';
  end();
  w_.line() << '}';
  end();
  if (!loops_.empty())
    --loops_.back().switches;
}

void Emitter::caseChain(const CaseStmt *s) {
  const Type *type = s->selector->type;
  const std::string selector = temporary("selector");
  begin(s->span);
  w_ << "const " << this->type(type) << ' ' << selector << " = ";
  valueAs(s->selector, type);
  w_ << ';';
  end();
  const bool flat = s->branches.size() > kMaxElseIf;
  const std::string behind = flat ? temporary("endcase") : std::string();
  if (flat) { // the label behind must not lie in the scope of the selector's declaration
    w_.line() << '{';
    end();
    open();
  }
  for (std::size_t b = 0; b < s->branches.size(); ++b) {
    const CaseBranch &branch = s->branches[b];
    begin(branch.labels.empty() ? s->span : branch.labels.front().span);
    w_ << (b == 0 || flat ? "if (" : "} else if (");
    for (std::size_t i = 0; i < branch.labels.size(); ++i) {
      const CaseLabel &label = branch.labels[i];
      if (i > 0)
        w_ << " || ";
      if (label.high == nullptr) {
        w_ << selector << " == ";
        valueAs(label.low, type);
      } else {
        w_ << '(' << selector << " >= ";
        valueAs(label.low, type);
        w_ << " && " << selector << " <= ";
        valueAs(label.high, type);
        w_ << ')';
      }
    }
    w_ << ") {";
    end();
    open();
    block(branch.body);
    if (flat) {
      w_.line() << "goto " << behind << ';';
      end();
    }
    close();
    if (flat) {
      w_.line() << '}';
      end();
    }
  }
  if (flat) {
    block(s->elseBody);
    close();
    w_.line() << '}';
    end();
    w_.line() << behind << ":;";
    end();
    return;
  }
  if (!s->elseBody.empty()) {
    w_.line() << "} else {";
    end();
    open();
    block(s->elseBody);
    close();
  }
  w_.line() << '}';
  end();
}

} // namespace stc::codegen
