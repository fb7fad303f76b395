#include "compiler/codegen/calls/builtin_rows.hpp"

#include "compiler/codegen/calls/assertions.hpp"
#include "compiler/codegen/calls/enabled_calls.hpp"
#include "compiler/codegen/calls/instances.hpp"
#include "compiler/codegen/calls/methods.hpp"
#include "compiler/codegen/calls/pool_objects.hpp"
#include "compiler/codegen/expressions/conversions.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/places/own_checks.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// `a, b)` of the arguments from the first on.
void closeWithArguments(EmitContext &cx, const BuiltinCall &call) {
  for (size_t i = 0; i < call.count(); ++i) {
    cx.out << (i > 0 ? ", " : "");
    emitBuiltinArgument(cx, call, i);
  }
  cx.out << ')';
}

/// `name<T>(a, b …)` with the type of the result
void emitOfResult(EmitContext &cx, const BuiltinCall &call, std::string_view name) {
  cx.out << "::stride::" << name << '<' << cx.type(underlying(call.expr->type)) << ">(";
  closeWithArguments(cx, call);
}

/// Overloads for REAL and LREAL: an integer argument must choose one.
void emitMath(EmitContext &cx, const BuiltinCall &call, std::string_view name) {
  const std::string_view type = cx.type(underlying(call.expr->type));
  cx.out << "::stride::" << name;
  for (size_t i = 0; i < call.count(); ++i) {
    cx.out << (i == 0 ? "(" : ", ") << "static_cast<" << type << ">(";
    emitBuiltinArgument(cx, call, i);
    cx.out << ')';
  }
  cx.out << ')';
}

/// The smallest or the largest, as a chain: `max(max(a, b), c)`.
void emitExtreme(EmitContext &cx, const BuiltinCall &call, std::string_view name) {
  const Type *result = underlying(call.expr->type);
  for (size_t i = 1; i < call.count(); ++i) {
    cx.out << "::stride::" << name;
    if (isString(result))
      cx.out << "Text(";
    else
      cx.out << '<' << cx.type(result) << ">(";
  }
  emitBuiltinArgument(cx, call, 0);
  for (size_t i = 1; i < call.count(); ++i) {
    cx.out << ", ";
    emitBuiltinArgument(cx, call, i);
    cx.out << ')';
  }
}

void emitLimit(EmitContext &cx, const BuiltinCall &call, std::string_view name) {
  if (!isString(underlying(call.expr->type))) {
    emitOfResult(cx, call, name);
    return;
  }
  cx.out << "::stride::minText(::stride::maxText(";
  emitBuiltinArgument(cx, call, 1);
  cx.out << ", ";
  emitBuiltinArgument(cx, call, 0);
  cx.out << "), ";
  emitBuiltinArgument(cx, call, 2);
  cx.out << ')';
}

/// All values are computed, from left to right, as braces evaluate them.
void emitMux(EmitContext &cx, const BuiltinCall &call, std::string_view) {
  const Type *result = underlying(call.expr->type);
  const bool number = isInteger(result) || result->kind == TypeKind::Boolean || isReal(result);
  const std::string values = cx.temporary("values");
  cx.out << "[&] { const auto selector__ = ";
  emitBuiltinArgument(cx, call, 0);
  cx.out << "; const " << cx.type(call.expr->type) << ' ' << values << "[] = {";
  for (size_t i = 1; i < call.count(); ++i) {
    cx.out << (i > 1 ? ", " : "");
    if (number)
      cx.out << "static_cast<" << cx.type(result) << ">(";
    emitBuiltinArgument(cx, call, i);
    cx.out << (number ? ")" : "");
  }
  cx.out << "}; return " << values << "[::stride::index<0, " << call.count() - 2 << ">(" << cx.ctx()
         << ", selector__, ";
  cx.position(call.expr->span);
  cx.out << ")]; }()";
}

/// Comparisons of many; `order` is how each argument must relate to the next one.
void emitInOrder(EmitContext &cx, const BuiltinCall &call, std::string_view order) {
  const Type *operands = underlying(call.type(0));
  const bool strings = isString(operands);
  cx.out << "::stride::inOrder([](const auto &a__, const auto &b__) { return ";
  if (strings)
    cx.out << "::stride::compare(a__, b__) " << order << " 0";
  else
    cx.out << "a__ " << order << " b__";
  cx.out << "; }";
  for (size_t i = 0; i < call.count(); ++i) {
    cx.out << ", ";
    if (!strings)
      cx.out << "static_cast<" << cx.type(operands) << ">(";
    emitBuiltinArgument(cx, call, i);
    cx.out << (strings ? "" : ")");
  }
  cx.out << ')';
}

/// The argument as it is.
void emitItself(EmitContext &cx, const BuiltinCall &call, std::string_view) {
  cx.out << '(';
  emitBuiltinArgument(cx, call, 0);
  cx.out << ')';
}

void emitConversion(EmitContext &cx, const BuiltinCall &call, std::string_view name) {
  if (call.type(0) == call.expr->type)
    emitItself(cx, call, name);
  else
    emitConverted(cx, call.type(0), call.expr->type, call.expr->span,
                  [&] { emitBuiltinArgument(cx, call, 0); });
}

/// The cycle's start.
void emitTime(EmitContext &cx, const BuiltinCall &, std::string_view) {
  cx.uses.context = true;
  cx.out << "static_cast<::stride::TIME>(" << kContext << ".cycleStartNs / 1000000)";
}

void emitLongTime(EmitContext &cx, const BuiltinCall &, std::string_view) {
  cx.uses.context = true;
  cx.out << "static_cast<::stride::LTIME>(" << kContext << ".cycleStartNs)";
}

void emitAdr(EmitContext &cx, const BuiltinCall &call, std::string_view) {
  cx.out << (isMisaligned(call.value(0)) ? "reinterpret_cast<::stride::BYTE *>(" : "(");
  emitAddress(cx, call.value(0));
  cx.out << ')';
}

/// A bound of an ARRAY[*]; those of other arrays are constants.
void emitBound(EmitContext &cx, const BuiltinCall &call, std::string_view name) {
  cx.out << "static_cast<::stride::DINT>(";
  emitPlace(cx, call.value(0));
  cx.out << '.' << name << '[' << call.value(1)->constant->integer - 1 << "])";
}

/// What an input declared ANY gets: `value(0)` is the variable's address.
void emitDescribe(EmitContext &cx, const BuiltinCall &call, std::string_view) {
  const Type *variable = typeAs<PointerType>(call.value(0)->type)->pointee;
  cx.includes.complete(call.expr->type);
  cx.includes.complete(variable);
  cx.out << cx.type(call.expr->type) << '{' << std::to_string(typeClassOf(variable))
         << "U, reinterpret_cast<::stride::BYTE *>(";
  emitBuiltinArgument(cx, call, 0);
  cx.out << "), static_cast<::stride::DINT>(sizeof(" << cx.type(variable) << "))}";
}

void emitAtomicAdd(EmitContext &cx, const BuiltinCall &call, std::string_view) {
  cx.out << "__atomic_fetch_add(&";
  emitFollowed(cx, Slot::Reference, call.expr->span, [&] {
    if (call.names.empty())
      emitCheckedPointer(cx, call.value(0));
    else
      cx.out << call.names[0];
  });
  cx.out << ", static_cast<::stride::DINT>(";
  emitBuiltinArgument(cx, call, 1);
  cx.out << "), __ATOMIC_SEQ_CST)";
}

void emitIsValidRef(EmitContext &cx, const BuiltinCall &call, std::string_view) {
  const Expr *reference = call.value(0);
  const VarSymbol *v = indirectVariable(reference);
  if (v == nullptr || v->section != Section::InOut || reference->kind != ExprKind::Name) {
    cx.out << '(';
    emitSlot(cx, reference);
    cx.out << " != nullptr)";
  } else if (cx.pou->isFunction()) {
    cx.out << "true";
  } else { // its C++ reference is bound only where the in-out is used
    cx.out << "(this->" << pathToBase(blockOf(cx.pou), v->owner) << fieldName(v) << " != nullptr)";
  }
}

void emitAssertion(EmitContext &cx, const BuiltinCall &call, std::string_view demand) {
  const CallExpr *e = call.expr;
  cx.includes.assertion();
  const Type *asserted = assertedType(e);
  const bool texts = asserted != nullptr && isString(asserted);
  std::vector<std::string> arguments;
  for (size_t i = 0; i < call.count(); ++i)
    arguments.push_back(cx.text([&] {
      if (texts || i >= assertedValues(e->builtin)) // a message is a text, too
        emitTextArgument(cx, call, i);
      else
        emitBuiltinArgument(cx, call, i);
    }));
  cx.out << assertionText(e, demand, std::string(cx.ctx()), arguments,
                          cx.text([&] { cx.position(e->span); }));
}

/// What is no more than a call: its arguments are its own matter.
template <void (*emit)(EmitContext &, const CallExpr *)>
void emitCall(EmitContext &cx, const BuiltinCall &call, std::string_view) {
  emit(cx, call.expr);
}

/// By the number of the function.
constexpr BuiltinEmission kEmissions[] = {
#define STC_BUILTIN(enumerator, name, signature, takes, check, fold, does, emit, text) emit,
#include "compiler/semantics/builtins.def"
};

} // namespace

const BuiltinEmission &builtinEmission(Builtin function) {
  return kEmissions[static_cast<size_t>(function)];
}

void emitBuiltinArgument(EmitContext &cx, const BuiltinCall &call, size_t i) {
  if (call.names.empty())
    emitValue(cx, call.value(i));
  else
    cx.out << call.names[i];
}

void emitTextArgument(EmitContext &cx, const BuiltinCall &call, size_t i) {
  if (call.names.empty() && isString(call.value(i)->type))
    emitText(cx, call.value(i));
  else
    emitBuiltinArgument(cx, call, i);
}

void emitTextFunction(EmitContext &cx, const BuiltinCall &call, std::string_view name) {
  const Type *result = underlying(call.expr->type);
  cx.out << "::stride::" << name;
  if (isString(result))
    cx.out << '<' << typeAs<StringType>(result)->length << '>';
  for (size_t i = 0; i < call.count(); ++i) {
    cx.out << (i == 0 ? "(" : ", ");
    emitTextArgument(cx, call, i);
  }
  cx.out << ')';
}

} // namespace stc::codegen
