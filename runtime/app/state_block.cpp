#include "runtime/app/state_block.hpp"

#include <array>
#include <bit>

namespace stride::app {

namespace {

constexpr auto kBases = [] {
  std::array<uint64_t, kFourGiB / kPartOfLowMemory - 1> bases{};
  for (size_t i = 0; i < bases.size(); ++i)
    bases[i] = (i + 1) * kPartOfLowMemory;
  return bases;
}();

} // namespace

StateBlock::StateBlock(size_t size) : memory_(size, kBases, "the application's state") {}

bool StateBlock::belowFourGiB() const {
  return std::bit_cast<uint64_t>(data()) + size() <= kFourGiB;
}

} // namespace stride::app
