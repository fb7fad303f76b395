#include "drivers/sercos/simulation/device.hpp"

#include <algorithm>

namespace stride::sercos::simulation {
namespace {

using namespace idns;

/// Commands that this file carries out itself.
bool isOwnCommand(Idn idn) {
  return idn == kCheckPhase3 || idn == kCheckPhase4 || idn == kResetClass1;
}

} // namespace

bool Device::Cyclic::add(IdnEntry &entry) {
  if (count == entries.size())
    return false;
  entries[count++] = &entry;
  bytes += entry.row.attribute.bytes;
  return true;
}

Device::Device(const DeviceSetup &setup, std::vector<IdnRow> rows)
    : setup_(setup), list_(std::move(rows)), channel_(list_, *this), address_(setup.address) {}

void Device::beginCycle(int64_t periodNs, uint8_t baudRate) noexcept {
  periodNs_ = periodNs;
  baudRate_ = baudRate;
}

// ---- phases

void Device::enter(Phase phase) noexcept {
  const Phase before = phase_;
  phase_ = phase;
  missedMsts_ = missedMdts_ = 0;
  if (phase == Phase::Zero || phase == Phase::One)
    asked_ = false;
  if (phase == Phase::Zero) {
    channel_.reset();
    controlWord_ = 0;
    readyFor3_ = readyFor4_ = commandChanged_ = false;
    checking_ = nullptr;
    for (IdnEntry &entry : list_.entries()) {
      entry.given = false;
      if (entry.isCommand()) {
        if ((entry.state & data_state::kCommandMask) == data_state::kRunning)
          onCommandEnd(entry.row.idn);
        entry.state = data_state::kIdle;
        entry.value = 0;
      }
    }
  }
  // The phase is in the three low bits; what was wrong stays until S-0-0099.
  IdnEntry &state = list_.at(kInterfaceStatus);
  state.value = (state.value & interface_status::kFaults) | static_cast<int64_t>(phase);
  onPhase(before);
}

/// What the MST says of the phase; FALSE: it was not where the device looks for it.
bool Device::followPhase(uint8_t phase) noexcept {
  const auto now = static_cast<uint8_t>(phase_);
  if (phase > static_cast<uint8_t>(Phase::Four))
    raiseInterfaceError(interface_status::kInvalidPhase);
  else if (phase > now + 1)
    raiseInterfaceError(interface_status::kAdvance);
  else if (phase < now && phase != 0)
    raiseInterfaceError(interface_status::kRegression);
  else if ((phase == 3 && now == 2 && !readyFor3_) || (phase == 4 && now == 3 && !readyFor4_))
    raiseInterfaceError(interface_status::kNotReady);
  else if (phase != now)
    enter(static_cast<Phase>(phase));
  else if (now >= 3) { // in another cycle than agreed
    const int64_t agreed = list_.value(kCommunicationCycle) * 1000;
    const int64_t off = periodNs_ > agreed ? periodNs_ - agreed : agreed - periodNs_;
    return off <= agreed / 4;
  }
  return true;
}

void Device::receiveMst(uint8_t phase) noexcept {
  const bool heard = !hasLeft() && !occurs(faults_.loseMsts);
  waits_ = waits_ && !(heard && phase == 0);
  if (!heard || (!waits_ && !followPhase(phase))) {
    missMst();
    return;
  }
  missedMsts_ = 0;
  runCommands();
  onCycle(periodNs_);
  updateStatus();
}

void Device::missMst() noexcept {
  ++list_.at(kMstErrors).value;
  if (phase_ != Phase::Zero && ++missedMsts_ >= kMostMisses)
    raiseInterfaceError(interface_status::kMstFailure);
  runCommands();
  onCycle(periodNs_);
  updateStatus();
}

void Device::missMdt() noexcept {
  asked_ = false;
  hadMdt_ = false;
  if (phase_ != Phase::Three && phase_ != Phase::Four)
    return;
  ++list_.at(kMdtErrors).value;
  if (++missedMdts_ >= kMostMisses) {
    raiseInterfaceError(interface_status::kMdtFailure);
    updateStatus();
  }
}

// ---- telegrams

bool Device::transmit(DriveTelegram &telegram) noexcept {
  if (hasLeft() || address_ == kNoAddress || phase_ == Phase::Zero)
    return false;
  const bool cyclic = phase_ == Phase::Three || phase_ == Phase::Four;
  if ((!cyclic && !asked_) || missedMsts_ != 0 || occurs(faults_.loseAts))
    return false;
  telegram.address = faults_.answersAs != 0 ? faults_.answersAs : address_;
  telegram.distorted = occurs(faults_.distortAts);
  putWord(telegram.data, 0, statusWord_);
  putWord(telegram.data, 2, channel_.word());
  size_t place = kHeadBytes;
  if (cyclic)
    for (size_t i = 0; i < at_.count; ++i) {
      const IdnEntry &entry = *at_.entries[i];
      for (unsigned byte = 0; byte < entry.row.attribute.bytes; ++byte)
        telegram.data[place++] =
            static_cast<uint8_t>(static_cast<uint64_t>(entry.value) >> (8 * byte));
    }
  telegram.length = static_cast<uint8_t>(place);
  return true;
}

void Device::receiveMdt(uint8_t address, std::span<const uint8_t> data) noexcept {
  const bool cyclic = phase_ == Phase::Three || phase_ == Phase::Four;
  asked_ = false;
  if (phase_ == Phase::Zero || address_ == kNoAddress)
    return;
  if (hasLeft() || occurs(faults_.loseMdts)) {
    missMdt();
    return;
  }
  if (!cyclic) {
    asked_ = address == address_;
    if (asked_ && phase_ == Phase::Two && data.size() >= kHeadBytes)
      receiveRecord(data);
  } else {
    const auto place = static_cast<size_t>(list_.value(kPlaceInMdt)) - 1;
    const bool whole = address == kBroadcast &&
                       data.size() == static_cast<size_t>(list_.value(kMdtLength)) &&
                       place + kHeadBytes + mdt_.bytes <= data.size();
    if (!whole) {
      missMdt();
      return;
    }
    missedMdts_ = 0;
    hadMdt_ = true;
    receiveRecord(data.subspan(place));
  }
  updateStatus();
}

void Device::receiveRecord(std::span<const uint8_t> record) noexcept {
  const uint16_t before = controlWord_;
  const uint16_t word = wordAt(record, 0);
  if (!faults_.mute && !mute_)
    channel_.receive(word, wordAt(record, 2), faults_.busyCycles);
  if (phase_ != Phase::Four)
    return;
  controlWord_ = word;
  list_.at(kControlWord).value = word;
  size_t place = kHeadBytes;
  for (size_t i = 0; i < mdt_.count; ++i) {
    IdnEntry &entry = *mdt_.entries[i];
    uint64_t bits = 0;
    for (unsigned byte = 0; byte < entry.row.attribute.bytes; ++byte)
      bits |= uint64_t{record[place++]} << (8 * byte);
    entry.value = fitted(entry.row.attribute, bits);
  }
  updateRealTimeBits(before);
}

/// What the real-time control bits stand for gets their values.
void Device::updateRealTimeBits(uint16_t before) noexcept {
  constexpr std::array<Idn, 2> kAssigned = {kRealTimeControl1, kRealTimeControl2};
  constexpr std::array<uint16_t, 2> kBits = {control::kRealTime1, control::kRealTime2};
  for (size_t i = 0; i < kAssigned.size(); ++i) {
    IdnEntry *entry = list_.find(static_cast<Idn>(list_.value(kAssigned[i])));
    if (entry == nullptr || list_.value(kAssigned[i]) == 0)
      continue;
    entry->value = (controlWord_ & kBits[i]) != 0 ? 1 : 0;
    if (((controlWord_ ^ before) & kBits[i]) != 0)
      onData(*entry);
  }
}

void Device::updateStatus() noexcept {
  uint16_t word = static_cast<uint16_t>(channel_.statusBits() | deviceStatus());
  word |= commandChanged_ ? status::kCommandChange : 0;
  word |= class3Changed_ ? status::kClass3 : 0;
  word |= class2Changed_ ? status::kClass2 : 0;
  word |= class1_ != 0 ? status::kClass1 : 0;
  constexpr std::array<Idn, 2> kAssigned = {kRealTimeStatus1, kRealTimeStatus2};
  constexpr std::array<uint16_t, 2> kBits = {status::kRealTime1, status::kRealTime2};
  for (size_t i = 0; i < kAssigned.size(); ++i) {
    const auto idn = static_cast<Idn>(list_.value(kAssigned[i]));
    if (idn != 0 && (list_.value(idn) & 1) != 0)
      word |= kBits[i];
  }
  statusWord_ = word;
  list_.at(kStatusWord).value = word;
}

// ---- procedure commands

void Device::endCommand(Idn idn, uint16_t state) noexcept {
  IdnEntry &entry = list_.at(idn);
  if ((entry.state & data_state::kCommandMask) != data_state::kRunning)
    return;
  entry.state = state;
  commandChanged_ = true;
}

uint16_t Device::startCommand(IdnEntry &entry) noexcept {
  if (!isOwnCommand(entry.row.idn))
    return onCommand(entry.row.idn);
  if (checking_ != nullptr)
    return data_state::kFailed;
  checking_ = &entry;
  checkCycles_ = std::max(setup_.commandCycles, 1U);
  return data_state::kRunning;
}

void Device::writeCommand(IdnEntry &entry) noexcept {
  const auto state = static_cast<uint16_t>(entry.state & data_state::kCommandMask);
  const auto word = static_cast<uint16_t>(entry.value & command::kStart);
  if (word == command::kStart) {
    if (state != data_state::kIdle && state != data_state::kInterrupted)
      return; // it runs, or has run and was not cancelled
    entry.state = startCommand(entry);
    commandChanged_ = commandChanged_ || entry.state != data_state::kRunning;
    return;
  }
  if (state == data_state::kRunning || state == data_state::kInterrupted) {
    if (checking_ == &entry)
      checking_ = nullptr;
    else
      onCommandEnd(entry.row.idn);
  }
  entry.state = word == command::kInterrupt && state == data_state::kRunning
                    ? data_state::kInterrupted
                    : data_state::kIdle;
  commandChanged_ = false;
}

/// Of this file's commands the one that runs.
void Device::runCommands() noexcept {
  if (checking_ == nullptr || --checkCycles_ != 0)
    return;
  const Idn idn = checking_->row.idn;
  checking_ = nullptr;
  bool good = true;
  if (idn == kCheckPhase3) {
    checkPhase3();
    good = readyFor3_ =
        list_.at(kInvalidPhase2).list.empty() && !faults_.failPhase3 && !failPhase3_;
  } else if (idn == kCheckPhase4) {
    IdnEntry &invalid = list_.at(kInvalidPhase3);
    invalid.clear();
    checkPhase4(invalid);
    good = readyFor4_ = invalid.list.empty() && !faults_.failPhase4;
  } else {
    good = canReset();
    if (good) {
      class1_ = 0;
      list_.at(kClass1).value = 0;
      list_.at(kManufacturerClass1).value = 0;
      list_.at(kInterfaceStatus).value &= ~int64_t{interface_status::kFaults};
      list_.at(kDiagnosticMessage).setText("ready");
      onReset();
    }
  }
  endCommand(idn, good ? data_state::kDone : data_state::kFailed);
}

// ---- diagnostics

void Device::raiseError(uint16_t bits, uint16_t number, std::string_view text) noexcept {
  const auto fresh = static_cast<uint16_t>(bits & ~class1_);
  class1_ |= bits;
  list_.at(kClass1).value = class1_;
  if (number != 0)
    list_.at(kManufacturerClass1).value = number;
  if (fresh == 0)
    return;
  list_.at(kDiagnosticMessage).setText(text);
  onError();
}

void Device::raiseInterfaceError(uint16_t bits) noexcept {
  list_.at(kInterfaceStatus).value |= bits;
  raiseError(class1::kCommunication, 0, "communication error, see S-0-0014");
  if (bits == interface_status::kMode)
    return;
  waits_ = true;
  if (phase_ != Phase::Zero)
    enter(Phase::Zero);
}

void Device::setClass2(uint16_t bits) noexcept {
  IdnEntry &entry = list_.at(kClass2);
  const int64_t changed = (entry.value ^ bits) & list_.value(kClass2Mask);
  entry.value = bits;
  class2Changed_ = class2Changed_ || changed != 0;
}

void Device::setClass3(uint16_t bits) noexcept {
  IdnEntry &entry = list_.at(kClass3);
  const int64_t changed = (entry.value ^ bits) & list_.value(kClass3Mask);
  entry.value = bits;
  class3Changed_ = class3Changed_ || changed != 0;
}

void Device::setDisturbed(bool leaves, bool mute, bool failPhase3) noexcept {
  leaves_ = leaves;
  mute_ = mute;
  failPhase3_ = failPhase3;
}

bool Device::isCyclicCommand(Idn idn) const noexcept {
  for (size_t i = 0; i < mdt_.count; ++i)
    if (mdt_.entries[i]->row.idn == idn)
      return true;
  return false;
}

// ---- service channel

uint16_t Device::onOpen(const IdnEntry &entry) noexcept {
  const bool refused = faults_.refuses && faults_.refused == entry.row.idn;
  return refused && faults_.reason >> 12U == 1 ? faults_.reason : service_error::kNone;
}

uint16_t Device::onWrite(IdnEntry &entry, int64_t value, std::span<const uint8_t> bytes) noexcept {
  if (faults_.refuses && faults_.refused == entry.row.idn)
    return faults_.reason;
  if (phase_ == Phase::Four && isCyclicCommand(entry.row.idn))
    return service_error::kCyclic;
  const bool ids = entry.isList() && entry.row.attribute.display == Display::Idn;
  for (size_t i = 0; ids && i + 1 < bytes.size(); i += 2)
    if (list_.find(wordAt(bytes, i)) == nullptr)
      return service_error::kInvalidData;
  if (entry.isCommand())
    return (value & ~int64_t{command::kStart}) != 0 || value == 2 ? service_error::kInvalidData
                                                                  : service_error::kNone;
  return entry.isList() ? service_error::kNone : checkData(entry, value);
}

void Device::onWritten(IdnEntry &entry) noexcept {
  if (entry.isCommand()) {
    writeCommand(entry);
    return;
  }
  if (phase_ == Phase::Two) // what has been checked is not what there is now
    readyFor3_ = false;
  if (phase_ == Phase::Three)
    readyFor4_ = false;
  if (!entry.isList())
    onData(entry);
}

void Device::onRead(IdnEntry &entry) noexcept {
  if (entry.row.idn == kClass2)
    class2Changed_ = false;
  else if (entry.row.idn == kClass3)
    class3Changed_ = false;
}

} // namespace stride::sercos::simulation
