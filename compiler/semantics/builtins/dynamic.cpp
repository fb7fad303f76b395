// __NEW, __DELETE and INI.

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/classes/classes.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace stc::sema {

using namespace ast;

namespace {

/// The first block without the attribute that an object of the type holds or is.
const PouSymbol *withoutAttribute(const Type *type) {
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (!isInstance(type))
    return nullptr;
  const PouSymbol *pou = typeAs<PouType>(type)->symbol;
  return hasAttribute(pou->decl->attributes, AttributeId::EnableDynamicCreation) ? nullptr : pou;
}

/// `__NEW(FB(x := 1), n)` becomes `__NEW(FB, n, x := 1)`: what goes to FB_Init has a `parameter`.
/// False: it has no list of inputs.
bool unfoldConstruct(Context &c, CallExpr *expr) {
  Expr *named = expr->arguments.empty() ? nullptr : expr->arguments[0].value;
  if (named == nullptr || named->kind != ExprKind::Call)
    return false;
  auto *call = as<CallExpr>(named);
  const Type *type = namedType(c, call->callee);
  if (type == nullptr || isError(type))
    return false;
  if (type->kind != TypeKind::FunctionBlock) {
    c.report(Code::WrongConstruct, named->span, typeName(type) + " takes no inputs here",
             "only instances of function blocks do")
        .help("write the type alone, and assign to what the pointer leads to");
    expr->arguments[0].value = call->callee;
    return true;
  }
  auto *pou = typeAs<PouType>(type)->symbol;
  declare(c, pou);
  bindConstruct(c, call->arguments, pou, named->span);
  std::vector<Argument> all(expr->arguments.begin(), expr->arguments.end());
  all[0].value = call->callee;
  std::copy_if(call->arguments.begin(), call->arguments.end(), std::back_inserter(all),
               [](const Argument &a) { return a.parameter != nullptr; });
  expr->arguments = c.arena.copy(all);
  return true;
}

} // namespace

const Type *checkNew(Context &c, CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::Error);
  if (!requireCount(c, expr) || expr->arguments[0].value == nullptr)
    return bad;
  const bool hasConstruct = unfoldConstruct(c, expr);
  Expr *named = expr->arguments[0].value;
  const Type *type = namedType(c, named);
  if (type == nullptr) {
    if (!isError(check(c, named)))
      c.report(Code::NewNeedsType, named->span, "`__NEW` creates an object of a type",
               "this is a value, not the name of a type")
          .help("write the type: `p := __NEW(INT);` or `p := __NEW(BYTE, 100);`");
    return bad;
  }
  named->type = type;
  if (isError(type))
    return bad;
  if (type->kind == TypeKind::Program)
    return argumentError(c, expr, 0, "a type or a function block");
  if (const PouSymbol *pou = withoutAttribute(type)) {
    auto &d = c.report(Code::NewNotEnabled, named->span,
                       "`" + std::string(pou->name.text) + "` cannot be created with `__NEW`",
                       "its declaration does not allow it");
    noteDeclaration(d, pou);
    d.help("write `{attribute 'enable_dynamic_creation'}` before its FUNCTION_BLOCK");
    return bad;
  }
  if (expr->arguments.size() > 1 && expr->arguments[1].parameter == nullptr) {
    Expr *count = expr->arguments[1].value;
    const Type *countType = check(c, count);
    if (isError(countType))
      return bad;
    if (!isInteger(underlying(countType)) && countType->kind != TypeKind::AnyInteger)
      return argumentError(c, expr, 1, "the number of elements");
    setTarget(count, elementaryType(TypeKind::Lint));
  }
  c.program.usesPool = true;
  if (isInstance(type))
    declare(c, typeAs<PouType>(type)->symbol);
  if (type->kind == TypeKind::FunctionBlock && !hasConstruct)
    bindConstruct(c, {}, typeAs<PouType>(type)->symbol, named->span);
  if (hasSlots(c, type)) {
    c.report(Code::PlaceMissing, named->span,
             "no VAR_CONFIG can place the variables of an object of `__NEW`",
             "`" + typeName(type) + "` has variables declared with `*`")
        .help("declare the object in the VAR of a program or function block, or in VAR_GLOBAL");
    return bad;
  }
  if (std::find(c.program.created.begin(), c.program.created.end(), type) ==
      c.program.created.end())
    c.program.created.push_back(type);
  return c.types.pointer(type);
}

const Type *checkDelete(Context &c, CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::Error);
  Expr *pointer = expr->arguments[0].value;
  if (pointer->type->kind != TypeKind::Pointer)
    return argumentError(c, expr, 0, "a pointer variable");
  if (!requireVariable(c, pointer, "delete"))
    return bad;
  c.program.usesPool = true;
  return elementaryType(TypeKind::None);
}

const Type *checkIni(Context &c, CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::Error);
  Expr *instance = expr->arguments[0].value;
  const Type *type = instance->type;
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (type->kind != TypeKind::FunctionBlock && type->kind != TypeKind::Structure) {
    auto &d = c.report(Code::WrongArgumentType, instance->span,
                       "`INI` needs the instance of a function block here, not " +
                           typeName(instance->type),
                       "expected an instance");
    if (type->kind == TypeKind::Pointer)
      d.help("write `^` after the pointer: what it points to is initialised");
    else if (type->kind == TypeKind::Program)
      d.help("a PROGRAM is initialised when the application starts; name one of its instances");
    else
      d.help("assign the initial value: `x := 0;`");
    return bad;
  }
  if (!requireVariable(c, instance, "initialise"))
    return bad;
  if (type->kind == TypeKind::FunctionBlock)
    declare(c, typeAs<PouType>(type)->symbol);
  coerce(c, expr->arguments[1].value, elementaryType(TypeKind::Boolean),
         "the second argument of INI");
  return elementaryType(TypeKind::Boolean);
}

} // namespace stc::sema
