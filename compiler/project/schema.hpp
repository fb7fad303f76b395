#pragma once
// What may stand in stride.toml and in cam files: sections, parameters, their types and ranges.

#include "compiler/codegen/codegen.hpp"
#include "compiler/project/toml_tree.hpp"
#include "compiler/source/diagnostic.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace stc {

enum class ParameterType : std::uint8_t {
  text,
  identifier, ///< names an ST variable or a task
  boolean,
  integer,  ///< low … high
  real,     ///< low … high
  choice,   ///< one of `choices`, by name or by value
  interval, ///< a duration as text, `T#3ms`, low … high in nanoseconds
  nameList, ///< a list of texts
};

/// A named value of a parameter.
struct Choice {
  std::string_view name;
  std::int64_t value;
};

struct Parameter {
  std::string_view name; ///< as the manual spells it
  ParameterType type;
  bool required = false;
  double low = 0;
  double high = 0;
  std::span<const Choice> choices = {};
  std::string_view unit = {}; ///< for messages: `µs`, `u/s`
};

struct Section;

/// The whole of stride.toml, as the section without a name.
[[nodiscard]] const Section &projectSchema();

/// A table (`[project]`) or a list of tables (`[[bus]]`) with its parameters and nested sections.
struct Section {
  std::string_view name;
  std::string_view what; ///< for messages: "a drive"
  std::string_view path; ///< `bus.axis_group.drive`
  bool list = false;
  std::span<const Parameter> parameters = {};
  std::span<const Section *const> sections = {};
  /// The whole file, the section without a name, whose `what` is the file.
  const Section &(*file)() = projectSchema;
};

/// The whole of a cam file, *.cam.toml.
[[nodiscard]] const Section &camSchema();
/// [fmt]: how sources are formatted.
[[nodiscard]] const Section &formatSchema();

/// A table of such a file that has been compared with its schema. Everything wrong with it has been
/// reported; what is left can be read without further checks.
class CheckedSection {
public:
  CheckedSection(const TomlNode &table, const Section &schema, Diagnostics &diagnostics);

  [[nodiscard]] const TomlNode &table() const { return *table_; }
  /// The value of a parameter, or null when it is absent or was wrong.
  [[nodiscard]] const TomlNode *get(std::string_view name) const;
  /// Whether the text has the parameter, right or wrong.
  [[nodiscard]] bool has(std::string_view name) const { return table_->find(name) != nullptr; }
  [[nodiscard]] std::int64_t integer(std::string_view name, std::int64_t otherwise) const;
  [[nodiscard]] double real(std::string_view name, double otherwise) const;
  [[nodiscard]] bool boolean(std::string_view name, bool otherwise) const;
  [[nodiscard]] std::string text(std::string_view name, std::string_view otherwise = {}) const;
  /// Value of a parameter of type choice.
  [[nodiscard]] std::int64_t choice(std::string_view name, std::int64_t otherwise) const;
  /// Appends all valid parameters, in the schema's order: numbers, choices with their name,
  /// durations in seconds.
  void parameters(std::string_view prefix, std::vector<ConfigParameter> &out) const;
  /// The tables of a nested section.
  [[nodiscard]] std::vector<CheckedSection> sections(std::string_view name,
                                                     Diagnostics &diagnostics) const;

private:
  const TomlNode *table_;
  const Section *schema_;
  std::vector<const TomlNode *> values_; ///< valid ones
};

/// Value of a choice written as text or number; -1 when it is none of them.
[[nodiscard]] std::int64_t findChoice(const Parameter &parameter, const TomlNode &value);

} // namespace stc
