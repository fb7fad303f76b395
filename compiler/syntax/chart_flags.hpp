#ifndef STRIDE_COMPILER_SYNTAX_CHART_FLAGS_HPP
#define STRIDE_COMPILER_SYNTAX_CHART_FLAGS_HPP
// The flags that a chart uses when its POU declares them, and the times of its steps that they
// watch. Internal to compiler/syntax.

#include "compiler/syntax/chart.hpp"
#include "compiler/syntax/chart_nodes.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// What the statements of one chart have in common.
class ChartFlags {
public:
  ChartFlags(const Chart &chart, const ChartTarget &target)
      : chart_(chart), target_(target), make_(target.interner, target.arena),
        declared_(target.variables.begin(), target.variables.end()) {}

protected:
  using Statements = ChartNodes::Statements;

  /// Of a variable that the program does not see: unlike those of the blocks that this one extends.
  std::string hidden(const std::string &what) const {
    return "sfc__" + std::string(target_.pou) + "__" + what;
  }
  /// Where what lives from call to call is declared: a member keeps it in its block.
  [[nodiscard]] ast::Section kept() const {
    return target_.ofMember ? ast::Section::Instance : ast::Section::Local;
  }
  void declareHidden(const ast::Name &what, const char *type, ast::Section section) {
    target_.variables.push_back(make_.declaration(what, {type}, section));
    make_.hide(target_.variables.back());
  }
  void declareBool(const ast::Name &what, ast::Section section) {
    declareHidden(what, "BOOL", section);
  }
  /// The variable when the POU declares it.
  [[nodiscard]] const ast::VarDecl *declared(std::string_view what) const;
  [[nodiscard]] bool hasFlag(const char *what) const { return declared(what) != nullptr; }
  ast::Expr *flag(const char *what) {
    return make_.variable(make_.name(what, declared(what)->name.span));
  }
  /// Whether one of the flags is TRUE; null: none of them is declared.
  ast::Expr *anyFlag(const std::vector<const char *> &flags);
  /// Whether a flag lets nothing happen; null: none of them is declared.
  ast::Expr *anyStop(bool init);
  ast::Name fires(size_t i) {
    return make_.name(hidden("fire" + std::to_string(i)), chart_.transitions[i].span);
  }
  /// Registers when the step has been active for too long, or is left too early.
  void watch(const ChartStep &step, const std::string &number, Statements &out);
  void forgetError(Statements &out);
  /// SFCQuitError forgets the error; when it becomes FALSE, the times of the active steps begin
  /// anew.
  void quitError(Statements &out);

  const Chart &chart_;
  const ChartTarget &target_;
  ChartNodes make_;
  std::vector<const ast::VarDecl *> declared_; ///< by the POU itself

private:
  /// The variable of a time that a step has; computed once, whatever its expression does.
  ast::Expr *limit(const std::string &what, ast::Expr *time, Statements &out);
  [[nodiscard]] ast::Expr *left(const ChartStep &step);
};

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_CHART_FLAGS_HPP
