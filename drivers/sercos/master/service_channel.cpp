#include "drivers/sercos/master/service_channel.hpp"

#include <algorithm>

namespace stride::sercos {
namespace {

constexpr unsigned kWordBits = 16;

/// Of the attribute bits that a step of reading or writing has.
uint16_t stepBits(Element element, bool writes, bool end) {
  return static_cast<uint16_t>(elementBits(element) | (writes ? control::kWrite : 0U) |
                               (end ? control::kEnd : 0U));
}

} // namespace

void ServiceChannel::clear() {
  size_ = place_ = 0;
  attribute_ = {};
  attributeBits_ = waited_ = 0;
  control_ = info_ = error_ = 0;
  idn_ = 0;
  element_ = Element::None;
  step_ = Step::None;
  state_ = State::Idle;
  writes_ = open_ = known_ = timedOut_ = draining_ = false;
}

void ServiceChannel::begin(Idn idn, Element element, bool writes) {
  if (!open_ || idn != idn_)
    open_ = known_ = false;
  idn_ = idn;
  element_ = element;
  writes_ = writes;
  state_ = State::Busy;
  error_ = 0;
  timedOut_ = false;
  place_ = 0;
  step_ = Step::None;
  waited_ = 0;
  if (!draining_)
    start();
}

void ServiceChannel::start() {
  if (open_)
    afterOpen();
  else
    go(Step::Open, Element::Idn, true, true, idn_);
}

bool ServiceChannel::read(Idn idn, Element element) {
  if (state_ == State::Busy || element == Element::None)
    return false;
  size_ = 0;
  begin(idn, element, false);
  return true;
}

bool ServiceChannel::write(Idn idn, std::span<const uint8_t> bytes) {
  if (state_ == State::Busy || bytes.size() > kMost)
    return false;
  std::copy(bytes.begin(), bytes.end(), bytes_.begin());
  size_ = bytes.size();
  bytes_[size_] = 0; // fills the last word of an odd list up
  begin(idn, Element::Data, true);
  return true;
}

/// The next transfer opens the channel anew, which breaks off what is under way; but the step that
/// is under way must end first, or the handshake of the next one would be that of the last.
void ServiceChannel::cancel() {
  if (state_ == State::Busy) {
    open_ = false;
    draining_ = true;
  }
  release();
}

void ServiceChannel::release() {
  state_ = State::Idle;
  step_ = Step::None;
}

void ServiceChannel::go(Step step, Element element, bool writes, bool end, uint16_t word) {
  const auto handshake = static_cast<uint16_t>((control_ & control::kMhs) ^ control::kMhs);
  control_ = static_cast<uint16_t>(stepBits(element, writes, end) | handshake);
  info_ = word;
  step_ = step;
  waited_ = 0;
}

void ServiceChannel::received(uint16_t statusWord, uint16_t info) {
  const bool seen = ((statusWord & status::kAhs) != 0) == ((control_ & control::kMhs) != 0);
  if (!seen || (statusWord & status::kBusy) != 0) {
    if (state_ != State::Busy || ++waited_ < timeout_)
      return;
    timedOut_ = true;
    draining_ = true;
    fail(0);
    return;
  }
  if (draining_) {
    draining_ = false;
    if (state_ == State::Busy)
      start();
    return;
  }
  if (state_ != State::Busy)
    return;
  if ((statusWord & status::kError) != 0)
    fail(info);
  else
    advance(info);
}

void ServiceChannel::fail(uint16_t error) {
  error_ = error;
  open_ = false; // it begins anew with its IDN
  state_ = State::Failed;
  step_ = Step::None;
}

void ServiceChannel::finish() {
  state_ = State::Done;
  step_ = Step::None;
}

void ServiceChannel::advance(uint16_t info) {
  switch (step_) {
  case Step::None:
    break;
  case Step::Open:
    open_ = true;
    afterOpen();
    break;
  case Step::AttributeLow:
    attributeBits_ = info;
    go(Step::AttributeHigh, Element::Attribute, false, true, 0);
    break;
  case Step::AttributeHigh:
    attributeBits_ |= uint32_t{info} << kWordBits;
    attribute_ = decodeAttribute(attributeBits_);
    known_ = true;
    afterAttribute();
    break;
  case Step::Single:
    bytes_[0] = static_cast<uint8_t>(info);
    bytes_[1] = static_cast<uint8_t>(info >> 8U);
    size_ = 2;
    finish();
    break;
  case Step::Length:
  case Step::Room:
    list(info);
    break;
  case Step::Words:
    takeWord(info);
    break;
  }
}

void ServiceChannel::afterOpen() {
  if (element_ == Element::Idn) // its state
    go(Step::Single, Element::Idn, false, true, 0);
  else if (isText())
    go(Step::Length, element_, false, false, 0);
  else if (known_)
    afterAttribute();
  else
    go(Step::AttributeLow, Element::Attribute, false, false, 0);
}

void ServiceChannel::afterAttribute() {
  if (element_ == Element::Attribute) {
    for (size_t i = 0; i < 4; ++i)
      bytes_[i] = static_cast<uint8_t>(attributeBits_ >> 8 * i);
    size_ = 4;
    finish();
    return;
  }
  if (attribute_.list) {
    const auto length = static_cast<uint16_t>(size_);
    go(Step::Length, element_, writes_, false, writes_ ? length : uint16_t{0});
    return;
  }
  if (writes_ && size_ != attribute_.bytes) {
    fail(size_ < attribute_.bytes ? service_error::kTooShort : service_error::kTooLong);
    return;
  }
  size_ = attribute_.bytes;
  nextWord();
}

/// The two words before a list.
void ServiceChannel::list(uint16_t info) {
  if (step_ == Step::Length) {
    if (!writes_)
      size_ = info;
    // What is empty ends with the second length.
    go(Step::Room, element_, writes_, size_ == 0,
       writes_ ? static_cast<uint16_t>(size_) : uint16_t{0});
    return;
  }
  if (size_ > kMost) {
    size_ = 0;
    fail(0);
  } else if (size_ == 0) {
    finish();
  } else {
    nextWord();
  }
}

uint16_t ServiceChannel::wordAt(size_t place) const {
  return static_cast<uint16_t>(bytes_[place] | bytes_[place + 1] << 8U);
}

void ServiceChannel::nextWord() {
  go(Step::Words, element_, writes_, place_ + 2 >= size_, writes_ ? wordAt(place_) : uint16_t{0});
}

void ServiceChannel::takeWord(uint16_t info) {
  if (!writes_) {
    bytes_[place_] = static_cast<uint8_t>(info);
    bytes_[place_ + 1] = static_cast<uint8_t>(info >> 8U);
  }
  place_ += 2;
  if (place_ >= size_)
    finish();
  else
    nextWord();
}

int64_t ServiceChannel::number() const {
  const size_t count = std::min<size_t>(size_, 8);
  uint64_t word = 0;
  for (size_t i = 0; i < count; ++i)
    word |= uint64_t{bytes_[i]} << 8 * i;
  if (count == 0 || count == 8 || attribute_.display != Display::Signed || element_ == Element::Idn)
    return static_cast<int64_t>(word);
  const size_t unused = 64 - 8 * count;
  return static_cast<int64_t>(word << unused) >> unused;
}

} // namespace stride::sercos
