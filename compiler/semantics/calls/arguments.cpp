// The arguments of calls, and the parameters they go to.

#include "compiler/semantics/calls/calls.hpp"

#include "compiler/semantics/calls/internal.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/suggest.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <unordered_set>

namespace stc::sema {

using namespace ast;

static void checkArgument(Context &c, Argument &argument, VarSymbol *parameter);
static void checkInOut(Context &c, Argument &argument, VarSymbol *parameter);
static void checkOutput(Context &c, Argument &argument, VarSymbol *parameter);
static void reportMissing(Context &c, CallExpr *expr, PouSymbol *pou,
                          const std::unordered_set<VarSymbol *> &given);

namespace {

std::string sectionName(Section section) {
  switch (section) {
  case Section::input:
    return "VAR_INPUT";
  case Section::output:
    return "VAR_OUTPUT";
  case Section::inOut:
    return "VAR_IN_OUT";
  default:
    return "VAR";
  }
}

/// `FUNCTION Sum (a : INT; b : INT) : INT`, shown when arguments do not fit.
std::string signature(const PouSymbol *pou) {
  constexpr std::size_t kMost = 12;
  std::string text;
  std::size_t count = 0;
  for (const VarSymbol *p : pou->parameters()) {
    if (p->hidden || ++count > kMost)
      continue;
    text += text.empty() ? "" : "; ";
    text += p->section == Section::inOut ? "VAR_IN_OUT " : "";
    text += std::string(p->name.text) + (p->section == Section::output ? " => " : " : ") +
            typeName(p->type);
  }
  if (count > kMost)
    text += "; …";
  if (pou->property != nullptr)
    return "PROPERTY " + std::string(pou->name.text) + " : " + typeName(pou->property->type);
  const DeclKind kind = pou->decl->kind;
  if (kind == DeclKind::action || kind == DeclKind::interface || kind == DeclKind::classD)
    return (kind == DeclKind::action      ? "ACTION "
            : kind == DeclKind::interface ? "INTERFACE "
                                          : "CLASS ") +
           std::string(pou->name.text);
  const std::string_view word = kind == DeclKind::function  ? "FUNCTION "
                                : kind == DeclKind::program ? "PROGRAM "
                                : kind == DeclKind::method  ? "METHOD "
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
  const Symbol *symbol = e->kind == ExprKind::name     ? as<NameExpr>(e)->symbol
                         : e->kind == ExprKind::member ? as<MemberExpr>(e)->symbol
                                                       : nullptr;
  return symbol != nullptr && symbol->kind == SymbolKind::enumerator;
}

} // namespace

void bindArguments(Context &c, CallExpr *expr, PouSymbol *pou) {
  const std::vector<VarSymbol *> all = pou->parameters();
  // Positional arguments go to inputs and in-outs, then to outputs, in the order of the
  // declaration.
  std::vector<VarSymbol *> positional;
  for (VarSymbol *p : all) {
    if (p->section != Section::output && !p->hidden)
      positional.push_back(p);
  }
  for (VarSymbol *p : all) {
    if (p->section == Section::output && !p->hidden)
      positional.push_back(p);
  }
  std::unordered_set<VarSymbol *> given;
  bool named = false;
  bool failed = false;
  std::size_t next = 0;
  for (Argument &a : expr->arguments) {
    VarSymbol *parameter = nullptr;
    if (a.name) {
      named = true;
      VarSymbol *found = findVariable(pou, a.name.id);
      if (found != nullptr && (found->owner == nullptr || !derivesFrom(pou, found->owner)))
        found = nullptr;
      if (found != nullptr && !found->isResult && found->section != Section::temp &&
          found->section != Section::local && found->section != Section::stat &&
          found->section != Section::instance)
        parameter = found;
      if (parameter == nullptr) {
        failed = true;
        auto &d = c.report(Code::unknownParameter, a.name.span,
                           "`" + std::string(pou->name.text) + "` has no parameter `" +
                               std::string(a.name.text) + "`",
                           found != nullptr ? "this is private" : "unknown parameter");
        std::vector<std::string_view> names;
        for (const VarSymbol *p : positional)
          names.push_back(p->name.text);
        if (const auto similar = nearest(a.name.text, names); !similar.empty())
          d.suggest("a similar one exists: `" + std::string(similar) + "`", a.name.span,
                    std::string(similar));
        noteSignature(d, pou);
        if (a.value != nullptr)
          check(c, a.value);
        continue;
      }
      const bool isOutput = parameter->section == Section::output;
      if (a.output != isOutput) {
        failed = true;
        auto &d =
            c.report(Code::wrongDirection, a.span,
                     "`" + std::string(a.name.text) + "` is a " + sectionName(parameter->section) +
                         (isOutput ? " and gives a value" : " and takes a value"),
                     isOutput ? "write `=>` here" : "write `:=` here");
        noteDeclaration(d, parameter);
        if (a.value != nullptr) {
          const std::string argument = std::string(a.name.text) + (isOutput ? " => " : " := ") +
                                       std::string(c.program.sources.text(a.value->span));
          d.suggest("write `" + argument + "`", a.span, argument);
        }
        if (a.value != nullptr)
          check(c, a.value);
        continue;
      }
    } else {
      if (named) {
        failed = true;
        auto &d = c.report(Code::mixedArguments, a.span,
                           "a positional argument cannot follow a named one", "name this argument");
        noteSignature(d, pou);
        check(c, a.value);
        continue;
      }
      if (next >= positional.size()) {
        auto &d = c.report(Code::tooManyArguments, a.span,
                           "`" + std::string(pou->name.text) + "` takes " +
                               std::to_string(positional.size()) +
                               (positional.size() == 1 ? " argument" : " arguments"),
                           "one too many");
        noteSignature(d, pou);
        for (std::size_t i = next; i < expr->arguments.size(); ++i) {
          if (expr->arguments[i].value != nullptr)
            check(c, expr->arguments[i].value);
        }
        return;
      }
      parameter = positional[next++];
      a.output = parameter->section == Section::output;
    }
    if (!given.insert(parameter).second) {
      c.report(Code::duplicateArgument, a.span,
               "`" + std::string(parameter->name.text) + "` is given twice", "given again here");
      if (a.value != nullptr)
        check(c, a.value);
      continue;
    }
    checkArgument(c, a, parameter);
  }
  if (!failed)
    reportMissing(c, expr, pou, given);
}

static void checkArgument(Context &c, Argument &argument, VarSymbol *parameter) {
  argument.parameter = parameter;
  if (argument.value == nullptr)
    return; // `Q =>`: not wanted; `IN :=`: keeps its value
  if (parameter->section == Section::inOut)
    checkInOut(c, argument, parameter);
  else if (parameter->section == Section::output)
    checkOutput(c, argument, parameter);
  else if (parameter->type->kind == TypeKind::reference)
    checkReference(c, argument.value, typeAs<PointerType>(parameter->type)->pointee);
  else
    checkAs(c, argument.value, parameter->type,
            "argument `" + std::string(parameter->name.text) + "`");
}

bool refersTo(const Type *type, const Type *wanted) {
  return type == wanted ||
         (isInstance(type) && isInstance(wanted) &&
          derivesFrom(typeAs<PouType>(type)->symbol, typeAs<PouType>(wanted)->symbol));
}

void checkReference(Context &c, Expr *value, const Type *wanted) {
  const Type *type = check(c, value, wanted);
  if (isError(type) || isError(wanted) || !requireVariable(c, value, "refer to"))
    return;
  const bool isBit = isBitPlace(value);
  if (isBit || !refersTo(type, wanted))
    c.report(Code::typeMismatch, value->span,
             "expected a variable of type " + typeName(wanted) + ", found " +
                 (isBit ? "a single bit" : typeName(type)),
             "a reference needs a variable of exactly its type");
  else
    requireAligned(c, value, "refer to");
}

static void checkInOut(Context &c, Argument &argument, VarSymbol *parameter) {
  const Type *type = check(c, argument.value, parameter->type);
  if (isError(type) || isError(parameter->type))
    return;
  const bool constantAllowed = parameter->isConstant;
  if (rejectProperty(c, argument.value, "pass"))
    return;
  if (isBitPlace(argument.value)) {
    const bool part = type->kind != TypeKind::boolean;
    c.report(Code::inOutNotVariable, argument.value->span,
             part ? "a part of a variable cannot be passed to a VAR_IN_OUT"
                  : "a single bit cannot be passed to a VAR_IN_OUT",
             part ? "it has no variable of its own" : "bits have no address")
        .help("copy it into a " + typeName(type) +
              " variable first, and back after the call if it may have changed");
    return;
  }
  const bool isPlace =
      argument.value->kind == ExprKind::name || argument.value->kind == ExprKind::member ||
      argument.value->kind == ExprKind::index || argument.value->kind == ExprKind::deref ||
      argument.value->kind == ExprKind::direct;
  const bool enumerator =
      isPlace && argument.value->constant != nullptr && namedEnumerator(argument.value);
  if (constantAllowed && (!isPlace || enumerator) && type->kind != TypeKind::none &&
      parameter->type->kind != TypeKind::openArray) {
    coerce(c, argument.value, parameter->type,
           "argument `" + std::string(parameter->name.text) + "`"); // it gets a copy
    return;
  }
  if (!isPlace) {
    auto &d =
        c.report(Code::inOutNotVariable, argument.value->span,
                 "the VAR_IN_OUT `" + std::string(parameter->name.text) + "` needs a variable",
                 "this is a value");
    noteDeclaration(d, parameter);
    d.help("store it in a variable first");
    return;
  }
  if (!constantAllowed && !requireVariable(c, argument.value, "pass"))
    return;
  const Type *wanted = parameter->type;
  if (wanted->kind == TypeKind::openArray) {
    if (fitsOpenArray(type, typeAs<OpenArrayType>(wanted)))
      return;
    auto &d = c.report(Code::inOutType, argument.value->span,
                       "the VAR_IN_OUT `" + std::string(parameter->name.text) + "` is " +
                           typeName(wanted) + ", this is " + typeName(type),
                       "elements and number of dimensions must be the same");
    noteDeclaration(d, parameter);
    return;
  }
  const bool anyString = constantAllowed && isString(type) && type->kind == wanted->kind;
  if (!refersTo(type, wanted) && !anyString) {
    auto &d = c.report(Code::inOutType, argument.value->span,
                       "the VAR_IN_OUT `" + std::string(parameter->name.text) + "` is " +
                           typeName(wanted) + ", this is " + typeName(type),
                       "the types must be the same");
    noteDeclaration(d, parameter);
    if (isElementary(type) && isElementary(wanted))
      d.help("copy it into a variable of type " + typeName(wanted) + " first, and back afterwards");
    return;
  }
  requireAligned(c, argument.value, "pass");
}

static void checkOutput(Context &c, Argument &argument, VarSymbol *parameter) {
  Expr *target = argument.value;
  const Type *type = checkTarget(c, target);
  if (isError(type) || isError(parameter->type))
    return;
  if (!requireVariable(c, target, "assign to"))
    return;
  const Conversion conversion = classify(parameter->type, type);
  if (conversion == Conversion::narrowing || conversion == Conversion::forbidden) {
    auto &d = c.report(conversion == Conversion::narrowing ? Code::narrowingConversion
                                                           : Code::typeMismatch,
                       target->span,
                       "the output `" + std::string(parameter->name.text) + "` is " +
                           typeName(parameter->type) + ", this variable is " + typeName(type),
                       "expected " + typeName(parameter->type));
    noteDeclaration(d, parameter);
  } else if (conversion == Conversion::lossy) {
    c.report(Code::lossyConversion, target->span,
             "implicit conversion from " + typeName(parameter->type) + " to " + typeName(type) +
                 " may change the value",
             "the output `" + std::string(parameter->name.text) + "` is " +
                 typeName(parameter->type));
  }
}

static void reportMissing(Context &c, CallExpr *expr, PouSymbol *pou,
                          const std::unordered_set<VarSymbol *> &given) {
  // SUPER^() runs the base's body on the same instance, whose in-outs are bound already.
  const Expr *callee = expr->callee;
  if (callee->kind == ExprKind::deref)
    callee = as<DerefExpr>(callee)->base;
  const bool ofBase =
      callee->kind == ExprKind::name && as<NameExpr>(callee)->name.id->lower == "super";
  std::string missing;
  bool inOut = false;
  std::size_t count = 0;
  for (VarSymbol *p : pou->parameters()) {
    if (given.contains(p) || p->hidden || (ofBase && p->section == Section::inOut))
      continue;
    const bool needed =
        p->section == Section::inOut || ((pou->isFunction() || pou->isMethod()) &&
                                         p->section == Section::input && p->decl->init == nullptr);
    if (!needed)
      continue;
    inOut = inOut || p->section == Section::inOut;
    missing += (missing.empty() ? "`" : ", `") + std::string(p->name.text) + "`";
    ++count;
  }
  if (count == 0)
    return;
  auto &d = c.report(inOut ? Code::missingInOut : Code::missingArgument, expr->span,
                     "the call of `" + std::string(pou->name.text) + "` lacks " + missing,
                     inOut ? "every VAR_IN_OUT needs a variable at each call"
                           : "every input without default needs a value");
  noteSignature(d, pou);
}

} // namespace stc::sema
