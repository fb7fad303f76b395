// Calls of functions, function blocks and programs.

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/suggest.hpp"

namespace stc {

using namespace ast;

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

void Checker::noteSignature(Diagnostic &d, const PouSymbol *pou) {
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

const Type *Checker::notCallable(CallExpr *expr, std::string message) {
  auto &d = report(Code::notCallable, expr->callee->span, std::move(message), "cannot be called");
  if (expr->callee->kind == ExprKind::name) {
    const auto *name = as<NameExpr>(expr->callee);
    if (name->symbol != nullptr)
      noteDeclaration(d, name->symbol);
    if (builtins_.contains(name->name.id))
      d.help("this variable hides the standard function; give it another name");
  }
  for (Argument &a : expr->arguments) {
    if (a.value != nullptr)
      check(a.value);
  }
  return elementaryType(TypeKind::error);
}

const Type *Checker::checkCall(CallExpr *expr, bool asStatement) {
  followSelf(expr->callee);
  Expr *callee = expr->callee;
  PouSymbol *pou = nullptr;
  // Functions, by plain or library-qualified name.
  if (callee->kind == ExprKind::name) {
    auto *name = as<NameExpr>(callee);
    Symbol *symbol = lookup(name->name);
    if (symbol != nullptr && symbol->kind == SymbolKind::variable &&
        static_cast<VarSymbol *>(symbol)->isResult)
      symbol = static_cast<VarSymbol *>(symbol)->owner; // recursion
    if (symbol == nullptr) {
      if (const auto conversion = findConversion(name->name.id))
        return checkConversionCall(expr, *conversion);
    } else if (symbol->kind == SymbolKind::builtin) {
      name->symbol = symbol;
      expr->resolved = Callee::builtin;
      expr->builtin = static_cast<BuiltinSymbol *>(symbol)->id;
      const Type *type = checkBuiltin(expr, nullptr);
      foldCall(expr, type);
      return type;
    } else if (symbol->kind == SymbolKind::pou) {
      pou = static_cast<PouSymbol *>(symbol);
      name->symbol = symbol;
    }
  } else if (callee->kind == ExprKind::member && as<MemberExpr>(callee)->bit < 0) {
    auto *member = as<MemberExpr>(callee);
    if (Symbol *space = resolveNamespace(member->base); space != nullptr) {
      Symbol *symbol = nameInSpace(space, member->name);
      if (symbol != nullptr && symbol->kind == SymbolKind::pou) {
        pou = static_cast<PouSymbol *>(symbol);
        member->symbol = symbol;
      }
    }
  }
  if (pou != nullptr && (pou->isBlock() || pou->isInterface())) {
    auto &d = report(Code::notCallable, callee->span,
                     "`" + std::string(pou->name.text) + "` is " + describe(pou) +
                         ", not an instance of one",
                     pou->isBlock() ? "a block is called through a variable"
                                    : "only methods of an interface can be called");
    if (pou->decl->kind == DeclKind::functionBlock)
      d.help("declare an instance, `x : " + std::string(pou->name.text) + ";`, and call `x(…)`");
    for (Argument &a : expr->arguments) {
      if (a.value != nullptr && !a.output)
        check(a.value);
    }
    return elementaryType(TypeKind::error);
  }
  if (pou != nullptr && pou->isMethod()) {
    as<NameExpr>(callee)->symbol = pou;
    return checkMethodCall(expr, pou);
  }
  if (pou == nullptr) {
    const Type *base = nullptr;
    if (PouSymbol *method = methodOf(callee, base))
      return checkMethodCall(expr, method);
    const Type *type =
        base != nullptr ? checkMemberOf(as<MemberExpr>(callee), base) : check(callee);
    callee->type = type;
    if (isError(type)) {
      for (Argument &a : expr->arguments) {
        if (a.value != nullptr)
          check(a.value);
      }
      return type;
    }
    if (type->kind == TypeKind::pointer && isInstance(typeAs<PointerType>(type)->pointee))
      return notCallable(expr, "a pointer must be followed before the call: `…^(…)`");
    if (!isInstance(type))
      return notCallable(expr, typeName(type) + " cannot be called");
    pou = typeAs<PouType>(type)->symbol;
    if (pou->decl->kind == DeclKind::classD) {
      report(Code::classCalled, callee->span,
             "`" + std::string(pou->name.text) + "` is a CLASS: its instances cannot be called",
             "a class has no body")
          .help("call one of its methods, or make it a FUNCTION_BLOCK");
      for (Argument &a : expr->arguments) {
        if (a.value != nullptr)
          check(a.value);
      }
      return elementaryType(TypeKind::error);
    }
  }
  declare(pou);
  expr->pou = pou;
  const bool named = callee->kind == ExprKind::name && as<NameExpr>(callee)->symbol == pou;
  if (named && pou->isTemplate) {
    reportTemplate(as<NameExpr>(callee)->name, pou);
    return elementaryType(TypeKind::error);
  }
  switch (pou->decl->kind) {
  case DeclKind::function:
    expr->resolved = Callee::function;
    break;
  case DeclKind::program:
    expr->resolved = named ? Callee::program : Callee::functionBlock; // or an instance of it
    if (named)
      callee->type = pou->type;
    break;
  default:
    expr->resolved = Callee::functionBlock;
    if (callee->kind != ExprKind::deref)
      requireVariable(callee, "call");
    requireAligned(callee, "call");
    break;
  }
  bindArguments(expr, pou);
  if (expr->resolved != Callee::function) {
    if (!asStatement) {
      auto &d = report(Code::blockCallAsValue, expr->span,
                       "the call of `" + std::string(pou->name.text) + "` has no value",
                       "used as a value here");
      d.help("call it in a statement of its own, then read one of its outputs");
      return elementaryType(TypeKind::error);
    }
    return elementaryType(TypeKind::none);
  }
  if (pou->result == nullptr)
    return elementaryType(TypeKind::none);
  const Type *result = pou->result->type;
  return result->kind == TypeKind::reference ? typeAs<PointerType>(result)->pointee : result;
}

void Checker::bindArguments(CallExpr *expr, PouSymbol *pou) {
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
        auto &d = report(Code::unknownParameter, a.name.span,
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
          check(a.value);
        continue;
      }
      const bool isOutput = parameter->section == Section::output;
      if (a.output != isOutput) {
        failed = true;
        auto &d =
            report(Code::wrongDirection, a.span,
                   "`" + std::string(a.name.text) + "` is a " + sectionName(parameter->section) +
                       (isOutput ? " and gives a value" : " and takes a value"),
                   isOutput ? "write `=>` here" : "write `:=` here");
        noteDeclaration(d, parameter);
        if (a.value != nullptr) {
          const std::string argument = std::string(a.name.text) + (isOutput ? " => " : " := ") +
                                       std::string(program_.sources.text(a.value->span));
          d.suggest("write `" + argument + "`", a.span, argument);
        }
        if (a.value != nullptr)
          check(a.value);
        continue;
      }
    } else {
      if (named) {
        failed = true;
        auto &d = report(Code::mixedArguments, a.span,
                         "a positional argument cannot follow a named one", "name this argument");
        noteSignature(d, pou);
        check(a.value);
        continue;
      }
      if (next >= positional.size()) {
        auto &d = report(Code::tooManyArguments, a.span,
                         "`" + std::string(pou->name.text) + "` takes " +
                             std::to_string(positional.size()) +
                             (positional.size() == 1 ? " argument" : " arguments"),
                         "one too many");
        noteSignature(d, pou);
        for (std::size_t i = next; i < expr->arguments.size(); ++i) {
          if (expr->arguments[i].value != nullptr)
            check(expr->arguments[i].value);
        }
        return;
      }
      parameter = positional[next++];
      a.output = parameter->section == Section::output;
    }
    if (!given.insert(parameter).second) {
      report(Code::duplicateArgument, a.span,
             "`" + std::string(parameter->name.text) + "` is given twice", "given again here");
      if (a.value != nullptr)
        check(a.value);
      continue;
    }
    checkArgument(a, parameter);
  }
  if (!failed)
    reportMissing(expr, pou, given);
}

void Checker::checkArgument(Argument &argument, VarSymbol *parameter) {
  argument.parameter = parameter;
  if (argument.value == nullptr)
    return; // `Q =>`: not wanted; `IN :=`: keeps its value
  if (parameter->section == Section::inOut)
    checkInOut(argument, parameter);
  else if (parameter->section == Section::output)
    checkOutput(argument, parameter);
  else if (parameter->type->kind == TypeKind::reference)
    checkReference(argument.value, typeAs<PointerType>(parameter->type)->pointee);
  else
    checkAs(argument.value, parameter->type,
            "argument `" + std::string(parameter->name.text) + "`");
}

/// A variable of type `type` may stand where one of `wanted` is referred to.
bool Checker::refersTo(const Type *type, const Type *wanted) {
  return type == wanted ||
         (isInstance(type) && isInstance(wanted) &&
          derivesFrom(typeAs<PouType>(type)->symbol, typeAs<PouType>(wanted)->symbol));
}

/// A REFERENCE TO input refers to a variable of exactly its type.
void Checker::checkReference(Expr *value, const Type *wanted) {
  const Type *type = check(value, wanted);
  if (isError(type) || isError(wanted) || !requireVariable(value, "refer to"))
    return;
  const bool isBit = isBitPlace(value);
  if (isBit || !refersTo(type, wanted))
    report(Code::typeMismatch, value->span,
           "expected a variable of type " + typeName(wanted) + ", found " +
               (isBit ? "a single bit" : typeName(type)),
           "a reference needs a variable of exactly its type");
  else
    requireAligned(value, "refer to");
}

void Checker::checkInOut(Argument &argument, VarSymbol *parameter) {
  const Type *type = check(argument.value, parameter->type);
  if (isError(type) || isError(parameter->type))
    return;
  const bool constantAllowed = parameter->isConstant;
  if (rejectProperty(argument.value, "pass"))
    return;
  if (isBitPlace(argument.value)) {
    const bool part = type->kind != TypeKind::boolean;
    report(Code::inOutNotVariable, argument.value->span,
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
    coerce(argument.value, parameter->type,
           "argument `" + std::string(parameter->name.text) + "`"); // it gets a copy
    return;
  }
  if (!isPlace) {
    auto &d = report(Code::inOutNotVariable, argument.value->span,
                     "the VAR_IN_OUT `" + std::string(parameter->name.text) + "` needs a variable",
                     "this is a value");
    noteDeclaration(d, parameter);
    d.help("store it in a variable first");
    return;
  }
  if (!constantAllowed && !requireVariable(argument.value, "pass"))
    return;
  const Type *wanted = parameter->type;
  if (wanted->kind == TypeKind::openArray) {
    if (fitsOpenArray(type, typeAs<OpenArrayType>(wanted)))
      return;
    auto &d = report(Code::inOutType, argument.value->span,
                     "the VAR_IN_OUT `" + std::string(parameter->name.text) + "` is " +
                         typeName(wanted) + ", this is " + typeName(type),
                     "elements and number of dimensions must be the same");
    noteDeclaration(d, parameter);
    return;
  }
  const bool anyString = constantAllowed && isString(type) && type->kind == wanted->kind;
  if (!refersTo(type, wanted) && !anyString) {
    auto &d = report(Code::inOutType, argument.value->span,
                     "the VAR_IN_OUT `" + std::string(parameter->name.text) + "` is " +
                         typeName(wanted) + ", this is " + typeName(type),
                     "the types must be the same");
    noteDeclaration(d, parameter);
    if (isElementary(type) && isElementary(wanted))
      d.help("copy it into a variable of type " + typeName(wanted) + " first, and back afterwards");
    return;
  }
  requireAligned(argument.value, "pass");
}

void Checker::checkOutput(Argument &argument, VarSymbol *parameter) {
  Expr *target = argument.value;
  const Type *type = checkTarget(target);
  if (isError(type) || isError(parameter->type))
    return;
  if (!requireVariable(target, "assign to"))
    return;
  const Conversion conversion = classify(parameter->type, type);
  if (conversion == Conversion::narrowing || conversion == Conversion::forbidden) {
    auto &d =
        report(conversion == Conversion::narrowing ? Code::narrowingConversion : Code::typeMismatch,
               target->span,
               "the output `" + std::string(parameter->name.text) + "` is " +
                   typeName(parameter->type) + ", this variable is " + typeName(type),
               "expected " + typeName(parameter->type));
    noteDeclaration(d, parameter);
  } else if (conversion == Conversion::lossy) {
    report(Code::lossyConversion, target->span,
           "implicit conversion from " + typeName(parameter->type) + " to " + typeName(type) +
               " may change the value",
           "the output `" + std::string(parameter->name.text) + "` is " +
               typeName(parameter->type));
  }
}

void Checker::reportMissing(CallExpr *expr, PouSymbol *pou,
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
  auto &d = report(inOut ? Code::missingInOut : Code::missingArgument, expr->span,
                   "the call of `" + std::string(pou->name.text) + "` lacks " + missing,
                   inOut ? "every VAR_IN_OUT needs a variable at each call"
                         : "every input without default needs a value");
  noteSignature(d, pou);
}

} // namespace stc
