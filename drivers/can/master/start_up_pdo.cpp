// PDOs that a node does not let be changed, at its start-up.
#include "drivers/can/master/start_up.hpp"
#include "drivers/can/master/texts.hpp"
#include "drivers/can/plan/bus_load.hpp"

#include <algorithm>
#include <span>

namespace stride::can {
namespace {

/// A parameter of a PDO, communication or mapping.
bool isOfPdo(Object object) {
  return object.index >= object::kRpdoCommunication && object.index < object::kTpdoMapping + 0x200;
}

bool isMapping(Object object) { return (object.index & 0x200U) != 0; } // 1600h …, 1A00h …

/// A PDO that nobody wants.
bool isSwitchedOff(const SdoWrite &write) {
  return !isMapping(write.object) && write.object.sub == 1 && write.optional;
}

uint32_t mappingOf(const PdoEntry &entry) {
  return uint32_t{entry.object.index} << 16U | uint32_t{entry.object.sub} << 8U | entry.bits;
}

/// Only makes a PDO ready to be changed: it is switched off, or has no objects for a while.
bool preparesPdo(const SdoWrite &write) {
  if (isMapping(write.object))
    return write.object.sub == 0 && write.value == 0;
  return write.object.sub == 1 && (write.value & kPdoInvalid) != 0 && !write.optional;
}

} // namespace

/// It refuses to change it.
bool StartUp::isFixedPdo(const SdoClient &sdo) const {
  const uint32_t code = sdo.abortCode();
  // Why a PDO stays on, a device may say in many ways.
  const bool isFixed = code == abort_code::kReadOnly || code == abort_code::kUnsupported ||
                       isSwitchedOff(now().object);
  return now().op == StartOp::Write && isOfPdo(now().object.object) && isFixed && !compares_ &&
         !sdo.timedOut();
}

/// A device may have PDOs that cannot be changed: they will do if what is wanted is in them.
StartUp::Outcome StartUp::fixedPdo(const SdoWrite &write) {
  if (preparesPdo(write))
    return Outcome::Next;
  asked_ = false;
  if (isSwitchedOff(write)) {
    inspects_ = true;
    inspection_.begin(write.object);
  } else if (isMapping(write.object)) {
    inspects_ = true;
    inspection_.beginMapping(write.object);
  } else {
    compares_ = true;
  }
  return Outcome::Busy;
}

StartUp::Outcome StartUp::inspected(const StartParts &parts, bus::Message &message) {
  const bool there = parts.sdo.state() == SdoClient::State::Done;
  uint32_t value = 0;
  for (size_t i = 0; there && i < std::min(parts.sdo.size(), bytes_.size()); ++i)
    value |= uint32_t{bytes_[i]} << 8 * i;
  asked_ = false;
  if (!inspection_.answered(there, value))
    return Outcome::Busy;
  if (isSwitchedOff(now().object))
    return cannotBeOff(parts, message);
  adapt(parts);
  // The rest of its mapping is known, too.
  const uint16_t index = now().object.object.index;
  while (place_ + 1 < steps_.size() && steps_[place_ + 1].object.object.index == index)
    ++place_;
  return Outcome::Next;
}

/// It is none of the plan, and stays on: it may be of use, and must disturb nobody.
StartUp::Outcome StartUp::cannotBeOff(const StartParts &parts, bus::Message &message) {
  const FixedPdo &pdo = inspection_.result();
  constexpr uint32_t kExtended = 0x20000000; // 29 bits are nobody's here
  if (!pdo.on)
    return Outcome::Next;
  const bool collides =
      (pdo.cobId & kExtended) == 0 && parts.cobIds != nullptr && parts.cobIds->test(pdo.pdo.cobId);
  if (!collides) {
    if (unused_.size() < unused_.capacity())
      unused_.push_back(pdo);
    parts.planChanged = true;
    return Outcome::Next;
  }
  message.set("node ", uint32_t{node_}, ": its ", pdo.transmits ? "TPDO " : "RPDO ",
              uint32_t{pdo.pdo.number}, " cannot be switched off, and its COB-ID ",
              HexText(pdo.pdo.cobId, 3), " (", ObjectText(now().object.object),
              ") is another PDO's of the plan: own PDOs can take it into account");
  return Outcome::Failed;
}

/// The plan gets what the device has.
void StartUp::adapt(const StartParts &parts) {
  const FixedPdo &fixed = inspection_.result();
  LogicalDevice &device = parts.devices[now().device];
  DrivePlan plan = device.plan();
  const std::span<Pdo> pdos = fixed.transmits ? std::span<Pdo>(plan.tpdos).first(plan.tpdoCount)
                                              : std::span<Pdo>(plan.rpdos).first(plan.rpdoCount);
  const auto pdo = std::find_if(pdos.begin(), pdos.end(),
                                [&](const Pdo &one) { return one.number == fixed.pdo.number; });
  if (pdo == pdos.end())
    return;
  const auto wanted = std::span<const StartStep>(steps_).subspan(place_);
  const uint16_t mapping = now().object.object.index;
  bool same = fixed.known && fixed.pdo.count == pdo->count;
  for (const StartStep &step : wanted) {
    const SdoWrite &write = step.object;
    if (write.object.index != mapping)
      break;
    const uint32_t is = write.object.sub == 0 ? fixed.count
                        : write.object.sub <= fixed.pdo.count
                            ? mappingOf(fixed.pdo.entries[write.object.sub - 1U])
                            : 0;
    const uint32_t shall = valueOf(write, parts);
    if (is == shall)
      continue;
    same = false;
    // What is in it is of no interest when it is none.
    if (mismatch_.object == Object{} && (fixed.known || write.object.sub == 0)) {
      mismatch_ = write;
      mismatch_.value = shall;
      mismatchValue_ = is;
    }
  }
  if (same)
    return;
  adapted_ = true;
  pdo->count = fixed.known ? fixed.pdo.count : uint8_t{0};
  for (size_t i = 0; i < pdo->count; ++i)
    pdo->entries[i] = {inProfile(fixed.pdo.entries[i].object, plan.axis),
                       fixed.pdo.entries[i].bits};
  device.setPlan(plan);
  parts.planChanged = true;
}

namespace {

/// What is sent there would be 0, whatever it means.
bool hasUnknown(const Pdo &pdo, std::span<const Pdo> planned) {
  constexpr uint16_t kLastGap = 0x0007;
  return std::any_of(pdo.mapped().begin(), pdo.mapped().end(), [&](const PdoEntry &one) {
    const bool wanted = std::any_of(planned.begin(), planned.end(), [&](const Pdo &other) {
      return std::any_of(other.mapped().begin(), other.mapped().end(),
                         [&](const PdoEntry &entry) { return entry.object == one.object; });
    });
    return signalOf(one.object) == Signal::Other && one.object.index > kLastGap && !wanted;
  });
}

bool carries(std::span<const Pdo> pdos, const PdoEntry &wanted) {
  return std::any_of(pdos.begin(), pdos.end(), [&](const Pdo &pdo) {
    return std::any_of(pdo.mapped().begin(), pdo.mapped().end(), [&](const PdoEntry &one) {
      return one.object == wanted.object && one.bits == wanted.bits;
    });
  });
}

} // namespace

/// Another PDO that cannot be switched off may have it.
bool StartUp::cover(const StartParts &parts, const PdoEntry &wanted, bool transmits) {
  LogicalDevice &device = parts.devices[now().device];
  DrivePlan plan = device.plan();
  const PdoEntry raw = {ofAxis(wanted.object, plan.axis), wanted.bits};
  const auto found = std::find_if(unused_.begin(), unused_.end(), [&](const FixedPdo &one) {
    return one.transmits == transmits && one.has(raw);
  });
  uint8_t &count = transmits ? plan.tpdoCount : plan.rpdoCount;
  if (found == unused_.end() || count == DrivePlan::kMostPdos)
    return false;
  Pdo &pdo = (transmits ? plan.tpdos : plan.rpdos)[count++];
  pdo = found->pdo;
  for (size_t i = 0; i < pdo.count; ++i)
    pdo.entries[i].object = inProfile(pdo.entries[i].object, plan.axis);
  unused_.erase(found);
  device.setPlan(plan);
  parts.planChanged = true;
  return true;
}

/// All that was planned must be in one of them; bytes of I/O devices have their places.
StartUp::Outcome StartUp::checkPdos(const StartParts &parts, bus::Message &message) {
  const DrivePlan &planned = parts.config.device(now().device).plan;
  LogicalDevice &device = parts.devices[now().device];
  const bool io = parts.config.kind == NodeConfig::Kind::Io;
  bool fits = !io;
  for (const bool transmits : {false, true}) {
    const std::span<const Pdo> wanted =
        transmits ? planned.sentByDrive() : planned.receivedByDrive();
    for (const Pdo &pdo : wanted)
      for (PdoEntry one : pdo.mapped()) {
        if (one.object == object::kTargetPosition &&
            modeFor(kPositionControl, device.facts().supportedModes) == mode::kInterpolatedPosition)
          one.object = object::kInterpolatedPosition;
        const DrivePlan &plan = device.plan();
        fits = fits && (carries(transmits ? plan.sentByDrive() : plan.receivedByDrive(), one) ||
                        cover(parts, one, transmits));
      }
  }
  for (const Pdo &pdo : device.plan().receivedByDrive())
    fits = fits && !hasUnknown(pdo, planned.receivedByDrive());
  if (fits)
    return Outcome::Next;
  message.set("node ", uint32_t{node_}, ", ", ObjectText(mismatch_.object), " is fixed: it is ",
              HexText(mismatchValue_), ", and would have to be ", HexText(mismatch_.value));
  return Outcome::Failed;
}

uint32_t StartUp::unusedBits() const {
  uint32_t bits = 0;
  for (const FixedPdo &pdo : unused_)
    bits += pdo.cyclic() ? worstBits(pdo.length()) : uint32_t{0};
  return bits;
}

StartUp::Outcome StartUp::compared(uint32_t value, const StartParts &parts,
                                   bus::Message &message) const {
  const SdoWrite &write = now().object;
  const uint32_t wanted = valueOf(write, parts);
  if (value == wanted)
    return Outcome::Next;
  message.set("node ", uint32_t{node_}, ", ", ObjectText(write.object), " is fixed: it is ",
              HexText(value), ", and would have to be ", HexText(wanted));
  return Outcome::Failed;
}

} // namespace stride::can
