#ifndef STRIDE_COMPILER_SYNTAX_GLOBAL_NAMES_HPP
#define STRIDE_COMPILER_SYNTAX_GLOBAL_NAMES_HPP
// Names that a program gives to things of the whole project.

#include "compiler/syntax/ast.hpp"

#include <string>
#include <unordered_map>
#include <vector>

namespace stc {

/// These names in lower case, and where they stand: POUs, types and global variables outside of
/// namespaces.
[[nodiscard]] std::unordered_map<std::string, Span>
globalNames(const std::vector<ast::File *> &files);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_GLOBAL_NAMES_HPP
