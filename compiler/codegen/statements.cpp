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
