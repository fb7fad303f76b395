// Statements and bodies.

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"

#include <map>

namespace stc {

using namespace ast;

void Checker::checkBody(PouSymbol *pou) {
  if (pou->checked)
    return;
  pou->checked = true;
  const ScopeGuard guard(*this, {&moduleOf(pou), pou});
  for (VarSymbol *v : pou->variables)
    checkInitOf(v);
  loopDepth_ = 0;
  checkBlock(pou->decl->body);
  checkJumps(pou->decl->body);
  for (PouSymbol *method : pou->methods) {
    declare(method);
    if (pou->isInterface()) { // callers use the default values
      for (VarSymbol *v : method->variables)
        checkInitOf(v);
      continue;
    }
    checkAfterInit(method);
    checkBody(method);
  }
}

void Checker::checkBlock(Block block) {
  for (Stmt *stmt : block)
    checkStatement(stmt);
}

/// `Visu;` and `fb.Rewind;` call a program and an action, as in V2.3; null: this is no such call.
CallExpr *Checker::bareCall(Expr *expr) {
  const Symbol *symbol = nullptr;
  if (expr->kind == ExprKind::name) {
    symbol = lookup(as<NameExpr>(expr)->name);
  } else if (expr->kind == ExprKind::member && as<MemberExpr>(expr)->bit < 0 &&
             as<MemberExpr>(expr)->base->kind == ExprKind::name) {
    const auto *member = as<MemberExpr>(expr);
    Symbol *base = lookup(as<NameExpr>(member->base)->name);
    const Type *type = nullptr;
    if (base != nullptr && base->kind == SymbolKind::variable)
      type = typeOf(static_cast<VarSymbol *>(base));
    else if (base != nullptr && base->kind == SymbolKind::pou)
      type = static_cast<PouSymbol *>(base)->type;
    if (type == nullptr || !isInstance(type))
      return nullptr;
    PouSymbol *owner = typeAs<PouType>(type)->symbol;
    declare(owner);
    symbol = memberNamed(owner, member->name.id);
  }
  if (symbol == nullptr || symbol->kind != SymbolKind::pou)
    return nullptr;
  const DeclKind kind = static_cast<const PouSymbol *>(symbol)->decl->kind;
  if (kind != DeclKind::program && kind != DeclKind::action)
    return nullptr;
  auto *call = arena_.make<CallExpr>();
  call->span = expr->span;
  call->callee = expr;
  return call;
}

void Checker::checkStatement(Stmt *stmt) {
  switch (stmt->kind) {
  case StmtKind::empty:
  case StmtKind::returnS:
    break;
  case StmtKind::assign:
    checkAssign(as<AssignStmt>(stmt));
    break;
  case StmtKind::call: {
    Expr *expr = as<CallStmt>(stmt)->expr;
    if (expr->kind == ExprKind::call) {
      expr->type = checkCall(as<CallExpr>(expr), true);
    } else if (CallExpr *call = bareCall(expr)) {
      as<CallStmt>(stmt)->expr = call;
      call->type = checkCall(call, true);
    } else if (expr->kind != ExprKind::error) {
      check(expr);
      if (isError(expr->type))
        break;
      auto &d = report(Code::noEffect, expr->span, "this statement has no effect",
                       "its value is not used");
      if (isInstance(expr->type))
        d.help("call it: `" + std::string(program_.sources.text(expr->span)) + "();`");
      else if (expr->kind == ExprKind::binary && as<BinaryExpr>(expr)->op == BinaryOp::equal)
        d.help("`=` compares; assign with `:=`");
    }
    break;
  }
  case StmtKind::ifS: {
    auto *s = as<IfStmt>(stmt);
    for (IfBranch &branch : s->branches) {
      checkCondition(branch.condition, "the condition of IF");
      checkBlock(branch.body);
    }
    checkBlock(s->elseBody);
    break;
  }
  case StmtKind::caseS:
    checkCase(as<CaseStmt>(stmt));
    break;
  case StmtKind::forS:
    checkFor(as<ForStmt>(stmt));
    break;
  case StmtKind::whileS: {
    auto *s = as<WhileStmt>(stmt);
    checkCondition(s->condition, "the condition of WHILE");
    ++loopDepth_;
    checkBlock(s->body);
    --loopDepth_;
    break;
  }
  case StmtKind::repeatS: {
    auto *s = as<RepeatStmt>(stmt);
    ++loopDepth_;
    checkBlock(s->body);
    --loopDepth_;
    checkCondition(s->until, "the condition of UNTIL");
    break;
  }
  case StmtKind::jump: // checkJumps() looks at the body as a whole
  case StmtKind::label:
    break;
  case StmtKind::tryS:
    checkTry(as<TryStmt>(stmt));
    break;
  case StmtKind::exit:
  case StmtKind::continueS:
    if (loopDepth_ == 0) {
      const std::string word = stmt->kind == StmtKind::exit ? "EXIT" : "CONTINUE";
      auto &d = report(Code::outsideLoop, stmt->span, word + " outside of a loop",
                       "there is no FOR, WHILE or REPEAT around it");
      if (stmt->kind == StmtKind::exit)
        d.help("leave the POU with RETURN");
    }
    break;
  }
}

void Checker::checkAssign(AssignStmt *stmt) {
  // The last target takes the value, the one before it what that one has taken, and so on.
  const Type *expected = nullptr;
  for (std::size_t i = stmt->targets.size(); i-- > 0;) {
    Expr *target = stmt->targets[i];
    const Type *type = stmt->op == AssignOp::reference ? check(target) : checkTarget(target);
    const bool assignable = requireVariable(target, "assign to");
    if (i + 1 == stmt->targets.size())
      expected = assignable ? type : elementaryType(TypeKind::error);
  }
  Expr *last = stmt->targets.back();
  if (stmt->op == AssignOp::reference) {
    checkReferenceAssign(stmt);
    return;
  }
  if (expected == nullptr || isError(expected)) {
    check(stmt->value);
    return;
  }
  if (stmt->op == AssignOp::set || stmt->op == AssignOp::reset) {
    if (expected->kind != TypeKind::boolean) {
      report(Code::setResetNotBool, last->span,
             "S= and R= work on BOOL, this is " + typeName(expected), "expected BOOL");
      check(stmt->value);
      return;
    }
    checkCondition(stmt->value, "the right side of S= and R=");
    return;
  }
  const Type *value = check(stmt->value, expected);
  if (isError(value))
    return;
  if (value->kind == TypeKind::none) {
    report(Code::noValue, stmt->value->span, "this call has no value",
           "the function has no result type")
        .help("give the function a result type: `FUNCTION f : INT`");
    return;
  }
  if (isInstance(value) && value == expected && value->kind == TypeKind::program) {
    report(Code::typeMismatch, stmt->span, "a program cannot be copied", "there is only one of it");
    return;
  }
  if (refuseOpenArray(last, "assign") || refuseOpenArray(stmt->value, "copy"))
    return;
  coerce(stmt->value, expected, {});
  for (std::size_t i = stmt->targets.size() - 1; i-- > 0;) {
    Expr *target = stmt->targets[i];
    const Conversion c = classify(stmt->targets[i + 1]->type, target->type);
    if (c == Conversion::narrowing || c == Conversion::forbidden || c == Conversion::lossy) {
      Expr from = *stmt->targets[i + 1];
      reportConversion(&from, from.type, target->type, c, {});
    }
  }
}

void Checker::checkCase(CaseStmt *stmt) {
  const Type *type = check(stmt->selector);
  bool ok = !isError(type);
  if (ok && !isInteger(underlying(type)) && type->kind != TypeKind::anyInteger) {
    auto &d = report(Code::caseSelector, stmt->selector->span,
                     "CASE selects by an integer or an enumeration, not by " + typeName(type),
                     "cannot select by this");
    if (type->kind == TypeKind::boolean)
      d.help("use IF … ELSE for a BOOL");
    ok = false;
  }
  if (ok && type->kind == TypeKind::anyInteger)
    type = settle(stmt->selector);
  struct Seen {
    std::int64_t high;
    Span span;
  };
  std::map<std::int64_t, Seen> seen; // by lower bound; ranges that do not overlap
  for (CaseBranch &branch : stmt->branches) {
    for (CaseLabel &label : branch.labels) {
      bool known = true;
      for (Expr *bound : {label.low, label.high}) {
        if (bound == nullptr)
          continue;
        const Type *boundType = check(bound, ok ? type : nullptr);
        known = known && ok && !isError(boundType);
        if (!known)
          continue;
        if (bound->constant == nullptr) {
          report(Code::caseLabelNotConstant, bound->span, "a CASE label must be a constant",
                 "its value is only known at run time")
              .help("use IF … ELSIF for values that change");
          known = false;
          continue;
        }
        if (boundType->kind == TypeKind::enumeration && !typeAs<EnumType>(boundType)->strict &&
            type->kind != TypeKind::enumeration && isInteger(type))
          setTarget(bound, type);
        else
          coerce(bound, type, "the CASE label");
        known = known && bound->constant->kind == ConstKind::integer;
      }
      if (!known)
        continue;
      const std::int64_t low = label.low->constant->integer;
      const std::int64_t high = label.high == nullptr ? low : label.high->constant->integer;
      const bool wide =
          bitWidth(type) == 64 && !isSignedInteger(underlying(type)); // compare as ULINT
      const auto before = [wide](std::int64_t a, std::int64_t b) {
        return wide ? static_cast<std::uint64_t>(a) < static_cast<std::uint64_t>(b) : a < b;
      };
      if (before(high, low)) {
        report(Code::emptyRange, label.span, "this range holds no value",
               "the upper bound is below the lower one");
        continue;
      }
      auto other = seen.upper_bound(high); // the first range behind this one
      if (other != seen.begin() && (--other)->second.high >= low) {
        auto &d = report(Code::duplicateLabel, label.span, "this CASE value is already handled",
                         "handled again here");
        d.label(other->second.span, "first handled here");
      } else {
        seen.emplace(low, Seen{high, label.span});
      }
    }
    checkBlock(branch.body);
  }
  checkBlock(stmt->elseBody);
}

void Checker::checkFor(ForStmt *stmt) {
  const Type *type = check(stmt->variable);
  bool ok = !isError(type) && requireVariable(stmt->variable, "count with");
  if (ok && (!isInteger(underlying(type)) || type->kind == TypeKind::enumeration)) {
    report(Code::forVariable, stmt->variable->span,
           "FOR counts with an integer variable, this is " + typeName(type), "expected an integer");
    ok = false;
  }
  for (Expr *e : {stmt->from, stmt->to, stmt->by}) {
    if (e == nullptr)
      continue;
    check(e, ok ? type : nullptr);
    if (ok && e != stmt->by)
      coerce(e, type, "FOR");
  }
  if (stmt->by != nullptr && ok && !isError(stmt->by->type)) {
    if (stmt->by->constant != nullptr && stmt->by->constant->kind == ConstKind::integer &&
        stmt->by->constant->integer == 0)
      report(Code::forStepZero, stmt->by->span, "a FOR loop with step 0 never ends", "the step");
    // The step has a sign even where the variable has none (`FOR u := 10 TO 0 BY -1`).
    const Type *step = underlying(type);
    if (!isSignedInteger(step))
      step = elementaryType(bitWidth(step) < 32 ? TypeKind::dint : TypeKind::lint);
    coerce(stmt->by, step, "the step of FOR");
  }
  ++loopDepth_;
  checkBlock(stmt->body);
  --loopDepth_;
}

} // namespace stc
