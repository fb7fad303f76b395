// Block transfers. [CiA 301, SDO block download and upload]
#include "drivers/can/simulation/sdo_server.hpp"

#include <algorithm>

namespace stride::can::simulation {
namespace {

constexpr size_t kSegment = 7;
constexpr uint8_t kLongestBlock = 127;
constexpr uint8_t kSequenceMask = 0x7F;
constexpr uint8_t kLastSegment = 0x80;

/// How many bytes of the last segment mean nothing.
unsigned unusedIn(size_t bytes) {
  return static_cast<unsigned>((kSegment - bytes % kSegment) % kSegment);
}

uint16_t wordAt(const Frame &frame, size_t place) {
  return static_cast<uint16_t>(frame.data[place] | frame.data[place + 1] << 8U);
}

} // namespace

uint16_t blockChecksum(std::span<const uint8_t> bytes) {
  constexpr unsigned kPolynomial = 0x1021;
  unsigned crc = 0;
  for (const uint8_t byte : bytes) {
    crc ^= static_cast<unsigned>(byte) << 8U;
    for (int i = 0; i < 8; ++i)
      crc = ((crc & 0x8000U) != 0 ? crc << 1U ^ kPolynomial : crc << 1U) & 0xFFFFU;
  }
  return static_cast<uint16_t>(crc);
}

void SdoServer::blockDownload(const Frame &frame) noexcept {
  const uint8_t command = frame.data[0];
  if ((command & 1U) != 0) {
    endBlockDownload(frame);
    return;
  }
  if (!setup_.blocks) {
    abort(Abort::CommandSpecifier);
    return;
  }
  if (!select(frame))
    return;
  sized_ = (command & 2U) != 0;
  checked_ = (command & 4U) != 0;
  announced_ = sized_ ? static_cast<size_t>(decode(std::span(frame.data).subspan(4))) : 0;
  if (const Abort code = fits(sized_ ? announced_ : entry_->room()); code != Abort::None) {
    abort(code);
    return;
  }
  blockSize_ = std::clamp<uint8_t>(setup_.blockSize, 1, kLongestBlock);
  mode_ = Mode::BlockDownload;
  answerObject(0xA4, blockSize_);
}

/// One segment of a block. What comes after a gap is not taken; the answer says where it begins.
void SdoServer::blockSegment(const Frame &frame) noexcept {
  const auto number = static_cast<uint8_t>(frame.data[0] & kSequenceMask);
  const bool last = (frame.data[0] & kLastSegment) != 0;
  if (number == 0 || number > blockSize_) {
    abort(Abort::SequenceNumber);
    return;
  }
  const bool next = number == sequence_ + 1;
  if (next) {
    if (used_ + kSegment > buffer_.size()) {
      abort(Abort::TooLong);
      return;
    }
    std::copy_n(frame.data.begin() + 1, kSegment, buffer_.begin() + static_cast<ptrdiff_t>(used_));
    used_ += kSegment;
    sequence_ = number;
  }
  if (!last && number != blockSize_)
    return;
  answer(0xA2);
  answer_.data[1] = sequence_;
  answer_.data[2] = blockSize_;
  sequence_ = 0;
  if (last && next)
    mode_ = Mode::BlockDownloadEnd;
}

void SdoServer::endBlockDownload(const Frame &frame) noexcept {
  if (mode_ != Mode::BlockDownloadEnd) {
    abort(Abort::CommandSpecifier);
    return;
  }
  mode_ = Mode::Idle;
  const size_t unused = frame.data[0] >> 2U & 7U;
  used_ -= std::min(unused, used_);
  Abort code = Abort::None;
  if (sized_ && used_ != announced_)
    code = Abort::Length;
  else if (checked_ && blockChecksum(std::span(buffer_).first(used_)) != wordAt(frame, 1))
    code = Abort::Checksum;
  else
    code = commit();
  if (code != Abort::None)
    abort(code);
  else
    answer(0xA1);
}

void SdoServer::blockUpload(const Frame &frame) noexcept {
  switch (frame.data[0] & 3U) {
  case 0:
    startBlockUpload(frame);
    return;
  case 1: // the client has checked it
    if (mode_ != Mode::BlockUploadEnd)
      break;
    mode_ = Mode::Idle;
    return;
  case 2:
    blockAcknowledged(frame);
    return;
  default:
    if (mode_ != Mode::BlockUploadStart)
      break;
    mode_ = Mode::BlockUpload;
    return;
  }
  abort(Abort::CommandSpecifier);
}

void SdoServer::startBlockUpload(const Frame &frame) noexcept {
  if (!setup_.blocks) {
    abort(Abort::CommandSpecifier);
    return;
  }
  if (!select(frame))
    return;
  const uint8_t size = frame.data[4];
  const uint8_t threshold = frame.data[5];
  if (size == 0 || size > kLongestBlock) {
    abort(Abort::BlockSize);
    return;
  }
  if (const Abort code = fetch(); code != Abort::None) {
    abort(code);
    return;
  }
  if (used_ <= threshold) { // the client is content with a transfer without blocks
    answerUpload();
    return;
  }
  checked_ = (frame.data[0] & 4U) != 0;
  blockSize_ = size;
  mode_ = Mode::BlockUploadStart;
  answerObject(0xC6, static_cast<uint32_t>(used_));
}

bool SdoServer::nextBlockSegment(Frame &frame) noexcept {
  const size_t from = done_ + sequence_ * kSegment;
  const size_t count = std::min(kSegment, used_ - std::min(from, used_));
  const bool last = from + count == used_;
  frame = {};
  frame.length = Frame::kMostBytes;
  ++sequence_;
  frame.data[0] = static_cast<uint8_t>(sequence_ | (last ? kLastSegment : 0));
  std::copy_n(buffer_.begin() + static_cast<ptrdiff_t>(from), count, frame.data.begin() + 1);
  if (last || sequence_ == blockSize_)
    mode_ = Mode::BlockUploadAnswer;
  return true;
}

void SdoServer::blockAcknowledged(const Frame &frame) noexcept {
  if (mode_ != Mode::BlockUploadAnswer) {
    abort(Abort::CommandSpecifier);
    return;
  }
  const uint8_t taken = frame.data[1];
  const uint8_t size = frame.data[2];
  if (taken > sequence_) {
    abort(Abort::SequenceNumber);
    return;
  }
  if (size == 0 || size > kLongestBlock) {
    abort(Abort::BlockSize);
    return;
  }
  const bool all = done_ + taken * kSegment >= used_;
  done_ += taken * kSegment;
  sequence_ = 0;
  blockSize_ = size;
  if (!all) {
    mode_ = Mode::BlockUpload;
    return;
  }
  mode_ = Mode::BlockUploadEnd;
  answer(static_cast<uint8_t>(0xC1U | unusedIn(used_) << 2U));
  const uint16_t crc = checked_ ? blockChecksum(std::span(buffer_).first(used_)) : uint16_t{0};
  answer_.data[1] = static_cast<uint8_t>(crc & 0xFFU);
  answer_.data[2] = static_cast<uint8_t>(crc >> 8U);
}

} // namespace stride::can::simulation
