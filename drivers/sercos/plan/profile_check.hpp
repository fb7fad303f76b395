// What a class of the Pack Profile demands of configuration and values, as far as it is public.
#ifndef STRIDE_DRIVERS_SERCOS_PLAN_PROFILE_CHECK_HPP
#define STRIDE_DRIVERS_SERCOS_PLAN_PROFILE_CHECK_HPP

#include "drivers/sercos/plan/cyclic_plan.hpp"
#include "drivers/sercos/plan/idn_value.hpp"
#include "drivers/sercos/protocol/pack_profile.hpp"
#include "runtime/common/setup_parameters.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stride::sercos {

std::string_view nameOf(PackProfile profile);

/// An IDN whose bits under `mask` must be `value`. [sercos.com: Basic Pack Profile, Extended Pack
/// Profile]
struct ProfileDemand {
  uint8_t profiles; ///< Bit n: of profile n.
  Idn idn;
  uint16_t mask;
  uint16_t value;
  std::string_view text; ///< What that means.
};
std::span<const ProfileDemand> profileDemands();
constexpr bool isOf(const ProfileDemand &demand, PackProfile profile) {
  return (demand.profiles >> static_cast<unsigned>(profile) & 1U) != 0;
}

/// What of a section of stride.toml does not go with its profile, one sentence each: telegrams, the
/// kind of axis.
std::vector<std::string> profileFaults(PackProfile profile, const common::SetupParameters &given,
                                       const CyclicPlan &plan);

/// The same of a list of parameters.
std::vector<std::string> profileFaults(PackProfile profile, std::span<const IdnValue> list);

} // namespace stride::sercos

#endif
