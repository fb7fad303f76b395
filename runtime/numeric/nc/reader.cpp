#include "runtime/numeric/nc/reader.hpp"

#include "runtime/numeric/cnc/gcode_word.hpp"

namespace stride::nc {
namespace {

void fail(Reader &reader, SentenceQueue &queue, Error error, int32_t column) noexcept {
  reader.error = error;
  reader.errorLine = reader.line.number;
  reader.errorColumn = column;
  queue.error = error;
}

void copyName(char *to, const char *from) noexcept {
  __builtin_memcpy(to, from, kMostName + 1);
  to[kMostName] = 0;
}

/// The name behind `%`, without blanks around it.
void readTitle(const ProgramLine &line, char *title) noexcept {
  int32_t start = skipBlanks(line, skipBlanks(line, 0) + 1);
  int32_t end = line.length;
  while (end > start && skipBlanks(line, end - 1) != end - 1)
    --end;
  int32_t count = 0;
  while (start < end && count < kMostName)
    title[count++] = line.text[start++];
  title[count] = 0;
}

/// The end of the program as a sentence. False: there is no room.
bool putEnd(Reader &reader, SentenceQueue &queue) noexcept {
  CodeWriter code = roomForSentence(queue, false);
  if (code.capacity < static_cast<int32_t>(sizeof(SentenceHead)))
    code = roomForSentence(queue, true);
  SentenceHead head{};
  head.size = sizeof head;
  head.kind = SentenceKind::End;
  head.line = reader.line.number;
  head.next = reader.line.offset;
  put(code, head);
  if (code.size > code.capacity)
    return false;
  queue.count += sizeof head;
  return true;
}

/// After the last line.
ReadState finish(Reader &reader, SentenceQueue &queue) noexcept {
  const Program &program = reader.programs[reader.level];
  if (program.sub && program.phase != Phase::Ended) {
    fail(reader, queue, program.phase == Phase::Start ? Error::NotDeclaredHere : Error::EndMissing,
         0);
    return ReadState::Wrong;
  }
  if (!program.sub && !putEnd(reader, queue))
    return ReadState::Full;
  reader.ended = true;
  return ReadState::Ended;
}

/// Makes a sentence of a complete line. More: go on.
ReadState takeLine(Reader &reader, SentenceQueue &queue, const ReadSettings &settings,
                   bool compact) noexcept {
  CodeWriter code = roomForSentence(queue, compact);
  if (code.capacity < static_cast<int32_t>(sizeof(SentenceHead)))
    return ReadState::Full;
  LineTask task{reader.line,
                reader.symbols,
                reader.programs[reader.level],
                settings.variables,
                code,
                Error::None,
                0};
  switch (readSentence(task)) {
  case LineResult::Nothing:
    return ReadState::More;
  case LineResult::Title:
    if (reader.level == 0)
      readTitle(reader.line, queue.title);
    return ReadState::More;
  case LineResult::Finish:
    return ReadState::Ended;
  case LineResult::Wrong:
    fail(reader, queue, task.error, reader.line.column[task.errorAt]);
    return ReadState::Wrong;
  case LineResult::Sentence:
    break;
  }
  if (code.size > code.capacity)
    return ReadState::Full;
  queue.count += static_cast<uint32_t>(code.size);
  return ReadState::More;
}

/// The same, with the room that sentences leave that have been taken.
ReadState takeWhole(Reader &reader, SentenceQueue &queue, const ReadSettings &settings) noexcept {
  ReadState state = takeLine(reader, queue, settings, false);
  if (state == ReadState::Full && queue.read > 0)
    state = takeLine(reader, queue, settings, true);
  if (state == ReadState::Full && queue.count == 0) {
    fail(reader, queue, Error::QueueFull, 0);
    return ReadState::Wrong;
  }
  if (state == ReadState::Ended)
    state = finish(reader, queue);
  reader.waiting = state == ReadState::Full;
  if (state == ReadState::More)
    nextLine(reader.line);
  return state;
}

/// The next line. More: there is none yet.
ReadState nextState(Reader &reader, const ReadSettings &settings, SentenceQueue &queue,
                    const uint8_t *bytes, int64_t count, bool end, int64_t &used,
                    bool &complete) noexcept {
  int64_t taken = 0;
  LineEvent event = readLine(reader.line, settings.parentheses, bytes + used, count - used, taken);
  used += taken;
  if (event == LineEvent::None && end && used == count) {
    event = endLine(reader.line);
    if (event == LineEvent::None)
      return finish(reader, queue);
  }
  if (event == LineEvent::Error) {
    fail(reader, queue, reader.line.error, reader.line.errorColumn);
    return ReadState::Wrong;
  }
  complete = event == LineEvent::Line;
  return ReadState::More;
}

} // namespace

void beginReading(Reader &reader, SentenceQueue &queue, bool keep) noexcept {
  __builtin_memset(&reader, 0, sizeof reader);
  if (!keep)
    emptySentences(queue);
  queue.error = Error::None;
  queue.request = Request::None;
  queue.whole = !keep;
  queue.begun = true;
  queue.title[0] = 0;
}

bool putSentence(SentenceQueue &queue, const uint8_t *codes, const double *values,
                 int32_t count) noexcept {
  CodeWriter code = roomForSentence(queue, false);
  SentenceHead head{};
  head.kind = SentenceKind::Words;
  put(code, head);
  put(code, static_cast<uint8_t>(count));
  for (int32_t i = 0; i < count; ++i) {
    WordHead word{};
    word.code = codes[i];
    word.type = ValueType::Real;
    word.size = 1 + sizeof(double);
    put(code, word);
    put(code, Op::Number);
    put(code, values[i]);
  }
  if (code.size > code.capacity)
    return false;
  head.size = static_cast<uint32_t>(code.size);
  __builtin_memcpy(code.bytes, &head, sizeof head);
  queue.count += head.size;
  return true;
}

ReadState readProgram(Reader &reader, SentenceQueue &queue, const ReadSettings &settings,
                      const uint8_t *bytes, int64_t count, bool end, int64_t &used) noexcept {
  used = 0;
  for (;;) {
    if (reader.error != Error::None)
      return ReadState::Wrong;
    if (reader.ended)
      return ReadState::Ended;
    bool complete = reader.waiting;
    if (!complete) {
      const ReadState state = nextState(reader, settings, queue, bytes, count, end, used, complete);
      if (state != ReadState::More)
        return state;
      if (!complete)
        return ReadState::More;
    }
    if (const ReadState state = takeWhole(reader, queue, settings); state != ReadState::More)
      return state;
  }
}

int64_t rewindProgram(Reader &reader, SentenceQueue &queue) noexcept {
  Program &program = reader.programs[reader.level];
  reader.symbols.used = program.scope.start;
  program.scope.count = 0;
  program.phase = Phase::Start;
  program.titled = false;
  resumeLine(reader.line, 0, 0, 0);
  reader.waiting = reader.ended = false;
  emptySentences(queue);
  queue.whole = true;
  queue.request = Request::None;
  return 0;
}

int64_t enterSubprogram(Reader &reader, SentenceQueue &queue) noexcept {
  if (reader.level == kMostNesting) {
    breakReading(reader, queue, Error::Nesting);
    return -1;
  }
  reader.resumes[reader.level] = queue.resume;
  ++reader.level;
  Program &program = reader.programs[reader.level];
  program = Program{};
  program.scope.start = reader.symbols.used;
  program.sub = true;
  copyName(program.name, queue.name);
  return rewindProgram(reader, queue);
}

int64_t leaveSubprogram(Reader &reader, SentenceQueue &queue) noexcept {
  if (reader.level == 0)
    return -1;
  reader.symbols.used = reader.programs[reader.level].scope.start;
  --reader.level;
  const Resume &resume = reader.resumes[reader.level];
  resumeLine(reader.line, resume.offset, resume.line, resume.state);
  // What follows belongs to the body: declarations have been before the call.
  reader.programs[reader.level].phase = Phase::Body;
  reader.waiting = reader.ended = false;
  emptySentences(queue);
  queue.request = Request::None;
  return resume.offset;
}

void breakReading(Reader &reader, SentenceQueue &queue, Error error) noexcept {
  fail(reader, queue, error, 0);
  reader.ended = true;
}

} // namespace stride::nc
