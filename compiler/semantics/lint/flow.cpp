// Which statements can run, which loops end.

#include "compiler/semantics/lint/internal.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace stc::lint {

using namespace ast;

static bool statement(Context &c, Stmt *stmt);
static bool ifStatement(Context &c, IfStmt *stmt);
static bool whileLoop(Context &c, WhileStmt *stmt);
static bool repeatLoop(Context &c, RepeatStmt *stmt);
static void forLoop(Context &c, ForStmt *stmt);
static bool caseStatement(Context &c, CaseStmt *stmt);

bool isLiteral(const Expr *expr) {
  switch (expr->kind) {
  case ExprKind::Literal:
  case ExprKind::EnumLiteral:
    return true;
  case ExprKind::Name: {
    const Symbol *symbol = as<NameExpr>(expr)->symbol;
    return symbol != nullptr && symbol->kind == SymbolKind::Enumerator;
  }
  case ExprKind::Member: {
    const Symbol *symbol = as<MemberExpr>(expr)->symbol;
    return symbol != nullptr && symbol->kind == SymbolKind::Enumerator;
  }
  case ExprKind::Unary:
    return isLiteral(as<UnaryExpr>(expr)->operand);
  case ExprKind::Binary:
    return isLiteral(as<BinaryExpr>(expr)->right) && isLiteral(as<BinaryExpr>(expr)->left);
  default:
    return false;
  }
}

namespace {

enum class Truth : uint8_t { Unknown, Always, Never };

/// What a condition made of literals only is. A constant's name may be a switch that is meant to be
/// turned.
Truth truthOf(const Expr *condition) {
  if (condition->constant == nullptr || !isLiteral(condition))
    return Truth::Unknown;
  return condition->constant->integer != 0 ? Truth::Always : Truth::Never;
}

std::string_view wordOf(const Stmt *stmt) {
  switch (stmt->kind) {
  case StmtKind::Return:
    return "RETURN leaves the POU here";
  case StmtKind::Exit:
    return "EXIT leaves the loop here";
  case StmtKind::Continue:
    return "CONTINUE begins the next round here";
  case StmtKind::Jump:
    return "JMP goes elsewhere here";
  case StmtKind::If:
  case StmtKind::Case:
    return "all branches of this leave";
  default:
    return "nothing comes after this";
  }
}

bool isEmpty(Block block) {
  return std::all_of(block.begin(), block.end(),
                     [](const Stmt *s) { return s->kind == StmtKind::Empty; });
}

/// `IF` of an IF statement.
Span wordSpan(const Stmt *stmt, uint32_t length) {
  return {stmt->span.file, stmt->span.begin, std::min(stmt->span.begin + length, stmt->span.end)};
}

} // namespace

bool block(Context &c, Block statements) {
  bool reachable = true;
  bool reported = false;
  const Stmt *leaves = nullptr;
  for (Stmt *stmt : statements) {
    if (stmt->kind == StmtKind::Label)
      reachable = true;
    else if (!reachable && !reported && stmt->kind != StmtKind::Empty) {
      reported = true;
      report(c, Code::UnreachableCode, stmt->span, "this statement is never reached", "never runs")
          .label(leaves->span, std::string(wordOf(leaves)));
    }
    const bool goesOn = statement(c, stmt);
    if (reachable && !goesOn) {
      reachable = false;
      leaves = stmt;
    }
  }
  return reachable;
}

static void leave(Context &c) {
  c.mayHaveLeft = true;
  for (Loop *loop : c.loops)
    loop->exits = true;
}

static bool statement(Context &c, Stmt *stmt) {
  switch (stmt->kind) {
  case StmtKind::Empty:
  case StmtKind::Label:
    return true;
  case StmtKind::Assign:
    assignment(c, as<AssignStmt>(stmt));
    return true;
  case StmtKind::Call: {
    Expr *expr = as<CallStmt>(stmt)->expr;
    c.statementCall = expr;
    read(c, expr);
    c.statementCall = nullptr;
    if (expr->kind == ExprKind::Call) {
      const auto *call = as<CallExpr>(expr);
      c.found->ignored.push_back(call);
      if (call->resolved == Callee::Function && call->pou != nullptr)
        ++c.functionCalls[call->pou->decl].asStatement;
    }
    return true;
  }
  case StmtKind::If:
    return ifStatement(c, as<IfStmt>(stmt));
  case StmtKind::Case:
    return caseStatement(c, as<CaseStmt>(stmt));
  case StmtKind::For:
    forLoop(c, as<ForStmt>(stmt));
    return true;
  case StmtKind::While:
    return whileLoop(c, as<WhileStmt>(stmt));
  case StmtKind::RepeatS:
    return repeatLoop(c, as<RepeatStmt>(stmt));
  case StmtKind::Exit:
    if (!c.loops.empty())
      c.loops.back()->exits = true;
    return false;
  case StmtKind::Continue:
    if (!c.loops.empty())
      c.loops.back()->continues = true;
    return false;
  case StmtKind::Return:
  case StmtKind::Jump:
    leave(c);
    return false;
  case StmtKind::Try: {
    auto *s = as<TryStmt>(stmt);
    ++c.conditional;
    bool goesOn = block(c, s->body);
    if (s->exception != nullptr)
      write(c, s->exception);
    goesOn = block(c, s->catchBody) || goesOn || !s->hasCatch;
    --c.conditional;
    return block(c, s->finallyBody) && goesOn;
  }
  }
  return true;
}

static bool ifStatement(Context &c, IfStmt *stmt) {
  bool goesOn = !stmt->hasElse;
  bool empty = isEmpty(stmt->elseBody);
  bool first = true;
  for (IfBranch &branch : stmt->branches) {
    read(c, branch.condition);
    empty = empty && isEmpty(branch.body);
    switch (truthOf(branch.condition)) {
    case Truth::Never:
      report(c, Code::ConstantCondition, branch.condition->span, "this condition is always FALSE",
             "its branch never runs");
      break;
    case Truth::Always:
      report(c, Code::ConstantCondition, branch.condition->span, "this condition is always TRUE",
             stmt->hasElse || &branch != &stmt->branches.back() ? "the branches after it never run"
                                                                : "its branch always runs");
      break;
    case Truth::Unknown:
      break;
    }
    if (first) // the first condition itself always runs
      ++c.conditional;
    first = false;
    goesOn = block(c, branch.body) || goesOn;
  }
  goesOn = block(c, stmt->elseBody) || goesOn;
  --c.conditional;
  if (empty)
    report(c, Code::EmptyBody, wordSpan(stmt, 2), "this IF does nothing",
           "all of its branches are empty")
        .help("write the statements between THEN and END_IF; a `;` after THEN is an empty "
              "statement");
  else
    ifChain(c, stmt);
  return goesOn;
}

static bool loopBody(Context &c, Block body, Loop &loop, Expr *before, Expr *after) {
  loop.writesBefore = c.writes;
  const bool outermost = c.loopStart == 0;
  if (outermost)
    c.loopStart = ++c.loopCount;
  c.loops.push_back(&loop);
  if (before != nullptr)
    read(c, before);
  ++c.conditional;
  const bool goesOn = block(c, body);
  --c.conditional;
  if (after != nullptr)
    read(c, after);
  c.loops.pop_back();
  if (outermost)
    c.loopStart = 0;
  return goesOn;
}

/// The variables of a condition that nothing but an assignment in this body can change; false when
/// something else is in it.
static bool variablesOf(const Context &c, const Expr *expr, std::vector<const VarSymbol *> &out) {
  switch (expr->kind) {
  case ExprKind::Literal:
  case ExprKind::EnumLiteral:
    return true;
  case ExprKind::Name: {
    const auto *name = as<NameExpr>(expr);
    if (expr->constant != nullptr)
      return true;
    if (name->symbol == nullptr || name->symbol->kind != SymbolKind::Variable)
      return false;
    const auto *v = static_cast<const VarSymbol *>(name->symbol);
    if (!isOwnLocal(c, v) || v->section == Section::InOut || v->type == nullptr ||
        !isElementary(v->type) || (v->uses & kUseAddress) != 0 ||
        (v->decl != nullptr && v->decl->address != nullptr))
      return false;
    out.push_back(v);
    return true;
  }
  case ExprKind::Unary:
    return variablesOf(c, as<UnaryExpr>(expr)->operand, out);
  case ExprKind::Binary:
    return out.size() < 64 && variablesOf(c, as<BinaryExpr>(expr)->left, out) &&
           variablesOf(c, as<BinaryExpr>(expr)->right, out);
  default:
    return false;
  }
}

static void unchangingCondition(Context &c, const Expr *condition, const Loop &loop, Span where) {
  if (loop.exits || c.bodies[c.current].hasLabels)
    return;
  std::vector<const VarSymbol *> variables;
  if (!variablesOf(c, condition, variables) || variables.empty())
    return;
  std::string names;
  for (const VarSymbol *v : variables) {
    const bool reachable =
        loop.calls && v->section != Section::Temp &&
        c.bodies[c.current].decl->kind != DeclKind::Function; // by a method or an action
    if (v->lastWrite > loop.writesBefore || reachable)
      return;
    const std::string name = "`" + std::string(v->name.text) + "`";
    if (names.find(name) == std::string::npos)
      names += (names.empty() ? "" : ", ") + name;
  }
  c.found->conditions.push_back({condition, where, std::move(names), std::move(variables)});
}

static bool whileLoop(Context &c, WhileStmt *stmt) {
  const Truth truth = truthOf(stmt->condition);
  if (truth == Truth::Never)
    report(c, Code::LoopNeverRuns, stmt->condition->span, "this loop never runs",
           "the condition is always FALSE");
  Loop loop;
  loopBody(c, stmt->body, loop, stmt->condition, nullptr);
  if (truth == Truth::Always && !loop.exits) {
    report(c, Code::EndlessLoop, stmt->condition->span, "this loop never ends",
           "always TRUE, and there is no EXIT")
        .help("leave the loop with EXIT; a task that does not end its cycle is stopped");
    return false;
  }
  if (truth == Truth::Unknown && isEmpty(stmt->body) && !loop.calls)
    report(c, Code::EmptyBody, wordSpan(stmt, 5), "this loop does nothing", "its body is empty")
        .help("a `;` after DO is an empty statement; nothing can change the condition while the "
              "loop waits");
  else if (truth == Truth::Unknown)
    unchangingCondition(c, stmt->condition, loop, wordSpan(stmt, 5));
  return truth != Truth::Always || loop.exits;
}

static bool repeatLoop(Context &c, RepeatStmt *stmt) {
  Loop loop;
  const bool falls = loopBody(c, stmt->body, loop, nullptr, stmt->until);
  const Truth truth = truthOf(stmt->until);
  if (truth == Truth::Never && !loop.exits) {
    report(c, Code::EndlessLoop, stmt->until->span, "this loop never ends",
           "always FALSE, and there is no EXIT")
        .help("leave the loop with EXIT; a task that does not end its cycle is stopped");
    return false;
  }
  if (truth == Truth::Unknown && isEmpty(stmt->body) && !loop.calls)
    report(c, Code::EmptyBody, wordSpan(stmt, 6), "this loop does nothing", "its body is empty")
        .help("a `;` after REPEAT is an empty statement; nothing can change the condition while "
              "the loop waits");
  else if (truth == Truth::Unknown)
    unchangingCondition(c, stmt->until, loop, wordSpan(stmt, 6));
  return falls || loop.continues || loop.exits;
}

static void forLoop(Context &c, ForStmt *stmt) {
  read(c, stmt->from);
  read(c, stmt->to);
  if (stmt->by != nullptr)
    read(c, stmt->by);
  write(c, stmt->variable);
  if (VarSymbol *root = rootVariable(stmt->variable))
    markUse(c, root, kUseRead); // counting is using
  const auto value = [](const Expr *e) {
    return e->constant != nullptr && isLiteral(e) ? std::optional(e->constant->integer)
                                                  : std::nullopt;
  };
  const auto from = value(stmt->from);
  const auto to = value(stmt->to);
  const auto by = stmt->by == nullptr ? std::optional<int64_t>(1) : value(stmt->by);
  if (from && to && by && *by != 0 && (*by > 0 ? *from > *to : *from < *to)) {
    auto &d =
        report(c, Code::LoopNeverRuns, stmt->from->span.to(stmt->to->span), "this loop never runs",
               *by > 0 ? "the end is below the start" : "the end is above the start");
    const Span behind{stmt->to->span.file, stmt->to->span.end, stmt->to->span.end};
    if (stmt->by == nullptr)
      d.suggest("count down: `" + text(c, stmt->from->span) + " TO " + text(c, stmt->to->span) +
                    " BY -1`",
                behind, " BY -1");
  }
  if (isEmpty(stmt->body))
    report(c, Code::EmptyBody, wordSpan(stmt, 3), "this loop does nothing", "its body is empty")
        .help("a `;` after DO is an empty statement");
  c.fors.push_back(stmt);
  Loop loop;
  loopBody(c, stmt->body, loop, nullptr, nullptr);
  c.fors.pop_back();
}

static bool caseStatement(Context &c, CaseStmt *stmt) {
  read(c, stmt->selector);
  bool goesOn = !stmt->hasElse;
  ++c.conditional;
  for (CaseBranch &branch : stmt->branches) {
    for (CaseLabel &label : branch.labels) {
      read(c, label.low);
      if (label.high != nullptr)
        read(c, label.high);
    }
    goesOn = block(c, branch.body) || goesOn;
  }
  goesOn = block(c, stmt->elseBody) || goesOn;
  --c.conditional;
  missingCases(c, stmt);
  unreachableCases(c, stmt);
  return goesOn;
}

} // namespace stc::lint
