#include "runtime/numeric/cnc/gcode_scanner.hpp"

#include "runtime/iec/text.h"

namespace stride::cnc {
namespace {

constexpr int64_t kExact = int64_t{1} << 53;
constexpr int32_t kExactDecimals = 22;
constexpr double kPowers[kExactDecimals + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

bool isBlank(uint8_t c) noexcept { return c == ' ' || c == '\t' || c == 0x0B || c == 0x0C; }
bool isDigit(uint8_t c) noexcept { return c >= '0' && c <= '9'; }
bool isLetter(uint8_t c) noexcept { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool beginsNumber(uint8_t c) noexcept { return isDigit(c) || c == '+' || c == '-' || c == '.'; }
char upper(uint8_t c) noexcept { return static_cast<char>(c >= 'a' ? c - 'a' + 'A' : c); }

ScanEvent fail(Scanner &s, GCodeError error) noexcept {
  s.error = error;
  s.state = ScanState::Rest;
  return ScanEvent::Error;
}

ScanEvent failHere(Scanner &s, GCodeError error) noexcept {
  s.wordOffset = s.offset;
  return fail(s, error);
}

/// A word is complete.
ScanEvent give(Scanner &s, uint8_t code, double value, bool variable) noexcept {
  s.word = {};
  s.word.letter = code;
  s.word.value = value;
  s.word.integer = wholePart(value);
  s.variable = variable;
  s.inSentence = true;
  s.begun = true;
  s.state = ScanState::Between;
  return ScanEvent::Word;
}

bool beginsWithSign(const Scanner &s) noexcept { return s.digits[0] == '-' || s.digits[0] == '+'; }

/// The value of what `digits` holds.
bool numberOf(const Scanner &s, double &value) noexcept {
  const int32_t decimals = s.decimals > 0 ? s.decimals : 0;
  const int32_t signs = beginsWithSign(s) ? 1 : 0;
  if (s.count == signs + (s.decimals >= 0 ? 1 : 0)) // no digit
    return false;
  if (s.mantissa < kExact && decimals <= kExactDecimals) {
    value = static_cast<double>(s.mantissa) / kPowers[decimals];
    if (s.digits[0] == '-')
      value = -value;
    return true;
  }
  // Written as `5.` or `.5` a number is none in ST.
  char text[kMostDigits + 3];
  int32_t length = 0;
  for (int32_t i = 0; i < s.count; ++i) {
    if (s.digits[i] == '.' && (length == 0 || !isDigit(static_cast<uint8_t>(text[length - 1]))))
      text[length++] = '0';
    text[length++] = s.digits[i];
  }
  if (text[length - 1] == '.')
    text[length++] = '0';
  const text::Scanned scanned = text::scanReal(text, static_cast<uint32_t>(length));
  value = scanned.real;
  return scanned.used == static_cast<uint32_t>(length);
}

/// Whether the number of this word E is the exponent of the number before it.
bool isExponentOf(const Scanner &s) noexcept {
  return s.exponent != Exponent::No && s.word.letter == 'E' && beginsWithSign(s) &&
         s.decimals < 0 && isExponent(s.exponent, s.count - 1, s.digits[1]);
}

ScanEvent endNumber(Scanner &s) noexcept {
  double value = 0.0;
  if (isExponentOf(s))
    return fail(s, GCodeError::Exponent);
  if (!numberOf(s, value))
    return fail(s, GCodeError::BadNumber);
  const uint8_t code = s.word.letter;
  if (wantsWhole(code) && static_cast<double>(wholePart(value)) != value)
    return fail(s, GCodeError::NotWhole);
  return give(s, code, value, false);
}

/// One more character of the number; false: too many.
bool addDigit(Scanner &s, uint8_t c) noexcept {
  if (s.count == kMostDigits)
    return false;
  s.digits[s.count++] = static_cast<char>(c);
  if (c == '.')
    s.decimals = 0;
  else if (isDigit(c)) {
    if (s.mantissa < kExact)
      s.mantissa = s.mantissa * 10 + (c - '0');
    if (s.decimals >= 0)
      ++s.decimals;
  }
  return true;
}

/// The letters are complete: which word. False: none.
bool endLetters(Scanner &s) noexcept {
  s.word.letter = codeOf(s.letters, s.count);
  return s.word.letter != kNoWord;
}

/// The end of a line, which is not taken yet.
ScanEvent endLine(Scanner &s) noexcept {
  switch (s.state) {
  case ScanState::Slash:
    return failHere(s, GCodeError::UnexpectedCharacter);
  case ScanState::Letters:
    return fail(s, endLetters(s) ? GCodeError::MissingValue : GCodeError::UnknownWord);
  case ScanState::AfterLetters:
    return fail(s, GCodeError::MissingValue);
  case ScanState::Number:
    return endNumber(s);
  case ScanState::Variable:
    return fail(s, GCodeError::UnclosedVariable);
  case ScanState::Comment:
    return fail(s, GCodeError::UnclosedComment);
  case ScanState::Name:
    while (s.count > 0 && isBlank(static_cast<uint8_t>(s.name[s.count - 1])))
      --s.count;
    s.name[s.count] = 0;
    s.state = ScanState::Between;
    return ScanEvent::ProgramName;
  case ScanState::Start:
  case ScanState::Between:
  case ScanState::Rest:
  case ScanState::Ended:
    break;
  }
  if (!s.inSentence)
    return ScanEvent::None;
  s.inSentence = false;
  s.state = ScanState::Between;
  return ScanEvent::EndOfSentence;
}

void beginNumber(Scanner &s) noexcept {
  s.state = ScanState::Number;
  s.count = 0;
  s.mantissa = 0;
  s.decimals = -1;
}

/// A byte where a value begins; it is taken.
ScanEvent beginValue(Scanner &s, uint8_t c) noexcept {
  if (c == '$') {
    s.state = ScanState::Variable;
    s.count = 0;
    return ScanEvent::None;
  }
  beginNumber(s);
  (void)addDigit(s, c);
  return ScanEvent::None;
}

/// The first letter of a word.
void beginWord(Scanner &s, uint8_t c) noexcept {
  const bool isSmall = c >= 'a';
  s.exponent = s.endsInDigit && upper(c) == 'E'
                   ? exponentBehind(s.count - (beginsWithSign(s) ? 1 : 0), isSmall && !s.lowerCase)
                   : Exponent::No;
  s.lowerCase = isSmall;
  s.state = ScanState::Letters;
  s.letters[0] = upper(c);
  s.count = 1;
}

/// A byte between words, or at the start of a line.
ScanEvent between(Scanner &s, uint8_t c, bool &taken) noexcept {
  const bool start = s.state == ScanState::Start;
  if (!isLetter(c))
    s.endsInDigit = false;
  if (isBlank(c))
    return ScanEvent::None;
  s.wordOffset = s.offset;
  s.state = ScanState::Between;
  if (isLetter(c)) {
    beginWord(s, c);
  } else if (c == '(') {
    s.state = ScanState::Comment;
  } else if (c == '/') {
    // It is a word only at the start of a line; two are a comment.
    s.state = ScanState::Slash;
    s.count = start ? 1 : 0;
  } else if (c == '%' && start) {
    s.state = s.begun ? ScanState::Ended : ScanState::Name;
    s.count = 0;
    s.name[0] = 0;
    if (s.begun)
      return ScanEvent::EndOfProgram;
    s.begun = true;
  } else {
    taken = false;
    return fail(s, GCodeError::UnexpectedCharacter);
  }
  return ScanEvent::None;
}

ScanEvent letters(Scanner &s, uint8_t c, bool &taken) noexcept {
  if (isLetter(c)) {
    if (s.count == kMostLetters)
      return fail(s, GCodeError::UnknownWord);
    s.letters[s.count++] = upper(c);
    return ScanEvent::None;
  }
  if (!endLetters(s)) {
    taken = false;
    return fail(s, GCodeError::UnknownWord);
  }
  if (isBlank(c)) {
    s.state = ScanState::AfterLetters;
    return ScanEvent::None;
  }
  if (beginsNumber(c) || c == '$')
    return beginValue(s, c);
  taken = false;
  return fail(s, GCodeError::MissingValue);
}

ScanEvent number(Scanner &s, uint8_t c, bool &taken) noexcept {
  if (isDigit(c) || (c == '.' && s.decimals < 0))
    return addDigit(s, c) ? ScanEvent::None : fail(s, GCodeError::BadNumber);
  taken = false;
  if (c == '.' || c == '+' || c == '-' || c == '$')
    return fail(s, GCodeError::BadNumber);
  s.endsInDigit = true;
  return endNumber(s);
}

ScanEvent variable(Scanner &s, uint8_t c) noexcept {
  if (c == '$') {
    s.name[s.count] = 0;
    return s.count > 0 ? give(s, s.word.letter, 0.0, true) : fail(s, GCodeError::BadVariable);
  }
  if (s.count == kMostName || c < ' ')
    return fail(s, GCodeError::BadVariable);
  s.name[s.count++] = static_cast<char>(c);
  return ScanEvent::None;
}

ScanEvent slash(Scanner &s, uint8_t c, bool &taken) noexcept {
  if (c == '/') {
    s.state = ScanState::Rest;
    return ScanEvent::None;
  }
  taken = false;
  return s.count == 1 ? give(s, kSkip, 0.0, false) : fail(s, GCodeError::UnexpectedCharacter);
}

/// One byte within a line. `taken` false: it belongs to what follows.
ScanEvent take(Scanner &s, uint8_t c, bool &taken) noexcept {
  switch (s.state) {
  case ScanState::Start:
  case ScanState::Between:
    return between(s, c, taken);
  case ScanState::Slash:
    return slash(s, c, taken);
  case ScanState::Letters:
    return letters(s, c, taken);
  case ScanState::AfterLetters:
    if (isBlank(c))
      return ScanEvent::None;
    if (beginsNumber(c) || c == '$')
      return beginValue(s, c);
    taken = false;
    return fail(s, GCodeError::MissingValue);
  case ScanState::Number:
    return number(s, c, taken);
  case ScanState::Variable:
    return variable(s, c);
  case ScanState::Comment:
    if (c == ')')
      s.state = ScanState::Between;
    return ScanEvent::None;
  case ScanState::Name:
    if (s.count < kMostName && c >= ' ' && !(s.count == 0 && isBlank(c)))
      s.name[s.count++] = static_cast<char>(c);
    return ScanEvent::None;
  case ScanState::Rest:
  case ScanState::Ended:
    break;
  }
  return ScanEvent::None;
}

/// Passes the end of a line.
void newLine(Scanner &s, uint8_t c) noexcept {
  s.carriageReturn = c == '\r';
  ++s.line;
  s.lastLine = s.offset + 1;
  s.state = ScanState::Start;
  s.endsInDigit = false;
}

} // namespace

ScanEvent scan(Scanner &scanner, const uint8_t *bytes, int64_t count, int64_t &used) noexcept {
  Scanner &s = scanner;
  for (used = 0; used < count; ++used, ++s.offset) {
    const uint8_t c = bytes[used];
    if (s.state == ScanState::Ended)
      continue;
    // The mark of UTF-8 at the beginning is none of the text.
    if (s.offset < 3 &&
        c == (s.offset == 0   ? 0xEF
              : s.offset == 1 ? 0xBB
                              : 0xBF) &&
        s.state == ScanState::Start)
      continue;
    ScanEvent event = ScanEvent::None;
    bool taken = true;
    if (c == '\n' || c == '\r') {
      if (c == '\n' && s.carriageReturn) {
        s.carriageReturn = false;
        s.lastLine = s.offset + 1;
        continue;
      }
      event = endLine(s);
      taken = event == ScanEvent::None;
      if (taken)
        newLine(s, c);
    } else {
      s.carriageReturn = false;
      event = take(s, c, taken);
    }
    if (event != ScanEvent::None) {
      if (taken) {
        ++used;
        ++s.offset;
      }
      return event;
    }
  }
  return ScanEvent::None;
}

ScanEvent scanEnd(Scanner &scanner) noexcept {
  return scanner.state == ScanState::Ended ? ScanEvent::None : endLine(scanner);
}

} // namespace stride::cnc
