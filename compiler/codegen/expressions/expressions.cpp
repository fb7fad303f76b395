#include "compiler/codegen/expressions/expressions.hpp"

#include "compiler/codegen/calls/builtin_calls.hpp"
#include "compiler/codegen/calls/calls.hpp"
#include "compiler/codegen/calls/instances.hpp"
#include "compiler/codegen/calls/methods.hpp"
#include "compiler/codegen/expressions/constants.hpp"
#include "compiler/codegen/expressions/conversions.hpp"
#include "compiler/codegen/expressions/operators.hpp"
#include "compiler/codegen/places/located.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

void emitCall(EmitContext &cx, const CallExpr *e) {
  if (e->resolved == Callee::Builtin) {
    emitBuiltin(cx, e);
    return;
  }
  const VarSymbol *result = e->pou->result;
  if (result == nullptr || result->type->kind != TypeKind::Reference) {
    emitFunctionCall(cx, e, false);
    return;
  }
  cx.includes.complete(e->type);
  emitFollowed(cx, Slot::Reference, e->span, [&] { emitFunctionCall(cx, e, false); });
}

/// A place's value.
void emitRead(EmitContext &cx, const Expr *e) {
  const bool byOthers = e->type->kind == TypeKind::Boolean && locationOf(e) != nullptr;
  const bool shared = cx.isShared(e);
  cx.out << (byOthers ? "::stride::truth(" : "") << (shared ? "::stride::load(" : "");
  emitPlace(cx, e);
  cx.out << (shared ? ")" : "") << (byOthers ? ")" : "");
}

} // namespace

void emitValue(EmitContext &cx, const Expr *e) {
  emitValueAs(cx, e, e->target != nullptr ? e->target : e->type);
}

void emitValueAs(EmitContext &cx, const Expr *e, const Type *type) {
  if (e->constant != nullptr) {
    emitLiteral(cx, e, type);
  } else if (isInstance(e->type) && type->kind == TypeKind::Interface) {
    cx.out << '&';
    emitTypeIdOf(cx, e);
  } else if ((isInstance(e->type) && isInstance(type)) ||
             (e->type == type && holdsInOut(type) && type->kind != TypeKind::OpenArray)) {
    emitCopy(cx, e, type);
  } else if (isString(type) ? e->type == type : isImplicitStore(cx, e->type, type)) {
    emitRaw(cx, e);
  } else {
    emitConvertedExpr(cx, e, e->type, type);
  }
}

void emitRaw(EmitContext &cx, const Expr *e) {
  e = shown(e);
  if (e->constant != nullptr)
    emitLiteral(cx, e, e->type);
  else if (isBitPlace(e) && !isBitField(e))
    emitBitValue(cx, e);
  else if (e->kind == ExprKind::Unary)
    emitUnary(cx, as<UnaryExpr>(e));
  else if (e->kind == ExprKind::Binary)
    emitBinary(cx, as<BinaryExpr>(e));
  else if (e->kind == ExprKind::Call)
    emitCall(cx, as<CallExpr>(e));
  else
    emitRead(cx, e);
}

void emitOperand(EmitContext &cx, const Expr *e, const Type *type, const Expr *other,
                 bool comparison) {
  if (type->kind == TypeKind::Interface)
    emitValueAs(cx, e, type);
  else if (e->constant != nullptr)
    emitLiteral(cx, e, type);
  else if (isImplicitOperand(e, type, other, comparison))
    emitRaw(cx, e);
  else
    emitConvertedExpr(cx, e, e->type, type);
}

void emitText(EmitContext &cx, const Expr *e) {
  if (e->constant == nullptr) {
    emitRaw(cx, e);
    return;
  }
  cx.out << "::stride::lit(";
  emitQuoted(cx, *e->constant, e->type->kind == TypeKind::Wstring);
  cx.out << ')';
}

} // namespace stc::codegen
