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

/// A variable that is named itself, or as a member: whether it can be assigned to, passed …
static bool requireWritable(Context &c, const Expr *expr, const VarSymbol *variable,
                            std::string_view what) {
  if (variable->isConstant) {
    auto &d = c.report(Code::AssignToConstant, expr->span,
                       "cannot " + std::string(what) + " the constant `" +
                           std::string(variable->name.text) + "`",
                       "declared CONSTANT");
    noteDeclaration(d, variable);
    return false;
  }
  if (variable->location != nullptr && what == "assign to")
    reportInputWritten(c, expr, *variable->location);
  const bool isOutput = expr->kind == ExprKind::Member && variable->section == Section::Output &&
                        !insideOf(c, variable->owner);
  if (!isOutput || what == "pass") // outputs may be passed on as in-outs (TimeAxis.Axis)
    return true;
  auto &d =
      c.report(Code::AssignToOutput, expr->span,
               "cannot " + std::string(what) + " the output `" + std::string(variable->name.text) +
                   "` of `" + std::string(variable->owner->name.text) + "`",
               "only the block itself writes its outputs");
  noteDeclaration(d, variable);
  return false;
}

static bool requirePlace(Context &c, Expr *expr, std::string_view what);

static bool requireNamed(Context &c, Expr *expr, Symbol *symbol, std::string_view what) {
  if (symbol == nullptr || isError(expr->type))
    return true; // reported before
  if (symbol->kind != SymbolKind::Variable) {
    auto &d = c.report(Code::NotAssignable, expr->span,
                       "cannot " + std::string(what) + " this: it is " + describe(symbol),
                       "a variable is needed here");
    noteDeclaration(d, symbol);
    return false;
  }
  const auto *variable = static_cast<const VarSymbol *>(symbol);
  if (!requireWritable(c, expr, variable, what))
    return false;
  // A field of a constant structure is constant, a field of a POU's variable is not.
  return expr->kind != ExprKind::Member || variable->owner != nullptr ||
         variable->globals != nullptr || requirePlace(c, as<MemberExpr>(expr)->base, what);
}

static bool requirePlace(Context &c, Expr *expr, std::string_view what) {
  if (const PropertySymbol *property = propertyOf(expr);
      property != nullptr && (what == "assign to" || property->type == nullptr ||
                              property->type->kind == TypeKind::Reference))
    return true; // the checker of names has seen to it that it has a SET
  if (rejectProperty(c, expr, what))
    return false;
  switch (expr->kind) {
  case ExprKind::Deref:
  case ExprKind::Error:
    return true;
  case ExprKind::Direct:
    if (const Location *at = as<DirectExpr>(expr)->location; at != nullptr && what == "assign to")
      reportInputWritten(c, expr, *at);
    return true;
  case ExprKind::Index: { // what a pointer points to is a variable, even if the pointer is constant
    Expr *base = as<IndexExpr>(expr)->base;
    const bool isPointer = base->type != nullptr && base->type->kind == TypeKind::Pointer;
    return isPointer || requirePlace(c, base, what);
  }
  case ExprKind::Name:
    return requireNamed(c, expr, as<NameExpr>(expr)->symbol, what);
  case ExprKind::Member:
    return as<MemberExpr>(expr)->bit >= 0
               ? requirePlace(c, as<MemberExpr>(expr)->base, what)
               : requireNamed(c, expr, as<MemberExpr>(expr)->symbol, what);
  default:
    c.report(Code::NotAssignable, expr->span, "cannot " + std::string(what) + " an expression",
             "this is not a variable");
    return false;
  }
}

bool requireVariable(Context &c, Expr *expr, std::string_view what) {
  return requireOwn(c, expr) && requirePlace(c, expr, what);
}

bool requireAligned(Context &c, const Expr *expr, std::string_view what) {
  if (!isMisaligned(expr))
    return true;
  const unsigned align = alignmentOf(expr->type);
  auto &d =
      c.report(Code::Misaligned, expr->span,
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
