// What can be assigned to and referred to.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/expressions/internal.hpp"
#include "compiler/semantics/locations.hpp"

namespace stc::sema {

using namespace ast;

bool requireVariable(Context &c, Expr *expr, std::string_view what) {
  const std::string action(what);
  if (const PropertySymbol *property = propertyOf(expr);
      property != nullptr && (what == "assign to" || property->type == nullptr ||
                              property->type->kind == TypeKind::reference))
    return true; // the checker of names has seen to it that it has a SET
  if (rejectProperty(c, expr, what))
    return false;
  switch (expr->kind) {
  case ExprKind::deref:
  case ExprKind::error:
    return true;
  case ExprKind::direct:
    if (const Location *at = as<DirectExpr>(expr)->location; at != nullptr && what == "assign to")
      reportInputWritten(c, expr, *at);
    return true;
  case ExprKind::index: // what a pointer points to is a variable, even if the pointer is constant
    if (as<IndexExpr>(expr)->base->type != nullptr &&
        as<IndexExpr>(expr)->base->type->kind == TypeKind::pointer)
      return true;
    return requireVariable(c, as<IndexExpr>(expr)->base, what);
  case ExprKind::name:
  case ExprKind::member: {
    Symbol *symbol =
        expr->kind == ExprKind::name ? as<NameExpr>(expr)->symbol : as<MemberExpr>(expr)->symbol;
    if (expr->kind == ExprKind::member && as<MemberExpr>(expr)->bit >= 0)
      return requireVariable(c, as<MemberExpr>(expr)->base, what);
    if (symbol == nullptr || isError(expr->type))
      return true; // reported before
    if (symbol->kind != SymbolKind::variable) {
      auto &d = c.report(Code::notAssignable, expr->span,
                         "cannot " + action + " this: it is " + describe(symbol),
                         "a variable is needed here");
      noteDeclaration(d, symbol);
      return false;
    }
    auto *variable = static_cast<VarSymbol *>(symbol);
    if (variable->isConstant) {
      auto &d =
          c.report(Code::assignToConstant, expr->span,
                   "cannot " + action + " the constant `" + std::string(variable->name.text) + "`",
                   "declared CONSTANT");
      noteDeclaration(d, variable);
      return false;
    }
    if (variable->location != nullptr && what == "assign to")
      reportInputWritten(c, expr, *variable->location);
    if (expr->kind == ExprKind::member && variable->section == Section::output &&
        !insideOf(c, variable->owner)) {
      if (what == "pass")
        return true; // outputs of a block may be passed on as in-outs (TimeAxis.Axis)
      auto &d = c.report(Code::assignToOutput, expr->span,
                         "cannot " + action + " the output `" + std::string(variable->name.text) +
                             "` of `" + std::string(variable->owner->name.text) + "`",
                         "only the block itself writes its outputs");
      noteDeclaration(d, variable);
      return false;
    }
    // A field of a constant structure is constant, a field of a POU's variable is not.
    if (expr->kind == ExprKind::member && variable->owner == nullptr &&
        variable->globals == nullptr)
      return requireVariable(c, as<MemberExpr>(expr)->base, what);
    return true;
  }
  default:
    c.report(Code::notAssignable, expr->span, "cannot " + action + " an expression",
             "this is not a variable");
    return false;
  }
}

bool requireAligned(Context &c, const Expr *expr, std::string_view what) {
  if (!isMisaligned(expr))
    return true;
  const unsigned align = alignmentOf(expr->type);
  auto &d =
      c.report(Code::misaligned, expr->span,
               "cannot " + std::string(what) + " this variable: it does not lie at a multiple of " +
                   std::to_string(align) + " bytes",
               "misaligned");
  if (locationOf(expr) != nullptr)
    d.note("its address is not a multiple of the size of " + typeName(expr->type));
  else
    d.note("a structure with pack_mode around it leaves no gaps that would align it");
  d.help("copy it into a variable of its own first, and back afterwards");
  return false;
}

} // namespace stc::sema
