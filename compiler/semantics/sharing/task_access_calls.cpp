// Calls: the instances and arguments they use, and the accesses of builtins.

#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/sharing/task_access_names.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>

namespace stc::access {

using namespace ast;

static void builtin(Reader &r, const CallExpr *e);
static bool isOpen(Reader &r, const CallExpr *e);

namespace {

/// Blocks of the library that look at an axis, or ask its drive, without moving it; actions of the
/// library that are made for another task than the rest of their block.
bool worksInAnyTask(const PouSymbol *block) {
  return hasAttribute(block->decl->attributes, AttributeId::AnyTask);
}

/// A library of Stride, which says itself what its blocks do.
bool isGiven(const Library *library) {
  return library != nullptr && !library->isUser && !library->isOwn;
}

} // namespace

void accessor(Reader &r, const Expr *object, const Symbol *symbol, bool writes, Span span) {
  const auto *property = static_cast<const PropertySymbol *>(symbol);
  const PouSymbol *pou = writes ? property->set : property->get;
  if (pou == nullptr)
    return;
  r.out.calls.push_back({pou, true});
  if (object == nullptr)
    return;
  PlacePath at = object->type != nullptr && isAddress(object->type)
                     ? behind(addressVariable(object))
                     : place(r, object, false);
  note(r, std::move(at), kAccessCall, span);
}

/// The instance whose body or method runs.
static void instanceOf(Reader &r, const CallExpr *e) {
  const Expr *object = e->callee;
  if (e->resolved == Callee::Method) {
    if (object->kind != ExprKind::Member || isNamespaceName(as<MemberExpr>(object)->base))
      return; // of the own instance
    object = as<MemberExpr>(object)->base;
  }
  PlacePath at = place(r, object, true);
  if (object->type != nullptr && isAddress(object->type)) {
    note(r, at, kAccessRead, e->span);
    at = behind(addressVariable(object));
  }
  const PouSymbol *block = blockOf(e->pou);
  if (isGiven(block->library) && e->pou != block && worksInAnyTask(e->pou))
    return;
  const bool native = block->decl->external;
  note(r, std::move(at), kAccessCall | (native ? kAccessUnknown : 0U), e->span);
}

static void argument(Reader &r, const CallExpr *e, const Argument &a) {
  if (a.value == nullptr)
    return;
  const VarSymbol *p = a.parameter;
  if (a.output) {
    if (p != nullptr && isAddress(a.value->type))
      if (const VarSymbol *to = addressVariable(a.value))
        r.out.flows.push_back({to, {}, p});
    target(r, a.value);
    return;
  }
  const bool native = e->pou->decl->external;
  if (p != nullptr && isAlias(p)) {
    PlacePath at = place(r, a.value, true);
    image(r, a.value, !p->isConstant);
    if (native) {
      const bool reads = p->isConstant;
      const unsigned flags = isScalarValue(p->type) ? kAccessRead | (reads ? 0U : kAccessWrite)
                             : reads                ? unsigned{kAccessWholeRead}
                                                    : unsigned{kAccessUnknown};
      note(r, at, flags, a.span);
    }
    const PouSymbol *block = blockOf(e->pou);
    if (isGiven(block->library) && p->type->kind == TypeKind::Structure &&
        typeAs<StructType>(p->type)->symbol->name.id->lower == "axis_ref" && !worksInAnyTask(block))
      r.out.axes.push_back({block, at, a.span});
    if (at.base != PlacePath::Base::None)
      r.out.flows.push_back({p, std::move(at), nullptr});
    return;
  }
  value(r, a.value);
  if (p == nullptr)
    return;
  if (native || !isAddress(p->type))
    escape(r, a.value);
  else
    flow(r, p, a.value);
}

void call(Reader &r, const CallExpr *e) {
  switch (e->resolved) {
  case Callee::Unresolved:
    return;
  case Callee::Builtin:
    builtin(r, e);
    return;
  case Callee::Function:
    break;
  case Callee::FunctionBlock:
  case Callee::Method:
    instanceOf(r, e);
    break;
  case Callee::Program:
    note(r, {PlacePath::Base::Root, e->pou, {}}, kAccessCall, e->span);
    break;
  }
  for (const Argument &a : e->arguments)
    argument(r, e, a);
  // Inputs and outputs of an instance are its members.
  if (e->resolved == Callee::FunctionBlock || e->resolved == Callee::Program) {
    const PlacePath instance = e->resolved == Callee::Program
                                   ? PlacePath{PlacePath::Base::Root, e->pou, {}}
                                   : place(r, e->callee, false);
    for (const Argument &a : e->arguments) {
      if (a.parameter == nullptr || a.value == nullptr || isAlias(a.parameter) ||
          instance.base == PlacePath::Base::None)
        continue;
      PlacePath member = instance;
      enter(r, member, {a.parameter, 0});
      const bool scalar = isScalarValue(a.parameter->type);
      note(r, std::move(member),
           a.output ? (scalar ? kAccessRead : kAccessWholeRead)
                    : (scalar ? kAccessWrite : kAccessWholeWrite),
           a.span);
    }
  }
  r.out.calls.push_back({e->pou, isOpen(r, e)});
}

/// The instance is found by an address, or is the one that runs: its type may be a derived one.
static bool isOpen(Reader &r, const CallExpr *e) {
  const Expr *object = e->callee;
  if (e->resolved == Callee::Method) {
    if (object->kind != ExprKind::Member || isNamespaceName(as<MemberExpr>(object)->base))
      return true;
    object = as<MemberExpr>(object)->base;
  } else if (e->resolved != Callee::FunctionBlock) {
    return false;
  }
  if (object->type != nullptr && isAddress(object->type))
    return true;
  const PlacePath at = place(r, object, false);
  return at.base == PlacePath::Base::None || at.base == PlacePath::Base::Address ||
         at.symbol == nullptr;
}

static void builtin(Reader &r, const CallExpr *e) {
  switch (builtinRow(e->builtin).takes.what) {
  case BuiltinTakes::Name: // __NEW: how many, and what FB_Init gets
    for (const Argument &a : e->arguments.subspan(1)) {
      if (a.value == nullptr)
        continue;
      value(r, a.value);
      if (a.parameter != nullptr && a.parameter->type != nullptr)
        initialValue(r, a.parameter, a.value);
    }
    return;
  case BuiltinTakes::TypeOf:
  case BuiltinTakes::Bounds:
  case BuiltinTakes::Reference:
    return;
  case BuiltinTakes::Address: // the access is where the address is followed
    place(r, e->arguments[0].value, true);
    return;
  case BuiltinTakes::Instance:
    access(r, e->arguments[0].value, kAccessWrite, kAccessWholeWrite);
    value(r, e->arguments[1].value);
    return;
  case BuiltinTakes::Query:
    value(r, e->arguments[0].value);
    target(r, e->arguments[1].value);
    flow(r, addressVariable(e->arguments[1].value), e->arguments[0].value);
    return;
  case BuiltinTakes::Enabled:
    for (const Argument &a : e->arguments)
      if (a.output)
        target(r, a.value);
      else
        value(r, a.value);
    return;
  case BuiltinTakes::Values:
  case BuiltinTakes::Operands:
  case BuiltinTakes::Location:
  case BuiltinTakes::Pointer:
    for (const Argument &a : e->arguments)
      value(r, a.value);
    return;
  }
}

} // namespace stc::access
