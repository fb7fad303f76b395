#include "runtime/common/quantity.hpp"

#include "runtime/common/text.hpp"

namespace stride::common {

namespace {

// In this order: `fSWMaxVelocity`, `fSetAcceleration`, `fSWLimitPositive` …
constexpr QuantityRule kRules[] = {
    {"jerk", "Jerk", "u/s³"},
    {"deceleration", "Acceleration", "u/s²"},
    {"acceleration", "Acceleration", "u/s²"},
    {"velocity", "Velocity", "u/s"},
    {"position", "Position", "u"},
    {"distance", "Distance", "u"},
    {"swlimit", "Position", "u"},
    {"torque", "Torque", "Nm"},
    {"current", "Current", "A"},
    {"taskcycle", "Time", "s"},
};

} // namespace

const QuantityRule *findQuantity(std::string_view path) {
  const size_t dot = path.rfind('.');
  const std::string name = lowerCase(dot == std::string_view::npos ? path : path.substr(dot + 1));
  for (const QuantityRule &rule : kRules)
    if (name.find(rule.part) != std::string::npos)
      return &rule;
  return nullptr;
}

std::string inUnit(std::string_view unit, std::string_view technical) {
  const bool isTechnical = unit == "u" || unit.starts_with("u/");
  return isTechnical && !technical.empty() ? std::string(technical) + std::string(unit.substr(1))
                                           : std::string(unit);
}

} // namespace stride::common
