#ifndef STRIDE_COMPILER_SEMANTICS_HIERARCHY_HPP
#define STRIDE_COMPILER_SEMANTICS_HIERARCHY_HPP
// Questions about EXTENDS and IMPLEMENTS, for the checker and the code generator.

#include "compiler/semantics/symbols.hpp"

#include <vector>

namespace stc {

/// The block, program or interface that code belongs to: a method's owner, else itself.
[[nodiscard]] inline PouSymbol *blockOf(PouSymbol *pou) {
  return pou->owner != nullptr ? pou->owner : pou;
}
[[nodiscard]] inline const PouSymbol *blockOf(const PouSymbol *pou) {
  return pou->owner != nullptr ? pou->owner : pou;
}

/// `pou` is `base`, or extends it at any depth (interfaces: through any of several).
[[nodiscard]] bool derivesFrom(const PouSymbol *pou, const PouSymbol *base);
/// `pou` or one of its bases implements `interface` or one that extends it.
[[nodiscard]] bool implements(const PouSymbol *pou, const PouSymbol *interface);
/// `from` may be used where `to` is expected: a derived block for its base, an implementing block
/// or derived interface for an interface.
[[nodiscard]] bool convertsTo(const PouSymbol *from, const PouSymbol *to);

/// The block, program or interface, or one that it extends or implements, may have more members
/// than are known, for something of its head is wrong (reported).
[[nodiscard]] bool isIncomplete(const PouSymbol *pou);

/// The code belongs to the block, or to one that extends it.
[[nodiscard]] bool isInside(const PouSymbol *code, const PouSymbol *block);
/// The member that is named, when it is a function block's own variable, which the code may at most
/// read; null: something else, or declared PUBLIC.
[[nodiscard]] const VarSymbol *foreignLocal(const Symbol *member, const PouSymbol *code);

/// The variable of this name, of the POU itself or inherited.
[[nodiscard]] VarSymbol *findVariable(const PouSymbol *pou, Ident id);
/// The method, action or property of this name, of the POU itself or inherited.
[[nodiscard]] Symbol *memberNamed(const PouSymbol *pou, Ident id);
/// The method or action of this name, of the POU itself or inherited.
[[nodiscard]] PouSymbol *findMethod(const PouSymbol *pou, Ident id);
/// What an instance of exactly the type `pou` runs when `method` of its base or interface is
/// called; null when there is none.
[[nodiscard]] PouSymbol *implementation(const PouSymbol *pou, const PouSymbol *method);

/// Instances hold a type id: calls through pointers, references and interfaces may need it.
[[nodiscard]] bool hasTypeId(const PouSymbol *pou);
/// The type id is a field of this very block; those that extend it find it in their base.
[[nodiscard]] bool carriesTypeId(const PouSymbol *pou);

/// The FB_Init that an instance runs last, or null.
[[nodiscard]] const PouSymbol *findInit(const PouSymbol *pou);
/// What FB_Init takes besides bInitRetains and bInCopyCode.
[[nodiscard]] std::vector<VarSymbol *> constructInputs(const PouSymbol *pou);

/// The methods with {attribute 'call_after_init'} that an instance of exactly this type runs, those
/// declared first in a base first.
[[nodiscard]] std::vector<PouSymbol *> afterInitMethods(const PouSymbol *pou);
/// Calls of the method through pointers, references and interfaces look at the instance's type.
[[nodiscard]] bool isDispatched(const PouSymbol *method);
/// So do calls of the block itself.
[[nodiscard]] bool isBodyDispatched(const PouSymbol *block);

/// All methods, accessors and properties that an interface demands, those of its bases first.
[[nodiscard]] std::vector<PouSymbol *> demandedMethods(const PouSymbol *interface);
/// All interfaces of a block, those of its bases and of the interfaces' bases included.
[[nodiscard]] std::vector<PouSymbol *> allInterfaces(const PouSymbol *pou);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_HIERARCHY_HPP
