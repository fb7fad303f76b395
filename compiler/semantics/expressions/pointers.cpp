// Pointers and references: arithmetic in bytes, comparisons, conversions and what may be pointed
// to.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/calls/calls.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/internal.hpp"
#include "compiler/semantics/locations.hpp"

namespace stc::sema {

using namespace ast;

const Type *checkPointerArithmetic(Context &c, BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const Type *address = elementaryType(TypeKind::Ulint);
  const auto number = [](const Type *t) { return isInteger(t) || t->kind == TypeKind::AnyInteger; };
  const bool sum = expr->op == BinaryOp::Add;
  const bool difference = expr->op == BinaryOp::Subtract;
  const bool both = l->kind == TypeKind::Pointer && r->kind == TypeKind::Pointer;
  if (both && difference)
    return address; // operandType stays null: bytes between the two
  if (!both && (sum || (difference && l->kind == TypeKind::Pointer)) &&
      number(l->kind == TypeKind::Pointer ? r : l)) {
    Expr *offset = l->kind == TypeKind::Pointer ? expr->right : expr->left;
    if (offset->type->kind == TypeKind::AnyInteger)
      setTarget(offset, elementaryType(TypeKind::Lint));
    return l->kind == TypeKind::Pointer ? l : r;
  }
  if (both || sum || difference || !number(l->kind == TypeKind::Pointer ? r : l))
    return operatorError(c, expr);
  // An address as a number: `ADR(x) MOD 4`.
  expr->operandType = address;
  setTarget(expr->left, address);
  setTarget(expr->right, address);
  return address;
}

bool comparePointers(BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const auto comparable = [](const Type *t) {
    return t->kind == TypeKind::Pointer || isInteger(t) || t->kind == TypeKind::AnyInteger;
  };
  if (!comparable(l) || !comparable(r))
    return false;
  if (l == r) {
    expr->operandType = l;
    return true;
  }
  const bool zero = expr->right->constant != nullptr && expr->right->constant->integer == 0;
  if (l->kind == TypeKind::Pointer && zero) {
    expr->operandType = l;
    setTarget(expr->right, l);
    return true;
  }
  expr->operandType = elementaryType(TypeKind::Ulint);
  setTarget(expr->left, expr->operandType);
  setTarget(expr->right, expr->operandType);
  return true;
}

/// Warns where what a pointer points to would be read as another type.
static void checkPointee(Context &c, const Expr *expr, const Type *type,
                         const std::string &prefix) {
  const Type *from = expr->type;
  const Type *wanted = typeAs<PointerType>(type)->pointee;
  // The address of an array is that of its first element, too.
  const Type *first = typeAs<PointerType>(from)->pointee;
  while (first->kind == TypeKind::Array && first != wanted)
    first = typeAs<ArrayType>(first)->element;
  if (classify(from, type) == Conversion::Free || isByteView(wanted) ||
      isByteView(typeAs<PointerType>(from)->pointee) || first == wanted)
    return;
  auto &d = c.report(Code::PointerOfOtherType, expr->span,
                     prefix + "this is a " + typeName(from) + ", not a " + typeName(type),
                     "what it points to will be read as another type");
  d.help("declare the pointer as `" + typeName(from) +
         "`, or take the address as bytes with "
         "`POINTER TO BYTE`");
}

static void reportIntegerAsPointer(Context &c, const Expr *expr, const Type *type,
                                   const std::string &prefix) {
  auto &d = c.report(Code::PointerFromInteger, expr->span,
                     prefix + "a number becomes an address: " + typeName(expr->type) + " to " +
                         typeName(type),
                     "nothing says that there is a variable at this address");
  const std::string source(c.program.sources.text(expr->span));
  if (expr->type == typeAs<PointerType>(type)->pointee && expr->kind == ExprKind::Name)
    d.suggest("take the address of `" + source + "`: `ADR(" + source + ")`", expr->span,
              "ADR(" + source + ")");
  else
    d.help("keep the address in a variable of type `" + typeName(type) + "`");
}

/// `diff : DINT := p - q`: the distance of two places in one variable.
static bool isDistance(const Expr *expr) {
  return expr->kind == ExprKind::Binary && as<BinaryExpr>(expr)->op == BinaryOp::Subtract &&
         underlying(as<BinaryExpr>(expr)->left->type)->kind == TypeKind::Pointer &&
         expr->type->kind == TypeKind::Ulint;
}

bool coercePointer(Context &c, Expr *expr, const Type *type, std::string_view what) {
  const Type *from = expr->type;
  const bool toPointer = type->kind == TypeKind::Pointer;
  const bool fromPointer = from->kind == TypeKind::Pointer;
  const auto prefix = [what] { return what.empty() ? std::string() : std::string(what) + ": "; };
  const bool null = expr->constant != nullptr && expr->constant->integer == 0;
  const bool isAddress = (isInteger(underlying(from)) && (null || bitWidth(from) >= 32)) ||
                         from->kind == TypeKind::AnyInteger;
  if (toPointer && fromPointer) {
    checkPointee(c, expr, type, prefix());
  } else if (toPointer && isAddress) {
    if (!null)
      reportIntegerAsPointer(c, expr, type, prefix());
  } else if (fromPointer && isInteger(type) && bitWidth(type) >= 32) {
    if (bitWidth(type) == 32)
      c.report(Code::PointerAsInteger, expr->span,
               prefix() + "an address has 64 bits, " + typeName(type) + " has 32",
               "works while the application's memory lies below 4 GiB")
          .help("keep it in a `" + typeName(from) + "` or in a variable of type `__UXINT`");
  } else if (!(isInteger(type) && bitWidth(type) == 32 && isDistance(expr))) {
    return false;
  }
  setTarget(expr, type);
  return true;
}

/// The variable of REFERENCE type that the expression names, or null.
static VarSymbol *referenceVariable(Expr *expr) {
  Symbol *symbol = expr->kind == ExprKind::Name     ? as<NameExpr>(expr)->symbol
                   : expr->kind == ExprKind::Member ? as<MemberExpr>(expr)->symbol
                                                    : nullptr;
  auto *variable = symbol != nullptr && symbol->kind == SymbolKind::Variable
                       ? static_cast<VarSymbol *>(symbol)
                       : nullptr;
  return variable != nullptr && variable->type->kind == TypeKind::Reference ? variable : nullptr;
}

bool isReference(Expr *expr) {
  if (expr->kind == ExprKind::Index)
    return elementBeforeReference(as<IndexExpr>(expr))->kind == TypeKind::Reference;
  return referenceVariable(expr) != nullptr;
}

bool refersToNothing(Context &c, Expr *value, const Type *type) {
  const bool isZero =
      value->constant != nullptr && value->constant->integer == 0 &&
      (value->type->kind == TypeKind::AnyInteger || value->type->kind == TypeKind::Pointer);
  if (isZero)
    setTarget(value, c.types.pointer(type));
  return isZero;
}

void checkReferenceAssign(Context &c, AssignStmt *stmt) {
  Expr *last = stmt->targets.back();
  if (!isReference(last)) {
    if (!isError(last->type))
      c.report(Code::NotAReference, last->span,
               "only a REFERENCE can be set with REF=", "this is " + typeName(last->type));
    check(c, stmt->value);
    return;
  }
  const Type *value = check(c, stmt->value, last->type);
  if (isError(value))
    return;
  if (refersToNothing(c, stmt->value, last->type))
    return;
  const bool fromCall = givesReference(stmt->value);
  if (!fromCall && !requireVariable(c, stmt->value, "refer to"))
    return;
  const bool isBit = isBitPlace(stmt->value);
  if (isBit)
    c.report(Code::TypeMismatch, stmt->value->span, "a reference cannot stand for a single bit",
             "bits have no address");
  else if (!refersTo(value, last->type))
    c.report(Code::TypeMismatch, stmt->value->span,
             "expected " + typeName(last->type) + ", found " + typeName(value),
             "a reference needs a variable of exactly its type");
  else if (!fromCall)
    requireAligned(c, stmt->value, "refer to");
}

} // namespace stc::sema
