// Which statements can run, which loops end.

#include "compiler/semantics/lint/lint.hpp"

#include <algorithm>
#include <optional>
#include <string>

namespace stc {

using namespace ast;

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

bool Linter::block(Block statements) {
  bool reachable = true;
  bool reported = false;
  const Stmt *leaves = nullptr;
  for (Stmt *stmt : statements) {
    if (stmt->kind == StmtKind::Label)
      reachable = true;
    else if (!reachable && !reported && stmt->kind != StmtKind::Empty) {
      reported = true;
      report(Code::UnreachableCode, stmt->span, "this statement is never reached", "never runs")
          .label(leaves->span, std::string(wordOf(leaves)));
    }
    const bool goesOn = statement(stmt);
    if (reachable && !goesOn) {
      reachable = false;
      leaves = stmt;
    }
  }
  return reachable;
}

void Linter::leave() {
  mayHaveLeft_ = true;
  for (Loop *loop : loops_)
    loop->exits = true;
}

bool Linter::statement(Stmt *stmt) {
  switch (stmt->kind) {
  case StmtKind::Empty:
  case StmtKind::Label:
    return true;
  case StmtKind::Assign:
    assignment(as<AssignStmt>(stmt));
    return true;
  case StmtKind::Call: {
    Expr *expr = as<CallStmt>(stmt)->expr;
    statementCall_ = expr;
    read(expr);
    statementCall_ = nullptr;
    if (expr->kind == ExprKind::Call) {
      const auto *call = as<CallExpr>(expr);
      ignored_.push_back(call);
      if (call->resolved == Callee::Function && call->pou != nullptr)
        ++functionCalls_[call->pou->decl].asStatement;
    }
    return true;
  }
  case StmtKind::If:
    return ifStatement(as<IfStmt>(stmt));
  case StmtKind::Case:
    return caseStatement(as<CaseStmt>(stmt));
  case StmtKind::For:
    forLoop(as<ForStmt>(stmt));
    return true;
  case StmtKind::While:
    return whileLoop(as<WhileStmt>(stmt));
  case StmtKind::RepeatS:
    return repeatLoop(as<RepeatStmt>(stmt));
  case StmtKind::Exit:
    if (!loops_.empty())
      loops_.back()->exits = true;
    return false;
  case StmtKind::Continue:
    if (!loops_.empty())
      loops_.back()->continues = true;
    return false;
  case StmtKind::Return:
  case StmtKind::Jump:
    leave();
    return false;
  case StmtKind::Try: {
    auto *s = as<TryStmt>(stmt);
    ++conditional_;
    bool goesOn = block(s->body);
    if (s->exception != nullptr)
      write(s->exception);
    goesOn = block(s->catchBody) || goesOn || !s->hasCatch;
    --conditional_;
    return block(s->finallyBody) && goesOn;
  }
  }
  return true;
}

bool Linter::ifStatement(IfStmt *stmt) {
  bool goesOn = !stmt->hasElse;
  bool empty = isEmpty(stmt->elseBody);
  bool first = true;
  for (IfBranch &branch : stmt->branches) {
    read(branch.condition);
    empty = empty && isEmpty(branch.body);
    switch (truthOf(branch.condition)) {
    case Truth::Never:
      report(Code::ConstantCondition, branch.condition->span, "this condition is always FALSE",
             "its branch never runs");
      break;
    case Truth::Always:
      report(Code::ConstantCondition, branch.condition->span, "this condition is always TRUE",
             stmt->hasElse || &branch != &stmt->branches.back() ? "the branches after it never run"
                                                                : "its branch always runs");
      break;
    case Truth::Unknown:
      break;
    }
    if (first) // the first condition itself always runs
      ++conditional_;
    first = false;
    goesOn = block(branch.body) || goesOn;
  }
  goesOn = block(stmt->elseBody) || goesOn;
  --conditional_;
  if (empty)
    report(Code::EmptyBody, wordSpan(stmt, 2), "this IF does nothing",
           "all of its branches are empty")
        .help("write the statements between THEN and END_IF; a `;` after THEN is an empty "
              "statement");
  else
    ifChain(stmt);
  return goesOn;
}

bool Linter::loopBody(Block body, Loop &loop, Expr *before, Expr *after) {
  loop.writesBefore = writes_;
  const bool outermost = loopStart_ == 0;
  if (outermost)
    loopStart_ = ++loopCount_;
  loops_.push_back(&loop);
  if (before != nullptr)
    read(before);
  ++conditional_;
  const bool goesOn = block(body);
  --conditional_;
  if (after != nullptr)
    read(after);
  loops_.pop_back();
  if (outermost)
    loopStart_ = 0;
  return goesOn;
}

/// The variables of a condition that nothing but an assignment in this body can change; false when
/// something else is in it.
bool Linter::variablesOf(const Expr *expr, std::vector<const VarSymbol *> &out) const {
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
    if (!isOwnLocal(v) || v->section == Section::InOut || v->type == nullptr ||
        !isElementary(v->type) || (v->uses & kUseAddress) != 0 ||
        (v->decl != nullptr && v->decl->address != nullptr))
      return false;
    out.push_back(v);
    return true;
  }
  case ExprKind::Unary:
    return variablesOf(as<UnaryExpr>(expr)->operand, out);
  case ExprKind::Binary:
    return out.size() < 64 && variablesOf(as<BinaryExpr>(expr)->left, out) &&
           variablesOf(as<BinaryExpr>(expr)->right, out);
  default:
    return false;
  }
}

void Linter::unchangingCondition(const Expr *condition, const Loop &loop, Span where) {
  if (loop.exits || bodies_[current_].hasLabels)
    return;
  std::vector<const VarSymbol *> variables;
  if (!variablesOf(condition, variables) || variables.empty())
    return;
  std::string names;
  for (const VarSymbol *v : variables) {
    const bool reachable =
        loop.calls && v->section != Section::Temp &&
        bodies_[current_].decl->kind != DeclKind::Function; // by a method or an action
    if (v->lastWrite > loop.writesBefore || reachable)
      return;
    const std::string name = "`" + std::string(v->name.text) + "`";
    if (names.find(name) == std::string::npos)
      names += (names.empty() ? "" : ", ") + name;
  }
  report(Code::EndlessLoop, condition->span, "once begun, this loop never ends",
         "nothing in the loop changes " + names)
      .label(where, "this loop")
      .help("change " + names + " in the loop, or leave it with EXIT");
}

bool Linter::whileLoop(WhileStmt *stmt) {
  const Truth truth = truthOf(stmt->condition);
  if (truth == Truth::Never)
    report(Code::LoopNeverRuns, stmt->condition->span, "this loop never runs",
           "the condition is always FALSE");
  Loop loop;
  loopBody(stmt->body, loop, stmt->condition, nullptr);
  if (truth == Truth::Always && !loop.exits) {
    report(Code::EndlessLoop, stmt->condition->span, "this loop never ends",
           "always TRUE, and there is no EXIT")
        .help("leave the loop with EXIT; a task that does not end its cycle is stopped");
    return false;
  }
  if (truth == Truth::Unknown && isEmpty(stmt->body) && !loop.calls)
    report(Code::EmptyBody, wordSpan(stmt, 5), "this loop does nothing", "its body is empty")
        .help("a `;` after DO is an empty statement; nothing can change the condition while the "
              "loop waits");
  else if (truth == Truth::Unknown)
    unchangingCondition(stmt->condition, loop, wordSpan(stmt, 5));
  return truth != Truth::Always || loop.exits;
}

bool Linter::repeatLoop(RepeatStmt *stmt) {
  Loop loop;
  const bool falls = loopBody(stmt->body, loop, nullptr, stmt->until);
  const Truth truth = truthOf(stmt->until);
  if (truth == Truth::Never && !loop.exits) {
    report(Code::EndlessLoop, stmt->until->span, "this loop never ends",
           "always FALSE, and there is no EXIT")
        .help("leave the loop with EXIT; a task that does not end its cycle is stopped");
    return false;
  }
  if (truth == Truth::Unknown && isEmpty(stmt->body) && !loop.calls)
    report(Code::EmptyBody, wordSpan(stmt, 6), "this loop does nothing", "its body is empty")
        .help("a `;` after REPEAT is an empty statement; nothing can change the condition while "
              "the loop waits");
  else if (truth == Truth::Unknown)
    unchangingCondition(stmt->until, loop, wordSpan(stmt, 6));
  return falls || loop.continues || loop.exits;
}

void Linter::forLoop(ForStmt *stmt) {
  read(stmt->from);
  read(stmt->to);
  if (stmt->by != nullptr)
    read(stmt->by);
  write(stmt->variable);
  if (VarSymbol *root = rootVariable(stmt->variable))
    root->uses |= kUseRead; // counting is using
  const auto value = [](const Expr *e) {
    return e->constant != nullptr && isLiteral(e) ? std::optional(e->constant->integer)
                                                  : std::nullopt;
  };
  const auto from = value(stmt->from);
  const auto to = value(stmt->to);
  const auto by = stmt->by == nullptr ? std::optional<int64_t>(1) : value(stmt->by);
  if (from && to && by && *by != 0 && (*by > 0 ? *from > *to : *from < *to)) {
    auto &d =
        report(Code::LoopNeverRuns, stmt->from->span.to(stmt->to->span), "this loop never runs",
               *by > 0 ? "the end is below the start" : "the end is above the start");
    const Span behind{stmt->to->span.file, stmt->to->span.end, stmt->to->span.end};
    if (stmt->by == nullptr)
      d.suggest("count down: `" + text(stmt->from->span) + " TO " + text(stmt->to->span) +
                    " BY -1`",
                behind, " BY -1");
  }
  if (isEmpty(stmt->body))
    report(Code::EmptyBody, wordSpan(stmt, 3), "this loop does nothing", "its body is empty")
        .help("a `;` after DO is an empty statement");
  fors_.push_back(stmt);
  Loop loop;
  loopBody(stmt->body, loop, nullptr, nullptr);
  fors_.pop_back();
}

bool Linter::caseStatement(CaseStmt *stmt) {
  read(stmt->selector);
  bool goesOn = !stmt->hasElse;
  ++conditional_;
  for (CaseBranch &branch : stmt->branches) {
    for (CaseLabel &label : branch.labels) {
      read(label.low);
      if (label.high != nullptr)
        read(label.high);
    }
    goesOn = block(branch.body) || goesOn;
  }
  goesOn = block(stmt->elseBody) || goesOn;
  --conditional_;
  missingCases(stmt);
  unreachableCases(stmt);
  return goesOn;
}

} // namespace stc
