#include "drivers/can/plan/group_plan.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>

namespace stride::can {
namespace {

constexpr uint32_t kUsualBitRate = 1000;
constexpr double kLongestCycle = 4e9; // µs

/// What a drive of that section exchanges in every cycle.
DriveWish driveWish(uint32_t node, const bus::SetupParameters &given,
                    const DriveSettings &settings) {
  DriveWish wish;
  wish.axis = static_cast<uint8_t>(given.number("axis"));
  wish.node = node <= kLastNode ? static_cast<uint8_t>(node) : uint8_t{0};
  wish.controlType = static_cast<uint8_t>(given.number("wControlType"));
  for (size_t i = 0; i < wish.send.size(); ++i) {
    const std::string place = std::to_string(i + 1);
    wish.send[i] = static_cast<uint16_t>(given.number("wCyclicDataS" + place));
    wish.receive[i] = static_cast<uint16_t>(given.number("wCyclicDataR" + place));
  }
  wish.modeInPdo = given.flag("mode_pdo");
  wish.eventPdos = given.flag("event_pdos");
  wish.inputs = given.flag("inputs");
  wish.probeInputs = static_cast<uint8_t>(given.number("probe_inputs"));
  wish.rpdos = settings.rpdos;
  wish.tpdos = settings.tpdos;
  return wish;
}

/// Its file with parameters is the data sheet of a device.
bool isDataSheet(const bus::DriveSetup &drive) {
  const std::string name = common::lowerCase(drive.parameters.text("parameters"));
  for (const std::string_view ending : {".dcf", ".eds", ".xdd", ".xdc"})
    if (name.ends_with(ending))
      return true;
  return false;
}

constexpr std::array kIdentityKeys = {"identity.vendor", "identity.product", "identity.revision",
                                      "identity.serial"};

/// It is found by its identity.
bool byLss(const bus::SetupParameters &node) { return node.number("lss") != 0; }

/// Why a node cannot be found by its identity.
std::string lssFault(const bus::SetupParameters &node, const bus::GroupSetup &setup) {
  if (!byLss(node))
    return {};
  for (const char *const key : kIdentityKeys)
    if (!node.given(key))
      return "`lss` finds it by its identity: `identity` needs `vendor`, `product`, `revision` and "
             "`serial`";
  const auto isSame = [&node](const auto &other) {
    return byLss(other.parameters) &&
           std::all_of(kIdentityKeys.begin(), kIdentityKeys.end(), [&](const char *key) {
             return other.parameters.number(key) == node.number(key);
           });
  };
  ptrdiff_t same = 0; // the axes of a device have one identity
  for (size_t i = 0; i < setup.drives.size(); ++i)
    same += deviceOf(setup, i) == i && isSame(setup.drives[i]) ? 1 : 0;
  same += std::count_if(setup.encoders.begin(), setup.encoders.end(), isSame) +
          std::count_if(setup.ios.begin(), setup.ios.end(), isSame);
  return same > 1 ? "`lss` finds it by its identity, and another node has the same one" : "";
}

/// What is of the device and not of an axis, which of its drives may say it.
constexpr std::array kDeviceKeys = {"reset", "guard", "lss", "pdo_timeout"};

/// What the axes of a device say differently.
std::string deviceFault(const bus::GroupSetup &setup, size_t drive) {
  const size_t first = deviceOf(setup, drive);
  const bus::SetupParameters &given = setup.drives[drive].parameters;
  const bus::SetupParameters &others = setup.drives[first].parameters;
  const auto differs = [&](const char *key) {
    return given.given(key) && given.number(key) != others.number(key);
  };
  std::string key;
  for (const char *const one : kDeviceKeys)
    if (differs(one))
      key = one;
  for (const char *const one : kIdentityKeys)
    if (differs(one))
      key = one;
  if (key.empty())
    return {};
  return "`" + key + "` is of the whole device: it belongs to drive `" + setup.drives[first].name +
         "`, which is its first one here";
}

/// Why the node of a drive cannot be what the configuration says.
std::string nodeFault(const bus::GroupSetup &setup, size_t drive, bool hasSyncDevice) {
  const uint32_t id = setup.drives[drive].id;
  if (id == 0 || id > kLastNode)
    return "wDriveId is its node id: 1 to 127";
  const auto own = static_cast<uint32_t>(setup.busParameters.number("node_id"));
  if (id == own)
    return "its node id is the master's own (node_id)";
  if (hasSyncDevice && id == kSyncDevice)
    return "its node id is that of the SYNC device";
  const uint8_t axis = axisOfDrive(setup.drives[drive]);
  if (std::count_if(setup.drives.begin(), setup.drives.end(), [&](const bus::DriveSetup &one) {
        return one.id == id && axisOfDrive(one) == axis;
      }) > 1)
    return "another drive has the same wDriveId: drives of one device differ in `axis`";
  if (deviceOf(setup, drive) != drive)
    return deviceFault(setup, drive);
  return lssFault(setup.drives[drive].parameters, setup);
}

/// Why a drive cannot be started at all.
std::string faultOf(const PlanResult &plan, const DriveSettings &settings, size_t drive,
                    const bus::GroupSetup &setup, bool hasSyncDevice) {
  if (std::string fault = nodeFault(setup, drive, hasSyncDevice); !fault.empty())
    return fault;
  if (!settings.errors.empty())
    return settings.errors.front();
  if (isDataSheet(setup.drives[drive]))
    return "`parameters` is a file of SMC_WriteDriveParamsToFile; of a DCF, `stride can import` "
           "makes "
           "`startup`";
  for (const PlanNote note : plan.notes)
    if (isError(note))
      return std::string(describe(note));
  return {};
}

void checkLoad(const GroupPlan &plan, bus::GroupFindings &findings) {
  if (plan.load.comfortable() || (plan.drives.empty() && plan.ios.empty()))
    return;
  bus::GroupFinding finding;
  finding.isError = !plan.load.fits();
  finding.message = std::string(plan.ios.empty() ? "the drives" : "the nodes") + " need " +
                    percent(plan.load.share) + " of the bus: " + std::to_string(plan.load.bits) +
                    " bits in each cycle of " + milliseconds(plan.cycle) + " at " +
                    std::to_string(plan.bitRate) + " kBit/s";
  finding.label =
      finding.isError ? "does not fit" : "more than 80 %: parameters and emergencies wait";
  finding.help = "take a cycle of " + milliseconds(plan.load.shortestCycle) +
                 " or longer, a higher `BaudRate`, or part the drives between two buses; "
                 "`stride can plan` shows what each of them needs";
  findings.push_back(std::move(finding));
}

} // namespace

uint8_t axisOfDrive(const bus::DriveSetup &drive) {
  return static_cast<uint8_t>(drive.parameters.number("axis"));
}

size_t deviceOf(const bus::GroupSetup &setup, size_t drive) {
  const auto first =
      std::find_if(setup.drives.begin(), setup.drives.end(),
                   [&](const bus::DriveSetup &one) { return one.id == setup.drives[drive].id; });
  return static_cast<size_t>(first - setup.drives.begin());
}

size_t driveNamed(const bus::GroupSetup &setup, std::string_view name) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  const auto found =
      std::find_if(setup.drives.begin(), setup.drives.end(), [&](const bus::DriveSetup &drive) {
        return std::equal(drive.name.begin(), drive.name.end(), name.begin(), name.end(),
                          [&](char a, char b) { return lower(a) == lower(b); });
      });
  return static_cast<size_t>(found - setup.drives.begin());
}

std::string milliseconds(uint32_t us) {
  std::string text = std::to_string(us / 1000);
  if (us % 1000 != 0) {
    std::string part = std::to_string(us % 1000 + 1000).substr(1);
    part.erase(part.find_last_not_of('0') + 1);
    text += "." + part;
  }
  return text + " ms";
}

std::string percent(double share) {
  const double tenths = std::min(share, 1e6) * 1000 + 0.5;
  const auto whole = static_cast<uint64_t>(tenths);
  return std::to_string(whole / 10) + "." + std::to_string(whole % 10) + " %";
}

namespace {

/// Why an encoder that is a node cannot be read.
std::string encoderFault(uint32_t id, const bus::GroupSetup &setup, bool hasSyncDevice) {
  if (id == 0 || id > kLastNode)
    return "wEncoderId is its node id: 1 to 127";
  if (id == static_cast<uint32_t>(setup.busParameters.number("node_id")))
    return "its node id is the master's own (node_id)";
  if (hasSyncDevice && id == kSyncDevice)
    return "its node id is that of the SYNC device";
  if (std::any_of(setup.drives.begin(), setup.drives.end(),
                  [id](const bus::DriveSetup &drive) { return drive.id == id; }))
    return "a drive has its node id";
  if (std::count_if(setup.encoders.begin(), setup.encoders.end(),
                    [id](const bus::EncoderSetup &one) {
                      return one.id == id && one.parameters.text("second_of").empty();
                    }) > 1)
    return "another encoder has the same wEncoderId";
  return {};
}

/// PDOs of its own, and what it is given at start-up.
void takeEncoderSettings(const bus::EncoderSetup &encoder, EncoderPlan &plan) {
  const auto node = static_cast<uint8_t>(encoder.id);
  DriveSettings settings = driveSettings(node, encoder.parameters);
  if (!settings.errors.empty()) {
    plan.fault = settings.errors.front();
    return;
  }
  plan.plan = planEncoder(node, settings.tpdos);
  plan.startup = std::move(settings.startup);
  if (!plan.plan.carries(Signal::EncoderPosition)) {
    plan.fault = "none of its own TPDOs has the position (6004h)";
    plan.plan = {};
  }
}

/// The PDOs of a drive's second encoder are the drive's.
std::string secondEncoderFault(const bus::EncoderSetup &encoder) {
  for (size_t number = 1; number <= DrivePlan::kMostPdos; ++number)
    if (const std::string table = "tpdo" + std::to_string(number);
        encoder.parameters.given(table + ".map"))
      return "it is the second encoder of a drive, which has its PDOs: `" + table +
             "` belongs into the section of the drive";
  return {};
}

std::vector<EncoderPlan> planEncoders(const bus::GroupSetup &setup, SyncProducer sync) {
  std::vector<EncoderPlan> encoders;
  for (const bus::EncoderSetup &encoder : setup.encoders) {
    EncoderPlan &one = encoders.emplace_back();
    if (const std::string drive = encoder.parameters.text("second_of"); !drive.empty()) {
      one.drive = driveNamed(setup, drive);
      if (one.drive == setup.drives.size())
        one.fault = "its drive is not in this axis group";
      else
        one.fault = secondEncoderFault(encoder);
      continue;
    }
    one.fault = encoderFault(encoder.id, setup, sync == SyncProducer::Device);
    if (one.fault.empty())
      one.fault = lssFault(encoder.parameters, setup);
    if (one.fault.empty())
      takeEncoderSettings(encoder, one);
  }
  return encoders;
}

/// A drive or an encoder that is a node has that number.
bool isTaken(uint32_t id, const bus::GroupSetup &setup) {
  return std::any_of(setup.drives.begin(), setup.drives.end(),
                     [id](const bus::DriveSetup &one) { return one.id == id; }) ||
         std::any_of(setup.encoders.begin(), setup.encoders.end(),
                     [id](const bus::EncoderSetup &one) {
                       return one.id == id && one.parameters.text("second_of").empty();
                     });
}

std::string ioFault(uint32_t id, const bus::GroupSetup &setup, bool hasSyncDevice) {
  if (id == static_cast<uint32_t>(setup.busParameters.number("node_id")))
    return "its node id is the master's own (node_id)";
  if (hasSyncDevice && id == kSyncDevice)
    return "its node id is that of the SYNC device";
  if (isTaken(id, setup))
    return "a drive or an encoder has its node id";
  if (std::count_if(setup.ios.begin(), setup.ios.end(), [id](const bus::IoSetup &one) {
        return static_cast<uint32_t>(one.parameters.number("node")) == id;
      }) > 1)
    return "another I/O device has the same `node`";
  return {};
}

std::vector<IoPlan> planIos(const bus::GroupSetup &setup, SyncProducer sync) {
  std::vector<IoPlan> ios;
  for (const bus::IoSetup &io : setup.ios) {
    IoPlan &one = ios.emplace_back(planIo(io));
    if (one.fault.empty())
      one.fault = ioFault(one.plan.node, setup, sync == SyncProducer::Device);
    if (one.fault.empty())
      one.fault = lssFault(io.parameters, setup);
    if (!one.fault.empty())
      one.plan = {};
  }
  return ios;
}

void checkIos(const bus::GroupSetup &setup, const GroupPlan &plan, bus::GroupFindings &findings) {
  for (size_t i = 0; i < plan.ios.size(); ++i) {
    const IoPlan &io = plan.ios[i];
    const std::string name = "I/O device `" + setup.ios[i].name + "`";
    if (!io.fault.empty()) {
      bus::GroupFinding finding{true, bus::GroupFinding::kGroup,
                                name + " cannot be on a CAN bus so: " + io.fault,
                                "cannot be served", ""};
      finding.io = i;
      findings.push_back(std::move(finding));
    }
    for (const uint32_t output : io.untold) {
      const std::string number = std::to_string(output);
      bus::GroupFinding finding{false, bus::GroupFinding::kGroup,
                                name + ": analog output " + number +
                                    " has a safe value, but none for when the controller is lost",
                                "has it only as long as the controller tells it",
                                "write it as the device has it: `startup = [\"6443h:" + number +
                                    " := USINT#1\", \"6444h:" + number + " := DINT#…\"]`"};
      finding.io = i;
      findings.push_back(std::move(finding));
    }
  }
}

void checkReadWait(const bus::GroupSetup &setup, bus::GroupFindings &findings) {
  const double wait = setup.busParameters.number("read_wait");
  if (!(wait >= setup.cycleSeconds) || setup.cycleSeconds <= 0)
    return;
  findings.push_back({true, bus::GroupFinding::kGroup,
                      "`read_wait` leaves no time of the cycle for the programs",
                      "its task has a cycle of " +
                          milliseconds(static_cast<uint32_t>(setup.cycleSeconds * 1e6 + 0.5)),
                      "take half of the cycle at most"});
}

void checkEncoders(const bus::GroupSetup &setup, const GroupPlan &plan,
                   bus::GroupFindings &findings) {
  for (size_t i = 0; i < plan.encoders.size(); ++i)
    if (!plan.encoders[i].fault.empty())
      findings.push_back({true, bus::GroupFinding::kGroup,
                          "encoder `" + setup.encoders[i].name +
                              "` cannot be on a CAN bus so: " + plan.encoders[i].fault,
                          "its encoder cannot be served", ""});
}

} // namespace

uint32_t bitRateOf(const bus::GroupSetup &setup) {
  const auto rate = static_cast<uint32_t>(setup.parameters.number("BaudRate"));
  return rate == 0 ? kUsualBitRate : rate;
}

GroupPlan planGroup(const bus::GroupSetup &setup) {
  GroupPlan result;
  result.sync =
      static_cast<SyncProducer>(static_cast<int>(setup.parameters.number("SyncProducer")));
  result.bitRate = bitRateOf(setup);
  result.cycle =
      static_cast<uint32_t>(std::clamp(setup.cycleSeconds * 1e6 + 0.5, 1.0, kLongestCycle));
  result.encoders = planEncoders(setup, result.sync);
  result.ios = planIos(setup, result.sync);
  std::vector<DrivePlan> plans;
  for (const IoPlan &io : result.ios)
    if (io.fault.empty())
      plans.push_back(io.plan);
  for (const EncoderPlan &encoder : result.encoders)
    if (encoder.plan.node != 0)
      plans.push_back(encoder.plan);
  for (const bus::DriveSetup &drive : setup.drives) {
    const auto node = static_cast<uint8_t>(std::min<uint32_t>(drive.id, kLastNode));
    result.settings.push_back(driveSettings(node, drive.parameters, axisOfDrive(drive)));
    const DriveSettings &settings = result.settings.back();
    DriveWish wish = driveWish(drive.id, drive.parameters, settings);
    const size_t place = result.drives.size();
    wish.secondEncoder =
        std::any_of(result.encoders.begin(), result.encoders.end(),
                    [place](const EncoderPlan &encoder) { return encoder.drive == place; });
    result.drives.push_back(planDrive(wish));
    result.faults.push_back(
        faultOf(result.drives.back(), settings, place, setup, result.sync == SyncProducer::Device));
  }
  addCobIds(setup, result);
  for (size_t i = 0; i < result.drives.size(); ++i)
    if (result.faults[i].empty())
      plans.push_back(result.drives[i].plan);
  result.load = busLoad(plans, result.bitRate, result.cycle);
  return result;
}

void checkGroup(const bus::GroupSetup &setup, bus::GroupFindings &findings) {
  const GroupPlan plan = planGroup(setup);
  for (size_t i = 0; i < plan.drives.size(); ++i) {
    const std::string drive = "drive `" + setup.drives[i].name + "`";
    const std::vector<std::string> &errors = plan.settings[i].errors;
    for (const std::string &error : errors)
      findings.push_back({true, i, drive + ": " + error, "cannot be served", ""});
    if (!plan.faults[i].empty() && errors.empty())
      findings.push_back({true, i, drive + " cannot be on a CAN bus so: " + plan.faults[i],
                          "cannot be served", ""});
    if (!plan.faults[i].empty())
      continue;
    for (const PlanNote note : plan.drives[i].notes)
      findings.push_back(
          {false, i, drive + ": " + std::string(describe(note)), "served without it", ""});
  }
  checkEncoders(setup, plan, findings);
  checkIos(setup, plan, findings);
  checkReadWait(setup, findings);
  checkLoad(plan, findings);
}

} // namespace stride::can
