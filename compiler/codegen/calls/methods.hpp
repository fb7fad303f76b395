#ifndef STRIDE_COMPILER_CODEGEN_CALLS_METHODS_HPP
#define STRIDE_COMPILER_CODEGEN_CALLS_METHODS_HPP
// Methods, properties, THIS and SUPER; instances as values and behind interfaces.

#include "compiler/codegen/context/context.hpp"
#include "compiler/codegen/cpp/part.hpp"

namespace stc::codegen {

/// `this`, or a pointer to its base part.
void emitSelf(EmitContext &cx, const SelfSymbol *symbol);
/// The instance is exactly of the expression's type, not of one that extends it.
[[nodiscard]] bool isExact(const ast::Expr *place);
/// `SUPER^`
[[nodiscard]] bool isSuper(const ast::Expr *place);
/// The type id field of the instance, after a `.`.
void emitTypeIdOf(EmitContext &cx, const ast::Expr *instance);
/// A place of a derived block as one of its base `type`.
void emitPlaceAs(EmitContext &cx, const ast::Expr *e, const Type *type);
/// A pointer to the place as one to its base `type`; null references stay null.
void emitAddressAs(EmitContext &cx, const ast::Expr *e, const Type *type);
/// The interface whose method is called; raises where it is 0.
void emitInterface(EmitContext &cx, const ast::Expr *object, Span span);
/// `this->Run(ctx__`, `m.base__.Run(ctx__`, `m.Run__call(ctx__`, `IShape__Area(ctx__, i`.
void openMethodCall(EmitContext &cx, const ast::Expr *object, const PouSymbol *method, Span span);
/// The instance in a call of a method; null: the block itself.
[[nodiscard]] const ast::Expr *objectOf(const ast::CallExpr *e);
/// Reading a property: `instance` is null inside of the block.
void emitPropertyGet(EmitContext &cx, const ast::Expr *instance, const PropertySymbol *property,
                     Span span);
/// The accessor that `property` names: its own, or the inherited half.
[[nodiscard]] const PouSymbol *accessorOf(const PropertySymbol *property, bool get);
/// `instance.Speed__set(ctx__, value);` with the value as `value` writes it.
void emitPropertySet(EmitContext &cx, const ast::Expr *target, Part value);
/// __QUERYINTERFACE, __QUERYPOINTER
void emitQuery(EmitContext &cx, const ast::CallExpr *e);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CALLS_METHODS_HPP
