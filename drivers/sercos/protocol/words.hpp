// The words of a Sercos telegram and what their bits mean. [IEC 61491; where a drive's manual is
// public, its bits: S-0-0134 and S-0-0135]
#ifndef STRIDE_DRIVERS_SERCOS_PROTOCOL_WORDS_HPP
#define STRIDE_DRIVERS_SERCOS_PROTOCOL_WORDS_HPP

#include <cstdint>

namespace stride::sercos {

/// Communication phases, as the MST carries them.
enum class Phase : uint8_t {
  Zero = 0,  ///< The ring closes: MST only.
  One = 1,   ///< Drives are looked for, one address in a cycle.
  Two = 2,   ///< Service channel, one drive in a cycle.
  Three = 3, ///< All telegrams at their times; cyclic data is not used yet.
  Four = 4,  ///< Operation.
};

/// Addresses of drives are 1 … kLastAddress. A device with address 0 only passes on.
inline constexpr uint8_t kNoAddress = 0;
inline constexpr uint8_t kLastAddress = 254;
inline constexpr uint8_t kBroadcast = 255; ///< Of the MDT in phases 3 and 4.

/// In phase 0 the master's own MST has to come back this often, one after the other.
inline constexpr unsigned kMstReturns = 10;
/// Who misses this many MSTs or MDTs (a drive) or ATs (a master) one after the other, gives up.
inline constexpr unsigned kMostMisses = 2;

/// Control word, in the MDT. [S-0-0134]
namespace control {
inline constexpr uint16_t kMhs = 0x0001;   ///< Handshake of the service channel: turns with a step.
inline constexpr uint16_t kWrite = 0x0002; ///< Service channel: the master writes; 0: it reads.
inline constexpr uint16_t kEnd = 0x0004; ///< Service channel: this is the last word of the element.
inline constexpr unsigned kElementShift = 3; ///< Bits 5 … 3: Element.
inline constexpr uint16_t kElementMask = 0x0038;
inline constexpr uint16_t kRealTime1 = 0x0040;
inline constexpr uint16_t kRealTime2 = 0x0080;
inline constexpr uint16_t kIpoSync = 0x0400; ///< Turns with each new set of command values.
inline constexpr uint16_t kModeMask = 0x0B00;
inline constexpr uint16_t kGo = 0x2000;     ///< 0: halt with S-0-0138 (in regulation).
inline constexpr uint16_t kEnable = 0x4000; ///< 0: torque off at once.
inline constexpr uint16_t kOn = 0x8000;     ///< 0: stop as well as possible, then torque off.
inline constexpr uint16_t kFollow = kOn | kEnable | kGo; ///< The drive follows command values.
inline constexpr uint16_t kServiceMask = 0x003F;         ///< All bits of the service channel.
} // namespace control

/// Status word, in the AT. [S-0-0135]
namespace status {
inline constexpr uint16_t kAhs = 0x0001;     ///< Handshake of the service channel: follows MHS.
inline constexpr uint16_t kBusy = 0x0002;    ///< Service channel: the step is not over.
inline constexpr uint16_t kError = 0x0004;   ///< Service channel: the info word is a ServiceError.
inline constexpr uint16_t kFollows = 0x0008; ///< The drive follows command values.
inline constexpr uint16_t kCommandChange = 0x0020; ///< A procedure command has ended or failed.
inline constexpr uint16_t kRealTime1 = 0x0040;
inline constexpr uint16_t kRealTime2 = 0x0080;
inline constexpr unsigned kModeShift = 8; ///< Bits 10 … 8: the mode that is active.
inline constexpr uint16_t kModeMask = 0x0700;
inline constexpr uint16_t kClass3 = 0x0800; ///< S-0-0013 has changed; until it is read.
inline constexpr uint16_t kClass2 = 0x1000; ///< S-0-0012 has changed; until it is read.
inline constexpr uint16_t kClass1 = 0x2000; ///< Shut down by an error: S-0-0011.
inline constexpr unsigned kReadyShift = 14;
inline constexpr uint16_t kReadyMask = 0xC000;
} // namespace status

/// Bits 15, 14 of the status word.
enum class Ready : uint8_t {
  Not = 0,         ///< Internal checks are not over, or there is an error.
  Logic = 1,       ///< Ready for main power.
  Power = 2,       ///< Main power is on; without torque.
  Operational = 3, ///< Under torque.
};

/// Which of the modes (0: S-0-0032, 1: S-0-0033, 2: S-0-0034, 3: S-0-0035, …) a control word wants.
constexpr uint8_t modeOf(uint16_t controlWord) {
  return static_cast<uint8_t>(((controlWord >> 8U) & 3U) | ((controlWord >> 9U) & 4U));
}
constexpr uint16_t modeBits(uint8_t mode) {
  return static_cast<uint16_t>(((mode & 3U) << 8U) | ((mode & 4U) << 9U));
}

constexpr Ready readyOf(uint16_t statusWord) {
  return static_cast<Ready>(statusWord >> status::kReadyShift);
}

/// Modes of operation, the values of S-0-0032 … S-0-0035; bit 3 is the mode without lag.
enum class OperationMode : uint16_t {
  None = 0,
  Torque = 1,
  Velocity = 2,
  Position1 = 3, ///< With position feedback 1 (motor, S-0-0051).
  Position2 = 4, ///< With position feedback 2 (external, S-0-0053).
  Position1Lagless = 11,
  Position2Lagless = 12,
};

/// Elements of the data block of an IDN, bits 5 … 3 of the control word.
enum class Element : uint8_t {
  None = 0,      ///< The service channel is closed; what is under way is broken off.
  Idn = 1,       ///< Written: opens the channel for that IDN. Read: its data state.
  Name = 2,      ///< A list of characters.
  Attribute = 3, ///< 4 bytes: attribute.hpp.
  Unit = 4,      ///< A list of characters.
  Minimum = 5,
  Maximum = 6,
  Data = 7,
};
constexpr Element elementOf(uint16_t controlWord) {
  return static_cast<Element>((controlWord & control::kElementMask) >> control::kElementShift);
}
constexpr uint16_t elementBits(Element element) {
  return static_cast<uint16_t>(static_cast<unsigned>(element) << control::kElementShift);
}

// A step of the service channel. The master puts its bits and its word (0 when it reads) into the
// MDT and turns MHS. The step is over when AHS is MHS and Busy is 0; until then the master repeats
// the same bits and word. Busy may come before AHS has followed, or after. With Error the word of
// the AT says why, and the element has to begin anew with its first word; else, when reading, it is
// the word. A channel opens with one step: Element::Idn, kWrite and kEnd, the word is the IDN.
// Elements of 2 bytes take one step with kEnd, those of 4 bytes two, the low word first; lists and
// texts begin with two words, the bytes in use now and the most that there can be (neither counts
// these 4 bytes), then the values follow; an odd byte at the end is filled up with 0. kEnd belongs
// to the last word, also when reading: with an earlier one it is "too short", without it after the
// last one "too long". To leave an element early another one is begun, or an IDN opened.
// The AT comes before the MDT in a cycle: what answers an MDT is in the AT after the next MST or in
// a later one. So there is a step in a cycle at best.

/// State of the data of an IDN: element 1, read. [IEC 61491]
namespace data_state {
inline constexpr uint16_t kSet = 0x0001;        ///< The command has been set …
inline constexpr uint16_t kEnabled = 0x0002;    ///< … and enabled.
inline constexpr uint16_t kNotYet = 0x0004;     ///< It has not been executed yet.
inline constexpr uint16_t kImpossible = 0x0008; ///< An error: it cannot be executed.
inline constexpr uint16_t kInvalid = 0x0100;    ///< The operation data is invalid (no command).

// Values of procedure commands: the low four bits.
inline constexpr uint16_t kCommandMask = 0x000F;
inline constexpr uint16_t kIdle = 0x0000;
inline constexpr uint16_t kDone = 0x0003;
inline constexpr uint16_t kInterrupted = 0x0005;
inline constexpr uint16_t kRunning = 0x0007;
inline constexpr uint16_t kFailed = 0x000F;
} // namespace data_state

/// What is written to the operation data of a procedure command.
namespace command {
inline constexpr uint16_t kCancel = 0;
inline constexpr uint16_t kInterrupt = 1; ///< Set, but no longer enabled.
inline constexpr uint16_t kStart = 3;
} // namespace command

} // namespace stride::sercos

#endif
