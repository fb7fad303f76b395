#include "drivers/can/simulation/sdo_server.hpp"

#include <algorithm>

namespace stride::can::simulation {
namespace {

// What a request is: the upper three bits of its first byte.
constexpr uint8_t kDownloadSegment = 0;
constexpr uint8_t kDownload = 1;
constexpr uint8_t kUpload = 2;
constexpr uint8_t kUploadSegment = 3;
constexpr uint8_t kAbort = 4;
constexpr uint8_t kBlockUpload = 5;
constexpr uint8_t kBlockDownload = 6;

constexpr uint8_t kAbortCommand = 0x80;
constexpr size_t kExpedited = 4;

uint8_t specifier(const Frame &frame) { return static_cast<uint8_t>(frame.data[0] >> 5U); }
bool bit(uint8_t byte, unsigned place) { return (byte >> place & 1U) != 0; }

} // namespace

SdoServer::SdoServer(Dictionary &dictionary, ObjectRules &rules, const SdoServerSetup &setup)
    : dictionary_(dictionary), rules_(rules), setup_(setup),
      buffer_(dictionary.mostBytes() + Frame::kMostBytes) {}

void SdoServer::reset() noexcept {
  mode_ = Mode::Idle;
  answers_ = false;
}

void SdoServer::answer(uint8_t command) noexcept {
  answer_ = {};
  answer_.length = Frame::kMostBytes;
  answer_.data[0] = command;
  answers_ = true;
}

void SdoServer::answerObject(uint8_t command, uint32_t value) noexcept {
  answer(command);
  answer_.data[1] = static_cast<uint8_t>(index_ & 0xFFU);
  answer_.data[2] = static_cast<uint8_t>(index_ >> 8U);
  answer_.data[3] = sub_;
  encode(value, std::span(answer_.data).subspan(4));
}

void SdoServer::abort(Abort code) noexcept {
  mode_ = Mode::Idle;
  answerObject(kAbortCommand, static_cast<uint32_t>(code));
}

void SdoServer::advance(int64_t nowNs) noexcept {
  if (nowNs >= nextNs())
    abort(Abort::TimedOut);
}

int64_t SdoServer::nextNs() const noexcept {
  return mode_ == Mode::Idle ? kNever : lastNs_ + setup_.timeoutNs;
}

void SdoServer::receive(const Frame &frame, int64_t nowNs) noexcept {
  if (frame.remote || frame.length != Frame::kMostBytes)
    return;
  lastNs_ = nowNs;
  if (frame.data[0] == kAbortCommand) {
    reset();
    return;
  }
  if (mode_ == Mode::BlockDownload) {
    blockSegment(frame);
    return;
  }
  switch (specifier(frame)) {
  case kDownloadSegment:
    downloadSegment(frame);
    break;
  case kDownload:
    startDownload(frame);
    break;
  case kUpload:
    startUpload(frame);
    break;
  case kUploadSegment:
    uploadSegment(frame);
    break;
  case kBlockUpload:
    blockUpload(frame);
    break;
  case kBlockDownload:
    blockDownload(frame);
    break;
  case kAbort: // an abort has no other bits set
  default:
    abort(Abort::CommandSpecifier);
    break;
  }
}

/// The object that a first request names; an answer has been given where it is not there.
bool SdoServer::select(const Frame &frame) noexcept {
  mode_ = Mode::Idle;
  index_ = static_cast<uint16_t>(frame.data[1] | frame.data[2] << 8U);
  sub_ = frame.data[3];
  entry_ = dictionary_.find(index_, sub_);
  used_ = done_ = announced_ = 0;
  toggle_ = sequence_ = 0;
  sized_ = false;
  if (entry_ == nullptr)
    abort(dictionary_.missing(index_));
  return entry_ != nullptr;
}

/// Whether so many bytes are a value of the object.
Abort SdoServer::fits(size_t size) const noexcept {
  const Access access = entry_->row.access;
  if (access == Access::ReadOnly || access == Access::Const)
    return Abort::ReadOnly;
  if (size > entry_->room())
    return Abort::TooLong;
  return !entry_->isText() && size < entry_->room() ? Abort::TooShort : Abort::None;
}

/// What is in the buffer becomes the value.
Abort SdoServer::commit() noexcept {
  if (const Abort code = fits(used_); code != Abort::None)
    return code;
  uint64_t value = 0;
  if (!entry_->isText()) {
    value = Dictionary::fitted(entry_->row.type, decode(std::span(buffer_).first(used_)));
    if (const Abort code = Dictionary::checkRange(*entry_, value); code != Abort::None)
      return code;
  }
  if (const Abort code = rules_.beforeWrite(*entry_, value); code != Abort::None)
    return code;
  entry_->value = value;
  if (entry_->isText()) // there is room for them: nothing is allocated
    entry_->text.assign(buffer_.begin(), buffer_.begin() + static_cast<ptrdiff_t>(used_));
  rules_.written(*entry_);
  return Abort::None;
}

/// The value goes into the buffer.
Abort SdoServer::fetch() noexcept {
  if (entry_->row.access == Access::WriteOnly)
    return Abort::WriteOnly;
  if (const Abort code = rules_.beforeRead(*entry_); code != Abort::None)
    return code;
  used_ = entry_->size();
  if (entry_->isText())
    std::copy(entry_->text.begin(), entry_->text.end(), buffer_.begin());
  else
    encode(entry_->value, std::span(buffer_).first(used_));
  return Abort::None;
}

void SdoServer::startDownload(const Frame &frame) noexcept {
  if (!select(frame))
    return;
  const uint8_t command = frame.data[0];
  const bool sized = bit(command, 0);
  if (bit(command, 1)) { // expedited
    const size_t unused = command >> 2U & 3U;
    const size_t whole = entry_->isText() ? kExpedited : std::min(entry_->room(), kExpedited);
    used_ = sized ? kExpedited - unused : whole;
    std::copy_n(frame.data.begin() + 4, used_, buffer_.begin());
    if (const Abort code = commit(); code != Abort::None)
      abort(code);
    else
      answerObject(0x60);
    return;
  }
  sized_ = sized;
  announced_ = sized ? static_cast<size_t>(decode(std::span(frame.data).subspan(4))) : 0;
  if (const Abort code = fits(sized ? announced_ : entry_->room()); code != Abort::None) {
    abort(code);
    return;
  }
  mode_ = Mode::Download;
  answerObject(0x60);
}

void SdoServer::downloadSegment(const Frame &frame) noexcept {
  const uint8_t command = frame.data[0];
  if (mode_ != Mode::Download) {
    abort(Abort::CommandSpecifier);
    return;
  }
  if ((command >> 4U & 1U) != toggle_) {
    abort(Abort::Toggle);
    return;
  }
  const size_t count = 7U - (command >> 1U & 7U);
  if (used_ + count > entry_->room()) {
    abort(Abort::TooLong);
    return;
  }
  std::copy_n(frame.data.begin() + 1, count, buffer_.begin() + static_cast<ptrdiff_t>(used_));
  used_ += count;
  const auto reply = static_cast<uint8_t>(0x20U | static_cast<unsigned>(toggle_) << 4U);
  toggle_ ^= 1U;
  if (!bit(command, 0)) {
    answer(reply);
    return;
  }
  mode_ = Mode::Idle;
  const Abort code = sized_ && used_ != announced_ ? Abort::Length : commit();
  if (code != Abort::None)
    abort(code);
  else
    answer(reply);
}

void SdoServer::startUpload(const Frame &frame) noexcept {
  if (!select(frame))
    return;
  if (const Abort code = fetch(); code != Abort::None)
    abort(code);
  else
    answerUpload();
}

/// At once if it fits into the answer, else in segments.
void SdoServer::answerUpload() noexcept {
  if (used_ > kExpedited || used_ == 0) {
    mode_ = Mode::Upload;
    answerObject(0x41, static_cast<uint32_t>(used_));
    return;
  }
  const auto unused = static_cast<unsigned>(kExpedited - used_);
  answerObject(static_cast<uint8_t>(0x43U | unused << 2U));
  std::copy_n(buffer_.begin(), used_, answer_.data.begin() + 4);
}

void SdoServer::uploadSegment(const Frame &frame) noexcept {
  if (mode_ != Mode::Upload) {
    abort(Abort::CommandSpecifier);
    return;
  }
  if ((frame.data[0] >> 4U & 1U) != toggle_) {
    abort(Abort::Toggle);
    return;
  }
  const size_t count = std::min<size_t>(7, used_ - done_);
  const bool last = done_ + count == used_;
  const auto unused = static_cast<unsigned>(7 - count);
  answer(
      static_cast<uint8_t>(static_cast<unsigned>(toggle_) << 4U | unused << 1U | (last ? 1U : 0U)));
  std::copy_n(buffer_.begin() + static_cast<ptrdiff_t>(done_), count, answer_.data.begin() + 1);
  done_ += count;
  toggle_ ^= 1U;
  if (last)
    mode_ = Mode::Idle;
}

bool SdoServer::transmit(Frame &frame) noexcept {
  if (!answers_)
    return mode_ == Mode::BlockUpload && nextBlockSegment(frame);
  answers_ = false;
  frame = answer_;
  return true;
}

} // namespace stride::can::simulation
