#ifndef STRIDE_COMPILER_CODEGEN_PLACES_PLACES_HPP
#define STRIDE_COMPILER_CODEGEN_PLACES_PLACES_HPP
// Places: variables, members, elements and what addresses lead to.

#include "compiler/codegen/context/context.hpp"
#include "compiler/codegen/cpp/part.hpp"

namespace stc::codegen {

/// What holds an address: a reference or pointer, or an in-out of an instance.
enum class Slot { Reference, InOut };

/// A variable (or element, field, bit base …) that can be assigned to.
void emitPlace(EmitContext &cx, const ast::Expr *e);
[[nodiscard]] std::string placeText(EmitContext &cx, const ast::Expr *e);
/// The place as something to be assigned to: `x`, or `::stride::shared(x)` when several tasks use
/// it. `place` is what emitPlace writes for it.
[[nodiscard]] std::string writableText(EmitContext &cx, const ast::Expr *e, std::string place);
[[nodiscard]] std::string writableText(EmitContext &cx, const ast::Expr *e);
/// A pointer to it; null references stay null.
void emitAddress(EmitContext &cx, const ast::Expr *e);
/// The slot of an in-out or a reference itself.
void emitSlot(EmitContext &cx, const ast::Expr *e);
/// A member itself, in its instance.
void emitMemberSlot(EmitContext &cx, const ast::MemberExpr *e);
/// What is stored under the variable's name.
void emitField(EmitContext &cx, const VarSymbol *v);
/// The descriptor that a VAR_IN_OUT of type ARRAY[*] is bound to.
void emitOpenArray(EmitContext &cx, const ast::Expr *e, const OpenArrayType *wanted);
/// What the address leads to that `address` writes.
void emitFollowed(EmitContext &cx, Slot slot, Span span, Part address);

/// What `from` returns is a value, and of a type whose methods may take its address.
[[nodiscard]] bool returnsBlock(const PouSymbol *from, const Type *type);
/// Such a value as a place.
void emitBlockResult(EmitContext &cx, const Type *type, Part value);

/// The in-out or reference that the expression names; null: it names none.
[[nodiscard]] const VarSymbol *indirectVariable(const ast::Expr *e);
/// The way to the field from a value of the type, through the bases that have it: `base__.`
[[nodiscard]] std::string basePath(const Type *base, const VarSymbol *field);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_PLACES_PLACES_HPP
