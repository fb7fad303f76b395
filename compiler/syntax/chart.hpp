#ifndef STRIDE_COMPILER_SYNTAX_CHART_HPP
#define STRIDE_COMPILER_SYNTAX_CHART_HPP
// A textual sequential function chart (IEC 61131-3), and the statements it becomes. Internal to
// compiler/syntax.

#include "compiler/source/diagnostic.hpp"
#include "compiler/syntax/ast.hpp"
#include "compiler/syntax/instruction_list.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace stc {

/// When a step runs an action.
struct ChartQualifier {
  std::string_view lower; ///< as it is written, in lower case
  const char *input;      ///< of the action control
  bool timed;             ///< a time belongs to it
};
/// Null: there is none of this name, in any case of letters.
[[nodiscard]] const ChartQualifier *findQualifier(std::string_view spelling);

/// `Work(L, T#5s);` in a step.
struct ChartAction {
  ast::Name name;
  const ChartQualifier *qualifier = nullptr; ///< never null: N when none is written
  ast::Expr *time = nullptr;                 ///< null: none
  std::vector<ast::Name> indicators;         ///< variables that show what the action tells
};

struct ChartStep {
  ast::Name name;
  bool initial = false;
  ast::Expr *minTime = nullptr; ///< how long it must be active; null: not watched
  ast::Expr *maxTime = nullptr; ///< how long it may be active; null: not watched
  std::vector<ChartAction> actions;
};

struct ChartTransition {
  std::vector<ast::Name> from;
  std::vector<ast::Name> to;
  ast::Expr *condition = nullptr;        ///< null: `instructions` give it
  std::vector<Instruction> instructions; ///< their last result is the condition
  std::optional<uint64_t> priority;      ///< smaller goes first; none: after those that have one
  Span span;                             ///< of the word TRANSITION
};

struct Chart {
  std::vector<ChartStep> steps;
  std::vector<ChartTransition> transitions; ///< in the order of the text
  Span span;                                ///< where it begins
};

/// Says what is wrong with the steps and transitions of a POU with these variables; false: an
/// error. Warns also of flags and times that do nothing here.
bool checkChart(const Chart &chart, const std::vector<ast::VarDecl *> &variables,
                Diagnostics &diagnostics);

/// Where the statements of a chart go.
struct ChartTarget {
  Interner &interner;
  Arena &arena;
  Diagnostics &diagnostics; ///< for instruction lists
  /// Of the POU: those that it declares; the variables of the steps and actions are added.
  std::vector<ast::VarDecl *> &variables;
  std::vector<std::string_view> members; ///< names of methods, actions and properties in its file
  std::string_view pou;                  ///< its name
  bool extends;                          ///< it has variables of another one, too
  bool ofMember;                         ///< the chart is the body of an ACTION or METHOD
};

/// Adds the statements of a chart that checkChart() finds right.
void lowerChart(const Chart &chart, const ChartTarget &target, std::vector<ast::Stmt *> &out);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_CHART_HPP
