// Walks all bodies once and notes how variables are used.

#include "compiler/semantics/lint/lint.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

/// The call is one of a function that the compiler implements itself, with that effect.
bool does(const CallExpr *call, BuiltinRow::Effect effect) {
  return call->resolved == Callee::Builtin && (builtinRow(call->builtin).does & effect) != 0;
}

/// The call does nothing with its arguments but read them, or ask for their size.
bool onlyReads(const CallExpr *call) {
  if (call->resolved != Callee::Builtin)
    return false;
  const BuiltinRow &row = builtinRow(call->builtin);
  return row.readsValues() || row.takes.what == BuiltinTakes::TypeOf;
}

bool containsLabel(Block block) {
  bool found = false;
  walkStatements(block, [&](const Stmt *stmt) {
    found = found || stmt->kind == StmtKind::Label || stmt->kind == StmtKind::Jump;
    return !found;
  });
  return found;
}

} // namespace

std::string Linter::text(Span span) const {
  std::string_view all = program_.sources.text(span);
  const bool usable = all.size() <= 40 && all.find('\n') == std::string_view::npos;
  return usable ? std::string(all) : "…";
}

void Linter::run(Library &library) {
  for (PouSymbol *pou : library.pous) {
    PouDecl *decl = pou->decl;
    walk(decl, decl, pou);
    for (PouDecl *method : decl->methods)
      walk(method, decl, pou);
    for (PouDecl *action : decl->actions)
      walk(action, decl, pou);
    for (PropertyDecl *property : decl->properties) {
      if (property->get != nullptr)
        walk(property->get, decl, pou);
      if (property->set != nullptr)
        walk(property->set, decl, pou);
    }
  }
  for (GlobalsSymbol *globals : library.globals) {
    for (VarSymbol *v : globals->variables) {
      if (v->decl != nullptr) {
        typeExpr(v->decl->type);
        initial(v->decl->init);
      }
      markUsed(v->type);
    }
  }
  for (const SlotPlace &slot : program_.slotPlaces)
    usePath(slot.path, slot.variable);
  for (const AccessPath &access : program_.accessPaths)
    usePath(access.path, nullptr);
  for (const Body &body : bodies_) {
    reportVariables(body);
    reportResults(body);
  }
  reportRecursion();
  reportIgnored();
  if (program_.diagnostics.wants(Code::UnusedPou))
    reportUnusedPous(library);
}

/// VAR_CONFIG and VAR_ACCESS reach what nothing else may name.
void Linter::usePath(const StatePath &path, const VarSymbol *end) {
  const auto mark = [this](const VarSymbol *v) { usedOutside_.insert(v); };
  if (path.root != nullptr && path.root->kind == SymbolKind::Variable)
    mark(static_cast<const VarSymbol *>(path.root));
  for (const PathStep &step : path.steps) {
    if (step.member != nullptr)
      mark(step.member);
  }
  if (end != nullptr)
    mark(end);
}

void Linter::walk(PouDecl *decl, PouDecl *owner, PouSymbol *pou) {
  if (!walked_.insert(decl).second)
    return;
  current_ = bodies_.size();
  bodyOf_.emplace(decl, current_);
  Body &body = bodies_.emplace_back();
  body.decl = decl;
  body.owner = owner;
  body.pou = pou;
  body.hasLabels = containsLabel(decl->body);
  body.sideEffects = decl->external || decl->kind != DeclKind::Function;
  loops_.clear();
  fors_.clear();
  loopStart_ = 0;
  conditional_ = 0;
  mayHaveLeft_ = body.hasLabels;
  declarations(decl->variables);
  block(decl->body);
}

void Linter::declarations(std::span<VarDecl *const> variables) {
  for (const VarDecl *v : variables) {
    typeExpr(v->type);
    initial(v->init);
    if (v->symbol == nullptr || v->symbol->type == nullptr)
      continue;
    v->symbol->lintBody = static_cast<uint32_t>(current_ + 1);
    markUsed(v->symbol->type);
  }
}

/// Constants are used by bounds and lengths, too.
void Linter::typeExpr(TypeExpr *type) {
  if (type == nullptr)
    return;
  switch (type->kind) {
  case TypeExprKind::Array: {
    auto *array = as<ArrayTypeExpr>(type);
    for (const ArrayRange &range : array->ranges) {
      if (range.low != nullptr)
        read(range.low);
      if (range.high != nullptr)
        read(range.high);
    }
    typeExpr(array->element);
    break;
  }
  case TypeExprKind::String:
    if (Expr *length = as<StringTypeExpr>(type)->length)
      read(length);
    break;
  case TypeExprKind::Pointer:
  case TypeExprKind::Reference:
    typeExpr(as<PointerTypeExpr>(type)->pointee);
    break;
  case TypeExprKind::Subrange:
    read(as<SubrangeTypeExpr>(type)->low);
    read(as<SubrangeTypeExpr>(type)->high);
    break;
  case TypeExprKind::Named: {
    auto *named = as<NamedTypeExpr>(type);
    construct(named->arguments);
    for (const std::span<Argument> arguments : named->elements)
      construct(arguments);
    break;
  }
  default:
    break;
  }
}

/// The inputs of FB_Init.
void Linter::construct(std::span<Argument> arguments) {
  for (const Argument &argument : arguments) {
    if (argument.value != nullptr)
      initial(argument.value); // interfaces and references keep the variable
  }
}

void Linter::initial(Expr *init) {
  if (init == nullptr)
    return;
  if (init->kind != ExprKind::Aggregate) {
    if (init->kind == ExprKind::Name || init->kind == ExprKind::Member)
      takeAddress(init); // may be a REFERENCE's
    else
      read(init);
    return;
  }
  const auto items = [this](auto &&self, std::span<AggregateItem> list) -> void {
    for (const AggregateItem &item : list) {
      if (item.repeat != nullptr)
        read(item.repeat);
      initial(item.value);
      self(self, item.values);
    }
  };
  items(items, as<AggregateExpr>(init)->items);
}

bool Linter::isOwnLocal(const VarSymbol *variable) const {
  return variable->isResult || variable->lintBody == current_ + 1;
}

void Linter::use(VarSymbol *variable, uint8_t bits, const Expr *where) {
  if ((bits & kUseRead) != 0 && (variable->uses & (kUseWritten | kUseAddress)) == 0 &&
      (bits & (kUseWritten | kUseAddress)) == 0 && variable->earlyRead == nullptr) {
    variable->earlyRead = where;
    variable->earlyLoop = loopStart_;
  }
  if ((bits & (kUseWritten | kUseAddress)) != 0) {
    variable->lastWrite = ++writes_;
    // In the loop's next round the write comes before the read.
    if ((variable->uses & (kUseWritten | kUseAddress)) == 0 && variable->earlyRead != nullptr &&
        variable->earlyLoop != 0 && variable->earlyLoop == loopStart_)
      variable->earlyRead = nullptr;
    if (variable->isResult && variable->owner != nullptr)
      resultsWritten_.insert(variable->owner->decl);
  }
  variable->uses |= bits;
}

VarSymbol *rootVariable(const Expr *expr) {
  for (;;) {
    switch (expr->kind) {
    case ExprKind::Name: {
      Symbol *symbol = as<NameExpr>(expr)->symbol;
      return symbol != nullptr && symbol->kind == SymbolKind::Variable
                 ? static_cast<VarSymbol *>(symbol)
                 : nullptr;
    }
    case ExprKind::Member: {
      const auto *member = as<MemberExpr>(expr);
      const Symbol *symbol = member->symbol;
      if (symbol != nullptr && symbol->kind == SymbolKind::Variable &&
          static_cast<const VarSymbol *>(symbol)->globals != nullptr)
        return static_cast<VarSymbol *>(member->symbol); // `GVL.x`
      expr = member->base;
      break;
    }
    case ExprKind::Index:
      expr = as<IndexExpr>(expr)->base;
      break;
    default:
      return nullptr;
    }
  }
}

void Linter::read(Expr *expr) {
  while (expr->kind == ExprKind::Unary) {
    conversion(expr);
    expr = as<UnaryExpr>(expr)->operand;
  }
  conversion(expr);
  switch (expr->kind) {
  case ExprKind::Name:
    if (Symbol *symbol = as<NameExpr>(expr)->symbol;
        symbol != nullptr && symbol->kind == SymbolKind::Variable)
      use(static_cast<VarSymbol *>(symbol), kUseRead, expr);
    break;
  case ExprKind::Member: {
    auto *member = as<MemberExpr>(expr);
    if (Symbol *symbol = member->symbol;
        symbol != nullptr && symbol->kind == SymbolKind::Variable) {
      auto *variable = static_cast<VarSymbol *>(symbol);
      use(variable, kUseRead, expr);
      if (variable->section == Section::InOut && variable->owner != nullptr &&
          member->base->kind == ExprKind::Name) {
        const VarSymbol *instance = rootVariable(member->base);
        const Body &body = bodies_[current_];
        if (instance != nullptr && (instance->uses & (kUseCalled | kUseAddress)) == 0 &&
            instance->section == Section::Local && body.owner == body.decl &&
            body.owner->methods.empty() && body.owner->actions.empty() && loopStart_ == 0 &&
            !body.hasLabels && isOwnLocal(instance))
          report(Code::InOutBeforeCall, expr->span,
                 "`" + std::string(member->name.text) + "` of `" +
                     std::string(instance->name.text) +
                     "` is used before the first call of the block",
                 "refers to nothing yet")
              .label(variable->name.span, "a VAR_IN_OUT gets its variable at the call")
              .help("call `" + std::string(instance->name.text) +
                    "(…)` first, or use the variable that is passed to it");
      }
    }
    read(member->base);
    break;
  }
  case ExprKind::Index: {
    auto *index = as<IndexExpr>(expr);
    read(index->base);
    for (Expr *i : index->indices)
      read(i);
    break;
  }
  case ExprKind::Deref:
    read(as<DerefExpr>(expr)->base);
    break;
  case ExprKind::Call:
    call(as<CallExpr>(expr));
    break;
  case ExprKind::Binary:
    readBinary(as<BinaryExpr>(expr));
    break;
  case ExprKind::Aggregate:
    initial(expr);
    break;
  default:
    break;
  }
}

void Linter::readBinary(BinaryExpr *expr) {
  // Sums of ten thousand terms lean to the left; walk down instead of recursing.
  const size_t first = chain_.size();
  chain_.push_back(expr);
  while (chain_.back()->left->kind == ExprKind::Binary)
    chain_.push_back(as<BinaryExpr>(chain_.back()->left));
  read(chain_.back()->left);
  while (chain_.size() > first) {
    BinaryExpr *b = chain_.back();
    chain_.pop_back();
    if (b != expr)
      conversion(b);
    const bool shortCircuit = b->op == BinaryOp::AndThen || b->op == BinaryOp::OrElse;
    conditional_ += shortCircuit ? 1 : 0;
    read(b->right);
    conditional_ -= shortCircuit ? 1 : 0;
    if (b->op >= BinaryOp::Equal && b->op <= BinaryOp::GreaterEqual)
      comparison(b);
    sameOperands(b);
  }
}

void Linter::write(Expr *target) {
  if (VarSymbol *root = rootVariable(target)) {
    const bool whole = target->kind == ExprKind::Name;
    const bool indirect = root->section == Section::InOut ||
                          (root->type != nullptr && (root->type->kind == TypeKind::Reference ||
                                                     root->type->kind == TypeKind::Pointer));
    use(root, indirect || !whole ? kUseRead | kUseWritten : kUseWritten, target);
    if (indirect || (!isOwnLocal(root)) || root->section == Section::Stat)
      bodies_[current_].sideEffects = true;
    for (const ForStmt *loop : fors_) {
      if (whole && rootVariable(loop->variable) == root && loop->variable->kind == ExprKind::Name)
        report(Code::ForVariableModified, target->span,
               "`" + std::string(root->name.text) +
                   "` is changed inside of the loop that counts "
                   "with it",
               "the next step counts on from here")
            .label(loop->variable->span, "counted here")
            .help("leave the loop with EXIT, skip a round with CONTINUE, or use WHILE");
    }
  } else {
    bodies_[current_].sideEffects = true;
  }
  switch (target->kind) { // what is read to find the place
  case ExprKind::Member: {
    auto *member = as<MemberExpr>(target);
    if (member->symbol != nullptr && member->symbol->kind == SymbolKind::Variable)
      use(static_cast<VarSymbol *>(member->symbol), kUseWritten, target);
    if (member->base->kind == ExprKind::Member || member->base->kind == ExprKind::Index)
      write(member->base);
    else
      read(member->base);
    break;
  }
  case ExprKind::Index: {
    auto *index = as<IndexExpr>(target);
    for (Expr *i : index->indices)
      read(i);
    if (index->base->kind == ExprKind::Member || index->base->kind == ExprKind::Index)
      write(index->base);
    else if (index->base->kind != ExprKind::Name)
      read(index->base);
    break;
  }
  case ExprKind::Deref:
    read(as<DerefExpr>(target)->base);
    break;
  case ExprKind::Name:
    break;
  default:
    read(target);
  }
}

void Linter::takeAddress(Expr *expr) {
  if (VarSymbol *root = rootVariable(expr)) {
    use(root, kUseAddress | kUseRead | kUseWritten, expr);
    if (!isOwnLocal(root))
      bodies_[current_].sideEffects = true;
  }
  if (expr->kind == ExprKind::Member) {
    auto *member = as<MemberExpr>(expr);
    if (member->symbol != nullptr && member->symbol->kind == SymbolKind::Variable)
      use(static_cast<VarSymbol *>(member->symbol), kUseAddress | kUseRead | kUseWritten, expr);
  }
  read(expr);
}

void Linter::call(CallExpr *expr) {
  if (expr->pou != nullptr)
    usedPous_.insert(expr->pou);
  Body &body = bodies_[current_];
  const bool function = expr->resolved == Callee::Function;
  const bool builtin = expr->resolved == Callee::Builtin;
  if (!builtin) {
    for (Loop *loop : loops_)
      loop->calls = true;
  }
  if (function && expr->pou != nullptr) {
    const PouSymbol *pou = expr->pou;
    ++functionCalls_[pou->decl].all;
    if (pou->decl == body.decl && conditional_ == 0 && !mayHaveLeft_ && !body.recursesAlways) {
      body.recursesAlways = true;
      report(Code::UnconditionalRecursion, expr->span,
             "`" + std::string(pou->name.text) + "` always calls itself", "this call never ends")
          .label(pou->name.span, "in this function")
          .help("make the call depend on a condition that becomes FALSE");
    }
    const bool known = std::any_of(body.calls.begin(), body.calls.end(),
                                   [&](const CallExpr *other) { return other->pou == expr->pou; });
    if (!known)
      body.calls.push_back(expr);
  } else if (!builtin) {
    body.sideEffects = true;
    if (expr->resolved == Callee::Method && expr->pou != nullptr && expr != statementCall_)
      resultsTaken_.insert(expr->pou->name.id);
    if (VarSymbol *root = rootVariable(expr->callee))
      use(root, kUseCalled | kUseRead, expr->callee);
    read(expr->callee);
  }
  const bool pureBuiltin = onlyReads(expr);
  if (does(expr, BuiltinRow::kShiftsOut))
    shift(expr);
  if (does(expr, BuiltinRow::kSaturates))
    saturation(expr);
  for (Argument &argument : expr->arguments) {
    if (argument.value == nullptr)
      continue;
    const VarSymbol *p = argument.parameter;
    if (argument.output) {
      write(argument.value);
    } else if (pureBuiltin) {
      read(argument.value);
    } else if (builtin ||
               (p != nullptr && (p->section == Section::InOut ||
                                 (p->type != nullptr && p->type->kind == TypeKind::Reference)))) {
      takeAddress(argument.value);
    } else {
      read(argument.value);
    }
  }
}

} // namespace stc
