#include "compiler/semantics/hierarchy.hpp"

#include "compiler/semantics/program.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>
#include <unordered_set>

namespace stc {

namespace {

/// Calls `found` for the interface and those it extends, each once, in the order of the
/// declarations, until it returns true. Interfaces may be reached on many ways.
template <class Found>
bool anyInterface(const PouSymbol *interface, std::unordered_set<const PouSymbol *> &seen,
                  Found &&found) {
  if (!seen.insert(interface).second)
    return false;
  return found(interface) ||
         std::any_of(interface->interfaces.begin(), interface->interfaces.end(),
                     [&](const PouSymbol *i) { return anyInterface(i, seen, found); });
}

} // namespace

bool derivesFrom(const PouSymbol *pou, const PouSymbol *base) {
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    if (p == base)
      return true;
  }
  if (pou == nullptr || !pou->isInterface() || base == nullptr)
    return false;
  std::unordered_set<const PouSymbol *> seen;
  return anyInterface(pou, seen, [&](const PouSymbol *i) { return i == base; });
}

bool implements(const PouSymbol *pou, const PouSymbol *interface) {
  std::unordered_set<const PouSymbol *> seen;
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    for (const PouSymbol *i : p->interfaces) {
      if (anyInterface(i, seen, [&](const PouSymbol *one) { return one == interface; }))
        return true;
    }
  }
  return false;
}

bool convertsTo(const PouSymbol *from, const PouSymbol *to) {
  if (derivesFrom(from, to))
    return true;
  return to->isInterface() && !from->isInterface() && implements(from, to);
}

bool isIncomplete(const PouSymbol *pou) {
  std::unordered_set<const PouSymbol *> seen;
  const auto lacks = [](const PouSymbol *one) { return one->lacksParts; };
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    if (lacks(p))
      return true;
    for (const PouSymbol *i : p->interfaces)
      if (anyInterface(i, seen, lacks))
        return true;
  }
  return false;
}

bool isInside(const PouSymbol *code, const PouSymbol *block) {
  return code != nullptr && block != nullptr && derivesFrom(blockOf(code), blockOf(block));
}

const VarSymbol *foreignLocal(const Symbol *member, const PouSymbol *code) {
  if (member == nullptr || member->kind != SymbolKind::Variable)
    return nullptr;
  const auto *variable = static_cast<const VarSymbol *>(member);
  const bool isPublic = variable->decl != nullptr && variable->decl->access == ast::Access::Public;
  const bool isOwn = variable->section == ast::Section::Local && variable->owner != nullptr &&
                     variable->owner->decl->kind == ast::DeclKind::FunctionBlock;
  return isOwn && !isPublic && !isInside(code, variable->owner) ? variable : nullptr;
}

VarSymbol *findVariable(const PouSymbol *pou, Ident id) {
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    const auto it = p->scope.find(id);
    if (it != p->scope.end() && (p == pou || it->second->section != ast::Section::Temp))
      return it->second;
  }
  return nullptr;
}

Symbol *memberNamed(const PouSymbol *pou, Ident id) {
  Symbol *symbol = nullptr;
  const auto find = [&](const PouSymbol *p) {
    const auto it = p->members.find(id);
    symbol = it == p->members.end() ? nullptr : it->second;
    return symbol != nullptr;
  };
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    if (find(p))
      return symbol;
  }
  std::unordered_set<const PouSymbol *> seen;
  if (pou->isInterface())
    anyInterface(pou, seen, find);
  return symbol;
}

PouSymbol *findMethod(const PouSymbol *pou, Ident id) {
  Symbol *symbol = memberNamed(pou, id);
  return symbol != nullptr && symbol->kind == SymbolKind::Pou ? static_cast<PouSymbol *>(symbol)
                                                              : nullptr;
}

PouSymbol *implementation(const PouSymbol *pou, const PouSymbol *method) {
  if (method->property == nullptr)
    return findMethod(pou, method->name.id);
  // Each accessor by itself: a derived block may replace only one of the two.
  const bool get = method->property->get == method;
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    const auto it = p->members.find(method->property->name.id);
    if (it == p->members.end() || it->second->kind != SymbolKind::Property)
      continue;
    const auto *property = static_cast<const PropertySymbol *>(it->second);
    if (PouSymbol *accessor = get ? property->get : property->set)
      return accessor;
  }
  return nullptr;
}

namespace {

/// It needs a type id, be it its own or its base's.
bool needsTypeId(const PouSymbol *pou) {
  if (!pou->isBlock())
    return false;
  if (pou->base != nullptr || !pou->interfaces.empty())
    return true;
  // The layout of a library's block does not depend on who uses it.
  return pou->library != nullptr && pou->library->isUser
             ? pou->extended || pou->isAbstract()
             : !pou->methods.empty() || pou->isAbstract();
}

} // namespace

bool carriesTypeId(const PouSymbol *pou) {
  return needsTypeId(pou) && (pou->base == nullptr || !hasTypeId(pou->base));
}

bool hasTypeId(const PouSymbol *pou) {
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    if (needsTypeId(p))
      return true;
  }
  return false;
}

const PouSymbol *findInit(const PouSymbol *pou) {
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    for (const PouSymbol *m : p->methods) {
      if (m->property == nullptr && m->name.id->lower == "fb_init")
        return m;
    }
  }
  return nullptr;
}

std::vector<VarSymbol *> constructInputs(const PouSymbol *pou) {
  std::vector<VarSymbol *> list;
  const PouSymbol *init = findInit(pou);
  if (init == nullptr)
    return list;
  for (VarSymbol *v : init->variables) {
    if (v->section == ast::Section::Input && v->name.id->lower != "binitretains" &&
        v->name.id->lower != "bincopycode")
      list.push_back(v);
  }
  return list;
}

std::vector<PouSymbol *> afterInitMethods(const PouSymbol *pou) {
  std::vector<PouSymbol *> list;
  if (pou->base != nullptr)
    list = afterInitMethods(pou->base);
  for (PouSymbol *&inherited : list)
    inherited = implementation(pou, inherited);
  for (PouSymbol *m : pou->methods) {
    if (m->property == nullptr && pou->isBlock() &&
        hasAttribute(m->decl->attributes, ast::AttributeId::CallAfterInit) &&
        std::find(list.begin(), list.end(), m) == list.end())
      list.push_back(m);
  }
  return list;
}

bool isDispatched(const PouSymbol *method) {
  const PouSymbol *owner = method->owner;
  if (!owner->isBlock() || method->isFinal() || owner->isFinal() ||
      method->decl->access == ast::Access::Private || method->name.id->lower == "fb_init" ||
      method->name.id->lower == "fb_exit" || method->name.id->lower == "fb_reinit")
    return false;
  if (!owner->library->isUser)
    return hasTypeId(owner);
  return method->overridden || method->isAbstract();
}

bool isBodyDispatched(const PouSymbol *block) {
  if (block->decl->kind != ast::DeclKind::FunctionBlock || block->isFinal())
    return false;
  return block->library->isUser ? block->extended : hasTypeId(block);
}

namespace {

void collect(const PouSymbol *interface, std::unordered_set<const PouSymbol *> &seen,
             std::vector<PouSymbol *> &methods) {
  if (!seen.insert(interface).second)
    return;
  for (const PouSymbol *base : interface->interfaces)
    collect(base, seen, methods);
  methods.insert(methods.end(), interface->methods.begin(), interface->methods.end());
}

void collectInterfaces(PouSymbol *interface, std::vector<PouSymbol *> &list) {
  if (std::find(list.begin(), list.end(), interface) != list.end())
    return;
  for (PouSymbol *base : interface->interfaces)
    collectInterfaces(base, list);
  list.push_back(interface);
}

} // namespace

std::vector<PouSymbol *> demandedMethods(const PouSymbol *interface) {
  std::unordered_set<const PouSymbol *> seen;
  std::vector<PouSymbol *> methods;
  collect(interface, seen, methods);
  return methods;
}

std::vector<PouSymbol *> allInterfaces(const PouSymbol *pou) {
  std::vector<PouSymbol *> list;
  if (pou->base != nullptr)
    list = allInterfaces(pou->base);
  for (PouSymbol *i : pou->interfaces)
    collectInterfaces(i, list);
  return list;
}

} // namespace stc
