#include "drivers/can/simulation/canopen_node.hpp"

#include "drivers/can/simulation/communication_rows.hpp"

#include <algorithm>

namespace stride::can::simulation {
namespace {

constexpr uint16_t kRequest = 0x600;
constexpr uint16_t kAnswer = 0x580;
constexpr uint16_t kErrorControlId = 0x700;
constexpr uint16_t kIdMask = 0x7F;
constexpr uint16_t kDeviceArea = 0x2000;

// Commands of the network management.
constexpr uint8_t kStart = 0x01;
constexpr uint8_t kStop = 0x02;
constexpr uint8_t kPreOperational = 0x80;
constexpr uint8_t kResetNode = 0x81;
constexpr uint8_t kResetCommunication = 0x82;

} // namespace

CanopenNode::CanopenNode(const NodeSetup &setup, const DeviceRows &device)
    : setup_(setup), id_(setup.id), dictionary_(allRows(setup_, device)), emergency_(dictionary_),
      control_(dictionary_), sdo_(dictionary_, *this, setup.sdo),
      process_(dictionary_, *this, emergency_, device.receive, device.transmit, setup.remotely),
      lss_({setup.vendor, setup.product, setup.revision, setup.serial}, setup.id),
      syncId_(dictionary_.at(0x1005)), syncPeriod_(dictionary_.at(0x1006)),
      syncOverflow_(dictionary_.at(0x1019)) {}

void CanopenNode::powerOn(int64_t nowNs) noexcept {
  now_ = nowNs;
  resetNode();
}

void CanopenNode::resetNode() noexcept {
  lss_.powerOn();
  dictionary_.restore(kDeviceArea, 0xFFFF, id_);
  emergency_.reset();
  emergency_.forget();
  onReset();
  resetCommunication();
}

void CanopenNode::resetCommunication() noexcept {
  enter(NmtState::Initialising);
  id_ = lss_.activate();
  dictionary_.restore(0, kDeviceArea - 1, id_);
  emergency_.forget();
  control_.reset(false, now_);
  control_.configure(now_);
  sdo_.reset();
  process_.configure();
  syncPending_ = false;
  syncNs_ = kNever;
  bootNs_ = id_ == kUnconfigured ? kNever : now_ + setup_.bootNs;
}

void CanopenNode::enter(NmtState state) noexcept {
  if (state == state_)
    return;
  if (state_ == NmtState::Operational)
    process_.end();
  state_ = state;
  if (!talks())
    sdo_.reset();
  onState(state);
  if (state_ == NmtState::Operational)
    process_.begin(now_);
}

bool CanopenNode::networkManagement(const Frame &frame) noexcept {
  if (frame.length != 2 || frame.remote || (frame.data[1] != 0 && frame.data[1] != id_))
    return false;
  switch (frame.data[0]) {
  case kStart:
    enter(NmtState::Operational);
    return true;
  case kStop:
    enter(NmtState::Stopped);
    return true;
  case kPreOperational:
    enter(NmtState::PreOperational);
    return true;
  case kResetNode:
    resetNode();
    return true;
  case kResetCommunication:
    resetCommunication();
    return true;
  default:
    return false;
  }
}

bool CanopenNode::synchronizedBy(const Frame &frame) const noexcept {
  return frame.id != 0 && frame.id == (syncId_.value & Frame::kLastId) && !frame.remote;
}

bool CanopenNode::receive(const Frame &frame, int64_t nowNs) noexcept {
  now_ = nowNs;
  if (frame.id == LssSlave::kRequestId && (hears() || id_ == kUnconfigured) && !silent_) {
    lss_.receive(frame);
    if (lss_.takeStart())
      resetCommunication();
    return true;
  }
  if (!hears())
    return false;
  if (frame.id == 0)
    return networkManagement(frame);
  if (synchronizedBy(frame)) {
    synchronize(frame);
    return true;
  }
  if (frame.id == kRequest + id_) {
    if (talks() && !deaf_)
      sdo_.receive(frame, nowNs);
  } else if ((frame.id & ~kIdMask) == kErrorControlId) {
    control_.receive(frame, id_, nowNs);
  } else if (process_.listensTo(frame.id)) {
    process_.receive(frame, nowNs);
  } else {
    return false;
  }
  watchMaster();
  process_.lookForEvents(nowNs);
  return true;
}

void CanopenNode::synchronize(const Frame &frame) noexcept {
  if (!talks())
    return;
  const bool counts = syncOverflow_.value > 1;
  if (frame.length != (counts ? 1 : 0)) {
    emergency_.raise(kErrorSyncLength, kCommunicationError);
    return;
  }
  emergency_.clear(kErrorSyncLength);
  onSync();
  process_.applySynchronous();
  onSynchronized();
  process_.sample(counts ? frame.data[0] : uint8_t{0}, now_);
  process_.lookForEvents(now_);
}

int64_t CanopenNode::syncPeriodNs() const noexcept {
  return static_cast<int64_t>(syncPeriod_.value) * kMicrosecond;
}

void CanopenNode::produceSync() noexcept {
  syncNs_ += syncPeriodNs();
  if (!talks())
    return;
  sync_ = {};
  sync_.id = static_cast<uint16_t>(syncId_.value & Frame::kLastId);
  if (syncOverflow_.value > 1) {
    syncCount_ =
        syncCount_ >= syncOverflow_.value ? uint8_t{1} : static_cast<uint8_t>(syncCount_ + 1);
    sync_.length = 1;
    sync_.data[0] = syncCount_;
  }
  syncPending_ = true;
  synchronize(sync_);
}

void CanopenNode::connectionLost(uint16_t code) noexcept {
  emergency_.raise(code, kCommunicationError);
  const uint64_t behaviour = dictionary_.value(0x1029, 1);
  onConnectionLost();
  if (behaviour == 0 && state_ == NmtState::Operational)
    enter(NmtState::PreOperational);
  else if (behaviour == 2)
    enter(NmtState::Stopped);
}

void CanopenNode::watchMaster() noexcept {
  if (control_.takeLost())
    connectionLost(kErrorLifeGuard);
  if (control_.takeBack())
    emergency_.clear(kErrorLifeGuard);
}

void CanopenNode::recovered(int64_t nowNs) noexcept {
  now_ = nowNs;
  if (state_ == NmtState::Initialising)
    return;
  connectionLost(kErrorBusOff);
  emergency_.clear(kErrorBusOff);
}

void CanopenNode::advance(int64_t nowNs) noexcept {
  now_ = nowNs;
  if (nowNs >= bootNs_) {
    bootNs_ = kNever;
    enter(NmtState::PreOperational);
    control_.reset(true, nowNs);
  }
  if (nowNs >= syncNs_)
    produceSync();
  control_.advance(nowNs);
  sdo_.advance(nowNs);
  if (nowNs >= nextDeviceNs())
    onTime();
  watchMaster();
  process_.lookForEvents(nowNs);
}

int64_t CanopenNode::nextNs() const noexcept {
  int64_t next = std::min({bootNs_, syncNs_, sdo_.nextNs(), process_.nextNs(), nextDeviceNs()});
  if (state_ != NmtState::Initialising)
    next = std::min(next, control_.nextNs());
  if (emergency_.nextNs() > now_) // before that it waits for the mailbox only
    next = std::min(next, emergency_.nextNs());
  return next;
}

bool CanopenNode::transmit(Frame &frame) noexcept {
  if (!silent_ && lss_.transmit(frame))
    return true;
  if (!hears())
    return false;
  if (control_.boots())
    return control_.transmit(frame, id_, state_);
  if (talks()) {
    if (syncPending_) {
      syncPending_ = false;
      frame = sync_;
      return true;
    }
    if (emergency_.transmit(frame, now_) || process_.transmit(frame))
      return true;
    if (sdo_.transmit(frame)) {
      frame.id = static_cast<uint16_t>(kAnswer + id_);
      return true;
    }
  }
  return control_.transmit(frame, id_, state_);
}

Abort CanopenNode::write(uint16_t index, uint8_t sub, uint64_t value) noexcept {
  Entry *entry = dictionary_.find(index, sub);
  if (entry == nullptr)
    return dictionary_.missing(index);
  value = Dictionary::fitted(entry->row.type, value);
  Abort code = Dictionary::checkRange(*entry, value);
  if (code == Abort::None)
    code = beforeWrite(*entry, value);
  if (code != Abort::None)
    return code;
  entry->value = value;
  written(*entry);
  return Abort::None;
}

Abort CanopenNode::beforeRead(Entry &entry) noexcept {
  if (entry.row.index >= kDeviceArea)
    onRead(entry);
  return Abort::None;
}

Abort CanopenNode::beforeWrite(const Entry &entry, uint64_t value) noexcept {
  return entry.row.index < kDeviceArea ? checkCommunication(entry, value) : onWrite(entry, value);
}

void CanopenNode::written(Entry &entry) noexcept {
  if (entry.row.index < kDeviceArea)
    communicationWritten(entry);
  else
    onWritten(entry);
}

} // namespace stride::can::simulation
