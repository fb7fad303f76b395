// `base.name`: members of variables, names of namespaces, lists and enumerations.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/internal.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/semantics/types/resolve.hpp"

namespace stc::sema {

using namespace ast;

/// `THIS^` or `SUPER^`
static bool isSelf(const Expr *expr) {
  if (expr->kind != ExprKind::Deref)
    return false;
  const Expr *pointer = as<DerefExpr>(expr)->base;
  if (pointer->kind != ExprKind::Name)
    return false;
  const Symbol *symbol = as<NameExpr>(pointer)->symbol;
  return symbol != nullptr && symbol->kind == SymbolKind::Self;
}

/// What may stand behind a name that is no variable.
static std::vector<std::string_view> namesIn(const Symbol *space) {
  std::vector<std::string_view> names;
  if (space->kind == SymbolKind::Type)
    return memberNames(static_cast<const TypeSymbol *>(space)->type);
  if (space->kind == SymbolKind::Globals)
    for (const VarSymbol *v : static_cast<const GlobalsSymbol *>(space)->variables)
      names.push_back(v->name.text);
  if (space->kind == SymbolKind::Space)
    for (const auto &[id, symbol] : static_cast<const NamespaceSymbol *>(space)->names)
      names.push_back(symbol->name.text);
  return names;
}

const Type *checkMember(Context &c, MemberExpr *expr) {
  if (expr->bit >= 0)
    return checkBit(c, expr);
  followSelf(c, expr->base);
  if (Symbol *space = resolveNamespace(c, expr->base)) {
    Symbol *found = nullptr;
    if (space->kind == SymbolKind::Type) {
      auto *type = static_cast<TypeSymbol *>(space);
      resolve(c, type);
      if (type->type->kind == TypeKind::Enumeration)
        found = findEnumerator(typeAs<EnumType>(type->type), expr->name.id);
      if (type->type->kind != TypeKind::Enumeration) {
        auto &d = c.report(Code::NotAVariable, expr->base->span,
                           "`" + std::string(space->name.text) + "` is a type, not a variable",
                           "only variables have members");
        d.help("declare a variable: `x : " + std::string(space->name.text) + ";`");
        return elementaryType(TypeKind::Error);
      }
    } else if (space->kind == SymbolKind::Globals) {
      auto *list = static_cast<GlobalsSymbol *>(space);
      const auto it = list->scope.find(expr->name.id);
      found = it == list->scope.end() ? nullptr : it->second;
    } else {
      found = nameInSpace(c, space, expr->name);
    }
    if (found == nullptr) {
      const Code code =
          space->kind == SymbolKind::Type ? Code::UnknownEnumerator : Code::UnknownMember;
      auto &d = c.report(code, expr->name.span,
                         "`" + std::string(space->name.text) + "` has no `" +
                             std::string(expr->name.text) + "`",
                         "not found in " + describe(space));
      helpMembers(d, expr->name, namesIn(space));
      return elementaryType(TypeKind::Error);
    }
    expr->symbol = found;
    return useSymbol(c, expr, found, expr->name);
  }
  const Type *base = check(c, expr->base);
  if (isSelf(expr->base))
    c.throughSelf.emplace(c.scope.pou, expr->name.id);
  return checkMemberOf(c, expr, base);
}

const Type *checkMemberOf(Context &c, MemberExpr *expr, const Type *base) {
  if (isError(base))
    return base;
  if (bitByName(c, expr))
    return checkBit(c, expr);
  if (isInstance(base) || base->kind == TypeKind::Interface) {
    PouSymbol *pou = typeAs<PouType>(base)->symbol;
    declare(c, pou);
    if (Symbol *member = memberNamed(pou, expr->name.id)) {
      expr->symbol = member;
      return useSymbol(c, expr, member, expr->name);
    }
  }
  if (base->kind != TypeKind::Structure && !isInstance(base) && base->kind != TypeKind::Interface) {
    const std::string name(expr->name.text);
    auto &d = c.report(Code::UnknownMember, expr->name.span, typeName(base) + " has no members",
                       "`." + name + "` is not possible here");
    if (base->kind == TypeKind::Pointer)
      d.help("follow the pointer first: `" + std::string(c.program.sources.text(expr->base->span)) +
             "^." + name + "`");
    else if (isInteger(underlying(base)))
      d.help("a bit is selected by its number, `.3`, or by the name of an integer constant");
    return elementaryType(TypeKind::Error);
  }
  VarSymbol *member = findMember(c, base, expr->name.id);
  if (member != nullptr &&
      (member->isResult || (member->owner == nullptr && member->globals != nullptr)))
    member = nullptr; // names that are only visible inside the POU
  if (member == nullptr) {
    if ((isInstance(base) || base->kind == TypeKind::Interface) &&
        isIncomplete(typeAs<PouType>(base)->symbol))
      return elementaryType(TypeKind::Error); // it may be inherited from what is not there
    // `w.cBit`: a bit by the name of a constant belongs to integers, which were handled above.
    auto &d =
        c.report(Code::UnknownMember, expr->name.span,
                 "`" + typeName(base) + "` has no member `" + std::string(expr->name.text) + "`",
                 "unknown member");
    helpMembers(d, expr->name, memberNames(base));
    return elementaryType(TypeKind::Error);
  }
  const Access access = member->decl == nullptr ? Access::None : member->decl->access;
  if (access == Access::Private && member->owner != nullptr &&
      !requireAccess(c, expr->name.span, member, member->owner, access))
    return elementaryType(TypeKind::Error);
  if (member->owner != nullptr && access != Access::Public && member->section == Section::Temp &&
      !insideOf(c, member->owner)) {
    reportPrivate(c, expr, member);
    return elementaryType(TypeKind::Error);
  }
  expr->symbol = member;
  return useSymbol(c, expr, member, expr->name);
}

} // namespace stc::sema
