#ifndef STRIDE_TESTS_UNIT_SYNTAX_PRINT_AST_HPP
#define STRIDE_TESTS_UNIT_SYNTAX_PRINT_AST_HPP
// Syntax trees as short S-expressions, and helpers to get them from text.

#include "compiler/source/render.hpp"
#include "compiler/syntax/parser.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc::test {

/// `(assign (x) (+ 1 2))`, one declaration or statement per line.
std::string print(const ast::File &file);
std::string print(const ast::Stmt *statement);
std::string print(const ast::Expr *expression);
std::string print(const ast::TypeExpr *type);

/// A parsed text with everything it needs.
struct Parsed {
  explicit Parsed(std::string text);

  /// "SE0202 3:7 expected `;` after the assignment", one per line, sorted by place.
  [[nodiscard]] std::string errors() const;
  /// All diagnostics as the user sees them.
  [[nodiscard]] std::string rendered() const;
  [[nodiscard]] std::string_view text(Span span) const { return sources.text(span); }

  Sources sources;
  Interner interner;
  Arena arena;
  Diagnostics diagnostics;
  ast::File *file = nullptr;
};

/// The statements in a program's body, printed.
std::string printBody(const std::string &statements);
/// The expression on the right of `x := …`.
std::string printExpression(const std::string &expression);
/// The errors in a program with this body, with lines counted from its first.
std::string bodyErrors(const std::string &statements);

} // namespace stc::test

#endif // STRIDE_TESTS_UNIT_SYNTAX_PRINT_AST_HPP
