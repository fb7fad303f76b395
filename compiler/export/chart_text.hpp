#ifndef STRIDE_COMPILER_EXPORT_CHART_TEXT_HPP
#define STRIDE_COMPILER_EXPORT_CHART_TEXT_HPP
// A textual sequential function chart (IEC 61131-3) in its parts, each as it is written.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc::exporting {

/// `Work(L, T#5s, done);`
struct ChartActionText {
  std::string name;
  std::string qualifier; ///< in capital letters; N when none is written
  std::string time;      ///< empty: none
  std::string indicator; ///< indicator variables, between commas; empty: none
};

struct ChartStepText {
  std::string name;
  bool initial = false;
  std::string minTime; ///< expressions; empty: none
  std::string maxTime;
  std::vector<ChartActionText> actions;
  std::string comment; ///< before it and in it, without signs; lines end with \n
  std::string pragmas; ///< as they are written, likewise
};

struct ChartTransitionText {
  std::string name;     ///< empty: none
  std::string priority; ///< digits; empty: none
  std::vector<std::string> from;
  std::vector<std::string> to;
  std::string condition;     ///< an expression, or lines of instructions
  bool instructions = false; ///< the condition is an instruction list
  std::string comment;       ///< as of steps
  std::string pragmas;
};

struct ChartText {
  std::vector<ChartStepText> steps;
  std::vector<ChartTransitionText> transitions;
  std::string comment; ///< after the last part
};

/// The parts of a body that the compiler has accepted; nothing when it is no chart, or when it has
/// what these parts cannot say (a pragma after the last of them, a priority that is no plain
/// number).
[[nodiscard]] std::optional<ChartText> chartText(std::string_view body);

} // namespace stc::exporting

#endif // STRIDE_COMPILER_EXPORT_CHART_TEXT_HPP
