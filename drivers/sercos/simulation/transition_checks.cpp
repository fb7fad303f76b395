// What a device looks at before it lets the ring into phase 3. [IEC 61491, S-0-0127]
#include "drivers/sercos/protocol/timing.hpp"
#include "drivers/sercos/simulation/device.hpp"

#include <algorithm>

namespace stride::sercos::simulation {
namespace {

using namespace idns;

/// One that is in the list already stays there once.
void reject(IdnEntry &invalid, Idn idn) {
  for (size_t i = 0; i < invalid.count(); ++i)
    if (invalid.id(i) == idn)
      return;
  invalid.add(idn);
}

} // namespace

/// The cyclic data as S-0-0015, S-0-0016 and S-0-0024 have it; FALSE: that telegram cannot be.
bool Device::configure() noexcept {
  at_.clear();
  mdt_.clear();
  const auto type = static_cast<uint16_t>(list_.value(kTelegramType));
  if ((type & kTelegramMask) == kApplicationTelegram) {
    const IdnEntry &at = list_.at(kAtList);
    const IdnEntry &mdt = list_.at(kMdtList);
    bool good = true;
    for (size_t i = 0; i < at.count(); ++i)
      good = at_.add(list_.at(at.id(i))) && good;
    for (size_t i = 0; i < mdt.count(); ++i)
      good = mdt_.add(list_.at(mdt.id(i))) && good;
    return good;
  }
  const TelegramContents contents = standardTelegram(type);
  for (const Idn idn : contents.at) {
    IdnEntry *entry = list_.find(idn);
    if (entry == nullptr || !at_.add(*entry))
      return false;
  }
  for (const Idn idn : contents.mdt) {
    IdnEntry *entry = list_.find(idn);
    if (entry == nullptr || !mdt_.add(*entry))
      return false;
  }
  return true;
}

/// Whether a configured list has only what can travel so, and not too much of it.
bool Device::checkList(Idn list, uint8_t telegram, Idn most) noexcept {
  const IdnEntry &entry = list_.at(list);
  size_t bytes = 0;
  for (size_t i = 0; i < entry.count(); ++i) {
    const IdnEntry &one = list_.at(entry.id(i));
    bytes += one.row.attribute.bytes;
    if ((one.row.cyclic & telegram) == 0)
      return false;
    for (size_t k = 0; k < i; ++k)
      if (entry.id(k) == entry.id(i))
        return false;
  }
  return entry.count() <= kMostCyclicObjects && static_cast<int64_t>(bytes) <= list_.value(most);
}

void Device::checkTimes(IdnEntry &invalid) noexcept {
  const auto us = [this](Idn idn) { return static_cast<uint32_t>(list_.value(idn)); };
  const uint32_t cycle = us(kCommunicationCycle);
  const uint32_t at = telegramUs(static_cast<uint32_t>(kHeadBytes + at_.bytes), baudRate_);
  const uint32_t mdt = telegramUs(us(kMdtLength), baudRate_);
  const uint32_t mst = telegramUs(kMstDataBytes, baudRate_);
  if (!isCycle(cycle)) {
    reject(invalid, kCommunicationCycle);
    return;
  }
  if (us(kControlUnitCycle) == 0 || us(kControlUnitCycle) % cycle != 0)
    reject(invalid, kControlUnitCycle);
  if (us(kAtStart) <= us(kShortestAtStart) || us(kAtStart) + at + us(kAtToMdt) > us(kMdtStart))
    reject(invalid, kAtStart);
  if (us(kMdtStart) + mdt + us(kMdtToMst) + mst + kJitterUs > cycle)
    reject(invalid, kMdtStart);
  if (us(kFeedbackSampling) + us(kShortestFeedback) > cycle)
    reject(invalid, kFeedbackSampling);
  if (us(kCommandValid) > cycle ||
      us(kMdtStart) + mdt + us(kCommandProcessing) >= us(kCommandValid))
    reject(invalid, kCommandValid);
}

void Device::checkPlace(IdnEntry &invalid) noexcept {
  const int64_t place = list_.value(kPlaceInMdt);
  const int64_t length = list_.value(kMdtLength);
  const auto record = static_cast<int64_t>(kHeadBytes + mdt_.bytes);
  if (length < static_cast<int64_t>(kHeadBytes) || length % 2 != 0 ||
      length > static_cast<int64_t>(kMostMdtBytes))
    reject(invalid, kMdtLength);
  if (place < 1 || place % 2 == 0 || place - 1 + record > length)
    reject(invalid, kPlaceInMdt);
}

/// S-0-0127: fills S-0-0021.
void Device::checkPhase3() noexcept {
  IdnEntry &invalid = list_.at(kInvalidPhase2);
  invalid.clear();
  for (const IdnEntry &entry : list_.entries())
    if (entry.row.given == Given::Phase2 && !entry.given)
      reject(invalid, entry.row.idn);
  const auto type = static_cast<uint16_t>(list_.value(kTelegramType));
  if ((type & kTelegramMask) == kApplicationTelegram) {
    if (!checkList(kAtList, kInAt, kMostAtData))
      reject(invalid, kAtList);
    if (!checkList(kMdtList, kInMdt, kMostMdtData))
      reject(invalid, kMdtList);
  }
  const bool known = (type & ~(kTelegramMask | kExternalFeedback)) == 0;
  if (!configure() || !known)
    reject(invalid, kTelegramType);
  if (invalid.list.empty()) { // else these would only follow from that
    checkTimes(invalid);
    checkPlace(invalid);
  }
}

} // namespace stride::sercos::simulation
