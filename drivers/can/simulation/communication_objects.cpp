// What the objects of the communication profile may be, and what they do. [CiA 301]
#include "drivers/can/simulation/canopen_node.hpp"
#include "drivers/can/simulation/communication_rows.hpp"

namespace stride::can::simulation {
namespace {

constexpr uint64_t kGenerating = 0x40000000;
constexpr uint64_t kNoMessage = 0x80000000;
constexpr uint64_t kIdentifier = 0x3FFFFFFF;

/// Bits of an identifier that a node with 11 bits has not.
bool tooLong(uint64_t cobId) { return (cobId & kIdentifier & ~uint64_t{Frame::kLastId}) != 0; }

} // namespace

Abort CanopenNode::checkCommunication(const Entry &entry, uint64_t value) const noexcept {
  const uint16_t index = entry.row.index;
  if (ProcessData::isParameter(index))
    return process_.beforeWrite(entry, value, state_ == NmtState::PreOperational);
  switch (index) {
  case 0x1003: // only to be emptied
    return value == 0 ? Abort::None : Abort::Value;
  case 0x1005: {
    const bool generating = (entry.value & value & kGenerating) != 0;
    return tooLong(value) || (generating && ((entry.value ^ value) & kIdentifier) != 0)
               ? Abort::Value
               : Abort::None;
  }
  case 0x1019:
    if (syncPeriod_.value != 0)
      return Abort::State;
    return value == 1 ? Abort::Value : Abort::None;
  case 0x1010:
    return value == kSave ? Abort::None : Abort::NotStored;
  case 0x1011:
    return value == kLoad ? Abort::None : Abort::NotStored;
  case 0x1014: {
    const bool stays = ((entry.value | value) & kNoMessage) == 0;
    return tooLong(value) || (stays && ((entry.value ^ value) & kIdentifier) != 0) ? Abort::Value
                                                                                   : Abort::None;
  }
  case 0x1016:
    return control_.beforeWrite(entry, value);
  default:
    return Abort::None;
  }
}

void CanopenNode::communicationWritten(Entry &entry) noexcept {
  const uint16_t index = entry.row.index;
  if (ProcessData::isParameter(index))
    process_.configure();
  switch (index) {
  case 0x1003:
    emergency_.forget();
    return;
  case 0x1005:
  case 0x1006: {
    const bool produces = (syncId_.value & kGenerating) != 0 && syncPeriod_.value != 0;
    syncNs_ = produces ? now_ + syncPeriodNs() : kNever;
    syncCount_ = 0;
    break;
  }
  case 0x100C:
  case 0x100D:
  case 0x1016:
  case 0x1017:
    control_.configure(now_);
    break;
  case 0x1010:
    entry.value = 1; // the signature is not its value
    dictionary_.store(0, 0xFFFF);
    return;
  case 0x1011:
    entry.value = 1;
    dictionary_.forgetStored();
    return;
  case 0x1020:
    return;
  default:
    break;
  }
  // Whoever trusts the date of a configuration must not find it after a change.
  for (const uint8_t sub : {uint8_t{1}, uint8_t{2}})
    dictionary_.find(0x1020, sub)->value = 0;
}

} // namespace stride::can::simulation
