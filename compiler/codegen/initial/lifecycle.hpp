#ifndef STRIDE_COMPILER_CODEGEN_INITIAL_LIFECYCLE_HPP
#define STRIDE_COMPILER_CODEGEN_INITIAL_LIFECYCLE_HPP
// FB_Init, FB_Exit and FB_Reinit of instances.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// FB_Init of what a variable is declared as, with the inputs that its declaration gives.
void construct(EmitContext &cx, std::string_view target, const VarSymbol *variable);
/// FB_Init of instances that come without a declaration of their own.
void constructPlain(EmitContext &cx, std::string_view target, const Type *type);
/// The same with arguments: those that have a `parameter` are for FB_Init.
void constructWith(EmitContext &cx, std::string_view target, const Type *type,
                   std::span<const ast::Argument> arguments);
/// {attribute 'call_after_init'}
void callAfterInit(EmitContext &cx, std::string_view target, const Type *type);
/// FB_Exit of a local variable, at the end of the call.
void exitAtEnd(EmitContext &cx, const VarSymbol *variable);
/// The inside of exit__ or reinit__ (`what` is fb_exit, fb_reinit) of something that holds the
/// variables; `base` of a structure is walked by itself, `block` together with its bases.
void emitLifecycle(EmitContext &cx, const std::vector<const VarSymbol *> &variables,
                   std::string_view what, const Type *base, const PouSymbol *block);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_INITIAL_LIFECYCLE_HPP
