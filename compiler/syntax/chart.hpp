#ifndef STRIDE_COMPILER_SYNTAX_CHART_HPP
#define STRIDE_COMPILER_SYNTAX_CHART_HPP
// A textual sequential function chart (IEC 61131-3), and the statements it becomes. Internal to
// compiler/syntax.

#include "compiler/source/diagnostic.hpp"
#include "compiler/syntax/ast.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace stc {

/// `Work(L, T#5s);` in a step.
struct ChartAction {
  ast::Name name;
  ast::Name qualifier;       ///< empty: N
  ast::Expr *time = nullptr; ///< null: none
};

struct ChartStep {
  ast::Name name;
  bool initial = false;
  std::vector<ChartAction> actions;
};

struct ChartTransition {
  std::vector<ast::Name> from;
  std::vector<ast::Name> to;
  ast::Expr *condition = nullptr;
  std::optional<uint64_t> priority; ///< smaller goes first; none: after those that have one
  Span span;                        ///< of the word TRANSITION
};

struct Chart {
  std::vector<ChartStep> steps;
  std::vector<ChartTransition> transitions; ///< in the order of the text
  Span span;                                ///< where it begins
};

/// Says what is wrong with the steps and transitions; false: with an error.
bool checkChart(const Chart &chart, Diagnostics &diagnostics);

/// Whether a qualifier (in lower case) exists, and needs a time.
struct ChartQualifier {
  std::string_view lower;
  const char *name;
  bool timed;
};
/// Null: there is none of this name.
[[nodiscard]] const ChartQualifier *findQualifier(std::string_view spelling);

/// Adds the statements of a chart that checkChart() finds right, and the variables of its steps and
/// actions.
void lowerChart(const Chart &chart, Interner &interner, Arena &arena,
                std::vector<ast::VarDecl *> &variables, std::vector<ast::Stmt *> &out);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_CHART_HPP
