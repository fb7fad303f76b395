#include "runtime/numeric/nc/token.hpp"

#include "runtime/iec/text.h"
#include "runtime/numeric/cnc/exponent.hpp"

namespace stride::nc {
namespace {

constexpr int32_t kMostDigits = 40;

bool isNamePart(char c) noexcept { return isLetter(c) || isDigit(c) || c == '_'; }

Token bad(Token token, Error error) noexcept {
  token.kind = TokenKind::Bad;
  token.error = error;
  return token;
}

/// Whether what follows the number is an exponent instead of a word E.
bool hasExponent(const ProgramLine &line, int32_t begin, int32_t end) noexcept {
  const char *const text = line.text;
  const char letter = text[end];
  if ((letter != 'e' && letter != 'E') || (text[end + 1] != '-' && text[end + 1] != '+'))
    return false;
  int32_t digits = 0;
  while (isDigit(text[end + 2 + digits]))
    ++digits;
  int32_t word = begin - 1;
  while (word >= 0 && (text[word] == '-' || text[word] == '+' || text[word] == ' '))
    --word;
  const bool isAfterCapital = word >= 0 && text[word] >= 'A' && text[word] <= 'Z';
  return text[end + 2 + digits] != '.' &&
         cnc::isExponent(cnc::exponentBehind(end - begin, letter == 'e' && isAfterCapital), digits,
                         text[end + 2]);
}

Token numberAt(const ProgramLine &line, Token token) noexcept {
  // Written as `5.` or `.5` a number is none in ST.
  char text[kMostDigits + 4];
  int32_t length = 0;
  int32_t i = token.at;
  bool point = false;
  bool digits = false;
  for (; isDigit(line.text[i]) || (line.text[i] == '.' && !point); ++i) {
    if (length >= kMostDigits)
      return bad(token, Error::BadNumber);
    if (line.text[i] == '.') {
      point = true;
      if (length == 0)
        text[length++] = '0';
    } else {
      digits = true;
    }
    text[length++] = line.text[i];
  }
  if (text[length - 1] == '.')
    text[length++] = '0';
  if (!digits || line.text[i] == '.' || hasExponent(line, token.at, i))
    return bad(token, Error::BadNumber);
  const text::Scanned scanned = text::scanReal(text, static_cast<uint32_t>(length));
  if (scanned.used != static_cast<uint32_t>(length))
    return bad(token, Error::BadNumber);
  token.kind = TokenKind::Number;
  token.number = scanned.real;
  token.end = i;
  return token;
}

/// `$name$` and `'text'`.
Token quotedAt(const ProgramLine &line, Token token, char quote) noexcept {
  int32_t i = token.at + 1;
  while (i < line.length && line.text[i] != quote)
    ++i;
  token.start = token.at + 1;
  token.length = i - token.start;
  token.end = i + 1;
  if (i == line.length)
    return bad(token, Error::UnexpectedEnd);
  const bool isText = quote == '\'';
  if (token.length > (isText ? kMostText : kMostName))
    return bad(token, isText ? Error::TextTooLong : Error::NameTooLong);
  if (!isText && token.length == 0)
    return bad(token, Error::NoVariable);
  token.kind = isText ? TokenKind::Text : TokenKind::Variable;
  return token;
}

Token nameAt(const ProgramLine &line, Token token, int32_t start, TokenKind kind) noexcept {
  int32_t i = start;
  while (isNamePart(line.text[i]))
    ++i;
  token.start = start;
  token.length = i - start;
  token.end = i;
  if (token.length == 0)
    return bad(token, Error::UnknownToken);
  if (token.length > kMostName)
    return bad(token, Error::NameTooLong);
  token.kind = kind;
  return token;
}

Token symbolAt(const ProgramLine &line, Token token) noexcept {
  const char c = line.text[token.at];
  const char next = line.text[token.at + 1];
  const bool two = (c == '<' && (next == '>' || next == '=')) || (c == '>' && next == '=') ||
                   (c == ':' && next == '=');
  token.kind = TokenKind::Symbol;
  token.symbol = two ? symbol(c, next) : symbol(c);
  token.end = token.at + (two ? 2 : 1);
  return token;
}

} // namespace

int32_t skipBlanks(const ProgramLine &line, int32_t index) noexcept {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == 0x0B || c == 0x0C; };
  while (index < line.length && blank(line.text[index]))
    ++index;
  return index;
}

Token tokenAt(const ProgramLine &line, int32_t index) noexcept {
  Token token{};
  token.at = token.start = token.end = skipBlanks(line, index);
  if (token.at >= line.length)
    return token;
  const char c = line.text[token.at];
  token.end = token.at + 1;
  if (isDigit(c) || c == '.')
    return numberAt(line, token);
  if (isLetter(c) || c == '_')
    return nameAt(line, token, token.at, TokenKind::Name);
  switch (c) {
  case '$':
  case '\'':
    return quotedAt(line, token, c);
  case '#':
    return nameAt(line, token, token.at + 1, TokenKind::Local);
  case '{':
  case '(':
    token.kind = TokenKind::Open;
    return token;
  case '}':
  case ')':
    token.kind = TokenKind::Close;
    return token;
  case '+':
  case '-':
  case '*':
  case '/':
  case '=':
  case '<':
  case '>':
  case ',':
  case ':':
  case '!':
  case '?':
    return symbolAt(line, token);
  default:
    return bad(token, Error::UnknownToken);
  }
}

bool isWordText(const ProgramLine &line, const Token &token, const char *word) noexcept {
  int32_t i = 0;
  for (; i < token.length && word[i] != 0; ++i)
    if (upperCase(line.text[token.start + i]) != word[i])
      return false;
  return token.kind == TokenKind::Name && i == token.length && word[i] == 0;
}

} // namespace stride::nc
