// The words of the error strategy.
#include "compiler/syntax/token_sets.hpp"

#include <algorithm>

namespace stc {

namespace {

constexpr size_t kMaxErrors = 100;

} // namespace

// ---------------------------------------------------------------------------------------------
// looking around

const Token *ReportStrategy::before() {
  UnitStream &stream = parser_.stream();
  for (size_t i = stream.index(); i-- > 0;)
    if (const uint16_t type = stream.token(i).type;
        type != Tok::LABEL && type != Tok::JUMP_LABEL && type != Tok::TYPE_ARGUMENT)
      return &stream.token(i);
  return nullptr;
}

Span ReportStrategy::insertion() {
  const Token *previous = before();
  const uint32_t at = previous == nullptr ? current().begin : previous->end;
  return {file_, at, at};
}

std::string ReportStrategy::describe(const Token &token) const {
  if (token.type == Tok::LABEL)
    return "a CASE label";
  if (token.type == Tok::JUMP_LABEL)
    return "a jump label";
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
  const auto index = static_cast<int64_t>(current().index);
  if (recovering_ || index == lastError_ || current().reported)
    return false;
  lastError_ = index;
  // A string without an end swallows what is missing now.
  if (const Token *previous = before();
      previous != nullptr && previous->reported &&
      (previous->type == Tok::STRING_LITERAL || previous->type == Tok::WSTRING_LITERAL ||
       previous->type == Tok::ASSIGN)) // of `x++`
    return false;
  if (++reports_ > kMaxErrors)
    throw antlr4::ParseCancellationException();
  return true;
}

bool ReportStrategy::closerIsWanted(uint16_t type) const {
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
    case Grammar::RuleTryStatement:
      if (type == Tok::CATCH || type == Tok::FINALLY || type == Tok::END_TRY)
        return true;
      break;
    default:
      break;
    }
  }
  return false;
}

/// Between the parentheses of a call, of an expression, or the brackets of an index.
bool ReportStrategy::insideBrackets() const {
  for (const antlr4::tree::ParseTree *at = parser_.context(); at != nullptr; at = at->parent)
    if (const size_t rule = static_cast<const Context *>(at)->getRuleIndex();
        rule == Grammar::RuleOperand || rule == Grammar::RuleArguments)
      return true;
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
  if (!mayReport() || !keywordsAsNames_.insert(token.type).second)
    return; // the declaration has said it
  diagnostics_
      .report(Code::KeywordAsName, span(token),
              ticked(spelling(token)) + " is a keyword, it cannot be a name",
              "keyword of the language")
      .help("choose another name, for example " + ticked(std::string(spelling(token)) + "_"));
}

void ReportStrategy::useAsName(Token &token) {
  token.type = Tok::IDENT;
  token.reported = true;
}

void ReportStrategy::reportUnexpected(const std::string &expected) {
  if (!mayReport() || keywordsAsNames_.contains(current().type))
    return;
  const Token &token = current();
  const Token *next = token.index + 1 < parser_.stream().size()
                          ? &parser_.stream().token(token.index + 1)
                          : nullptr;
  const Span where = token.begin == token.end ? insertion() : span(token);
  Diagnostic &d = diagnostics_.report(Code::UnexpectedToken, where,
                                      "expected " + expected + ", found " + describe(token),
                                      "expected " + expected);
  if (token.type == Tok::COLON && next != nullptr && next->type == Tok::EQUAL)
    d.help("the sign for an assignment is written without a space: `:=`");
  else if (expected == "`TO`" && token.type == Tok::SEMICOLON)
    d.help("a loop is written `FOR i := 1 TO 10 BY 1 DO … END_FOR`");
  else if (token.type == Tok::ARROW)
    d.help("a comparison is written `>=`; `=>` stands in calls, before the variable that "
           "takes an output");
  else if (token.type == Tok::STRUCT || token.type == Tok::UNION)
    d.help("a variable is declared with the name of a type: write `TYPE Name : " +
           std::string(tokenSpelling(token.type)) + " … END_" +
           std::string(tokenSpelling(token.type)) + " END_TYPE`, then `: Name;` here");
  else if (token.type == Tok::REF_ASSIGN && insideBrackets())
    d.help("write `:=`: it binds an input that is a REFERENCE to the variable that is given");
  else if (std::string help = foreignHelp(token, before(), next); !help.empty())
    d.help(std::move(help));
}

/// " after the condition": where the wanted token should have stood.
std::string_view ReportStrategy::placeOfMissing(uint16_t wanted) {
  const Context *context = parser_.context();
  const size_t rule = context->getRuleIndex();
  switch (wanted) {
  case Tok::THEN:
    return " after the condition";
  case Tok::DO:
    return rule == Grammar::RuleForStatement ? " after the range" : " after the condition";
  case Tok::OF:
    return rule == Grammar::RuleCaseStatement ? " after the selector" : " before the element type";
  case Tok::COLON:
    return rule == Grammar::RuleCaseLabels ? " after the CASE label" : " between name and type";
  case Tok::UNTIL:
    return " before the condition";
  case Tok::SEMICOLON:
    break;
  default:
    return {};
  }
  switch (rule) {
  case Grammar::RuleSimpleStatement:
    return hasValue(context)                                      ? " after the assignment"
           : before() != nullptr && before()->type == Tok::RPAREN ? " after the call"
                                                                  : " after the statement";
  case Grammar::RuleVarDeclaration:
  case Grammar::RuleConfigVariable:
  case Grammar::RuleAccessVariable:
  case Grammar::RuleTypeDeclaration:
    return " after the declaration";
  default:
    return " after the statement";
  }
}

/// The bracket before the current token that `closer` would close; null: none.
const Token *ReportStrategy::openBracketOf(uint16_t closer) {
  const uint16_t opener = closer == Tok::RPAREN ? Tok::LPAREN : Tok::LBRACKET;
  int depth = 0;
  for (size_t i = current().index; i-- > 0;) {
    const Token &token = parser_.stream().token(i);
    depth += token.type == closer;
    if (token.type == opener && depth-- == 0)
      return &token;
  }
  return nullptr;
}

void ReportStrategy::reportMissing(uint16_t wanted) {
  if (!mayReport())
    return;
  const std::string sign = ticked(tokenSpelling(wanted));
  Diagnostic &d = diagnostics_.report(Code::ExpectedToken, insertion(),
                                      "expected " + sign + std::string(placeOfMissing(wanted)),
                                      "add " + sign + " here");
  d.suggestions.push_back({"add " + sign,
                           {Edit{insertion(), (isKeywordType(wanted) ? " " : "") +
                                                  std::string(tokenSpelling(wanted))}}});
  if (wanted == Tok::COLON && current().type == Tok::IDENT && before() != nullptr)
    if (std::string help = helpForTypeFirst(*before(), current()); !help.empty())
      d.help(std::move(help));
  if (wanted == Tok::RPAREN || wanted == Tok::RBRACKET)
    if (const Token *opener = openBracketOf(wanted); opener != nullptr)
      d.label(span(*opener), "to close this one");
}

void ReportStrategy::reportMissingEnd(uint16_t wanted) {
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
            .report(Code::ElseIf, {file_, word.begin, start.end},
                    "`ELSE IF` opens a second IF, whose END_IF is missing",
                    "a second IF begins here")
            .label(span(opener), "this IF has no END_IF")
            .help("write `ELSIF` for a further condition");
        return;
      }
    }
  }
  Diagnostic &d =
      diagnostics_.report(Code::MissingEnd, span(opener), "missing " + sign,
                          "this " + std::string(tokenSpelling(opener.type)) + " is not closed");
  const Token &found = current();
  if (found.begin != found.end && found.type != Tok::LABEL)
    d.label(span(found), "expected " + sign + " before this");
  else if (previous != nullptr)
    d.label(insertion(), "expected " + sign + " here");
}

} // namespace stc
