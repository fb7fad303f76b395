#include "runtime/numeric/cnc/gcode_reader.hpp"

namespace stride::cnc {
namespace {

char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 'a' - 'A') : c; }

bool sameName(const char *a, const char *b) noexcept {
  int32_t i = 0;
  for (; i < kMostName && a[i] != 0; ++i)
    if (lower(a[i]) != lower(b[i]))
      return false;
  return i == kMostName || b[i] == 0;
}

bool isType(int16_t type) noexcept {
  return (type >= 1 && type <= 6) || type == 11 || (type >= 14 && type <= 17) || type == 22;
}

/// Words that have been decoded make room.
void compact(Reader &reader, const WordMemory &memory) noexcept {
  const uint32_t gone = *memory.read < reader.written ? *memory.read : reader.written;
  if (gone == 0 || (gone < memory.capacity / 2 && reader.written < memory.capacity))
    return;
  __builtin_memmove(memory.words, memory.words + gone, (reader.written - gone) * sizeof(GCodeWord));
  reader.written -= gone;
  *memory.count -= gone;
  *memory.read = 0;
}

void put(Reader &reader, const WordMemory &memory, const GCodeWord &word) noexcept {
  memory.words[reader.written++] = word;
}

/// A sentence is complete: the decoder may have it.
void publish(Reader &reader, const WordMemory &memory, uint8_t letter, int32_t integer) noexcept {
  GCodeWord word{};
  word.letter = letter;
  word.integer = integer;
  put(reader, memory, word);
  *memory.count = reader.written;
}

/// What is left when there is no more room for a word.
ReadResult full(const WordMemory &memory) noexcept {
  return *memory.count == 0 ? ReadResult::TooSmall : ReadResult::Full;
}

/// Takes an event. More: go on.
ReadResult take(Reader &reader, const WordMemory &memory, const VariableList *variables,
                ScanEvent event) noexcept {
  Scanner &scanner = reader.scanner;
  switch (event) {
  case ScanEvent::Word: {
    GCodeWord word = scanner.word;
    if (scanner.variable &&
        (variables == nullptr || !resolveVariable(*variables, scanner.name, word)))
      return ReadResult::Variable;
    put(reader, memory, word);
    return ReadResult::More;
  }
  case ScanEvent::EndOfSentence:
    publish(reader, memory, kEndOfSentence, scanner.line + 1);
    return ReadResult::More;
  case ScanEvent::EndOfProgram:
    publish(reader, memory, kEndOfProgram, 0);
    reader.ended = true;
    return ReadResult::Ended;
  case ScanEvent::Error:
    return ReadResult::Wrong;
  case ScanEvent::ProgramName:
    __builtin_memcpy(memory.title, scanner.name, sizeof scanner.name);
    break;
  case ScanEvent::None:
    break;
  }
  return ReadResult::More;
}

} // namespace

bool resolveVariable(const VariableList &list, const char *name, GCodeWord &word) noexcept {
  if (list.first == nullptr)
    return false;
  for (int32_t i = 0; i < list.count; ++i) {
    NamedVariable &variable = list.first[i];
    if (!sameName(variable.name, name))
      continue;
    if (!isType(variable.type))
      return false;
    word.variables = static_cast<uint8_t>(variable.type);
    word.address = variable.address;
    if (variable.address != nullptr)
      return true;
    const auto type = static_cast<VariableType>(variable.type);
    if (type == VariableType::Structure)
      return false;
    const bool real = type == VariableType::Real || type == VariableType::Lreal;
    word.variables = static_cast<uint8_t>(real ? VariableType::Real : VariableType::Dint);
    word.address = real ? reinterpret_cast<uint8_t *>(&variable.real)
                        : reinterpret_cast<uint8_t *>(&variable.integer);
    return true;
  }
  return false;
}

bool putWord(Reader &reader, const WordMemory &memory, uint8_t letter, double value) noexcept {
  if (reader.written == memory.capacity)
    return false;
  if (letter == kEndOfSentence) {
    publish(reader, memory, letter, 0);
    return true;
  }
  GCodeWord word{};
  word.letter = letter;
  word.value = value;
  word.integer = wholePart(value);
  put(reader, memory, word);
  return true;
}

ReadResult readWords(Reader &reader, const WordMemory &memory, const VariableList *variables,
                     const uint8_t *bytes, int64_t count, bool end, int64_t &used) noexcept {
  used = 0;
  for (;;) {
    if (reader.ended)
      return ReadResult::Ended;
    compact(reader, memory);
    if (reader.written >= memory.capacity)
      return full(memory);
    ScanEvent event = ScanEvent::None;
    if (used < count) {
      int64_t taken = 0;
      event = scan(reader.scanner, bytes + used, count - used, taken);
      used += taken;
    } else if (!end) {
      return ReadResult::More;
    } else {
      event = scanEnd(reader.scanner);
      if (event == ScanEvent::None)
        event = ScanEvent::EndOfProgram;
    }
    if (const ReadResult result = take(reader, memory, variables, event);
        result != ReadResult::More)
      return result;
  }
}

} // namespace stride::cnc
