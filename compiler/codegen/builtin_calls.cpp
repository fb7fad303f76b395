// Functions that the compiler implements itself.

#include "compiler/codegen/assertions.hpp"
#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// The runtime's name of those whose arguments are simply passed on; empty for the others.
std::string_view runtimeName(Builtin id) {
  switch (id) {
  case Builtin::abs:
    return "abs";
  case Builtin::sqrt:
    return "sqrt";
  case Builtin::ln:
    return "ln";
  case Builtin::log:
    return "log10";
  case Builtin::exp:
    return "exp";
  case Builtin::sin:
    return "sin";
  case Builtin::cos:
    return "cos";
  case Builtin::tan:
    return "tan";
  case Builtin::asin:
    return "asin";
  case Builtin::acos:
    return "acos";
  case Builtin::atan:
    return "atan";
  case Builtin::atan2:
    return "atan2";
  case Builtin::expt:
    return "pow";
  case Builtin::trunc:
    return "truncate";
  case Builtin::min:
    return "min";
  case Builtin::max:
    return "max";
  case Builtin::limit:
    return "limit";
  case Builtin::sel:
    return "sel";
  case Builtin::shl:
    return "shl";
  case Builtin::shr:
    return "shr";
  case Builtin::rol:
    return "rol";
  case Builtin::ror:
    return "ror";
  case Builtin::fromBcd:
    return "fromBcd";
  case Builtin::toBcd:
    return "toBcd";
  case Builtin::isValidBcd:
    return "isValidBcd";
  case Builtin::isValid:
    return "isValid";
  case Builtin::bigEndian:
    return "swapBytes";
  case Builtin::len:
    return "len";
  case Builtin::left:
    return "left";
  case Builtin::right:
    return "right";
  case Builtin::mid:
    return "mid";
  case Builtin::concat:
    return "concat";
  case Builtin::insert:
    return "insert";
  case Builtin::deleteS:
    return "remove";
  case Builtin::replace:
    return "replace";
  case Builtin::find:
    return "find";
  default:
    return {};
  }
}

bool isStringFunction(Builtin id) { return id >= Builtin::len && id <= Builtin::find; }

/// How the next one must relate to each argument of a comparison of many.
std::string_view orderOf(Builtin id) {
  switch (id) {
  case Builtin::greater:
    return " > ";
  case Builtin::greaterEqual:
    return " >= ";
  case Builtin::equal:
    return " == ";
  case Builtin::lessEqual:
    return " <= ";
  case Builtin::less:
    return " < ";
  default:
    return {};
  }
}

bool isMath(Builtin id) { return id >= Builtin::sqrt && id <= Builtin::expt; }

} // namespace

/// SEL and MUX compute only the value that is selected, as CODESYS does: `SEL(n = 0, a / n, 0)`.
bool Emitter::selectedOnly(const CallExpr *e) {
  if (e->builtin != Builtin::sel && e->builtin != Builtin::mux)
    return false;
  unsigned result = effectNone;
  for (std::size_t i = 1; i < e->arguments.size(); ++i)
    result |= effects(e->arguments[i].value);
  if ((result & (effectCalls | effectRaises | effectStrays)) == 0)
    return false;
  const std::size_t last = e->arguments.size() - 1;
  w_ << "[&]() -> " << type(e->type) << " { switch (";
  if (e->builtin == Builtin::mux) {
    w_ << "::stride::index<0, " << last - 1 << ">(" << ctx() << ", ";
    value(e->arguments[0].value);
    w_ << ", ";
    position(e->span);
  } else {
    w_ << "static_cast<int>(";
    value(e->arguments[0].value);
  }
  w_ << ")) {";
  for (std::size_t i = 1; i <= last; ++i) {
    if (i < last)
      w_ << " case " << i - 1;
    else
      w_ << " default";
    w_ << ": return ";
    const bool number = isInteger(underlying(e->type)) || isReal(underlying(e->type));
    if (number)
      w_ << "static_cast<" << type(e->type) << ">(";
    value(e->arguments[i].value);
    w_ << (number ? ");" : ";");
  }
  w_ << " } }()";
  return true;
}

/// The order of the arguments shows if one of them calls what may change the others, or if two of
/// them may raise an exception.
bool Emitter::ordersArguments(const CallExpr *e) {
  unsigned before = effectNone;
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr || e->builtin == Builtin::adr || e->builtin == Builtin::isValidRef ||
        e->builtin == Builtin::lowerBound || e->builtin == Builtin::upperBound ||
        e->builtin == Builtin::queryInterface || e->builtin == Builtin::queryPointer)
      continue;
    const unsigned after = effects(a.value);
    if (Analysis::orderShows(before, after))
      return true;
    before |= after;
  }
  return false;
}

void Emitter::builtin(const CallExpr *e) {
  if (e->builtin == Builtin::newT) {
    newObject(e);
    return;
  }
  if (e->builtin == Builtin::ini) {
    reinitialise(e);
    return;
  }
  if (selectedOnly(e))
    return;
  if (ordersArguments(e))
    orderedBuiltin(e);
  else
    builtinPlain(e, nullptr);
}

/// The arguments as constants `in__…`, from left to right; gives their names. What nothing changes
/// until the call is not copied.
std::vector<std::string> Emitter::takeArguments(const CallExpr *e) {
  unsigned all = effectNone;
  for (const Argument &a : e->arguments)
    all |= effects(a.value);
  std::vector<std::string> names;
  for (const Argument &a : e->arguments) {
    names.push_back(temporary("in"));
    const Type *t = a.value->target != nullptr ? a.value->target : a.value->type;
    w_ << type(t) << ((all & effectCalls) != 0 ? " const " : " const &") << names.back() << " = ";
    value(a.value);
    w_ << "; ";
  }
  return names;
}

/// `target := CONCAT(…)` without a copy in between; false for other values.
bool Emitter::stringInto(std::string_view target, const Expr *value) {
  if (value->kind != ExprKind::call || value->constant != nullptr || !isString(value->type))
    return false;
  const auto *call = as<CallExpr>(value);
  if (call->resolved != Callee::builtin || !isStringFunction(call->builtin))
    return false;
  const bool ordered = ordersArguments(call);
  std::vector<std::string> names;
  w_ << (ordered ? "{ " : "");
  if (ordered)
    names = takeArguments(call);
  w_ << "::stride::" << runtimeName(call->builtin) << '<' << typeAs<StringType>(value->type)->length
     << ">(" << target;
  for (std::size_t i = 0; i < call->arguments.size(); ++i) {
    w_ << ", ";
    builtinArgument(call, i, ordered ? &names : nullptr, true);
  }
  w_ << (ordered ? "); }" : ");");
  return true;
}

void Emitter::orderedBuiltin(const CallExpr *e) {
  w_ << "[&] { ";
  const std::vector<std::string> names = takeArguments(e);
  w_ << "return ";
  builtinPlain(e, &names);
  w_ << "; }()";
}

void Emitter::builtinArgument(const CallExpr *e, std::size_t i,
                              const std::vector<std::string> *names, bool anyText) {
  const Expr *v = e->arguments[i].value;
  if (names != nullptr)
    w_ << (*names)[i];
  else if (anyText && isString(v->type))
    text(v);
  else
    value(v);
}

void Emitter::builtinPlain(const CallExpr *e, const std::vector<std::string> *names) {
  const std::size_t count = e->arguments.size();
  const auto argument = [&](std::size_t i) { builtinArgument(e, i, names, false); };
  const auto rest = [&](std::size_t from, bool anyText) {
    for (std::size_t i = from; i < count; ++i) {
      if (i > from)
        w_ << ", ";
      builtinArgument(e, i, names, anyText);
    }
    w_ << ')';
  };
  if (isAssertion(e->builtin)) {
    includes_.assertion();
    const auto cut = [&](auto write) {
      const std::size_t start = w_.size();
      write();
      return w_.cut(start);
    };
    const Type *asserted = assertedType(e);
    const bool texts = asserted != nullptr && isString(asserted);
    std::vector<std::string> arguments;
    for (std::size_t i = 0; i < count; ++i)
      arguments.push_back(
          cut([&] { builtinArgument(e, i, names, texts || i >= assertedValues(e->builtin)); }));
    w_ << assertionText(e, std::string(ctx()), arguments, cut([&] { position(e->span); }));
    return;
  }
  const Type *result = underlying(e->type);
  switch (e->builtin) {
  case Builtin::min:
  case Builtin::max: { // a chain: MAX(MAX(a, b), c)
    const bool strings = isString(result);
    for (std::size_t i = 1; i < count; ++i) {
      w_ << "::stride::" << runtimeName(e->builtin);
      if (strings)
        w_ << "Text(";
      else
        w_ << '<' << type(result) << ">(";
    }
    argument(0);
    for (std::size_t i = 1; i < count; ++i) {
      w_ << ", ";
      argument(i);
      w_ << ')';
    }
    return;
  }
  case Builtin::limit:
    if (isString(result)) {
      w_ << "::stride::minText(::stride::maxText(";
      argument(1);
      w_ << ", ";
      argument(0);
      w_ << "), ";
      argument(2);
      w_ << ')';
      return;
    }
    break;
  case Builtin::mux: { // braces evaluate from left to right
    const std::string values = temporary("values");
    w_ << "[&] { const auto selector__ = ";
    argument(0);
    w_ << "; const " << type(e->type) << ' ' << values << "[] = {";
    for (std::size_t i = 1; i < count; ++i) {
      w_ << (i > 1 ? ", " : "");
      const bool number = isInteger(result) || result->kind == TypeKind::boolean || isReal(result);
      if (number)
        w_ << "static_cast<" << type(result) << ">(";
      argument(i);
      if (number)
        w_ << ')';
    }
    w_ << "}; return " << values << "[::stride::index<0, " << count - 2 << ">(" << ctx()
       << ", selector__, ";
    position(e->span);
    w_ << ")]; }()";
    return;
  }
  case Builtin::greater:
  case Builtin::greaterEqual:
  case Builtin::equal:
  case Builtin::lessEqual:
  case Builtin::less: {
    const Type *operands =
        underlying(e->arguments[0].value->target != nullptr ? e->arguments[0].value->target
                                                            : e->arguments[0].value->type);
    const bool strings = isString(operands);
    w_ << "::stride::inOrder([](const auto &a__, const auto &b__) { return ";
    if (strings)
      w_ << "::stride::compare(a__, b__)" << orderOf(e->builtin) << '0';
    else
      w_ << "a__" << orderOf(e->builtin) << "b__";
    w_ << "; }";
    for (std::size_t i = 0; i < count; ++i) {
      w_ << ", ";
      if (!strings)
        w_ << "static_cast<" << type(operands) << ">(";
      argument(i);
      if (!strings)
        w_ << ')';
    }
    w_ << ')';
    return;
  }
  case Builtin::littleEndian:
  case Builtin::move:
    w_ << '(';
    argument(0);
    w_ << ')';
    return;
  case Builtin::convert: {
    const Expr *v = e->arguments[0].value;
    const Type *from = v->target != nullptr ? v->target : v->type;
    if (from == e->type) {
      w_ << '(';
      argument(0);
      w_ << ')';
      return;
    }
    converted(from, e->type, e->span, [&] { argument(0); });
    return;
  }
  case Builtin::time:
    needContext();
    w_ << "static_cast<::stride::TIME>(" << kContext << ".cycleStartNs / 1000000)";
    return;
  case Builtin::ltime:
    needContext();
    w_ << "static_cast<::stride::LTIME>(" << kContext << ".cycleStartNs)";
    return;
  case Builtin::queryInterface:
  case Builtin::queryPointer:
    query(e);
    return;
  case Builtin::adr: {
    const bool misaligned = isMisaligned(e->arguments[0].value);
    w_ << (misaligned ? "reinterpret_cast<::stride::BYTE *>(" : "(");
    address(e->arguments[0].value);
    w_ << ')';
    return;
  }
  case Builtin::lowerBound:
  case Builtin::upperBound: // of ARRAY[*]; the others are constants
    w_ << "static_cast<::stride::DINT>(";
    place(e->arguments[0].value);
    w_ << (e->builtin == Builtin::lowerBound ? ".lo[" : ".hi[")
       << e->arguments[1].value->constant->integer - 1 << "])";
    return;
  case Builtin::isValidRef: {
    const Expr *reference = e->arguments[0].value;
    const VarSymbol *v = indirectVariable(reference);
    if (v != nullptr && v->section == Section::inOut && reference->kind == ExprKind::name) {
      // Its C++ reference is bound only where the in-out is used.
      if (pou_->isFunction())
        w_ << "true";
      else
        w_ << "(this->" << pathToBase(blockOf(pou_), v->owner) << fieldName(v) << " != nullptr)";
      return;
    }
    w_ << '(';
    slot(reference);
    w_ << " != nullptr)";
    return;
  }
  default:
    break;
  }
  w_ << "::stride::" << runtimeName(e->builtin);
  if (isStringFunction(e->builtin)) {
    if (isString(result))
      w_ << '<' << typeAs<StringType>(result)->length << '>';
    w_ << '(';
    rest(0, true);
    return;
  }
  if (isMath(e->builtin)) { // overloads for REAL and LREAL: an integer argument must choose one
    for (std::size_t i = 0; i < count; ++i) {
      w_ << (i == 0 ? "(" : ", ") << "static_cast<" << type(result) << ">(";
      argument(i);
      w_ << ')';
    }
    w_ << ')';
    return;
  }
  w_ << '<' << type(result) << ">(";
  rest(0, false);
}

} // namespace stc::codegen
