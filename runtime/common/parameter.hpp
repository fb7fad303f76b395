// A parameter of stride.toml, or of a cam file, as one row: its name, what it may be, what it is
// when nobody gives it, and what its documentation says. Data only, for the compiler that checks
// and for whoever uses the value.
#ifndef STRIDE_RUNTIME_COMMON_PARAMETER_HPP
#define STRIDE_RUNTIME_COMMON_PARAMETER_HPP

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace stride::common {

enum class ParameterType : uint8_t {
  Text,
  Identifier, ///< Names an ST variable or a task.
  DriveName,  ///< Names a drive of the same axis group.
  Boolean,
  Integer,  ///< low … high.
  Real,     ///< low … high.
  Choice,   ///< One of `choices`, by name or by value.
  Interval, ///< A duration as text, `T#3ms`; low … high in nanoseconds. As a number: seconds.
  NameList, ///< A list of texts.
};

/// A named value of a parameter.
struct Choice {
  std::string_view name;
  int64_t value;
};

/// The values of a section, those that nobody gives included. In a table below, names begin with
/// that of the table: "physics.model".
class ParameterValues {
public:
  [[nodiscard]] virtual double number(std::string_view name) const = 0;
  /// Of the task that serves the section's device; 0: there is none. [s]
  [[nodiscard]] virtual double cycleSeconds() const = 0;

protected:
  ParameterValues() = default;
  ParameterValues(const ParameterValues &) = default;
  ParameterValues &operator=(const ParameterValues &) = default;
  ~ParameterValues() = default;
};

/// What a parameter is when nobody gives it.
struct Default {
  bool any = false; ///< FALSE: then there is none.
  double number = 0;
  /// Text: itself, in which `{project}` and `{name}` stand for the names of project and section.
  /// Where `computed` says how much it is: how, for people.
  std::string_view text = {};
  double (*computed)(const ParameterValues &values) = nullptr;
};

/// A value of a parameter of the same section: of a choice, or 1 for TRUE.
struct Condition {
  std::string_view parameter = {}; ///< Empty: always.
  int64_t value = 0;
};

struct Parameter {
  std::string_view name; ///< As stride.toml spells it.
  ParameterType type;
  bool required = false;
  double low = 0;
  double high = 0;
  std::span<const Choice> choices = {};
  std::string_view unit = {}; ///< `µs`, `u/s`.
  Default otherwise = {};
  std::string_view text = {}; ///< Its documentation.

  // What is to be said of it together with others; without effect means: with a warning.
  Condition only = {};            ///< Else it is without effect.
  std::string_view example = {};  ///< Not empty: where `only` holds it is required.
  std::string_view without = {};  ///< It has no effect beside this one.
  std::string_view with = {};     ///< It needs this one, too.
  std::string_view lessThan = {}; ///< It must be less than this one …
  bool lessOnLinearOnly = false;  ///< … of a linear axis.
  bool linearOnly = false;        ///< On a rotary axis it has no effect.

  [[nodiscard]] constexpr Parameter needed() const {
    Parameter result = *this;
    result.required = true;
    return result;
  }
  [[nodiscard]] constexpr Parameter says(std::string_view documentation) const {
    Parameter result = *this;
    result.text = documentation;
    return result;
  }
  /// A number, a choice by value, a BOOL as 0 or 1, a duration in seconds.
  [[nodiscard]] constexpr Parameter defaultsTo(double number) const {
    Parameter result = *this;
    result.otherwise = {true, number};
    return result;
  }
  [[nodiscard]] constexpr Parameter defaultsTo(std::string_view value) const {
    Parameter result = *this;
    result.otherwise = {true, 0, value};
    return result;
  }
  [[nodiscard]] constexpr Parameter defaultsTo(double (*computed)(const ParameterValues &),
                                               std::string_view words) const {
    Parameter result = *this;
    result.otherwise = {true, 0, words, computed};
    return result;
  }
  [[nodiscard]] constexpr Parameter onlyWith(std::string_view parameter, int64_t value) const {
    Parameter result = *this;
    result.only = {parameter, value};
    return result;
  }
  [[nodiscard]] constexpr Parameter neededWith(std::string_view parameter, int64_t value,
                                               std::string_view example) const {
    Parameter result = onlyWith(parameter, value);
    result.example = example;
    return result;
  }
  [[nodiscard]] constexpr Parameter onlyWithout(std::string_view other) const {
    Parameter result = *this;
    result.without = other;
    return result;
  }
  [[nodiscard]] constexpr Parameter together(std::string_view other) const {
    Parameter result = *this;
    result.with = other;
    return result;
  }
  [[nodiscard]] constexpr Parameter below(std::string_view other, bool onLinearOnly) const {
    Parameter result = *this;
    result.lessThan = other;
    result.lessOnLinearOnly = onLinearOnly;
    return result;
  }
  [[nodiscard]] constexpr Parameter ofLinearAxes() const {
    Parameter result = *this;
    result.linearOnly = true;
    return result;
  }
};

/// A table below a section, `[….drive.physics]`, with its parameters.
struct ParameterTable {
  std::string_view name;
  std::string_view what; ///< For messages: "the physics of a drive".
  std::span<const Parameter> parameters;
};

// Rows of the usual kinds.

inline constexpr double kLargestWord = 65535;
inline constexpr double kLargestDword = 4294967295.0;
inline constexpr double kHuge = std::numeric_limits<double>::max();
inline constexpr double kTiny = std::numeric_limits<double>::min();
inline constexpr double kMicrosecondNs = 1e3;
inline constexpr double kHourNs = 3.6e12;

constexpr Parameter text(std::string_view name) { return {name, ParameterType::Text}; }
constexpr Parameter identifier(std::string_view name) { return {name, ParameterType::Identifier}; }
constexpr Parameter flag(std::string_view name) { return {name, ParameterType::Boolean}; }
constexpr Parameter whole(std::string_view name, double low, double high,
                          std::string_view unit = {}) {
  return {name, ParameterType::Integer, false, low, high, {}, unit};
}
constexpr Parameter word(std::string_view name) { return whole(name, 0, kLargestWord); }
constexpr Parameter dword(std::string_view name, std::string_view unit = {}) {
  return whole(name, 0, kLargestDword, unit);
}
constexpr Parameter real(std::string_view name, double low, double high,
                         std::string_view unit = {}) {
  return {name, ParameterType::Real, false, low, high, {}, unit};
}
constexpr Parameter anyReal(std::string_view name, std::string_view unit) {
  return real(name, -kHuge, kHuge, unit);
}
constexpr Parameter positive(std::string_view name, std::string_view unit) {
  return real(name, kTiny, kHuge, unit);
}
constexpr Parameter notNegative(std::string_view name, std::string_view unit) {
  return real(name, 0, kHuge, unit);
}
constexpr Parameter choice(std::string_view name, std::span<const Choice> choices) {
  return {name, ParameterType::Choice, false, 0, 0, choices};
}
/// A duration from a microsecond to an hour.
constexpr Parameter duration(std::string_view name) {
  return {name, ParameterType::Interval, false, kMicrosecondNs, kHourNs};
}

} // namespace stride::common

#endif
