#include "drivers/sercos/plan/profile_check.hpp"

#include "runtime/bus/plc_schema.hpp"

#include <array>

namespace stride::sercos {
namespace {

constexpr uint8_t kA = 1U << static_cast<unsigned>(PackProfile::BasicA);
constexpr uint8_t kB = 1U << static_cast<unsigned>(PackProfile::BasicB);
constexpr uint8_t kExtended = 1U << static_cast<unsigned>(PackProfile::Extended);
constexpr uint16_t kScalingKind = 0x0007;

constexpr std::array<ProfileDemand, 4> kDemands = {{
    {kA, idns::kPositionScaling, kScalingKind, 2, "positions are rotational"},
    {kA | kB, idns::kVelocityScaling, kScalingKind, 2, "velocities are rotational"},
    {kA | kB, idns::kVelocityScaling, 0x0030, 0, "velocities are in revolutions per minute"},
    {kA | kB | kExtended, idns::kTorqueScaling, kScalingKind, 0, "torques are in percent"},
}};

std::string idnName(Idn idn) {
  const IdnText text = idnText(idn);
  return {text.begin(), text.end()};
}

} // namespace

std::string_view nameOf(PackProfile profile) {
  constexpr std::array<std::string_view, 4> kNames = {"none", "BasicA", "BasicB", "Extended"};
  return kNames[static_cast<size_t>(profile)];
}

std::span<const ProfileDemand> profileDemands() { return kDemands; }

std::vector<std::string> profileFaults(PackProfile profile, const common::SetupParameters &given,
                                       const CyclicPlan &plan) {
  std::vector<std::string> faults;
  if (profile != PackProfile::BasicA && profile != PackProfile::BasicB)
    return faults;
  const std::string name = "PackProfile " + std::string(nameOf(profile));
  if (plan.telegramType == kApplicationTelegram)
    faults.push_back(name + " has standard telegrams only, without `additional` data and without "
                            "wControlType \"CONFIGURABLE\"");
  const bool position = plan.mdt.carries(idns::kPositionCommand);
  if (profile == PackProfile::BasicA && !(position && plan.at.carries(idns::kPositionFeedback1)))
    faults.push_back(name + " sends positions to the drive and gets them back");
  if (profile == PackProfile::BasicB && (position || !plan.mdt.carries(idns::kVelocityCommand)))
    faults.push_back(name + " sends velocities to the drive");
  if (given.number("iMovementType") != static_cast<double>(bus::plc::kRotary))
    faults.push_back(name + " is for rotary drives");
  return faults;
}

std::vector<std::string> profileFaults(PackProfile profile, std::span<const IdnValue> list) {
  std::vector<std::string> faults;
  for (const ProfileDemand &demand : kDemands) {
    if (!isOf(demand, profile))
      continue;
    for (const IdnValue &value : list)
      if (value.idn == demand.idn && value.numbers.size() == 1 &&
          (static_cast<uint64_t>(value.numbers[0]) & demand.mask) != demand.value)
        faults.push_back("PackProfile " + std::string(nameOf(profile)) + " is not met by `" +
                         idnName(value.idn) + "`: there " + std::string(demand.text));
  }
  return faults;
}

} // namespace stride::sercos
