#include "drivers/can/master/sdo_client.hpp"

#include "drivers/can/master/frames.hpp"

#include <algorithm>

namespace stride::can {
namespace {

constexpr size_t kExpedited = 4;
constexpr size_t kSegment = 7;
constexpr uint8_t kAbort = 0x80;

// What the upper three bits of the node's answers say.
constexpr unsigned command(const Frame &frame) { return frame.data[0] >> 5U; }
constexpr unsigned kSegmentUploaded = 0;
constexpr unsigned kSegmentDownloaded = 1;
constexpr unsigned kUploadStarted = 2;
constexpr unsigned kDownloadStarted = 3;

} // namespace

bool SdoClient::upload(Object object, std::span<uint8_t> buffer) {
  if (!begin(object))
    return false;
  uploads_ = true;
  buffer_ = buffer;
  blocks_ = buffer.size() > kLongest && !noBlocks_;
  return true;
}

bool SdoClient::download(Object object, std::span<const uint8_t> bytes) {
  if (bytes.empty() || !begin(object))
    return false;
  uploads_ = false;
  bytes_ = bytes;
  blocks_ = bytes.size() > kLongest && !noBlocks_;
  return true;
}

bool SdoClient::begin(Object object) {
  if (state_ == State::Busy)
    return false;
  object_ = object;
  state_ = State::Busy;
  abortCode_ = abort_code::kNone;
  timedOut_ = false;
  ask(Next::Start);
  return true;
}

/// A question from its beginning.
void SdoClient::ask(Next next) {
  phase_ = Phase::Start;
  next_ = next;
  waited_ = 0;
  done_ = 0;
  announced_ = 0;
  sized_ = false;
  toggle_ = false;
  lastSegment_ = false;
  vain_ = 0;
}

void SdoClient::cancel() {
  if (state_ != State::Busy)
    return;
  lateAnswer_ = true;
  fail(abort_code::kGeneral, true);
}

void SdoClient::clear() {
  lateAnswer_ = state_ == State::Busy;
  state_ = State::Idle;
  next_ = Next::Nothing;
  abortPending_ = false;
  unasked_ = 0;
  misfits_ = 0;
}

void SdoClient::finish(size_t size) {
  done_ = size;
  next_ = Next::Nothing;
  state_ = State::Done;
}

void SdoClient::fail(uint32_t code, bool tellNode) {
  abortCode_ = code;
  abortPending_ = tellNode;
  next_ = Next::Nothing;
  state_ = State::Failed;
}

/// An answer that is none to this question.
void SdoClient::misfit(uint32_t code) {
  if (lateAnswer_) { // to the one before
    lateAnswer_ = false;
    return;
  }
  ++misfits_;
  fail(code, true);
}

void SdoClient::cycle() {
  if (state_ != State::Busy || ++waited_ < timeout_)
    return;
  timedOut_ = true;
  lateAnswer_ = true;
  fail(abort_code::kTimedOut, true);
}

bool SdoClient::concernsObject(const Frame &frame) const {
  return readNumber(frame, 1, 2) == object_.index && frame.data[3] == object_.sub;
}

void SdoClient::received(const Frame &frame) {
  if (frame.length != Frame::kMostBytes) {
    if (state_ == State::Busy)
      misfit(abort_code::kCommand);
    return;
  }
  if (state_ != State::Busy) {
    unasked_ += lateAnswer_ ? 0 : 1;
    lateAnswer_ = false;
    return;
  }
  if (phase_ == Phase::Start && next_ == Next::Start) { // it has not even been asked
    unasked_ += lateAnswer_ ? 0 : 1;
    lateAnswer_ = false;
    return;
  }
  if (frame.data[0] == kAbort) {
    aborted(frame);
    return;
  }
  if (next_ != Next::Nothing && phase_ != Phase::Block) {
    misfit(abort_code::kCommand);
    return;
  }
  switch (phase_) {
  case Phase::Start:
    if (!uploads_)
      downloadStarted(frame);
    else if (blocks_)
      blockUploadStarted(frame);
    else
      uploadStarted(frame);
    break;
  case Phase::Segment:
    if (uploads_)
      segmentUploaded(frame);
    else
      segmentDownloaded(frame);
    break;
  case Phase::Block:
    if (uploads_)
      blockSegment(frame);
    else
      blockAcknowledged(frame);
    break;
  case Phase::BlockEnd:
    if (uploads_)
      blockUploadEnds(frame);
    else
      blockDownloadEnded(frame);
    break;
  }
}

void SdoClient::aborted(const Frame &frame) {
  const uint32_t code = readNumber(frame, 4, 4);
  if (!concernsObject(frame)) {
    misfit(abort_code::kCommand);
    return;
  }
  if (blocks_ && phase_ == Phase::Start && code == abort_code::kCommand) {
    noBlocks_ = true;
    blocks_ = false;
    ask(Next::Start);
    return;
  }
  // An empty object of which the node says nothing more.
  if (uploads_ && phase_ == Phase::Segment && sized_ && announced_ == 0) {
    finish(0);
    return;
  }
  fail(code == abort_code::kNone ? abort_code::kGeneral : code, false);
}

void SdoClient::downloadStarted(const Frame &frame) {
  if (blocks_) {
    blockDownloadStarted(frame);
    return;
  }
  if (command(frame) != kDownloadStarted || !concernsObject(frame)) {
    misfit(abort_code::kCommand);
    return;
  }
  if (bytes_.size() <= kExpedited) {
    finish(bytes_.size());
    return;
  }
  phase_ = Phase::Segment;
  next_ = Next::Segment;
}

bool SdoClient::answersSegment(const Frame &frame, unsigned expected) {
  const bool toggled = ((frame.data[0] & 0x10U) != 0) == toggle_;
  if (command(frame) != expected || !toggled) {
    misfit(command(frame) != expected ? abort_code::kCommand : abort_code::kToggle);
    return false;
  }
  toggle_ = !toggle_;
  return true;
}

void SdoClient::segmentDownloaded(const Frame &frame) {
  if (!answersSegment(frame, kSegmentDownloaded))
    return;
  done_ += std::min(kSegment, bytes_.size() - done_);
  if (done_ == bytes_.size())
    finish(done_);
  else
    next_ = Next::Segment;
}

bool SdoClient::takeSize(size_t size) {
  sized_ = true;
  announced_ = size;
  if (size <= buffer_.size())
    return true;
  fail(abort_code::kMemory, true);
  return false;
}

bool SdoClient::store(std::span<const uint8_t> bytes) {
  if (bytes.size() > buffer_.size() - done_) {
    fail(abort_code::kMemory, true);
    return false;
  }
  std::copy(bytes.begin(), bytes.end(), buffer_.begin() + static_cast<ptrdiff_t>(done_));
  done_ += bytes.size();
  if (!sized_ || done_ <= announced_)
    return true;
  fail(abort_code::kTooLong, true);
  return false;
}

void SdoClient::uploadStarted(const Frame &frame) {
  if (command(frame) != kUploadStarted || !concernsObject(frame)) {
    misfit(abort_code::kCommand);
    return;
  }
  const bool expedited = (frame.data[0] & 2U) != 0;
  const bool sized = (frame.data[0] & 1U) != 0;
  if (expedited) {
    const size_t unused = sized ? frame.data[0] >> 2U & 3U : 0;
    if (store(frame.bytes().subspan(4, kExpedited - unused)))
      finish(done_);
    return;
  }
  if (sized && !takeSize(readNumber(frame, 4, 4)))
    return;
  phase_ = Phase::Segment;
  next_ = Next::Segment;
}

void SdoClient::segmentUploaded(const Frame &frame) {
  if (!answersSegment(frame, kSegmentUploaded))
    return;
  const size_t unused = frame.data[0] >> 1U & 7U;
  const bool last = (frame.data[0] & 1U) != 0;
  if (unused == kSegment && !last) { // that would never end
    misfit(abort_code::kTooShort);
    return;
  }
  if (!store(frame.bytes().subspan(1, kSegment - unused)))
    return;
  if (!last)
    next_ = Next::Segment;
  else if (sized_ && done_ < announced_)
    fail(abort_code::kTooShort, true);
  else
    finish(done_);
}

Frame SdoClient::nextFrame() const {
  if (!abortPending_) {
    switch (next_) {
    case Next::Start:
      return startFrame();
    case Next::Segment:
      return segmentFrame();
    default:
      return blockFrame();
    }
  }
  Frame frame = makeFrame(kSdoRequestBase + node_, Frame::kMostBytes);
  frame.data[0] = kAbort;
  writeNumber(frame, 1, 2, object_.index);
  frame.data[3] = object_.sub;
  writeNumber(frame, 4, 4, abortCode_);
  return frame;
}

Frame SdoClient::startFrame() const {
  Frame frame = makeFrame(kSdoRequestBase + node_, Frame::kMostBytes);
  writeNumber(frame, 1, 2, object_.index);
  frame.data[3] = object_.sub;
  if (uploads_) {
    frame.data[0] = blocks_ ? 0xA4 : 0x40;
    if (blocks_) {
      frame.data[4] = 127;                            // segments in a block
      frame.data[5] = static_cast<uint8_t>(kLongest); // up to here as the node likes
    }
    return frame;
  }
  if (bytes_.size() > kExpedited) {
    frame.data[0] = blocks_ ? 0xC6 : 0x21;
    writeNumber(frame, 4, 4, static_cast<uint32_t>(bytes_.size()));
    return frame;
  }
  frame.data[0] = static_cast<uint8_t>(0x23U | (kExpedited - bytes_.size()) << 2U);
  std::copy(bytes_.begin(), bytes_.end(), frame.data.begin() + 4);
  return frame;
}

Frame SdoClient::segmentFrame() const {
  Frame frame = makeFrame(kSdoRequestBase + node_, Frame::kMostBytes);
  const unsigned toggle = toggle_ ? 0x10U : 0U;
  if (uploads_) {
    frame.data[0] = static_cast<uint8_t>(0x60U | toggle);
    return frame;
  }
  const std::span<const uint8_t> part =
      bytes_.subspan(done_, std::min(kSegment, bytes_.size() - done_));
  const unsigned last = done_ + part.size() == bytes_.size() ? 1U : 0U;
  frame.data[0] = static_cast<uint8_t>(toggle | (kSegment - part.size()) << 1U | last);
  std::copy(part.begin(), part.end(), frame.data.begin() + 1);
  return frame;
}

void SdoClient::sent() {
  waited_ = 0;
  if (abortPending_)
    abortPending_ = false;
  else if (next_ == Next::Start || next_ == Next::Segment)
    next_ = Next::Nothing;
  else
    blockSent();
}

} // namespace stride::can
