// Properties where they are used.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/classes/classes.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/internal.hpp"

namespace stc::sema {

using namespace ast;

PropertySymbol *propertyOf(const Expr *expr) {
  const Symbol *symbol = expr->kind == ExprKind::Name     ? as<NameExpr>(expr)->symbol
                         : expr->kind == ExprKind::Member ? as<MemberExpr>(expr)->symbol
                                                          : nullptr;
  if (symbol == nullptr || symbol->kind != SymbolKind::Property)
    return nullptr;
  return const_cast<PropertySymbol *>(static_cast<const PropertySymbol *>(symbol));
}

const Type *useProperty(Context &c, Expr *expr, PropertySymbol *property, const Name &name) {
  declare(c, property->owner);
  const bool writing = c.assignTarget == expr;
  const Type *type = property->type;
  const bool isReference = type->kind == TypeKind::Reference;
  if (isReference)
    type = typeAs<PointerType>(type)->pointee;
  const PouSymbol *accessor = writing && !isReference ? property->set : property->get;
  if (accessor == nullptr && property->owner->isBlock()) { // a base may have the other half
    for (const PouSymbol *b = property->owner->base; b != nullptr && accessor == nullptr;
         b = b->base) {
      const auto it = b->members.find(property->name.id);
      if (it != b->members.end() && it->second->kind == SymbolKind::Property) {
        const auto *other = static_cast<const PropertySymbol *>(it->second);
        accessor = writing && !isReference ? other->set : other->get;
      }
    }
  }
  if (accessor == nullptr) {
    const std::string text(name.text);
    auto &d = writing ? c.report(Code::PropertyReadOnly, name.span,
                                 "the property `" + text + "` cannot be written", "it has no SET")
                      : c.report(Code::PropertyWriteOnly, name.span,
                                 "the property `" + text + "` cannot be read", "it has no GET");
    noteDeclaration(d, property);
    return elementaryType(TypeKind::Error);
  }
  if (!requireAccess(c, name.span, property, accessor->owner, memberAccess(accessor)))
    return elementaryType(TypeKind::Error);
  return type;
}

bool rejectProperty(Context &c, const Expr *expr, std::string_view action) {
  const Expr *at = expr;
  while (true) {
    if (const PropertySymbol *property = propertyOf(at)) {
      if (property->type == nullptr || property->type->kind == TypeKind::Reference)
        return false;
      const bool part = at != expr;
      auto &d = c.report(Code::PropertyNotVariable, expr->span,
                         "cannot " + std::string(action) + (part ? " a part of" : "") +
                             " the property `" + std::string(property->name.text) + "`",
                         part ? "its GET gives a copy" : "a property is no variable");
      noteDeclaration(d, property);
      d.help(part ? "copy the property into a variable, change that, and assign it back"
                  : "copy it into a variable first");
      return true;
    }
    switch (at->kind) {
    case ExprKind::Member:
      if (isError(at->type) || as<MemberExpr>(at)->base->type == nullptr)
        return false;
      at = as<MemberExpr>(at)->base;
      break;
    case ExprKind::Index:
      at = as<IndexExpr>(at)->base;
      break;
    default:
      return false;
    }
  }
}

} // namespace stc::sema
