#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_EXPRESSION_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_EXPRESSION_HPP
// Expressions that become Structured Text.

#include "compiler/import/networks/text.hpp"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace stc::import::networks {

/// An expression: a text of the file, an operator over others, or a call of a function.
struct Expression {
  enum class Kind { Text, Operator, Call };
  Kind kind = Kind::Text;
  std::string text;                 ///< the text, the operator or the function
  Precedence precedence = kPrimary; ///< of Text and Operator
  std::vector<Expression> operands; ///< of Operator and Call
  std::vector<std::string> names;   ///< of Call: formal parameters; empty: by position
  std::vector<std::string> outputs; ///< of Call: `name => variable`
  bool operator==(const Expression &) const = default;
};

[[nodiscard]] Expression textOf(std::string_view text);
[[nodiscard]] Expression truth();
[[nodiscard]] bool isTruth(const Expression &expression);
/// Two negations cancel each other out.
[[nodiscard]] Expression negation(Expression operand);
/// Nested ones are joined, TRUE falls away. None: TRUE.
[[nodiscard]] Expression conjunction(std::vector<Expression> operands);
/// Nested ones are joined; what all (or neighbours) begin or end with is taken out of the brackets:
/// `a AND b OR a AND c` becomes `a AND (b OR c)`.
[[nodiscard]] Expression disjunction(std::vector<Expression> operands);
/// An infix operator, or a call where there is none of that name. `name` is as boxes name it
/// (`ADD`, `GE`, `AND`, `SEL`, a function's name).
[[nodiscard]] Expression operation(std::string_view name, std::vector<Expression> operands);
/// Whether boxes of that name become infix operators.
[[nodiscard]] bool isInfix(std::string_view name);
/// Whether it takes any number of operands pairwise: `GT(a, b, c)`.
[[nodiscard]] bool isComparison(std::string_view name);

/// As Structured Text with as few brackets as possible.
[[nodiscard]] std::string printed(const Expression &expression);
/// The variables it reads, in lower case.
[[nodiscard]] std::set<std::string> readsOf(const Expression &expression);
/// Variables and literals in it.
[[nodiscard]] size_t leavesOf(const Expression &expression);
/// Whether a function is called in it.
[[nodiscard]] bool callsIn(const Expression &expression);

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_EXPRESSION_HPP
