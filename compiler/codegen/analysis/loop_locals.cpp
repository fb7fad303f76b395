#include "compiler/codegen/analysis/loop_locals.hpp"

#include "compiler/codegen/cpp/layout.hpp"
#include "compiler/semantics/held.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// Copying it copies variables of blocks.
bool holdsInstance(const Type *type) {
  return anyHeld(type, [](const Type *t, const VarSymbol *) {
    if (t->kind == TypeKind::Structure)
      return Held::Inside;
    return isElementary(t) || t->kind == TypeKind::Pointer ? Held::Over : Held::Found;
  });
}

/// A built-in function that looks at the values of its arguments at most.
bool onlyLooks(const BuiltinRow &row) {
  return row.onlyComputes() || row.takes.what == BuiltinTakes::TypeOf ||
         row.takes.what == BuiltinTakes::Bounds;
}

/// Calls save the locals: with more of them that costs more than it gains.
constexpr size_t kLocalsOverCalls = 4;

/// An instance that is found without following an address, so that its block is known.
bool isOwnPlace(const Expr *place) {
  while (true) {
    switch (place->kind) {
    case ExprKind::Name: {
      const VarSymbol *v = namedVariable(place);
      return v != nullptr && !isIndirect(v);
    }
    case ExprKind::Member: {
      const auto *m = as<MemberExpr>(place);
      if (m->symbol == nullptr || m->symbol->kind != SymbolKind::Variable ||
          isIndirect(static_cast<const VarSymbol *>(m->symbol)))
        return false;
      if (isNamespace(m->base))
        return true;
      place = m->base;
      continue;
    }
    case ExprKind::Index:
      if (followsAddress(as<IndexExpr>(place)))
        return false;
      place = as<IndexExpr>(place)->base;
      continue;
    default:
      return false;
    }
  }
}

/// A block that stands for itself alone: no other one shares its variables or replaces its code.
bool standsAlone(const PouSymbol *block) {
  return block->base == nullptr && !block->extended && !block->isAbstract();
}

} // namespace

std::vector<const VarSymbol *> LoopLocals::of(const Stmt *loop, const PouSymbol *pou) {
  if (pou == nullptr ||
      (pou->decl->kind != DeclKind::Program && pou->decl->kind != DeclKind::FunctionBlock))
    return {}; // a function's variables are C++ locals anyway
  Facts facts;
  statement(loop, facts);
  if (facts.opaque || contains(facts.called, pou) ||
      (!facts.called.empty() && pou->isBlock() && !standsAlone(pou)))
    return {};
  std::vector<const VarSymbol *> result;
  for (const VarSymbol *v : facts.written)
    if (!contains(result, v) && canBeLocal(v, pou, facts))
      result.push_back(v);
  if (!facts.called.empty() && result.size() > kLocalsOverCalls)
    result.resize(kLocalsOverCalls);
  return result;
}

bool LoopLocals::canBeLocal(const VarSymbol *v, const PouSymbol *pou, const Facts &facts) {
  const bool isMember =
      v->section == Section::Local || v->section == Section::Input || v->section == Section::Output;
  if (v->owner != pou || !isMember || v->isConstant || v->decl == nullptr ||
      v->decl->address != nullptr || v->isBit || analysis_.isShared(v))
    return false;
  // A pointer that each call puts back is quicker where it is.
  const bool isPointer =
      v->type->kind == TypeKind::Pointer && facts.called.empty() && pointers_.areTyped();
  return (isPointer || isScalar(v->type)) && !contains<const Symbol *>(facts.foreign, v) &&
         !contains(facts.indirect, underlying(v->type));
}

bool LoopLocals::countsAlone(const ForStmt *loop, const PouSymbol *pou) {
  const VarSymbol *v = namedVariable(loop->variable);
  if (v == nullptr || pou == nullptr || v->owner != pou || isIndirect(v) ||
      v->location != nullptr || v->section == Section::Stat || v->section == Section::Instance ||
      analysis_.isShared(v))
    return false;
  Facts facts;
  block(loop->body, facts);
  // A method shares the variables of its block with whatever it calls.
  const bool shares =
      contains(facts.called, pou) || (!facts.called.empty() && pou->isBlock() && !standsAlone(pou));
  // What an index is proven by does not rest on where pointers lead.
  return !facts.opaque && !facts.follows && !shares && !contains(facts.written, v) &&
         !contains<const Symbol *>(facts.foreign, v) &&
         !contains(facts.indirect, underlying(v->type));
}

void LoopLocals::block(Block block, Facts &facts) {
  for (const Stmt *s : block) {
    if (facts.opaque)
      return;
    statement(s, facts);
  }
}

void LoopLocals::statement(const Stmt *s, Facts &facts) {
  const auto value = [&](const Expr *e) { expression(e, facts); };
  const auto inner = [&](Block b) { block(b, facts); };
  switch (s->kind) {
  case StmtKind::Assign: {
    const auto *a = as<AssignStmt>(s);
    facts.opaque = facts.opaque || a->op == AssignOp::Reference;
    for (const Expr *t : a->targets)
      target(t, facts);
    return value(a->value);
  }
  case StmtKind::For:
    target(as<ForStmt>(s)->variable, facts);
    return forEachChild(s, value, inner);
  case StmtKind::Call:
    if (as<CallStmt>(s)->expr->kind == ExprKind::Call)
      call(as<CallExpr>(as<CallStmt>(s)->expr), facts);
    else
      facts.opaque = true;
    return;
  case StmtKind::Jump:
  case StmtKind::Label:
  case StmtKind::Try:
    facts.opaque = true;
    return;
  default:
    return forEachChild(s, value, inner);
  }
}

void LoopLocals::target(const Expr *expr, Facts &facts) {
  if (holdsInstance(expr->type)) {
    facts.opaque = true;
    return;
  }
  const Expr *whole = expr;
  if (whole->kind == ExprKind::Member && as<MemberExpr>(whole)->bit >= 0)
    whole = as<MemberExpr>(whole)->base;
  if (whole->kind == ExprKind::Name) {
    if (const VarSymbol *v = namedVariable(whole); v != nullptr && !isIndirect(v))
      facts.written.push_back(v);
  }
  expression(expr, facts);
}

void LoopLocals::name(const Symbol *symbol, Facts &facts) {
  if (symbol == nullptr) {
    facts.opaque = true;
    return;
  }
  if (symbol->kind != SymbolKind::Variable) {
    facts.opaque = facts.opaque || symbol->kind != SymbolKind::Enumerator;
    return;
  }
  const auto *v = static_cast<const VarSymbol *>(symbol);
  if (v->section == Section::Access) // another name of some variable
    facts.opaque = true;
  if (isIndirect(v)) {
    const Type *pointee =
        v->type->kind == TypeKind::Reference ? typeAs<PointerType>(v->type)->pointee : v->type;
    facts.indirect.push_back(underlying(pointee));
  }
}

void LoopLocals::expression(const Expr *e, Facts &facts) {
  while (!facts.opaque) {
    if (e->constant != nullptr)
      return;
    if (holdsInstance(e->type) && e->kind != ExprKind::Name && e->kind != ExprKind::Member &&
        e->kind != ExprKind::Index && e->kind != ExprKind::Deref) {
      facts.opaque = true;
      return;
    }
    switch (e->kind) {
    case ExprKind::Literal:
    case ExprKind::EnumLiteral:
      return;
    case ExprKind::Name:
      name(as<NameExpr>(e)->symbol, facts);
      return;
    case ExprKind::Member: {
      const auto *m = as<MemberExpr>(e);
      if (m->symbol == nullptr) {
        facts.opaque = facts.opaque || m->bit < 0;
      } else {
        name(m->symbol, facts);
        facts.foreign.push_back(m->symbol);
      }
      if (isNamespace(m->base))
        return;
      // A program before the dot is a place, too.
      if (m->base->kind == ExprKind::Name) {
        const Symbol *base = as<NameExpr>(m->base)->symbol;
        if (base != nullptr && base->kind == SymbolKind::Pou)
          return;
      }
      e = m->base;
      continue;
    }
    case ExprKind::Index: {
      const auto *i = as<IndexExpr>(e);
      facts.opaque = facts.opaque || followsAddress(i);
      for (const Expr *x : i->indices)
        expression(x, facts);
      e = i->base;
      continue;
    }
    case ExprKind::Unary:
      e = as<UnaryExpr>(e)->operand;
      continue;
    case ExprKind::Binary:
      expression(as<BinaryExpr>(e)->right, facts);
      e = as<BinaryExpr>(e)->left;
      continue;
    case ExprKind::Call:
      call(as<CallExpr>(e), facts);
      return;
    case ExprKind::Deref:
      deref(as<DerefExpr>(e), facts);
      e = as<DerefExpr>(e)->base;
      continue;
    default: // direct addresses
      facts.opaque = true;
      return;
    }
  }
}

/// A pointer leads to a variable of its type, or nobody knows where.
void LoopLocals::deref(const DerefExpr *e, Facts &facts) {
  const Type *pointer = e->base->type;
  if (pointer == nullptr || pointer->kind != TypeKind::Pointer ||
      !pointers_.leadTo(typeAs<PointerType>(pointer)->pointee)) {
    facts.opaque = true;
    return;
  }
  facts.follows = true;
  facts.indirect.push_back(underlying(typeAs<PointerType>(pointer)->pointee));
}

void LoopLocals::call(const CallExpr *e, Facts &facts) {
  if (e->resolved == Callee::FunctionBlock || e->resolved == Callee::Method) {
    instanceCall(e, facts);
    return;
  }
  const bool isFunction = e->resolved == Callee::Function && analysis_.pure(e->pou);
  const BuiltinRow *builtin = e->resolved == Callee::Builtin ? &builtinRow(e->builtin) : nullptr;
  if (!isFunction && (builtin == nullptr || !onlyLooks(*builtin))) {
    facts.opaque = true;
    return;
  }
  if (builtin != nullptr && builtin->takes.what == BuiltinTakes::TypeOf)
    return;
  arguments(e, facts);
  if (!isFunction)
    return;
  // A pure function writes its own variables only; what counts is which others it reads.
  const Facts &inner = body(e->pou);
  facts.opaque = facts.opaque || inner.opaque;
  facts.follows = facts.follows || inner.follows;
  facts.foreign.insert(facts.foreign.end(), inner.foreign.begin(), inner.foreign.end());
}

void LoopLocals::arguments(const CallExpr *e, Facts &facts) {
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr)
      continue;
    if (a.output) {
      target(a.value, facts);
      continue;
    }
    const bool binds = a.parameter != nullptr && isIndirect(a.parameter);
    if (holdsInstance(a.value->type) && !binds)
      facts.opaque = true;
    // What an in-out or a reference is bound to stays in memory.
    if (const VarSymbol *bound = binds ? namedVariable(a.value) : nullptr; bound != nullptr)
      facts.foreign.push_back(bound);
    expression(a.value, facts);
  }
}

/// A block or one of its methods: it reaches its own variables, those it names with a dot, and what
/// its in-outs and references may stand for.
void LoopLocals::instanceCall(const CallExpr *e, Facts &facts) {
  const bool isMethod = e->resolved == Callee::Method;
  const PouSymbol *block = isMethod ? e->pou->owner : e->pou;
  const bool isPlain =
      !isMethod || (e->callee->kind == ExprKind::Member && e->pou->decl->kind == DeclKind::Method);
  const Expr *object = isMethod && isPlain ? as<MemberExpr>(e->callee)->base : e->callee;
  if (!isPlain || !block->isBlock() || !standsAlone(block) || !isOwnPlace(object)) {
    facts.opaque = true;
    return;
  }
  expression(object, facts);
  arguments(e, facts);
  const Facts &inner = body(e->pou);
  facts.opaque = facts.opaque || inner.opaque;
  facts.follows = facts.follows || inner.follows;
  facts.foreign.insert(facts.foreign.end(), inner.foreign.begin(), inner.foreign.end());
  facts.indirect.insert(facts.indirect.end(), inner.indirect.begin(), inner.indirect.end());
  facts.called.insert(facts.called.end(), inner.called.begin(), inner.called.end());
  facts.called.push_back(block);
}

const LoopLocals::Facts &LoopLocals::body(const PouSymbol *pou) {
  const auto found = bodies_.find(pou);
  if (found != bodies_.end())
    return found->second;
  Facts unknown; // what calls itself
  unknown.opaque = true;
  bodies_.emplace(pou, unknown);
  Facts facts;
  if (!pou->checked)
    facts.opaque = true;
  else if (!pou->decl->external)
    block(pou->decl->body, facts);
  else // native functions on plain values compute, by agreement
    facts.opaque = !pou->isFunction();
  return bodies_[pou] = std::move(facts);
}

} // namespace stc::codegen
