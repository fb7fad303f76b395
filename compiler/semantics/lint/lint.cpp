// Walks all bodies once and notes how variables are used.

#include "compiler/semantics/lint/lint.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

/// Functions of the compiler that only compute a value of their arguments.
bool onlyReads(Builtin builtin) {
  return builtin <= Builtin::time || builtin == Builtin::sizeofT || isAssertion(builtin);
}

bool containsLabel(Block block) {
  bool found = false;
  walkStatements(block, [&](const Stmt *stmt) {
    found = found || stmt->kind == StmtKind::label || stmt->kind == StmtKind::jump;
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
  if (program_.diagnostics.wants(Code::unusedPou))
    reportUnusedPous(library);
}

/// VAR_CONFIG and VAR_ACCESS reach what nothing else may name.
void Linter::usePath(const StatePath &path, const VarSymbol *end) {
  const auto mark = [this](const VarSymbol *v) { usedOutside_.insert(v); };
  if (path.root != nullptr && path.root->kind == SymbolKind::variable)
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
  body.sideEffects = decl->external || decl->kind != DeclKind::function;
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
    v->symbol->lintBody = static_cast<std::uint32_t>(current_ + 1);
    markUsed(v->symbol->type);
  }
}

/// Constants are used by bounds and lengths, too.
void Linter::typeExpr(TypeExpr *type) {
  if (type == nullptr)
    return;
  switch (type->kind) {
  case TypeExprKind::array: {
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
  case TypeExprKind::string:
    if (Expr *length = as<StringTypeExpr>(type)->length)
      read(length);
    break;
  case TypeExprKind::pointer:
  case TypeExprKind::reference:
    typeExpr(as<PointerTypeExpr>(type)->pointee);
    break;
  case TypeExprKind::subrange:
    read(as<SubrangeTypeExpr>(type)->low);
    read(as<SubrangeTypeExpr>(type)->high);
    break;
  case TypeExprKind::named: {
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
  if (init->kind != ExprKind::aggregate) {
    if (init->kind == ExprKind::name || init->kind == ExprKind::member)
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

void Linter::use(VarSymbol *variable, std::uint8_t bits, const Expr *where) {
  if ((bits & useRead) != 0 && (variable->uses & (useWritten | useAddress)) == 0 &&
      (bits & (useWritten | useAddress)) == 0 && variable->earlyRead == nullptr) {
    variable->earlyRead = where;
    variable->earlyLoop = loopStart_;
  }
  if ((bits & (useWritten | useAddress)) != 0) {
    variable->lastWrite = ++writes_;
    // In the loop's next round the write comes before the read.
    if ((variable->uses & (useWritten | useAddress)) == 0 && variable->earlyRead != nullptr &&
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
    case ExprKind::name: {
      Symbol *symbol = as<NameExpr>(expr)->symbol;
      return symbol != nullptr && symbol->kind == SymbolKind::variable
                 ? static_cast<VarSymbol *>(symbol)
                 : nullptr;
    }
    case ExprKind::member: {
      const auto *member = as<MemberExpr>(expr);
      const Symbol *symbol = member->symbol;
      if (symbol != nullptr && symbol->kind == SymbolKind::variable &&
          static_cast<const VarSymbol *>(symbol)->globals != nullptr)
        return static_cast<VarSymbol *>(member->symbol); // `GVL.x`
      expr = member->base;
      break;
    }
    case ExprKind::index:
      expr = as<IndexExpr>(expr)->base;
      break;
    default:
      return nullptr;
    }
  }
}

void Linter::read(Expr *expr) {
  while (expr->kind == ExprKind::unary) {
    conversion(expr);
    expr = as<UnaryExpr>(expr)->operand;
  }
  conversion(expr);
  switch (expr->kind) {
  case ExprKind::name:
    if (Symbol *symbol = as<NameExpr>(expr)->symbol;
        symbol != nullptr && symbol->kind == SymbolKind::variable)
      use(static_cast<VarSymbol *>(symbol), useRead, expr);
    break;
  case ExprKind::member: {
    auto *member = as<MemberExpr>(expr);
    if (Symbol *symbol = member->symbol;
        symbol != nullptr && symbol->kind == SymbolKind::variable) {
      auto *variable = static_cast<VarSymbol *>(symbol);
      use(variable, useRead, expr);
      if (variable->section == Section::inOut && variable->owner != nullptr &&
          member->base->kind == ExprKind::name) {
        const VarSymbol *instance = rootVariable(member->base);
        const Body &body = bodies_[current_];
        if (instance != nullptr && (instance->uses & (useCalled | useAddress)) == 0 &&
            instance->section == Section::local && body.owner == body.decl &&
            body.owner->methods.empty() && body.owner->actions.empty() && loopStart_ == 0 &&
            !body.hasLabels && isOwnLocal(instance))
          report(Code::inOutBeforeCall, expr->span,
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
  case ExprKind::index: {
    auto *index = as<IndexExpr>(expr);
    read(index->base);
    for (Expr *i : index->indices)
      read(i);
    break;
  }
  case ExprKind::deref:
    read(as<DerefExpr>(expr)->base);
    break;
  case ExprKind::call:
    call(as<CallExpr>(expr));
    break;
  case ExprKind::binary:
    readBinary(as<BinaryExpr>(expr));
    break;
  case ExprKind::aggregate:
    initial(expr);
    break;
  default:
    break;
  }
}

void Linter::readBinary(BinaryExpr *expr) {
  // Sums of ten thousand terms lean to the left; walk down instead of recursing.
  const std::size_t first = chain_.size();
  chain_.push_back(expr);
  while (chain_.back()->left->kind == ExprKind::binary)
    chain_.push_back(as<BinaryExpr>(chain_.back()->left));
  read(chain_.back()->left);
  while (chain_.size() > first) {
    BinaryExpr *b = chain_.back();
    chain_.pop_back();
    if (b != expr)
      conversion(b);
    const bool shortCircuit = b->op == BinaryOp::andThen || b->op == BinaryOp::orElse;
    conditional_ += shortCircuit ? 1 : 0;
    read(b->right);
    conditional_ -= shortCircuit ? 1 : 0;
    if (b->op >= BinaryOp::equal && b->op <= BinaryOp::greaterEqual)
      comparison(b);
    sameOperands(b);
  }
}

void Linter::write(Expr *target) {
  if (VarSymbol *root = rootVariable(target)) {
    const bool whole = target->kind == ExprKind::name;
    const bool indirect = root->section == Section::inOut ||
                          (root->type != nullptr && (root->type->kind == TypeKind::reference ||
                                                     root->type->kind == TypeKind::pointer));
    use(root, indirect || !whole ? useRead | useWritten : useWritten, target);
    if (indirect || (!isOwnLocal(root)) || root->section == Section::stat)
      bodies_[current_].sideEffects = true;
    for (const ForStmt *loop : fors_) {
      if (whole && rootVariable(loop->variable) == root && loop->variable->kind == ExprKind::name)
        report(Code::forVariableModified, target->span,
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
  case ExprKind::member: {
    auto *member = as<MemberExpr>(target);
    if (member->symbol != nullptr && member->symbol->kind == SymbolKind::variable)
      use(static_cast<VarSymbol *>(member->symbol), useWritten, target);
    if (member->base->kind == ExprKind::member || member->base->kind == ExprKind::index)
      write(member->base);
    else
      read(member->base);
    break;
  }
  case ExprKind::index: {
    auto *index = as<IndexExpr>(target);
    for (Expr *i : index->indices)
      read(i);
    if (index->base->kind == ExprKind::member || index->base->kind == ExprKind::index)
      write(index->base);
    else if (index->base->kind != ExprKind::name)
      read(index->base);
    break;
  }
  case ExprKind::deref:
    read(as<DerefExpr>(target)->base);
    break;
  case ExprKind::name:
    break;
  default:
    read(target);
  }
}

void Linter::takeAddress(Expr *expr) {
  if (VarSymbol *root = rootVariable(expr)) {
    use(root, useAddress | useRead | useWritten, expr);
    if (!isOwnLocal(root))
      bodies_[current_].sideEffects = true;
  }
  if (expr->kind == ExprKind::member) {
    auto *member = as<MemberExpr>(expr);
    if (member->symbol != nullptr && member->symbol->kind == SymbolKind::variable)
      use(static_cast<VarSymbol *>(member->symbol), useAddress | useRead | useWritten, expr);
  }
  read(expr);
}

void Linter::call(CallExpr *expr) {
  if (expr->pou != nullptr)
    usedPous_.insert(expr->pou);
  Body &body = bodies_[current_];
  const bool function = expr->resolved == Callee::function;
  const bool builtin = expr->resolved == Callee::builtin;
  if (!builtin) {
    for (Loop *loop : loops_)
      loop->calls = true;
  }
  if (function && expr->pou != nullptr) {
    const PouSymbol *pou = expr->pou;
    ++functionCalls_[pou->decl].all;
    if (pou->decl == body.decl && conditional_ == 0 && !mayHaveLeft_ && !body.recursesAlways) {
      body.recursesAlways = true;
      report(Code::unconditionalRecursion, expr->span,
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
    if (expr->resolved == Callee::method && expr->pou != nullptr && expr != statementCall_)
      resultsTaken_.insert(expr->pou->name.id);
    if (VarSymbol *root = rootVariable(expr->callee))
      use(root, useCalled | useRead, expr->callee);
    read(expr->callee);
  }
  const bool pureBuiltin = builtin && onlyReads(expr->builtin);
  if (builtin && (expr->builtin == Builtin::shl || expr->builtin == Builtin::shr))
    shift(expr);
  if (builtin && (expr->builtin == Builtin::convert || expr->builtin == Builtin::trunc))
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
               (p != nullptr && (p->section == Section::inOut ||
                                 (p->type != nullptr && p->type->kind == TypeKind::reference)))) {
      takeAddress(argument.value);
    } else {
      read(argument.value);
    }
  }
}

} // namespace stc
