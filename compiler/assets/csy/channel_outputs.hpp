#ifndef STRIDE_COMPILER_ASSETS_CSY_CHANNEL_OUTPUTS_HPP
#define STRIDE_COMPILER_ASSETS_CSY_CHANNEL_OUTPUTS_HPP
// What a channel of a TSX CSY 85 has as outputs.

#include <cstdint>
#include <string>
#include <vector>

namespace stc {

/// The names of the outputs (%Q, %QD) of a channel, 0 to 31, in the order of the register map.
[[nodiscard]] std::vector<std::string> csyOutputsOf(uint32_t channel);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CSY_CHANNEL_OUTPUTS_HPP
