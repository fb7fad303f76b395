// When the telegrams of a cycle are on the ring, and whether they fit. Pure arithmetic, whole
// numbers only. [IEC 61491: the conditions of S-0-0006, S-0-0007, S-0-0008 and S-0-0089]
#ifndef STRIDE_DRIVERS_SERCOS_PROTOCOL_TIMING_HPP
#define STRIDE_DRIVERS_SERCOS_PROTOCOL_TIMING_HPP

#include <cstddef>
#include <cstdint>
#include <span>

namespace stride::sercos {

/// Whether Sercos rings have that speed. [MBit/s]
constexpr bool isBaudRate(uint32_t megabits) {
  return megabits == 2 || megabits == 4 || megabits == 8 || megabits == 16;
}

/// Whether a ring can have that cycle: 62, 125, 250, 500 µs, or whole milliseconds up to 65. [µs]
constexpr bool isCycle(uint32_t us) {
  constexpr uint32_t kMillisecond = 1000;
  constexpr uint32_t kLongest = 65;
  return us == 62 || us == 125 || us == 250 || us == 500 ||
         (us != 0 && us % kMillisecond == 0 && us / kMillisecond <= kLongest);
}

/// A telegram is a flag, the address (8 bits), `dataBytes`, the checksum (16 bits) and a flag. All
/// but the flags is stuffed: a bit more after each five in the worst case. [bit]
constexpr uint32_t telegramBits(uint32_t dataBytes) {
  constexpr uint32_t kFlags = 16;
  const uint32_t stuffed = 8 + 8 * dataBytes + 16;
  return kFlags + stuffed + (stuffed + 4) / 5;
}

inline constexpr uint32_t kMstDataBytes = 1;

/// How long such a telegram takes, rounded up. `megabits`: isBaudRate. [µs]
constexpr uint32_t telegramUs(uint32_t dataBytes, uint32_t megabits) {
  return (telegramBits(dataBytes) + megabits - 1) / megabits;
}

/// The start of each telegram trembles by that much, both ways. What a ring's parts really do is
/// in their data sheets only; 1 µs is what the standard allows. [µs]
inline constexpr uint32_t kJitterUs = 1;

/// A drive, as far as the times of the telegrams depend on it. What it says of itself in phase 2;
/// these values stand for drives that cannot be asked yet.
struct DriveTiming {
  uint32_t atBytes = 0;          ///< Data of its AT: status word, service channel, cyclic data.
  uint32_t mdtBytes = 0;         ///< Its record in the MDT: control word, service channel, data.
  uint32_t shortestAtStart = 12; ///< S-0-0003. [µs]
  uint32_t atToMdt = 12;         ///< S-0-0004. [µs]
  uint32_t feedback = 200;       ///< S-0-0005. [µs]
  uint32_t atToAt = 4;           ///< S-0-0087: of several axes that share an interface. [µs]
  uint32_t mdtToMst = 50;        ///< S-0-0088. [µs]
  uint32_t processing = 50;      ///< S-0-0090. [µs]
};

/// What the master writes to a drive.
struct DriveSlot {
  uint16_t atStart = 0;    ///< S-0-0006, from the end of the MST. [µs]
  uint16_t placeInMdt = 0; ///< S-0-0009: 1 is the first byte of the data field.
};

struct RingTiming {
  bool fits = false;          ///< All conditions hold; else the other values only show why not.
  uint32_t mdtStart = 0;      ///< S-0-0089, of all. [µs]
  uint32_t feedback = 0;      ///< S-0-0007, of all. [µs]
  uint32_t commandValid = 0;  ///< S-0-0008, of all. [µs]
  uint32_t mdtLength = 0;     ///< S-0-0010. [byte]
  uint32_t neededUs = 0;      ///< What the telegrams take, and what has to be between them.
  uint32_t shortestCycle = 0; ///< That they fit into: isCycle; 0: there is none. [µs]
};

/// The times for drives in the order of the ring, one slot for each in `slots` (which is as long).
/// `megabits`: isBaudRate; `cycleUs` more than 0.
RingTiming planRing(std::span<const DriveTiming> drives, uint32_t megabits, uint32_t cycleUs,
                    std::span<DriveSlot> slots);

} // namespace stride::sercos

#endif
