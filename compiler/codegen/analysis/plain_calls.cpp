#include "compiler/codegen/analysis/plain_calls.hpp"

#include "compiler/codegen/cpp/layout.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

constexpr unsigned kLeaves = kEffectRaises | kEffectCalls;

/// A built-in function is called whose value comes from the context: TIME().
bool callsClock(Block block) {
  bool calls = false;
  const auto look = [&](const Expr *e) {
    const auto *call = e->kind == ExprKind::Call ? as<CallExpr>(e) : nullptr;
    calls = calls || (call != nullptr && call->resolved == Callee::Builtin &&
                      (builtinRow(call->builtin).does & BuiltinRow::kReads) != 0);
  };
  walkExpressions(block, look);
  return calls;
}

} // namespace

// A library that is not compiled with the program may have checks where the program has none.
PlainCalls::PlainCalls(const Program &program, Addressed &addressed)
    : analysis_(program, true), addressed_(addressed),
      hasOwnChecks_(std::any_of(program.implicitChecks.begin(), program.implicitChecks.end(),
                                [](const PouSymbol *check) { return check != nullptr; })) {}

bool PlainCalls::alwaysEnds(const PouSymbol *block) {
  const auto [at, fresh] = known_.try_emplace(block, false);
  if (fresh)
    known_[block] = find(block);
  return known_[block];
}

bool PlainCalls::readsClock(const Stmt *loop) {
  bool reads = false;
  const auto look = [&](const Expr *e) {
    const auto *call = e->kind == ExprKind::Call ? as<CallExpr>(e) : nullptr;
    if (call != nullptr && call->resolved == Callee::FunctionBlock && alwaysEnds(call->pou))
      reads = reads || callsClock(call->pou->decl->body);
  };
  forEachChild(
      loop, [&](Expr *e) { walk(e, look); }, [&](Block body) { walkExpressions(body, look); });
  return reads;
}

bool PlainCalls::find(const PouSymbol *block) {
  if (!block->isBlock() || block->base != nullptr || block->extended || block->isAbstract() ||
      block->decl->external || !block->checked || hasOwnChecks_)
    return false;
  // The end of the data stack is looked at where the body begins, and the bounds of ARRAY[*].
  const auto raises = [&](const VarSymbol *v) {
    return v->type->kind == TypeKind::Reference || v->type->kind == TypeKind::OpenArray ||
           (v->section == Section::Temp && addressed_.onDataStack(v));
  };
  if (std::any_of(block->variables.begin(), block->variables.end(), raises))
    return false;
  analysis_.assumeBound(block);
  const bool ends = this->block(block->decl->body, block);
  analysis_.assumeBound(nullptr);
  return ends;
}

bool PlainCalls::block(Block block, const PouSymbol *pou) {
  return std::all_of(block.begin(), block.end(), [&](const Stmt *s) { return statement(s, pou); });
}

bool PlainCalls::statement(const Stmt *s, const PouSymbol *pou) {
  switch (s->kind) {
  case StmtKind::Assign: {
    const auto *a = as<AssignStmt>(s);
    return a->op != AssignOp::Reference && (analysis_.effects(a->value) & kLeaves) == 0 &&
           std::all_of(a->targets.begin(), a->targets.end(),
                       [&](const Expr *t) { return isPlainTarget(t, pou); });
  }
  case StmtKind::For:
    if (!analysis_.shortLoop(as<ForStmt>(s)) || !isPlainTarget(as<ForStmt>(s)->variable, pou))
      return false;
    break;
  case StmtKind::If:
  case StmtKind::Case:
  case StmtKind::Return:
  case StmtKind::Exit:
  case StmtKind::Continue:
    break;
  default:
    return false;
  }
  bool ends = true;
  forEachChild(
      s, [&](const Expr *e) { ends = ends && (analysis_.effects(e) & kLeaves) == 0; },
      [&](Block inner) { ends = ends && block(inner, pou); });
  return ends;
}

/// Aggregates may hold blocks, which are copied by functions.
bool PlainCalls::isPlainTarget(const Expr *target, const PouSymbol *pou) {
  return isScalar(target->type) && writtenProperty(target) == nullptr &&
         (analysis_.targetEffects(target, pou) & kLeaves) == 0;
}

} // namespace stc::codegen
