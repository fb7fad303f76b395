// Blocks as classes: bases, interfaces and members are looked up.

#include "compiler/semantics/classes/classes.hpp"

#include "compiler/semantics/classes/internal.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/semantics/types/resolve.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

static PouSymbol *makeMethod(Context &c, PouSymbol *owner, PouDecl *decl,
                             PropertySymbol *property) {
  PouSymbol &method = c.program.pouStorage.emplace_back();
  method.kind = SymbolKind::Pou;
  method.name = property != nullptr ? property->name : decl->name;
  method.library = owner->library;
  method.decl = decl;
  method.owner = owner;
  method.property = property;
  method.linked = true;
  owner->methods.push_back(&method);
  return &method;
}

static void makeMembers(Context &c, PouSymbol *pou) {
  const auto add = [&](Symbol *symbol) {
    const auto [it, fresh] = pou->members.emplace(symbol->name.id, symbol);
    if (fresh)
      return;
    auto &d = c.report(Code::DuplicateName, symbol->name.span,
                       "`" + std::string(pou->name.text) + "` has two members `" +
                           std::string(symbol->name.text) + "`",
                       "declared again here");
    d.label(it->second->name.span, "first declared here");
  };
  for (PouDecl *m : pou->decl->methods)
    add(makeMethod(c, pou, m, nullptr));
  for (PouDecl *a : pou->decl->actions)
    add(makeMethod(c, pou, a, nullptr));
  for (PropertyDecl *p : pou->decl->properties) {
    auto *property = c.arena.make<PropertySymbol>();
    property->kind = SymbolKind::Property;
    property->name = p->name;
    property->library = pou->library;
    property->decl = p;
    property->owner = pou;
    if (p->get != nullptr)
      property->get = makeMethod(c, pou, p->get, property);
    if (p->set != nullptr)
      property->set = makeMethod(c, pou, p->set, property);
    pou->properties.push_back(property);
    add(property);
  }
}

static PouSymbol *lookupBase(Context &c, NamePath path, bool interface, const PouSymbol *from) {
  const Name &name = path.back();
  Symbol *symbol = nullptr;
  if (path.size() == 1) {
    symbol = lookupDeclared(c, name);
    if (symbol == nullptr || symbol->kind == SymbolKind::Variable) {
      Symbol *inLibrary = lookupInLibraries(c, name);
      symbol = inLibrary != nullptr ? inLibrary : symbol;
    }
  } else {
    symbol = lookupPath(c, path, true);
    if (symbol == nullptr)
      return nullptr;
  }
  if (symbol == nullptr) {
    reportUnknown(c, name, Sought::Type);
    return nullptr;
  }
  auto *pou = symbol->kind == SymbolKind::Pou ? static_cast<PouSymbol *>(symbol) : nullptr;
  if (pou != nullptr && (interface ? pou->isInterface() : pou->isBlock()))
    return pou;
  auto &d = c.report(interface ? Code::NotAnInterface : Code::WrongBase, name.span,
                     "`" + std::string(name.text) + "` is not " +
                         (interface ? "an interface" : "a function block or class"),
                     "this is " + describe(symbol));
  noteDeclaration(d, symbol);
  if (!interface && pou != nullptr && pou->isInterface())
    d.help("write IMPLEMENTS instead of EXTENDS");
  if (interface && pou != nullptr && pou->isBlock() && !from->isInterface())
    d.help("write EXTENDS to derive from a block");
  return nullptr;
}

/// `other`, which `pou` extends, is just being linked: reports that both extend each other.
static bool isCircle(Context &c, const PouSymbol *pou, const PouSymbol *other, const Name &name) {
  if (!other->linking)
    return false;
  auto &d = c.report(Code::CircularInheritance, name.span,
                     "`" + std::string(pou->name.text) + "` extends itself",
                     other == pou ? "this is the block itself"
                                  : "`" + std::string(other->name.text) + "` extends `" +
                                        std::string(pou->name.text) + "`");
  d.label(other->name.span, "`" + std::string(other->name.text) + "` is declared here");
  return true;
}

static bool isChainTooLong(Context &c, PouSymbol *pou, const PouSymbol *other, const Name &name) {
  if (other->bases < kMaxNesting) {
    pou->bases = std::max(pou->bases, other->bases + 1);
    return false;
  }
  c.report(Code::TooDeep, name.span,
           "`" + std::string(name.text) + "` extends too many others, one after the other",
           "more than " + std::to_string(kMaxNesting));
  return true;
}

static void linkBase(Context &c, PouSymbol *pou) {
  const Name &name = pou->decl->base.back();
  PouSymbol *base = lookupBase(c, pou->decl->base, false, pou);
  if (base != nullptr && !isCircle(c, pou, base, name))
    link(c, base);
  if (base == nullptr || base->linking || isChainTooLong(c, pou, base, name)) {
    pou->lacksParts = true;
    return;
  }
  pou->base = base;
  base->extended = true;
}

static void linkInterfaces(Context &c, PouSymbol *pou) {
  for (NamePath path : pou->decl->interfaces) {
    PouSymbol *interface = lookupBase(c, path, true, pou);
    const bool isNone = interface == nullptr || isCircle(c, pou, interface, path.back());
    if (!isNone)
      link(c, interface);
    if (isNone || isChainTooLong(c, pou, interface, path.back())) {
      pou->lacksParts = true;
      continue;
    }
    if (std::find(pou->interfaces.begin(), pou->interfaces.end(), interface) !=
        pou->interfaces.end())
      c.report(Code::DuplicateName, path.back().span,
               "the interface `" + std::string(path.back().text) + "` is named twice",
               "named again here");
    else
      pou->interfaces.push_back(interface);
  }
}

void link(Context &c, PouSymbol *pou) {
  if (pou->linked)
    return;
  pou->linked = true;
  if (isTooDeep(c, pou->name))
    return;
  pou->linking = true;
  const ScopeGuard guard(c, {&c.names.moduleOf(pou), nullptr, pou->decl});
  makeMembers(c, pou);
  pou->lacksParts = pou->decl->hasGenerics;
  if (!pou->decl->base.empty())
    linkBase(c, pou);
  linkInterfaces(c, pou);
  if (pou->base != nullptr) {
    for (PouSymbol *m : pou->methods) {
      m->overrides = isLifecycle(m) ? nullptr : implementation(pou->base, m);
      for (PouSymbol *o = m->overrides; o != nullptr; o = o->overrides)
        o->overridden = true;
    }
  }
  pou->linking = false;
}

void declareMembers(Context &c, PouSymbol *pou, std::vector<VarSymbol *> &variables) {
  for (PropertySymbol *p : pou->properties) {
    if (p->type == nullptr)
      p->type = resolveType(c, p->decl->type,
                            std::string(pou->name.text) + "__" + std::string(p->name.text));
  }
  for (PouSymbol *m : pou->methods) {
    declare(c, m);
    for (const auto &[id, v] : m->scope) {
      if (v->section == Section::Instance && v->owner == m && v->storage.empty())
        v->storage = c.arena.copy(std::string_view(std::string(m->name.text) +
                                                   (m->property == nullptr  ? "__"
                                                    : m->property->get == m ? "__get__"
                                                                            : "__set__") +
                                                   std::string(v->name.text)));
    }
    for (VarSymbol *v : m->variables) {
      if (v->section == Section::Instance)
        variables.push_back(v);
    }
  }
  // One name, one meaning: in the block itself and along its bases.
  for (const auto &[id, member] : pou->members) {
    const auto own = pou->scope.find(id);
    if (own != pou->scope.end() && own->second->owner == pou) {
      auto &d = c.report(Code::DuplicateName, member->name.span,
                         "`" + std::string(pou->name.text) + "` has a variable and a member `" +
                             std::string(member->name.text) + "`",
                         "declared again here");
      d.label(own->second->name.span, "first declared here");
    }
  }
}

} // namespace stc::sema
