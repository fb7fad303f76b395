#include "compiler/codegen/calls/enabled_calls.hpp"

#include "compiler/codegen/calls/builtin_calls.hpp"
#include "compiler/codegen/calls/calls.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/codegen/statements/assignments.hpp"
#include "compiler/semantics/type_table.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// A call whose value nobody wants, because it has none.
void emitAlone(EmitContext &cx, const CallExpr *call) {
  if (call->resolved == Callee::Builtin)
    emitBuiltin(cx, call);
  else
    emitFunctionCall(cx, call, true);
}

} // namespace

void emitEnabledCall(EmitContext &cx, const CallExpr *e) {
  const bool gives = e->type->kind != TypeKind::None;
  const Argument *enabled = e->arguments.size() > 2 ? &e->arguments[2] : nullptr;
  const std::string condition = cx.temporary("enabled");
  const std::string result = gives ? cx.temporary("result") : std::string();
  Found found(cx);
  cx.out << "[&] { const bool " << condition << " = ";
  emitValue(cx, e->arguments[0].value);
  cx.out << "; ";
  if (enabled != nullptr)
    findTarget(cx, found, enabled->value);
  if (gives)
    cx.out << cx.type(e->type) << ' ' << result << "{}; ";
  cx.out << "if (" << condition << ") { ";
  if (gives) {
    cx.out << result << " = ";
    emitValueAs(cx, e->arguments[1].value, e->type);
    cx.out << ';';
  } else {
    emitAlone(cx, as<CallExpr>(e->arguments[1].value));
  }
  cx.out << " }";
  if (enabled != nullptr) {
    cx.out << ' ';
    emitOutputTo(cx, enabled->value, condition, elementaryType(TypeKind::Boolean), enabled->span);
  }
  cx.out << (gives ? " return " + result + "; }()" : " }();");
}

} // namespace stc::codegen
