// Textual sequential function charts: STEP, INITIAL_STEP and TRANSITION.
#include "compiler/syntax/chart.hpp"
#include "compiler/syntax/file_parser.hpp"

#include "compiler/syntax/token_sets.hpp"

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

void FileParser::chartError(const std::string &expected) {
  diagnostics_.report(Code::ExpectedToken, span(now_),
                      "expected " + expected + " in a sequential function chart",
                      "found `" + std::string(scanner_.text(now_).substr(0, 40)) + "`");
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

/// The expression up to `end` (not taken), parsed as the value of `target := …;`; null: there is
/// none.
ast::Expr *FileParser::chartExpression(const Token &target, bool (*ends)(uint16_t)) {
  unit_.clear();
  unit_.push_back(target);
  Token sign = target;
  sign.triviaCount = 0;
  sign.type = Tok::ASSIGN;
  sign.begin = target.end;
  unit_.push_back(sign);
  size_t depth = 0;
  while (!endsUnit() && !isChart(now_.type) && (depth != 0 || !ends(now_.type)) &&
         now_.type != Tok::SEMICOLON) {
    if (now_.type == Tok::LPAREN)
      ++depth;
    else if (now_.type == Tok::RPAREN)
      --depth;
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

/// `Work(L, T#5s);`
bool FileParser::chartAction(ChartStep &step) {
  if (now_.type != Tok::IDENT) {
    chartError("an action or END_STEP");
    return false;
  }
  ChartAction action;
  const Token target = now_;
  action.name = builder_.name(now_);
  advance();
  const ChartQualifier *qualifier = nullptr;
  if (now_.type == Tok::LPAREN) {
    advance();
    if (now_.type == Tok::IDENT) {
      action.qualifier = builder_.name(now_);
      qualifier = findQualifier(action.qualifier.text);
      if (qualifier == nullptr) {
        diagnostics_
            .report(Code::SfcQualifier, span(now_),
                    "`" + std::string(action.qualifier.text) + "` is not a qualifier of an action",
                    "not known")
            .help("the qualifiers are N, R, S, L, D, P, SD, DS, SL, P0 and P1");
        chartFailed_ = true;
      }
      advance();
    }
    if (now_.type == Tok::COMMA) {
      advance();
      action.time = chartExpression(
          target, [](uint16_t type) { return type == Tok::RPAREN || type == Tok::COMMA; });
    }
    if (!chartToken(Tok::RPAREN))
      return false;
  }
  if (!chartToken(Tok::SEMICOLON))
    return false;
  const bool timed = qualifier != nullptr && qualifier->timed;
  if (timed != (action.time != nullptr) && !chartFailed_) {
    const std::string name = qualifier == nullptr ? "N" : qualifier->name;
    diagnostics_
        .report(Code::SfcQualifier, action.qualifier ? action.qualifier.span : action.name.span,
                "the qualifier " + name + (timed ? " needs a time" : " has no time"),
                timed ? "add it here" : "this qualifier acts without one")
        .help(timed ? "write `" + std::string(action.name.text) + "(" + name + ", T#1s)`"
                    : "remove the time, or write L, D, SD, DS or SL");
    chartFailed_ = true;
  }
  step.actions.push_back(action);
  return true;
}

void FileParser::chartStep(Chart &chart) {
  ChartStep step;
  step.initial = now_.type == Tok::INITIAL_STEP;
  advance();
  if (now_.type != Tok::IDENT) {
    chartError("the name of a step");
    return skipChartPart(Tok::END_STEP);
  }
  step.name = builder_.name(now_);
  advance();
  bool good = chartToken(Tok::COLON);
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
  if (!chartToken(Tok::ASSIGN))
    return false;
  const ast::Expr *value =
      chartExpression(word, [](uint16_t type) { return type == Tok::RPAREN; });
  if (value == nullptr || value->kind != ast::ExprKind::Literal ||
      static_cast<const ast::Literal *>(value)->literal != ast::LiteralKind::Integer) {
    if (value != nullptr)
      chartError("a whole number as the priority");
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
  if (!chartToken(Tok::ASSIGN))
    return false;
  out.condition = chartExpression(last, [](uint16_t) { return false; });
  return out.condition != nullptr && chartToken(Tok::SEMICOLON);
}

bool FileParser::startsChart() const {
  return isChart(now_.type) || (isNow("transition") && ahead_.type == Tok::LPAREN);
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
  if (now_.type == Tok::STEP || now_.type == Tok::INITIAL_STEP)
    return chartStep(*out);
  ChartTransition transition;
  if (chartTransition(transition))
    out->transitions.push_back(transition);
  skipChartPart(Tok::END_TRANSITION);
}

/// The chart becomes the body.
void FileParser::finishChart(const ast::PouDecl *node, Content &content) {
  const Chart &chart = *content.chart;
  const bool may =
      node->kind == ast::DeclKind::Program || node->kind == ast::DeclKind::FunctionBlock;
  if (!may || !content.statements.empty()) {
    diagnostics_
        .report(Code::SfcPlace, may ? content.statements.front()->span : chart.span,
                may ? "statements stand beside a sequential function chart"
                    : "a sequential function chart needs a PROGRAM or FUNCTION_BLOCK",
                may ? "this belongs to no step" : "its steps must be kept between the calls")
        .help(may ? "put them into an ACTION … END_ACTION that a step names"
                  : "write a FUNCTION_BLOCK and call an instance of it");
    return;
  }
  if (!chartFailed_ && checkChart(chart, diagnostics_))
    lowerChart(chart, interner_, arena_, content.variables, content.statements);
}

} // namespace stc
