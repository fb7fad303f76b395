// What a token begins or ends, and how far heads reach.

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/format_layout.hpp"
#include "compiler/syntax/token_sets.hpp"
#include <algorithm>

namespace stc {

// -------------------------------------------------------------------------------------------------
// questions

bool FormatLayout::startsDeclaration(size_t i) const {
  return stc::startsDeclaration(type(i), type(i + 1));
}

bool FormatLayout::startsSection(size_t i) const {
  return stc::startsSection(type(i), type(i + 1));
}

bool FormatLayout::startsAccessor(size_t i) const {
  return (isWordAt(i, "get") || isWordAt(i, "set")) && !continuesName(type(i + 1));
}

/// No statement or declaration goes on here.
bool FormatLayout::stopsStatement(size_t i) const {
  const uint16_t t = type(i);
  return isStatementBoundary(t) || closesUnit(t) || startsSection(i) || startsDeclaration(i) ||
         isMember(t) || t == Tok::END_VAR || t == Tok::END_STRUCT || t == Tok::END_UNION ||
         t == Tok::END_TYPE;
}

/// After the `;` that ends what begins at `i`, or where something else begins.
size_t FormatLayout::statementEnd(size_t i) const {
  do {
    if (type(i) == Tok::SEMICOLON)
      return i + 1;
    ++i;
  } while (!stopsStatement(i));
  return i;
}

/// After the next token of type `last`, or where a statement ends.
size_t FormatLayout::through(size_t i, uint16_t last) const {
  do {
    if (type(i) == last)
      return i + 1;
    ++i;
  } while (!stopsStatement(i) && type(i) != Tok::SEMICOLON);
  return type(i) == last ? i + 1 : i;
}

/// Semicolons directly after a closing keyword stay on its line.
size_t FormatLayout::withSemicolons(size_t i) const {
  while (type(i) == Tok::SEMICOLON && items_[i].comments.empty())
    ++i;
  return i;
}

/// After the colon of the CASE labels that begin at `i`; 0 when there are none.
size_t FormatLayout::labelEnd(size_t i) const {
  const Kind now = blocks_.back().kind;
  if (now != Kind::Choice && now != Kind::Branch)
    return 0;
  unsigned depth = 0;
  for (size_t k = i; k == i || !stopsStatement(k); ++k) {
    switch (type(k)) {
    case Tok::LPAREN:
    case Tok::LBRACKET:
      ++depth;
      break;
    case Tok::RPAREN:
    case Tok::RBRACKET:
      depth -= depth > 0;
      break;
    case Tok::COLON:
      if (depth == 0)
        return k == i + 1 && type(i) == Tok::IDENT &&
                       jumpTargets_.contains(lowerCase(items_[i].text))
                   ? 0
                   : k + 1;
      break;
    case Tok::ASSIGN:
      if (depth == 0)
        return 0;
      break;
    case Tok::SEMICOLON:
    case Token::kEnd:
      return 0;
    default:
      break;
    }
  }
  return 0;
}

// -------------------------------------------------------------------------------------------------
// heads

size_t FormatLayout::headEnd(size_t i) const {
  const uint16_t keyword = type(i++);
  while (isModifier(type(i)))
    ++i;
  if (type(i) == Tok::IDENT)
    ++i;
  while (type(i) == Tok::DOT)
    i += type(i + 1) == Tok::IDENT ? 2 : 1;
  return headRest(i, keyword);
}

size_t FormatLayout::headRest(size_t i, uint16_t keyword) const {
  while (type(i) == Tok::EXTENDS || type(i) == Tok::IMPLEMENTS) {
    ++i;
    while (type(i) == Tok::IDENT || type(i) == Tok::DOT || type(i) == Tok::COMMA) {
      const bool name = type(i) == Tok::IDENT;
      ++i;
      if (name && type(i) == Tok::IDENT)
        break;
    }
  }
  if (type(i) == Tok::COLON && keyword == Tok::ACTION)
    return i + 1;
  if (type(i) == Tok::COLON && keyword != Tok::NAMESPACE && keyword != Tok::PROGRAM)
    i = headType(i + 1);
  return withSemicolons(i);
}

size_t FormatLayout::headType(size_t i) const {
  for (;;) {
    if (type(i) == Tok::ARRAY) {
      while (type(i) != Tok::OF && type(i) != Tok::SEMICOLON && !stopsStatement(i))
        ++i;
      if (type(i) != Tok::OF)
        return i;
      ++i;
    } else if (type(i) == Tok::POINTER || type(i) == Tok::REFERENCE) {
      i += type(i + 1) == Tok::TO ? 2 : 1;
    } else if (type(i) == Tok::REF_TO) {
      ++i;
    } else {
      break;
    }
  }
  if (type(i) == Tok::STRING || type(i) == Tok::WSTRING) {
    ++i;
    if (type(i) == Tok::LPAREN || type(i) == Tok::LBRACKET)
      i = through(i, type(i) == Tok::LPAREN ? Tok::RPAREN : Tok::RBRACKET);
  } else if (type(i) == Tok::IDENT) {
    ++i;
    while (type(i) == Tok::DOT)
      i += type(i + 1) == Tok::IDENT ? 2 : 1;
  }
  return i;
}

} // namespace stc
