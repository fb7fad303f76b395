// {attribute 'consistent'}: which variables can have it. What it does is decided by the tasks
// (sharing_consistent.cpp).

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/held.hpp"
#include "compiler/semantics/task_access.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

const Attribute *consistentOf(const Attributes &attributes) {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [](const Attribute &a) { return a.name == "consistent"; });
  return found == attributes.end() ? nullptr : &*found;
}

/// Why the attribute does nothing for the variable; empty: it does.
std::string obstacle(const VarSymbol *v) {
  if (v->globals == nullptr)
    return "this is not a variable of a VAR_GLOBAL list";
  if (v->isConstant)
    return "a constant never changes";
  if (v->decl->address != nullptr)
    return "it lies in the process image, of which each task has its own copy";
  if (isScalarValue(v->type))
    return "its value is read and written in one step anyway";
  return isPlainData(v->type) ? "" : "it holds more than values: blocks, references or axes";
}

} // namespace

bool isPlainData(const Type *type) {
  return !anyHeld(type, [](const Type *t, const VarSymbol *v) {
    if ((v != nullptr && v->location != nullptr) || isAxisType(t))
      return Held::found;
    if (t->kind == TypeKind::structure)
      return Held::inside;
    return isScalarValue(t) || isString(t) ? Held::over : Held::found;
  });
}

void Checker::reportConsistent(const Attributes &attributes, const std::string &why) {
  if (const Attribute *a = consistentOf(attributes))
    report(Code::consistentTarget, a->span, "{attribute 'consistent'} does nothing here", why)
        .help("write it in front of a structure, array or text in VAR_GLOBAL that one task writes "
              "and others read");
}

void Checker::checkConsistent(std::span<VarDecl *const> variables) {
  for (const VarDecl *decl : variables) {
    if (consistentOf(decl->attributes) == nullptr)
      continue;
    VarSymbol *v = decl->symbol;
    if (v == nullptr) {
      reportConsistent(decl->attributes, "this declares no variable of its own");
      continue;
    }
    if (v->type == nullptr || v->type->kind == TypeKind::error)
      continue;
    if (const std::string why = obstacle(v); !why.empty())
      reportConsistent(decl->attributes, why);
    else
      v->isConsistent = true;
  }
}

void Checker::checkConsistent(const Decl *decl) {
  if (decl->kind == DeclKind::globals || decl->kind == DeclKind::config ||
      decl->kind == DeclKind::access) {
    reportConsistent(decl->attributes, "it is for a variable, not for a list");
    checkConsistent(as<GlobalsDecl>(decl)->variables);
    return;
  }
  reportConsistent(decl->attributes, "it is for a variable");
  switch (decl->kind) {
  case DeclKind::structure:
    checkConsistent(as<StructDecl>(decl)->fields);
    return;
  case DeclKind::enumeration:
  case DeclKind::alias:
  case DeclKind::configuration:
    return;
  default: {
    const auto *pou = as<PouDecl>(decl);
    checkConsistent(pou->variables);
    for (const PouDecl *method : pou->methods)
      checkConsistent(method);
    for (const PouDecl *action : pou->actions)
      checkConsistent(action);
    return;
  }
  }
}

} // namespace stc
