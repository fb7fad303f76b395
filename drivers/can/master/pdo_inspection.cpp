#include "drivers/can/master/pdo_inspection.hpp"

#include <algorithm>

namespace stride::can {
namespace {

constexpr uint16_t kBlock = 0x200; ///< Of 1400h, 1600h, 1800h and 1A00h each.

} // namespace

bool FixedPdo::has(const PdoEntry &entry) const {
  return known && std::any_of(pdo.mapped().begin(), pdo.mapped().end(), [&](const PdoEntry &one) {
           return one.object == entry.object && one.bits == entry.bits;
         });
}

void PdoInspection::begin(Object object) {
  result_ = {};
  result_.transmits = object.index >= object::kTpdoCommunication;
  result_.pdo.number = static_cast<uint16_t>(object.index % kBlock + 1);
  step_ = Step::CobId;
  count_ = 0;
}

void PdoInspection::beginMapping(Object object) {
  begin(object);
  step_ = Step::Count;
}

uint16_t PdoInspection::communication() const {
  const uint16_t first =
      result_.transmits ? object::kTpdoCommunication : object::kRpdoCommunication;
  return static_cast<uint16_t>(first + result_.pdo.number - 1);
}

uint16_t PdoInspection::mapping() const { return static_cast<uint16_t>(communication() + kBlock); }

Object PdoInspection::wish() const {
  switch (step_) {
  case Step::CobId:
    return {communication(), 1};
  case Step::Type:
    return {communication(), 2};
  case Step::Count:
    return {mapping(), 0};
  case Step::Entry:
    break;
  }
  return {mapping(), static_cast<uint8_t>(result_.pdo.count + 1)};
}

/// Above eight objects it is a multiplexed PDO, or nonsense.
bool PdoInspection::counted(bool there, uint32_t value) {
  result_.count = there ? value : 0;
  result_.known = there && value <= Pdo::kMostEntries;
  count_ = result_.known ? static_cast<uint8_t>(value) : uint8_t{0};
  step_ = Step::Entry;
  return count_ == 0;
}

bool PdoInspection::answered(bool there, uint32_t value) {
  Pdo &pdo = result_.pdo;
  switch (step_) {
  case Step::CobId:
    result_.cobId = value;
    result_.on = there && (value & kPdoInvalid) == 0;
    pdo.cobId = static_cast<uint16_t>(value & Frame::kLastId);
    step_ = Step::Type;
    return !result_.on;
  case Step::Type:
    pdo.transmission = there ? static_cast<uint8_t>(value) : Pdo::kByEvent;
    step_ = Step::Count;
    return false;
  case Step::Count:
    return counted(there, value);
  case Step::Entry:
    break;
  }
  const auto bits = static_cast<uint8_t>(value & 0xFFU);
  if (!there || bits == 0 || pdo.bits() + bits > Pdo::kMostBits) {
    result_.known = false;
    return true;
  }
  pdo.entries[pdo.count++] = {
      {static_cast<uint16_t>(value >> 16U), static_cast<uint8_t>(value >> 8U & 0xFFU)}, bits};
  return pdo.count == count_;
}

} // namespace stride::can
