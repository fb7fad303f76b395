#include "compiler/codegen/loop_locals.hpp"

#include "compiler/codegen/layout.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// Values that fit a register. Texts and aggregates stay where they are.
bool isScalar(const Type *type) {
  const Type *t = underlying(type);
  return t->kind == TypeKind::boolean || isInteger(t) || isReal(t) || isTimeOrDate(t);
}

/// Copying it copies variables of blocks.
bool holdsInstance(const Type *type) {
  switch (type->kind) {
  case TypeKind::array:
    return holdsInstance(typeAs<ArrayType>(type)->element);
  case TypeKind::structure: {
    for (const auto *s = typeAs<StructType>(type); s != nullptr; s = s->base) {
      for (const VarSymbol *field : s->fields) {
        if (holdsInstance(field->type))
          return true;
      }
    }
    return false;
  }
  default:
    return !isElementary(type);
  }
}

/// Builtins that look at the values of their arguments only.
bool onlyComputes(Builtin id) {
  return id <= Builtin::find || id == Builtin::convert || id == Builtin::time ||
         id == Builtin::sizeofT || id == Builtin::lowerBound || id == Builtin::upperBound;
}

template <class T> bool contains(const std::vector<T> &all, T one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

} // namespace

std::vector<const VarSymbol *> LoopLocals::of(const Stmt *loop, const PouSymbol *pou) {
  if (pou == nullptr ||
      (pou->decl->kind != DeclKind::program && pou->decl->kind != DeclKind::functionBlock))
    return {}; // a function's variables are C++ locals anyway
  Facts facts;
  statement(loop, facts);
  if (facts.opaque)
    return {};
  std::vector<const VarSymbol *> result;
  for (const VarSymbol *v : facts.written) {
    const bool member = v->section == Section::local || v->section == Section::input ||
                        v->section == Section::output;
    if (v->owner != pou || !member || v->isConstant || v->decl == nullptr ||
        v->decl->address != nullptr || v->isBit || !isScalar(v->type) || contains(result, v) ||
        contains<const Symbol *>(facts.foreign, v) || contains(facts.indirect, underlying(v->type)))
      continue;
    result.push_back(v);
  }
  return result;
}

void LoopLocals::block(Block block, Facts &facts) {
  for (const Stmt *s : block) {
    if (facts.opaque)
      return;
    statement(s, facts);
  }
}

void LoopLocals::statement(const Stmt *s, Facts &facts) {
  switch (s->kind) {
  case StmtKind::empty:
  case StmtKind::exit:
  case StmtKind::continueS:
  case StmtKind::returnS:
    return;
  case StmtKind::assign: {
    const auto *a = as<AssignStmt>(s);
    if (a->op == AssignOp::reference) {
      facts.opaque = true;
      return;
    }
    for (const Expr *t : a->targets)
      target(t, facts);
    expression(a->value, facts);
    return;
  }
  case StmtKind::ifS: {
    const auto *i = as<IfStmt>(s);
    for (const IfBranch &b : i->branches) {
      expression(b.condition, facts);
      block(b.body, facts);
    }
    block(i->elseBody, facts);
    return;
  }
  case StmtKind::caseS: {
    const auto *c = as<CaseStmt>(s);
    expression(c->selector, facts);
    for (const CaseBranch &b : c->branches)
      block(b.body, facts);
    block(c->elseBody, facts);
    return;
  }
  case StmtKind::forS: {
    const auto *f = as<ForStmt>(s);
    target(f->variable, facts);
    expression(f->from, facts);
    expression(f->to, facts);
    if (f->by != nullptr)
      expression(f->by, facts);
    block(f->body, facts);
    return;
  }
  case StmtKind::whileS:
    expression(as<WhileStmt>(s)->condition, facts);
    block(as<WhileStmt>(s)->body, facts);
    return;
  case StmtKind::repeatS:
    block(as<RepeatStmt>(s)->body, facts);
    expression(as<RepeatStmt>(s)->until, facts);
    return;
  default: // calls of blocks, jumps, __TRY
    facts.opaque = true;
    return;
  }
}

void LoopLocals::target(const Expr *expr, Facts &facts) {
  if (holdsInstance(expr->type)) {
    facts.opaque = true;
    return;
  }
  const Expr *whole = expr;
  if (whole->kind == ExprKind::member && as<MemberExpr>(whole)->bit >= 0)
    whole = as<MemberExpr>(whole)->base;
  if (whole->kind == ExprKind::name) {
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
  if (symbol->kind != SymbolKind::variable) {
    facts.opaque = facts.opaque || symbol->kind != SymbolKind::enumerator;
    return;
  }
  const auto *v = static_cast<const VarSymbol *>(symbol);
  if (isIndirect(v)) {
    const Type *pointee =
        v->type->kind == TypeKind::reference ? typeAs<PointerType>(v->type)->pointee : v->type;
    facts.indirect.push_back(underlying(pointee));
  }
}

void LoopLocals::expression(const Expr *e, Facts &facts) {
  while (!facts.opaque) {
    if (e->constant != nullptr)
      return;
    if (holdsInstance(e->type) && e->kind != ExprKind::name && e->kind != ExprKind::member &&
        e->kind != ExprKind::index) {
      facts.opaque = true;
      return;
    }
    switch (e->kind) {
    case ExprKind::literal:
    case ExprKind::enumLiteral:
      return;
    case ExprKind::name:
      name(as<NameExpr>(e)->symbol, facts);
      return;
    case ExprKind::member: {
      const auto *m = as<MemberExpr>(e);
      if (m->symbol == nullptr) {
        facts.opaque = facts.opaque || m->bit < 0;
      } else {
        name(m->symbol, facts);
        facts.foreign.push_back(m->symbol);
      }
      if (isNamespace(m->base))
        return;
      // A program in front of the dot is a place, too.
      if (m->base->kind == ExprKind::name) {
        const Symbol *base = as<NameExpr>(m->base)->symbol;
        if (base != nullptr && base->kind == SymbolKind::pou)
          return;
      }
      e = m->base;
      continue;
    }
    case ExprKind::index: {
      const auto *i = as<IndexExpr>(e);
      facts.opaque = facts.opaque || followsAddress(i);
      for (const Expr *x : i->indices)
        expression(x, facts);
      e = i->base;
      continue;
    }
    case ExprKind::unary:
      e = as<UnaryExpr>(e)->operand;
      continue;
    case ExprKind::binary:
      expression(as<BinaryExpr>(e)->right, facts);
      e = as<BinaryExpr>(e)->left;
      continue;
    case ExprKind::call:
      call(as<CallExpr>(e), facts);
      return;
    default: // pointers, direct addresses
      facts.opaque = true;
      return;
    }
  }
}

void LoopLocals::call(const CallExpr *e, Facts &facts) {
  const bool isFunction = e->resolved == Callee::function && analysis_.pure(e->pou);
  if (!isFunction && (e->resolved != Callee::builtin || !onlyComputes(e->builtin))) {
    facts.opaque = true;
    return;
  }
  if (!isFunction && e->builtin == Builtin::sizeofT)
    return;
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr)
      continue;
    if (holdsInstance(a.value->type))
      facts.opaque = true;
    expression(a.value, facts);
  }
  if (!isFunction)
    return;
  const Facts &inner = function(e->pou);
  facts.opaque = facts.opaque || inner.opaque;
  facts.foreign.insert(facts.foreign.end(), inner.foreign.begin(), inner.foreign.end());
}

/// A pure function writes its own variables only; what counts is which others it reads.
const LoopLocals::Facts &LoopLocals::function(const PouSymbol *function) {
  const auto found = functions_.find(function);
  if (found != functions_.end())
    return found->second;
  Facts facts;
  if (!function->decl->external)
    block(function->decl->body, facts);
  return functions_.emplace(function, std::move(facts)).first->second;
}

} // namespace stc::codegen
