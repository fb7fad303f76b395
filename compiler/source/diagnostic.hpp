#ifndef STRIDE_COMPILER_SOURCE_DIAGNOSTIC_HPP
#define STRIDE_COMPILER_SOURCE_DIAGNOSTIC_HPP
// Diagnostics as data. Nothing here knows how they are shown (render.hpp does).

#include "compiler/source/span.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

enum class Severity : uint8_t {
  Off, ///< not reported
  Note,
  Warning,
  Error
};

/// Stable diagnostic codes; the table with default severity and title is diagnostic_codes.def.
enum class Code : uint16_t {
#define STC_DIAGNOSTIC(number, name, severity, title) name = (number),
#include "compiler/source/diagnostic_codes.def"
#undef STC_DIAGNOSTIC
};

/// What is known about a code without an occurrence of it.
struct CodeInfo {
  Code code;
  Severity severity;
  std::string_view name;  ///< "unknownMember"
  std::string_view title; ///< one line
};

/// All codes in ascending order.
[[nodiscard]] const std::vector<CodeInfo> &allCodes();
[[nodiscard]] const CodeInfo &info(Code code);
/// Why the code is reported, with a wrong and a right example, Markdown.
[[nodiscard]] std::string_view explainText(Code code);
/// "SE0203"
[[nodiscard]] std::string codeName(Code code);
/// "unknown-member": the code's name in words.
[[nodiscard]] std::string kebabName(Code code);
/// The code called `SE0203`, `se0203`, `203`, `0203` or `unknown-member` (case does not count), or
/// null.
[[nodiscard]] const CodeInfo *findCode(std::string_view what);
/// True for what is only looked for in programs without errors: unused variables, unreachable code
/// …
[[nodiscard]] bool isLint(Code code);

/// A marked range with a word about it. The first label of a diagnostic is the primary one.
struct Label {
  Span span;
  std::string text;
};

/// A replacement that an editor can make; an empty range inserts.
struct Edit {
  Span span;
  std::string text;
};

/// Edits that together follow one help.
struct Suggestion {
  std::string message;
  std::vector<Edit> edits;
};

/// One error or warning: what, where, and the way out.
struct Diagnostic {
  Code code{};
  Severity severity = Severity::Error;
  std::string message;
  std::vector<Label>
      labels; ///< labels[0] is the primary place (may be absent for errors without a place)
  std::vector<std::string> notes{};
  std::vector<std::string> helps{};
  std::vector<Suggestion> suggestions{}; ///< for tools; each one's message is also among the helps

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
  /// A help that says what to write, and the edit that does it.
  Diagnostic &suggest(std::string text, std::vector<Edit> edits) {
    helps.push_back(text);
    suggestions.push_back({std::move(text), std::move(edits)});
    return *this;
  }
  Diagnostic &suggest(std::string text, Span span, std::string replacement) {
    return suggest(std::move(text), {Edit{span, std::move(replacement)}});
  }
};

/// The severities that the user chose. Errors stay errors.
class Levels {
public:
  enum class Group : uint8_t {
    AllWarnings, ///< what is a warning by default
    Lints,       ///< isLint(): also those that are off by default
  };
  void set(Code code, Severity severity) { single_[code] = severity; }
  void set(Group group, Severity severity) { groups_[group] = severity; }
  /// A single code's choice goes before a group's, `lints` before `all-warnings`.
  [[nodiscard]] Severity of(Code code) const;
  /// Takes over what `other` says.
  void add(const Levels &other);

private:
  std::map<Code, Severity> single_;
  std::map<Group, Severity> groups_;
};

/// "all-warnings", "lints"; nothing for other names.
[[nodiscard]] std::optional<Levels::Group> findGroup(std::string_view name);
/// All names that a setting may have: of codes, of groups.
[[nodiscard]] std::vector<std::string> settingNames();

/// Collects diagnostics of one run. References returned by report() are valid until the next
/// report().
class Diagnostics {
public:
  void setLevels(Levels levels) { levels_ = std::move(levels); }
  [[nodiscard]] const Levels &levels() const { return levels_; }
  /// From `offset` of the file on, the code is silent (`{warning disable SE0390}`) or as before.
  void setSilent(FileId file, uint32_t offset, Code code, bool silent);
  /// The file is not the user's business: only errors are reported in it.
  void setForeign(FileId file) { foreign_.insert(file); }
  /// Whether an occurrence of the code would be reported anywhere: lets passes that cost time be
  /// left out.
  [[nodiscard]] bool wants(Code code) const { return levels_.of(code) != Severity::Off; }

  /// Adds a diagnostic with the code's severity. What is off, or silent at its place, is built but
  /// not added.
  Diagnostic &report(Code code, Span where, std::string message, std::string labelText = {});
  [[nodiscard]] bool hasErrors() const { return errors_ != 0; }
  [[nodiscard]] size_t errorCount() const { return errors_; }
  [[nodiscard]] size_t warningCount() const { return warnings_; }
  [[nodiscard]] const std::vector<Diagnostic> &all() const { return list_; }
  /// An empty collection for a part of the run, with what is silent or foreign here.
  [[nodiscard]] Diagnostics part() const;
  /// Adds what a part() has, after what is here.
  void add(Diagnostics &&part);
  /// Sorts by file and place, stable; drops exact repetitions.
  void sort();

private:
  [[nodiscard]] bool isSilent(Code code, Span where) const;

  struct Silence {
    FileId file;
    uint32_t offset;
    Code code;
    bool silent;
  };

  std::vector<Diagnostic> list_;
  Diagnostic dropped_;
  Levels levels_;
  std::vector<Silence> silences_; ///< in the order of each file's text
  size_t inherited_ = 0;          ///< silences of the whole that this is a part() of
  std::set<FileId> foreign_;
  size_t errors_ = 0;
  size_t warnings_ = 0;
};

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_DIAGNOSTIC_HPP
