#ifndef STRIDE_COMPILER_SEMANTICS_CLASSES_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_CLASSES_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// FB_Init, FB_Exit, FB_Reinit: run by themselves, base and derived; they replace nothing.
[[nodiscard]] bool isLifecycle(const PouSymbol *method);
/// `METHOD Area : LREAL (VAR_INPUT scale : LREAL)`
[[nodiscard]] std::string signatureText(const PouSymbol *method);
/// One can stand for the other: parameters and result are the same, in the same order.
[[nodiscard]] bool sameSignature(const PouSymbol *a, const PouSymbol *b);
/// `Block.Method`
[[nodiscard]] std::string memberName(const PouSymbol *method);
/// Reports bases of an interface that demand one method in two ways.
void checkInterfaceBases(Context &c, PouSymbol *pou);
/// Reports what a block lacks of its interfaces.
void checkInterfaces(Context &c, PouSymbol *pou);
/// Reports inherited abstract methods that a block does not implement.
void checkAbstractMethods(Context &c, PouSymbol *pou);
/// The abstract methods an instance would have, `` `a`, `b` ``; also what interfaces of abstract
/// bases demand.
std::string missingMethods(const PouSymbol *pou);
/// Reports FB_Init, FB_Exit and FB_Reinit with wrong parameters.
void checkLifecycle(Context &c, PouSymbol *method);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_CLASSES_INTERNAL_HPP
