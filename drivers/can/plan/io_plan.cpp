#include "drivers/can/plan/io_plan.hpp"

#include "drivers/can/plan/drive_settings.hpp"

#include <algorithm>
#include <cmath>

namespace stride::can {
namespace {

constexpr uint32_t kAnalogBytes = 2;
constexpr uint32_t kAnalogPerPdo = 4;
constexpr uint16_t kIoEventTimer = 100; // ms

IoSide sideOf(const bus::IoSetup &io, uint32_t bytes, const std::string &direction) {
  IoSide side;
  side.bytes = bytes;
  side.analog = static_cast<uint32_t>(io.parameters.number("analog_" + direction));
  const uint32_t values = kAnalogBytes * side.analog;
  side.digital = io.parameters.given("digital_" + direction)
                     ? static_cast<uint32_t>(io.parameters.number("digital_" + direction))
                     : bytes - std::min(bytes, values);
  return side;
}

std::string faultOf(const IoSide &side, const std::string &direction) {
  if (side.digital + kAnalogBytes * side.analog > side.bytes)
    return "its `" + direction + "` have room for " + std::to_string(side.bytes) + " bytes, and " +
           std::to_string(side.digital + kAnalogBytes * side.analog) + " are needed";
  if (side.digital > IoSide::kMostDigital)
    return "it can have 8 bytes of digital " + direction + ", and analog ones besides them";
  return {};
}

/// The PDOs of one direction: digital ones in the first, analog ones in the next three.
struct IoDirection {
  const IoSide &side;
  uint16_t digital; ///< Object of the digital bytes …
  uint16_t analog;  ///< … and of the analog values.
  uint16_t cobIdBase;
  uint8_t transmission;
  uint16_t inhibit;
  uint16_t eventTimer;
};

Pdo pdoOf(const IoDirection &direction, uint8_t node, uint8_t number, uint16_t index,
          uint32_t first, uint32_t count, uint8_t bits) {
  Pdo pdo;
  pdo.number = number;
  pdo.cobId = static_cast<uint16_t>(direction.cobIdBase + (number - 1) * kNextPdo + node);
  pdo.transmission = direction.transmission;
  pdo.inhibit = direction.inhibit;
  pdo.eventTimer = direction.eventTimer;
  for (uint32_t i = 0; i < count; ++i)
    pdo.entries[pdo.count++] = {{index, static_cast<uint8_t>(first + i + 1)}, bits};
  return pdo;
}

void addPdos(const IoDirection &direction, uint8_t node,
             std::array<Pdo, DrivePlan::kMostPdos> &pdos, uint8_t &count,
             std::array<uint16_t, DrivePlan::kMostPdos> &at) {
  constexpr uint8_t kByte = 8;
  constexpr uint8_t kWord = 16;
  const IoSide &side = direction.side;
  uint8_t number = 1;
  if (side.digital > 0)
    pdos[count++] = pdoOf(direction, node, number, direction.digital, 0, side.digital, kByte);
  for (uint32_t first = 0; first < side.analog; first += kAnalogPerPdo) {
    ++number;
    const uint32_t values = std::min(side.analog - first, kAnalogPerPdo);
    at[count] = static_cast<uint16_t>(side.analogAt() + kAnalogBytes * first);
    pdos[count++] = pdoOf(direction, node, number, direction.analog, first, values, kWord);
  }
}

uint32_t safeByte(const bus::IoSetup &io, uint32_t place) {
  return place < io.safeOutputs.size() ? io.safeOutputs[place] : 0;
}

/// What outputs become in a node that has lost its master. A device may lack these objects.
void addErrorValues(const bus::IoSetup &io, IoPlan &plan, const std::vector<SdoWrite> &given) {
  constexpr uint32_t kAllBits = 0xFF;
  const auto write = [&](uint16_t index, uint32_t place, uint8_t size, uint32_t value) {
    plan.startup.push_back({{index, static_cast<uint8_t>(place + 1)}, size, value, true});
  };
  for (uint32_t i = 0; i < plan.outputs.digital; ++i) {
    write(object::kOutputErrorMode, i, 1, kAllBits);
    write(object::kOutputErrorValue, i, 1, safeByte(io, i));
  }
  for (uint32_t i = 0; i < plan.outputs.analog; ++i) {
    const uint32_t at = plan.outputs.analogAt() + kAnalogBytes * i;
    if (safeByte(io, at) == 0 && safeByte(io, at + 1) == 0) {
      write(object::kAnalogErrorMode, i, 1, 1);
      write(object::kAnalogErrorValue, i, 4, 0);
      continue;
    }
    // Where the 16 bits lie in the 32 of 6444h, devices see differently: the user has to say it.
    const Object value = {object::kAnalogErrorValue, static_cast<uint8_t>(i + 1)};
    if (std::none_of(given.begin(), given.end(),
                     [&](const SdoWrite &one) { return one.object == value; }))
      plan.untold.push_back(i + 1);
  }
}

uint16_t inhibitOf(const bus::IoSetup &io) {
  return static_cast<uint16_t>(
      std::clamp(io.parameters.number("inhibit") * 1e4 + 0.5, 0.0, 65535.0)); // [100 µs]
}

} // namespace

IoPlan planIo(const bus::IoSetup &io) {
  IoPlan plan;
  plan.inputs = sideOf(io, io.inputBytes, "inputs");
  plan.outputs = sideOf(io, io.outputBytes, "outputs");
  plan.fault = faultOf(plan.inputs, "inputs");
  if (plan.fault.empty())
    plan.fault = faultOf(plan.outputs, "outputs");
  const auto node = static_cast<uint8_t>(io.parameters.number("node"));
  const DriveSettings settings = driveSettings(node, io.parameters);
  plan.errors = settings.errors;
  if (plan.fault.empty() && !plan.errors.empty())
    plan.fault = plan.errors.front();
  if (!plan.fault.empty())
    return plan;
  plan.plan.node = node;
  const bool events = io.parameters.number("when") != 0;
  const uint8_t transmission = events ? Pdo::kByEvent : uint8_t{1};
  addPdos({plan.outputs, object::kOutputs, object::kAnalogOutputs, kRpdoBase, transmission, 0, 0},
          node, plan.plan.rpdos, plan.plan.rpdoCount, plan.rpdoAt);
  addPdos({plan.inputs, object::kInputs, object::kAnalogInputs, kTpdoBase, transmission,
           events ? inhibitOf(io) : uint16_t{0}, events ? kIoEventTimer : uint16_t{0}},
          node, plan.plan.tpdos, plan.plan.tpdoCount, plan.tpdoAt);
  addErrorValues(io, plan, settings.startup);
  if (events && plan.inputs.analog > 0)
    plan.startup.push_back({{object::kAnalogEvents, 0}, 1, 1, true});
  plan.startup.insert(plan.startup.end(), settings.startup.begin(), settings.startup.end());
  return plan;
}

} // namespace stride::can
