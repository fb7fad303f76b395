#ifndef STRIDE_COMPILER_SYNTAX_CONDITIONS_HPP
#define STRIDE_COMPILER_SYNTAX_CONDITIONS_HPP
// Conditional compilation: what `{IF …}` may ask, and its answers.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stc {

/// A name that `defined (name)` knows; the value is what hasvalue compares with.
struct Define {
  std::string name;
  std::string value;
};
/// `NAME` or `NAME=VALUE`, as on the command line; nothing when NAME is no identifier.
[[nodiscard]] std::optional<Define> readDefine(std::string_view text);

/// The names that the given files declare, found by their tokens alone: conditions are answered
/// before anything is parsed. What stands in either branch of an `{IF …}` counts as declared.
/// Several threads may ask at once.
class DeclaredNames {
public:
  enum class Kind : uint8_t { Variable, Type, Pou };
  struct Entry {
    std::vector<std::string> attributes; ///< in lower case
    std::string type;                    ///< of a variable, in lower case without blanks
    std::string init;                    ///< the text of its initial value, the same way
    FileId local = 0;                    ///< of a POU's variable: the file; else 0
  };

  DeclaredNames(const Sources &sources, std::vector<FileId> files)
      : sources_(sources), files_(std::move(files)) {}

  /// `name` may be a path (`GVL.x`, `Main.x`); a plain name finds variables of POUs only from the
  /// same file. Null: not declared.
  const Entry *find(Kind kind, std::string_view name, FileId from);

private:
  class Reader;
  void read(const SourceFile &file);

  const Sources &sources_;
  std::vector<FileId> files_;
  std::once_flag isRead_;
  std::unordered_multimap<std::string, Entry> names_[3];
};

/// What parse() is told about the project.
struct ParseOptions {
  std::vector<Define> defines;
  DeclaredNames *names = nullptr; ///< null: nothing is declared
  bool generated = false; ///< a text of our own: its names may have two underscores in a row
};

/// The state of one file's conditional pragmas.
class Conditions {
public:
  explicit Conditions(const ParseOptions *options);

  /// ParseOptions::generated.
  [[nodiscard]] bool generated() const { return generated_; }
  void define(std::string_view name, std::string_view value);
  void undefine(std::string_view name);
  /// The value of the expression `text`, which begins at `place` of the file; nothing after an
  /// error.
  std::optional<bool> evaluate(std::string_view text, Span place, Diagnostics &diagnostics);

private:
  friend class ConditionParser;

  std::unordered_map<std::string, std::string> defines_; ///< names in lower case
  DeclaredNames *names_;
  bool generated_;
};

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_CONDITIONS_HPP
