#include "compiler/codegen/calls/builtin_calls.hpp"

#include "compiler/codegen/calls/builtin_rows.hpp"
#include "compiler/codegen/expressions/expressions.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// SEL and MUX compute only the value that is selected, as CODESYS does: `SEL(n = 0, a / n, 0)`.
/// Where that shows, they are no functions.
bool selectsOnly(EmitContext &cx, const CallExpr *e) {
  if ((builtinRow(e->builtin).does & BuiltinRow::kSelects) == 0)
    return false;
  unsigned result = kEffectNone;
  for (size_t i = 1; i < e->arguments.size(); ++i)
    result |= cx.effects(e->arguments[i].value);
  return (result & (kEffectCalls | kEffectRaises | kEffectStrays)) != 0;
}

void emitSelected(EmitContext &cx, const CallExpr *e) {
  const size_t last = e->arguments.size() - 1;
  const bool number = isInteger(underlying(e->type)) || isReal(underlying(e->type));
  cx.out << "[&]() -> " << cx.type(e->type) << " { switch (";
  if ((builtinRow(e->builtin).does & BuiltinRow::kRaises) != 0) { // there may be no such argument
    cx.out << "::stride::index<0, " << last - 1 << ">(" << cx.ctx() << ", ";
    emitValue(cx, e->arguments[0].value);
    cx.out << ", ";
    cx.position(e->span);
  } else {
    cx.out << "static_cast<int>(";
    emitValue(cx, e->arguments[0].value);
  }
  cx.out << ")) {";
  for (size_t i = 1; i <= last; ++i) {
    if (i < last)
      cx.out << " case " << i - 1;
    else
      cx.out << " default";
    cx.out << ": return ";
    if (number)
      cx.out << "static_cast<" << cx.type(e->type) << ">(";
    emitValue(cx, e->arguments[i].value);
    cx.out << (number ? ");" : ";");
  }
  cx.out << " } }()";
}

/// The order of the arguments shows if one of them calls what may change the others, or if two of
/// them may raise an exception. Functions that take other than values order them by themselves.
bool orderShows(EmitContext &cx, const CallExpr *e) {
  if (!builtinRow(e->builtin).readsValues())
    return false;
  unsigned before = kEffectNone;
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr)
      continue;
    const unsigned after = cx.effects(a.value);
    if (Analysis::orderShows(before, after))
      return true;
    before |= after;
  }
  return false;
}

/// The arguments as constants `in__…`, from left to right; gives their names. What nothing changes
/// until the call is not copied.
std::vector<std::string> takeValues(EmitContext &cx, const CallExpr *e) {
  unsigned all = kEffectNone;
  for (const Argument &a : e->arguments)
    all |= cx.effects(a.value);
  std::vector<std::string> names;
  for (const Argument &a : e->arguments) {
    names.push_back(cx.temporary("in"));
    const Type *t = a.value->target != nullptr ? a.value->target : a.value->type;
    cx.out << cx.type(t) << ((all & kEffectCalls) != 0 ? " const " : " const &") << names.back()
           << " = ";
    emitValue(cx, a.value);
    cx.out << "; ";
  }
  return names;
}

/// A call of a function that gives a text; null: the value is none.
const CallExpr *textCall(const Expr *value) {
  if (value->kind != ExprKind::Call || value->constant != nullptr || !isString(value->type))
    return nullptr;
  const auto *call = as<CallExpr>(value);
  return call->resolved == Callee::Builtin &&
                 builtinEmission(call->builtin).emit == emitTextFunction
             ? call
             : nullptr;
}

} // namespace

void emitBuiltin(EmitContext &cx, const CallExpr *e) {
  if (selectsOnly(cx, e)) {
    emitSelected(cx, e);
    return;
  }
  const auto &[emit, argument] = builtinEmission(e->builtin);
  if (!orderShows(cx, e)) {
    emit(cx, {e, {}}, argument);
    return;
  }
  cx.out << "[&] { ";
  const std::vector<std::string> names = takeValues(cx, e);
  cx.out << "return ";
  emit(cx, {e, names}, argument);
  cx.out << "; }()";
}

bool emitStringInto(EmitContext &cx, std::string_view target, const Expr *value) {
  const CallExpr *call = textCall(value);
  if (call == nullptr)
    return false;
  const bool ordered = orderShows(cx, call);
  std::vector<std::string> names;
  cx.out << (ordered ? "{ " : "");
  if (ordered)
    names = takeValues(cx, call);
  cx.out << "::stride::" << builtinEmission(call->builtin).argument << '<'
         << typeAs<StringType>(value->type)->length << ">(" << target;
  for (size_t i = 0; i < call->arguments.size(); ++i) {
    cx.out << ", ";
    emitTextArgument(cx, {call, names}, i);
  }
  cx.out << (ordered ? "); }" : ");");
  return true;
}

} // namespace stc::codegen
