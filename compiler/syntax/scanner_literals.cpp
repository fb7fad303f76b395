// Numbers, strings, durations, dates, direct addresses.

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/scanner.hpp"

#include <algorithm>

namespace stc {

namespace {

enum class Prefix : uint8_t { None, Duration, Date };

Prefix literalPrefix(std::string_view word) {
  static constexpr std::string_view kDurations[] = {"t", "time", "lt", "ltime"};
  static constexpr std::string_view kDates[] = {
      "d",    "date",         "ld", "ldate",         "tod", "time_of_day",
      "ltod", "ltime_of_day", "dt", "date_and_time", "ldt", "ldate_and_time",
  };
  const auto is = [&](std::string_view name) { return isWord(word, name); };
  if (std::any_of(std::begin(kDurations), std::end(kDurations), is))
    return Prefix::Duration;
  return std::any_of(std::begin(kDates), std::end(kDates), is) ? Prefix::Date : Prefix::None;
}

} // namespace

/// Digits with underscores, a base, a fraction, an exponent; lenient: literals.cpp checks the
/// digits.
void Scanner::numberBody() {
  const auto digits = [&] {
    while (isWordChar(at(place_)) || at(place_) == '#')
      ++place_;
  };
  const size_t begin = place_;
  while (isDigit(at(place_)) || (at(place_) == '_' && isDigit(at(place_ + 1))))
    ++place_;
  const auto exponent = [&] {
    if ((at(place_) == 'e' || at(place_) == 'E') &&
        (isDigit(at(place_ + 1)) ||
         ((at(place_ + 1) == '+' || at(place_ + 1) == '-') && isDigit(at(place_ + 2))))) {
      place_ += 2;
      while (isDigit(at(place_)))
        ++place_;
    }
  };
  if (at(place_) == '#') {
    digits();
    return;
  }
  if (at(place_) == '.' && isDigit(at(place_ + 1)) && previous_ != Tok::DOT) {
    ++place_;
    while (isDigit(at(place_)) || (at(place_) == '_' && isDigit(at(place_ + 1))))
      ++place_;
    exponent();
  } else if (previous_ != Tok::DOT) {
    exponent();
  }
  if (place_ > begin && isWordChar(at(place_)))
    digits(); // malformed
}

uint16_t Scanner::number(size_t begin, Token &token) {
  numberBody();
  const std::string_view spelling = text_.substr(begin, place_ - begin);
  if (spelling.find('#') != std::string_view::npos)
    return Tok::INTEGER;
  const bool real = spelling.find('.') != std::string_view::npos ||
                    (spelling.find_first_of("eE") != std::string_view::npos &&
                     spelling.find_first_not_of("0123456789_eE+-") == std::string_view::npos);
  if (!real && at(place_) == '.' && previous_ != Tok::DOT && at(place_ + 1) != '.' &&
      !isLetter(at(place_ + 1)) && at(place_ + 1) != '%') {
    token.reported = true;
    ++place_;
    diagnostics_
        .report(Code::InvalidNumber, span(begin, place_), "a decimal point needs a digit after it")
        .help("write `" + std::string(spelling.substr(0, 80)) + ".0`");
    return Tok::REAL;
  }
  return real ? Tok::REAL : Tok::INTEGER;
}

uint16_t Scanner::prefixedLiteral(size_t begin, Token &token) {
  const std::string_view prefix = text_.substr(begin, place_ - begin);
  ++place_; // #
  const char first = at(place_);
  const bool sign = first == '+' || first == '-';
  switch (literalPrefix(prefix)) {
  case Prefix::Duration:
    if (!isDigit(at(place_ + (sign ? 1 : 0))))
      break;
    ++place_;
    while (isWordChar(at(place_)) || (at(place_) == '.' && isDigit(at(place_ + 1))))
      ++place_;
    return Tok::TIME_LITERAL;
  case Prefix::Date:
    if (!isDigit(first))
      break;
    while (
        isWordChar(at(place_)) ||
        ((at(place_) == ':' || at(place_) == '.' || at(place_) == '-') && isDigit(at(place_ + 1))))
      ++place_;
    return Tok::TIME_LITERAL;
  case Prefix::None:
    break;
  }
  if (isDigit(first) || (sign && isDigit(at(place_ + 1)))) {
    place_ += sign ? 1 : 0;
    numberBody();
    return Tok::TYPED_LITERAL;
  }
  if (first == '\'' || first == '"') {
    quoted(place_, first, token);
    return Tok::TYPED_LITERAL;
  }
  const std::string_view name = wordAt(place_);
  place_ += name.size();
  if (isWord(name, "true") || isWord(name, "false"))
    return Tok::TYPED_LITERAL;
  if (!name.empty())
    return Tok::ENUM_LITERAL;
  token.reported = true;
  diagnostics_.report(Code::InvalidTypedLiteral, span(begin, place_),
                      "there is no value after `" + std::string(prefix.substr(0, 80)) + "#`",
                      "expected a literal or the name of an enumerator here");
  return Tok::TYPED_LITERAL;
}

/// Whether a string goes on over the end of its line: its other quote comes before anything that
/// looks like the end of a statement, which tells it from a string whose quote was forgotten.
static bool closesLater(std::string_view text, char quote) {
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == quote)
      return true;
    if (c == ';' || (c == ':' && i + 1 < text.size() && text[i + 1] == '='))
      return false;
    i += c == '$' ? 1 : 0;
  }
  return false;
}

uint16_t Scanner::quoted(size_t begin, char quote, Token &token) {
  const char *const data = text_.data();
  const size_t size = text_.size();
  const uint16_t type = quote == '\'' ? Tok::STRING_LITERAL : Tok::WSTRING_LITERAL;
  bool goesOn = false; // over the end of a line
  for (size_t place = begin + 1; place < size; ++place) {
    const char c = data[place];
    if (c == quote) {
      place_ = place + 1;
      return type;
    }
    if (c == '\n' || (c == '\r' && at(place + 1) == '\n')) {
      if (goesOn || (goesOn = closesLater(text_.substr(place), quote)))
        continue;
      place_ = place;
      break;
    }
    if (c == '$' && place + 1 < size && data[place + 1] != '\n' && data[place + 1] != '\r')
      ++place;
    place_ = place + 1;
  }
  if (place_ <= begin)
    place_ = begin + 1;
  place_ = std::min(place_, size);
  token.reported = true;
  diagnostics_
      .report(Code::UnterminatedString, span(begin, begin + 1), "this string has no end",
              "the string begins here")
      .note("what follows up to the next `;` or `:=` has no such quote")
      .help(quote == '\'' ? "close it with `'`; a quote inside is written `$'`"
                          : "close it with `\"`; a quote inside is written `$\"`");
  return type;
}

/// `%MW4` and the like, as the operand of an instruction (`ST %MW4`), but not `a %b` of C.
static bool isWholeAddress(std::string_view text) {
  const auto in = [&](size_t i, std::string_view set) {
    return i < text.size() && set.find(lowerCase(text[i])) != std::string_view::npos;
  };
  return in(1, "iqm") && in(in(2, "xbwdlf") ? 3 : 2, "0123456789");
}

/// After the numbers of an address. Those of a module's registers may have `MOD` or `ERR` in place
/// of a number, and a bit of a word as `%MW1.4.3.0:X3`.
size_t Scanner::afterNumbers(size_t place, bool ofWord) const {
  const auto isWord = [this](size_t from, std::string_view word) {
    return lowerCase(text_.substr(from, word.size())) == word && !isLetter(at(from + word.size()));
  };
  size_t points = 0;
  for (;;) {
    if (isDigit(at(place))) {
      ++place;
    } else if (at(place) == '.' && isDigit(at(place + 1))) {
      ++place;
      ++points;
    } else if (points > 0 && at(place) == '.' &&
               (isWord(place + 1, "mod") || isWord(place + 1, "err"))) {
      place += 4;
      ++points;
    } else {
      break;
    }
  }
  if (ofWord && points > 1 && at(place) == ':' && lowerCase(at(place + 1)) == 'x') {
    size_t end = place + 2;
    while (isDigit(at(end)))
      ++end;
    if (end > place + 2 && !isLetter(at(end))) // else a type that is named like it
      place = end;
  }
  return place;
}

uint16_t Scanner::address(size_t begin, Token &token) {
  const bool partial = previous_ == Tok::DOT;
  const bool isOperand = previous_ == Tok::IDENT && isWholeAddress(text_.substr(begin)) &&
                         begin > 0 && classOf(text_[begin - 1]) == kBlank;
  if (!isLetter(at(begin + 1)) || (!partial && !isOperand && afterOperand() && !atLineStart(begin)))
    return foreign(begin, 1, Tok::MOD, token);
  ++place_;
  const size_t letters = place_;
  while (isLetter(at(place_)))
    ++place_;
  const std::string_view area = text_.substr(letters, place_ - letters);
  const size_t numbers = place_;
  if (at(place_) == '*')
    ++place_;
  else
    place_ = afterNumbers(place_, area.size() == 2 && lowerCase(area[1]) == 'w');
  const auto in = [](char c, std::string_view set) {
    return set.find(lowerCase(c)) != std::string_view::npos;
  };
  // After a point it is a part of the variable, or (in VAR_ACCESS) an address of that resource.
  const bool good =
      place_ > numbers &&
      ((partial && area.size() == 1 && in(area[0], "xbwdl")) ||
       (area.size() <= 2 && in(area[0], "iqm") && (area.size() == 1 || in(area[1], "xbwdlf"))) ||
       (area.size() == 2 && in(area[0], "c") && in(area[1], "h"))); // a channel of a module
  if (!good) {
    token.reported = true;
    diagnostics_
        .report(Code::InvalidAddress, span(begin, place_), "malformed direct address",
                "not an address")
        .note("an address is written `%IX0.0`, `%QW2`, `%MD4` or `%I*`");
  }
  return Tok::DIRECT;
}

} // namespace stc
