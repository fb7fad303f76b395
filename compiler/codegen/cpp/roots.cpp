#include "compiler/codegen/cpp/roots.hpp"

#include "compiler/semantics/hierarchy.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// What a type's name ends with if it is the root's.
std::string_view typeEnd(const Root &root) { return root.isStatic ? "__static__" : ""; }

/// After a root's type, the end of the constant that holds its place.
std::string placeOf(std::string type) {
  if (!type.ends_with("__"))
    type += "__";
  return type + "at__";
}

} // namespace

std::string rootLocalType(Names &names, const Root &root) {
  return std::string(names.local(root.symbol)).append(typeEnd(root));
}

std::string rootType(Names &names, const Root &root) {
  return std::string(names.qualified(root.symbol)).append(typeEnd(root));
}

std::string rootLocalPlace(Names &names, const Root &root) {
  return placeOf(rootLocalType(names, root));
}

std::string rootPlace(Names &names, const Root &root) { return placeOf(rootType(names, root)); }

std::string rootName(Names &names, const Root &root, const Library *own) {
  std::string name;
  if (root.symbol->library != own)
    name = std::string(names.space(root.symbol->library)) + "__";
  if (root.symbol->kind == SymbolKind::Globals)
    return name.append(names.listName(static_cast<const GlobalsSymbol *>(root.symbol)));
  return name.append(names.local(root.symbol)) + (root.isStatic ? "__static" : "__program");
}

bool hasStatics(const PouSymbol *pou) {
  return std::any_of(pou->variables.begin(), pou->variables.end(),
                     [](const VarSymbol *v) { return v->section == Section::Stat; });
}

Root rootOf(const StatePath &path) {
  if (path.root->kind == SymbolKind::Pou)
    return {path.root, false};
  return {static_cast<const VarSymbol *>(path.root)->globals, false};
}

const Type *typeAt(const StatePath &path) {
  const Type *type = path.root->kind == SymbolKind::Pou
                         ? static_cast<const PouSymbol *>(path.root)->type
                         : static_cast<const VarSymbol *>(path.root)->type;
  for (const PathStep &step : path.steps)
    type = step.member != nullptr ? step.member->type : typeAs<ArrayType>(type)->element;
  return type;
}

std::string pathInRoot(const StatePath &path) {
  std::string text;
  const Type *type = nullptr;
  if (path.root->kind == SymbolKind::Variable) {
    text += "." + mangle(path.root->name.text);
    type = static_cast<const VarSymbol *>(path.root)->type;
  } else {
    type = static_cast<const PouSymbol *>(path.root)->type;
  }
  for (const PathStep &step : path.steps) {
    if (step.member == nullptr) {
      text += ".v[" + std::to_string(step.element) + "]";
      type = typeAs<ArrayType>(type)->element;
      continue;
    }
    text += ".";
    if (type->kind == TypeKind::Structure) {
      for (const auto *s = typeAs<StructType>(type); s->base != nullptr; s = s->base) {
        if (std::find(s->fields.begin(), s->fields.end(), step.member) != s->fields.end())
          break;
        text += "base__.";
      }
    }
    if (isInstance(type) && step.member->owner != nullptr)
      text += pathToBase(typeAs<PouType>(type)->symbol, blockOf(step.member->owner));
    text += fieldName(step.member);
    type = step.member->type;
  }
  return text;
}

std::string statePath(Names &names, const StatePath &path, const Library *own) {
  return rootName(names, rootOf(path), own) + pathInRoot(path);
}

std::string copiesLocalPlace(Names &names, const VarSymbol *variable) {
  return rootLocalType(names, {variable->globals, false}) + mangle(variable->name.text) + "__at__";
}

std::string copiesPlace(Names &names, const VarSymbol *variable) {
  return rootType(names, {variable->globals, false}) + mangle(variable->name.text) + "__at__";
}

} // namespace stc::codegen
