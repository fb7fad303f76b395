// What holds what by value: no type may hold itself, be nested too deeply or be too large. All that
// walks through types relies on it.

#include "compiler/semantics/types/resolve.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>
#include <unordered_map>

namespace stc::sema {

using namespace ast;

namespace {

/// Types held by value.
template <class Visit> void visitContained(const Type *type, Visit &&visit) {
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (type->kind == TypeKind::Structure || isInstance(type))
    visit(type);
}

template <class Visit> void visitMembers(const Type *type, Visit &&visit) {
  if (type->kind == TypeKind::Structure) {
    const auto *s = typeAs<StructType>(type);
    if (s->base != nullptr)
      visit(static_cast<const Type *>(s->base), nullptr);
    for (VarSymbol *field : s->fields)
      visitContained(field->type, [&](const Type *t) { visit(t, field); });
  } else {
    const PouSymbol *pou = typeAs<PouType>(type)->symbol;
    if (pou->base != nullptr && pou->base->type != nullptr)
      visit(static_cast<const Type *>(pou->base->type), nullptr);
    for (VarSymbol *v : pou->variables) {
      if (v->section != Section::InOut && v->section != Section::Temp)
        visitContained(v->type, [&](const Type *t) { visit(t, v); });
    }
  }
}

std::span<VarSymbol *> variablesOf(const Type *type) {
  return type->kind == TypeKind::Structure ? typeAs<StructType>(type)->fields
                                           : typeAs<PouType>(type)->symbol->variables;
}

} // namespace

static void checkSize(Context &c, VarSymbol *variable) {
  if (variable->type == nullptr || isError(variable->type) || variable->section == Section::InOut ||
      c.storage.of(variable->type).size <= kMaxTypeBytes)
    return;
  c.report(Code::TypeTooLarge, variable->name.span,
           "`" + std::string(variable->name.text) + "` is larger than 2 GiB",
           "of type " + typeName(variable->type))
      .note("a variable has at most 2,147,483,648 bytes");
  variable->type = elementaryType(TypeKind::Error);
}

/// The levels of types in `type`; `level`: so many hold it on the way to it.
static unsigned checkContained(Context &c, const Type *type, unsigned level,
                               std::unordered_map<const Type *, unsigned> &depths) {
  constexpr unsigned kRunning = 0;
  depths[type] = kRunning;
  unsigned depth = 1;
  visitMembers(type, [&](const Type *member, VarSymbol *through) {
    const auto known = depths.find(member);
    if (known != depths.end() && known->second == kRunning && through != nullptr) {
      auto &d = c.report(Code::RecursiveType, through->name.span,
                         "`" + typeName(member) + "` contains itself",
                         "this member has a `" + typeName(member) + "` inside it again");
      d.note("a value of this type would be infinitely large");
      d.help("hold a POINTER TO or REFERENCE TO `" + typeName(member) + "` instead");
      through->type = elementaryType(TypeKind::Error);
      return;
    }
    unsigned below = kMaxNesting;
    if (known != depths.end())
      below = known->second;
    else if (level < 2 * kMaxNesting)
      below = checkContained(c, member, level + 1, depths);
    if (below >= kMaxNesting && through != nullptr) {
      c.report(Code::TooDeep, through->name.span,
               "`" + typeName(member) + "` holds types in types, too many levels deep",
               "more than " + std::to_string(kMaxNesting) + " levels");
      through->type = elementaryType(TypeKind::Error);
      return;
    }
    depth = std::max(depth, below + 1);
  });
  for (VarSymbol *v : variablesOf(type))
    checkSize(c, v);
  depths[type] = depth;
  return depth;
}

void checkContainment(Context &c, Module &module) {
  std::unordered_map<const Type *, unsigned> depths; // levels of types in types
  for (TypeSymbol *t : module.library->types) {
    if (t->type->kind == TypeKind::Structure && !depths.contains(t->type))
      checkContained(c, t->type, 0, depths);
  }
  for (PouSymbol *p : module.library->pous) {
    if (p->type != nullptr && !depths.contains(p->type))
      checkContained(c, p->type, 0, depths);
    for (VarSymbol *v : p->variables)
      checkSize(c, v);
    for (const PouSymbol *m : p->methods)
      for (VarSymbol *v : m->variables)
        checkSize(c, v);
  }
  for (GlobalsSymbol *g : module.library->globals)
    for (VarSymbol *v : g->variables)
      checkSize(c, v);
}

} // namespace stc::sema
