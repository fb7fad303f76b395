// PUBLIC, PROTECTED, INTERNAL, PRIVATE where members are used.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/expressions/internal.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::sema {

using namespace ast;

bool insideOf(Context &c, const PouSymbol *owner) { return isInside(c.scope.pou, owner); }

bool requireAccess(Context &c, Span span, const Symbol *member, const PouSymbol *owner,
                   Access access) {
  std::string_view word;
  std::string who;
  switch (access) {
  case Access::Private:
    if (c.scope.pou != nullptr && blockOf(c.scope.pou) == owner)
      return true;
    word = "PRIVATE";
    who = "only `" + std::string(owner->name.text) + "` itself can use it";
    break;
  case Access::Protected:
    if (insideOf(c, owner))
      return true;
    word = "PROTECTED";
    who = "only `" + std::string(owner->name.text) + "` and blocks that extend it can use it";
    break;
  case Access::Internal:
    if (c.names.seesInternals(c.scope, member->library, owner->space))
      return true;
    word = "INTERNAL";
    who = owner->space != nullptr ? "only the namespace `" + owner->space->path + "` can use it"
                                  : "only the library `" + member->library->name + "` can use it";
    break;
  default:
    return true;
  }
  auto &d = c.report(Code::MemberNotVisible, span,
                     "`" + (member == owner ? "" : std::string(owner->name.text) + ".") +
                         std::string(member->name.text) + "` is " + std::string(word),
                     who);
  noteDeclaration(d, member);
  return false;
}

void reportPrivate(Context &c, const MemberExpr *expr, const VarSymbol *member) {
  const std::string owner(member->owner->name.text);
  auto &d = c.report(Code::NotAccessible, expr->name.span,
                     "`" + std::string(member->name.text) + "` is private to `" + owner + "`",
                     "only its own code can use it");
  noteDeclaration(d, member);
  d.help("make it a VAR_OUTPUT (or VAR_INPUT) of `" + owner + "`");
}

bool requireOwn(Context &c, const Expr *place) {
  for (;;) {
    switch (place->kind) {
    case ExprKind::Member: {
      const auto *expr = as<MemberExpr>(place);
      if (const VarSymbol *local = foreignLocal(expr->symbol, c.scope.pou); local != nullptr) {
        reportPrivate(c, expr, local);
        return false;
      }
      place = expr->base;
      break;
    }
    case ExprKind::Index:
      place = as<IndexExpr>(place)->base;
      break;
    default:
      return true;
    }
  }
}

} // namespace stc::sema
