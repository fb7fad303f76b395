#ifndef STRIDE_COMPILER_ASSETS_CNC_VALUES_HPP
#define STRIDE_COMPILER_ASSETS_CNC_VALUES_HPP
// Values that a command line says of the variables of a CNC program: `--set NAME=VALUE`.

#include "compiler/assets/cnc/cnc_source.hpp"

#include <memory>

namespace stc {

/// The value of one variable.
struct CncValue {
  std::string name;             ///< As it was said; case does not matter.
  std::string text;             ///< Without quotes.
  std::optional<double> number; ///< Nothing: it is a text, or TRUE or FALSE.
  std::optional<bool> truth;    ///< TRUE or FALSE.
  bool used = false;            ///< A program names the variable.
};

/// The values of several, and which variables there are.
class CncValues {
public:
  /// Takes `NAME=VALUE`. A value is a number, TRUE, FALSE or a text, which may stand in single
  /// quotes. What is wrong with it, or nothing.
  std::string add(std::string_view text);

  /// The value of a variable that a program names; null: nobody has said one.
  CncValue *find(std::string_view name);

  /// What is wrong if values were said of variables that no program has; else nothing.
  [[nodiscard]] std::string unknown() const;

private:
  std::vector<std::unique_ptr<CncValue>> values_; ///< Pointers to them stay valid.
  std::vector<std::string> known_;                ///< Variables of programs.
};

/// Gives the variables of a program of G-code their values. What does not fit is reported.
void setVariables(CncProgram &program, CncValues &values, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CNC_VALUES_HPP
