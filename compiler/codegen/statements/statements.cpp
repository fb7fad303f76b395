#include "compiler/codegen/statements/statements.hpp"

#include "compiler/codegen/calls/builtin_calls.hpp"
#include "compiler/codegen/calls/calls.hpp"
#include "compiler/codegen/calls/pool_objects.hpp"
#include "compiler/codegen/statements/assignments.hpp"
#include "compiler/codegen/statements/branches.hpp"
#include "compiler/codegen/statements/jumps.hpp"
#include "compiler/codegen/statements/loops.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

void emitExit(EmitContext &cx);
void emitReturn(EmitContext &cx);

/// EXIT, CONTINUE and RETURN that leave no __TRY with __FINALLY.
void emitLeave(EmitContext &cx, const Stmt *s) {
  cx.begin(s->span);
  if (s->kind == StmtKind::Exit)
    emitExit(cx);
  else if (s->kind == StmtKind::Continue)
    cx.out << "continue;";
  else
    emitReturn(cx);
  cx.end();
}

void emitExit(EmitContext &cx) {
  Loop &loop = cx.modes.loops.around.back();
  if (loop.isDouble || loop.switches > 0) { // `break` would not leave it all
    loop.labelled = true;
    cx.out << "goto exit__" << loop.id << ';';
  } else {
    cx.out << "break;";
  }
}

void emitReturn(EmitContext &cx) {
  if (cx.uses.budget) // a RETURN before the first loop has used nothing
    cx.out << "budget__.done(" << cx.ctx() << "); ";
  if (!cx.modes.loops.locals.empty())
    cx.out << cx.modes.loops.context << ".save(); ";
  cx.out << "return";
  if (const VarSymbol *result = cx.pou->result) {
    cx.uses.add(result);
    cx.out << ' ' << mangle(result->name.text);
  }
  cx.out << ';';
}

void emitCallStatement(EmitContext &cx, const CallStmt *s) {
  if (s->expr->kind != ExprKind::Call)
    return;
  const auto *call = as<CallExpr>(s->expr);
  cx.begin(s->span);
  switch (call->resolved) {
  case Callee::Function:
  case Callee::Method:
    emitFunctionCall(cx, call, true);
    break;
  case Callee::FunctionBlock:
  case Callee::Program:
    emitInstanceCall(cx, call, s->span);
    break;
  case Callee::Builtin: {
    const bool gives = call->type->kind != TypeKind::None;
    cx.out << (gives ? "static_cast<void>(" : "");
    emitBuiltin(cx, call);
    cx.out << (gives ? ");" : "");
    break;
  }
  case Callee::Unresolved:
    break;
  }
  cx.end();
}

} // namespace

void emitBlock(EmitContext &cx, Block block) {
  // A `goto` must not cross the temporaries of the statements between it and its label.
  const bool labelled = std::any_of(block.begin(), block.end(), [](const Stmt *s) {
    return s->kind == StmtKind::Label && as<LabelStmt>(s)->used;
  });
  const Scoped<Block> outer(cx.modes.before, {});
  for (const Stmt *s : block) {
    const bool alone = labelled && s->kind != StmtKind::Label && s->kind != StmtKind::Empty;
    if (alone) {
      cx.line("{");
      cx.open();
    }
    emitStatement(cx, s);
    if (alone) {
      cx.close();
      cx.line("}");
    }
    cx.modes.before = block.first(cx.modes.before.size() + 1);
  }
}

void emitStatement(EmitContext &cx, const Stmt *s) {
  switch (s->kind) {
  case StmtKind::Empty:
    return;
  case StmtKind::Jump:
    return emitJump(cx, as<JumpStmt>(s));
  case StmtKind::Label:
    return emitLabel(cx, as<LabelStmt>(s));
  case StmtKind::Try:
    return emitTry(cx, as<TryStmt>(s));
  case StmtKind::Assign:
    return emitAssignment(cx, as<AssignStmt>(s));
  case StmtKind::Call:
    return emitCallStatement(cx, as<CallStmt>(s));
  case StmtKind::If:
    return emitIf(cx, as<IfStmt>(s));
  case StmtKind::Case:
    return emitCase(cx, as<CaseStmt>(s));
  case StmtKind::For:
  case StmtKind::While:
  case StmtKind::RepeatS:
    return emitLoop(cx, s);
  case StmtKind::Exit:
  case StmtKind::Continue:
  case StmtKind::Return:
    if (!leaveTry(cx, s))
      emitLeave(cx, s);
    return;
  }
}

} // namespace stc::codegen
