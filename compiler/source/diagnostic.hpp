#pragma once
// Diagnostics as data. Nothing here knows how they are shown (render.hpp does).

#include "compiler/source/span.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

enum class Severity : std::uint8_t { note, warning, error };

/// Stable diagnostic codes; the table with default severity, title and explain text is
/// diagnostic_codes.def.
enum class Code : std::uint16_t {
#define STC_DIAGNOSTIC(number, name, severity, title, explain) name = number,
#include "compiler/source/diagnostic_codes.def"
#undef STC_DIAGNOSTIC
};

/// What is known about a code without an occurrence of it.
struct CodeInfo {
  Code code;
  Severity severity;
  std::string_view title;   ///< one line
  std::string_view explain; ///< a wrong and a right example, Markdown
};

/// All codes in ascending order.
[[nodiscard]] const std::vector<CodeInfo> &allCodes();
[[nodiscard]] const CodeInfo &info(Code code);
/// "SE0203"
[[nodiscard]] std::string codeName(Code code);

/// A marked range with a word about it. The first label of a diagnostic is the primary one.
struct Label {
  Span span;
  std::string text;
};

/// One error or warning: what, where, and the way out.
struct Diagnostic {
  Code code;
  Severity severity = Severity::error;
  std::string message;
  std::vector<Label>
      labels; ///< labels[0] is the primary place (may be absent for errors without a place)
  std::vector<std::string> notes;
  std::vector<std::string> helps;

  Diagnostic &label(Span span, std::string text) {
    labels.push_back({span, std::move(text)});
    return *this;
  }
  Diagnostic &note(std::string text) {
    notes.push_back(std::move(text));
    return *this;
  }
  Diagnostic &help(std::string text) {
    helps.push_back(std::move(text));
    return *this;
  }
};

/// Collects diagnostics of one run. References returned by report() are valid until the next
/// report().
class Diagnostics {
public:
  /// Adds a diagnostic with the code's default severity.
  Diagnostic &report(Code code, Span where, std::string message, std::string labelText = {});
  [[nodiscard]] bool hasErrors() const { return errors_ != 0; }
  [[nodiscard]] std::size_t errorCount() const { return errors_; }
  [[nodiscard]] std::size_t warningCount() const { return warnings_; }
  [[nodiscard]] const std::vector<Diagnostic> &all() const { return list_; }
  /// Sorts by file and place, stable; drops exact repetitions.
  void sort();

private:
  std::vector<Diagnostic> list_;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
};

} // namespace stc
