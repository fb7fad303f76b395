// The declarations of a POU: variables, result, members.

#include "compiler/semantics/declarations/declarations.hpp"

#include "compiler/semantics/classes/classes.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/internal.hpp"
#include "compiler/semantics/types/resolve.hpp"

namespace stc::sema {

using namespace ast;

void declare(Context &c, GlobalsSymbol *globals) {
  for (VarSymbol *v : globals->variables)
    typeOf(c, v);
}

/// Reports a VAR section that the POU cannot have.
static bool mayStandIn(Context &c, const PouSymbol *pou, const VarDecl *v) {
  if (v->section == Section::Global || v->section == Section::Config ||
      v->section == Section::Access) {
    c.report(Code::SectionNotAllowed, v->name.span,
             std::string(v->section == Section::Global ? "VAR_GLOBAL" : "this VAR section") +
                 " cannot stand inside of " + describe(pou),
             "declared here")
        .help("move it out of the POU");
    return false;
  }
  if (v->section == Section::Instance && !pou->isMethod()) {
    c.report(Code::SectionNotAllowed, v->name.span, "VAR_INST is only possible in a METHOD",
             "declared here")
        .help("use VAR: the variables of " + describe(pou) +
              (pou->isFunction() ? " live as long as its call" : " are kept anyway"));
    return false;
  }
  if (pou->isInterface() || (pou->decl->kind == DeclKind::Class && v->section != Section::Local &&
                             v->section != Section::Stat)) {
    c.report(Code::SectionNotAllowed, v->name.span, describe(pou) + " has no such variables",
             "declared here")
        .help(pou->isInterface() ? "declare a PROPERTY" : "use VAR, a METHOD or a PROPERTY");
    return false;
  }
  const bool hasBody =
      pou->decl->kind == DeclKind::FunctionBlock || pou->decl->kind == DeclKind::Program;
  if (v->edge != Edge::None && !hasBody) {
    c.report(Code::SectionNotAllowed, v->name.span,
             "only inputs of a function block or program can be edges", "declared here")
        .help("use R_TRIG or F_TRIG");
    return false;
  }
  return true;
}

/// The variables of a POU by their names; their types come later.
static std::vector<VarSymbol *> declareVariables(Context &c, PouSymbol *pou, Module &home) {
  std::vector<VarSymbol *> variables;
  for (VarDecl *v : pou->decl->variables) {
    if (v->section == Section::External) {
      bindExternal(c, pou, v);
      continue;
    }
    if (!mayStandIn(c, pou, v))
      continue;
    VarSymbol *symbol = makeVariable(c.arena, v, home, pou);
    const auto [it, fresh] = pou->scope.emplace(v->name.id, symbol);
    if (!fresh) {
      auto &d = c.report(Code::DuplicateName, v->name.span,
                         "the name `" + std::string(v->name.text) + "` is declared twice",
                         "declared again here");
      d.label(it->second->name.span, "first declared here");
      continue;
    }
    variables.push_back(symbol);
    for (const Attribute &a : v->attributes) { // a second name of the same variable
      if (a.id == AttributeId::Alias)
        pou->scope.emplace(c.program.interner.intern(a.value), symbol);
    }
  }
  return variables;
}

/// The variable that holds the result of a function or method.
static void declareResult(Context &c, PouSymbol *pou) {
  TypeExpr *returnType = pou->decl->returnType;
  if (pou->property != nullptr && pou->property->get == pou)
    returnType = pou->property->decl->type;
  if ((!pou->isFunction() && !pou->isMethod()) || returnType == nullptr)
    return;
  auto *result = c.arena.make<VarSymbol>();
  result->kind = SymbolKind::Variable;
  result->name = pou->name;
  result->library = pou->library;
  result->owner = pou;
  result->isResult = true;
  const auto [it, fresh] = pou->scope.emplace(pou->name.id, result);
  if (!fresh) {
    auto &d = c.report(Code::DuplicateName, it->second->name.span,
                       "a variable of `" + std::string(pou->name.text) + "` has " +
                           (pou->isMethod() ? "its" : "the function's") + " own name",
                       "this name stands for the result");
    d.label(pou->name.span, pou->isFunction()          ? "the function"
                            : pou->property != nullptr ? "the property"
                                                       : "the method");
  }
  result->type = resolveType(c, returnType, std::string(pou->name.text) + "__result");
  pou->result = result;
}

static void rejectInitOfInOut(Context &c, const VarSymbol *v) {
  if (v->section != Section::InOut || v->decl->init == nullptr)
    return;
  c.report(Code::InOutWithInit, v->decl->init->span,
           "a VAR_IN_OUT variable cannot have an initial value",
           "it always stands for the caller's variable")
      .help("remove the value, or make the variable a VAR_INPUT");
  v->decl->init = nullptr;
}

void declare(Context &c, PouSymbol *pou) {
  if (pou->declared)
    return;
  pou->declared = true;
  link(c, pou);
  if (pou->base != nullptr)
    declare(c, pou->base);
  for (PouSymbol *interface : pou->interfaces)
    declare(c, interface);
  Module &home = c.names.moduleOf(pou);
  const ScopeGuard guard(c, {&home, pou});
  std::vector<VarSymbol *> variables = declareVariables(c, pou, home);
  declareResult(c, pou);
  if (!pou->isMethod())
    declareMembers(c, pou, variables);
  pou->variables = c.arena.copy(variables);
  // Types after names: an array bound may use a constant of the same POU.
  for (VarSymbol *v : variables) {
    typeOf(c, v);
    rejectInitOfInOut(c, v);
  }
  if (!home.library->isUser && (pou->isFunction() || pou->isMethod())) {
    for (VarSymbol *v : variables)
      checkInitOf(c, v); // callers use the default values
  }
}

} // namespace stc::sema
