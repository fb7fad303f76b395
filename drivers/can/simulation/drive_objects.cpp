#include "drivers/can/simulation/drive_objects.hpp"

#include "drivers/can/simulation/drive402.hpp"

#include "runtime/iec/math.h"

#include <algorithm>
#include <limits>

namespace stride::can::simulation {
namespace {

using Type = DataType;

constexpr uint32_t kServoDrive = 0x00020192;
constexpr double kMilli = 1000;
constexpr uint64_t kDefaultRamp = 1'000'000; ///< [inc/s²]

uint64_t whole(double value, double least) {
  const double most = std::numeric_limits<uint32_t>::max();
  return static_cast<uint64_t>(std::clamp(stride::floor(value + 0.5), least, most));
}

void addPower(std::vector<ObjectRow> &rows, uint64_t modes) {
  rows.insert(rows.end(),
              {{.index = 0x6007, .type = Type::Integer16, .value = 1, .low = 0, .high = 3},
               {.index = 0x603F,
                .type = Type::Unsigned16,
                .access = Access::ReadOnly,
                .mapping = kInTransmit},
               {.index = 0x6040, .type = Type::Unsigned16, .mapping = kInBoth},
               {.index = 0x6041,
                .type = Type::Unsigned16,
                .access = Access::ReadOnly,
                .mapping = kInTransmit},
               {.index = 0x605A, .type = Type::Integer16, .value = 2, .low = 0, .high = 7},
               {.index = 0x605B, .type = Type::Integer16, .value = 0, .low = 0, .high = 1},
               {.index = 0x605C, .type = Type::Integer16, .value = 1, .low = 0, .high = 1},
               {.index = 0x605D, .type = Type::Integer16, .value = 1, .low = 1, .high = 3},
               {.index = 0x605E, .type = Type::Integer16, .value = 2, .low = 0, .high = 3},
               {.index = 0x6060, .type = Type::Integer8, .mapping = kInBoth},
               {.index = 0x6061,
                .type = Type::Integer8,
                .access = Access::ReadOnly,
                .mapping = kInTransmit},
               {.index = 0x6502, .access = Access::ReadOnly, .value = modes}});
}

void addPosition(std::vector<ObjectRow> &rows) {
  rows.insert(
      rows.end(),
      {{.index = 0x6062,
        .type = Type::Integer32,
        .access = Access::ReadOnly,
        .mapping = kInTransmit},
       {.index = 0x6063,
        .type = Type::Integer32,
        .access = Access::ReadOnly,
        .mapping = kInTransmit},
       {.index = 0x6064,
        .type = Type::Integer32,
        .access = Access::ReadOnly,
        .mapping = kInTransmit},
       {.index = 0x6065, .value = kNoWindow},
       {.index = 0x6066, .type = Type::Unsigned16},
       {.index = 0x607A, .type = Type::Integer32, .mapping = kInBoth},
       {.index = 0x607B, .type = Type::Unsigned8, .access = Access::Const, .value = 2},
       {.index = 0x607B, .sub = 1, .type = Type::Integer32},
       {.index = 0x607B, .sub = 2, .type = Type::Integer32},
       {.index = 0x607C, .type = Type::Integer32},
       {.index = 0x607D, .type = Type::Unsigned8, .access = Access::Const, .value = 2},
       {.index = 0x607D, .sub = 1, .type = Type::Integer32},
       {.index = 0x607D, .sub = 2, .type = Type::Integer32},
       {.index = 0x60B0, .type = Type::Integer32, .mapping = kInBoth},
       {.index = 0x60C1, .type = Type::Unsigned8, .access = Access::Const, .value = 1},
       {.index = 0x60C1, .sub = 1, .type = Type::Integer32, .mapping = kInBoth},
       {.index = 0x60C2, .type = Type::Unsigned8, .access = Access::Const, .value = 2},
       {.index = 0x60C2, .sub = 1, .type = Type::Unsigned8, .value = 1, .low = 1, .high = 255},
       {.index = 0x60C2,
        .sub = 2,
        .type = Type::Integer8,
        .value = static_cast<uint64_t>(int64_t{-3}),
        .low = -6,
        .high = 0},
       {.index = 0x60F4,
        .type = Type::Integer32,
        .access = Access::ReadOnly,
        .mapping = kInTransmit}});
}

void addVelocityAndTorque(std::vector<ObjectRow> &rows, const Drive402Setup &setup) {
  const double quick = setup.drive.quickStop / setup.velocityScale;
  const uint64_t quickStop = quick > 0 ? whole(quick, 1) : 10 * kDefaultRamp;
  const uint64_t rated = whole(setup.ratedTorque * kMilli, 1);
  rows.insert(
      rows.end(),
      {{.index = 0x606B,
        .type = Type::Integer32,
        .access = Access::ReadOnly,
        .mapping = kInTransmit},
       {.index = 0x606C,
        .type = Type::Integer32,
        .access = Access::ReadOnly,
        .mapping = kInTransmit},
       {.index = 0x6071, .type = Type::Integer16, .mapping = kInBoth},
       {.index = 0x6072, .type = Type::Unsigned16, .value = 1000},
       {.index = 0x6074,
        .type = Type::Integer16,
        .access = Access::ReadOnly,
        .mapping = kInTransmit},
       {.index = 0x6075, .value = 1000},
       {.index = 0x6076, .value = rated},
       {.index = 0x6077,
        .type = Type::Integer16,
        .access = Access::ReadOnly,
        .mapping = kInTransmit},
       {.index = 0x6078,
        .type = Type::Integer16,
        .access = Access::ReadOnly,
        .mapping = kInTransmit},
       {.index = 0x6079, .access = Access::ReadOnly, .mapping = kInTransmit, .value = 325'000},
       {.index = 0x6083, .value = kDefaultRamp, .low = 1, .high = 0xFFFFFFFF},
       {.index = 0x6084, .value = kDefaultRamp, .low = 1, .high = 0xFFFFFFFF},
       {.index = 0x6085, .value = quickStop, .low = 1, .high = 0xFFFFFFFF},
       {.index = 0x6087},
       {.index = 0x60B1, .type = Type::Integer32, .mapping = kInBoth},
       {.index = 0x60B2, .type = Type::Integer16, .mapping = kInBoth},
       {.index = 0x60FF, .type = Type::Integer32, .mapping = kInBoth}});
}

void addSignals(std::vector<ObjectRow> &rows) {
  rows.insert(rows.end(),
              {{.index = 0x60B8, .type = Type::Unsigned16, .mapping = kInBoth},
               {.index = 0x60B9,
                .type = Type::Unsigned16,
                .access = Access::ReadOnly,
                .mapping = kInTransmit},
               {.index = 0x60BA,
                .type = Type::Integer32,
                .access = Access::ReadOnly,
                .mapping = kInTransmit},
               {.index = 0x60BB,
                .type = Type::Integer32,
                .access = Access::ReadOnly,
                .mapping = kInTransmit},
               {.index = 0x60BC,
                .type = Type::Integer32,
                .access = Access::ReadOnly,
                .mapping = kInTransmit},
               {.index = 0x60BD,
                .type = Type::Integer32,
                .access = Access::ReadOnly,
                .mapping = kInTransmit},
               {.index = 0x60E4, .type = Type::Unsigned8, .access = Access::Const, .value = 1},
               {.index = 0x60E4,
                .sub = 1,
                .type = Type::Integer32,
                .access = Access::ReadOnly,
                .mapping = kInTransmit},
               {.index = 0x60FD, .access = Access::ReadOnly, .mapping = kInTransmit},
               {.index = 0x60FE, .type = Type::Unsigned8, .access = Access::Const, .value = 2},
               {.index = 0x60FE, .sub = 1, .mapping = kInBoth},
               {.index = 0x60FE, .sub = 2}});
}

void addHoming(std::vector<ObjectRow> &rows, const Drive402Setup &setup) {
  const dummy::HomingParameters &homing = setup.drive.homing;
  const double scale = setup.velocityScale;
  rows.insert(rows.end(),
              {{.index = 0x6098,
                .type = Type::Integer8,
                .value = static_cast<uint64_t>(setup.drive.homing.positive ? 19 : 21)},
               {.index = 0x6099, .type = Type::Unsigned8, .access = Access::Const, .value = 2},
               {.index = 0x6099,
                .sub = 1,
                .value = whole(homing.fast / scale, 1),
                .low = 1,
                .high = 0xFFFFFFFF},
               {.index = 0x6099,
                .sub = 2,
                .value = whole(homing.slow / scale, 1),
                .low = 1,
                .high = 0xFFFFFFFF},
               {.index = 0x609A,
                .value = whole(homing.acceleration / scale, 1),
                .low = 1,
                .high = 0xFFFFFFFF}});
}

} // namespace

uint32_t supportedModes(bool torque) {
  uint32_t modes = 0;
  for (const int8_t mode : {kProfileVelocity, kHomingMode, kInterpolatedPosition, kSyncPosition,
                            kSyncVelocity, kProfileTorque, kSyncTorque})
    if (torque || (mode != kProfileTorque && mode != kSyncTorque))
      modes |= 1U << static_cast<unsigned>(mode - 1);
  return modes;
}

namespace {

/// A mapped object of an axis.
uint32_t mapped(uint32_t entry, uint16_t shift) { return entry + (uint32_t{shift} << 16U); }

/// The PDOs that the profile gives to drives; all but the first of the first axis are off.
void addPdos(DeviceRows &device, uint8_t axis) {
  constexpr uint32_t kOff = 0x80000000;
  constexpr uint32_t kTold = 0x40000000; ///< Nobody may ask for it.
  struct Row {
    uint32_t word;
    uint32_t value;
  };
  constexpr std::array<Row, 4> kReceive = {{{0x60400010, 0},
                                            {0x60400010, 0x60600008},
                                            {0x60400010, 0x607A0020},
                                            {0x60400010, 0x60FF0020}}};
  constexpr std::array<Row, 4> kTransmit = {{{0x60410010, 0},
                                             {0x60410010, 0x60610008},
                                             {0x60410010, 0x60640020},
                                             {0x60410010, 0x606C0020}}};
  const auto shift = static_cast<uint16_t>(kAxisObjects * axis);
  const auto add = [&](std::vector<PdoRow> &rows, const Row &row, size_t place, uint32_t base) {
    PdoRow &pdo = rows.emplace_back();
    pdo.number = static_cast<uint16_t>(kAxisPdos * axis + place + 1);
    if (axis == 0) // the predefined connection set has no identifiers for others
      pdo.cobId = base + static_cast<uint32_t>(place * 0x100) + (place > 0 ? kOff : 0);
    else
      pdo.cobId = kOff | (base & kTold);
    pdo.map[0] = mapped(row.word, shift);
    pdo.map[1] = row.value == 0 ? 0 : mapped(row.value, shift);
  };
  for (size_t i = 0; i < kReceive.size(); ++i) {
    add(device.receive, kReceive[i], i, 0x200);
    add(device.transmit, kTransmit[i], i, kTold | 0x180);
  }
}

void addAxis(DeviceRows &device, const Drive402Setup &setup, bool several) {
  std::vector<ObjectRow> rows;
  const bool torque = setup.drive.mechanics.model == dummy::Model::SecondOrder;
  addPower(rows, supportedModes(torque));
  addPosition(rows);
  addVelocityAndTorque(rows, setup);
  addSignals(rows);
  addHoming(rows, setup);
  if (several)
    rows.push_back({.index = 0x67FF, .access = Access::Const, .value = kServoDrive});
  for (ObjectRow &row : rows)
    row.index = static_cast<uint16_t>(row.index + kAxisObjects * setup.axis);
  device.objects.insert(device.objects.end(), rows.begin(), rows.end());
  addPdos(device, setup.axis);
}

} // namespace

DeviceRows driveRows(const Drive402Setup &setup) {
  constexpr uint32_t kSeveral = 0xFFFF0000; // each says in 67FFh what it is
  DeviceRows device;
  const bool several = setup.axis != 0 || !setup.further.empty();
  device.deviceType = several ? kSeveral | (kServoDrive & 0xFFFFU) : kServoDrive;
  device.objects = setup.more; // the last one of several for the same object counts
  for (const Drive402Setup &other : setup.further)
    device.objects.insert(device.objects.end(), other.more.begin(), other.more.end());
  addAxis(device, setup, several);
  for (const Drive402Setup &other : setup.further)
    addAxis(device, other, several);
  return device;
}

DriveObjects::DriveObjects(const AxisObjects &d)
    : errorCode(d.at(0x603F)), controlword(d.at(0x6040)), statusword(d.at(0x6041)),
      mode(d.at(0x6060)), modeDisplay(d.at(0x6061)), positionDemand(d.at(0x6062)),
      positionInternal(d.at(0x6063)), position(d.at(0x6064)), followingWindow(d.at(0x6065)),
      followingTime(d.at(0x6066)), velocityDemand(d.at(0x606B)), velocity(d.at(0x606C)),
      targetTorque(d.at(0x6071)), torqueDemand(d.at(0x6074)), torque(d.at(0x6077)),
      current(d.at(0x6078)), targetPosition(d.at(0x607A)), lowestPosition(d.at(0x607D, 1)),
      highestPosition(d.at(0x607D, 2)), acceleration(d.at(0x6083)), deceleration(d.at(0x6084)),
      quickDeceleration(d.at(0x6085)), torqueSlope(d.at(0x6087)), positionOffset(d.at(0x60B0)),
      velocityOffset(d.at(0x60B1)), torqueOffset(d.at(0x60B2)), probeFunction(d.at(0x60B8)),
      probeStatus(d.at(0x60B9)), probePosition{&d.at(0x60BA), &d.at(0x60BB), &d.at(0x60BC),
                                               &d.at(0x60BD)},
      interpolationData(d.at(0x60C1, 1)), interpolationTime(d.at(0x60C2, 1)),
      interpolationExponent(d.at(0x60C2, 2)), followingError(d.at(0x60F4)), inputs(d.at(0x60FD)),
      targetVelocity(d.at(0x60FF)), abortOption(d.at(0x6007)), quickStopOption(d.at(0x605A)),
      shutdownOption(d.at(0x605B)), disableOption(d.at(0x605C)), haltOption(d.at(0x605D)),
      faultOption(d.at(0x605E)), homingMethod(d.at(0x6098)), homingFast(d.at(0x6099, 1)),
      homingSlow(d.at(0x6099, 2)), homingAcceleration(d.at(0x609A)), homeOffset(d.at(0x607C)),
      outputs(d.at(0x60FE, 1)), outputMask(d.at(0x60FE, 2)), mostTorque(d.at(0x6072)),
      secondPosition(d.at(0x60E4, 1)), supportedModes(d.at(0x6502)) {}

} // namespace stride::can::simulation
