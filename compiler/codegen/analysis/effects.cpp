// What evaluating an expression, or finding a place, can do besides giving a value.

#include "compiler/codegen/analysis/analysis.hpp"

#include "compiler/codegen/cpp/layout.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

bool isNamespace(const Expr *expr) {
  const Symbol *symbol = nullptr;
  if (expr->kind == ExprKind::name)
    symbol = as<NameExpr>(expr)->symbol;
  else if (expr->kind == ExprKind::member)
    symbol = as<MemberExpr>(expr)->symbol;
  if (symbol == nullptr)
    return false;
  return symbol->kind == SymbolKind::library || symbol->kind == SymbolKind::globals ||
         symbol->kind == SymbolKind::type || symbol->kind == SymbolKind::space;
}

const VarSymbol *namedVariable(const Expr *expr) {
  const Symbol *symbol = nullptr;
  if (expr->kind == ExprKind::name)
    symbol = as<NameExpr>(expr)->symbol;
  else if (expr->kind == ExprKind::member && isNamespace(as<MemberExpr>(expr)->base))
    symbol = as<MemberExpr>(expr)->symbol;
  return symbol != nullptr && symbol->kind == SymbolKind::variable
             ? static_cast<const VarSymbol *>(symbol)
             : nullptr;
}

bool followsAddress(const IndexExpr *e) {
  const Type *t = e->base->type;
  for (std::size_t i = 0; i < e->indices.size() && t != nullptr; ++i) {
    if (t->kind == TypeKind::pointer || t->kind == TypeKind::reference)
      return true;
    t = indexStep(t);
  }
  return t == nullptr || t->kind == TypeKind::reference;
}

const Symbol *symbolAt(const Expr *place) {
  return place->kind == ExprKind::name     ? as<NameExpr>(place)->symbol
         : place->kind == ExprKind::member ? as<MemberExpr>(place)->symbol
                                           : nullptr;
}

const PropertySymbol *writtenProperty(const Expr *target) {
  const Symbol *symbol = symbolAt(target);
  if (symbol == nullptr || symbol->kind != SymbolKind::property)
    return nullptr;
  const auto *property = static_cast<const PropertySymbol *>(symbol);
  return property->type->kind == TypeKind::reference ? nullptr : property;
}

const Expr *containerOf(const Expr *place) {
  while (place->kind == ExprKind::member && !isNamespace(as<MemberExpr>(place)->base)) {
    const Symbol *symbol = as<MemberExpr>(place)->symbol;
    const bool isField = symbol == nullptr || // a bit or part
                         (symbol->kind == SymbolKind::variable &&
                          !isIndirect(static_cast<const VarSymbol *>(symbol)));
    if (!isField && as<MemberExpr>(place)->bit < 0)
      break;
    place = as<MemberExpr>(place)->base;
  }
  return place;
}

namespace {

/// `^` of THIS or SUPER: always the same place, never null.
bool isSelf(const Expr *pointer) {
  const Symbol *symbol = symbolAt(pointer);
  return symbol != nullptr && symbol->kind == SymbolKind::self;
}

/// Reading the variable goes through a slot that holds an address.
bool followsSlot(const Symbol *symbol) {
  return symbol != nullptr && symbol->kind == SymbolKind::variable &&
         isIndirect(static_cast<const VarSymbol *>(symbol));
}

/// The in-out of the function, method or body whose code it is: the same place as long as the call
/// lasts.
bool isFixed(const VarSymbol *variable, const PouSymbol *body) {
  return variable->section == Section::inOut && variable->owner == body;
}

} // namespace

unsigned Analysis::checkedBy(ImplicitCheck first, ImplicitCheck last) {
  if (!checks_)
    return effectNone;
  for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
    if (ownChecks_[i] != nullptr && !pure(ownChecks_[i]))
      return effectReads | effectRaises | effectCalls;
  }
  return effectNone;
}

/// A pointer or reference is followed.
unsigned Analysis::following() {
  return effectReads | effectStrays | (checks_ ? effectRaises : effectNone) |
         checkedBy(ImplicitCheck::pointer, ImplicitCheck::pointer);
}

unsigned Analysis::indexing(const IndexExpr *e) {
  unsigned result = effectNone;
  const Type *array = e->base->type;
  for (const Expr *i : e->indices) {
    if (array->kind == TypeKind::pointer || array->kind == TypeKind::reference)
      result |= following();
    if (array->kind != TypeKind::array || !provenIndex(i, typeAs<ArrayType>(array)))
      result |= effectStrays | (checks_ ? effectRaises : effectNone) | effects(i) |
                checkedBy(ImplicitCheck::bounds, ImplicitCheck::bounds);
    array = indexStep(array);
  }
  return array != nullptr && array->kind == TypeKind::reference ? result | following() : result;
}

unsigned Analysis::dividing(const BinaryExpr *e) {
  if ((e->op != BinaryOp::divide && e->op != BinaryOp::modulo) || e->right->constant != nullptr)
    return effectNone;
  if (e->operandType == nullptr) // a duration by a number
    return isReal(underlying(e->right->type)) ? effectNone : effectRaises;
  const unsigned own = checkedBy(ImplicitCheck::divByte, ImplicitCheck::divLreal);
  return isReal(e->operandType) ? own : own | effectRaises;
}

unsigned Analysis::calling(const CallExpr *e) {
  unsigned result = effectNone;
  for (const Argument &a : e->arguments) {
    if (a.value != nullptr)
      result |= effects(a.value);
  }
  if (e->resolved == Callee::builtin) {
    if (e->builtin == Builtin::mux)
      result |= effectRaises;
    if (e->builtin == Builtin::queryInterface || e->builtin == Builtin::queryPointer)
      result |= effectReads | effectCalls; // they assign to their second argument
    if (e->builtin == Builtin::newT || e->builtin == Builtin::deleteT ||
        e->builtin == Builtin::ini || isAssertion(e->builtin))
      return result | effectReads | effectRaises | effectCalls;
    return result |
           (e->builtin == Builtin::time || e->builtin == Builtin::ltime ? effectReads : effectNone);
  }
  result |= effectReads | effectRaises;
  if (e->resolved != Callee::function || !pure(e->pou))
    result |= effectCalls;
  return result;
}

unsigned Analysis::effects(const Expr *expr) {
  if (expr->constant != nullptr)
    return effectNone;
  unsigned result = effectNone;
  if (checks_ && expr->target != nullptr && expr->target->kind == TypeKind::subrange &&
      expr->type != expr->target)
    result = effectRaises | checkedBy(ImplicitCheck::rangeSigned, ImplicitCheck::rangeLongUnsigned);
  switch (expr->kind) {
  case ExprKind::literal:
  case ExprKind::enumLiteral:
  case ExprKind::typeName:
  case ExprKind::error:
  case ExprKind::aggregate: // an initial value only
    return result;
  case ExprKind::direct:
    return result | effectReads;
  case ExprKind::name:
  case ExprKind::member: {
    const Symbol *symbol = symbolAt(expr);
    result |= effectReads;
    if (symbol != nullptr && symbol->kind == SymbolKind::property)
      result |= effectRaises | effectCalls;
    if (followsSlot(symbol))
      result |= effectStrays | (checks_ ? effectRaises : effectNone);
    const bool ends = expr->kind == ExprKind::name || isNamespace(as<MemberExpr>(expr)->base);
    return ends ? result : result | effects(as<MemberExpr>(expr)->base);
  }
  case ExprKind::index:
    return result | effectReads | indexing(as<IndexExpr>(expr)) |
           effects(as<IndexExpr>(expr)->base);
  case ExprKind::deref:
    return result | following() | effects(as<DerefExpr>(expr)->base);
  case ExprKind::unary:
    return result | effects(as<UnaryExpr>(expr)->operand);
  case ExprKind::binary: {
    // Sums of thousands of terms lean to the left: they are walked, not descended into.
    const Expr *left = expr;
    while (left->kind == ExprKind::binary && left->constant == nullptr &&
           (left == expr || left->target == nullptr || left->target->kind != TypeKind::subrange)) {
      const auto *binary = as<BinaryExpr>(left);
      result |= dividing(binary) | effects(binary->right);
      left = binary->left;
    }
    return result | effects(left);
  }
  case ExprKind::call:
    return result | calling(as<CallExpr>(expr));
  }
  return result;
}

unsigned Analysis::placeEffects(const Expr *place, const PouSymbol *body) {
  switch (place->kind) {
  case ExprKind::direct:
    return effectNone;
  case ExprKind::name:
  case ExprKind::member: {
    const bool ends = place->kind == ExprKind::name || isNamespace(as<MemberExpr>(place)->base);
    const Expr *base = ends ? nullptr : as<MemberExpr>(place)->base;
    const Symbol *symbol = symbolAt(place);
    if (symbol != nullptr && symbol->kind == SymbolKind::property)
      return effects(place);
    unsigned result = base == nullptr ? effectNone : placeEffects(base, body);
    if (followsSlot(symbol) && !isFixed(static_cast<const VarSymbol *>(symbol), body))
      result |= effectReads | effectStrays | (checks_ ? effectRaises : effectNone);
    return result;
  }
  case ExprKind::index: {
    const auto *index = as<IndexExpr>(place);
    const bool points = index->base->type->kind == TypeKind::pointer;
    return indexing(index) | (points ? effects(index->base) : placeEffects(index->base, body));
  }
  case ExprKind::deref: {
    const Expr *pointer = as<DerefExpr>(place)->base;
    return isSelf(pointer) ? unsigned{effectNone} : following() | effects(pointer);
  }
  default:
    return effects(place);
  }
}

unsigned Analysis::targetEffects(const Expr *target, const PouSymbol *body) {
  if (writtenProperty(target) == nullptr)
    return placeEffects(target, body);
  const bool isOwn = target->kind == ExprKind::name || isNamespace(as<MemberExpr>(target)->base);
  return isOwn ? unsigned{effectNone} : objectEffects(as<MemberExpr>(target)->base, body);
}

unsigned Analysis::objectEffects(const Expr *object, const PouSymbol *body) {
  if (object->type != nullptr && object->type->kind == TypeKind::interface)
    return effects(object) | effectStrays | (checks_ ? effectRaises : effectNone);
  return placeEffects(object, body);
}

} // namespace stc::codegen
