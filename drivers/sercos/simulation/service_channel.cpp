#include "drivers/sercos/simulation/service_channel.hpp"

#include "drivers/sercos/protocol/service_error.hpp"

#include <algorithm>

namespace stride::sercos::simulation {
namespace {

constexpr size_t kListHead = 4; ///< Bytes now, most bytes.

std::span<const uint8_t> bytesOf(std::string_view text) {
  return {reinterpret_cast<const uint8_t *>(text.data()), text.size()};
}

size_t mostBytes(const IdnList &list) {
  size_t most = 8;
  for (const IdnEntry &entry : list.entries())
    most = std::max({most, entry.room, entry.row.name.size() + 1, entry.row.unit.size() + 1});
  return most + kListHead;
}

} // namespace

ServiceChannel::ServiceChannel(IdnList &list, ServiceHost &host)
    : list_(list), host_(host), buffer_(mostBytes(list)) {}

void ServiceChannel::reset() noexcept {
  entry_ = nullptr;
  element_ = Element::None;
  status_ = word_ = 0;
  busy_ = 0;
}

void ServiceChannel::receive(uint16_t controlWord, uint16_t word, uint32_t busyCycles) noexcept {
  const bool isNew = (controlWord & control::kMhs) != (status_ & status::kAhs);
  if (!isNew) { // a repetition; or a step has been taken back before it was carried out
    status_ &= static_cast<uint16_t>(~status::kBusy);
    return;
  }
  if ((status_ & status::kBusy) == 0) {
    busy_ = busyCycles;
    status_ |= status::kBusy;
  } else if (busy_ > 0) {
    --busy_;
  }
  if (busy_ > 0)
    return;
  status_ = static_cast<uint16_t>(controlWord & control::kMhs); // kAhs is the same bit
  step(controlWord, word);
}

void ServiceChannel::step(uint16_t controlWord, uint16_t word) noexcept {
  const Element element = elementOf(controlWord);
  const bool writes = (controlWord & control::kWrite) != 0;
  const bool end = (controlWord & control::kEnd) != 0;
  uint16_t error = service_error::kNone;
  word_ = 0;
  if (element == Element::None) {
    entry_ = nullptr;
    element_ = Element::None;
  } else if (element == Element::Idn && writes) {
    error = openIdn(word, end);
  } else if (entry_ == nullptr) {
    error = service_error::kNotOpen;
  } else {
    if (element != element_ || writes != writing_) {
      error = writes ? beginWriting(element) : beginReading(element);
      element_ = element;
      writing_ = writes;
      place_ = 0;
    }
    if (error == service_error::kNone)
      error = writes ? write(word, end) : read(end);
  }
  if (error != service_error::kNone) {
    element_ = Element::None;
    status_ |= status::kError;
    word_ = error;
  }
}

uint16_t ServiceChannel::openIdn(uint16_t word, bool end) noexcept {
  entry_ = nullptr;
  element_ = Element::None;
  if (!end)
    return service_error::kIdnAccess;
  IdnEntry *entry = list_.find(word);
  if (entry == nullptr)
    return service_error::kNoIdn;
  const uint16_t error = host_.onOpen(*entry);
  if (error == service_error::kNone)
    entry_ = entry;
  return error;
}

void ServiceChannel::put(uint64_t value, size_t bytes) noexcept {
  for (size_t i = 0; i < bytes; ++i)
    buffer_[i] = static_cast<uint8_t>(value >> (8 * i));
  length_ = bytes;
}

void ServiceChannel::putList(std::span<const uint8_t> bytes, size_t room) noexcept {
  put(bytes.size() | (room << 16U), kListHead);
  std::copy(bytes.begin(), bytes.end(), buffer_.begin() + kListHead);
  length_ = kListHead + bytes.size();
  if (length_ % 2 != 0)
    buffer_[length_++] = 0;
}

/// Collects the bytes of an element.
uint16_t ServiceChannel::beginReading(Element element) noexcept {
  const IdnEntry &entry = *entry_;
  const std::string_view name = entry.row.name;
  const std::string_view unit = entry.row.unit;
  switch (element) {
  case Element::Idn:
    put(entry.state, 2);
    return service_error::kNone;
  case Element::Name:
    if (name.empty())
      return service_error::kNoName;
    putList(bytesOf(name), name.size());
    return service_error::kNone;
  case Element::Attribute:
    put(encode(entry.row.attribute), 4);
    return service_error::kNone;
  case Element::Unit:
    if (unit.empty())
      return service_error::kNoUnit;
    putList(bytesOf(unit), unit.size());
    return service_error::kNone;
  case Element::Minimum:
  case Element::Maximum:
    if (!entry.hasLimits())
      return errorOf(element, service_error::kNoIdn);
    put(static_cast<uint64_t>(element == Element::Minimum ? entry.row.low : entry.row.high),
        entry.row.attribute.bytes);
    return service_error::kNone;
  default:
    if (entry.isList())
      putList(entry.list, entry.room);
    else
      put(static_cast<uint64_t>(entry.value), entry.row.attribute.bytes);
    return service_error::kNone;
  }
}

uint16_t ServiceChannel::read(bool end) noexcept {
  if (place_ >= length_)
    return errorOf(element_, service_error::kTooLong);
  word_ = static_cast<uint16_t>(buffer_[place_] | (buffer_[place_ + 1] << 8U));
  place_ += 2;
  if (!end)
    return service_error::kNone;
  if (place_ < length_)
    return errorOf(element_, service_error::kTooShort);
  const bool data = element_ == Element::Data;
  element_ = Element::None;
  if (data)
    host_.onRead(*entry_);
  return service_error::kNone;
}

uint16_t ServiceChannel::beginWriting(Element element) const noexcept {
  if (element != Element::Data)
    return errorOf(element, service_error::kReadOnly);
  if (entry_->row.attribute.protection == protect::kAlways)
    return service_error::kReadOnly;
  return entry_->row.attribute.writableIn(host_.servicePhase()) ? service_error::kNone
                                                                : service_error::kProtectedNow;
}

/// Bytes that the data needs, as far as that is known.
size_t ServiceChannel::expected() const noexcept {
  if (!entry_->isList())
    return entry_->row.attribute.bytes;
  if (place_ < 2)
    return kListHead;
  const size_t bytes = buffer_[0] | static_cast<size_t>(buffer_[1] << 8U);
  return kListHead + bytes + bytes % 2;
}

uint16_t ServiceChannel::write(uint16_t word, bool end) noexcept {
  if (place_ >= expected())
    return service_error::kTooLong;
  buffer_[place_] = static_cast<uint8_t>(word);
  buffer_[place_ + 1] = static_cast<uint8_t>(word >> 8U);
  place_ += 2;
  if (entry_->isList() && expected() - kListHead > entry_->room)
    return service_error::kTooLong;
  if (!end)
    return service_error::kNone;
  if (place_ < expected())
    return service_error::kTooShort;
  element_ = Element::None;
  return store();
}

/// The data is there: into the data block with it.
uint16_t ServiceChannel::store() noexcept {
  IdnEntry &entry = *entry_;
  const Attribute &attribute = entry.row.attribute;
  if (entry.isList()) {
    const size_t length = buffer_[0] | static_cast<size_t>(buffer_[1] << 8U);
    if (length % attribute.bytes != 0)
      return service_error::kInvalidData;
    const std::span<const uint8_t> bytes(buffer_.data() + kListHead, length);
    const uint16_t error = host_.onWrite(entry, 0, bytes);
    if (error != service_error::kNone)
      return error;
    entry.list.assign(bytes.begin(), bytes.end());
  } else {
    uint64_t bits = 0;
    for (size_t i = 0; i < attribute.bytes; ++i)
      bits |= uint64_t{buffer_[i]} << (8 * i);
    const int64_t value = fitted(attribute, bits);
    if (entry.hasLimits() && value < entry.row.low)
      return service_error::kBelowMinimum;
    if (entry.hasLimits() && value > entry.row.high)
      return service_error::kAboveMaximum;
    const uint16_t error = host_.onWrite(entry, value, {});
    if (error != service_error::kNone)
      return error;
    entry.value = value;
  }
  entry.given = true;
  entry.state &= static_cast<uint16_t>(~data_state::kInvalid);
  host_.onWritten(entry);
  return service_error::kNone;
}

} // namespace stride::sercos::simulation
