// Where a Sercos master meets its ring.
#ifndef STRIDE_DRIVERS_SERCOS_RING_RING_HPP
#define STRIDE_DRIVERS_SERCOS_RING_RING_HPP

#include "drivers/sercos/protocol/telegrams.hpp"
#include "drivers/sercos/protocol/words.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stride::sercos {

inline constexpr size_t kMostDrives = 254;
inline constexpr size_t kMostMdtBytes = kMostDrives * kMostRecordBytes;
/// More than one drive can answer to an address.
inline constexpr size_t kMostAnswers = kMostDrives + 2;

/// Words as they travel, the low byte first.
constexpr uint16_t wordAt(std::span<const uint8_t> bytes, size_t place) {
  return static_cast<uint16_t>(bytes[place] | (bytes[place + 1] << 8U));
}
constexpr void putWord(std::span<uint8_t> bytes, size_t place, uint16_t word) {
  bytes[place] = static_cast<uint8_t>(word);
  bytes[place + 1] = static_cast<uint8_t>(word >> 8U);
}

/// What a master sends from one MST, without it, to the next one: the MDT of the cycle that ends,
/// after it has seen that cycle's ATs, and the MST of the cycle that begins.
struct MasterTelegrams {
  int64_t periodNs = 1'000'000; ///< From the cycle before to this one; more than 0. [ns]
  bool mst = true;              ///< The MST is sent, with
  Phase phase = Phase::Zero;    ///< … this phase.
  /// The MDT is sent. It has the form of the phase that the MST of the call before had: devices in
  /// another phase do not understand it. Phases 1 and 2: to the drive with `mdtAddress`; its data
  /// is control word and word of the service channel (kHeadBytes). Phases 3 and 4: to all
  /// (kBroadcast); each drive's record is at data[S-0-0009 − 1], and its length S-0-0010.
  bool mdt = false;
  uint8_t mdtAddress = kBroadcast;
  uint16_t mdtLength = 0; ///< Bytes of `mdtData`, 0 … kMostMdtBytes.
  std::array<uint8_t, kMostMdtBytes> mdtData{};
};

/// A telegram of a drive.
struct DriveTelegram {
  uint8_t address = 0;
  bool distorted = false; ///< The checksum was wrong: nothing of it can be trusted.
  uint8_t length = 0;     ///< Bytes of `data`.
  /// Status word, word of the service channel, and in phases 3 and 4 the cyclic data.
  std::array<uint8_t, kMostRecordBytes> data{};

  [[nodiscard]] std::span<const uint8_t> bytes() const { return {data.data(), length}; }
};

/// What has come back, with the cycle that begins.
struct RingAnswers {
  bool light = false;        ///< The receiver sees light.
  bool mstReturned = false;  ///< The MST has come back whole.
  bool mstDistorted = false; ///< Something has come back, but not what was sent.
  /// ATs, in the order of their times. In phases 1 and 2 it is that of the drive to which the MDT
  /// went; several when several have that address. In phases 3 and 4 those of all drives that are
  /// in that phase. One that is missing was not sent or is lost.
  size_t count = 0;
  std::array<DriveTelegram, kMostAnswers> telegrams{};

  [[nodiscard]] std::span<const DriveTelegram> ats() const { return {telegrams.data(), count}; }
};

/// An optical ring with one master. Nothing here allocates, waits or throws.
class Ring {
public:
  Ring() = default;
  Ring(const Ring &) = delete;
  Ring &operator=(const Ring &) = delete;
  virtual ~Ring() = default;

  /// One communication cycle, seen from where the master computes: between ATs and MDT. First the
  /// MDT goes, then the MST, then the ATs come, which know the MDT of the same call.
  virtual void cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept = 0;

  /// The brightness of the transmitter, 0 … 100 (0: off).
  virtual void setLight(uint8_t percent) noexcept = 0;
  /// The speed of the ring: who has another one only distorts. [MBit/s]
  virtual void setBaudRate(uint8_t megabits) noexcept = 0;
};

} // namespace stride::sercos

#endif
