// Whether the members of a block fit each other and its base.

#include "compiler/semantics/classes/classes.hpp"

#include "compiler/semantics/classes/internal.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/source/suggest.hpp"

#include <map>

namespace stc::sema {

using namespace ast;

static void checkNameClashes(Context &c, PouSymbol *pou);
static void checkMethod(Context &c, PouSymbol *method);
static std::string nearestMethod(const PouSymbol *pou, const Name &name);

namespace {

std::string_view accessName(Access access) {
  switch (access) {
  case Access::Private:
    return "PRIVATE";
  case Access::Protected:
    return "PROTECTED";
  case Access::Internal:
    return "INTERNAL";
  default:
    return "PUBLIC";
  }
}

/// How far a member can be seen: less is less.
int reach(Access access) {
  switch (access) {
  case Access::Private:
    return 0;
  case Access::Protected:
    return 1;
  case Access::Internal:
    return 2;
  default:
    return 3;
  }
}

} // namespace

void checkClass(Context &c, PouSymbol *pou) {
  if (pou->base == nullptr && pou->interfaces.empty() && pou->methods.empty() &&
      (pou->decl->modifiers & (kModAbstract | kModFinal)) == 0)
    return;
  const ScopeGuard guard(c, {&c.names.moduleOf(pou), pou});
  if (pou->isAbstract() && pou->isFinal())
    c.report(Code::ModifierNotAllowed, pou->name.span,
             "`" + std::string(pou->name.text) + "` cannot be ABSTRACT and FINAL",
             "nobody could ever make an instance of it");
  if (pou->base != nullptr && pou->base->isFinal()) {
    auto &d =
        c.report(Code::FinalBase, pou->decl->base.back().span,
                 "`" + std::string(pou->base->name.text) + "` is FINAL", "it cannot be extended");
    noteDeclaration(d, pou->base);
  }
  checkNameClashes(c, pou);
  for (PouSymbol *m : pou->methods)
    checkMethod(c, m);
  if (pou->isInterface()) {
    checkInterfaceBases(c, pou);
    return;
  }
  checkInterfaces(c, pou);
  checkAbstractMethods(c, pou);
}

static void checkNameClashes(Context &c, PouSymbol *pou) {
  if (pou->base == nullptr)
    return;
  const auto clash = [&](const Symbol *own, const Symbol *inherited, const PouSymbol *where) {
    auto &d =
        c.report(Code::InheritedName, own->name.span,
                 "`" + std::string(where->name.text) + "`, which `" + std::string(pou->name.text) +
                     "` extends, has `" + std::string(own->name.text) + "` already",
                 "this name is taken");
    d.label(inherited->name.span, "inherited from here");
    d.help("give it another name");
  };
  const auto where = [](const Symbol *s) -> const PouSymbol * {
    if (s->kind == SymbolKind::Variable)
      return static_cast<const VarSymbol *>(s)->owner;
    if (s->kind == SymbolKind::Property)
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

static void checkAbstract(Context &c, const PouSymbol *method) {
  const PouSymbol *owner = method->owner;
  const std::string name(method->name.text);
  const Span at = method->name.span;
  if (!method->isAbstract())
    return;
  if (!method->decl->body.empty())
    c.report(Code::ModifierNotAllowed, at, "the ABSTRACT method `" + name + "` has a body",
             "an abstract method has none")
        .help("remove the statements, or the word ABSTRACT");
  if (!owner->isAbstract() && owner->isBlock()) {
    auto &d =
        c.report(Code::AbstractInConcrete, at,
                 "`" + name + "` is ABSTRACT, but `" + std::string(owner->name.text) + "` is not",
                 "instances would have nothing to run here");
    noteDeclaration(d, owner);
    d.help("declare the block ABSTRACT: `FUNCTION_BLOCK ABSTRACT " + std::string(owner->name.text) +
           "`");
  }
  if (method->isFinal())
    c.report(Code::ModifierNotAllowed, at, "`" + name + "` cannot be ABSTRACT and FINAL",
             "nobody could ever implement it");
}

/// OVERRIDE where no base has such a method.
static void checkNothingOverridden(Context &c, const PouSymbol *method) {
  if ((method->decl->modifiers & kModOverride) == 0 || isLifecycle(method))
    return;
  const PouSymbol *owner = method->owner;
  if (isIncomplete(owner))
    return;
  const std::string block(owner->name.text);
  auto &d =
      c.report(Code::NothingOverridden, method->name.span,
               "`" + std::string(method->name.text) +
                   "` is declared OVERRIDE, but there is nothing to override",
               owner->base == nullptr ? "`" + block + "` extends no block"
                                      : "no block that `" + block + "` extends has this method");
  if (owner->base == nullptr)
    return;
  const auto similar = nearestMethod(owner->base, method->name);
  if (!similar.empty())
    d.help("a similar one exists: `" + similar + "`");
}

/// Whether the method may replace the one of a base, and fits it.
static void checkOverride(Context &c, const PouSymbol *method, const PouSymbol *base) {
  const Span at = method->name.span;
  if (base->isFinal()) {
    auto &d = c.report(Code::FinalMethod, at, "`" + memberName(base) + "` is FINAL",
                       "it cannot be replaced");
    d.label(base->name.span, "declared FINAL here");
    return;
  }
  const Access own = memberAccess(method);
  const Access inherited = memberAccess(base);
  if (inherited == Access::Private) {
    auto &d = c.report(Code::InheritedName, at,
                       "`" + memberName(base) + "` is PRIVATE and cannot be replaced",
                       "this name is taken");
    d.label(base->name.span, "declared PRIVATE here");
    d.help("give it another name, or declare the base's method PROTECTED");
    return;
  }
  if (reach(own) < reach(inherited)) {
    auto &d = c.report(Code::AccessNarrowed, at,
                       "`" + memberName(method) + "` is " + std::string(accessName(own)) + ", `" +
                           memberName(base) + "` is " + std::string(accessName(inherited)),
                       "less visible than what it replaces");
    d.label(base->name.span, "the replaced one");
    d.help("declare it " + std::string(accessName(inherited)));
  }
  if (!sameSignature(method, base)) {
    auto &d = c.report(Code::OverrideMismatch, at,
                       "`" + memberName(method) + "` does not fit `" + memberName(base) +
                           "`, which it replaces",
                       "`" + signatureText(method) + "`");
    d.label(base->name.span, "`" + signatureText(base) + "`");
    d.help("parameters and result must be the same, in the same order");
  }
}

static void checkMethod(Context &c, PouSymbol *method) {
  const PouSymbol *owner = method->owner;
  if (isLifecycle(method) && owner->isBlock())
    checkLifecycle(c, method);
  if (owner->isInterface())
    return;
  checkAbstract(c, method);
  if (method->overrides == nullptr)
    checkNothingOverridden(c, method);
  else
    checkOverride(c, method, method->overrides);
}

static std::string nearestMethod(const PouSymbol *pou, const Name &name) {
  std::vector<std::string_view> names;
  for (const PouSymbol *p = pou; p != nullptr; p = p->base) {
    for (const PouSymbol *m : p->methods)
      names.push_back(m->name.text);
  }
  return std::string(nearest(name.text, names));
}

} // namespace stc::sema
