#include "compiler/syntax/token_sets.hpp"

#include <algorithm>

namespace stc {

ReportStrategy::ReportStrategy(UnitParser &parser, std::string_view text, FileId file,
                               Diagnostics &diagnostics)
    : parser_(parser), text_(text), file_(file), diagnostics_(diagnostics) {}

void ReportStrategy::reset(antlr4::Parser *) {
  recovering_ = false;
  lastError_ = -1;
  conjured_.clear();
}

// ------------------------------------------------------------------------------------------------
// going on

antlr4::Token *ReportStrategy::conjure(uint16_t type) {
  Token &token = conjured_.emplace_back();
  token.type = type;
  token.begin = token.end = insertion().begin;
  token.index = current().index;
  return &token;
}

void ReportStrategy::skipTo(bool (*stop)(uint16_t)) {
  while (!isEnd(current().type) && !stop(current().type))
    parser_.stream().advance();
}

void ReportStrategy::skipStatement() {
  UnitStream &stream = parser_.stream();
  while (!isStatementBoundary(current().type)) {
    if (current().type == Tok::SEMICOLON) {
      stream.advance();
      recovering_ = false;
      return;
    }
    stream.advance();
    // A line that looks like a new assignment or call begins a new statement.
    if (current().type == Tok::IDENT && onNewLine(current())) {
      const uint16_t next = stream.token(current().index + 1).type;
      const Token *previous = before();
      if ((next == Tok::ASSIGN || next == Tok::LPAREN || next == Tok::DOT) && previous != nullptr &&
          (startsOperand(previous->type) || previous->type == Tok::RPAREN ||
           previous->type == Tok::RBRACKET) &&
          previous->type != Tok::LPAREN && previous->type != Tok::LBRACKET)
        return;
    }
  }
}

namespace {

bool endsDeclaration(uint16_t type) {
  return type == Tok::SEMICOLON || type == Tok::END_VAR || type == Tok::END_STRUCT ||
         type == Tok::END_TYPE || type == Tok::END_UNION || isEnd(type);
}

} // namespace

void ReportStrategy::reportError(antlr4::Parser *, const antlr4::RecognitionException &) {
  if (recovering_)
    return;
  const Token &token = current();
  switch (parser_.context()->getRuleIndex()) {
  case Grammar::RuleTypeSpec:
    reportUnexpected("a type");
    break;
  case Grammar::RuleOperand:
    if (canOnlyBeMeantAsName(token.type))
      reportKeywordAsName(token);
    else
      reportUnexpected("an expression");
    break;
  default:
    reportUnexpected("something else");
    break;
  }
  recovering_ = true;
}

/// A name at the start of a line, before `:`, `,` or AT: the declaration before it was not
/// finished.
bool ReportStrategy::startsDeclaration(const Token &token) {
  UnitStream &stream = parser_.stream();
  if (token.type != Tok::IDENT || !onNewLine(token) || token.index + 1 >= stream.size())
    return false;
  const uint16_t next = stream.token(token.index + 1).type;
  return next == Tok::COLON || next == Tok::COMMA || next == Tok::AT;
}

/// From a STRUCT that stands where a type is wanted over its END_STRUCT: its fields are no
/// variables.
void ReportStrategy::skipBodyOfType() {
  const auto opens = [](uint16_t type) { return type == Tok::STRUCT || type == Tok::UNION; };
  const auto closes = [](uint16_t type) {
    return type == Tok::END_STRUCT || type == Tok::END_UNION;
  };
  if (!opens(current().type))
    return;
  for (int depth = 0; !isEnd(current().type) && current().type != Tok::END_VAR &&
                      current().type != Tok::END_TYPE;) {
    depth += opens(current().type) ? 1 : 0;
    depth -= closes(current().type) ? 1 : 0;
    parser_.stream().advance();
    if (depth == 0)
      return;
  }
}

void ReportStrategy::recover(antlr4::Parser *, std::exception_ptr error) {
  UnitStream &stream = parser_.stream();
  switch (parser_.context()->getRuleIndex()) {
  case Grammar::RuleStatement:
    skipStatement();
    return;
  case Grammar::RuleCondition:
  case Grammar::RuleForControl:
    skipTo([](uint16_t type) {
      return type == Tok::THEN || type == Tok::DO || type == Tok::OF || type == Tok::SEMICOLON ||
             isStatementBoundary(type);
    });
    return;
  case Grammar::RuleCaseLabels:
    skipTo([](uint16_t type) {
      return type == Tok::COLON || type == Tok::SEMICOLON || isStatementBoundary(type);
    });
    if (current().type == Tok::COLON)
      stream.advance();
    recovering_ = false;
    return;
  case Grammar::RuleVarDeclaration:
  case Grammar::RuleConfigVariable:
  case Grammar::RuleAccessVariable:
  case Grammar::RuleTypeDeclaration:
    skipBodyOfType();
    while (!endsDeclaration(current().type) && !startsDeclaration(current()))
      stream.advance();
    if (parser_.context()->getRuleIndex() == Grammar::RuleTypeDeclaration &&
        current().type == Tok::END_STRUCT)
      stream.advance();
    while (current().type == Tok::SEMICOLON)
      stream.advance();
    recovering_ = false;
    return;
  case Grammar::RulePouHead:
  case Grammar::RuleNamespaceHead:
  case Grammar::RuleUsingDirective:
  case Grammar::RuleResourceHead:
  case Grammar::RuleTaskDeclaration:
  case Grammar::RuleProgramInstance:
    skipTo(isEnd);
    return;
  default:
    std::rethrow_exception(error);
  }
}

void ReportStrategy::sync(antlr4::Parser *) {
  switch (parser_.context()->getRuleIndex()) {
  case Grammar::RuleStatements:
    syncStatements();
    break;
  case Grammar::RuleVarSection:
    if (&current() == parser_.context()->start) // the keyword decides what follows
      break;
    syncDeclarations([](uint16_t type) { return type == Tok::IDENT || type == Tok::END_VAR; },
                     "the name of a variable or `END_VAR`");
    break;
  case Grammar::RuleStructBody:
    syncDeclarations(
        [](uint16_t type) {
          return type == Tok::IDENT || type == Tok::SEMICOLON || type == Tok::END_STRUCT ||
                 type == Tok::END_UNION || type == Tok::END_TYPE;
        },
        "the name of a field or `END_STRUCT`");
    break;
  case Grammar::RuleTypeBlock:
    syncDeclarations(
        [](uint16_t type) {
          return type == Tok::IDENT || type == Tok::END_TYPE || isModifier(type);
        },
        "the name of a type or `END_TYPE`");
    break;
  case Grammar::RuleCaseStatement:
    syncCase();
    break;
  case Grammar::RuleTypeSpec:
    syncEnumerator();
    break;
  default:
    break;
  }
}

/// A keyword as an enumerator, `(idle, return)`: as a name, so that the other enumerators are
/// known.
void ReportStrategy::syncEnumerator() {
  UnitStream &stream = parser_.stream();
  const Token &before = current();
  if ((before.type != Tok::LPAREN && before.type != Tok::COMMA) ||
      before.index + 2 >= stream.size())
    return;
  Token &token = stream.token(before.index + 1);
  const uint16_t after = stream.token(before.index + 2).type;
  const bool ends = after == Tok::COMMA || after == Tok::RPAREN || after == Tok::ASSIGN;
  if (!ends || !isKeywordType(token.type) || startsOperand(token.type))
    return;
  reportKeywordAsName(token);
  useAsName(token);
}

void ReportStrategy::syncDeclarations(bool (*good)(uint16_t), const std::string &expected) {
  UnitStream &stream = parser_.stream();
  while (!good(current().type) && !isEnd(current().type)) {
    if (keywordAsName(current())) {
      reportKeywordAsName(current());
      useAsName(current());
      return;
    }
    if (current().type == Tok::SEMICOLON) { // stray
      stream.advance();
      continue;
    }
    reportUnexpected(expected);
    recovering_ = true;
    // Up to the next declaration: after a `;`, or a name before a colon.
    do {
      stream.advance();
    } while (!isEnd(current().type) && current().type != Tok::SEMICOLON &&
             current().type != Tok::END_VAR && current().type != Tok::END_STRUCT &&
             current().type != Tok::END_TYPE &&
             !(current().type == Tok::IDENT && onNewLine(current())));
    recovering_ = false;
  }
}

namespace {

/// Closes no block, but begins another part of one.
bool continuesBlock(uint16_t type) {
  return type == Tok::LABEL || type == Tok::ELSE || type == Tok::ELSIF || type == Tok::UNTIL ||
         type == Tok::CATCH || type == Tok::FINALLY;
}

} // namespace

/// An END_… where another one is wanted is taken for that one.
void ReportStrategy::takeForCloserOf(const Context *block) {
  Token &token = current();
  const uint16_t wanted = closerOf(block->getRuleIndex());
  const auto &opener = static_cast<const Token &>(*block->start);
  if (mayReport())
    diagnostics_
        .report(Code::MismatchedEnd, span(token),
                ticked(spelling(token)) + " does not close " + ticked(spelling(opener)),
                "expected `" + std::string(tokenSpelling(wanted)) + "`")
        .label(span(opener), "this is open");
  token.type = wanted;
}

/// Leaves out what belongs to no block, with the head that it has (`ELSIF a THEN`).
void ReportStrategy::skipStrayCloser() {
  UnitStream &stream = parser_.stream();
  const uint16_t type = current().type;
  const std::string found = ticked(spelling(current()));
  if (mayReport()) {
    if (continuesBlock(type))
      diagnostics_.report(Code::UnexpectedToken, span(current()),
                          found + " without a block that it belongs to");
    else
      diagnostics_.report(Code::MismatchedEnd, span(current()), found + " closes nothing");
  }
  stream.advance();
  if (type == Tok::ELSIF || type == Tok::UNTIL) {
    skipTo(
        [](uint16_t t) { return t == Tok::THEN || t == Tok::SEMICOLON || isStatementBoundary(t); });
    if (current().type == Tok::THEN)
      stream.advance();
  }
  if (type == Tok::CATCH)
    while (!isEnd(current().type)) {
      stream.advance();
      if (stream.token(stream.index() - 1).type == Tok::RPAREN)
        break;
    }
  if (current().type == Tok::SEMICOLON)
    stream.advance();
}

void ReportStrategy::syncStatements() {
  for (;;) {
    Token &token = current();
    if (isEnd(token.type) || startsStatement(token.type))
      return;
    if (isCloser(token.type)) {
      if (closerIsWanted(token.type))
        return;
      const Context *block = innermostBlock();
      if (block != nullptr && !continuesBlock(token.type)) {
        takeForCloserOf(block);
        return;
      }
      skipStrayCloser();
    } else if (keywordAsName(token)) {
      reportKeywordAsName(token);
      useAsName(token);
      return;
    } else {
      reportUnexpected("a statement");
      recovering_ = true;
      parser_.stream().advance();
      skipStatement();
      recovering_ = false;
    }
  }
}

void ReportStrategy::syncCase() {
  UnitStream &stream = parser_.stream();
  const auto good = [&] {
    const uint16_t type = current().type;
    return isEnd(type) || type == Tok::LABEL || type == Tok::ELSE || type == Tok::END_CASE ||
           (isCloser(type) && closerIsWanted(type));
  };
  if (good())
    return;
  reportUnexpected("a CASE label");
  size_t depth = 0;
  while (depth != 0 || !good()) {
    if (isEnd(current().type))
      break;
    depth += startsBlock(current().type);
    switch (current().type) {
    case Tok::END_IF:
    case Tok::END_CASE:
    case Tok::END_FOR:
    case Tok::END_WHILE:
    case Tok::END_REPEAT:
      depth -= depth > 0;
      break;
    default:
      break;
    }
    stream.advance();
  }
}

} // namespace stc
