#include "runtime/numeric/nc/program_line.hpp"

namespace stride::nc {
namespace {

constexpr int64_t kMostColumn = 65535;
constexpr uint8_t kReturnBit = 0x80; // of stateOf: a `\n` may follow

int32_t columnOf(const ProgramLine &line) noexcept {
  const int64_t column = line.offset - line.begin;
  return static_cast<int32_t>(column < kMostColumn ? column : kMostColumn);
}

LineEvent fail(ProgramLine &line, Error error) noexcept {
  line.error = error;
  line.errorColumn = columnOf(line);
  line.state = LineState::Rest;
  return LineEvent::Error;
}

LineEvent put(ProgramLine &line, char c) noexcept {
  if (line.length == kMostLine)
    return fail(line, Error::BufferTooSmall);
  line.column[line.length] = static_cast<uint16_t>(columnOf(line));
  line.text[line.length++] = c;
  return LineEvent::None;
}

/// Whether the last character is this one and stands right before the present one.
bool follows(const ProgramLine &line, char c) noexcept {
  return line.length > 0 && line.text[line.length - 1] == c &&
         line.column[line.length - 1] + 1 == columnOf(line);
}

bool isEmpty(const ProgramLine &line) noexcept {
  for (int32_t i = 0; i < line.length; ++i)
    if (line.text[i] != ' ' && line.text[i] != '\t')
      return false;
  return true;
}

LineEvent takeCode(ProgramLine &line, bool parentheses, char c) noexcept {
  if (c == '/' && follows(line, '/')) {
    --line.length;
    line.state = LineState::LineComment;
    return LineEvent::None;
  }
  if (parentheses ? c == '(' : c == '*' && follows(line, '(')) {
    // A blank stands for the comment, so that it separates.
    if (!parentheses)
      --line.length;
    line.state = LineState::Comment;
    return put(line, ' ');
  }
  if (c == '%' && isEmpty(line))
    line.state = LineState::Name;
  else if (c == '\'')
    line.state = LineState::Text;
  else if (c == '$')
    line.state = LineState::Variable;
  return put(line, c);
}

LineEvent take(ProgramLine &line, bool parentheses, char c) noexcept {
  switch (line.state) {
  case LineState::Code:
    return takeCode(line, parentheses, c);
  case LineState::Text:
  case LineState::Variable:
    if (c == (line.state == LineState::Text ? '\'' : '$'))
      line.state = LineState::Code;
    return put(line, c);
  case LineState::Name:
    return put(line, c);
  case LineState::Comment:
  case LineState::Star: {
    const bool ends = c == ')' && (parentheses || line.state == LineState::Star);
    line.state = ends ? LineState::Code : c == '*' ? LineState::Star : LineState::Comment;
    return LineEvent::None;
  }
  case LineState::LineComment:
  case LineState::Rest:
    break;
  }
  return LineEvent::None;
}

/// The end of a line, which is not taken yet. `open`: a comment may go on in the next line.
LineEvent complete(ProgramLine &line, bool open) noexcept {
  line.column[line.length] = static_cast<uint16_t>(columnOf(line));
  line.text[line.length] = 0;
  switch (line.state) {
  case LineState::Text:
  case LineState::Variable:
    return fail(line, Error::UnexpectedEnd);
  case LineState::Comment:
  case LineState::Star:
    if (!open)
      return fail(line, Error::UnexpectedEnd);
    line.state = LineState::Comment;
    return LineEvent::Line;
  case LineState::Rest:
    line.length = 0;
    line.text[0] = 0;
    line.state = LineState::Code;
    return LineEvent::Line;
  case LineState::Code:
  case LineState::Name:
  case LineState::LineComment:
    break;
  }
  line.state = LineState::Code;
  return LineEvent::Line;
}

bool isMark(const ProgramLine &line, uint8_t c) noexcept {
  constexpr uint8_t kMark[3] = {0xEF, 0xBB, 0xBF};
  return line.offset < 3 && line.begin == 0 && c == kMark[line.offset];
}

} // namespace

LineEvent readLine(ProgramLine &line, bool parentheses, const uint8_t *bytes, int64_t count,
                   int64_t &used) noexcept {
  for (used = 0; used < count; ++used, ++line.offset) {
    const uint8_t c = bytes[used];
    if (c == '\n' && line.carriageReturn) {
      line.carriageReturn = false;
      line.begin = line.offset + 1;
      continue;
    }
    line.carriageReturn = false;
    if (isMark(line, c)) // of UTF-8, at the beginning
      continue;
    const bool end = c == '\n' || c == '\r';
    const LineEvent event =
        end ? complete(line, !parentheses) : take(line, parentheses, static_cast<char>(c));
    if (event == LineEvent::None)
      continue;
    // An error at the end of a line leaves the end for the line's own event.
    if (!(end && event == LineEvent::Error)) {
      line.carriageReturn = c == '\r';
      ++used;
      ++line.offset;
    }
    return event;
  }
  return LineEvent::None;
}

LineEvent endLine(ProgramLine &line) noexcept {
  if (line.length == 0 && line.state == LineState::Code)
    return LineEvent::None;
  return complete(line, false);
}

void nextLine(ProgramLine &line) noexcept {
  ++line.number;
  line.begin = line.offset;
  line.length = 0;
}

uint8_t stateOf(const ProgramLine &line) noexcept {
  const auto state = static_cast<uint8_t>(line.state);
  return line.carriageReturn ? static_cast<uint8_t>(state | kReturnBit) : state;
}

void resumeLine(ProgramLine &line, int64_t offset, int32_t number, uint8_t state) noexcept {
  line.offset = line.begin = offset;
  line.number = number;
  line.length = 0;
  line.error = Error::None;
  line.state = static_cast<LineState>(state & static_cast<uint8_t>(~kReturnBit));
  line.carriageReturn = (state & kReturnBit) != 0;
}

} // namespace stride::nc
