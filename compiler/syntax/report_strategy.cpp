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

/// `a[1 := 5;` has its mistake in front of the `:=`, which was taken for that of an argument.
void ReportStrategy::stepBackToAssignment() {
  UnitStream &stream = parser_.stream();
  unsigned depth = 0;
  for (size_t i = current().index; i-- > 0;) {
    const uint16_t type = stream.token(i).type;
    if (type == Tok::RPAREN || type == Tok::RBRACKET)
      ++depth;
    else if (type == Tok::LPAREN || type == Tok::LBRACKET) {
      if (depth == 0)
        return;
      --depth;
    } else if (type == Tok::ASSIGN && depth == 0) {
      if (mayReport())
        diagnostics_.report(Code::ExpectedToken,
                            {file_, stream.token(i - 1).end, stream.token(i - 1).end},
                            "expected `]`", "add `]` here");
      return;
    }
  }
}

/// True when `wanted` comes later in the same statement head.
bool ReportStrategy::thenFollows(uint16_t wanted) {
  UnitStream &stream = parser_.stream();
  for (size_t i = current().index; i < stream.size(); ++i) {
    const Token &token = stream.token(i);
    if (token.type == wanted)
      return true;
    if (isStatementBoundary(token.type) || token.type == Tok::SEMICOLON ||
        token.type == Tok::ASSIGN)
      return false;
  }
  return false;
}

antlr4::Token *ReportStrategy::recoverInline(antlr4::Parser *) {
  UnitStream &stream = parser_.stream();
  const uint16_t wanted = parser_.expected();
  parser_.clearExpected();
  const size_t rule = parser_.context()->getRuleIndex();
  const uint16_t found = current().type;
  const auto fail = [&]() -> antlr4::Token * {
    recovering_ = true;
    throw antlr4::InputMismatchException(&parser_);
  };
  const auto takeIt = [&] {
    Token &token = current();
    stream.advance();
    recovering_ = false;
    return static_cast<antlr4::Token *>(&token);
  };
  switch (wanted) {
  case Tok::SEMICOLON: {
    const bool declaration =
        rule == Grammar::RuleVarDeclaration || rule == Grammar::RuleTypeDeclaration ||
        rule == Grammar::RuleConfigVariable || rule == Grammar::RuleAccessVariable;
    const bool over = isStatementBoundary(found) || onNewLine(current()) ||
                      (declaration && (found == Tok::END_VAR || found == Tok::END_STRUCT ||
                                       found == Tok::END_TYPE));
    if (over && (startsStatement(found) || isStatementBoundary(found) || declaration)) {
      reportMissing(wanted);
      return conjure(wanted);
    }
    if (found == Tok::COMMA && rule == Grammar::RuleSimpleStatement && !hasValue(parser_.context()))
      reportUnexpected("`:=`");
    else
      reportUnexpected(declaration || rule == Grammar::RuleTaskDeclaration ||
                               rule == Grammar::RuleProgramInstance ||
                               rule == Grammar::RuleUsingDirective
                           ? "`;`"
                       : rule == Grammar::RuleSimpleStatement && !hasValue(parser_.context())
                           ? "`:=` or `;`"
                           : "an operator or `;`");
    return fail();
  }
  case Tok::THEN:
  case Tok::DO:
  case Tok::OF:
    if (wanted == Tok::OF && rule == Grammar::RuleTypeSpec) {
      if (startsType(found)) {
        reportMissing(wanted);
        return conjure(wanted);
      }
      break;
    }
    if (thenFollows(wanted)) {
      reportUnexpected("an operator or " + ticked(tokenSpelling(wanted)));
      // What stands in front is only a part of the condition.
      if (!parser_.context()->children.empty()) {
        static_cast<Context *>(parser_.context()->children.back())->exception =
            std::make_exception_ptr(antlr4::ParseCancellationException());
      }
      while (current().type != wanted)
        stream.advance();
      return takeIt();
    }
    // The words of the three heads are often mixed up.
    if (found == Tok::THEN || found == Tok::DO || found == Tok::OF) {
      reportUnexpected(ticked(tokenSpelling(wanted)));
      return takeIt();
    }
    reportMissing(wanted);
    return conjure(wanted);
  case Tok::UNTIL:
    if (found == Tok::END_REPEAT) {
      reportMissing(wanted);
      return conjure(wanted);
    }
    reportMissingEnd(wanted);
    return conjure(wanted);
  case Tok::END_IF:
    if ((found == Tok::ELSE || found == Tok::ELSIF) && rule == Grammar::RuleIfStatement) {
      if (mayReport())
        diagnostics_
            .report(Code::UnexpectedToken, span(current()),
                    ticked(spelling(current())) + " after the ELSE of the same IF",
                    "expected `END_IF`")
            .label(span(static_cast<const Token &>(*parser_.context()->start)), "of this IF");
      size_t depth = 0;
      while (!isEnd(current().type) && (depth != 0 || current().type != Tok::END_IF)) {
        depth += current().type == Tok::IF;
        depth -= current().type == Tok::END_IF;
        stream.advance();
      }
      return isEnd(current().type) ? conjure(wanted) : takeIt();
    }
    reportMissingEnd(wanted);
    return conjure(wanted);
  case Tok::END_CASE:
  case Tok::END_FOR:
  case Tok::END_WHILE:
  case Tok::END_REPEAT:
  case Tok::END_TRY:
  case Tok::END_VAR:
  case Tok::END_TYPE:
    reportMissingEnd(wanted);
    return conjure(wanted);
  case Tok::RPAREN:
  case Tok::RBRACKET:
    if (isStatementBoundary(found) || found == Tok::SEMICOLON || found == Tok::THEN ||
        found == Tok::DO || found == Tok::OF || (onNewLine(current()) && startsOperand(found))) {
      if (wanted == Tok::RBRACKET)
        stepBackToAssignment();
      reportMissing(wanted);
      return conjure(wanted);
    }
    reportUnexpected("an operator, `,` or " + ticked(tokenSpelling(wanted)));
    return fail();
  case Tok::COLON:
    if (rule == Grammar::RuleCaseLabels ? startsStatement(found) : startsType(found)) {
      reportMissing(wanted);
      return conjure(wanted);
    }
    reportUnexpected(rule == Grammar::RuleVarDeclaration && found == Tok::ASSIGN ? "`:` and a type"
                                                                                 : "`:`");
    return fail();
  case Tok::IDENT:
    if (isKeywordType(found) && !isCloser(found)) {
      reportKeywordAsName(current());
      useAsName(current());
      return takeIt();
    }
    reportUnexpected("a name");
    return fail();
  case Tok::ASSIGN:
    if (found == Tok::EQUAL) { // FOR i = 1 TO …
      if (mayReport())
        diagnostics_
            .report(Code::EqualForAssign, span(current()), "`=` compares, it does not assign",
                    "expected `:=`")
            .help("write `:=` to assign a value");
      return takeIt();
    }
    break;
  case Token::kEnd:
    reportUnexpected("nothing more here");
    skipTo(isEnd);
    return takeIt();
  case 0:
    if (rule == Grammar::RuleStructBody) {
      reportMissingEnd(Tok::END_STRUCT);
      return conjure(Tok::END_STRUCT);
    }
    reportUnexpected("the name of a member after the point");
    return fail();
  default:
    break;
  }
  reportUnexpected(ticked(tokenSpelling(wanted)));
  return fail();
}

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

/// A name at the start of a line, in front of `:`, `,` or AT: the declaration before it was not
/// finished.
bool ReportStrategy::startsDeclaration(const Token &token) {
  UnitStream &stream = parser_.stream();
  if (token.type != Tok::IDENT || !onNewLine(token) || token.index + 1 >= stream.size())
    return false;
  const uint16_t next = stream.token(token.index + 1).type;
  return next == Tok::COLON || next == Tok::COMMA || next == Tok::AT;
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
  default:
    break;
  }
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
    // Up to the next declaration: behind a `;`, or a name in front of a colon.
    do {
      stream.advance();
    } while (!isEnd(current().type) && current().type != Tok::SEMICOLON &&
             current().type != Tok::END_VAR && current().type != Tok::END_STRUCT &&
             current().type != Tok::END_TYPE &&
             !(current().type == Tok::IDENT && onNewLine(current())));
    recovering_ = false;
  }
}

void ReportStrategy::syncStatements() {
  UnitStream &stream = parser_.stream();
  for (;;) {
    Token &token = current();
    if (isEnd(token.type) || startsStatement(token.type))
      return;
    if (isCloser(token.type)) {
      if (closerIsWanted(token.type))
        return;
      const std::string found = ticked(spelling(token));
      const Context *block = innermostBlock();
      const bool end = token.type != Tok::LABEL && token.type != Tok::ELSE &&
                       token.type != Tok::ELSIF && token.type != Tok::UNTIL &&
                       token.type != Tok::CATCH && token.type != Tok::FINALLY;
      if (end && block != nullptr) {
        // Takes it for the one that is missing.
        const uint16_t wanted = closerOf(block->getRuleIndex());
        const auto &opener = static_cast<const Token &>(*block->start);
        if (mayReport())
          diagnostics_
              .report(Code::MismatchedEnd, span(token),
                      found + " does not close " + ticked(spelling(opener)),
                      "expected `" + std::string(tokenSpelling(wanted)) + "`")
              .label(span(opener), "this is open");
        token.type = wanted;
        return;
      }
      if (mayReport())
        diagnostics_.report(end ? Code::MismatchedEnd : Code::UnexpectedToken, span(token),
                            end ? found + " closes nothing"
                                : found + " without a block that it belongs to");
      const uint16_t type = token.type;
      stream.advance();
      if (type == Tok::ELSIF || type == Tok::UNTIL) {
        skipTo([](uint16_t t) {
          return t == Tok::THEN || t == Tok::SEMICOLON || isStatementBoundary(t);
        });
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
      continue;
    }
    if (keywordAsName(token)) {
      reportKeywordAsName(token);
      useAsName(token);
      return;
    }
    reportUnexpected("a statement");
    recovering_ = true;
    stream.advance();
    skipStatement();
    recovering_ = false;
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
