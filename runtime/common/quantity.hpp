// What a variable is a value of, guessed from its name: for whoever shows it.
#ifndef STRIDE_RUNTIME_COMMON_QUANTITY_HPP
#define STRIDE_RUNTIME_COMMON_QUANTITY_HPP

#include <string>
#include <string_view>

namespace stride::common {

/// A quantity and its unit, in which `u` stands for the technical unit of an axis.
struct QuantityRule {
  std::string_view part; ///< of the name of the member, in lower case
  std::string_view title;
  std::string_view unit;
};

/// The rule for a path, by its last name: `Drive.fSetVelocity` is a velocity in u/s; null: none.
[[nodiscard]] const QuantityRule *findQuantity(std::string_view path);

/// `mm/s` of `u/s` and `mm`; units without `u` stay as they are.
[[nodiscard]] std::string inUnit(std::string_view unit, std::string_view technical);

} // namespace stride::common

#endif
