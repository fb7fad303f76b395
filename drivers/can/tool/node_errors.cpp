#include "drivers/can/tool/node_errors.hpp"

#include "drivers/can/master/emcy.hpp"
#include "drivers/can/tool/tool_support.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stride::can::tool {
namespace {

constexpr uint64_t kMost = 8; ///< Errors that are shown.

std::string errorLine(uint64_t place, uint64_t entry) {
  const auto code = static_cast<uint16_t>(entry);
  std::string line = fmt::format("1003h:{}  {:04X}h  {}", place, code, errorText(code));
  if (const uint64_t maker = entry >> 16U; maker != 0)
    line += fmt::format(" (of its maker: {:04X}h)", maker);
  return line;
}

} // namespace

std::vector<std::string> errorLines(const ReadObject &read) {
  const Transfer state = read(object::kErrorRegister);
  const uint64_t bits = state.done ? numberOf(state.bytes) : 0;
  if (bits == 0)
    return {};
  std::vector<std::string> lines = {fmt::format("error register (1001h) {:02X}h", bits)};
  const Transfer number = read({object::kErrorField, 0});
  if (!number.done)
    return lines;
  const uint64_t count = numberOf(number.bytes);
  for (uint64_t place = 1; place <= std::min(count, kMost); ++place) {
    const Transfer entry = read({object::kErrorField, static_cast<uint8_t>(place)});
    if (!entry.done)
      break;
    lines.push_back(errorLine(place, numberOf(entry.bytes)));
  }
  if (count > kMost)
    lines.push_back(fmt::format("and {} older ones", count - kMost));
  return lines;
}

} // namespace stride::can::tool
