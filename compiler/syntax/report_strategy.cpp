#include "compiler/syntax/unit_parser.hpp"

#include <algorithm>

namespace stc {

namespace {

constexpr std::size_t kMaxErrors = 100;

bool isEnd(std::uint16_t type) { return type == Token::kEnd; }

/// Closes or continues a block of statements.
bool isCloser(std::uint16_t type) {
  switch (type) {
  case Tok::LABEL:
  case Tok::ELSIF:
  case Tok::ELSE:
  case Tok::END_IF:
  case Tok::END_CASE:
  case Tok::END_FOR:
  case Tok::END_WHILE:
  case Tok::UNTIL:
  case Tok::END_REPEAT:
    return true;
  default:
    return false;
  }
}

bool startsBlock(std::uint16_t type) {
  switch (type) {
  case Tok::IF:
  case Tok::CASE:
  case Tok::FOR:
  case Tok::WHILE:
  case Tok::REPEAT:
    return true;
  default:
    return false;
  }
}

bool isStatementKeyword(std::uint16_t type) {
  return startsBlock(type) || type == Tok::EXIT || type == Tok::RETURN || type == Tok::CONTINUE;
}

bool startsOperand(std::uint16_t type) {
  switch (type) {
  case Tok::IDENT:
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
  case Tok::LPAREN:
  case Tok::LBRACKET:
  case Tok::NOT:
  case Tok::PLUS:
  case Tok::MINUS:
    return true;
  default:
    return false;
  }
}

bool startsStatement(std::uint16_t type) {
  return startsOperand(type) || isStatementKeyword(type) || type == Tok::SEMICOLON;
}

bool startsType(std::uint16_t type) {
  switch (type) {
  case Tok::IDENT:
  case Tok::ARRAY:
  case Tok::STRING:
  case Tok::WSTRING:
  case Tok::POINTER:
  case Tok::REFERENCE:
  case Tok::STRUCT:
    return true;
  default:
    return false;
  }
}

/// Keywords that can only be meant as names where an expression should stand.
bool canOnlyBeMeantAsName(std::uint16_t type) {
  switch (type) {
  case Tok::PROGRAM:
  case Tok::FUNCTION:
  case Tok::FUNCTION_BLOCK:
  case Tok::TYPE:
  case Tok::STRUCT:
  case Tok::ARRAY:
  case Tok::STRING:
  case Tok::WSTRING:
    return true;
  default:
    return false;
  }
}

/// Where a statement that could not be read certainly is over.
bool isStatementBoundary(std::uint16_t type) {
  return isEnd(type) || isCloser(type) || isStatementKeyword(type);
}

std::uint16_t closerOf(std::size_t rule) {
  switch (rule) {
  case Grammar::RuleIfStatement:
    return Tok::END_IF;
  case Grammar::RuleCaseStatement:
    return Tok::END_CASE;
  case Grammar::RuleForStatement:
    return Tok::END_FOR;
  case Grammar::RuleWhileStatement:
    return Tok::END_WHILE;
  case Grammar::RuleRepeatStatement:
    return Tok::END_REPEAT;
  default:
    return 0;
  }
}

/// An assignment whose right side was reached.
bool hasValue(const antlr4::ParserRuleContext *statement) {
  return !statement->children.empty() &&
         static_cast<const antlr4::RuleContext *>(statement->children.back())->getRuleIndex() ==
             Grammar::RuleExpression;
}

std::string ticked(std::string_view text) { return "`" + std::string(text) + "`"; }

} // namespace

ReportStrategy::ReportStrategy(UnitParser &parser, std::string_view text, FileId file,
                               Diagnostics &diagnostics)
    : parser_(parser), text_(text), file_(file), diagnostics_(diagnostics) {}

void ReportStrategy::reset(antlr4::Parser *) {
  recovering_ = false;
  lastError_ = -1;
  conjured_.clear();
}

// ---------------------------------------------------------------------------------------------
// looking around

const Token *ReportStrategy::before() {
  UnitStream &stream = parser_.stream();
  for (std::size_t i = stream.index(); i-- > 0;)
    if (stream.token(i).type != Tok::LABEL)
      return &stream.token(i);
  return nullptr;
}

Span ReportStrategy::insertion() {
  const Token *previous = before();
  const std::uint32_t at = previous == nullptr ? current().begin : previous->end;
  return {file_, at, at};
}

std::string ReportStrategy::describe(const Token &token) const {
  if (token.type == Tok::LABEL)
    return "a CASE label";
  if (token.begin == token.end)
    return isEnd(token.type) ? "the end of the file" : "nothing";
  std::string_view text = spelling(token);
  const bool cut = text.size() > 40;
  if (cut) {
    text = text.substr(0, 40);
    while ((static_cast<unsigned char>(text.back()) & 0xC0) == 0x80)
      text.remove_suffix(1);
  }
  return "`" + std::string(text) + (cut ? "…`" : "`");
}

bool ReportStrategy::onNewLine(const Token &token) {
  const Token *previous = before();
  return previous == nullptr || previous->end >= token.begin
             ? false
             : text_.substr(previous->end, token.begin - previous->end).find('\n') !=
                   std::string_view::npos;
}

bool ReportStrategy::mayReport() {
  const auto index = static_cast<std::int64_t>(current().index);
  if (recovering_ || index == lastError_ || current().reported)
    return false;
  lastError_ = index;
  // A string without an end swallows what is missing now.
  if (const Token *previous = before();
      previous != nullptr && previous->reported &&
      (previous->type == Tok::STRING_LITERAL || previous->type == Tok::WSTRING_LITERAL))
    return false;
  if (++reports_ > kMaxErrors)
    throw antlr4::ParseCancellationException();
  return true;
}

bool ReportStrategy::closerIsWanted(std::uint16_t type) const {
  for (const antlr4::tree::ParseTree *at = parser_.context(); at != nullptr; at = at->parent) {
    switch (static_cast<const antlr4::RuleContext *>(at)->getRuleIndex()) {
    case Grammar::RuleIfStatement:
      if (type == Tok::END_IF || type == Tok::ELSE || type == Tok::ELSIF)
        return true;
      break;
    case Grammar::RuleCaseStatement:
      if (type == Tok::END_CASE || type == Tok::ELSE || type == Tok::LABEL)
        return true;
      break;
    case Grammar::RuleForStatement:
      if (type == Tok::END_FOR)
        return true;
      break;
    case Grammar::RuleWhileStatement:
      if (type == Tok::END_WHILE)
        return true;
      break;
    case Grammar::RuleRepeatStatement:
      if (type == Tok::UNTIL || type == Tok::END_REPEAT)
        return true;
      break;
    default:
      break;
    }
  }
  return false;
}

const ReportStrategy::Context *ReportStrategy::innermostBlock() const {
  for (const antlr4::tree::ParseTree *at = parser_.context(); at != nullptr; at = at->parent) {
    const auto *context = static_cast<const Context *>(at);
    if (closerOf(context->getRuleIndex()) != 0)
      return context;
  }
  return nullptr;
}

/// A keyword that the user seems to take for a name.
bool ReportStrategy::keywordAsName(const Token &token) {
  if (!isKeywordType(token.type) || token.index + 1 >= parser_.stream().size())
    return false;
  switch (parser_.stream().token(token.index + 1).type) {
  case Tok::COLON:
  case Tok::COMMA:
  case Tok::ASSIGN:
  case Tok::DOT:
  case Tok::LBRACKET:
  case Tok::CARET:
    return true;
  default:
    return false;
  }
}

// -------------------------------------------------------------------------------------------------
// saying it

void ReportStrategy::reportKeywordAsName(const Token &token) {
  if (!mayReport())
    return;
  diagnostics_
      .report(Code::keywordAsName, span(token),
              ticked(spelling(token)) + " is a keyword, it cannot be a name",
              "keyword of the language")
      .help("choose another name, for example " + ticked(std::string(spelling(token)) + "_"));
}

void ReportStrategy::useAsName(Token &token) {
  token.type = Tok::IDENT;
  token.reported = true;
}

void ReportStrategy::reportUnexpected(const std::string &expected) {
  if (!mayReport())
    return;
  const Token &token = current();
  const Token *next = token.index + 1 < parser_.stream().size()
                          ? &parser_.stream().token(token.index + 1)
                          : nullptr;
  const Span where =
      token.type == Tok::LABEL || token.begin == token.end ? insertion() : span(token);
  Diagnostic &d = diagnostics_.report(Code::unexpectedToken, where,
                                      "expected " + expected + ", found " + describe(token),
                                      "expected " + expected);
  if (token.type == Tok::COLON && next != nullptr && next->type == Tok::EQUAL)
    d.help("the sign for an assignment is written without a space: `:=`");
  else if (token.type == Tok::ARROW)
    d.help("a comparison is written `>=`; `=>` stands in calls, in front of the variable that "
           "takes an output");
  else if (token.type == Tok::COLON)
    d.help("an assignment is written `:=`");
}

void ReportStrategy::reportMissing(std::uint16_t wanted) {
  if (!mayReport())
    return;
  const std::string sign = ticked(tokenSpelling(wanted));
  const Context *context = parser_.context();
  std::string after;
  switch (wanted) {
  case Tok::THEN:
    after = " after the condition";
    break;
  case Tok::DO:
    after = context->getRuleIndex() == Grammar::RuleForStatement ? " after the range"
                                                                 : " after the condition";
    break;
  case Tok::OF:
    after = context->getRuleIndex() == Grammar::RuleCaseStatement ? " after the selector"
                                                                  : " in front of the element type";
    break;
  case Tok::COLON:
    after = context->getRuleIndex() == Grammar::RuleCaseLabels ? " after the CASE label"
                                                               : " between name and type";
    break;
  case Tok::UNTIL:
    after = " in front of the condition";
    break;
  case Tok::SEMICOLON:
    switch (context->getRuleIndex()) {
    case Grammar::RuleSimpleStatement:
      after = hasValue(context)                                      ? " after the assignment"
              : before() != nullptr && before()->type == Tok::RPAREN ? " after the call"
                                                                     : " after the statement";
      break;
    case Grammar::RuleVarDeclaration:
    case Grammar::RuleTypeDeclaration:
      after = " after the declaration";
      break;
    default:
      after = " after the statement";
      break;
    }
    break;
  default:
    break;
  }
  Diagnostic &d = diagnostics_.report(Code::expectedToken, insertion(), "expected " + sign + after,
                                      "add " + sign + " here");
  if (wanted == Tok::RPAREN || wanted == Tok::RBRACKET) {
    // The opener is the token in front of the arguments.
    const std::uint16_t opener = wanted == Tok::RPAREN ? Tok::LPAREN : Tok::LBRACKET;
    int depth = 0;
    for (std::size_t i = current().index; i-- > 0;) {
      const Token &token = parser_.stream().token(i);
      depth += token.type == wanted;
      if (token.type == opener && depth-- == 0) {
        d.label(span(token), "to close this one");
        break;
      }
    }
  }
}

void ReportStrategy::reportMissingEnd(std::uint16_t wanted) {
  const Context *context = parser_.context();
  if (!mayReport())
    return;
  UnitStream &stream = parser_.stream();
  const auto &opener = static_cast<const Token &>(*context->start);
  const std::string sign = ticked(tokenSpelling(wanted));
  const Token *previous = before();
  if (wanted == Tok::END_IF && !context->children.empty()) {
    const auto *inner = static_cast<const Context *>(context->children.back());
    const auto &start = static_cast<const Token &>(*inner->start);
    if (inner->getRuleIndex() == Grammar::RuleStatements && start.type == Tok::IF &&
        start.index > 0) {
      const Token &word = stream.token(start.index - 1);
      if (word.type == Tok::ELSE &&
          text_.substr(word.end, start.begin - word.end).find('\n') == std::string_view::npos) {
        diagnostics_
            .report(Code::elseIf, {file_, word.begin, start.end},
                    "`ELSE IF` opens a second IF, whose END_IF is missing",
                    "a second IF begins here")
            .label(span(opener), "this IF has no END_IF")
            .help("write `ELSIF` for a further condition");
        return;
      }
    }
  }
  Diagnostic &d =
      diagnostics_.report(Code::missingEnd, span(opener), "missing " + sign,
                          "this " + std::string(tokenSpelling(opener.type)) + " is not closed");
  const Token &found = current();
  if (found.begin != found.end && found.type != Tok::LABEL)
    d.label(span(found), "expected " + sign + " before this");
  else if (previous != nullptr)
    d.label(insertion(), "expected " + sign + " here");
}

// ------------------------------------------------------------------------------------------------
// going on

antlr4::Token *ReportStrategy::conjure(std::uint16_t type) {
  Token &token = conjured_.emplace_back();
  token.type = type;
  token.begin = token.end = insertion().begin;
  token.index = current().index;
  return &token;
}

void ReportStrategy::skipTo(bool (*stop)(std::uint16_t)) {
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
      const std::uint16_t next = stream.token(current().index + 1).type;
      const Token *previous = before();
      if ((next == Tok::ASSIGN || next == Tok::LPAREN || next == Tok::DOT) && previous != nullptr &&
          (startsOperand(previous->type) || previous->type == Tok::RPAREN ||
           previous->type == Tok::RBRACKET) &&
          previous->type != Tok::LPAREN && previous->type != Tok::LBRACKET)
        return;
    }
  }
}

/// True when `wanted` comes later in the same statement head.
bool ReportStrategy::thenFollows(std::uint16_t wanted) {
  UnitStream &stream = parser_.stream();
  for (std::size_t i = current().index; i < stream.size(); ++i) {
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
  const std::uint16_t wanted = parser_.expected();
  parser_.clearExpected();
  const std::size_t rule = parser_.context()->getRuleIndex();
  const std::uint16_t found = current().type;
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
        rule == Grammar::RuleVarDeclaration || rule == Grammar::RuleTypeDeclaration;
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
      reportUnexpected(declaration ? "`;`"
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
            .report(Code::unexpectedToken, span(current()),
                    ticked(spelling(current())) + " behind the ELSE of the same IF",
                    "expected `END_IF`")
            .label(span(static_cast<const Token &>(*parser_.context()->start)), "of this IF");
      std::size_t depth = 0;
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
  case Tok::END_VAR:
  case Tok::END_TYPE:
    reportMissingEnd(wanted);
    return conjure(wanted);
  case Tok::RPAREN:
  case Tok::RBRACKET:
    if (isStatementBoundary(found) || found == Tok::SEMICOLON || found == Tok::THEN ||
        found == Tok::DO || found == Tok::OF || (onNewLine(current()) && startsOperand(found))) {
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
            .report(Code::equalForAssign, span(current()), "`=` compares, it does not assign",
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
    reportUnexpected("the name of a member behind the point");
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

void ReportStrategy::recover(antlr4::Parser *, std::exception_ptr error) {
  UnitStream &stream = parser_.stream();
  switch (parser_.context()->getRuleIndex()) {
  case Grammar::RuleStatement:
    skipStatement();
    return;
  case Grammar::RuleCondition:
  case Grammar::RuleForControl:
    skipTo([](std::uint16_t type) {
      return type == Tok::THEN || type == Tok::DO || type == Tok::OF || type == Tok::SEMICOLON ||
             isStatementBoundary(type);
    });
    return;
  case Grammar::RuleCaseLabels:
    skipTo([](std::uint16_t type) {
      return type == Tok::COLON || type == Tok::SEMICOLON || isStatementBoundary(type);
    });
    if (current().type == Tok::COLON)
      stream.advance();
    recovering_ = false;
    return;
  case Grammar::RuleVarDeclaration:
  case Grammar::RuleTypeDeclaration:
    skipTo([](std::uint16_t type) {
      return type == Tok::SEMICOLON || type == Tok::END_VAR || type == Tok::END_STRUCT ||
             type == Tok::END_TYPE || type == Tok::END_UNION;
    });
    if (parser_.context()->getRuleIndex() == Grammar::RuleTypeDeclaration &&
        current().type == Tok::END_STRUCT)
      stream.advance();
    while (current().type == Tok::SEMICOLON)
      stream.advance();
    recovering_ = false;
    return;
  case Grammar::RulePouHead:
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
    syncDeclarations([](std::uint16_t type) { return type == Tok::IDENT || type == Tok::END_VAR; },
                     "the name of a variable or `END_VAR`");
    break;
  case Grammar::RuleStructBody:
    syncDeclarations(
        [](std::uint16_t type) {
          return type == Tok::IDENT || type == Tok::SEMICOLON || type == Tok::END_STRUCT ||
                 type == Tok::END_UNION || type == Tok::END_TYPE;
        },
        "the name of a field or `END_STRUCT`");
    break;
  case Grammar::RuleTypeBlock:
    syncDeclarations(
        [](std::uint16_t type) {
          return type == Tok::IDENT || type == Tok::END_TYPE ||
                 (type >= Tok::ABSTRACT && type <= Tok::INTERNAL);
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

void ReportStrategy::syncDeclarations(bool (*good)(std::uint16_t), const std::string &expected) {
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
                       token.type != Tok::ELSIF && token.type != Tok::UNTIL;
      if (end && block != nullptr) {
        // Takes it for the one that is missing.
        const std::uint16_t wanted = closerOf(block->getRuleIndex());
        const auto &opener = static_cast<const Token &>(*block->start);
        if (mayReport())
          diagnostics_
              .report(Code::mismatchedEnd, span(token),
                      found + " does not close " + ticked(spelling(opener)),
                      "expected `" + std::string(tokenSpelling(wanted)) + "`")
              .label(span(opener), "this is open");
        token.type = wanted;
        return;
      }
      if (mayReport())
        diagnostics_.report(end ? Code::mismatchedEnd : Code::unexpectedToken, span(token),
                            end ? found + " closes nothing"
                                : found + " without a block that it belongs to");
      const std::uint16_t type = token.type;
      stream.advance();
      if (type == Tok::ELSIF || type == Tok::UNTIL) {
        skipTo([](std::uint16_t t) {
          return t == Tok::THEN || t == Tok::SEMICOLON || isStatementBoundary(t);
        });
        if (current().type == Tok::THEN)
          stream.advance();
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
    const std::uint16_t type = current().type;
    return isEnd(type) || type == Tok::LABEL || type == Tok::ELSE || type == Tok::END_CASE ||
           (isCloser(type) && closerIsWanted(type));
  };
  if (good())
    return;
  reportUnexpected("a CASE label");
  std::size_t depth = 0;
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
