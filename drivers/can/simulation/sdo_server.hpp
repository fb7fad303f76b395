// The server of service data objects: other nodes read and write the dictionary by it.
// [CiA 301, SDO: expedited, segmented and block transfer]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_SDO_SERVER_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_SDO_SERVER_HPP

#include "drivers/can/port/frame.hpp"
#include "drivers/can/simulation/dictionary.hpp"
#include "drivers/can/simulation/node.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stride::can::simulation {

/// What a device says to requests for its objects.
class ObjectRules {
public:
  ObjectRules() = default;
  ObjectRules(const ObjectRules &) = delete;
  ObjectRules &operator=(const ObjectRules &) = delete;
  virtual ~ObjectRules() = default;

  /// Somebody wants to read it: what changes by itself is made current.
  virtual Abort beforeRead(Entry &entry) noexcept = 0;
  /// Somebody wants to write it. Type, access and range have been looked at.
  virtual Abort beforeWrite(const Entry &entry, uint64_t value) noexcept = 0;
  /// It has been written.
  virtual void written(Entry &entry) noexcept = 0;
  /// Whether a change of it is an event, for process data that are sent by events.
  [[nodiscard]] virtual bool triggers(const Entry & /*entry*/) const noexcept { return true; }
};

struct SdoServerSetup {
  int64_t timeoutNs = 1'000'000'000; ///< Without a request a transfer ends then. [ns]
  bool blocks = true;                ///< It knows block transfers.
  uint8_t blockSize = 127;           ///< Segments of a block that it takes, 1 … 127.
};

class SdoServer {
public:
  SdoServer(Dictionary &dictionary, ObjectRules &rules, const SdoServerSetup &setup);

  /// A request has come. What has not 8 bytes is none.
  void receive(const Frame &frame, int64_t nowNs) noexcept;
  void advance(int64_t nowNs) noexcept;
  [[nodiscard]] int64_t nextNs() const noexcept;
  /// The next answer, without an identifier. FALSE: there is none.
  bool transmit(Frame &frame) noexcept;
  /// What is under way is forgotten.
  void reset() noexcept;

private:
  enum class Mode : uint8_t {
    Idle,
    Download,
    Upload,
    BlockDownload,
    BlockDownloadEnd,
    BlockUploadStart,
    BlockUpload,
    BlockUploadAnswer,
    BlockUploadEnd,
  };

  void answer(uint8_t command) noexcept;
  void answerObject(uint8_t command, uint32_t value = 0) noexcept;
  void abort(Abort code) noexcept;
  bool select(const Frame &frame) noexcept;
  Abort fits(size_t size) const noexcept;
  Abort fetch() noexcept;
  Abort commit() noexcept;

  void startDownload(const Frame &frame) noexcept;
  void downloadSegment(const Frame &frame) noexcept;
  void startUpload(const Frame &frame) noexcept;
  void answerUpload() noexcept;
  void uploadSegment(const Frame &frame) noexcept;
  void blockDownload(const Frame &frame) noexcept;
  void blockSegment(const Frame &frame) noexcept;
  void endBlockDownload(const Frame &frame) noexcept;
  void blockUpload(const Frame &frame) noexcept;
  void startBlockUpload(const Frame &frame) noexcept;
  void blockAcknowledged(const Frame &frame) noexcept;
  bool nextBlockSegment(Frame &frame) noexcept;

  Dictionary &dictionary_;
  ObjectRules &rules_;
  SdoServerSetup setup_;
  Mode mode_ = Mode::Idle;
  Entry *entry_ = nullptr;
  uint16_t index_ = 0; ///< Of the object that a transfer is about, or was asked for.
  uint8_t sub_ = 0;
  std::vector<uint8_t> buffer_;
  size_t used_ = 0;      ///< Bytes in the buffer.
  size_t done_ = 0;      ///< Upload: of these so many have been sent and acknowledged.
  size_t announced_ = 0; ///< Download: bytes that shall come …
  bool sized_ = false;   ///< … if that was said.
  bool checked_ = false; ///< A block transfer with checksum.
  uint8_t toggle_ = 0;
  uint8_t sequence_ = 0; ///< The last segment of the block.
  uint8_t blockSize_ = 0;
  int64_t lastNs_ = 0;
  bool answers_ = false;
  Frame answer_;
};

/// The checksum of block transfers: x^16 + x^12 + x^5 + 1, from 0.
uint16_t blockChecksum(std::span<const uint8_t> bytes);

} // namespace stride::can::simulation

#endif
