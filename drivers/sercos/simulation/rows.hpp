// Short forms for the rows of data blocks.
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_ROWS_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_ROWS_HPP

#include "drivers/sercos/simulation/idn_list.hpp"

namespace stride::sercos::simulation::rows {

// When it can be written.
inline constexpr uint8_t kNever = protect::kAlways;
inline constexpr uint8_t kIn2 = protect::kPhase3 | protect::kPhase4;
inline constexpr uint8_t kIn23 = protect::kPhase4;
inline constexpr uint8_t kIn34 = protect::kPhase2;
inline constexpr uint8_t kIn4 = protect::kPhase2 | protect::kPhase3;
inline constexpr uint8_t kIn234 = 0;

constexpr Attribute of(uint8_t bytes, Display display, uint8_t protection, uint8_t decimals = 0) {
  return {.bytes = bytes, .display = display, .decimals = decimals, .protection = protection};
}
constexpr Attribute bits(uint8_t protection) { return of(2, Display::Binary, protection); }
constexpr Attribute number(uint8_t protection, uint8_t decimals = 0) {
  return of(2, Display::Unsigned, protection, decimals);
}
constexpr Attribute integer(uint8_t protection, uint8_t decimals = 0) {
  return of(2, Display::Signed, protection, decimals);
}
constexpr Attribute longNumber(uint8_t protection, uint8_t decimals = 0) {
  return of(4, Display::Unsigned, protection, decimals);
}
constexpr Attribute longInteger(uint8_t protection, uint8_t decimals = 0) {
  return of(4, Display::Signed, protection, decimals);
}
constexpr Attribute idnNumber(uint8_t protection) { return of(2, Display::Idn, protection); }
constexpr Attribute command(uint8_t protection) {
  return {.bytes = 2, .command = true, .display = Display::Binary, .protection = protection};
}
constexpr Attribute idnList(uint8_t protection) {
  return {.bytes = 2, .list = true, .display = Display::Idn, .protection = protection};
}
constexpr Attribute text(uint8_t protection) {
  return {.bytes = 1, .list = true, .display = Display::Text, .protection = protection};
}

} // namespace stride::sercos::simulation::rows

#endif
