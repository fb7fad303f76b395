// Bodies and statements.

#include "compiler/semantics/statements/statements.hpp"

#include "compiler/semantics/calls/calls.hpp"
#include "compiler/semantics/classes/classes.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/semantics/statements/internal.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <cstdint>

namespace stc::sema {

using namespace ast;

static void checkStatement(Context &c, Stmt *stmt);
static void checkAssign(Context &c, AssignStmt *stmt);
static void checkFor(Context &c, ForStmt *stmt);

void checkBody(Context &c, PouSymbol *pou) {
  if (pou->checked)
    return;
  pou->checked = true;
  const ScopeGuard guard(c, {&c.names.moduleOf(pou), pou});
  for (VarSymbol *v : pou->variables)
    checkInitOf(c, v);
  const ModeGuard loops(c.loopDepth, 0U);
  checkBlock(c, pou->decl->body);
  checkJumps(c, pou->decl->body);
  for (PouSymbol *method : pou->methods) {
    declare(c, method);
    if (pou->isInterface()) { // callers use the default values
      for (VarSymbol *v : method->variables)
        checkInitOf(c, v);
      continue;
    }
    checkAfterInit(c, method);
    checkBody(c, method);
  }
}

/// What the statement of a chart that runs an action is: a call, or an assignment to a variable.
static Stmt *chosen(Context &c, Stmt *stmt) {
  if (stmt->kind != StmtKind::If || as<IfStmt>(stmt)->ofVariable == nullptr)
    return stmt;
  const Stmt *call = as<IfStmt>(stmt)->branches.front().body.front();
  const Expr *callee = as<CallExpr>(as<CallStmt>(call)->expr)->callee;
  Symbol *symbol = lookup(c, as<NameExpr>(callee)->name);
  const bool isVariable = symbol != nullptr && symbol->kind == SymbolKind::Variable &&
                          !isInstance(typeOf(c, static_cast<VarSymbol *>(symbol)));
  return isVariable ? as<IfStmt>(stmt)->ofVariable : stmt;
}

void checkBlock(Context &c, Block block) {
  for (Stmt *&stmt : block)
    stmt = chosen(c, stmt);
  for (Stmt *stmt : block)
    checkStatement(c, stmt);
}

static void checkLoopBody(Context &c, Block body) {
  const ModeGuard loop(c.loopDepth, c.loopDepth + 1);
  checkBlock(c, body);
}

/// `Visu;` and `fb.Rewind;` call a program and an action, as in V2.3; null: this is no such call.
static CallExpr *bareCall(Context &c, Expr *expr) {
  const Symbol *symbol = nullptr;
  if (expr->kind == ExprKind::Name) {
    symbol = lookup(c, as<NameExpr>(expr)->name);
  } else if (expr->kind == ExprKind::Member && as<MemberExpr>(expr)->bit < 0 &&
             as<MemberExpr>(expr)->base->kind == ExprKind::Name) {
    const auto *member = as<MemberExpr>(expr);
    Symbol *base = lookup(c, as<NameExpr>(member->base)->name);
    const Type *type = nullptr;
    if (base != nullptr && base->kind == SymbolKind::Variable)
      type = typeOf(c, static_cast<VarSymbol *>(base));
    else if (base != nullptr && base->kind == SymbolKind::Pou)
      type = static_cast<PouSymbol *>(base)->type;
    if (type == nullptr || !isInstance(type))
      return nullptr;
    PouSymbol *owner = typeAs<PouType>(type)->symbol;
    declare(c, owner);
    symbol = memberNamed(owner, member->name.id);
  }
  if (symbol == nullptr || symbol->kind != SymbolKind::Pou)
    return nullptr;
  const DeclKind kind = static_cast<const PouSymbol *>(symbol)->decl->kind;
  if (kind != DeclKind::Program && kind != DeclKind::Action)
    return nullptr;
  auto *call = c.arena.make<CallExpr>();
  call->span = expr->span;
  call->callee = expr;
  return call;
}

static void checkCallStatement(Context &c, CallStmt *stmt) {
  Expr *expr = stmt->expr;
  if (expr->kind == ExprKind::Call) {
    expr->type = checkCall(c, as<CallExpr>(expr), true);
    return;
  }
  if (CallExpr *call = bareCall(c, expr)) {
    stmt->expr = call;
    call->type = checkCall(c, call, true);
    return;
  }
  if (expr->kind == ExprKind::Error || isError(check(c, expr)))
    return;
  auto &d =
      c.report(Code::NoEffect, expr->span, "this statement has no effect", "its value is not used");
  if (isInstance(expr->type))
    d.help("call it: `" + std::string(c.program.sources.text(expr->span)) + "();`");
  else if (expr->kind == ExprKind::Binary && as<BinaryExpr>(expr)->op == BinaryOp::Equal)
    d.help("`=` compares; assign with `:=`");
}

/// EXIT, CONTINUE
static void checkInLoop(Context &c, const Stmt *stmt) {
  if (c.loopDepth != 0)
    return;
  const std::string word = stmt->kind == StmtKind::Exit ? "EXIT" : "CONTINUE";
  auto &d = c.report(Code::OutsideLoop, stmt->span, word + " outside of a loop",
                     "there is no FOR, WHILE or REPEAT around it");
  if (stmt->kind == StmtKind::Exit)
    d.help("leave the POU with RETURN");
}

/// The condition of a branch of IF. One that is assigned right before is a slip, or said to be
/// none.
static void checkBranch(Context &c, const IfBranch &branch) {
  if (branch.assigned == nullptr)
    return checkCondition(c, branch.condition, "the condition of IF");
  const Type *type = check(c, branch.condition, elementaryType(TypeKind::Boolean));
  if (isError(type))
    return;
  const Span sign = branch.assigned->opSpan;
  if (type == elementaryType(TypeKind::Boolean))
    c.report(Code::ConditionAssigned, sign, "`:=` assigns; what is assigned is the condition",
             "is `=` meant?")
        .help("write `=` to compare, or assign in a statement of its own before");
  else
    c.report(Code::AssignInCondition, sign, "`:=` assigns, it does not compare", "expected `=`")
        .help("write `=` to compare");
}

static void checkStatement(Context &c, Stmt *stmt) {
  switch (stmt->kind) {
  case StmtKind::Empty:
  case StmtKind::Return:
  case StmtKind::Jump: // checkJumps() looks at the body as a whole
  case StmtKind::Label:
    return;
  case StmtKind::Assign:
    return checkAssign(c, as<AssignStmt>(stmt));
  case StmtKind::Call:
    return checkCallStatement(c, as<CallStmt>(stmt));
  case StmtKind::If:
    for (const IfBranch &branch : as<IfStmt>(stmt)->branches) {
      checkBranch(c, branch);
      checkBlock(c, branch.body);
    }
    return checkBlock(c, as<IfStmt>(stmt)->elseBody);
  case StmtKind::Case:
    return checkCase(c, as<CaseStmt>(stmt));
  case StmtKind::For:
    return checkFor(c, as<ForStmt>(stmt));
  case StmtKind::While:
    checkCondition(c, as<WhileStmt>(stmt)->condition, "the condition of WHILE");
    return checkLoopBody(c, as<WhileStmt>(stmt)->body);
  case StmtKind::RepeatS:
    checkLoopBody(c, as<RepeatStmt>(stmt)->body);
    return checkCondition(c, as<RepeatStmt>(stmt)->until, "the condition of UNTIL");
  case StmtKind::Try:
    return checkTry(c, as<TryStmt>(stmt));
  case StmtKind::Exit:
  case StmtKind::Continue:
    return checkInLoop(c, stmt);
  }
}

/// The variable of an instruction list that gets its type from its first value, which is this one;
/// else null.
static VarSymbol *withoutType(Context &c, const AssignStmt *stmt) {
  const Expr *target = stmt->targets.front();
  if (target->kind != ExprKind::Name)
    return nullptr;
  Symbol *symbol = lookup(c, as<NameExpr>(target)->name);
  if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
    return nullptr;
  auto *variable = static_cast<VarSymbol *>(symbol);
  const bool inferred =
      variable->decl != nullptr && variable->decl->type->kind == TypeExprKind::Inferred;
  return inferred && isError(typeOf(c, variable)) ? variable : nullptr;
}

/// What a value has as type when nothing says which.
static const Type *ownType(const Type *type) {
  return type->kind == TypeKind::AnyInteger ? elementaryType(TypeKind::Dint)
         : type->kind == TypeKind::AnyReal  ? elementaryType(TypeKind::Lreal)
                                            : type;
}

static void inferType(Context &c, AssignStmt *stmt, VarSymbol *variable) {
  const Type *type = check(c, stmt->value);
  if (isError(type))
    return;
  if (type->kind == TypeKind::None) {
    c.report(Code::NoValue, stmt->value->span, "this call has no value",
             "the function has no result type")
        .help("give the function a result type: `FUNCTION f : INT`");
    return;
  }
  variable->type = ownType(type);
  variable->common = stmt->value->common;
  const ConstValue *constant = stmt->value->constant;
  if (type->kind == TypeKind::AnyReal)
    variable->common = elementaryType(TypeKind::Real);
  else if (type->kind == TypeKind::AnyInteger && constant != nullptr &&
           constant->integer >= INT16_MIN && constant->integer <= INT16_MAX)
    variable->common = elementaryType(TypeKind::Int);
  check(c, stmt->targets.front());
  coerce(c, stmt->value, variable->type, {});
}

static void checkAssign(Context &c, AssignStmt *stmt) {
  if (VarSymbol *variable = withoutType(c, stmt))
    return inferType(c, stmt, variable);
  // The last target takes the value, the one before it what that one has taken, and so on.
  const Type *expected = nullptr;
  for (size_t i = stmt->targets.size(); i-- > 0;) {
    Expr *target = stmt->targets[i];
    const Type *type = stmt->op == AssignOp::Reference ? check(c, target) : checkTarget(c, target);
    const bool assignable = requireVariable(c, target, "assign to");
    if (i + 1 == stmt->targets.size())
      expected = assignable ? type : elementaryType(TypeKind::Error);
  }
  Expr *last = stmt->targets.back();
  if (stmt->op == AssignOp::Reference) {
    checkReferenceAssign(c, stmt);
    return;
  }
  if (expected == nullptr || isError(expected)) {
    check(c, stmt->value);
    return;
  }
  if (stmt->op == AssignOp::Set || stmt->op == AssignOp::Reset) {
    if (expected->kind != TypeKind::Boolean) {
      c.report(Code::SetResetNotBool, last->span,
               "S= and R= work on BOOL, this is " + typeName(expected), "expected BOOL");
      check(c, stmt->value);
      return;
    }
    checkCondition(c, stmt->value, "the right side of S= and R=");
    return;
  }
  const Type *value = check(c, stmt->value, expected);
  if (isError(value))
    return;
  if (value->kind == TypeKind::None) {
    c.report(Code::NoValue, stmt->value->span, "this call has no value",
             "the function has no result type")
        .help("give the function a result type: `FUNCTION f : INT`");
    return;
  }
  if (isInstance(value) && value == expected && value->kind == TypeKind::Program) {
    c.report(Code::TypeMismatch, stmt->span, "a program cannot be copied",
             "there is only one of it");
    return;
  }
  if (refuseOpenArray(c, last, "assign") || refuseOpenArray(c, stmt->value, "copy"))
    return;
  coerce(c, stmt->value, expected, {});
  for (size_t i = stmt->targets.size() - 1; i-- > 0;) {
    Expr *target = stmt->targets[i];
    const Conversion kind = classify(stmt->targets[i + 1]->type, target->type);
    if (kind == Conversion::Narrowing || kind == Conversion::Forbidden ||
        kind == Conversion::Lossy) {
      Expr from = *stmt->targets[i + 1];
      reportConversion(c, &from, from.type, target->type, kind, {});
    }
  }
}

static void checkFor(Context &c, ForStmt *stmt) {
  const Type *type = check(c, stmt->variable);
  bool ok = !isError(type) && requireVariable(c, stmt->variable, "count with");
  if (ok && (!isInteger(underlying(type)) || type->kind == TypeKind::Enumeration)) {
    c.report(Code::ForVariable, stmt->variable->span,
             "FOR counts with an integer variable, this is " + typeName(type),
             "expected an integer");
    ok = false;
  }
  for (Expr *e : {stmt->from, stmt->to, stmt->by}) {
    if (e == nullptr)
      continue;
    check(c, e, ok ? type : nullptr);
    if (ok && e != stmt->by)
      coerce(c, e, type, "FOR");
  }
  if (stmt->by != nullptr && ok && !isError(stmt->by->type)) {
    if (stmt->by->constant != nullptr && stmt->by->constant->kind == ConstKind::Integer &&
        stmt->by->constant->integer == 0)
      c.report(Code::ForStepZero, stmt->by->span, "a FOR loop with step 0 never ends", "the step");
    // The step has a sign even where the variable has none (`FOR u := 10 TO 0 BY -1`).
    const Type *step = underlying(type);
    if (!isSignedInteger(step))
      step = elementaryType(bitWidth(step) < 32 ? TypeKind::Dint : TypeKind::Lint);
    coerce(c, stmt->by, step, "the step of FOR");
  }
  checkLoopBody(c, stmt->body);
}

} // namespace stc::sema
