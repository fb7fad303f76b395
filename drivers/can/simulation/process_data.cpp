#include "drivers/can/simulation/process_data.hpp"

#include <algorithm>

namespace stride::can::simulation {
int64_t ProcessData::Pdo::eventNs() const {
  return static_cast<int64_t>(event->value) * kMillisecond;
}

int64_t ProcessData::Pdo::inhibitNs() const {
  return static_cast<int64_t>(inhibit->value) * kInhibitUnit;
}

void ProcessData::begin(int64_t nowNs) noexcept {
  operational_ = true;
  for (Pdo &pdo : pdos_) {
    pdo.pending = pdo.seen = false;
    pdo.due = true;
    pdo.syncs = 0;
    pdo.waits = pdo.start != nullptr && pdo.start->value != 0;
    pdo.lastNs = nowNs - pdo.inhibitNs();
  }
  lookForEvents(nowNs);
}

void ProcessData::end() noexcept {
  operational_ = false;
  for (Pdo &pdo : pdos_)
    pdo.pending = pdo.seen = false;
}

void ProcessData::receive(const Frame &frame, int64_t nowNs) noexcept {
  if (!operational_)
    return;
  for (Pdo &pdo : pdos_) {
    if (!pdo.exists || pdo.id != frame.id || pdo.places == 0)
      continue;
    if (transmits(pdo)) {
      if (!frame.remote || !remotely_)
        continue;
      build(pdo);
      pdo.pending = true;
      continue;
    }
    if (frame.remote)
      continue;
    if (frame.length < pdo.bytes) {
      emergency_.raise(kErrorPdoLength, kCommunicationError);
      continue;
    }
    emergency_.clear(kErrorPdoLength);
    emergency_.clear(kErrorPdoTimeout);
    pdo.frame = frame;
    pdo.seen = true;
    pdo.lastNs = nowNs;
    pdo.pending = pdo.synchronous();
    if (!pdo.pending)
      apply(pdo);
  }
}

/// What the device does not take stays as it is: there is nobody who could be told.
void ProcessData::apply(Pdo &pdo) noexcept {
  size_t from = 0;
  for (size_t i = 0; i < pdo.places; ++i) {
    const Place &place = pdo.content[i];
    const auto bytes = std::span(pdo.frame.data).subspan(from, place.bytes);
    from += place.bytes;
    if (place.entry == nullptr)
      continue;
    const uint64_t value = Dictionary::fitted(place.entry->row.type, decode(bytes));
    if (Dictionary::checkRange(*place.entry, value) != Abort::None ||
        rules_.beforeWrite(*place.entry, value) != Abort::None)
      continue;
    place.entry->value = value;
    rules_.written(*place.entry);
  }
}

void ProcessData::applySynchronous() noexcept {
  for (size_t i = 0; i < receivers_; ++i) {
    if (!pdos_[i].pending)
      continue;
    pdos_[i].pending = false;
    apply(pdos_[i]);
  }
}

void ProcessData::build(Pdo &pdo) noexcept {
  pdo.frame = {};
  pdo.frame.id = pdo.id;
  pdo.frame.length = pdo.bytes;
  size_t to = 0;
  for (size_t i = 0; i < pdo.places; ++i) {
    const Place &place = pdo.content[i];
    const uint64_t value = place.entry == nullptr ? 0 : place.entry->value;
    encode(value, std::span(pdo.frame.data).subspan(to, place.bytes));
    to += place.bytes;
  }
}

void ProcessData::sample(uint8_t counter, int64_t nowNs) noexcept {
  if (!operational_)
    return;
  for (size_t i = receivers_; i < pdos_.size(); ++i) {
    Pdo &pdo = pdos_[i];
    if (!pdo.exists || pdo.places == 0 || !pdo.synchronous())
      continue;
    if (pdo.waits && counter != 0 && counter != pdo.start->value)
      continue;
    if (pdo.waits) // this SYNC is the first one that counts
      pdo.syncs = pdo.type->value == 0 ? 0 : static_cast<uint8_t>(pdo.type->value - 1);
    pdo.waits = false;
    ++pdo.syncs;
    const bool now = pdo.type->value == 0 ? pdo.due : pdo.syncs >= pdo.type->value;
    if (!now)
      continue;
    pdo.syncs = 0;
    pdo.due = false;
    build(pdo);
    pdo.seen = true;
    pdo.sent = pdo.frame;
    pdo.pending = true;
    pdo.lastNs = nowNs;
  }
}

/// Whether what is to be sent differs from what was, in something that counts as an event.
bool ProcessData::changed(const Pdo &pdo) const noexcept {
  if (!pdo.seen)
    return true;
  size_t from = 0;
  for (size_t i = 0; i < pdo.places; ++i) {
    const Place &place = pdo.content[i];
    const auto *const now = pdo.frame.data.begin() + from;
    if (place.entry != nullptr && rules_.triggers(*place.entry) &&
        !std::equal(now, now + place.bytes, pdo.sent.data.begin() + from))
      return true;
    from += place.bytes;
  }
  return false;
}

/// Event-driven ones go when their bytes have changed, or when their time is over; not before the
/// inhibit time is.
void ProcessData::watch(Pdo &pdo, int64_t nowNs) noexcept {
  const Frame before = pdo.frame;
  const bool pending = pdo.pending;
  build(pdo);
  const bool event = changed(pdo);
  if (pdo.type->value == 0) {
    pdo.due = pdo.due || event;
    pdo.frame = before;
    return;
  }
  const bool over = pdo.eventNs() > 0 && nowNs - pdo.lastNs >= pdo.eventNs();
  if ((!event && !over && !pending) || (!pending && nowNs - pdo.lastNs < pdo.inhibitNs())) {
    pdo.due = event;
    return;
  }
  pdo.due = false;
  if (!pending || over)
    pdo.lastNs = nowNs;
  pdo.pending = true;
  pdo.seen = true;
  pdo.sent = pdo.frame;
}

void ProcessData::lookForEvents(int64_t nowNs) noexcept {
  if (!operational_)
    return;
  for (Pdo &pdo : pdos_) {
    if (!pdo.exists || pdo.places == 0)
      continue;
    if (transmits(pdo)) {
      if (!pdo.synchronous() || pdo.type->value == 0)
        watch(pdo, nowNs);
    } else if (pdo.seen && pdo.eventNs() > 0 && nowNs - pdo.lastNs >= pdo.eventNs()) {
      pdo.seen = false; // told once
      emergency_.raise(kErrorPdoTimeout, kCommunicationError);
    }
  }
}

/// When lookForEvents has something to do though nothing changes.
int64_t ProcessData::nextNs() const noexcept {
  int64_t next = kNever;
  if (!operational_)
    return next;
  for (const Pdo &pdo : pdos_) {
    if (!pdo.exists || pdo.places == 0)
      continue;
    const bool sends = transmits(pdo);
    if (sends && pdo.synchronous())
      continue;
    if (pdo.eventNs() > 0 && (sends || pdo.seen))
      next = std::min(next, pdo.lastNs + std::max(pdo.eventNs(), sends ? pdo.inhibitNs() : 0));
    if (sends && pdo.due)
      next = std::min(next, pdo.lastNs + pdo.inhibitNs());
  }
  return next;
}

bool ProcessData::transmit(Frame &frame) noexcept {
  for (size_t i = receivers_; i < pdos_.size(); ++i) {
    if (!pdos_[i].pending)
      continue;
    pdos_[i].pending = false;
    frame = pdos_[i].frame;
    return true;
  }
  return false;
}

} // namespace stride::can::simulation
