// Whether a block has what its interfaces and abstract bases demand.

#include "compiler/semantics/classes/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

void checkInterfaceBases(Context &c, PouSymbol *pou) {
  // Two bases may demand the same method, but then the same one.
  const std::vector<PouSymbol *> all = demandedMethods(pou);
  for (size_t i = 0; i < all.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      const bool same = all[i]->name.id == all[k]->name.id &&
                        (all[i]->property == nullptr) == (all[k]->property == nullptr);
      if (!same || (all[i]->property != nullptr &&
                    (all[i]->property->get == all[i]) != (all[k]->property->get == all[k])))
        continue;
      if (sameSignature(all[i], all[k]))
        continue;
      auto &d = c.report(Code::OverrideMismatch, pou->name.span,
                         "`" + memberName(all[k]) + "` and `" + memberName(all[i]) + "` differ",
                         "`" + std::string(pou->name.text) + "` has both");
      d.label(all[k]->name.span, "`" + signatureText(all[k]) + "`");
      d.label(all[i]->name.span, "`" + signatureText(all[i]) + "`");
      return;
    }
  }
}

void checkInterfaces(Context &c, PouSymbol *pou) {
  for (PouSymbol *interface : pou->interfaces) {
    declare(c, interface);
    std::string missing;
    std::string text;
    const PropertySymbol *lastProperty = nullptr;
    for (PouSymbol *demanded : demandedMethods(interface)) {
      declare(c, demanded->owner);
      PouSymbol *own = implementation(pou, demanded);
      if (own == nullptr) {
        if (pou->isAbstract() || isIncomplete(pou))
          continue;
        std::string what(demanded->name.text);
        if (demanded->property != nullptr) {
          if (demanded->property == lastProperty)
            continue;
          const Symbol *half = memberNamed(pou, demanded->name.id);
          if (half != nullptr && half->kind == SymbolKind::Property)
            what += demanded->property->get == demanded ? " (GET)" : " (SET)";
          lastProperty = demanded->property;
        }
        missing += (missing.empty() ? "`" : ", `") + what + "`";
        text += (text.empty() ? "" : ", ") + ("`" + signatureText(demanded) + "`");
        continue;
      }
      declare(c, own->owner);
      if (sameSignature(own, demanded))
        continue;
      auto &d =
          c.report(Code::OverrideMismatch, own->owner == pou ? own->name.span : pou->name.span,
                   "`" + memberName(own) + "` does not fit the interface `" +
                       std::string(demanded->owner->name.text) + "`",
                   own->owner == pou ? "`" + signatureText(own) + "`"
                                     : "inherits `" + signatureText(own) + "`");
      d.label(demanded->name.span, "`" + signatureText(demanded) + "`");
      d.help("parameters and result must be the same, in the same order");
    }
    if (missing.empty())
      continue;
    auto &d = c.report(Code::MissingImplementation, pou->name.span,
                       "`" + std::string(pou->name.text) + "` implements `" +
                           std::string(interface->name.text) + "` but lacks " + missing,
                       "not all of the interface is there");
    d.label(interface->name.span, "the interface");
    d.help("add " + text);
  }
}

void checkAbstractMethods(Context &c, PouSymbol *pou) {
  if (pou->isAbstract() || pou->base == nullptr)
    return;
  const std::string missing = isIncomplete(pou) ? std::string() : missingMethods(pou);
  if (missing.empty())
    return;
  auto &d = c.report(Code::MissingImplementation, pou->name.span,
                     "`" + std::string(pou->name.text) + "` does not implement " + missing,
                     "inherited as ABSTRACT");
  noteDeclaration(d, pou->base);
  d.help("implement them, or declare `" + std::string(pou->name.text) + "` ABSTRACT too");
}

std::string missingMethods(const PouSymbol *pou) {
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

} // namespace stc::sema
