// What evaluating an expression, or finding a place, can do besides giving a value.

#include "compiler/codegen/analysis/analysis.hpp"

#include "compiler/codegen/cpp/layout.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

bool isScalar(const Type *type) {
  const Type *t = underlying(type);
  return t->kind == TypeKind::Boolean || isInteger(t) || isReal(t) || isTimeOrDate(t);
}

bool isNamespace(const Expr *expr) {
  const Symbol *symbol = nullptr;
  if (expr->kind == ExprKind::Name)
    symbol = as<NameExpr>(expr)->symbol;
  else if (expr->kind == ExprKind::Member)
    symbol = as<MemberExpr>(expr)->symbol;
  if (symbol == nullptr)
    return false;
  return symbol->kind == SymbolKind::Library || symbol->kind == SymbolKind::Globals ||
         symbol->kind == SymbolKind::Type || symbol->kind == SymbolKind::Space;
}

const VarSymbol *namedVariable(const Expr *expr) {
  const Symbol *symbol = nullptr;
  if (expr->kind == ExprKind::Name)
    symbol = as<NameExpr>(expr)->symbol;
  else if (expr->kind == ExprKind::Member && isNamespace(as<MemberExpr>(expr)->base))
    symbol = as<MemberExpr>(expr)->symbol;
  return symbol != nullptr && symbol->kind == SymbolKind::Variable
             ? static_cast<const VarSymbol *>(symbol)
             : nullptr;
}

bool followsAddress(const IndexExpr *e) {
  const Type *t = e->base->type;
  for (size_t i = 0; i < e->indices.size() && t != nullptr; ++i) {
    if (t->kind == TypeKind::Pointer || t->kind == TypeKind::Reference)
      return true;
    t = indexStep(t);
  }
  return t == nullptr || t->kind == TypeKind::Reference;
}

const Symbol *symbolAt(const Expr *place) {
  return place->kind == ExprKind::Name     ? as<NameExpr>(place)->symbol
         : place->kind == ExprKind::Member ? as<MemberExpr>(place)->symbol
                                           : nullptr;
}

const PropertySymbol *writtenProperty(const Expr *target) {
  const Symbol *symbol = symbolAt(target);
  if (symbol == nullptr || symbol->kind != SymbolKind::Property)
    return nullptr;
  const auto *property = static_cast<const PropertySymbol *>(symbol);
  return property->type->kind == TypeKind::Reference ? nullptr : property;
}

const Expr *containerOf(const Expr *place) {
  while (place->kind == ExprKind::Member && !isNamespace(as<MemberExpr>(place)->base)) {
    const Symbol *symbol = as<MemberExpr>(place)->symbol;
    const bool isField = symbol == nullptr || // a bit or part
                         (symbol->kind == SymbolKind::Variable &&
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
  return symbol != nullptr && symbol->kind == SymbolKind::Self;
}

/// The in-out of the function, method or body whose code it is: the same place as long as the call
/// lasts.
bool isFixed(const VarSymbol *variable, const PouSymbol *body) {
  return variable->section == Section::InOut && variable->owner == body;
}

} // namespace

/// Reading the variable goes through a slot that holds an address, perhaps none.
bool Analysis::followsSlot(const Symbol *symbol) const {
  if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
    return false;
  const auto *v = static_cast<const VarSymbol *>(symbol);
  return isIndirect(v) && (bound_ == nullptr || !isFixed(v, bound_));
}

unsigned Analysis::checkedBy(ImplicitCheck first, ImplicitCheck last) {
  if (!checks_)
    return kEffectNone;
  for (auto i = static_cast<size_t>(first); i <= static_cast<size_t>(last); ++i) {
    if (ownChecks_[i] != nullptr && !pure(ownChecks_[i]))
      return kEffectReads | kEffectRaises | kEffectCalls;
  }
  return kEffectNone;
}

/// A pointer or reference is followed.
unsigned Analysis::following() {
  return kEffectReads | kEffectStrays | (checks_ ? kEffectRaises : kEffectNone) |
         checkedBy(ImplicitCheck::Pointer, ImplicitCheck::Pointer);
}

unsigned Analysis::indexing(const IndexExpr *e) {
  unsigned result = kEffectNone;
  const Type *array = e->base->type;
  for (const Expr *i : e->indices) {
    if (array->kind == TypeKind::Pointer || array->kind == TypeKind::Reference)
      result |= following();
    if (array->kind != TypeKind::Array || !provenIndex(i, typeAs<ArrayType>(array)))
      result |= kEffectStrays | (checks_ ? kEffectRaises : kEffectNone) | effects(i) |
                checkedBy(ImplicitCheck::Bounds, ImplicitCheck::Bounds);
    array = indexStep(array);
  }
  return array != nullptr && array->kind == TypeKind::Reference ? result | following() : result;
}

unsigned Analysis::dividing(const BinaryExpr *e) {
  if ((e->op != BinaryOp::Divide && e->op != BinaryOp::Modulo) || e->right->constant != nullptr)
    return kEffectNone;
  if (e->operandType == nullptr) // a duration by a number
    return isReal(underlying(e->right->type)) ? kEffectNone : kEffectRaises;
  const unsigned own = checkedBy(ImplicitCheck::DivByte, ImplicitCheck::DivLreal);
  return isReal(e->operandType) ? own : own | kEffectRaises;
}

/// Besides those of the arguments.
static unsigned effectsOf(const BuiltinRow &row) {
  return ((row.does & BuiltinRow::kReads) != 0 ? kEffectReads : kEffectNone) |
         ((row.does & BuiltinRow::kRaises) != 0 ? kEffectRaises : kEffectNone) |
         ((row.does & BuiltinRow::kCalls) != 0 ? kEffectCalls : kEffectNone);
}

unsigned Analysis::calling(const CallExpr *e) {
  unsigned result = kEffectNone;
  for (const Argument &a : e->arguments) {
    if (a.value != nullptr)
      result |= effects(a.value);
  }
  if (e->resolved == Callee::Builtin)
    return result | effectsOf(builtinRow(e->builtin));
  result |= kEffectReads | kEffectRaises;
  if (e->resolved != Callee::Function || !pure(e->pou))
    result |= kEffectCalls;
  return result;
}

unsigned Analysis::effects(const Expr *expr) {
  if (expr->constant != nullptr)
    return kEffectNone;
  unsigned result = kEffectNone;
  if (checks_ && expr->target != nullptr && expr->target->kind == TypeKind::Subrange &&
      expr->type != expr->target)
    result =
        kEffectRaises | checkedBy(ImplicitCheck::RangeSigned, ImplicitCheck::RangeLongUnsigned);
  switch (expr->kind) {
  case ExprKind::Literal:
  case ExprKind::EnumLiteral:
  case ExprKind::TypeName:
  case ExprKind::Error:
  case ExprKind::Aggregate: // an initial value only
    return result;
  case ExprKind::Direct:
    return result | kEffectReads;
  case ExprKind::Name:
  case ExprKind::Member: {
    const Symbol *symbol = symbolAt(expr);
    result |= kEffectReads;
    if (symbol != nullptr && symbol->kind == SymbolKind::Property)
      result |= kEffectRaises | kEffectCalls;
    if (followsSlot(symbol))
      result |= kEffectStrays | (checks_ ? kEffectRaises : kEffectNone);
    const bool ends = expr->kind == ExprKind::Name || isNamespace(as<MemberExpr>(expr)->base);
    return ends ? result : result | effects(as<MemberExpr>(expr)->base);
  }
  case ExprKind::Index:
    return result | kEffectReads | indexing(as<IndexExpr>(expr)) |
           effects(as<IndexExpr>(expr)->base);
  case ExprKind::Deref:
    return result | following() | effects(as<DerefExpr>(expr)->base);
  case ExprKind::Unary:
    return result | effects(as<UnaryExpr>(expr)->operand);
  case ExprKind::Binary: {
    // Sums of thousands of terms lean to the left: they are walked, not descended into.
    const Expr *left = expr;
    while (left->kind == ExprKind::Binary && left->constant == nullptr &&
           (left == expr || left->target == nullptr || left->target->kind != TypeKind::Subrange)) {
      const auto *binary = as<BinaryExpr>(left);
      result |= dividing(binary) | effects(binary->right);
      left = binary->left;
    }
    return result | effects(left);
  }
  case ExprKind::Call:
    return result | calling(as<CallExpr>(expr));
  }
  return result;
}

unsigned Analysis::placeEffects(const Expr *place, const PouSymbol *body) {
  switch (place->kind) {
  case ExprKind::Direct:
    return kEffectNone;
  case ExprKind::Name:
  case ExprKind::Member: {
    const bool ends = place->kind == ExprKind::Name || isNamespace(as<MemberExpr>(place)->base);
    const Expr *base = ends ? nullptr : as<MemberExpr>(place)->base;
    const Symbol *symbol = symbolAt(place);
    if (symbol != nullptr && symbol->kind == SymbolKind::Property)
      return effects(place);
    unsigned result = base == nullptr ? kEffectNone : placeEffects(base, body);
    if (followsSlot(symbol) && !isFixed(static_cast<const VarSymbol *>(symbol), body))
      result |= kEffectReads | kEffectStrays | (checks_ ? kEffectRaises : kEffectNone);
    return result;
  }
  case ExprKind::Index: {
    const auto *index = as<IndexExpr>(place);
    const bool points = index->base->type->kind == TypeKind::Pointer;
    return indexing(index) | (points ? effects(index->base) : placeEffects(index->base, body));
  }
  case ExprKind::Deref: {
    const Expr *pointer = as<DerefExpr>(place)->base;
    return isSelf(pointer) ? unsigned{kEffectNone} : following() | effects(pointer);
  }
  default:
    return effects(place);
  }
}

unsigned Analysis::targetEffects(const Expr *target, const PouSymbol *body) {
  if (writtenProperty(target) == nullptr)
    return placeEffects(target, body);
  const bool isOwn = target->kind == ExprKind::Name || isNamespace(as<MemberExpr>(target)->base);
  return isOwn ? unsigned{kEffectNone} : objectEffects(as<MemberExpr>(target)->base, body);
}

unsigned Analysis::objectEffects(const Expr *object, const PouSymbol *body) {
  if (object->type != nullptr && object->type->kind == TypeKind::Interface)
    return effects(object) | kEffectStrays | (checks_ ? kEffectRaises : kEffectNone);
  return placeEffects(object, body);
}

} // namespace stc::codegen
