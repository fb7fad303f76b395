#ifndef STRIDE_COMPILER_CODEGEN_CPP_ROOTS_HPP
#define STRIDE_COMPILER_CODEGEN_CPP_ROOTS_HPP
// Objects of their own in the application's state, and the ways into them.

#include "compiler/codegen/cpp/names.hpp"

#include <string>

namespace stc::codegen {

/// An object of its own in the application's state: a variable list, a program, or the statics of a
/// POU.
struct Root {
  const Symbol *symbol = nullptr;
  bool isStatic = false;
  bool operator==(const Root &) const = default;
};

/// `GVL__globals__`, in the namespace of its library
std::string rootLocalType(Names &names, const Root &root);
/// `::st::user::GVL__globals__`
std::string rootType(Names &names, const Root &root);
/// `GVL__globals__at__`: the constant that holds its place in the state.
std::string rootLocalPlace(Names &names, const Root &root);
/// `::st::user::GVL__globals__at__`
std::string rootPlace(Names &names, const Root &root);
/// `GVL__`, `Path__program`, `F__static`: what it is called in bodies and in the state; with the
/// library's name before it when it is not `own`.
std::string rootName(Names &names, const Root &root, const Library *own);

/// The root in which the path begins.
Root rootOf(const StatePath &path);
/// The type of the variable it leads to.
const Type *typeAt(const StatePath &path);
/// The way from the root to the variable as C++: `.fb.x`.
std::string pathInRoot(const StatePath &path);
/// The path as C++, from the state: `Main__program.fb.x`.
std::string statePath(Names &names, const StatePath &path, const Library *own);

/// The statics of a POU that has some.
[[nodiscard]] bool hasStatics(const PouSymbol *pou);

/// `::st::user::GVL__globals__x__at__`: the constant that holds the place of the copies of a
/// variable with {attribute 'consistent'}; the local name without its namespace.
std::string copiesLocalPlace(Names &names, const VarSymbol *variable);
std::string copiesPlace(Names &names, const VarSymbol *variable);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CPP_ROOTS_HPP
