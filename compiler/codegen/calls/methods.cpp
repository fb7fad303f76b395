#include "compiler/codegen/calls/methods.hpp"

#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

const SelfSymbol *selfOf(const Expr *e) {
  if (e->kind != ExprKind::Name)
    return nullptr;
  const Symbol *symbol = as<NameExpr>(e)->symbol;
  return symbol != nullptr && symbol->kind == SymbolKind::Self
             ? static_cast<const SelfSymbol *>(symbol)
             : nullptr;
}

} // namespace

bool isSuper(const Expr *place) {
  if (place->kind != ExprKind::Deref)
    return false;
  const SelfSymbol *self = selfOf(as<DerefExpr>(place)->base);
  return self != nullptr && self->isSuper;
}

/// `this`, or a pointer to its base part.
void emitSelf(EmitContext &cx, const SelfSymbol *symbol) {
  if (symbol->isSuper)
    cx.out << "&this->base__";
  else
    cx.out << "this";
}

/// The instance is exactly of the expression's type, not of one that extends it.
bool isExact(const Expr *place) {
  const Symbol *symbol = nullptr;
  switch (place->kind) {
  case ExprKind::Name:
    symbol = as<NameExpr>(place)->symbol;
    break;
  case ExprKind::Member:
    symbol = as<MemberExpr>(place)->symbol;
    break;
  case ExprKind::Index:
    return true;
  default:
    return false;
  }
  if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
    return true; // a program; a property's GET gives a copy
  return !isIndirect(static_cast<const VarSymbol *>(symbol));
}

void emitTypeIdOf(EmitContext &cx, const Expr *instance) {
  cx.includes.complete(instance->type);
  emitPlace(cx, instance);
  cx.out << '.' << pathToTypeId(typeAs<PouType>(instance->type)->symbol);
}

/// A place of a derived block or structure as one of its base `type`.
void emitPlaceAs(EmitContext &cx, const Expr *e, const Type *type) {
  emitPlace(cx, e);
  if (e->type == type)
    return;
  cx.includes.complete(e->type);
  cx.out << baseSuffix(e->type, type);
}

/// A pointer to the place as one to its base `type`; null references stay null.
void emitAddressAs(EmitContext &cx, const Expr *e, const Type *type) {
  if (e->type == type || baseSuffix(e->type, type).empty()) {
    emitAddress(cx, e);
    return;
  }
  cx.out << "reinterpret_cast<" << cx.type(type) << " *>(";
  emitAddress(cx, e);
  cx.out << ')';
}

// ------------------------------------------------------------------------------------------------
// calls

/// The interface whose method is called; raises where it is 0.
void emitInterface(EmitContext &cx, const Expr *object, Span span) {
  if (const auto found = cx.found.find(object); found != cx.found.end()) {
    cx.out << found->second;
    return;
  }
  cx.out << (cx.checks() ? "::stride::used(" : "");
  if (cx.checks())
    cx.out << cx.ctx() << ", ";
  emitValue(cx, object);
  if (cx.checks()) {
    cx.out << ", ";
    cx.position(object->span.valid() ? object->span : span);
    cx.out << ')';
  }
}

/// `this->Run(ctx__`, `m.base__.Run(ctx__`, `m.Run__call(ctx__`, `IShape__Area(ctx__, i`.
void openMethodCall(EmitContext &cx, const Expr *object, const PouSymbol *method, Span span) {
  const PouSymbol *owner = method->owner;
  for (const VarSymbol *p : method->parameters())
    cx.includes.complete(p->type);
  if (method->result != nullptr)
    cx.includes.complete(method->result->type);
  if (owner->isInterface()) {
    cx.includes.symbol(owner);
    cx.out << cx.run.names.qualified(method) << '(' << cx.ctx() << ", ";
    emitInterface(cx, object, span);
    return;
  }
  const PouSymbol *from = nullptr;
  bool exact = false;
  if (object == nullptr) { // a method of the block itself
    from = blockOf(cx.pou);
    cx.out << "this->";
  } else {
    from = typeAs<PouType>(object->type)->symbol;
    exact = isExact(object) || isSuper(object);
    cx.includes.complete(object->type);
    emitPlace(cx, object);
    cx.out << '.';
  }
  cx.out << pathToBase(from, owner) << methodName(method);
  if (!exact && isDispatched(method))
    cx.out << "__call";
  cx.out << '(' << cx.ctx();
}

const Expr *objectOf(const CallExpr *e) {
  return e->callee->kind == ExprKind::Member ? as<MemberExpr>(e->callee)->base : nullptr;
}

/// Reading a property: `instance` is null inside of the block.
void emitPropertyGet(EmitContext &cx, const Expr *instance, const PropertySymbol *property,
                     Span span) {
  const PouSymbol *get = accessorOf(property, true);
  const auto call = [&] {
    openMethodCall(cx, instance, get, span);
    cx.out << ')';
  };
  if (property->type->kind == TypeKind::Reference) {
    cx.includes.complete(typeAs<PointerType>(property->type)->pointee);
    emitFollowed(cx, Slot::Reference, span, call);
  } else if (returnsBlock(get, property->type)) {
    emitBlockResult(cx, property->type, call);
  } else {
    call();
  }
}

/// The accessor that `property` names: its own, or the inherited half.
const PouSymbol *accessorOf(const PropertySymbol *property, bool get) {
  for (const PouSymbol *p = property->owner; p != nullptr; p = p->base) {
    const auto it = p->members.find(property->name.id);
    if (it == p->members.end() || it->second->kind != SymbolKind::Property)
      continue;
    const auto *own = static_cast<const PropertySymbol *>(it->second);
    if (const PouSymbol *found = get ? own->get : own->set)
      return found;
  }
  return nullptr;
}

/// `instance.Speed__set(ctx__, value);` with the value as `value` writes it.
void emitPropertySet(EmitContext &cx, const Expr *target, Part value) {
  const PropertySymbol *property = writtenProperty(target);
  const Expr *instance = target->kind == ExprKind::Member ? as<MemberExpr>(target)->base : nullptr;
  openMethodCall(cx, instance, accessorOf(property, false), target->span);
  cx.out << ", ";
  value();
  cx.out << ");";
}

// ------------------------------------------------------------------------------------------------
// __QUERYINTERFACE, __QUERYPOINTER

void emitQuery(EmitContext &cx, const CallExpr *e) {
  const Expr *source = e->arguments[0].value;
  const Expr *target = e->arguments[1].value;
  const std::string from = cx.temporary("from");
  const std::string has = cx.temporary("has");
  const bool toPointer = target->type->kind == TypeKind::Pointer;
  const Type *wanted = toPointer ? typeAs<PointerType>(target->type)->pointee : target->type;
  const PouSymbol *pou = typeAs<PouType>(wanted)->symbol;
  cx.includes.symbol(pou);
  cx.out << "[&] { const ::stride::Interface " << from << " = ";
  if (isInstance(source->type)) {
    cx.out << '&';
    emitTypeIdOf(cx, source);
  } else {
    emitValue(cx, source);
  }
  cx.out << "; const bool " << has << " = " << from << " != nullptr && "
         << cx.run.names.qualified(pou) << "__is__(*" << from << "); ";
  std::string result = from;
  if (toPointer) {
    const std::string type(cx.run.names.qualified(pou));
    result = "reinterpret_cast<" + type + " *>(reinterpret_cast<char *>(" + from + ") - offsetof(" +
             type + ", " + pathToTypeId(pou) + "))";
  }
  const std::string stored = has + " ? " + result + " : nullptr";
  if (writtenProperty(target) != nullptr) {
    emitPropertySet(cx, target, [&] { cx.out << stored; });
  } else {
    emitPlace(cx, target);
    cx.out << " = " << stored << ';';
  }
  cx.out << " return " << has << "; }()";
}

} // namespace stc::codegen
