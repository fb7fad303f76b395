#ifndef STRIDE_COMPILER_TOML_SCHEMA_HPP
#define STRIDE_COMPILER_TOML_SCHEMA_HPP
// What may stand in stride.toml and in cam files: sections, parameters, their types and ranges.

#include "compiler/source/diagnostic.hpp"
#include "compiler/toml/toml_tree.hpp"
#include "runtime/common/parameter.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stc {

using stride::common::Choice;
using stride::common::Parameter;
using stride::common::ParameterType;

/// A parameter that counts with other drivers only.
struct Foreign {
  std::string_view name;
  std::string reason; ///< "only with device = \"SharedMemory\""
};

/// A table (`[project]`) or a list of tables (`[[bus]]`) with its parameters and nested sections.
struct SectionSchema {
  std::string_view name;
  std::string_view what; ///< for messages: "a drive"
  std::string_view path; ///< `bus.axis_group.drive`
  bool list = false;
  std::span<const Parameter> parameters = {};
  std::span<const SectionSchema *const> sections = {};
  /// Of `parameters` and `sections`: without effect here, which is a warning.
  std::span<const Foreign> foreign = {};
  bool open = false; ///< Any key may stand there; whoever reads it looks at them.
};

/// A table of such a file that has been compared with its schema. Everything wrong with it has been
/// reported; what is left can be read without further checks.
class CheckedSection {
public:
  /// `file`: the whole file, as the section without a name; null: `schema` is.
  CheckedSection(const TomlNode &table, const SectionSchema &schema, Diagnostics &diagnostics,
                 const SectionSchema *file = nullptr);

  [[nodiscard]] const TomlNode &table() const { return *table_; }
  [[nodiscard]] const SectionSchema &schema() const { return *schema_; }
  /// The value of a parameter, or null when it is absent or was wrong.
  [[nodiscard]] const TomlNode *get(std::string_view name) const;
  /// Whether the text has the parameter, right or wrong.
  [[nodiscard]] bool has(std::string_view name) const { return table_->find(name) != nullptr; }
  [[nodiscard]] int64_t integer(std::string_view name, int64_t otherwise) const;
  [[nodiscard]] double real(std::string_view name, double otherwise) const;
  [[nodiscard]] bool boolean(std::string_view name, bool otherwise) const;
  [[nodiscard]] std::string text(std::string_view name, std::string_view otherwise = {}) const;
  /// Value of a parameter of type choice.
  [[nodiscard]] int64_t choice(std::string_view name, int64_t otherwise) const;
  // The same with the schema's default, which is a number.
  [[nodiscard]] int64_t integer(std::string_view name) const;
  [[nodiscard]] double real(std::string_view name) const;
  [[nodiscard]] bool boolean(std::string_view name) const;
  [[nodiscard]] int64_t choice(std::string_view name) const;
  /// The tables of a nested list of tables, not yet compared with a schema.
  [[nodiscard]] std::span<const TomlNode> tables(std::string_view name) const;
  /// The tables of a nested section.
  [[nodiscard]] std::vector<CheckedSection> sections(std::string_view name,
                                                     Diagnostics &diagnostics) const;

private:
  const TomlNode *table_;
  const SectionSchema *schema_;
  const SectionSchema *file_;
  std::vector<const TomlNode *> values_; ///< valid ones
};

/// The section's parameter, or null.
[[nodiscard]] const Parameter *findParameter(const SectionSchema &schema, std::string_view name);

/// Value of a choice written as text or number; nothing when it is none of them.
[[nodiscard]] std::optional<int64_t> findChoice(const Parameter &parameter, const TomlNode &value);

/// A name and where the file says it; the span is invalid for defaults.
struct ConfigName {
  std::string text;
  Span span;
};

/// The `name` of a section; with an invalid span when it is missing or wrong.
[[nodiscard]] ConfigName nameOf(const CheckedSection &section);
/// The text of a parameter as a name; with an invalid span when it is missing or wrong.
[[nodiscard]] ConfigName nameIn(const CheckedSection &section, std::string_view parameter);

/// Reports the second use of a name or number, with the first one marked.
class Unique {
public:
  Unique(Code code, Diagnostics &diagnostics) : code_(code), diagnostics_(diagnostics) {}

  /// True for a new one; else `message` has been reported at `where`.
  bool add(const std::string &key, Span where, const std::string &message);

private:
  Code code_;
  Diagnostics &diagnostics_;
  std::unordered_map<std::string, Span> seen_;
};

/// Warns that a valid parameter changes nothing; `reason` completes "counts …".
void withoutEffect(Diagnostics &diagnostics, const CheckedSection &section, std::string_view name,
                   std::string_view reason);

} // namespace stc

#endif // STRIDE_COMPILER_TOML_SCHEMA_HPP
