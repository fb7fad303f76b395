#include "drivers/sercos/sercos_setup.hpp"

#include "drivers/sercos/parameter_file.hpp"
#include "drivers/sercos/plan/group_plan.hpp"
#include "drivers/sercos/schema.hpp"
#include "runtime/common/folder_file.hpp"

#include <algorithm>
#include <optional>

namespace stride::sercos {
namespace {

constexpr uint32_t kFullLight = 100; // %

DriveConfig driveConfig(const bus::DriveSetup &drive, const DriveSettings &settings, double cycle) {
  const bus::SetupParameters &given = drive.parameters;
  DriveConfig config;
  config.address = static_cast<uint8_t>(drive.id);
  config.cycle = cycle;
  config.settings = settings;
  config.rotary = given.number("iMovementType") == static_cast<double>(bus::plc::kRotary);
  config.period = given.number("fPositionPeriod") * given.number("dwRatioTechUnitsDenom") /
                  given.number("iRatioTechUnitsNum");
  config.torqueRated = given.number("torque_rated");
  config.homesItself = given.number("homing") == static_cast<double>(kHomesItself);
  config.probeInputs = static_cast<uint8_t>(given.number("probe_inputs"));
  config.serviceTimeout = static_cast<uint32_t>(given.number("service_timeout"));
  config.commandTimeout = cyclesOf(given.number("command_timeout"), cycle);
  config.powerTimeout = cyclesOf(given.number("power_timeout"), cycle);
  config.modeTimeout = cyclesOf(given.number("mode_timeout"), cycle);
  return config;
}

/// Without what the driver writes itself, and what is locked.
std::string readFile(const std::string &folder, const std::string &name, DriveConfig &config) {
  const std::optional<std::string> text = common::textOfFile(folder, name);
  if (!text)
    return "the file '" + name + "' of its parameters cannot be read";
  std::string error;
  if (!readParameterFile(*text, config.file, error))
    return "the file '" + name + "' of its parameters: " + error;
  const std::vector<Idn> &locked = config.settings.locked;
  std::erase_if(config.file, [&locked](const IdnValue &value) {
    return isOwnedByDriver(value.idn) ||
           std::find(locked.begin(), locked.end(), value.idn) != locked.end();
  });
  return {};
}

} // namespace

SercosSetup sercosSetup(const bus::GroupSetup &setup) {
  const GroupPlan plan = planGroup(setup);
  SercosSetup result;
  result.master.cycle = setup.cycleSeconds;
  result.master.megabits = plan.megabits;
  result.master.light =
      static_cast<uint8_t>(plan.light == 0 ? kFullLight : std::min(plan.light, kFullLight));
  for (size_t i = 0; i < setup.drives.size(); ++i) {
    DriveConfig config = driveConfig(setup.drives[i], plan.drives[i], setup.cycleSeconds);
    std::string fault = !plan.faults[i].empty() ? plan.faults[i] : plan.fault;
    const std::string file = setup.drives[i].parameters.text("parameters");
    if (fault.empty() && !file.empty() && setup.files)
      fault = readFile(*setup.files, file, config);
    result.master.drives.push_back(std::move(config));
    result.faults.push_back(std::move(fault));
  }
  for (const EncoderPlan &encoder : plan.encoders)
    result.encoders.push_back(encoder.fault.empty() ? encoder.drive : SercosSetup::kNoDrive);
  return result;
}

} // namespace stride::sercos
