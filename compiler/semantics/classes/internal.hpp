#pragma once
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// FB_Init, FB_Exit, FB_Reinit: run by themselves, base and derived; they replace nothing.
[[nodiscard]] bool isLifecycle(const PouSymbol *method);
/// `METHOD Area : LREAL (VAR_INPUT scale : LREAL)`
[[nodiscard]] std::string signatureText(const PouSymbol *method);
[[nodiscard]] bool sameSignature(const PouSymbol *a, const PouSymbol *b);
[[nodiscard]] std::string memberName(const PouSymbol *method);
void checkInterfaceBases(Context &c, PouSymbol *pou);
void checkInterfaces(Context &c, PouSymbol *pou);
void checkAbstractMethods(Context &c, PouSymbol *pou);
/// The abstract methods an instance would have, `` `a`, `b` ``; also what interfaces of abstract
/// bases demand.
std::string missingMethods(const PouSymbol *pou);
void checkLifecycle(Context &c, PouSymbol *method);

} // namespace stc::sema
