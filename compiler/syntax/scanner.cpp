#include "compiler/syntax/scanner.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>
#include <cstring>

namespace stc {

namespace {

/// The sign that two characters are together; 0: none.
uint16_t pairOf(char first, char next) {
  switch (first) {
  case '.':
    return next == '.' ? Tok::DOTDOT : 0;
  case ':':
    return next == '=' ? Tok::ASSIGN : 0;
  case '*':
    return next == '*' ? Tok::POWER : 0;
  case '<':
    return next == '>' ? Tok::NOT_EQUAL : next == '=' ? Tok::LESS_EQUAL : 0;
  case '>':
    return next == '=' ? Tok::GREATER_EQUAL : 0;
  case '=':
    return next == '>' ? Tok::ARROW : 0;
  default:
    return 0;
  }
}

/// The sign that a character is alone; 0: none.
uint16_t signOf(char c) {
  switch (c) {
  case ';':
    return Tok::SEMICOLON;
  case ',':
    return Tok::COMMA;
  case '(':
    return Tok::LPAREN;
  case ')':
    return Tok::RPAREN;
  case '[':
    return Tok::LBRACKET;
  case ']':
    return Tok::RBRACKET;
  case '^':
    return Tok::CARET;
  case '.':
    return Tok::DOT;
  case ':':
    return Tok::COLON;
  case '+':
    return Tok::PLUS;
  case '-':
    return Tok::MINUS;
  case '*':
    return Tok::STAR;
  case '/':
    return Tok::SLASH;
  case '<':
    return Tok::LESS;
  case '>':
    return Tok::GREATER;
  case '=':
    return Tok::EQUAL;
  case '&':
    return Tok::AMPERSAND;
  default:
    return 0;
  }
}

} // namespace

bool looksBinary(std::string_view text) {
  if (std::memchr(text.data(), '\0', text.size()) != nullptr)
    return true;
  size_t control = 0;
  for (const char c : text.substr(0, 65536))
    control += static_cast<unsigned char>(c) < 0x20 && classOf(c) != kBlank;
  return control > 10;
}

Scanner::Scanner(const SourceFile &file, Diagnostics &diagnostics, Conditions *conditions)
    : text_(file.text()), file_(file.id()), diagnostics_(diagnostics), conditions_(conditions) {}

// -----------------------------------------------------------------------------------------------------
// tokens

Token Scanner::next() {
  Token token;
  token.type = 0; // stands for: nothing but bad characters
  bool afterBad = false;
  while (token.type == 0) {
    skipBlanks();
    token.reported |= afterBad;
    const size_t begin = place_;
    token.begin = static_cast<uint32_t>(begin);
    if (pending_ != 0) {
      token.type = pending_;
      pending_ = 0;
      break;
    }
    if (begin >= text_.size()) {
      reportOpenBranches();
      token.type = Token::kEnd;
      break;
    }
    switch (classOf(text_[begin])) {
    case kLetter:
      token.type = word(begin, token);
      break;
    case kDigit:
      token.type = number(begin, token);
      break;
    default:
      token.type = sign(begin, token);
      break;
    }
    afterBad = token.type == 0;
  }
  token.end = static_cast<uint32_t>(place_);
  if (const auto count = trivia_.size() - pendingTrivia_; count != 0) {
    const size_t kept = std::min<size_t>(count, 255); // the nearest
    token.triviaCount = static_cast<uint8_t>(kept);
    token.triviaBegin = static_cast<uint32_t>(trivia_.size() - kept);
    pendingTrivia_ = static_cast<uint32_t>(trivia_.size());
  }
  beforePrevious_ = previous_;
  previous_ = token.type;
  sectionHead_ = (token.type >= Tok::VAR && token.type <= Tok::VAR_INST) ||
                 (sectionHead_ && ((token.type >= Tok::CONSTANT && token.type <= Tok::NON_RETAIN) ||
                                   (token.type >= Tok::ABSTRACT && token.type <= Tok::OVERRIDE)));
  return token;
}

uint16_t Scanner::foreign(size_t begin, size_t length, uint16_t meant, Token &token) {
  place_ = begin + length;
  token.reported = true;
  const std::string found(text_.substr(begin, length));
  const std::string right(tokenSpelling(meant));
  diagnostics_
      .report(Code::ForeignOperator, span(begin, place_),
              "`" + found + "` is not an operator of Structured Text", "not known here")
      .suggest("write `" + right + "`", span(begin, place_), right);
  return meant;
}

void Scanner::badCharacters(size_t begin) {
  size_t end = begin;
  static constexpr std::string_view kKnown = "+-*/=<>&:;,.()[]^'\"{}%!|";
  while (end < text_.size() && classOf(text_[end]) == kOther &&
         kKnown.find(text_[end]) == std::string_view::npos &&
         !(text_[end] == '\xC2' && at(end + 1) == '\xA0'))
    ++end;
  place_ = std::max(end, begin + 1);
  if (++badCharacters_ > kMaxBadCharacters)
    return;
  Diagnostic &d = diagnostics_.report(Code::InvalidCharacter, span(begin, place_),
                                      place_ - begin > 1 && !isForeign(text_[begin])
                                          ? "these characters have no meaning here"
                                          : "this character has no meaning here");
  // `a ?= b`, and `ST? a` of an instruction list
  const bool stores = begin >= 2 && isWord(text_.substr(begin - 2, 2), "st") &&
                      (begin == 2 || !isWordChar(text_[begin - 3]));
  if (text_[begin] == '?' && (at(begin + 1) == '=' || stores))
    d.help("an assignment attempt is `__QUERYINTERFACE(value, target)` here, or `__QUERYPOINTER`");
  else if (text_[begin] == '?')
    d.help("choose between two values with `SEL(condition, ifFalse, ifTrue)`");
  if (badCharacters_ == kMaxBadCharacters)
    d.note("further characters of this kind in the file are not reported");
}

/// Signs of other languages; 0: it is none.
inline uint16_t Scanner::signOfOthers(size_t begin, Token &token) {
  const char first = text_[begin];
  const char next = at(begin + 1);
  const bool calculates = first == '+' || first == '-';
  if ((next == '=' && (calculates || first == '*')) ||
      (next == first && (calculates || first == '<' || first == '>')) ||
      (first == '-' && next == '>') || (first == '=' && next == '<')) {
    if (const uint16_t meant = foreignPair(begin, token); meant != 0)
      return meant;
  }
  switch (first) {
  case '=':
    return next == '=' ? foreign(begin, 2, Tok::EQUAL, token) : 0;
  case '!':
    return next == '=' ? foreign(begin, 2, Tok::NOT_EQUAL, token)
                       : foreign(begin, 1, Tok::NOT, token);
  case '&':
    return next == '&' ? foreign(begin, 2, Tok::AND, token) : 0;
  case '|':
    return foreign(begin, next == '|' ? 2 : 1, Tok::OR, token);
  default:
    return 0;
  }
}

uint16_t Scanner::sign(size_t begin, Token &token) {
  const char first = text_[begin];
  const char next = at(begin + 1);
  if (const uint16_t meant = signOfOthers(begin, token); meant != 0)
    return meant;
  if (const uint16_t pair = pairOf(first, next); pair != 0) {
    place_ = begin + 2;
    return pair;
  }
  if (const uint16_t single = signOf(first); single != 0) {
    place_ = begin + 1;
    return single;
  }
  switch (first) {
  case '%':
    return address(begin, token);
  case '\'':
  case '"':
    return quoted(begin, first, token);
  default:
    if (isForeignLetter(first, next)) // a name is meant
      return word(begin, token);
    badCharacters(begin);
    return 0;
  }
}

} // namespace stc
