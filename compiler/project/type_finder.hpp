#ifndef STRIDE_COMPILER_PROJECT_TYPE_FINDER_HPP
#define STRIDE_COMPILER_PROJECT_TYPE_FINDER_HPP
// Declarations of libraries, for those who need them before the program is checked.

#include "compiler/semantics/program.hpp"
#include "compiler/syntax/ast.hpp"

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stc {

/// The declaration of that name, given in lower case, in files; null: there is none.
[[nodiscard]] const ast::Decl *typeIn(const std::vector<ast::File *> &files,
                                      std::string_view lower);

/// Finds types and blocks in libraries; parses a file of Stride's own once.
class TypeFinder {
public:
  TypeFinder(Program &program, const LibraryIndex &index) : program_(program), index_(index) {}

  /// The declaration of a type in a library: of the project's own ones, then of Stride's. Null:
  /// there is none.
  [[nodiscard]] const ast::Decl *find(std::string_view lower);

private:
  Program &program_;
  const LibraryIndex &index_;
  std::unordered_map<std::string, ast::File *> parsed_;
};

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_TYPE_FINDER_HPP
