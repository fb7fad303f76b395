#ifndef STRIDE_COMPILER_ASSETS_CSY_FIRMWARE_HPP
#define STRIDE_COMPILER_ASSETS_CSY_FIRMWARE_HPP
// `firmware` of [[csy]] and of path files: how many reference points a path may have.

#include "runtime/common/parameter.hpp"
#include "runtime/numeric/csy/trajectory_table.hpp"

#include <array>

namespace stc {

inline constexpr std::array<stride::common::Choice, 2> kCsyFirmwares = {
    {{"1.1", stride::csy::kMostPointsOfOldFirmware}, {"1.2", stride::csy::kMostPoints}}};
/// Its value is the number of points.
inline constexpr stride::common::Parameter kCsyFirmware =
    stride::common::choice("firmware", kCsyFirmwares).defaultsTo(stride::csy::kMostPoints);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CSY_FIRMWARE_HPP
