#ifndef STRIDE_COMPILER_CODEGEN_PLACES_LOCATED_HPP
#define STRIDE_COMPILER_CODEGEN_PLACES_LOCATED_HPP
// Places that are no plain C++ variables: the process image, bits and parts.

#include "compiler/codegen/context/context.hpp"
#include "compiler/codegen/cpp/part.hpp"

namespace stc::codegen {

/// A variable in the process image; `slot` writes what holds its place.
void emitLocated(EmitContext &cx, const Location &at, const Type *type, Part slot);
/// The value of a bit or part (isBitPlace).
void emitBitValue(EmitContext &cx, const ast::Expr *e);
/// Stores what `value` writes in it.
void emitBitStore(EmitContext &cx, const ast::Expr *e, Part value);
/// Brings zeroed memory to the variable's default; `target` is what holds its place.
void initLocated(EmitContext &cx, std::string_view target, const VarSymbol *variable);
/// Gives what VAR_CONFIG says of a variable: its initial value.
void initConfigured(EmitContext &cx, const SlotPlace &entry);

/// In an assignment of a whole structure: the value at the place of `from`'s field `v` goes to the
/// place of `this`'s. Atomic, as nobody looks who else uses the places.
void copyPlaced(EmitContext &cx, const VarSymbol *v);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_PLACES_LOCATED_HPP
