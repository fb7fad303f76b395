// Block transfers of SdoClient.
#include "drivers/can/master/crc16.hpp"
#include "drivers/can/master/frames.hpp"
#include "drivers/can/master/sdo_client.hpp"

#include <algorithm>

namespace stride::can {
namespace {

constexpr size_t kBlockSegment = 7;
constexpr uint8_t kMostSegments = 127;
constexpr uint8_t kLastSegment = 0x80;
/// A block of which nothing arrives so often is given up.
constexpr uint8_t kMostVain = 3;

// First byte of the node's words, without their flags.
constexpr unsigned kDownloadAnswer = 0xA0; ///< scs 5
constexpr unsigned kUploadAnswer = 0xC0;   ///< scs 6
constexpr unsigned kScs = 0xE0;
constexpr unsigned kChecked = 4;
constexpr unsigned kSized = 2;

} // namespace

Frame SdoClient::blockFrame() const {
  Frame frame = makeFrame(kSdoRequestBase + node_, Frame::kMostBytes);
  switch (next_) {
  case Next::BlockSegment: {
    const size_t first = done_ + blockPlace_ * kBlockSegment;
    const std::span<const uint8_t> part =
        bytes_.subspan(first, std::min(kBlockSegment, bytes_.size() - first));
    const bool last = first + part.size() == bytes_.size();
    frame.data[0] = static_cast<uint8_t>((blockPlace_ + 1U) | (last ? kLastSegment : 0U));
    std::copy(part.begin(), part.end(), frame.data.begin() + 1);
    break;
  }
  case Next::BlockStart:
    frame.data[0] = 0xA3;
    break;
  case Next::BlockAck:
    frame.data[0] = 0xA2;
    frame.data[1] = blockPlace_;
    frame.data[2] = kMostSegments;
    break;
  default: // the end
    if (uploads_) {
      frame.data[0] = 0xA1;
    } else {
      const size_t rest = bytes_.size() % kBlockSegment;
      const size_t unused = rest == 0 ? 0 : kBlockSegment - rest;
      frame.data[0] = static_cast<uint8_t>(0xC1U | unused << 2U);
      writeNumber(frame, 1, 2, checked_ ? crc16(bytes_) : 0U);
    }
    break;
  }
  return frame;
}

void SdoClient::blockSent() {
  const Next was = next_;
  next_ = Next::Nothing;
  switch (was) {
  case Next::BlockSegment:
    ++blockPlace_;
    lastSegment_ = done_ + blockPlace_ * kBlockSegment >= bytes_.size();
    if (!lastSegment_ && blockPlace_ < blockSize_)
      next_ = Next::BlockSegment;
    break;
  case Next::BlockAck:
    blockPlace_ = 0;
    if (lastSegment_)
      phase_ = Phase::BlockEnd;
    break;
  case Next::BlockEnd:
    if (uploads_)
      finish(done_);
    break;
  default:
    break;
  }
}

void SdoClient::beginBlock(uint8_t size) {
  if (size == 0 || size > kMostSegments) {
    misfit(abort_code::kBlockSize);
    return;
  }
  blockSize_ = size;
  blockPlace_ = 0;
  lastSegment_ = false;
  phase_ = Phase::Block;
  next_ = Next::BlockSegment;
}

void SdoClient::blockDownloadStarted(const Frame &frame) {
  if ((frame.data[0] & (kScs | 3U)) != kDownloadAnswer || !concernsObject(frame)) {
    misfit(abort_code::kCommand);
    return;
  }
  checked_ = (frame.data[0] & kChecked) != 0;
  beginBlock(frame.data[4]);
}

void SdoClient::blockAcknowledged(const Frame &frame) {
  if ((frame.data[0] & (kScs | 3U)) != (kDownloadAnswer | 2U)) {
    misfit(abort_code::kCommand);
    return;
  }
  const uint8_t arrived = frame.data[1];
  // While segments are still to be sent there is nothing to acknowledge.
  if (next_ != Next::Nothing || arrived > blockPlace_) {
    misfit(abort_code::kSequence);
    return;
  }
  const bool all = lastSegment_ && arrived == blockPlace_;
  done_ = std::min(done_ + arrived * kBlockSegment, bytes_.size());
  vain_ = arrived == 0 ? static_cast<uint8_t>(vain_ + 1) : uint8_t{0};
  if (all) {
    phase_ = Phase::BlockEnd;
    next_ = Next::BlockEnd;
  } else if (vain_ == kMostVain) {
    fail(abort_code::kSequence, true);
  } else {
    beginBlock(frame.data[2]);
  }
}

void SdoClient::blockDownloadEnded(const Frame &frame) {
  if ((frame.data[0] & (kScs | 3U)) != (kDownloadAnswer | 1U))
    misfit(abort_code::kCommand);
  else
    finish(bytes_.size());
}

void SdoClient::blockUploadStarted(const Frame &frame) {
  constexpr unsigned kOtherUpload = 0x40;
  if ((frame.data[0] & kScs) == kOtherUpload && concernsObject(frame)) { // as the node prefers
    blocks_ = false;
    uploadStarted(frame);
    return;
  }
  if ((frame.data[0] & (kScs | 1U)) != kUploadAnswer || !concernsObject(frame)) {
    misfit(abort_code::kCommand);
    return;
  }
  if ((frame.data[0] & kSized) != 0 && !takeSize(readNumber(frame, 4, 4)))
    return;
  checked_ = (frame.data[0] & kChecked) != 0;
  blockSize_ = kMostSegments;
  blockPlace_ = 0;
  phase_ = Phase::Block;
  next_ = Next::BlockStart;
}

void SdoClient::blockSegment(const Frame &frame) {
  if (next_ != Next::Nothing) {
    misfit(abort_code::kSequence);
    return;
  }
  const auto number = static_cast<uint8_t>(frame.data[0] & ~kLastSegment);
  const bool last = (frame.data[0] & kLastSegment) != 0;
  if (number == blockPlace_ + 1) { // others come again
    if (last) {
      std::copy_n(frame.data.begin() + 1, kBlockSegment, last_.begin());
      lastSegment_ = true;
    } else if (!store(frame.bytes().subspan(1, kBlockSegment))) {
      return;
    }
    ++blockPlace_;
    waited_ = 0;
  }
  if (last || number >= blockSize_)
    endOfBlock();
}

/// The node waits for what has arrived.
void SdoClient::endOfBlock() {
  vain_ = blockPlace_ == 0 ? static_cast<uint8_t>(vain_ + 1) : uint8_t{0};
  if (vain_ == kMostVain)
    fail(abort_code::kSequence, true);
  else
    next_ = Next::BlockAck;
}

void SdoClient::blockUploadEnds(const Frame &frame) {
  if ((frame.data[0] & (kScs | 3U)) != (kUploadAnswer | 1U)) {
    misfit(abort_code::kCommand);
    return;
  }
  const size_t unused = frame.data[0] >> 2U & 7U;
  if (!store(std::span<const uint8_t>(last_).first(kBlockSegment - unused)))
    return;
  if (sized_ && done_ < announced_)
    fail(abort_code::kTooShort, true);
  else if (checked_ && readNumber(frame, 1, 2) != crc16(buffer_.first(done_)))
    fail(abort_code::kCrc, true);
  else
    next_ = Next::BlockEnd;
}

} // namespace stride::can
