#include "compiler/assets/csy/channel_outputs.hpp"

#include "runtime/numeric/csy/register_map.hpp"

namespace stc {

namespace csy = stride::csy;

std::vector<std::string> csyOutputsOf(uint32_t channel) {
  std::vector<std::string> names;
  csy::Register found{};
  for (size_t i = 0; csy::registerAt(csy::kindOfChannel(channel), i, found); ++i)
    if (found.row->area == csy::RegisterArea::Output)
      names.emplace_back(found.symbol);
  return names;
}

} // namespace stc
