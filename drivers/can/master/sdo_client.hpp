// The client's side of SDO with one node: reads and writes objects of its dictionary. [CiA 301,
// 7.2.4.3: expedited, segmented and block transfer]
#ifndef STRIDE_DRIVERS_CAN_MASTER_SDO_CLIENT_HPP
#define STRIDE_DRIVERS_CAN_MASTER_SDO_CLIENT_HPP

#include "drivers/can/master/sdo_abort.hpp"
#include "drivers/can/plan/objects.hpp"
#include "drivers/can/port/frame.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stride::can {

/// One transfer at a time, driven by frames and cycles: received() for each answer, cycle() once in
/// each cycle, and while pending() a frame to be sent: nextFrame(), then sent(). Bytes stay the
/// caller's, who keeps them until the transfer is over.
class SdoClient {
public:
  enum class State : uint8_t { Idle, Busy, Done, Failed };

  /// Longer transfers are made in blocks. [bytes]
  static constexpr size_t kLongest = 64;

  /// `timeout`: for each answer. [cycles]
  SdoClient(uint8_t node, uint32_t timeout) : timeout_(timeout), node_(node) {}

  /// Begins to read the object into `buffer`. False: another transfer is under way.
  bool upload(Object object, std::span<uint8_t> buffer);
  /// Begins to write it; at least one byte. False: another transfer is under way.
  bool download(Object object, std::span<const uint8_t> bytes);
  /// Gives the transfer up; the node is told.
  void cancel();
  /// The node is reset: what is under way is over, without a word to it.
  void clear();

  /// A frame with the identifier of the node's answers.
  void received(const Frame &frame);
  /// A cycle has passed.
  void cycle();

  [[nodiscard]] bool pending() const { return abortPending_ || next_ != Next::Nothing; }
  /// The frame to be sent now; `pending()`.
  [[nodiscard]] Frame nextFrame() const;
  /// It has been.
  void sent();

  [[nodiscard]] State state() const { return state_; }
  /// Failed: why; one of abort_code, or the node's own.
  [[nodiscard]] uint32_t abortCode() const { return abortCode_; }
  /// Failed: no answer has come, whatever the question.
  [[nodiscard]] bool timedOut() const { return timedOut_; }
  /// Done: bytes that have been read.
  [[nodiscard]] size_t size() const { return done_; }
  /// Answers to questions that nobody has asked, since the last clear(): two nodes have one number?
  [[nodiscard]] uint32_t unasked() const { return unasked_; }
  /// Answers that did not fit to their question, since the last clear().
  [[nodiscard]] uint32_t misfits() const { return misfits_; }

private:
  /// What is awaited from the node, and what is said next.
  enum class Phase : uint8_t {
    Start,
    Segment,
    Block,    ///< Download: the acknowledgement of a block; upload: its segments.
    BlockEnd, ///< Download: the last word; upload: the check sum.
  };
  enum class Next : uint8_t {
    Nothing,
    Start,
    Segment,
    BlockSegment, ///< Download.
    BlockStart,   ///< Upload: the node shall begin.
    BlockAck,     ///< Upload.
    BlockEnd,
  };

  bool begin(Object object);
  void ask(Next next);
  void finish(size_t size);
  void fail(uint32_t code, bool tellNode);
  void misfit(uint32_t code);
  [[nodiscard]] bool concernsObject(const Frame &frame) const;
  [[nodiscard]] Frame startFrame() const;
  [[nodiscard]] Frame segmentFrame() const;
  void uploadStarted(const Frame &frame);
  void blockUploadStarted(const Frame &frame);
  void downloadStarted(const Frame &frame);
  [[nodiscard]] bool answersSegment(const Frame &frame, unsigned expected);
  void segmentDownloaded(const Frame &frame);
  void segmentUploaded(const Frame &frame);
  [[nodiscard]] bool takeSize(size_t size);
  [[nodiscard]] bool store(std::span<const uint8_t> bytes);
  void aborted(const Frame &frame);
  // sdo_block.cpp
  [[nodiscard]] Frame blockFrame() const;
  void blockSent();
  void blockDownloadStarted(const Frame &frame);
  void blockAcknowledged(const Frame &frame);
  void blockDownloadEnded(const Frame &frame);
  void blockSegment(const Frame &frame);
  void endOfBlock();
  void blockUploadEnds(const Frame &frame);
  void beginBlock(uint8_t size);

  std::span<uint8_t> buffer_;      ///< Upload.
  std::span<const uint8_t> bytes_; ///< Download.
  Object object_;
  size_t done_ = 0;      ///< Bytes read, or written and acknowledged.
  size_t announced_ = 0; ///< Upload: bytes that the node has announced …
  bool sized_ = false;   ///< … if it has.
  uint32_t timeout_;
  uint32_t waited_ = 0; ///< For the answer. [cycles]
  uint32_t abortCode_ = abort_code::kNone;
  uint32_t unasked_ = 0;
  uint32_t misfits_ = 0;
  uint8_t node_;
  State state_ = State::Idle;
  Phase phase_ = Phase::Start;
  Next next_ = Next::Nothing;
  bool uploads_ = false;
  bool blocks_ = false;   ///< A block transfer …
  bool noBlocks_ = false; ///< … which the node does not know.
  bool checked_ = false;  ///< With a check sum.
  bool toggle_ = false;
  bool timedOut_ = false;
  bool lateAnswer_ = false; ///< The answer to a question that has been given up may still come.
  bool abortPending_ = false;
  uint8_t blockSize_ = 0;         ///< Segments in the block.
  uint8_t blockPlace_ = 0;        ///< Segments of it that were sent, or received in order.
  uint8_t vain_ = 0;              ///< Blocks in a row of which nothing has arrived.
  bool lastSegment_ = false;      ///< Has been sent, or received …
  std::array<uint8_t, 7> last_{}; ///< … until the node says how much of it counts.
};

} // namespace stride::can

#endif
