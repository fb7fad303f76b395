#ifndef STRIDE_COMPILER_CODEGEN_PLACES_OWN_CHECKS_HPP
#define STRIDE_COMPILER_CODEGEN_PLACES_OWN_CHECKS_HPP
// Checks that the project replaces by functions of its own: CheckBounds, CheckDivInt …

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// The project's own function for the check, if it has one that is to be called here.
[[nodiscard]] const PouSymbol *ownCheck(EmitContext &cx, ImplicitCheck check);
/// Writes the begin of a call of the project's own check; false: there is none.
[[nodiscard]] bool openRangeCheck(EmitContext &cx, const SubrangeType *range);
[[nodiscard]] bool openDivisorCheck(EmitContext &cx, const ast::BinaryExpr *e);
/// An index on its way into `array`, through CheckBounds.
void emitCheckedIndex(EmitContext &cx, const ast::Expr *index, const ArrayType *array);
/// A pointer on its way to being followed, through CheckPointer.
void emitCheckedPointer(EmitContext &cx, const ast::Expr *pointer);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_PLACES_OWN_CHECKS_HPP
