#ifndef STRIDE_COMPILER_SEMANTICS_HELD_HPP
#define STRIDE_COMPILER_SEMANTICS_HELD_HPP
// What values of a type hold: a walk through types that takes each of them once, however often and
// on however many ways it occurs.

#include "compiler/semantics/symbols.hpp"

#include <unordered_set>
#include <vector>

namespace stc {

/// What a walk does with a type that it meets.
enum class Held : uint8_t {
  Found,  ///< ends the walk
  Inside, ///< looks at what it holds, if it is a structure or an instance
  Over,   ///< goes on elsewhere
};

/// Calls `look(type, variable)` for `type` (variable is null) and for all that a value of it holds:
/// fields of structures, variables of blocks (of all sections, with the variable) and their bases
/// (without). Arrays stand for their elements. True when a call returned Held::Found. Takes time
/// that is linear in the number of fields of the types, and ends for types that hold themselves.
template <class Look> bool anyHeld(const Type *type, Look &&look) {
  std::vector<const Type *> pending;
  std::unordered_set<const Type *> seen;
  const auto isFound = [&](const Type *t, const VarSymbol *variable) {
    while (t->kind == TypeKind::Array)
      t = typeAs<ArrayType>(t)->element;
    const Held held = look(t, variable);
    if (held == Held::Inside && (t->kind == TypeKind::Structure || isInstance(t)) &&
        seen.insert(t).second)
      pending.push_back(t);
    return held == Held::Found;
  };
  const auto anyFound = [&](const auto &variables) {
    for (const VarSymbol *v : variables)
      if (v->type != nullptr && isFound(v->type, v))
        return true;
    return false;
  };
  if (isFound(type, nullptr))
    return true;
  for (size_t i = 0; i < pending.size(); ++i) {
    if (pending[i]->kind == TypeKind::Structure) {
      const auto *s = typeAs<StructType>(pending[i]);
      if ((s->base != nullptr && isFound(s->base, nullptr)) || anyFound(s->fields))
        return true;
    } else {
      const PouSymbol *pou = typeAs<PouType>(pending[i])->symbol;
      if ((pou->base != nullptr && pou->base->type != nullptr &&
           isFound(pou->base->type, nullptr)) ||
          anyFound(pou->variables))
        return true;
    }
  }
  return false;
}

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_HELD_HPP
