#ifndef STRIDE_COMPILER_SEMANTICS_CONFIG_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_CONFIG_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// What an expression of VAR_CONFIG or VAR_ACCESS leads to.
struct PathTarget {
  StatePath path;
  const Type *type = nullptr;
  VarSymbol *variable = nullptr; ///< the last name; null for a program
  bool isConstant = false;       ///< it, or what it lies in
};

/// Variables that VAR_CONFIG can place.
inline constexpr size_t kMaxSlots = 65536;
/// The place a complete address names; reports what names none.
std::optional<Location> locate(Context &c, const ast::DirectAddress &address);
/// Makes the area hold the bytes; false (and reported) when it cannot.
bool reserve(Context &c, const ast::DirectAddress &address, uint64_t byte, uint64_t size);
/// Adds the variables `AT %I*` in a value of the type; `path` leads to it.
void collectSlots(Context &c, const Type *type, StatePath &path, std::vector<SlotPlace> &out);
/// A variable by its path, whose names learn what they stand for; `inside`: a program whose own
/// variables can be named without it.
std::optional<PathTarget> resolvePath(Context &c, ast::Expr *expr, Module &module,
                                      const ast::PouDecl *inside = nullptr);
/// The entries of VAR_ACCESS.
void checkAccesses(Context &c, Module &module);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_CONFIG_INTERNAL_HPP
