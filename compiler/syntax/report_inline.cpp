// What stands where another token is wanted: what is missing is made up, what is wrong is skipped.

#include "compiler/syntax/token_sets.hpp"

namespace stc {

/// `a[1 := 5;` has its mistake before the `:=`, which was taken for that of an argument.
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

antlr4::Token *ReportStrategy::take() {
  Token &token = current();
  parser_.stream().advance();
  recovering_ = false;
  return &token;
}

antlr4::Token *ReportStrategy::insert(uint16_t wanted) {
  reportMissing(wanted);
  return conjure(wanted);
}

antlr4::Token *ReportStrategy::insertEnd(uint16_t wanted) {
  reportMissingEnd(wanted);
  return conjure(wanted);
}

void ReportStrategy::giveUpAt(const std::string &expected) {
  reportUnexpected(expected);
  recovering_ = true;
  throw antlr4::InputMismatchException(&parser_);
}

antlr4::Token *ReportStrategy::insteadOfSemicolon() {
  const size_t rule = parser_.context()->getRuleIndex();
  const uint16_t found = current().type;
  const bool declaration =
      rule == Grammar::RuleVarDeclaration || rule == Grammar::RuleTypeDeclaration ||
      rule == Grammar::RuleConfigVariable || rule == Grammar::RuleAccessVariable;
  const bool over = isStatementBoundary(found) || onNewLine(current()) ||
                    (declaration &&
                     (found == Tok::END_VAR || found == Tok::END_STRUCT || found == Tok::END_TYPE));
  if (over && (startsStatement(found) || isStatementBoundary(found) || declaration))
    return insert(Tok::SEMICOLON);
  const bool noValue = rule == Grammar::RuleSimpleStatement && !hasValue(parser_.context());
  if (noValue)
    giveUpAt(found == Tok::COMMA ? "`:=`" : "`:=` or `;`");
  const bool onlyThis = declaration || rule == Grammar::RuleTaskDeclaration ||
                        rule == Grammar::RuleProgramInstance || rule == Grammar::RuleUsingDirective;
  giveUpAt(onlyThis ? "`;`" : "an operator or `;`");
}

/// For THEN, DO and OF, which end the heads of statements.
antlr4::Token *ReportStrategy::insteadOfHeadsEnd(uint16_t wanted) {
  if (thenFollows(wanted)) {
    reportUnexpected("an operator or " + ticked(tokenSpelling(wanted)));
    // What stands before is only a part of the condition.
    if (!parser_.context()->children.empty()) {
      static_cast<Context *>(parser_.context()->children.back())->exception =
          std::make_exception_ptr(antlr4::ParseCancellationException());
    }
    while (current().type != wanted)
      parser_.stream().advance();
    return take();
  }
  // The words of the three heads are often mixed up.
  const uint16_t found = current().type;
  if (found == Tok::THEN || found == Tok::DO || found == Tok::OF) {
    reportUnexpected(ticked(tokenSpelling(wanted)));
    return take();
  }
  return insert(wanted);
}

antlr4::Token *ReportStrategy::insteadOfEndIf() {
  const bool secondElse = (current().type == Tok::ELSE || current().type == Tok::ELSIF) &&
                          parser_.context()->getRuleIndex() == Grammar::RuleIfStatement;
  if (!secondElse)
    return insertEnd(Tok::END_IF);
  if (mayReport())
    diagnostics_
        .report(Code::UnexpectedToken, span(current()),
                ticked(spelling(current())) + " after the ELSE of the same IF", "expected `END_IF`")
        .label(span(static_cast<const Token &>(*parser_.context()->start)), "of this IF");
  size_t depth = 0;
  while (!isEnd(current().type) && (depth != 0 || current().type != Tok::END_IF)) {
    depth += current().type == Tok::IF;
    depth -= current().type == Tok::END_IF;
    parser_.stream().advance();
  }
  return isEnd(current().type) ? conjure(Tok::END_IF) : take();
}

antlr4::Token *ReportStrategy::insteadOfBracket(uint16_t wanted) {
  const uint16_t found = current().type;
  const bool endsHead = found == Tok::THEN || found == Tok::DO || found == Tok::OF ||
                        found == Tok::TO || found == Tok::BY;
  const bool closesOuter = // `a[(n + 1]`
      (found == Tok::RPAREN || found == Tok::RBRACKET) && openBracketOf(found) != nullptr;
  if (isStatementBoundary(found) || found == Tok::SEMICOLON || endsHead || closesOuter ||
      (onNewLine(current()) && startsOperand(found))) {
    if (wanted == Tok::RBRACKET)
      stepBackToAssignment();
    return insert(wanted);
  }
  giveUpAt("an operator, `,` or " + ticked(tokenSpelling(wanted)));
}

antlr4::Token *ReportStrategy::insteadOfColon() {
  const size_t rule = parser_.context()->getRuleIndex();
  const uint16_t found = current().type;
  if (rule == Grammar::RuleCaseLabels ? startsStatement(found) : startsType(found))
    return insert(Tok::COLON);
  giveUpAt(rule == Grammar::RuleVarDeclaration && found == Tok::ASSIGN ? "`:` and a type" : "`:`");
}

antlr4::Token *ReportStrategy::insteadOfName() {
  if (!isKeywordType(current().type) || isCloser(current().type))
    giveUpAt("a name");
  reportKeywordAsName(current());
  useAsName(current());
  return take();
}

/// `FOR i = 1 TO …`
antlr4::Token *ReportStrategy::takeEqualForAssign() {
  if (mayReport())
    diagnostics_
        .report(Code::EqualForAssign, span(current()), "`=` compares, it does not assign",
                "expected `:=`")
        .help("write `:=` to assign a value");
  return take();
}

antlr4::Token *ReportStrategy::recoverInline(antlr4::Parser *) {
  const uint16_t wanted = parser_.expected();
  parser_.clearExpected();
  const size_t rule = parser_.context()->getRuleIndex();
  const uint16_t found = current().type;
  switch (wanted) {
  case Tok::SEMICOLON:
    return insteadOfSemicolon();
  case Tok::THEN:
  case Tok::DO:
  case Tok::OF:
    if (wanted != Tok::OF || rule != Grammar::RuleTypeSpec)
      return insteadOfHeadsEnd(wanted);
    if (startsType(found))
      return insert(wanted);
    break;
  case Tok::UNTIL:
    return found == Tok::END_REPEAT ? insert(wanted) : insertEnd(wanted);
  case Tok::END_IF:
    return insteadOfEndIf();
  case Tok::END_CASE:
  case Tok::END_FOR:
  case Tok::END_WHILE:
  case Tok::END_REPEAT:
  case Tok::END_TRY:
  case Tok::END_VAR:
  case Tok::END_TYPE:
    return insertEnd(wanted);
  case Tok::RPAREN:
  case Tok::RBRACKET:
    return insteadOfBracket(wanted);
  case Tok::COLON:
    return insteadOfColon();
  case Tok::IDENT:
    return insteadOfName();
  case Tok::ASSIGN:
    if (found == Tok::EQUAL)
      return takeEqualForAssign();
    break;
  case Token::kEnd:
    reportUnexpected("nothing more here");
    skipTo(isEnd);
    return take();
  case 0: // one of several
    if (rule == Grammar::RuleStructBody)
      return insertEnd(Tok::END_STRUCT);
    giveUpAt("the name of a member after the point");
  default:
    break;
  }
  giveUpAt(ticked(tokenSpelling(wanted)));
}

} // namespace stc
