#ifndef STRIDE_COMPILER_TOML_TOML_TREE_HPP
#define STRIDE_COMPILER_TOML_TOML_TREE_HPP
// stride.toml as a tree that knows where everything stands. The only file that sees toml++ is
// toml_tree.cpp.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

enum class TomlKind : uint8_t { Table, Array, String, Integer, Floating, Boolean, Other };

/// A value of a TOML document. Members of a table are in the order of the text.
struct TomlNode {
  TomlKind kind = TomlKind::Other;
  std::string key;  ///< as a member of a table
  Span keySpan;     ///< of the key; of an element of `[[x]]` its header's key
  Span span;        ///< of the value; of a table or an element of `[[x]]` its header's key
  std::string text; ///< string
  int64_t integer = 0;
  double floating = 0; ///< also the value of an integer
  bool boolean = false;
  bool arrayOfTables = false; ///< array whose elements are all tables (and there is one)
  std::vector<TomlNode> children;

  /// The member of that name (exact case), or null.
  [[nodiscard]] const TomlNode *find(std::string_view name) const;
};

/// Reads a TOML text. A text that is not TOML is reported (SE0801, with its place), and nothing is
/// returned.
[[nodiscard]] std::unique_ptr<TomlNode> parseToml(const SourceFile &file, Diagnostics &diagnostics);

/// "a table", "a list of tables", "text" …, for messages.
[[nodiscard]] std::string_view describe(const TomlNode &node);

} // namespace stc

#endif // STRIDE_COMPILER_TOML_TOML_TREE_HPP
