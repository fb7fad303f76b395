// Textual sequential function charts: STEP, INITIAL_STEP and TRANSITION.
#include "compiler/syntax/chart.hpp"
#include "compiler/syntax/file_parser.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/source/st_scan.hpp"
#include "compiler/syntax/token_sets.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace stc {

FileParser::Content::Content() = default;
FileParser::Content::~Content() = default;

/// Takes the token, or says that it is missing.
bool FileParser::chartToken(uint16_t type) {
  if (now_.type == type) {
    advance();
    return true;
  }
  chartError("`" + std::string(tokenSpelling(type)) + "`");
  return false;
}

void FileParser::chartError(const std::string &expected) { chartError(expected, now_); }

void FileParser::chartError(const std::string &expected, const Token &found) {
  diagnostics_.report(Code::ExpectedToken, span(found),
                      "expected " + expected + " in a sequential function chart",
                      "found `" + std::string(scanner_.text(found).substr(0, 40)) + "`");
  chartFailed_ = true;
}

/// After an error: goes on after the END_… of the step or transition.
void FileParser::skipChartPart(uint16_t end) {
  while (now_.type != end && !endsUnit() && !startsDeclaration() && !isMember(now_.type) &&
         now_.type != Tok::STEP && now_.type != Tok::INITIAL_STEP && now_.type != Tok::TRANSITION)
    advance();
  if (now_.type == end)
    advance();
}

/// The expression after `sign` up to what ends it (not taken), parsed as the value of
/// `target := …;`; null: there is none.
ast::Expr *FileParser::chartExpression(const Token &target, Token sign, bool (*ends)(uint16_t)) {
  unit_.clear();
  unit_.push_back(target);
  sign.type = Tok::ASSIGN;
  unit_.push_back(sign);
  size_t depth = 0;
  while (!endsUnit() && !isChart(now_.type) && (depth != 0 || !ends(now_.type)) &&
         now_.type != Tok::SEMICOLON) {
    if (now_.type == Tok::LPAREN || now_.type == Tok::LBRACKET) {
      ++depth;
    } else if (now_.type == Tok::RPAREN || now_.type == Tok::RBRACKET) {
      if (depth == 0)
        break;
      --depth;
    }
    take();
  }
  Token end = unit_.back();
  end.triviaCount = 0;
  end.type = Tok::SEMICOLON;
  end.begin = end.end;
  unit_.push_back(end);
  const size_t errors = diagnostics_.errorCount();
  auto *unit = parseUnit(&Grammar::bodyUnit);
  std::vector<ast::Stmt *> out;
  if (unit != nullptr && !unit->children.empty())
    builder_.statements(static_cast<Grammar::StatementsContext *>(unit->children[0]), out);
  if (out.size() != 1 || out[0]->kind != ast::StmtKind::Assign) {
    if (diagnostics_.errorCount() == errors)
      chartError("an expression");
    chartFailed_ = true;
    return nullptr;
  }
  return ast::as<ast::AssignStmt>(out[0])->value;
}

/// `name`, or `(name, name)`.
bool FileParser::chartSteps(std::vector<ast::Name> &out, Token &last) {
  const bool list = now_.type == Tok::LPAREN;
  if (list)
    advance();
  for (;;) {
    if (now_.type != Tok::IDENT) {
      chartError("the name of a step");
      return false;
    }
    last = now_;
    out.push_back(builder_.name(now_));
    advance();
    if (!list)
      return true;
    if (now_.type != Tok::COMMA)
      return chartToken(Tok::RPAREN);
    advance();
  }
}

/// `, T#5s, done` after the qualifier of an action.
bool FileParser::chartTimes(ChartAction &action, const Token &target) {
  while (now_.type == Tok::COMMA) {
    const Token comma = now_;
    advance();
    const bool hasTime =
        action.qualifier == nullptr || !action.qualifier->timed || action.time != nullptr;
    if (action.qualifier != nullptr && hasTime && now_.type == Tok::IDENT &&
        (ahead_.type == Tok::COMMA || ahead_.type == Tok::RPAREN)) {
      action.indicators.push_back(builder_.name(now_));
      advance();
      continue;
    }
    if (action.time != nullptr) {
      chartError("the name of an indicator variable");
      return false;
    }
    action.time = chartExpression(
        target, comma, [](uint16_t type) { return type == Tok::RPAREN || type == Tok::COMMA; });
    if (action.time == nullptr)
      return false;
  }
  return true;
}

/// `L, T#5s, done` of an action.
bool FileParser::chartQualifier(ChartAction &action, const Token &target) {
  if (now_.type != Tok::IDENT) {
    chartError("a qualifier");
    return false;
  }
  const ast::Name written = builder_.name(now_);
  action.qualifier = findQualifier(written.text);
  advance();
  if (!chartTimes(action, target))
    return false;
  if (action.qualifier == nullptr) {
    diagnostics_
        .report(Code::SfcQualifier, written.span,
                "`" + std::string(written.text) + "` is not a qualifier of an action", "not known")
        .help("the qualifiers are N, R, S, L, D, P, SD, DS, SL, P0 and P1");
    chartFailed_ = true;
    return true;
  }
  const bool timed = action.qualifier->timed;
  if (timed == (action.time != nullptr))
    return true;
  const std::string name(written.text);
  diagnostics_
      .report(Code::SfcQualifier, timed ? written.span : action.time->span,
              "the qualifier " + name + (timed ? " needs a time" : " has no time"),
              timed ? "how long is missing" : "it acts without one")
      .help(timed ? "write `" + std::string(action.name.text) + "(" + name + ", T#1s)`"
                  : "remove the time, or write L, D, SD, DS or SL");
  chartFailed_ = true;
  return true;
}

/// `Work(L, T#5s);`
bool FileParser::chartAction(ChartStep &step) {
  if (now_.type != Tok::IDENT) {
    chartError("an action or END_STEP");
    return false;
  }
  ChartAction action;
  const Token target = now_;
  action.name = builder_.name(now_);
  action.qualifier = findQualifier("n");
  advance();
  if (now_.type == Tok::LPAREN) {
    advance();
    if ((now_.type != Tok::RPAREN && !chartQualifier(action, target)) || !chartToken(Tok::RPAREN))
      return false;
  }
  if (!chartToken(Tok::SEMICOLON))
    return false;
  if (action.qualifier != nullptr)
    step.actions.push_back(action);
  return true;
}

/// `(MIN_TIME := T#1s, MAX_TIME := longest)` after the name of a step.
bool FileParser::chartStepTimes(ChartStep &step) {
  do {
    advance();
    ast::Expr **time = isNow("min_time")   ? &step.minTime
                       : isNow("max_time") ? &step.maxTime
                                           : nullptr;
    if (time == nullptr || *time != nullptr) {
      chartError("MIN_TIME or MAX_TIME, each at most once,");
      return false;
    }
    const Token word = now_;
    advance();
    const Token sign = now_;
    if (!chartToken(Tok::ASSIGN))
      return false;
    *time = chartExpression(
        word, sign, [](uint16_t type) { return type == Tok::COMMA || type == Tok::RPAREN; });
    if (*time == nullptr)
      return false;
  } while (now_.type == Tok::COMMA);
  return chartToken(Tok::RPAREN);
}

void FileParser::chartStep(Chart &chart) {
  ChartStep step;
  step.initial = now_.type == Tok::INITIAL_STEP || isNow("initial_step");
  advance();
  if (now_.type != Tok::IDENT) {
    chartError("the name of a step");
    return skipChartPart(Tok::END_STEP);
  }
  step.name = builder_.name(now_);
  advance();
  bool good = now_.type != Tok::LPAREN || chartStepTimes(step);
  good = good && chartToken(Tok::COLON);
  while (good && now_.type != Tok::END_STEP)
    good = chartAction(step);
  skipChartPart(Tok::END_STEP);
  chart.steps.push_back(step);
}

/// `(PRIORITY := 2)`
bool FileParser::chartPriority(ChartTransition &out) {
  advance();
  if (!isNow("priority")) {
    chartError("PRIORITY");
    return false;
  }
  const Token word = now_;
  advance();
  const Token sign = now_;
  if (!chartToken(Tok::ASSIGN))
    return false;
  const Token first = now_;
  const ast::Expr *value =
      chartExpression(word, sign, [](uint16_t type) { return type == Tok::RPAREN; });
  if (value == nullptr || value->kind != ast::ExprKind::Literal ||
      static_cast<const ast::Literal *>(value)->literal != ast::LiteralKind::Integer) {
    if (value != nullptr)
      chartError("a whole number as the priority", first);
    return false;
  }
  out.priority = static_cast<const ast::Literal *>(value)->integer;
  return chartToken(Tok::RPAREN);
}

bool FileParser::chartTransition(ChartTransition &out) {
  out.span = span(now_);
  advance();
  if (now_.type == Tok::IDENT && !isNow("from"))
    advance(); // a name, which nothing refers to
  else if (isNow("from") && ahead_.type == Tok::IDENT && isWord(scanner_.text(ahead_), "from"))
    advance();
  if (now_.type == Tok::LPAREN && !chartPriority(out))
    return false;
  if (!isNow("from")) {
    chartError("FROM");
    return false;
  }
  advance();
  Token last;
  if (!chartSteps(out.from, last) || !chartToken(Tok::TO) || !chartSteps(out.to, last))
    return false;
  if (now_.type == Tok::COLON)
    return chartInstructions(out);
  const Token sign = now_;
  if (!chartToken(Tok::ASSIGN))
    return false;
  out.condition = chartExpression(last, sign, [](uint16_t) { return false; });
  return out.condition != nullptr && chartToken(Tok::SEMICOLON);
}

/// `: LD a AND b END_TRANSITION`, each instruction on a line of its own.
bool FileParser::chartInstructions(ChartTransition &out) {
  advance();
  while (!endsUnit() && !startsDeclaration() && !isMember(now_.type) && !isChart(now_.type)) {
    readInstruction(out.instructions);
    if (out.instructions.empty())
      continue;
    const Instruction &last = out.instructions.back();
    const Operation operation = last.op == nullptr ? Operation::Load : last.op->operation;
    if (last.kind != Instruction::Kind::Label && operation != Operation::Jump &&
        operation != Operation::Return)
      continue;
    diagnostics_
        .report(Code::SfcPlace, last.span, "a transition has no labels, jumps and returns",
                "not possible here")
        .help("calculate the condition with AND, OR, NOT and parentheses");
    chartFailed_ = true;
    out.instructions.pop_back();
  }
  if (!out.instructions.empty())
    return true;
  chartError("instructions");
  return false;
}

/// `TRANSITION (…) FROM`, which is no call.
bool FileParser::startsRanked() const {
  if (!isNow("transition") || ahead_.type != Tok::LPAREN)
    return false;
  const std::string_view text = scanner_.text();
  const size_t close = text.find(')', ahead_.end);
  if (close == std::string_view::npos)
    return false;
  const size_t word = afterBlanks(close + 1, false);
  return isWord(text.substr(std::min(word, text.size()), 4), "from");
}

/// `STEP Name:`, `STEP Name (` or `TRANSITION FROM` after `ACTION name:`, where the scanner takes
/// the word for a name: what follows a colon may be a type.
bool FileParser::startsAfterHead() const {
  if (ahead_.type != Tok::IDENT)
    return false;
  if (isNow("transition"))
    return isWord(scanner_.text(ahead_), "from");
  const std::string_view text = scanner_.text();
  const std::string_view sign = text.substr(std::min(afterBlanks(ahead_.end, false), text.size()));
  const bool heads = (sign.starts_with(':') && !sign.starts_with(":=")) || sign.starts_with('(');
  return (isNow("initial_step") || isNow("step")) && heads;
}

/// `begun`: the chart has a part already. The words of a chart are keywords only before a name.
bool FileParser::startsChart(bool begun) const {
  if (isChart(now_.type) || (begun && isNow("transition") && ahead_.type == Tok::LPAREN) ||
      startsRanked() || startsAfterHead())
    return true;
  const bool step = isNow("initial_step") || isNow("step");
  return (step || isNow("transition")) &&
         (isChart(ahead_.type) || (begun && step && ahead_.type == Tok::COLON));
}

void FileParser::chart(std::unique_ptr<Chart> &out) {
  if (now_.type == Tok::END_STEP || now_.type == Tok::END_TRANSITION) {
    diagnostics_.report(Code::MismatchedEnd, span(now_),
                        "`" + std::string(tokenSpelling(now_.type)) + "` closes nothing");
    advance();
    return;
  }
  sawChart_ = true;
  if (out == nullptr) {
    out = std::make_unique<Chart>();
    out->span = span(now_);
    chartFailed_ = false;
  }
  if (now_.type == Tok::STEP || now_.type == Tok::INITIAL_STEP || isNow("step") ||
      isNow("initial_step"))
    return chartStep(*out);
  ChartTransition transition;
  if (chartTransition(transition)) {
    out->transitions.push_back(transition);
    if (now_.type != Tok::END_TRANSITION)
      chartError("`END_TRANSITION`");
  }
  skipChartPart(Tok::END_TRANSITION);
}

namespace {

constexpr std::array<std::string_view, 5> kPouWords = {"PROGRAM", "FUNCTION_BLOCK", "FUNCTION",
                                                       "CLASS", "INTERFACE"};
constexpr std::array<std::string_view, 3> kMemberWords = {"ACTION", "METHOD", "PROPERTY"};
constexpr std::array<std::string_view, 7> kModifiers = {
    "PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "FINAL", "ABSTRACT", "OVERRIDE"};

} // namespace

/// Members may stand after their POU, with its name or as the next thing: they are read when the
/// chart is a part of it already.
void FileParser::findMemberNames() {
  const std::string_view text = scanner_.text();
  const std::vector<StWord> words = wordsOf(text);
  const auto at = [&](size_t i) {
    return i < words.size() ? text.substr(words[i].begin, words[i].end - words[i].begin)
                            : std::string_view();
  };
  const auto isAny = [&](size_t i, const auto &list) {
    return std::ranges::any_of(list,
                               [&](std::string_view one) { return equalIgnoringCase(one, at(i)); });
  };
  std::string owner;
  for (size_t i = 0; i < words.size(); ++i) {
    const bool pou = isAny(i, kPouWords);
    if (words[i].kind != StWord::Kind::Name || (!pou && !isAny(i, kMemberWords)))
      continue;
    size_t name = i + 1;
    while (isAny(name, kModifiers))
      ++name;
    if (pou)
      owner = lowerCase(at(name));
    else if (at(name + 1) == ".")
      memberNames_.emplace(lowerCase(at(name)), at(name + 2));
    else
      memberNames_.emplace(owner, at(name));
  }
  memberNames_.emplace("", ""); // it was looked for
}

/// Of the methods, actions and properties of the POU in this file.
std::vector<std::string_view> FileParser::membersOf(const ast::PouDecl *node) {
  if (memberNames_.empty())
    findMemberNames();
  std::vector<std::string_view> out;
  const auto [first, last] = memberNames_.equal_range(lowerCase(node->name.text));
  for (auto each = first; each != last; ++each)
    out.push_back(each->second);
  return out;
}

/// The chart becomes the body.
void FileParser::finishChart(const ast::PouDecl *node, Content &content) {
  const Chart &chart = *content.chart;
  const bool ofMember = node->kind == ast::DeclKind::Action || node->kind == ast::DeclKind::Method;
  const bool may = ofMember || node->kind == ast::DeclKind::Program ||
                   node->kind == ast::DeclKind::FunctionBlock;
  if (!may || !content.statements.empty()) {
    diagnostics_
        .report(Code::SfcPlace, may ? content.statements.front()->span : chart.span,
                may ? "statements stand beside a sequential function chart"
                    : "a sequential function chart needs a PROGRAM or FUNCTION_BLOCK, or one of "
                      "their members",
                may ? "this belongs to no step" : "its steps must be kept between the calls")
        .help(may ? "put them into an ACTION … END_ACTION that a step names"
                  : "write a FUNCTION_BLOCK and call an instance of it");
    return;
  }
  if (!chartFailed_ && checkChart(chart, content.variables, diagnostics_))
    lowerChart(chart,
               {builder_.interner(), arena_, diagnostics_, content.variables, membersOf(node),
                node->name.text, !node->base.empty(), ofMember},
               content.statements);
}

} // namespace stc
