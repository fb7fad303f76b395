// The classes of the Pack Profile of Sercos II, as far as they are public.
#ifndef STRIDE_DRIVERS_SERCOS_PROTOCOL_PACK_PROFILE_HPP
#define STRIDE_DRIVERS_SERCOS_PROTOCOL_PACK_PROFILE_HPP

#include "drivers/sercos/protocol/idn.hpp"

#include <cstdint>
#include <span>

namespace stride::sercos {

/// What is public is a description in words: BasicA takes positions, BasicB velocities, both by
/// standard telegrams; Extended also torques, by telegrams that are put together, with homing and
/// probing. The lists of the specification are not public: these here hold the IDNs without which
/// a drive cannot do what the description says.
enum class PackProfile : uint8_t { None, BasicA, BasicB, Extended };

/// The IDNs that a drive of that class has to have, the lowest first.
std::span<const Idn> packProfileIdns(PackProfile profile);

} // namespace stride::sercos

#endif
