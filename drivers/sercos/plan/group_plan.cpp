#include "drivers/sercos/plan/group_plan.hpp"

#include "drivers/sercos/protocol/words.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>

namespace stride::sercos {
namespace {

constexpr uint32_t kUsualMegabits = 2;
constexpr double kLongestCycle = 4e9; // µs
constexpr double kKilo = 1000;

/// wParam1 is in MBit/s and goes before BaudRate, which is in kBit/s.
uint32_t megabitsOf(const bus::SetupParameters &given) {
  const auto word = static_cast<uint32_t>(given.number("wParam1"));
  if (word != 0)
    return word;
  const auto rate = static_cast<uint32_t>(given.number("BaudRate") / kKilo);
  return rate == 0 ? kUsualMegabits : rate;
}

std::string milliseconds(uint32_t us) {
  if (us % 1000 != 0)
    return std::to_string(us) + " us";
  return std::to_string(us / 1000) + " ms";
}

/// Why a drive cannot be started at all.
std::string faultOf(const DriveSettings &settings, uint32_t id, const bus::GroupSetup &setup) {
  if (id == kNoAddress || id > kLastAddress)
    return "wDriveId is its address on the ring: 1 to 254";
  if (std::count_if(setup.drives.begin(), setup.drives.end(),
                    [id](const bus::DriveSetup &drive) { return drive.id == id; }) > 1)
    return "another drive has the same wDriveId";
  return settings.errors.empty() ? std::string() : settings.errors.front();
}

std::string ringFault(const GroupPlan &plan, size_t drives) {
  if (!isBaudRate(plan.megabits))
    return "a Sercos ring has 2, 4, 8 or 16 MBit/s, and wParam1 says " +
           std::to_string(plan.megabits);
  if (!isCycle(plan.cycle))
    return "a Sercos ring has a cycle of 62, 125, 250 or 500 us or of 1 to 65 whole milliseconds, "
           "and that of the task is " +
           milliseconds(plan.cycle);
  if (drives > kLastAddress)
    return "a Sercos ring has 254 drives at most";
  if (plan.timing.fits)
    return {};
  return "the telegrams need " + std::to_string(plan.timing.neededUs) + " us of the cycle of " +
         milliseconds(plan.cycle) + " at " + std::to_string(plan.megabits) + " MBit/s";
}

EncoderPlan encoderPlan(const bus::GroupSetup &setup, const bus::EncoderSetup &encoder) {
  const std::string name = common::lowerCase(encoder.parameters.text("second_of"));
  const auto drive =
      std::find_if(setup.drives.begin(), setup.drives.end(), [&name](const bus::DriveSetup &one) {
        return common::lowerCase(one.name) == name;
      });
  EncoderPlan plan;
  plan.drive = static_cast<size_t>(drive - setup.drives.begin());
  if (name.empty())
    plan.fault = "on a Sercos ring it is the second encoder of a drive (`second_of`)";
  else if (drive == setup.drives.end())
    plan.fault = "its drive is not in this axis group";
  else if (drive->parameters.text("device_type") == "io")
    plan.fault = "its drive is an I/O device";
  return plan;
}

} // namespace

GroupPlan planGroup(const bus::GroupSetup &setup) {
  GroupPlan plan;
  for (const bus::EncoderSetup &encoder : setup.encoders)
    plan.encoders.push_back(encoderPlan(setup, encoder));
  plan.megabits = megabitsOf(setup.parameters);
  plan.cycle =
      static_cast<uint32_t>(std::clamp(setup.cycleSeconds * 1e6 + 0.5, 1.0, kLongestCycle));
  plan.light = static_cast<uint32_t>(setup.parameters.number("wParam2"));
  if (plan.light == 0)
    plan.light = static_cast<uint32_t>(setup.parameters.number("LedBrightness"));
  std::vector<DriveTiming> timings;
  for (const bus::DriveSetup &drive : setup.drives) {
    const size_t place = plan.drives.size();
    const bool second =
        std::any_of(plan.encoders.begin(), plan.encoders.end(), [place](const EncoderPlan &one) {
          return one.fault.empty() && one.drive == place;
        });
    plan.drives.push_back(driveSettings(drive.parameters, second));
    const DriveSettings &settings = plan.drives.back();
    plan.faults.push_back(faultOf(settings, drive.id, setup));
    DriveTiming timing;
    timing.atBytes = settings.cyclic.at.bytes();
    timing.mdtBytes = settings.cyclic.mdt.bytes();
    timings.push_back(timing);
  }
  std::vector<DriveSlot> slots(timings.size());
  if (isBaudRate(plan.megabits))
    plan.timing = planRing(timings, plan.megabits, plan.cycle, slots);
  plan.fault = ringFault(plan, setup.drives.size());
  return plan;
}

void checkGroup(const bus::GroupSetup &setup, bus::GroupFindings &findings) {
  const GroupPlan plan = planGroup(setup);
  for (size_t i = 0; i < plan.drives.size(); ++i) {
    const std::string drive = "drive `" + setup.drives[i].name + "`";
    const std::vector<std::string> &errors = plan.drives[i].errors;
    for (const std::string &error : errors)
      findings.push_back({true, i, drive + ": " + error, "cannot be served", ""});
    if (!plan.faults[i].empty() && errors.empty())
      findings.push_back({true, i, drive + " cannot be on a Sercos ring so: " + plan.faults[i],
                          "cannot be served", ""});
    if (setup.drives[i].parameters.flag("bHWLimitEnable"))
      findings.push_back({false, i,
                          drive + ": a Sercos drive tells no limit switches, so `bHWLimitEnable` "
                                  "sees none",
                          "served without it", "the drive itself stops at its limit switches"});
  }
  for (size_t i = 0; i < plan.encoders.size(); ++i)
    if (!plan.encoders[i].fault.empty())
      findings.push_back({true, bus::GroupFinding::kGroup,
                          "encoder `" + setup.encoders[i].name +
                              "` cannot be on a Sercos ring so: " + plan.encoders[i].fault,
                          "its encoder cannot be served", ""});
  if (plan.fault.empty())
    return;
  const bool slow = isBaudRate(plan.megabits) && isCycle(plan.cycle) && !plan.timing.fits;
  std::string help;
  if (slow && plan.timing.shortestCycle != 0)
    help = "take a cycle of " + milliseconds(plan.timing.shortestCycle) +
           " or longer, a higher baud rate (wParam1), or part the drives between two rings";
  findings.push_back(
      {true, bus::GroupFinding::kGroup, plan.fault, slow ? "do not fit" : "is none of them", help});
}

} // namespace stride::sercos
