// The arguments of calls, and the parameters they go to.

#include "compiler/semantics/calls/calls.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/calls/internal.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/types/resolve.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/st_text.hpp"

#include <unordered_set>
#include <utility>

namespace stc::sema {

using namespace ast;

static void checkArgument(Context &c, Argument &argument, VarSymbol *parameter);
static void checkInOut(Context &c, Argument &argument, VarSymbol *parameter);
static void checkOutput(Context &c, Argument &argument, VarSymbol *parameter);
static void reportMissing(Context &c, CallExpr *expr, PouSymbol *pou,
                          const std::unordered_set<VarSymbol *> &given, bool inputsOptional);

namespace {

/// `FUNCTION Sum (a : INT; b : INT) : INT`, shown when arguments do not fit.
std::string signature(const PouSymbol *pou) {
  constexpr size_t kMost = 12;
  std::string text;
  size_t count = 0;
  for (const VarSymbol *p : pou->parameters()) {
    if (p->hidden || ++count > kMost)
      continue;
    text += text.empty() ? "" : "; ";
    text += p->section == Section::InOut ? "VAR_IN_OUT " : "";
    text += std::string(p->name.text) + (p->section == Section::Output ? " => " : " : ") +
            typeName(p->type);
  }
  if (count > kMost)
    text += "; …";
  if (pou->property != nullptr)
    return "PROPERTY " + std::string(pou->name.text) + " : " + typeName(pou->property->type);
  const DeclKind kind = pou->decl->kind;
  if (kind == DeclKind::Action || kind == DeclKind::Interface || kind == DeclKind::Class)
    return (kind == DeclKind::Action      ? "ACTION "
            : kind == DeclKind::Interface ? "INTERFACE "
                                          : "CLASS ") +
           std::string(pou->name.text);
  const std::string_view word = kind == DeclKind::Function  ? "FUNCTION "
                                : kind == DeclKind::Program ? "PROGRAM "
                                : kind == DeclKind::Method  ? "METHOD "
                                                            : "FUNCTION_BLOCK ";
  return std::string(word) + std::string(pou->name.text) + " (" + text + ")" +
         (pou->result != nullptr && pou->result->type != nullptr
              ? " : " + typeName(pou->result->type)
              : std::string());
}

} // namespace

/// Shows how the called POU is declared.
static void noteSignature(Diagnostic &d, const PouSymbol *pou) {
  if (pou->name.span.valid() && pou->library->isUser)
    d.label(pou->name.span, "declared here");
  d.note("it is declared as `" + signature(pou) + "`");
}

namespace {

bool namedEnumerator(const Expr *e) {
  const Symbol *symbol = e->kind == ExprKind::Name     ? as<NameExpr>(e)->symbol
                         : e->kind == ExprKind::Member ? as<MemberExpr>(e)->symbol
                                                       : nullptr;
  return symbol != nullptr && symbol->kind == SymbolKind::Enumerator;
}

} // namespace

namespace {

/// A call whose arguments are being given to parameters.
struct Binding {
  CallExpr *expr;
  PouSymbol *pou;
  std::vector<VarSymbol *> positional; ///< inputs and in-outs, then outputs, as they are declared
  std::unordered_set<VarSymbol *> given;
  size_t next = 0;      ///< of `positional`
  bool isNamed = false; ///< an argument had a name, out of the order of `positional`
  bool hasFailed = false;
};

Binding bindingOf(CallExpr *expr, PouSymbol *pou) {
  Binding binding{expr, pou, {}, {}};
  const std::vector<VarSymbol *> all = pou->parameters();
  for (const bool outputs : {false, true}) {
    for (VarSymbol *p : all) {
      if ((p->section == Section::Output) == outputs && !p->hidden)
        binding.positional.push_back(p);
    }
  }
  return binding;
}

bool isParameter(const VarSymbol *v) {
  return !v->isResult && v->section != Section::Temp && v->section != Section::Local &&
         v->section != Section::Stat && v->section != Section::Instance;
}

} // namespace

static void reportUnknownParameter(Context &c, const Binding &binding, const Argument &a,
                                   bool isPrivate) {
  if (!isPrivate && isIncomplete(binding.pou))
    return;
  auto &d = c.report(Code::UnknownParameter, a.name.span,
                     "`" + std::string(binding.pou->name.text) + "` has no parameter `" +
                         std::string(a.name.text) + "`",
                     isPrivate ? "this is private" : "unknown parameter");
  std::vector<std::string_view> names;
  for (const VarSymbol *p : binding.positional)
    names.push_back(p->name.text);
  if (const auto similar = nearest(a.name.text, names); !similar.empty())
    d.suggest("a similar one exists: `" + std::string(similar) + "`", a.name.span,
              std::string(similar));
  noteSignature(d, binding.pou);
}

static void reportWrongDirection(Context &c, const Argument &a, const VarSymbol *parameter) {
  const bool isOutput = parameter->section == Section::Output;
  auto &d = c.report(Code::WrongDirection, a.span,
                     "`" + std::string(a.name.text) + "` is a " +
                         std::string(sectionName(parameter->section)) +
                         (isOutput ? " and gives a value" : " and takes a value"),
                     isOutput ? "write `=>` here" : "write `:=` here");
  noteDeclaration(d, parameter);
  if (a.value != nullptr) {
    const std::string argument = std::string(a.name.text) + (isOutput ? " => " : " := ") +
                                 std::string(c.program.sources.text(a.value->span));
    d.suggest("write `" + argument + "`", a.span, argument);
  }
}

/// The parameter of a named argument; null: there is none (reported).
static VarSymbol *namedParameter(Context &c, Binding &binding, const Argument &a) {
  VarSymbol *found = findVariable(binding.pou, a.name.id);
  if (found != nullptr && (found->owner == nullptr || !derivesFrom(binding.pou, found->owner)))
    found = nullptr;
  const bool fits = found != nullptr && isParameter(found);
  // `F(a := 1, 2)`: what follows is unambiguous as long as the order is that of the declaration.
  const bool isNext =
      binding.next < binding.positional.size() && binding.positional[binding.next] == found;
  binding.next += isNext ? 1 : 0;
  binding.isNamed = binding.isNamed || !isNext;
  if (fits && a.output == (found->section == Section::Output))
    return found;
  binding.hasFailed = true;
  if (fits)
    reportWrongDirection(c, a, found);
  else
    reportUnknownParameter(c, binding, a, found != nullptr);
  if (a.value != nullptr)
    check(c, a.value);
  return nullptr;
}

/// `F(IN = x)`: the input is compared where a value is meant for it.
static bool isComparedParameter(Context &c, const Binding &binding, const Argument &a) {
  if (a.name || a.value == nullptr || a.value->kind != ExprKind::Binary)
    return false;
  const auto *compared = as<BinaryExpr>(a.value);
  if (compared->op != BinaryOp::Equal || compared->left->kind != ExprKind::Name)
    return false;
  const Name &name = as<NameExpr>(compared->left)->name;
  const VarSymbol *own = findVariable(binding.pou, name.id);
  if (own == nullptr || !isParameter(own) || c.names.find(c.scope, name).symbol != nullptr)
    return false;
  const std::string text(name.text);
  c.report(Code::EqualForAssign, compared->opSpan, "`=` compares, it does not assign",
           "expected `:=`")
      .suggest("give `" + text + "` its value with `:=`", compared->opSpan, ":=");
  return true;
}

/// The same of a positional argument.
static VarSymbol *positionalParameter(Context &c, Binding &binding, Argument &a) {
  if (binding.isNamed) {
    binding.hasFailed = true;
    auto &d = c.report(Code::MixedArguments, a.span,
                       "a positional argument cannot follow a named one", "name this argument");
    noteSignature(d, binding.pou);
    check(c, a.value);
    return nullptr;
  }
  VarSymbol *parameter = binding.positional[binding.next++];
  a.output = parameter->section == Section::Output;
  return parameter;
}

static void reportTooMany(Context &c, const Binding &binding, const Argument &a) {
  const size_t count = binding.positional.size();
  auto &d = c.report(Code::TooManyArguments, a.span,
                     "`" + std::string(binding.pou->name.text) + "` takes " +
                         std::to_string(count) + (count == 1 ? " argument" : " arguments"),
                     "one too many");
  noteSignature(d, binding.pou);
  for (const Argument &rest : binding.expr->arguments.subspan(binding.next)) {
    if (rest.value != nullptr)
      check(c, rest.value);
  }
}

void bindArguments(Context &c, CallExpr *expr, PouSymbol *pou) {
  const bool inputsOptional = std::exchange(c.inputsOptional, false); // not of calls in arguments
  Binding binding = bindingOf(expr, pou);
  for (Argument &a : expr->arguments) {
    if (isComparedParameter(c, binding, a)) {
      binding.hasFailed = true;
      check(c, as<BinaryExpr>(a.value)->right);
      continue;
    }
    if (!a.name && !binding.isNamed && binding.next >= binding.positional.size()) {
      reportTooMany(c, binding, a);
      return;
    }
    VarSymbol *parameter =
        a.name ? namedParameter(c, binding, a) : positionalParameter(c, binding, a);
    if (parameter == nullptr)
      continue;
    if (!binding.given.insert(parameter).second) {
      c.report(Code::DuplicateArgument, a.span,
               "`" + std::string(parameter->name.text) + "` is given twice", "given again here");
      if (a.value != nullptr)
        check(c, a.value);
      continue;
    }
    checkArgument(c, a, parameter);
  }
  if (!binding.hasFailed)
    reportMissing(c, expr, pou, binding.given, inputsOptional);
}

static bool namesPlace(const Expr *expr) {
  return expr->kind == ExprKind::Name || expr->kind == ExprKind::Member ||
         expr->kind == ExprKind::Index || expr->kind == ExprKind::Deref ||
         expr->kind == ExprKind::Direct;
}

/// The variable for an input declared ANY becomes what describes it.
static void checkAny(Context &c, Argument &argument, const VarSymbol *parameter) {
  Expr *value = argument.value;
  const Type *type = check(c, value);
  if (isError(type) || type == parameter->type || rejectProperty(c, value, "pass"))
    return; // (an ANY input may be passed on as it is)
  const std::string group(c.program.sources.text(parameter->decl->type->span));
  if (!namesPlace(value) || namedEnumerator(value) || isBitPlace(value) ||
      type->kind == TypeKind::OpenArray) {
    auto &d = c.report(Code::InOutNotVariable, value->span,
                       "the input `" + std::string(parameter->name.text) + "` is " + group +
                           ": it needs a variable",
                       "this has no address");
    noteDeclaration(d, parameter);
    d.help("store it in a variable first");
    return;
  }
  if (!isInGroup(parameter->any, type)) {
    auto &d = c.report(Code::InOutType, value->span,
                       "the input `" + std::string(parameter->name.text) + "` is " + group +
                           ", this is " + typeName(type),
                       "not one of these types");
    noteDeclaration(d, parameter);
    return;
  }
  const auto call = [&](Builtin function, Expr *of, const Type *result) {
    auto *made = c.arena.make<CallExpr>();
    made->span = value->span;
    made->callee = value;
    Argument only;
    only.value = of;
    only.span = of->span;
    made->arguments = c.arena.copy(std::vector<Argument>{only});
    made->resolved = Callee::Builtin;
    made->builtin = function;
    made->type = result;
    return made;
  };
  argument.value =
      call(Builtin::Describe, call(Builtin::Adr, value, c.types.pointer(type)), parameter->type);
}

static void checkArgument(Context &c, Argument &argument, VarSymbol *parameter) {
  argument.parameter = parameter;
  if (argument.value == nullptr)
    return; // `Q =>`: not wanted; `IN :=`: keeps its value
  if (parameter->any != AnyGroup::None)
    checkAny(c, argument, parameter);
  else if (parameter->section == Section::InOut)
    checkInOut(c, argument, parameter);
  else if (parameter->section == Section::Output)
    checkOutput(c, argument, parameter);
  else if (parameter->type->kind == TypeKind::Reference)
    checkReference(c, argument.value, typeAs<PointerType>(parameter->type)->pointee);
  else
    checkAs(c, argument.value, parameter->type,
            "argument `" + std::string(parameter->name.text) + "`");
}

/// A structure that is `base`, or extends it.
static bool extendsStructure(const Type *type, const Type *base) {
  if (type->kind != TypeKind::Structure || base->kind != TypeKind::Structure)
    return false;
  const auto *at = typeAs<StructType>(type);
  if (at->isUnion)
    return false;
  while (at != nullptr && at != base)
    at = at->base;
  return at != nullptr;
}

bool refersTo(const Type *type, const Type *wanted) {
  return type == wanted || extendsStructure(type, wanted) ||
         (isInstance(type) && isInstance(wanted) &&
          derivesFrom(typeAs<PouType>(type)->symbol, typeAs<PouType>(wanted)->symbol));
}

void checkReference(Context &c, Expr *value, const Type *wanted) {
  const Type *type = check(c, value, wanted);
  const bool fromCall = givesReference(value);
  if (isError(type) || isError(wanted) || refersToNothing(c, value, wanted) ||
      (!fromCall && !requireVariable(c, value, "refer to")))
    return;
  const bool isBit = isBitPlace(value);
  if (isBit || !refersTo(type, wanted))
    c.report(Code::TypeMismatch, value->span,
             "expected a variable of type " + typeName(wanted) + ", found " +
                 (isBit ? "a single bit" : typeName(type)),
             "a reference needs a variable of exactly its type");
  else if (!fromCall)
    requireAligned(c, value, "refer to");
}

static void reportBitInOut(Context &c, const Expr *value, const Type *type) {
  const bool part = type->kind != TypeKind::Boolean;
  c.report(Code::InOutNotVariable, value->span,
           part ? "a part of a variable cannot be passed to a VAR_IN_OUT"
                : "a single bit cannot be passed to a VAR_IN_OUT",
           part ? "it has no variable of its own" : "bits have no address")
      .help("copy it into a " + typeName(type) +
            " variable first, and back after the call if it may have changed");
}

static void reportValueInOut(Context &c, const Expr *value, const VarSymbol *parameter) {
  auto &d = c.report(Code::InOutNotVariable, value->span,
                     "the VAR_IN_OUT `" + std::string(parameter->name.text) + "` needs a variable",
                     "this is a value");
  noteDeclaration(d, parameter);
  d.help("store it in a variable first");
}

/// Whether a variable of that type can stand for the parameter; reports when it cannot.
static bool fitsInOut(Context &c, const Expr *value, const Type *type, const VarSymbol *parameter) {
  const Type *wanted = parameter->type;
  const bool open = wanted->kind == TypeKind::OpenArray;
  const bool anyString = parameter->isConstant && isString(type) && type->kind == wanted->kind;
  const bool enumeration = type->kind == TypeKind::Enumeration && !typeAs<EnumType>(type)->strict &&
                           underlying(type) == wanted; // the block may leave any number in it
  if (open ? fitsOpenArray(type, typeAs<OpenArrayType>(wanted))
           : refersTo(type, wanted) || anyString || enumeration)
    return true;
  auto &d = c.report(Code::InOutType, value->span,
                     "the VAR_IN_OUT `" + std::string(parameter->name.text) + "` is " +
                         typeName(wanted) + ", this is " + typeName(type),
                     open ? "elements and number of dimensions must be the same"
                          : "the types must be the same");
  noteDeclaration(d, parameter);
  if (isElementary(type) && isElementary(wanted))
    d.help("copy it into a variable of type " + typeName(wanted) + " first, and back afterwards");
  return false;
}

/// A member of AXIS_REF, which was a REAL in V2.3, for a VAR_IN_OUT : REAL. True: it gets a copy.
static bool copiesAxisField(Context &c, Argument &argument, const Type *type,
                            const VarSymbol *parameter) {
  if (parameter->type->kind != TypeKind::Real || type->kind != TypeKind::Lreal ||
      !isAxisField(argument.value))
    return false;
  argument.copied = true;
  const std::string name(parameter->name.text);
  auto &d = c.report(Code::InOutCopied, argument.value->span,
                     "the VAR_IN_OUT `" + name + "` is REAL, this member of AXIS_REF is LREAL",
                     parameter->isConstant ? "the call gets a copy"
                                           : "the call gets a copy; what it changes goes back");
  noteDeclaration(d, parameter);
  d.help("declare `" + name + "` as LREAL")
      .note("the values of AXIS_REF are LREAL here; in CoDeSys V2.3 they were REAL");
  return true;
}

static const Type *checkForInOut(Context &c, Expr *&value, const Type *type) {
  const ModeGuard named(c.inOutOf, value->kind == ExprKind::Name ? type : nullptr);
  return check(c, value, type);
}

static void checkInOut(Context &c, Argument &argument, VarSymbol *parameter) {
  const Type *type = checkForInOut(c, argument.value, parameter->type);
  if (isError(type) || isError(parameter->type) || rejectProperty(c, argument.value, "pass"))
    return;
  if (isBitPlace(argument.value)) {
    reportBitInOut(c, argument.value, type);
    return;
  }
  const bool openArray = parameter->type->kind == TypeKind::OpenArray;
  const bool place = namesPlace(argument.value);
  const bool enumerator =
      place && argument.value->constant != nullptr && namedEnumerator(argument.value);
  if (parameter->isConstant && (!place || enumerator) && type->kind != TypeKind::None &&
      !openArray) {
    coerce(c, argument.value, parameter->type,
           "argument `" + std::string(parameter->name.text) + "`"); // it gets a copy
    return;
  }
  if (!place) {
    reportValueInOut(c, argument.value, parameter);
    return;
  }
  if (!parameter->isConstant && !requireVariable(c, argument.value, "pass"))
    return;
  if (copiesAxisField(c, argument, type, parameter))
    return;
  if (fitsInOut(c, argument.value, type, parameter) && !openArray)
    requireAligned(c, argument.value, "pass");
}

static void checkOutput(Context &c, Argument &argument, VarSymbol *parameter) {
  Expr *target = argument.value;
  const Type *type = checkTarget(c, target);
  if (isError(type) || isError(parameter->type))
    return;
  if (!requireVariable(c, target, "assign to"))
    return;
  const Conversion conversion =
      narrowsTo(parameter, type) ? Conversion::Free : classify(parameter->type, type);
  if (conversion == Conversion::Narrowing || conversion == Conversion::Forbidden) {
    auto &d = c.report(conversion == Conversion::Narrowing ? Code::NarrowingConversion
                                                           : Code::TypeMismatch,
                       target->span,
                       "the output `" + std::string(parameter->name.text) + "` is " +
                           typeName(parameter->type) + ", this variable is " + typeName(type),
                       "expected " + typeName(parameter->type));
    noteDeclaration(d, parameter);
  } else if (conversion == Conversion::Lossy) {
    c.report(Code::LossyConversion, target->span,
             "implicit conversion from " + typeName(parameter->type) + " to " + typeName(type) +
                 " may change the value",
             "the output `" + std::string(parameter->name.text) + "` is " +
                 typeName(parameter->type));
  }
}

static void reportMissing(Context &c, CallExpr *expr, PouSymbol *pou,
                          const std::unordered_set<VarSymbol *> &given, bool inputsOptional) {
  // SUPER^() runs the base's body on the same instance, whose in-outs are bound already.
  const Expr *callee = expr->callee;
  if (callee->kind == ExprKind::Deref)
    callee = as<DerefExpr>(callee)->base;
  const bool ofBase =
      callee->kind == ExprKind::Name && as<NameExpr>(callee)->name.id->lower == "super";
  std::string missing;
  bool inOut = false;
  size_t count = 0;
  for (VarSymbol *p : pou->parameters()) {
    if (given.contains(p) || p->hidden || (ofBase && p->section == Section::InOut))
      continue;
    const bool needed = p->section == Section::InOut ||
                        (!inputsOptional && (pou->isFunction() || pou->isMethod()) &&
                         p->section == Section::Input && p->decl->init == nullptr);
    if (!needed)
      continue;
    inOut = inOut || p->section == Section::InOut;
    missing += (missing.empty() ? "`" : ", `") + std::string(p->name.text) + "`";
    ++count;
  }
  if (count == 0)
    return;
  auto &d = c.report(inOut ? Code::MissingInOut : Code::MissingArgument, expr->span,
                     "the call of `" + std::string(pou->name.text) + "` lacks " + missing,
                     inOut ? "every VAR_IN_OUT needs a variable at each call"
                           : "every input without default needs a value");
  noteSignature(d, pou);
}

} // namespace stc::sema
