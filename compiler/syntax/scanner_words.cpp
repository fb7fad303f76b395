// Words: which of them are keywords where they stand, and which are names.

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/scanner.hpp"

#include <algorithm>

namespace stc {

namespace {

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

/// Heads of declarations, after which the words that modify them stand.
bool startsHead(uint16_t type) {
  switch (type) {
  case Tok::PROGRAM:
  case Tok::FUNCTION:
  case Tok::FUNCTION_BLOCK:
  case Tok::TYPE:
  case Tok::METHOD:
  case Tok::PROPERTY:
  case Tok::INTERFACE:
  case Tok::CLASS:
  case Tok::NAMESPACE:
    return true;
  default:
    return false;
  }
}

bool isModifierType(uint16_t type) { return type >= Tok::ABSTRACT && type <= Tok::OVERRIDE; }

/// After these stands a name.
bool wantsName(uint16_t type) {
  switch (type) {
  case Tok::COMMA:
  case Tok::DOT:
  case Tok::LPAREN:
  case Tok::LBRACKET:
  case Tok::ACTION:
  case Tok::USING:
  case Tok::CONFIGURATION:
  case Tok::EXTENDS:
  case Tok::IMPLEMENTS:
  case Tok::JMP:
    return true;
  default:
    return startsHead(type) || isModifierType(type);
  }
}

} // namespace

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

/// POINTER, REFERENCE and REF_TO where a type may stand.
bool Scanner::pointerBegins(Keyword keyword, size_t wordEnd) const {
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
  const std::string_view next = wordAt(significant(wordEnd));
  if (keyword.type != Tok::REF_TO)
    return isWord(next, "to");
  return nameFollows(wordEnd) || isWord(next, "array") || isWord(next, "string") ||
         isWord(next, "wstring");
}

bool Scanner::statementBegins(size_t wordEnd) const {
  if (afterOperand() && previous_ != Tok::IDENT)
    return false;
  const size_t next = significant(wordEnd);
  if (at(next) == ';')
    return previous_ == Tok::SEMICOLON || previous_ == Tok::THEN || previous_ == Tok::DO ||
           previous_ == Tok::ELSE || previous_ == Tok::COLON || previous_ == Tok::REPEAT ||
           previous_ == Tok::IDENT || (previous_ >= Tok::IF && previous_ <= Tok::END_VAR);
  const std::string_view word = wordAt(next);
  return word.size() > 4 && isWord(word.substr(0, 4), "end_");
}

/// ABSTRACT, PUBLIC and the like, of a declaration or of a section's head.
bool Scanner::modifies(size_t wordEnd) const {
  if (startsHead(previous_))
    return nameFollows(wordEnd);
  if (declaresName(wordEnd))
    return false;
  return sectionHead_ || (isModifierType(previous_) && nameFollows(wordEnd));
}

bool Scanner::constructBegins(Keyword keyword, size_t wordEnd) const {
  if (keyword.type == Tok::UNION)
    return previous_ == Tok::COLON && nameFollows(wordEnd);
  if (previous_ == Tok::COLON) // a type, or a label
    return keyword.type == Tok::JMP && nameFollows(wordEnd);
  return !wantsName(previous_) && nameFollows(wordEnd);
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
    return pointerBegins(keyword, wordEnd);
  case Keyword::Kind::Infix:
    return afterOperand();
  case Keyword::Kind::Statement:
    return statementBegins(wordEnd);
  case Keyword::Kind::Clause:
    return (previous_ == Tok::IDENT || previous_ == Tok::SEMICOLON || // after USING
            previous_ == Tok::END_VAR || // after generic constants, which are reported
            (previous_ == Tok::STRUCT && keyword.type == Tok::EXTENDS)) &&
           nameFollows(wordEnd);
  case Keyword::Kind::Modifier:
    return modifies(wordEnd);
  case Keyword::Kind::Construct:
    return constructBegins(keyword, wordEnd);
  }
  return false;
}

bool Scanner::firstOf(uint32_t hash) {
  if (std::find(badNames_.begin(), badNames_.end(), hash) != badNames_.end())
    return false;
  if (badNames_.size() < 1000)
    badNames_.push_back(hash);
  return true;
}

inline Scanner::Word Scanner::wordFrom(size_t begin) const {
  const char *const data = text_.data();
  const size_t size = text_.size();
  Word word;
  IdentHash running;
  size_t end = begin;
  for (; end < size; ++end) {
    const char c = data[end];
    if (!isWordChar(c)) {
      if (!isForeign(c) || (c == '\xC2' && at(end + 1) == '\xA0'))
        break;
      word.foreignLetters = true;
    }
    word.doubled |= c == '_' && end > begin && data[end - 1] == '_';
    running.add(c);
  }
  word.text = text_.substr(begin, end - begin);
  word.hash = running.value();
  return word;
}

void Scanner::reportForeignLetters(size_t begin, const Word &word) {
  if (!firstOf(word.hash) || ++badCharacters_ > kMaxBadCharacters)
    return;
  size_t from = 0;
  while (!isForeign(word.text[from]))
    ++from;
  size_t to = from;
  while (to < word.text.size() && isForeign(word.text[to]))
    ++to;
  diagnostics_
      .report(Code::InvalidCharacter, span(begin + from, begin + to),
              "a name may not contain this character", "not a letter of a name")
      .note("names consist of the letters A to Z, digits and single underscores");
}

/// The keyword that a word is where it stands; 0: it is none.
inline uint16_t Scanner::keywordOf(size_t begin, const Word &word, Token &token) {
  if (previous_ == Tok::DOT) // keywords cannot stand after a dot
    return 0;
  const size_t end = begin + word.text.size();
  const Keyword keyword = findKeyword(word.text, word.hash);
  if (keyword.kind == Keyword::Kind::Assignment) {
    const bool variable =
        afterOperand() && (previous_ != Tok::INTEGER || beforePrevious_ == Tok::DOT);
    if (!variable || at(end) != '=' || at(end + 1) == '>')
      return 0;
    ++place_;
    return keyword.type;
  }
  if (keyword.kind != Keyword::Kind::None && isKeywordHere(keyword, end))
    return keyword.type;
  return lowerCase(word.text[0]) == 'e' ? misspelledKeyword(begin, word.text, token) : 0;
}

/// Reports names that are too long or kept for others.
inline void Scanner::checkName(size_t begin, const Word &word, Token &token) {
  const Span where = span(begin, begin + word.text.size());
  if (word.text.size() > kMaxName) {
    token.reported = true;
    if (firstOf(word.hash))
      diagnostics_
          .report(Code::NameTooLong, where,
                  "this name has " + std::to_string(word.text.size()) + " characters")
          .note("a name has at most " + std::to_string(kMaxName) + " characters");
  }
  const bool ours = conditions_ != nullptr && conditions_->generated();
  if (word.doubled && !ours && !isKnownDoubleUnderscore(word.text)) {
    token.reported = true;
    if (firstOf(word.hash))
      diagnostics_
          .report(Code::DoubleUnderscore, where,
                  "the name `" + std::string(word.text.substr(0, 80)) +
                      "` has two underscores in a row")
          .note(
              "names have single underscores; two in a row are kept for operators such as `__NEW` "
              "and for generated "
              "names");
  }
}

uint16_t Scanner::word(size_t begin, Token &token) {
  const Word word = wordFrom(begin);
  place_ = begin + word.text.size();
  token.hash = word.hash;
  if (word.foreignLetters) {
    token.reported = true;
    reportForeignLetters(begin, word);
    return Tok::IDENT;
  }
  if (at(place_) == '#' && previous_ != Tok::DOT)
    return prefixedLiteral(begin, token);
  if (const uint16_t keyword = keywordOf(begin, word, token); keyword != 0)
    return keyword;
  checkName(begin, word, token);
  return Tok::IDENT;
}

} // namespace stc
