// What a driver is told of its section of stride.toml: what is given there, and for the rest the
// defaults of the schema.
#ifndef STRIDE_RUNTIME_COMMON_SETUP_PARAMETERS_HPP
#define STRIDE_RUNTIME_COMMON_SETUP_PARAMETERS_HPP

#include "runtime/common/parameter.hpp"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stride::common {

/// A value of stride.toml.
struct SetupParameter {
  /// As in stride.toml; in a table below with its name before it: "physics.model".
  std::string name;
  std::string text; ///< Texts and choices by name.
  double number;    ///< Numbers, choices by value, BOOLs as 0 and 1, durations in seconds.
};

/// The rows that a section may have.
struct SectionRows {
  std::span<const Parameter> general; ///< Whatever the driver.
  std::span<const Parameter> own;     ///< The driver's.
  std::span<const ParameterTable> tables = {};

  /// "physics.model", or null.
  [[nodiscard]] const Parameter *find(std::string_view name) const;
};

/// The values of one section of stride.toml.
class SetupParameters final : public ParameterValues {
public:
  SetupParameters() = default;
  /// The rows must live as long as this. `cycleSeconds`: of the task that serves the device.
  explicit SetupParameters(const SectionRows &rows, double cycleSeconds = 0)
      : rows_(rows), cycleSeconds_(cycleSeconds) {}

  void add(SetupParameter parameter) { list_.push_back(std::move(parameter)); }

  /// Whether stride.toml gives it.
  [[nodiscard]] bool given(std::string_view name) const { return find(name) != nullptr; }
  /// What is given, else the default; 0 where there is none.
  [[nodiscard]] double number(std::string_view name) const override;
  /// Of a BOOL.
  [[nodiscard]] bool flag(std::string_view name) const { return number(name) != 0; }
  /// What is given, else the default; empty where there is none. Choices by name.
  [[nodiscard]] std::string text(std::string_view name) const;
  [[nodiscard]] double cycleSeconds() const override { return cycleSeconds_; }

private:
  [[nodiscard]] const SetupParameter *find(std::string_view name) const;

  SectionRows rows_;
  double cycleSeconds_ = 0;
  std::vector<SetupParameter> list_;
};

} // namespace stride::common

#endif
