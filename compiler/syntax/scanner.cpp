#include "compiler/syntax/scanner.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>
#include <cstring>

namespace stc {

namespace {

constexpr unsigned kMaxBadCharacters = 20;

/// Operators of the language whose names have two underscores.
bool isKnownDoubleUnderscore(std::string_view word) {
  static constexpr std::string_view kNames[] = {
      "__new",          "__delete",  "__isvalidref",  "__queryinterface",
      "__querypointer", "__try",     "__catch",       "__finally",
      "__endtry",       "__xword",   "__xint",        "__uxint",
      "__varinfo",      "__pouname", "__position",    "__compare_and_swap",
      "__xadd",         "__vector",  "__currenttask", "__lword",
      "__bitoffset",    "__system",
  };
  return std::any_of(std::begin(kNames), std::end(kNames),
                     [&](std::string_view name) { return isWord(word, name); });
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

bool Scanner::afterOperand() const {
  switch (previous_) {
  case Tok::IDENT:
  case Tok::RPAREN:
  case Tok::RBRACKET:
  case Tok::CARET:
  case Tok::INTEGER:
  case Tok::REAL:
  case Tok::TRUE:
  case Tok::FALSE:
  case Tok::STRING_LITERAL:
  case Tok::WSTRING_LITERAL:
  case Tok::TIME_LITERAL:
  case Tok::TYPED_LITERAL:
  case Tok::ENUM_LITERAL:
  case Tok::DIRECT:
    return true;
  default:
    return false;
  }
}

std::string_view Scanner::wordAt(size_t place) const {
  size_t end = place;
  if (place < text_.size() && isLetter(text_[place]))
    while (end < text_.size() && isWordChar(text_[end]))
      ++end;
  return text_.substr(std::min(place, text_.size()), end - place);
}

bool Scanner::nameFollows(size_t place) const {
  const std::string_view next = wordAt(significant(place));
  if (next.empty())
    return false;
  switch (findKeyword(next, hashIdent(next)).kind) {
  case Keyword::Kind::Hard:
  case Keyword::Kind::Operation:
  case Keyword::Kind::At:
  case Keyword::Kind::Infix:
  case Keyword::Kind::Clause:
    return false;
  default:
    return true;
  }
}

/// True when the word that ends here is a declared name: `:`, `,` or AT follows.
bool Scanner::declaresName(size_t wordEnd) const {
  const size_t next = significant(wordEnd);
  return at(next) == ':' || at(next) == ',' || isWord(wordAt(next), "at");
}

bool Scanner::isKeywordHere(Keyword keyword, size_t wordEnd) const {
  switch (keyword.kind) {
  case Keyword::Kind::None:
  case Keyword::Kind::Assignment:
  case Keyword::Kind::Local:
    return false;
  case Keyword::Kind::Hard:
    return true;
  case Keyword::Kind::Operation:
    return afterOperand() || at(significant(wordEnd)) != '(';
  case Keyword::Kind::Qualifier:
    return sectionHead_ && !declaresName(wordEnd);
  case Keyword::Kind::At:
    return at(significant(wordEnd)) == '%';
  case Keyword::Kind::Pointer:
    switch (previous_) {
    case Tok::COLON:
    case Tok::OF:
    case Tok::TO:
    case Tok::LPAREN: // SIZEOF(POINTER TO INT)
    case Tok::REF_TO:
      break;
    default:
      return false;
    }
    if (keyword.type == Tok::REF_TO) {
      const std::string_view next = wordAt(significant(wordEnd));
      return nameFollows(wordEnd) || isWord(next, "array") || isWord(next, "string") ||
             isWord(next, "wstring");
    }
    return isWord(wordAt(significant(wordEnd)), "to");
  case Keyword::Kind::Infix:
    return afterOperand();
  case Keyword::Kind::Statement: {
    const size_t next = significant(wordEnd);
    if (afterOperand() && previous_ != Tok::IDENT)
      return false;
    if (at(next) == ';')
      return previous_ == Tok::SEMICOLON || previous_ == Tok::THEN || previous_ == Tok::DO ||
             previous_ == Tok::ELSE || previous_ == Tok::COLON || previous_ == Tok::REPEAT ||
             previous_ == Tok::IDENT || (previous_ >= Tok::IF && previous_ <= Tok::END_VAR);
    const std::string_view word = wordAt(next);
    return word.size() > 4 && isWord(word.substr(0, 4), "end_");
  }
  case Keyword::Kind::Clause:
    return (previous_ == Tok::IDENT || previous_ == Tok::SEMICOLON || // behind USING
            (previous_ == Tok::STRUCT && keyword.type == Tok::EXTENDS)) &&
           nameFollows(wordEnd);
  case Keyword::Kind::Modifier:
    switch (previous_) {
    case Tok::PROGRAM:
    case Tok::FUNCTION:
    case Tok::FUNCTION_BLOCK:
    case Tok::TYPE:
    case Tok::METHOD:
    case Tok::PROPERTY:
    case Tok::INTERFACE:
    case Tok::CLASS:
    case Tok::NAMESPACE:
      return nameFollows(wordEnd);
    default:
      break;
    }
    if (previous_ >= Tok::ABSTRACT && previous_ <= Tok::OVERRIDE && nameFollows(wordEnd) &&
        !declaresName(wordEnd))
      return true;
    return sectionHead_ && !declaresName(wordEnd);
  case Keyword::Kind::Construct:
    if (keyword.type == Tok::UNION)
      return previous_ == Tok::COLON && nameFollows(wordEnd);
    switch (previous_) {
    case Tok::COLON: // a type, or a label
      return keyword.type == Tok::JMP && nameFollows(wordEnd);
    case Tok::COMMA:
    case Tok::DOT:
    case Tok::LPAREN:
    case Tok::LBRACKET:
    case Tok::PROGRAM:
    case Tok::FUNCTION:
    case Tok::FUNCTION_BLOCK:
    case Tok::TYPE:
    case Tok::METHOD:
    case Tok::PROPERTY:
    case Tok::ACTION:
    case Tok::INTERFACE:
    case Tok::CLASS:
    case Tok::NAMESPACE:
    case Tok::USING:
    case Tok::CONFIGURATION:
    case Tok::EXTENDS:
    case Tok::IMPLEMENTS:
    case Tok::JMP:
      return false;
    default:
      if (previous_ >= Tok::ABSTRACT && previous_ <= Tok::OVERRIDE)
        return false;
      return nameFollows(wordEnd);
    }
  }
  return false;
}

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

bool Scanner::firstOf(uint32_t hash) {
  if (std::find(badNames_.begin(), badNames_.end(), hash) != badNames_.end())
    return false;
  if (badNames_.size() < 1000)
    badNames_.push_back(hash);
  return true;
}

uint16_t Scanner::word(size_t begin, Token &token) {
  const char *const data = text_.data();
  const size_t size = text_.size();
  IdentHash running;
  size_t end = begin;
  bool foreignLetters = false;
  bool doubled = false;
  for (; end < size; ++end) {
    const char c = data[end];
    if (!isWordChar(c)) {
      if (!isForeign(c) || (c == '\xC2' && at(end + 1) == '\xA0'))
        break;
      foreignLetters = true;
    }
    doubled |= c == '_' && end > begin && data[end - 1] == '_';
    running.add(c);
  }
  place_ = end;
  const uint32_t hash = running.value();
  token.hash = hash;
  const std::string_view spelling = text_.substr(begin, end - begin);
  if (foreignLetters) {
    token.reported = true;
    if (firstOf(hash) && ++badCharacters_ <= kMaxBadCharacters) {
      size_t from = begin;
      while (!isForeign(data[from]))
        ++from;
      size_t to = from;
      while (to < end && isForeign(data[to]))
        ++to;
      diagnostics_
          .report(Code::InvalidCharacter, span(from, to), "a name may not contain this character",
                  "not a letter of a name")
          .note("names consist of the letters A to Z, digits and single underscores");
    }
    return Tok::IDENT;
  }
  if (end < size && data[end] == '#' && previous_ != Tok::DOT)
    return prefixedLiteral(begin, token);
  if (previous_ == Tok::DOT) // keywords cannot stand behind a dot
    return Tok::IDENT;
  const Keyword keyword = findKeyword(spelling, hash);
  if (keyword.kind == Keyword::Kind::Assignment) {
    const bool variable =
        afterOperand() && (previous_ != Tok::INTEGER || beforePrevious_ == Tok::DOT);
    if (variable && at(end) == '=' && at(end + 1) != '>') {
      ++place_;
      return keyword.type;
    }
  } else if (keyword.kind != Keyword::Kind::None && isKeywordHere(keyword, end)) {
    return keyword.type;
  } else if (lowerCase(data[begin]) == 'e') {
    if (const uint16_t meant = misspelledKeyword(begin, spelling, token); meant != 0)
      return meant;
  }
  if (spelling.size() > kMaxName) {
    token.reported = true;
    if (firstOf(hash))
      diagnostics_
          .report(Code::NameTooLong, span(begin, end),
                  "this name has " + std::to_string(spelling.size()) + " characters")
          .note("a name has at most " + std::to_string(kMaxName) + " characters");
  }
  const bool ours = conditions_ != nullptr && conditions_->generated();
  if (doubled && !ours && !isKnownDoubleUnderscore(spelling)) {
    token.reported = true;
    if (firstOf(hash))
      diagnostics_
          .report(Code::DoubleUnderscore, span(begin, end),
                  "the name `" + std::string(spelling.substr(0, 80)) +
                      "` has two underscores in a row")
          .note(
              "names have single underscores; two in a row are kept for operators such as `__NEW` "
              "and for generated "
              "names");
  }
  return Tok::IDENT;
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
  if (text_[begin] == '?')
    d.help("choose between two values with `SEL(condition, ifFalse, ifTrue)`");
  if (badCharacters_ == kMaxBadCharacters)
    d.note("further characters of this kind in the file are not reported");
}

uint16_t Scanner::sign(size_t begin, Token &token) {
  const char next = at(begin + 1);
  const auto one = [&](uint16_t type) {
    place_ = begin + 1;
    return type;
  };
  const auto two = [&](uint16_t type) {
    place_ = begin + 2;
    return type;
  };
  const char first = text_[begin];
  const bool calculates = first == '+' || first == '-';
  if ((next == '=' && (calculates || first == '*')) ||
      (next == first && (calculates || first == '<' || first == '>')) ||
      (first == '-' && next == '>') || (first == '=' && next == '<')) {
    if (const uint16_t meant = foreignPair(begin, token); meant != 0)
      return meant;
  }
  switch (text_[begin]) {
  case ';':
    return one(Tok::SEMICOLON);
  case ',':
    return one(Tok::COMMA);
  case '(':
    return one(Tok::LPAREN);
  case ')':
    return one(Tok::RPAREN);
  case '[':
    return one(Tok::LBRACKET);
  case ']':
    return one(Tok::RBRACKET);
  case '^':
    return one(Tok::CARET);
  case '.':
    return next == '.' ? two(Tok::DOTDOT) : one(Tok::DOT);
  case ':':
    return next == '=' ? two(Tok::ASSIGN) : one(Tok::COLON);
  case '+':
    return one(Tok::PLUS);
  case '-':
    return one(Tok::MINUS);
  case '*':
    return next == '*' ? two(Tok::POWER) : one(Tok::STAR);
  case '/':
    return one(Tok::SLASH);
  case '<':
    return next == '>' ? two(Tok::NOT_EQUAL) : next == '=' ? two(Tok::LESS_EQUAL) : one(Tok::LESS);
  case '>':
    return next == '=' ? two(Tok::GREATER_EQUAL) : one(Tok::GREATER);
  case '=':
    if (next == '=')
      return foreign(begin, 2, Tok::EQUAL, token);
    return next == '>' ? two(Tok::ARROW) : one(Tok::EQUAL);
  case '!':
    return next == '=' ? foreign(begin, 2, Tok::NOT_EQUAL, token)
                       : foreign(begin, 1, Tok::NOT, token);
  case '&':
    return next == '&' ? foreign(begin, 2, Tok::AND, token) : one(Tok::AMPERSAND);
  case '|':
    return foreign(begin, next == '|' ? 2 : 1, Tok::OR, token);
  case '%':
    return address(begin, token);
  case '\'':
  case '"':
    return quoted(begin, text_[begin], token);
  default:
    if (isForeignLetter(text_[begin], next)) // a name is meant
      return word(begin, token);
    badCharacters(begin);
    return 0;
  }
}

} // namespace stc
