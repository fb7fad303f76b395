// Walks all bodies once and notes how variables are used.

#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/lint/internal.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>
#include <atomic>

namespace stc::lint {

using namespace ast;

static void declarations(Context &c, std::span<VarDecl *const> variables);
static void construct(Context &c, std::span<Argument> arguments);
static void readBinary(Context &c, BinaryExpr *expr);
static void call(Context &c, CallExpr *expr);

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
  return row.readsValues() || row.takes.what == BuiltinTakes::TypeOf ||
         row.takes.what == BuiltinTakes::Enabled;
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

std::string text(const Context &c, Span span) {
  std::string_view all = c.program.sources.text(span);
  const bool usable = all.size() <= 40 && all.find('\n') == std::string_view::npos;
  return usable ? std::string(all) : "…";
}

void walk(Context &c, size_t index) {
  c.current = index;
  Body &body = c.bodies[index];
  PouDecl *const decl = body.decl;
  body.hasLabels = containsLabel(decl->body);
  body.sideEffects = decl->external || decl->kind != DeclKind::Function;
  c.loops.clear();
  c.fors.clear();
  c.loopStart = 0;
  c.conditional = 0;
  c.mayHaveLeft = body.hasLabels;
  declarations(c, decl->variables);
  block(c, decl->body);
}

static void declarations(Context &c, std::span<VarDecl *const> variables) {
  for (const VarDecl *v : variables) {
    typeExpr(c, v->type);
    initial(c, v->init);
    if (v->symbol == nullptr || v->symbol->type == nullptr)
      continue;
    v->symbol->lintBody = static_cast<uint32_t>(c.current + 1);
    markUsed(c, v->symbol->type);
  }
}

void typeExpr(Context &c, TypeExpr *type) {
  if (type == nullptr)
    return;
  switch (type->kind) {
  case TypeExprKind::Array: {
    auto *array = as<ArrayTypeExpr>(type);
    for (const ArrayRange &range : array->ranges) {
      if (range.low != nullptr)
        read(c, range.low);
      if (range.high != nullptr)
        read(c, range.high);
    }
    typeExpr(c, array->element);
    break;
  }
  case TypeExprKind::String:
    if (Expr *length = as<StringTypeExpr>(type)->length)
      read(c, length);
    break;
  case TypeExprKind::Pointer:
  case TypeExprKind::Reference:
    typeExpr(c, as<PointerTypeExpr>(type)->pointee);
    break;
  case TypeExprKind::Subrange:
    read(c, as<SubrangeTypeExpr>(type)->low);
    read(c, as<SubrangeTypeExpr>(type)->high);
    break;
  case TypeExprKind::Named: {
    auto *named = as<NamedTypeExpr>(type);
    construct(c, named->arguments);
    for (const std::span<Argument> arguments : named->elements)
      construct(c, arguments);
    break;
  }
  default:
    break;
  }
}

/// The inputs of FB_Init.
static void construct(Context &c, std::span<Argument> arguments) {
  for (const Argument &argument : arguments) {
    if (argument.value != nullptr)
      initial(c, argument.value); // interfaces and references keep the variable
  }
}

void initial(Context &c, Expr *init) {
  if (init == nullptr)
    return;
  if (init->kind != ExprKind::Aggregate) {
    if (init->kind == ExprKind::Name || init->kind == ExprKind::Member)
      takeAddress(c, init); // may be a REFERENCE's
    else
      read(c, init);
    return;
  }
  const auto items = [&c](auto &&self, std::span<AggregateItem> list) -> void {
    for (const AggregateItem &item : list) {
      if (item.repeat != nullptr)
        read(c, item.repeat);
      initial(c, item.value);
      self(self, item.values);
    }
  };
  items(items, as<AggregateExpr>(init)->items);
}

/// It belongs to the POU whose bodies this thread walks: what they do to it is known in the order
/// of the text.
static bool isOfPou(const Context &c, const VarSymbol *variable) {
  const PouSymbol *owner = variable->owner;
  const PouDecl *here = c.bodies[c.current].owner;
  return owner != nullptr &&
         (owner->decl == here || (owner->owner != nullptr && owner->owner->decl == here));
}

bool isOwnLocal(const Context &c, const VarSymbol *variable) {
  return variable->isResult || (isOfPou(c, variable) && variable->lintBody == c.current + 1);
}

/// Of global variables and fields nobody asks how they are used.
static void useElsewhere(VarSymbol *variable, uint8_t bits) {
  if (variable->owner == nullptr)
    return;
  std::atomic_ref<uint8_t> uses(variable->usesElsewhere);
  if ((uses.load(std::memory_order_relaxed) & bits) != bits)
    uses.fetch_or(bits, std::memory_order_relaxed);
}

void markUse(const Context &c, VarSymbol *variable, uint8_t bits) {
  if (isOfPou(c, variable))
    variable->uses |= bits;
  else
    useElsewhere(variable, bits);
}

static void use(Context &c, VarSymbol *variable, uint8_t bits, const Expr *where) {
  const bool writes = (bits & (kUseWritten | kUseAddress)) != 0;
  if (writes && variable->isResult && variable->owner != nullptr)
    c.resultsWritten.insert(variable->owner->decl);
  if (!isOfPou(c, variable)) {
    useElsewhere(variable, bits);
    return;
  }
  if ((bits & kUseRead) != 0 && (variable->uses & (kUseWritten | kUseAddress)) == 0 && !writes &&
      variable->earlyRead == nullptr) {
    variable->earlyRead = where;
    variable->earlyLoop = c.loopStart;
  }
  if (writes) {
    variable->lastWrite = ++c.writes;
    // In the loop's next round the write comes before the read.
    if ((variable->uses & (kUseWritten | kUseAddress)) == 0 && variable->earlyRead != nullptr &&
        variable->earlyLoop != 0 && variable->earlyLoop == c.loopStart)
      variable->earlyRead = nullptr;
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

/// A VAR_IN_OUT of an instance that was not called yet.
static void inOutBeforeCall(Context &c, const MemberExpr *member, const VarSymbol *variable) {
  if (variable->section != Section::InOut || variable->owner == nullptr ||
      member->base->kind != ExprKind::Name)
    return;
  const VarSymbol *instance = rootVariable(member->base);
  const Body &body = c.bodies[c.current];
  if (instance == nullptr || (instance->uses & (kUseCalled | kUseAddress)) != 0 ||
      instance->section != Section::Local || body.owner != body.decl ||
      !body.owner->methods.empty() || !body.owner->actions.empty() || c.loopStart != 0 ||
      body.hasLabels || !isOwnLocal(c, instance))
    return;
  c.found->inOuts.push_back({member, variable, instance});
}

/// CODESYS lets other code look at a block's own variables.
static void foreignRead(Context &c, const MemberExpr *member) {
  const VarSymbol *variable = foreignLocal(member->symbol, c.bodies[c.current].pou);
  if (variable == nullptr)
    return;
  const std::string owner(variable->owner->name.text);
  report(c, Code::ForeignLocal, member->name.span,
         "`" + std::string(member->name.text) + "` is a variable of `" + owner + "` itself",
         "read from outside")
      .label(variable->name.span, "a VAR may change its meaning with the next version of the block")
      .help("make it a VAR_OUTPUT of `" + owner + "`");
}

void read(Context &c, Expr *expr) {
  while (expr->kind == ExprKind::Unary) {
    conversion(c, expr);
    expr = as<UnaryExpr>(expr)->operand;
  }
  conversion(c, expr);
  switch (expr->kind) {
  case ExprKind::Name:
    if (Symbol *symbol = as<NameExpr>(expr)->symbol;
        symbol != nullptr && symbol->kind == SymbolKind::Variable)
      use(c, static_cast<VarSymbol *>(symbol), kUseRead, expr);
    break;
  case ExprKind::Member: {
    auto *member = as<MemberExpr>(expr);
    if (Symbol *symbol = member->symbol;
        symbol != nullptr && symbol->kind == SymbolKind::Variable) {
      auto *variable = static_cast<VarSymbol *>(symbol);
      use(c, variable, kUseRead, expr);
      inOutBeforeCall(c, member, variable);
      foreignRead(c, member);
    }
    read(c, member->base);
    break;
  }
  case ExprKind::Index: {
    auto *index = as<IndexExpr>(expr);
    read(c, index->base);
    for (Expr *i : index->indices)
      read(c, i);
    break;
  }
  case ExprKind::Deref:
    read(c, as<DerefExpr>(expr)->base);
    break;
  case ExprKind::Call:
    call(c, as<CallExpr>(expr));
    break;
  case ExprKind::Binary:
    readBinary(c, as<BinaryExpr>(expr));
    break;
  case ExprKind::Aggregate:
    initial(c, expr);
    break;
  default:
    break;
  }
}

static void readBinary(Context &c, BinaryExpr *expr) {
  // Sums of ten thousand terms lean to the left; walk down instead of recursing.
  const size_t first = c.chain.size();
  c.chain.push_back(expr);
  while (c.chain.back()->left->kind == ExprKind::Binary)
    c.chain.push_back(as<BinaryExpr>(c.chain.back()->left));
  read(c, c.chain.back()->left);
  while (c.chain.size() > first) {
    BinaryExpr *b = c.chain.back();
    c.chain.pop_back();
    if (b != expr)
      conversion(c, b);
    const bool shortCircuit = b->op == BinaryOp::AndThen || b->op == BinaryOp::OrElse;
    c.conditional += shortCircuit ? 1 : 0;
    read(c, b->right);
    c.conditional -= shortCircuit ? 1 : 0;
    if (b->op >= BinaryOp::Equal && b->op <= BinaryOp::GreaterEqual)
      comparison(c, b);
    sameOperands(c, b);
  }
}

void write(Context &c, Expr *target) {
  if (VarSymbol *root = rootVariable(target)) {
    const bool whole = target->kind == ExprKind::Name;
    const bool indirect = root->section == Section::InOut ||
                          (root->type != nullptr && (root->type->kind == TypeKind::Reference ||
                                                     root->type->kind == TypeKind::Pointer));
    use(c, root, indirect || !whole ? kUseRead | kUseWritten : kUseWritten, target);
    if (indirect || (!isOwnLocal(c, root)) || root->section == Section::Stat)
      c.bodies[c.current].sideEffects = true;
    for (const ForStmt *loop : c.fors) {
      if (whole && rootVariable(loop->variable) == root && loop->variable->kind == ExprKind::Name)
        report(c, Code::ForVariableModified, target->span,
               "`" + std::string(root->name.text) +
                   "` is changed inside of the loop that counts "
                   "with it",
               "the next step counts on from here")
            .label(loop->variable->span, "counted here")
            .help("leave the loop with EXIT, skip a round with CONTINUE, or use WHILE");
    }
  } else {
    c.bodies[c.current].sideEffects = true;
  }
  switch (target->kind) { // what is read to find the place
  case ExprKind::Member: {
    auto *member = as<MemberExpr>(target);
    if (member->symbol != nullptr && member->symbol->kind == SymbolKind::Variable)
      use(c, static_cast<VarSymbol *>(member->symbol), kUseWritten, target);
    if (member->base->kind == ExprKind::Member || member->base->kind == ExprKind::Index)
      write(c, member->base);
    else
      read(c, member->base);
    break;
  }
  case ExprKind::Index: {
    auto *index = as<IndexExpr>(target);
    for (Expr *i : index->indices)
      read(c, i);
    if (index->base->kind == ExprKind::Member || index->base->kind == ExprKind::Index)
      write(c, index->base);
    else if (index->base->kind != ExprKind::Name)
      read(c, index->base);
    break;
  }
  case ExprKind::Deref:
    read(c, as<DerefExpr>(target)->base);
    break;
  case ExprKind::Name:
    break;
  default:
    read(c, target);
  }
}

void takeAddress(Context &c, Expr *expr) {
  if (VarSymbol *root = rootVariable(expr)) {
    use(c, root, kUseAddress | kUseRead | kUseWritten, expr);
    if (!isOwnLocal(c, root))
      c.bodies[c.current].sideEffects = true;
  }
  if (expr->kind == ExprKind::Member) {
    auto *member = as<MemberExpr>(expr);
    if (member->symbol != nullptr && member->symbol->kind == SymbolKind::Variable)
      use(c, static_cast<VarSymbol *>(member->symbol), kUseAddress | kUseRead | kUseWritten, expr);
  }
  read(c, expr);
}

static void call(Context &c, CallExpr *expr) {
  if (expr->pou != nullptr)
    c.usedPous.insert(expr->pou);
  Body &body = c.bodies[c.current];
  const bool function = expr->resolved == Callee::Function;
  const bool builtin = expr->resolved == Callee::Builtin;
  if (!builtin) {
    for (Loop *loop : c.loops)
      loop->calls = true;
  }
  if (function && expr->pou != nullptr) {
    const PouSymbol *pou = expr->pou;
    ++c.functionCalls[pou->decl].all;
    if (pou->decl == body.decl && c.conditional == 0 && !c.mayHaveLeft && !body.recursesAlways) {
      body.recursesAlways = true;
      report(c, Code::UnconditionalRecursion, expr->span,
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
    if (expr->resolved == Callee::Method && expr->pou != nullptr && expr != c.statementCall)
      c.resultsTaken.insert(expr->pou->name.id);
    if (VarSymbol *root = rootVariable(expr->callee))
      use(c, root, kUseCalled | kUseRead, expr->callee);
    read(c, expr->callee);
  }
  const bool pureBuiltin = onlyReads(expr);
  if (does(expr, BuiltinRow::kShiftsOut))
    shift(c, expr);
  if (does(expr, BuiltinRow::kSaturates))
    saturation(c, expr);
  for (Argument &argument : expr->arguments) {
    if (argument.value == nullptr)
      continue;
    const VarSymbol *p = argument.parameter;
    const bool alias =
        p != nullptr && (p->section == Section::InOut ||
                         (p->type != nullptr && p->type->kind == TypeKind::Reference));
    if (argument.output)
      write(c, argument.value);
    else if (!pureBuiltin && (builtin || alias))
      takeAddress(c, argument.value);
    else
      read(c, argument.value);
  }
}

} // namespace stc::lint
