// Blocks as classes: bases, interfaces, members, and whether they fit together.

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/suggest.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>
#include <map>

namespace stc {

using namespace ast;

namespace {

bool isSpecial(const PouSymbol *method, std::string_view lower) {
  return method->property == nullptr && method->name.id->lower == lower;
}

/// FB_Init, FB_Exit, FB_Reinit: run by themselves, base and derived; they replace nothing.
bool isLifecycle(const PouSymbol *method) {
  return isSpecial(method, "fb_init") || isSpecial(method, "fb_exit") ||
         isSpecial(method, "fb_reinit");
}

std::string_view accessName(Access access) {
  switch (access) {
  case Access::privateA:
    return "PRIVATE";
  case Access::protectedA:
    return "PROTECTED";
  case Access::internalA:
    return "INTERNAL";
  default:
    return "PUBLIC";
  }
}

/// How far a member can be seen: less is less.
int reach(Access access) {
  switch (access) {
  case Access::privateA:
    return 0;
  case Access::protectedA:
    return 1;
  case Access::internalA:
    return 2;
  default:
    return 3;
  }
}

std::string sectionWord(const VarSymbol *v) {
  std::string word = v->section == Section::input    ? "VAR_INPUT"
                     : v->section == Section::output ? "VAR_OUTPUT"
                                                     : "VAR_IN_OUT";
  if (v->isConstant)
    word += " CONSTANT";
  return word;
}

/// `METHOD Area : LREAL (VAR_INPUT scale : LREAL)`
std::string signatureText(const PouSymbol *method) {
  if (method->property != nullptr)
    return "PROPERTY " + std::string(method->property->name.text) + " : " +
           (method->property->type == nullptr ? "?" : typeName(method->property->type)) +
           (method->property->get == method ? " (GET)" : " (SET)");
  if (method->decl->kind == DeclKind::action)
    return "ACTION " + std::string(method->name.text);
  std::string text = "METHOD " + std::string(method->name.text);
  if (method->result != nullptr)
    text += " : " + typeName(method->result->type);
  std::string parameters;
  for (const VarSymbol *p : method->parameters()) {
    parameters += parameters.empty() ? "" : "; ";
    parameters += sectionWord(p) + " " + std::string(p->name.text) + " : " + typeName(p->type);
  }
  return parameters.empty() ? text : text + " (" + parameters + ")";
}

bool sameSignature(const PouSymbol *a, const PouSymbol *b) {
  const Type *ra = a->result == nullptr ? nullptr : a->result->type;
  const Type *rb = b->result == nullptr ? nullptr : b->result->type;
  if (ra != rb)
    return (ra != nullptr && isError(ra)) || (rb != nullptr && isError(rb));
  const auto pa = a->parameters();
  const auto pb = b->parameters();
  if (pa.size() != pb.size())
    return false;
  for (std::size_t i = 0; i < pa.size(); ++i) {
    if (isError(pa[i]->type) || isError(pb[i]->type))
      continue;
    if (pa[i]->section != pb[i]->section || pa[i]->type != pb[i]->type ||
        pa[i]->isConstant != pb[i]->isConstant ||
        (pa[i]->name.id != pb[i]->name.id && a->property == nullptr))
      return false;
  }
  return true;
}

std::string memberName(const PouSymbol *method) {
  return std::string(method->owner->name.text) + "." +
         std::string(method->property != nullptr ? method->property->name.text : method->name.text);
}

} // namespace

// ---------------------------------------------------------------------------------------------
// bases and members

PouSymbol *Checker::makeMethod(PouSymbol *owner, PouDecl *decl, PropertySymbol *property) {
  PouSymbol &method = program_.pouStorage.emplace_back();
  method.kind = SymbolKind::pou;
  method.name = property != nullptr ? property->name : decl->name;
  method.library = owner->library;
  method.decl = decl;
  method.owner = owner;
  method.property = property;
  method.linked = true;
  owner->methods.push_back(&method);
  return &method;
}

void Checker::makeMembers(PouSymbol *pou) {
  const auto add = [&](Symbol *symbol) {
    const auto [it, fresh] = pou->members.emplace(symbol->name.id, symbol);
    if (fresh)
      return;
    auto &d = report(Code::duplicateName, symbol->name.span,
                     "`" + std::string(pou->name.text) + "` has two members `" +
                         std::string(symbol->name.text) + "`",
                     "declared again here");
    d.label(it->second->name.span, "first declared here");
  };
  for (PouDecl *m : pou->decl->methods)
    add(makeMethod(pou, m, nullptr));
  for (PouDecl *a : pou->decl->actions)
    add(makeMethod(pou, a, nullptr));
  for (PropertyDecl *p : pou->decl->properties) {
    auto *property = arena_.make<PropertySymbol>();
    property->kind = SymbolKind::property;
    property->name = p->name;
    property->library = pou->library;
    property->decl = p;
    property->owner = pou;
    if (p->get != nullptr)
      property->get = makeMethod(pou, p->get, property);
    if (p->set != nullptr)
      property->set = makeMethod(pou, p->set, property);
    pou->properties.push_back(property);
    add(property);
  }
}

PouSymbol *Checker::lookupBase(NamePath path, bool interface, const PouSymbol *from) {
  const Name &name = path.back();
  Symbol *symbol = nullptr;
  if (path.size() == 1) {
    symbol = lookupDeclared(name);
    if (symbol == nullptr || symbol->kind == SymbolKind::variable) {
      Symbol *inLibrary = lookupInLibraries(name.id);
      symbol = inLibrary != nullptr ? inLibrary : symbol;
    }
  } else {
    symbol = lookupPath(path, true);
    if (symbol == nullptr)
      return nullptr;
  }
  if (symbol == nullptr) {
    reportUnknown(name, true);
    return nullptr;
  }
  auto *pou = symbol->kind == SymbolKind::pou ? static_cast<PouSymbol *>(symbol) : nullptr;
  if (pou != nullptr && (interface ? pou->isInterface() : pou->isBlock()))
    return pou;
  auto &d = report(interface ? Code::notAnInterface : Code::wrongBase, name.span,
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

void Checker::link(PouSymbol *pou) {
  if (pou->linked)
    return;
  pou->linked = true;
  if (isTooDeep(pou->name))
    return;
  pou->linking = true;
  const ScopeGuard guard(*this, {&moduleOf(pou), nullptr, pou->decl});
  makeMembers(pou);
  const auto circle = [&](PouSymbol *other, const Name &name) {
    if (!other->linking)
      return false;
    auto &d = report(Code::circularInheritance, name.span,
                     "`" + std::string(pou->name.text) + "` extends itself",
                     other == pou ? "this is the block itself"
                                  : "`" + std::string(other->name.text) + "` extends `" +
                                        std::string(pou->name.text) + "`");
    d.label(other->name.span, "`" + std::string(other->name.text) + "` is declared here");
    return true;
  };
  const auto isChainTooLong = [&](const PouSymbol *other, const Name &name) {
    if (other->bases < kMaxNesting) {
      pou->bases = std::max(pou->bases, other->bases + 1);
      return false;
    }
    report(Code::tooDeep, name.span,
           "`" + std::string(name.text) + "` extends too many others, one after the other",
           "more than " + std::to_string(kMaxNesting));
    return true;
  };
  if (!pou->decl->base.empty()) {
    PouSymbol *base = lookupBase(pou->decl->base, false, pou);
    if (base != nullptr && !circle(base, pou->decl->base.back()))
      link(base);
    if (base != nullptr && !base->linking && !isChainTooLong(base, pou->decl->base.back())) {
      pou->base = base;
      base->extended = true;
    }
  }
  for (NamePath path : pou->decl->interfaces) {
    PouSymbol *interface = lookupBase(path, true, pou);
    if (interface == nullptr || circle(interface, path.back()))
      continue;
    link(interface);
    if (isChainTooLong(interface, path.back()))
      continue;
    if (std::find(pou->interfaces.begin(), pou->interfaces.end(), interface) !=
        pou->interfaces.end())
      report(Code::duplicateName, path.back().span,
             "the interface `" + std::string(path.back().text) + "` is named twice",
             "named again here");
    else
      pou->interfaces.push_back(interface);
  }
  if (pou->base != nullptr) {
    for (PouSymbol *m : pou->methods) {
      m->overrides = isLifecycle(m) ? nullptr : implementation(pou->base, m);
      for (PouSymbol *o = m->overrides; o != nullptr; o = o->overrides)
        o->overridden = true;
    }
  }
  pou->linking = false;
}

void Checker::declareMembers(PouSymbol *pou, std::vector<VarSymbol *> &variables) {
  for (PropertySymbol *p : pou->properties) {
    if (p->type == nullptr)
      p->type = resolveType(p->decl->type,
                            std::string(pou->name.text) + "__" + std::string(p->name.text));
  }
  for (PouSymbol *m : pou->methods) {
    declare(m);
    for (const auto &[id, v] : m->scope) {
      if (v->section == Section::instance && v->owner == m && v->storage.empty())
        v->storage = arena_.copy(std::string_view(std::string(m->name.text) +
                                                  (m->property == nullptr  ? "__"
                                                   : m->property->get == m ? "__get__"
                                                                           : "__set__") +
                                                  std::string(v->name.text)));
    }
    for (VarSymbol *v : m->variables) {
      if (v->section == Section::instance)
        variables.push_back(v);
    }
  }
  // One name, one meaning: in the block itself and along its bases.
  for (const auto &[id, member] : pou->members) {
    const auto own = pou->scope.find(id);
    if (own != pou->scope.end() && own->second->owner == pou) {
      auto &d = report(Code::duplicateName, member->name.span,
                       "`" + std::string(pou->name.text) + "` has a variable and a member `" +
                           std::string(member->name.text) + "`",
                       "declared again here");
      d.label(own->second->name.span, "first declared here");
    }
  }
}

// ---------------------------------------------------------------------------------------------
// checks

void Checker::checkClass(PouSymbol *pou) {
  if (pou->base == nullptr && pou->interfaces.empty() && pou->methods.empty() &&
      (pou->decl->modifiers & (modAbstract | modFinal)) == 0)
    return;
  const ScopeGuard guard(*this, {&moduleOf(pou), pou});
  if (pou->isAbstract() && pou->isFinal())
    report(Code::modifierNotAllowed, pou->name.span,
           "`" + std::string(pou->name.text) + "` cannot be ABSTRACT and FINAL",
           "nobody could ever make an instance of it");
  if (pou->base != nullptr && pou->base->isFinal()) {
    auto &d =
        report(Code::finalBase, pou->decl->base.back().span,
               "`" + std::string(pou->base->name.text) + "` is FINAL", "it cannot be extended");
    noteDeclaration(d, pou->base);
  }
  checkNameClashes(pou);
  for (PouSymbol *m : pou->methods)
    checkMethod(m);
  if (pou->isInterface()) {
    checkInterfaceBases(pou);
    return;
  }
  checkInterfaces(pou);
  checkAbstractMethods(pou);
}

void Checker::checkNameClashes(PouSymbol *pou) {
  if (pou->base == nullptr)
    return;
  const auto clash = [&](const Symbol *own, const Symbol *inherited, const PouSymbol *where) {
    auto &d =
        report(Code::inheritedName, own->name.span,
               "`" + std::string(where->name.text) + "`, which `" + std::string(pou->name.text) +
                   "` extends, has `" + std::string(own->name.text) + "` already",
               "this name is taken");
    d.label(inherited->name.span, "inherited from here");
    d.help("give it another name");
  };
  const auto where = [](const Symbol *s) -> const PouSymbol * {
    if (s->kind == SymbolKind::variable)
      return static_cast<const VarSymbol *>(s)->owner;
    if (s->kind == SymbolKind::property)
      return static_cast<const PropertySymbol *>(s)->owner;
    return static_cast<const PouSymbol *>(s)->owner;
  };
  for (VarSymbol *v : pou->variables) {
    if (v->owner != pou)
      continue;
    const Symbol *inherited = findVariable(pou->base, v->name.id);
    if (inherited == nullptr)
      inherited = memberNamed(pou->base, v->name.id);
    if (inherited != nullptr && where(inherited) != nullptr)
      clash(v, inherited, where(inherited));
  }
  for (const auto &[id, member] : std::map<std::string_view, Symbol *>([&] {
         std::map<std::string_view, Symbol *> sorted;
         for (const auto &[key, symbol] : pou->members)
           sorted.emplace(key->lower, symbol);
         return sorted;
       }())) {
    const Symbol *inherited = findVariable(pou->base, member->name.id);
    const Symbol *other = memberNamed(pou->base, member->name.id);
    if (inherited == nullptr && other != nullptr && other->kind != member->kind)
      inherited = other; // a method where the base has a property
    if (inherited != nullptr && where(inherited) != nullptr)
      clash(member, inherited, where(inherited));
  }
}

void Checker::checkMethod(PouSymbol *method) {
  PouSymbol *owner = method->owner;
  const std::string name(method->name.text);
  const Span at = method->name.span;
  if (isLifecycle(method) && owner->isBlock())
    checkLifecycle(method);
  if (owner->isInterface())
    return;
  if (method->isAbstract() && !method->decl->body.empty())
    report(Code::modifierNotAllowed, at, "the ABSTRACT method `" + name + "` has a body",
           "an abstract method has none")
        .help("remove the statements, or the word ABSTRACT");
  if (method->isAbstract() && !owner->isAbstract() && owner->isBlock()) {
    auto &d =
        report(Code::abstractInConcrete, at,
               "`" + name + "` is ABSTRACT, but `" + std::string(owner->name.text) + "` is not",
               "instances would have nothing to run here");
    noteDeclaration(d, owner);
    d.help("declare the block ABSTRACT: `FUNCTION_BLOCK ABSTRACT " + std::string(owner->name.text) +
           "`");
  }
  if (method->isAbstract() && method->isFinal())
    report(Code::modifierNotAllowed, at, "`" + name + "` cannot be ABSTRACT and FINAL",
           "nobody could ever implement it");
  const bool saysOverride = (method->decl->modifiers & modOverride) != 0;
  const PouSymbol *base = method->overrides;
  if (base == nullptr) {
    if (saysOverride && !isLifecycle(method)) {
      auto &d =
          report(Code::nothingOverridden, at,
                 "`" + name + "` is declared OVERRIDE, but there is nothing to override",
                 owner->base == nullptr ? "`" + std::string(owner->name.text) + "` extends no block"
                                        : "no block that `" + std::string(owner->name.text) +
                                              "` extends has this method");
      if (owner->base != nullptr) {
        const auto similar = nearestMethod(owner->base, method->name);
        if (!similar.empty())
          d.help("a similar one exists: `" + similar + "`");
      }
    }
    return;
  }
  if (base->isFinal()) {
    auto &d = report(Code::finalMethod, at, "`" + memberName(base) + "` is FINAL",
                     "it cannot be replaced");
    d.label(base->name.span, "declared FINAL here");
    return;
  }
  const Access own = memberAccess(method);
  const Access inherited = memberAccess(base);
  if (inherited == Access::privateA) {
    auto &d = report(Code::inheritedName, at,
                     "`" + memberName(base) + "` is PRIVATE and cannot be replaced",
                     "this name is taken");
    d.label(base->name.span, "declared PRIVATE here");
    d.help("give it another name, or declare the base's method PROTECTED");
    return;
  }
  if (reach(own) < reach(inherited)) {
    auto &d = report(Code::accessNarrowed, at,
                     "`" + memberName(method) + "` is " + std::string(accessName(own)) + ", `" +
                         memberName(base) + "` is " + std::string(accessName(inherited)),
                     "less visible than what it replaces");
    d.label(base->name.span, "the replaced one");
    d.help("declare it " + std::string(accessName(inherited)));
  }
  if (!sameSignature(method, base)) {
    auto &d = report(Code::overrideMismatch, at,
                     "`" + memberName(method) + "` does not fit `" + memberName(base) +
                         "`, which it replaces",
                     "`" + signatureText(method) + "`");
    d.label(base->name.span, "`" + signatureText(base) + "`");
    d.help("parameters and result must be the same, in the same order");
  }
}

std::string Checker::nearestMethod(const PouSymbol *pou, const Name &name) {
  std::vector<std::string_view> names;
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    for (const PouSymbol *m : p->methods)
      names.push_back(m->name.text);
  }
  return std::string(nearest(name.text, names));
}

Access Checker::memberAccess(const PouSymbol *method) {
  const Access own = method->decl->access;
  if (own != Access::none || method->property == nullptr)
    return own;
  return method->property->decl->access;
}

void Checker::checkInterfaceBases(PouSymbol *pou) {
  // Two bases may demand the same method, but then the same one.
  const std::vector<PouSymbol *> all = demandedMethods(pou);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const bool same = all[i]->name.id == all[k]->name.id &&
                        (all[i]->property == nullptr) == (all[k]->property == nullptr);
      if (!same || (all[i]->property != nullptr &&
                    (all[i]->property->get == all[i]) != (all[k]->property->get == all[k])))
        continue;
      if (sameSignature(all[i], all[k]))
        continue;
      auto &d = report(Code::overrideMismatch, pou->name.span,
                       "`" + memberName(all[k]) + "` and `" + memberName(all[i]) + "` differ",
                       "`" + std::string(pou->name.text) + "` has both");
      d.label(all[k]->name.span, "`" + signatureText(all[k]) + "`");
      d.label(all[i]->name.span, "`" + signatureText(all[i]) + "`");
      return;
    }
  }
}

void Checker::checkInterfaces(PouSymbol *pou) {
  for (PouSymbol *interface : pou->interfaces) {
    declare(interface);
    std::string missing;
    std::string text;
    const PropertySymbol *lastProperty = nullptr;
    for (PouSymbol *demanded : demandedMethods(interface)) {
      declare(demanded->owner);
      PouSymbol *own = implementation(pou, demanded);
      if (own == nullptr) {
        if (pou->isAbstract())
          continue;
        std::string what(demanded->name.text);
        if (demanded->property != nullptr) {
          if (demanded->property == lastProperty)
            continue;
          const Symbol *half = memberNamed(pou, demanded->name.id);
          if (half != nullptr && half->kind == SymbolKind::property)
            what += demanded->property->get == demanded ? " (GET)" : " (SET)";
          lastProperty = demanded->property;
        }
        missing += (missing.empty() ? "`" : ", `") + what + "`";
        text += (text.empty() ? "" : ", ") + ("`" + signatureText(demanded) + "`");
        continue;
      }
      declare(own->owner);
      if (sameSignature(own, demanded))
        continue;
      auto &d = report(Code::overrideMismatch, own->owner == pou ? own->name.span : pou->name.span,
                       "`" + memberName(own) + "` does not fit the interface `" +
                           std::string(demanded->owner->name.text) + "`",
                       own->owner == pou ? "`" + signatureText(own) + "`"
                                         : "inherits `" + signatureText(own) + "`");
      d.label(demanded->name.span, "`" + signatureText(demanded) + "`");
      d.help("parameters and result must be the same, in the same order");
    }
    if (missing.empty())
      continue;
    auto &d = report(Code::missingImplementation, pou->name.span,
                     "`" + std::string(pou->name.text) + "` implements `" +
                         std::string(interface->name.text) + "` but lacks " + missing,
                     "not all of the interface is there");
    d.label(interface->name.span, "the interface");
    d.help("add " + text);
  }
}

void Checker::checkAbstractMethods(PouSymbol *pou) {
  if (pou->isAbstract() || pou->base == nullptr)
    return;
  const std::string missing = missingMethods(pou);
  if (missing.empty())
    return;
  auto &d = report(Code::missingImplementation, pou->name.span,
                   "`" + std::string(pou->name.text) + "` does not implement " + missing,
                   "inherited as ABSTRACT");
  noteDeclaration(d, pou->base);
  d.help("implement them, or declare `" + std::string(pou->name.text) + "` ABSTRACT too");
}

/// The abstract methods an instance would have, `` `a`, `b` ``; also what interfaces of abstract
/// bases demand.
std::string Checker::missingMethods(const PouSymbol *pou) {
  std::string list;
  std::vector<Ident> seen;
  const auto miss = [&](const PouSymbol *m) {
    if (std::find(seen.begin(), seen.end(), m->name.id) != seen.end())
      return;
    seen.push_back(m->name.id);
    list += (list.empty() ? "`" : ", `") + std::string(m->name.text) + "`";
  };
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    for (const PouSymbol *m : p->methods) {
      const PouSymbol *own = implementation(pou, m);
      if (m->isAbstract() && (own == nullptr || own->isAbstract()))
        miss(m);
    }
    if (p == pou)
      continue; // reported with the interface's name
    for (const PouSymbol *i : p->interfaces) {
      for (const PouSymbol *m : demandedMethods(i)) {
        if (implementation(pou, m) == nullptr)
          miss(m);
      }
    }
  }
  return list;
}

} // namespace stc
