#ifndef STRIDE_COMPILER_CLI_TERMINAL_HPP
#define STRIDE_COMPILER_CLI_TERMINAL_HPP
// What a command shows its user.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace stc::cli {

enum class ColorChoice { Automatic, Always, Never };
enum class Format { Text, Json };

/// How diagnostics are shown.
struct Output {
  ColorChoice color = ColorChoice::Automatic;
  Format format = Format::Text;
  size_t maxErrors = 100; ///< as text; 0: all

  /// Whether standard error gets colours: on a terminal unless NO_COLOR is set, or as chosen.
  [[nodiscard]] bool useColor() const;
};

/// Writes the text to standard output; to a terminal without control characters.
void print(const std::string &text);

/// Writes diagnostics, text with a summary line to standard error, JSON (an object a line) to
/// standard output. As text nothing is shown after `maxErrors` errors. Returns the exit code: 0
/// exactly when none is an error.
int show(const std::vector<Diagnostic> &diagnostics, const Sources &sources, const Output &output);

/// A single error without a place.
int showError(Code code, std::string message, const Output &output = {});

/// One line on the terminal that changes while something lasts; nothing when standard error is no
/// terminal.
class ProgressLine {
public:
  ProgressLine();
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine &) = delete;
  ProgressLine &operator=(const ProgressLine &) = delete;

  void update(std::string_view what, size_t done, size_t total);
  void clear();
  [[nodiscard]] bool isTerminal() const { return terminal_; }
  [[nodiscard]] double seconds() const;

private:
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_;
};

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_TERMINAL_HPP
