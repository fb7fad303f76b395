// The registers of the multi-axis motion module TSX CSY 85: one table, from which come the types
// T_CSY_… of stdlib/CSY, the addresses that the compiler knows, and the list in docs/csy.md.
// Source: TSX CSY 85 configuration manual 35010452, chapter 5. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_CSY_REGISTER_MAP_HPP
#define STRIDE_RUNTIME_NUMERIC_CSY_REGISTER_MAP_HPP

#include <stddef.h>
#include <stdint.h>

namespace stride::csy {

/// Types of language objects, as bits.
enum ChannelKind : uint8_t {
  kCmd = 1,     ///< T_CSY_CMD: what all channels have that take commands
  kRing = 2,    ///< T_CSY_RING: channel 0
  kTrf = 4,     ///< T_CSY_TRF: transfers of any channel
  kInd = 8,     ///< T_CSY_IND: independent axes, channels 1 to 16
  kCoord = 16,  ///< T_CSY_COORD: coordinated groups, channels 17 to 20
  kFollow = 32, ///< T_CSY_FOLLOW: follower groups, channels 21 to 24
  kCam = 64,    ///< T_CSY_CAM: channels 25 to 31
  kModule = 128 ///< T_GEN_MOD: the module, %….MOD
};

inline constexpr uint32_t kChannels = 32;
inline constexpr uint32_t kModuleChannel = kChannels; ///< stands for `MOD`

enum class RegisterArea : uint8_t {
  Input,  ///< %I, %IW, %IF: refreshed at the start of the task
  Output, ///< %Q, %QD: taken over at its end
  Memory  ///< %MW, %MD, %MF: by explicit exchanges
};

enum class RegisterType : uint8_t { Bool, Int, Dint, Real };

inline constexpr uint8_t kNoWord = 255;
inline constexpr uint8_t kErrorBit = 255; ///< %I….ERR
/// Words from here on are not the manual's: they carry what READ_PARAM and the others ask for.
inline constexpr uint8_t kOwnWord = 120;

/// One register, or several of them whose names end in numbers.
struct RegisterRow {
  const char *symbol; ///< with repeats, `_` and a number are added
  RegisterArea area;
  RegisterType type;
  uint8_t word;        ///< of words; kNoWord: of bits of %I and %Q
  uint8_t bit;         ///< of BOOL: in the word, or of %I and %Q
  uint8_t kinds;       ///< types that have it
  bool writable;       ///< by programs
  const char *meaning; ///< in one line
  uint8_t first = 0;   ///< number of the first one
  uint8_t repeats = 1;
  uint8_t step = 0; ///< words from one to the next
};

extern const RegisterRow kRegisters[];
extern const size_t kRegisterRows;

/// A register of one type of object, without repeats.
struct Register {
  const RegisterRow *row;
  char symbol[32];
  uint8_t word;
};

/// The `index`-th register of a type (one bit of ChannelKind), in the order of the table; false
/// after the last one.
bool registerAt(uint8_t kind, size_t index, Register &found) noexcept;

/// The type of object of a channel, 0 to 32; 0 for others. Every channel can also be seen as
/// T_CSY_CMD and T_CSY_TRF.
uint8_t kindOfChannel(uint32_t channel) noexcept;
/// `T_CSY_IND` and so on.
const char *nameOfKind(uint8_t kind) noexcept;

// ---- where the registers lie in the process image

/// Bytes that a channel takes of each area. A word of memory takes four bytes, so that those of two
/// words, which begin at any number, lie at multiples of four.
inline constexpr uint32_t kInputBytes = 16;
inline constexpr uint32_t kOutputBytes = 8;
inline constexpr uint32_t kMemoryWords = 128;
inline constexpr uint32_t kMemoryBytes = 4 * kMemoryWords;

/// Where the bytes of a module begin in an area: far above what programs use for themselves.
/// Channels lie one after the other, `MOD` after the last one.
constexpr uint32_t startOfModule(RegisterArea area, uint32_t module) noexcept {
  switch (area) {
  case RegisterArea::Input:
    return 0x10000 + module * 0x400;
  case RegisterArea::Output:
    return 0x10000 + module * 0x400;
  case RegisterArea::Memory:
    break;
  }
  return 0x100000 + module * 0x8000;
}
constexpr uint32_t bytesOfChannel(RegisterArea area) noexcept {
  return area == RegisterArea::Input    ? kInputBytes
         : area == RegisterArea::Output ? kOutputBytes
                                        : kMemoryBytes;
}

/// What a module takes for its outputs while the PLC is in STOP, so many bytes after the outputs
/// themselves, which programs keep.
inline constexpr uint32_t kStopOutputs = 0x200;

struct ImagePlace {
  uint32_t byte;
  int8_t bit; ///< 0 to 7; -1: not of a bit
};

/// From the start of the channel's bytes of the area. Numbers must be within the areas.
ImagePlace placeOfBit(uint8_t number) noexcept;                    ///< of %I and %Q
ImagePlace placeOfWord(RegisterArea area, uint32_t word) noexcept; ///< of all
ImagePlace placeOf(const Register &found) noexcept;

} // namespace stride::csy

#endif // STRIDE_RUNTIME_NUMERIC_CSY_REGISTER_MAP_HPP
