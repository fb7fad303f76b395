#include "runtime/numeric/cnc/gcode_word.hpp"

#include "runtime/numeric/exact_math.hpp"

namespace stride::cnc {
namespace {

/// The letters of the axes with limits, in the order of PathObject::limits.
constexpr char kLimitLetters[kLimitedAxes] = {'Z', 'A', 'B', 'C', 'P', 'Q', 'U', 'V', 'W'};

template <class Value> double read(const uint8_t *address) noexcept {
  Value value;
  __builtin_memcpy(&value, address, sizeof value);
  return static_cast<double>(value);
}

template <class Value>
void write(uint8_t *address, double value, double least, double most) noexcept {
  // Halves away from zero, as conversions in ST.
  double whole = value == value ? exact::signOf(value) * exact::floor(exact::fabs(value) + 0.5) : 0;
  whole = whole < least ? least : whole > most ? most : whole;
  const auto stored = static_cast<Value>(whole);
  __builtin_memcpy(address, &stored, sizeof stored);
}

/// Index into kLimitLetters, or -1.
int32_t limitedAxis(char letter) noexcept {
  for (int32_t i = 0; i < kLimitedAxes; ++i)
    if (kLimitLetters[i] == letter)
      return i;
  return -1;
}

bool within(uint8_t code, uint8_t first, int32_t from) noexcept {
  return code >= first + from && code < first + kLimitedAxes;
}

} // namespace

double valueOf(const GCodeWord &word) noexcept {
  if (word.address == nullptr)
    return word.value;
  switch (static_cast<VariableType>(word.variables)) {
  case VariableType::Int:
    return read<int16_t>(word.address);
  case VariableType::Byte:
  case VariableType::Usint:
    return read<uint8_t>(word.address);
  case VariableType::Word:
  case VariableType::Uint:
    return read<uint16_t>(word.address);
  case VariableType::Dint:
    return read<int32_t>(word.address);
  case VariableType::Dword:
  case VariableType::Udint:
    return read<uint32_t>(word.address);
  case VariableType::Real:
    return read<float>(word.address);
  case VariableType::Sint:
    return read<int8_t>(word.address);
  case VariableType::Lreal:
    return read<double>(word.address);
  case VariableType::None:
  case VariableType::Structure:
    break;
  }
  return __builtin_nan("");
}

bool assignTo(const GCodeWord &word, double value) noexcept {
  if (word.address == nullptr)
    return false;
  switch (static_cast<VariableType>(word.variables)) {
  case VariableType::Int:
    write<int16_t>(word.address, value, -32768.0, 32767.0);
    return true;
  case VariableType::Byte:
  case VariableType::Usint:
    write<uint8_t>(word.address, value, 0.0, 255.0);
    return true;
  case VariableType::Word:
  case VariableType::Uint:
    write<uint16_t>(word.address, value, 0.0, 65535.0);
    return true;
  case VariableType::Dint:
    write<int32_t>(word.address, value, -2147483648.0, 2147483647.0);
    return true;
  case VariableType::Dword:
  case VariableType::Udint:
    write<uint32_t>(word.address, value, 0.0, 4294967295.0);
    return true;
  case VariableType::Sint:
    write<int8_t>(word.address, value, -128.0, 127.0);
    return true;
  case VariableType::Real: {
    const auto stored = static_cast<float>(value);
    __builtin_memcpy(word.address, &stored, sizeof stored);
    return true;
  }
  case VariableType::Lreal:
    __builtin_memcpy(word.address, &value, sizeof value);
    return true;
  case VariableType::None:
  case VariableType::Structure:
    break;
  }
  return false;
}

int32_t wholePart(double value) noexcept {
  if (value >= 2147483647.0)
    return 2147483647;
  if (value <= -2147483648.0)
    return -2147483647 - 1;
  return value == value ? static_cast<int32_t>(value) : 0;
}

bool isWord(uint8_t code) noexcept {
  return (code >= 'A' && code <= 'Z') || within(code, kFirstVelocityLimit, 0) ||
         within(code, kFirstAccelerationLimit, 0) || within(code, kFirstPeriod, 1) ||
         code == kRapidVelocity || code == kRapidAcceleration || code == kProbe;
}

bool wantsWhole(uint8_t code) noexcept {
  return code == 'G' || code == 'H' || code == 'M' || code == 'N' || code == 'S' || code == kProbe;
}

int32_t lettersOf(uint8_t code, char *text) noexcept {
  const auto pair = [text](char first, char second) {
    text[0] = first;
    text[1] = second;
    return 2;
  };
  if (code == kProbe) {
    __builtin_memcpy(text, "PROBE", 5);
    return 5;
  }
  if (code == kRapidVelocity || code == kRapidAcceleration)
    return pair(code == kRapidVelocity ? 'F' : 'E', 'F');
  if (within(code, kFirstVelocityLimit, 0))
    return pair('F', kLimitLetters[code - kFirstVelocityLimit]);
  if (within(code, kFirstAccelerationLimit, 0))
    return pair('E', kLimitLetters[code - kFirstAccelerationLimit]);
  if (within(code, kFirstPeriod, 1))
    return pair('P', kLimitLetters[code - kFirstPeriod]);
  text[0] = static_cast<char>(code);
  return 1;
}

uint8_t codeOf(const char *letters, int32_t count) noexcept {
  if (count == 1)
    return letters[0] >= 'A' && letters[0] <= 'Z' ? static_cast<uint8_t>(letters[0])
                                                  : static_cast<uint8_t>(kNoWord);
  if (count == 5 && __builtin_memcmp(letters, "PROBE", 5) == 0)
    return kProbe;
  if (count != 2)
    return kNoWord;
  if (letters[1] == 'F' && (letters[0] == 'F' || letters[0] == 'E'))
    return letters[0] == 'F' ? kRapidVelocity : kRapidAcceleration;
  const int32_t axis = limitedAxis(letters[1]);
  if (axis < 0)
    return kNoWord;
  if (letters[0] == 'F')
    return static_cast<uint8_t>(kFirstVelocityLimit + axis);
  if (letters[0] == 'E')
    return static_cast<uint8_t>(kFirstAccelerationLimit + axis);
  if (letters[0] == 'P' && axis > 0)
    return static_cast<uint8_t>(kFirstPeriod + axis);
  return kNoWord;
}

} // namespace stride::cnc
