// {attribute 'consistent'}: which variables can have it. What it does is decided by the tasks
// (sharing/consistent.cpp).

#include "compiler/semantics/config/config.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/plain_data.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

namespace {

const Attribute *consistentOf(const Attributes &attributes) {
  return attributeOf(attributes, AttributeId::Consistent);
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

static void reportConsistent(Context &c, const Attributes &attributes, const std::string &why) {
  if (const Attribute *a = consistentOf(attributes))
    c.report(Code::ConsistentTarget, a->span, "{attribute 'consistent'} does nothing here", why)
        .help("write it before a structure, array or text in VAR_GLOBAL that one task writes "
              "and others read");
}

static void checkConsistent(Context &c, std::span<VarDecl *const> variables) {
  for (const VarDecl *decl : variables) {
    if (consistentOf(decl->attributes) == nullptr)
      continue;
    VarSymbol *v = decl->symbol;
    if (v == nullptr) {
      reportConsistent(c, decl->attributes, "this declares no variable of its own");
      continue;
    }
    if (v->type == nullptr || v->type->kind == TypeKind::Error)
      continue;
    if (const std::string why = obstacle(v); !why.empty())
      reportConsistent(c, decl->attributes, why);
    else
      v->isConsistent = true;
  }
}

void checkConsistent(Context &c, const Decl *decl) {
  if (decl->kind == DeclKind::Globals || decl->kind == DeclKind::Config ||
      decl->kind == DeclKind::Access) {
    reportConsistent(c, decl->attributes, "it is for a variable, not for a list");
    checkConsistent(c, as<GlobalsDecl>(decl)->variables);
    return;
  }
  reportConsistent(c, decl->attributes, "it is for a variable");
  switch (decl->kind) {
  case DeclKind::Structure:
    checkConsistent(c, as<StructDecl>(decl)->fields);
    return;
  case DeclKind::Enumeration:
  case DeclKind::Alias:
  case DeclKind::Configuration:
    return;
  default: {
    const auto *pou = as<PouDecl>(decl);
    checkConsistent(c, pou->variables);
    for (const PouDecl *method : pou->methods)
      checkConsistent(c, method);
    for (const PouDecl *action : pou->actions)
      checkConsistent(c, action);
    return;
  }
  }
}

} // namespace stc::sema
