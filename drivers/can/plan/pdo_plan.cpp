#include "drivers/can/plan/pdo_plan.hpp"

#include <algorithm>

namespace stride::can {
namespace {

using cyclic::kCurrent;
using cyclic::kPosition;
using cyclic::kTorque;
using cyclic::kVelocity;

/// PDOs by event come at least so often: a lost one is not lost for good. [ms]
constexpr uint16_t kEventTimer = 100;

/// What the values of wControlType mean.
struct ControlRow {
  uint8_t type;
  uint8_t sent;
  uint8_t received;
};
constexpr std::array<ControlRow, 6> kControlRows = {{
    {1, kTorque, 0},
    {2, kVelocity, kVelocity},
    {3, kVelocity, kPosition},
    {4, kPosition, kPosition},
    {5, kPosition | kVelocity, kPosition | kVelocity},
    {6, kVelocity, 0},
}};

/// What the values of wCyclicDataS1 … mean.
struct DataRow {
  uint16_t number;
  uint8_t bit;
};
constexpr std::array<DataRow, 4> kSendRows = {
    {{1100, kPosition}, {1110, kVelocity}, {1160, kTorque}, {1150, kCurrent}}};
constexpr std::array<DataRow, 4> kReceiveRows = {
    {{1101, kPosition}, {1111, kVelocity}, {1161, kTorque}, {1151, kCurrent}}};
constexpr uint16_t kUserData = 65535;

void note(std::vector<PlanNote> &notes, PlanNote one) {
  if (std::find(notes.begin(), notes.end(), one) == notes.end())
    notes.push_back(one);
}

uint8_t dataBits(std::span<const uint16_t> numbers, std::span<const DataRow> rows,
                 std::vector<PlanNote> &notes) {
  uint8_t bits = 0;
  for (const uint16_t number : numbers) {
    if (number == 0)
      continue;
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const DataRow &one) { return one.number == number; });
    if (row != rows.end())
      bits = bits | row->bit;
    else
      note(notes, number == kUserData ? PlanNote::UserDataNotMapped : PlanNote::UnknownData);
  }
  return bits;
}

PdoEntry entry(Signal signal) {
  const SignalObject &row = objectOf(signal);
  return {row.object, row.bits};
}

uint32_t bitsOf(std::span<const PdoEntry> entries) {
  uint32_t bits = 0;
  for (const PdoEntry &one : entries)
    bits += one.bits;
  return bits;
}

/// The PDOs of one direction while they are filled.
class Filler {
public:
  Filler(std::array<Pdo, DrivePlan::kMostPdos> &pdos, uint8_t &count, uint16_t base,
         const DriveWish &wish, bool transmits)
      : pdos_(pdos), count_(count), base_(base), node_(wish.node), axis_(wish.axis),
        transmits_(transmits) {}

  /// Into a PDO of that kind with room for all of them, or into a new one.
  void add(std::span<const PdoEntry> entries, uint8_t transmission) {
    Pdo *place = nullptr;
    for (uint8_t i = 0; i < count_ && place == nullptr; ++i)
      if (pdos_[i].transmission == transmission && hasRoom(pdos_[i], entries))
        place = &pdos_[i];
    if (place == nullptr)
      place = begin(transmission);
    if (place == nullptr)
      return;
    for (const PdoEntry &one : entries)
      place->entries[place->count++] = one;
  }
  void add(PdoEntry one, uint8_t transmission) { add({&one, 1}, transmission); }

  [[nodiscard]] bool tooMany() const { return tooMany_; }

private:
  static bool hasRoom(const Pdo &pdo, std::span<const PdoEntry> entries) {
    return pdo.bits() + bitsOf(entries) <= Pdo::kMostBits &&
           pdo.count + entries.size() <= Pdo::kMostEntries;
  }
  Pdo *begin(uint8_t transmission) {
    if (count_ == DrivePlan::kMostPdos) {
      tooMany_ = true;
      return nullptr;
    }
    Pdo &pdo = pdos_[count_];
    pdo.cobId = predefinedId(base_, count_, node_, axis_);
    pdo.number = static_cast<uint16_t>(kAxisPdos * axis_ + ++count_);
    pdo.transmission = transmission;
    if (transmits_ && !pdo.synchronous())
      pdo.eventTimer = kEventTimer;
    return &pdo;
  }

  std::array<Pdo, DrivePlan::kMostPdos> &pdos_;
  uint8_t &count_;
  uint16_t base_;
  uint8_t node_;
  uint8_t axis_;
  bool transmits_;
  bool tooMany_ = false;
};

/// The words that every drive has, and the values of the cycle.
struct Direction {
  PdoEntry word; ///< Controlword or statusword …
  PdoEntry mode; ///< … and its mode.
  std::vector<PdoEntry> values;
};

void fill(Filler &filler, const Direction &direction, const DriveWish &wish) {
  constexpr uint8_t kSync = 1;
  const uint32_t modeBits = wish.modeInPdo ? direction.mode.bits : 0U;
  const uint32_t valueBits = bitsOf(direction.values);
  const bool together = direction.word.bits + modeBits + valueBits <= Pdo::kMostBits;
  if (together || !wish.eventPdos) {
    filler.add(direction.word, kSync);
    if (wish.modeInPdo)
      filler.add(direction.mode, kSync);
    for (const PdoEntry &one : direction.values)
      filler.add(one, kSync);
    return;
  }
  for (const PdoEntry &one : direction.values)
    filler.add(one, kSync);
  // The mode costs nothing there.
  filler.add(direction.word, Pdo::kByEvent);
  filler.add(direction.mode, Pdo::kByEvent);
}

std::vector<PdoEntry> setValues(uint8_t sent) {
  std::vector<PdoEntry> values;
  if ((sent & kPosition) != 0)
    values.push_back(entry(Signal::TargetPosition));
  // Beside a position, a velocity goes ahead of the position controller.
  if ((sent & kVelocity) != 0)
    values.push_back(
        entry((sent & kPosition) != 0 ? Signal::VelocityOffset : Signal::TargetVelocity));
  if ((sent & kTorque) != 0)
    values.push_back(entry(Signal::TargetTorque));
  return values;
}

std::vector<PdoEntry> actualValues(uint8_t received) {
  std::vector<PdoEntry> values;
  if ((received & kPosition) != 0)
    values.push_back(entry(Signal::Position));
  if ((received & kVelocity) != 0)
    values.push_back(entry(Signal::Velocity));
  if ((received & kTorque) != 0)
    values.push_back(entry(Signal::Torque));
  if ((received & kCurrent) != 0)
    values.push_back(entry(Signal::Current));
  return values;
}

uint8_t modesOf(uint8_t sent) {
  uint8_t modes = 0;
  if ((sent & kPosition) != 0)
    modes = modes | 1U << kPositionControl;
  if ((sent & kVelocity) != 0)
    modes = modes | 1U << kVelocityControl;
  if ((sent & kTorque) != 0)
    modes = modes | 1U << kTorqueControl;
  return modes;
}

uint8_t kindOf(const DriveWish &wish) { return wish.eventPdos ? Pdo::kByEvent : uint8_t{1}; }

/// What is seen now and then only.
void fillExtras(Filler &tpdos, const DriveWish &wish) {
  const uint8_t kind = kindOf(wish);
  if (wish.inputs)
    tpdos.add(entry(Signal::Inputs), kind);
  if (wish.probeInputs == 0)
    return;
  std::vector<PdoEntry> status = {entry(Signal::ProbeStatus)};
  // A latched position is valid in the frame that says so; further ones are asked for.
  for (unsigned input = 0; input < 4; ++input)
    if ((wish.probeInputs >> input & 1U) != 0 && status.size() == 1)
      status.push_back(
          entry(static_cast<Signal>(static_cast<unsigned>(Signal::Probe1Rising) + input)));
  tpdos.add(status, kind);
}

/// The object, or one that stands for the same, is in one of them.
bool has(std::span<const Pdo> pdos, Signal signal) {
  return std::any_of(pdos.begin(), pdos.end(), [signal](const Pdo &pdo) {
    return std::any_of(pdo.mapped().begin(), pdo.mapped().end(),
                       [signal](const PdoEntry &one) { return signalOf(one.object) == signal; });
  });
}

/// Cyclic values of PDOs that are given as they are.
struct CarrierRow {
  Signal signal;
  uint8_t bit;
};
constexpr std::array<CarrierRow, 4> kSetCarriers = {{{Signal::TargetPosition, kPosition},
                                                     {Signal::VelocityOffset, kVelocity},
                                                     {Signal::TargetVelocity, kVelocity},
                                                     {Signal::TargetTorque, kTorque}}};
constexpr std::array<CarrierRow, 4> kActualCarriers = {{{Signal::Position, kPosition},
                                                        {Signal::Velocity, kVelocity},
                                                        {Signal::Torque, kTorque},
                                                        {Signal::Current, kCurrent}}};

uint8_t valuesIn(std::span<const Pdo> pdos, std::span<const CarrierRow> carriers) {
  uint8_t bits = 0;
  for (const CarrierRow &one : carriers)
    if (has(pdos, one.signal))
      bits = bits | one.bit;
  return bits;
}

/// Filled up places of a PDO (0001h … 0007h) are nobody's values.
bool isGap(Object object) { return object.index <= 0x0007; }

void takeOwn(std::span<const Pdo> own, std::array<Pdo, DrivePlan::kMostPdos> &pdos,
             uint8_t &count) {
  for (const Pdo &pdo : own.first(std::min(own.size(), pdos.size())))
    pdos[count++] = pdo;
}

void takeOwnRpdos(const DriveWish &wish, PlanResult &result) {
  DrivePlan &plan = result.plan;
  takeOwn(wish.rpdos, plan.rpdos, plan.rpdoCount);
  const uint8_t carried = valuesIn(wish.rpdos, kSetCarriers);
  if ((plan.sent & ~carried) != 0)
    note(result.notes, PlanNote::SetValueNotMapped);
  plan.sent = carried;
  if (!has(wish.rpdos, Signal::Controlword))
    note(result.notes, PlanNote::NoControlword);
  for (const Pdo &pdo : wish.rpdos)
    for (const PdoEntry &one : pdo.mapped())
      if (signalOf(one.object) == Signal::Other && !isGap(one.object))
        note(result.notes, PlanNote::NobodySets);
}

void takeOwnTpdos(const DriveWish &wish, PlanResult &result) {
  DrivePlan &plan = result.plan;
  takeOwn(wish.tpdos, plan.tpdos, plan.tpdoCount);
  const uint8_t carried = valuesIn(wish.tpdos, kActualCarriers);
  if ((plan.received & ~carried) != 0)
    note(result.notes, PlanNote::ActualValueNotMapped);
  plan.received = carried;
  if (!has(wish.tpdos, Signal::Statusword))
    note(result.notes, PlanNote::NoStatusword);
  if (wish.secondEncoder && !has(wish.tpdos, Signal::SecondPosition))
    note(result.notes, PlanNote::SecondEncoderNotMapped);
  if (wish.inputs && !has(wish.tpdos, Signal::Inputs))
    note(result.notes, PlanNote::InputsNotMapped);
}

/// Both directions are of use together only.
void checkProbes(const DriveWish &wish, PlanResult &result) {
  const bool own = !wish.rpdos.empty() || !wish.tpdos.empty();
  if (own && wish.probeInputs != 0 &&
      !(has(result.plan.receivedByDrive(), Signal::ProbeFunction) &&
        has(result.plan.sentByDrive(), Signal::ProbeStatus)))
    note(result.notes, PlanNote::ProbesNotMapped);
}

} // namespace

uint32_t Pdo::bits() const { return bitsOf(mapped()); }

bool DrivePlan::carries(Signal signal) const {
  return has(receivedByDrive(), signal) || has(sentByDrive(), signal);
}

bool isError(PlanNote note) { return note >= PlanNote::UnknownControlType; }

std::string_view describe(PlanNote note) {
  static constexpr std::array<std::string_view, 14> kTexts = {
      "set currents have no standard object on CAN: SetCurrent is not sent",
      "user-defined cyclic data needs a PDO of its own: it is not sent",
      "unknown cyclic data is not sent",
      "a set value of its wControlType is in none of its own RPDOs",
      "an actual value of its wControlType is in none of its own TPDOs",
      "its second encoder (60E4h:1) is in none of its own TPDOs",
      "its inputs (60FDh) are in none of its own TPDOs",
      "its touch probes (60B8h in an RPDO, 60B9h in a TPDO) are not in its own PDOs",
      "its own RPDOs have objects that are no set values: they are sent as 0",
      "unknown wControlType",
      "no set value is sent to the drive: choose one in wCyclicDataS1",
      "more than four PDOs in one direction",
      "none of its own RPDOs has the controlword (6040h)",
      "none of its own TPDOs has the statusword (6041h)",
  };
  return kTexts[static_cast<size_t>(note)];
}

bool PlanResult::usable() const { return std::none_of(notes.begin(), notes.end(), isError); }

namespace {

/// The values that the control type wants. FALSE: there is no such type.
bool wantValues(const DriveWish &wish, PlanResult &result) {
  DrivePlan &plan = result.plan;
  if (wish.controlType == 0) {
    plan.sent = dataBits(wish.send, kSendRows, result.notes);
    plan.received = dataBits(wish.receive, kReceiveRows, result.notes);
  } else {
    const auto row =
        std::find_if(kControlRows.begin(), kControlRows.end(),
                     [&](const ControlRow &one) { return one.type == wish.controlType; });
    if (row == kControlRows.end()) {
      result.notes.push_back(PlanNote::UnknownControlType);
      return false;
    }
    plan.sent = row->sent;
    plan.received = row->received;
  }
  if ((plan.sent & kCurrent) != 0) {
    note(result.notes, PlanNote::CurrentNotSent);
    plan.sent = static_cast<uint8_t>(plan.sent & ~kCurrent);
  }
  return true;
}

void planRpdos(const DriveWish &wish, PlanResult &result) {
  DrivePlan &plan = result.plan;
  if (!wish.rpdos.empty()) {
    takeOwnRpdos(wish, result);
    return;
  }
  Filler filler(plan.rpdos, plan.rpdoCount, kRpdoBase, wish, false);
  fill(filler, {entry(Signal::Controlword), entry(Signal::Mode), setValues(plan.sent)}, wish);
  if (wish.probeInputs != 0)
    filler.add(entry(Signal::ProbeFunction), kindOf(wish));
  if (filler.tooMany())
    note(result.notes, PlanNote::TooMany);
}

void planTpdos(const DriveWish &wish, PlanResult &result) {
  DrivePlan &plan = result.plan;
  if (!wish.tpdos.empty()) {
    takeOwnTpdos(wish, result);
    return;
  }
  Filler filler(plan.tpdos, plan.tpdoCount, kTpdoBase, wish, true);
  std::vector<PdoEntry> values = actualValues(plan.received);
  if (wish.secondEncoder)
    values.push_back(entry(Signal::SecondPosition));
  fill(filler, {entry(Signal::Statusword), entry(Signal::ModeDisplay), std::move(values)}, wish);
  fillExtras(filler, wish);
  if (filler.tooMany())
    note(result.notes, PlanNote::TooMany);
}

} // namespace

PlanResult planDrive(const DriveWish &wish) {
  PlanResult result;
  result.plan.node = wish.node;
  result.plan.axis = wish.axis;
  if (!wantValues(wish, result))
    return result;
  planRpdos(wish, result);
  planTpdos(wish, result);
  checkProbes(wish, result);
  result.plan.controllerModes = modesOf(result.plan.sent);
  if (result.plan.sent == 0)
    note(result.notes, PlanNote::NothingSent);
  return result;
}

DrivePlan planEncoder(uint8_t node, std::span<const Pdo> own) {
  constexpr uint8_t kWithSync = 2; // the first one is sent by a timer of the encoder
  DrivePlan plan;
  plan.node = node;
  if (!own.empty()) {
    takeOwn(own, plan.tpdos, plan.tpdoCount);
    return plan;
  }
  Pdo &pdo = plan.tpdos[plan.tpdoCount++];
  pdo.number = kWithSync;
  pdo.cobId = static_cast<uint16_t>(kTpdoBase + (kWithSync - 1) * kNextPdo + node);
  pdo.entries[pdo.count++] = entry(Signal::EncoderPosition);
  return plan;
}

} // namespace stride::can
