// Methods, properties, THIS and SUPER; instances as values and behind interfaces.

#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::codegen {

using namespace ast;

std::string methodSignature(Context &context, Includes &includes, const PouSymbol *method,
                            std::string_view name, bool self, const Emitter *definition) {
  std::string out;
  if (method->result != nullptr) {
    includes.pointed(method->result->type);
    out += context.names.type(method->result->type);
    out += out.back() == '*' ? "" : " ";
  } else {
    out += "void ";
  }
  out += std::string(name) + "(::stride::Ctx &";
  if (definition == nullptr || definition->usesContext())
    out += "ctx__";
  if (self)
    out += ", ::stride::Interface self__";
  for (const VarSymbol *p : method->parameters()) {
    out += ", ";
    if (definition != nullptr && !definition->used(p))
      out += "[[maybe_unused]] ";
    std::string type(context.names.type(p->type));
    includes.pointed(p->type);
    if (p->section != Section::input && p->type->kind != TypeKind::openArray)
      type += type.back() == '*' ? "&" : " &";
    if (type.back() != '*' && type.back() != '&')
      type += ' ';
    out += type + (definition != nullptr && p->section == Section::input
                       ? Emitter::inputName(context, p)
                       : mangle(p->name.text));
  }
  return out + ")";
}

namespace {

const SelfSymbol *selfOf(const Expr *e) {
  if (e->kind != ExprKind::name)
    return nullptr;
  const Symbol *symbol = as<NameExpr>(e)->symbol;
  return symbol != nullptr && symbol->kind == SymbolKind::self
             ? static_cast<const SelfSymbol *>(symbol)
             : nullptr;
}

bool isSuper(const Expr *place) {
  if (place->kind != ExprKind::deref)
    return false;
  const SelfSymbol *self = selfOf(as<DerefExpr>(place)->base);
  return self != nullptr && self->isSuper;
}

} // namespace

/// `this`, or a pointer to its base part.
void Emitter::self(const SelfSymbol *symbol) {
  if (symbol->isSuper)
    w_ << "&this->base__";
  else
    w_ << "this";
}

/// The instance is exactly of the expression's type, not of one that extends it.
bool Emitter::isExact(const Expr *place) {
  const Symbol *symbol = nullptr;
  switch (place->kind) {
  case ExprKind::name:
    symbol = as<NameExpr>(place)->symbol;
    break;
  case ExprKind::member:
    symbol = as<MemberExpr>(place)->symbol;
    break;
  case ExprKind::index:
    return true;
  default:
    return false;
  }
  if (symbol == nullptr || symbol->kind != SymbolKind::variable)
    return true; // a program; a property's GET gives a copy
  return !isIndirect(static_cast<const VarSymbol *>(symbol));
}

/// The type id field of the instance, behind a `.`.
void Emitter::typeIdOf(const Expr *instance) {
  includes_.complete(instance->type);
  place(instance);
  w_ << '.' << pathToTypeId(typeAs<PouType>(instance->type)->symbol);
}

/// A place of a derived block as one of its base `type`.
void Emitter::placeAs(const Expr *e, const Type *type) {
  place(e);
  if (e->type == type || !isInstance(e->type) || !isInstance(type))
    return;
  includes_.complete(e->type);
  const std::string path =
      pathToBase(typeAs<PouType>(e->type)->symbol, typeAs<PouType>(type)->symbol);
  w_ << '.' << std::string_view(path).substr(0, path.size() - 1);
}

/// A pointer to the place as one to its base `type`; null references stay null.
void Emitter::addressAs(const Expr *e, const Type *type) {
  if (e->type == type || !isInstance(e->type) || !isInstance(type)) {
    address(e);
    return;
  }
  w_ << "reinterpret_cast<" << this->type(type) << " *>(";
  address(e);
  w_ << ')';
}

// ------------------------------------------------------------------------------------------------
// calls

/// The interface whose method is called; raises where it is 0.
void Emitter::interfaceOf(const Expr *object, Span span) {
  if (const auto found = found_.find(object); found != found_.end()) {
    w_ << found->second;
    return;
  }
  w_ << (checks() ? "::stride::used(" : "");
  if (checks())
    w_ << ctx() << ", ";
  value(object);
  if (checks()) {
    w_ << ", ";
    position(object->span.valid() ? object->span : span);
    w_ << ')';
  }
}

/// `this->Run(ctx__`, `m.base__.Run(ctx__`, `m.Run__call(ctx__`, `IShape__Area(ctx__, i`.
void Emitter::methodPrefix(const Expr *object, const PouSymbol *method, Span span) {
  const PouSymbol *owner = method->owner;
  for (const VarSymbol *p : method->parameters())
    includes_.complete(p->type);
  if (method->result != nullptr)
    includes_.complete(method->result->type);
  if (owner->isInterface()) {
    includes_.symbol(owner);
    w_ << c_.names.qualified(method) << '(' << ctx() << ", ";
    interfaceOf(object, span);
    return;
  }
  const PouSymbol *from = nullptr;
  bool exact = false;
  if (object == nullptr) { // a method of the block itself
    from = blockOf(pou_);
    w_ << "this->";
  } else {
    from = typeAs<PouType>(object->type)->symbol;
    exact = isExact(object) || isSuper(object);
    includes_.complete(object->type);
    place(object);
    w_ << '.';
  }
  w_ << pathToBase(from, owner) << methodName(method);
  if (!exact && isDispatched(method))
    w_ << "__call";
  w_ << '(' << ctx();
}

const Expr *Emitter::objectOf(const CallExpr *e) {
  return e->callee->kind == ExprKind::member ? as<MemberExpr>(e->callee)->base : nullptr;
}

/// Reading a property: `instance` is null inside of the block.
void Emitter::propertyGet(const Expr *instance, const PropertySymbol *property, Span span) {
  const PouSymbol *get = accessor(property, true);
  const bool reference = property->type->kind == TypeKind::reference;
  if (reference) {
    includes_.complete(typeAs<PointerType>(property->type)->pointee);
    w_ << (checks() ? "::stride::deref(" : "(*");
    if (checks())
      w_ << ctx() << ", ";
  }
  const std::size_t start = w_.size();
  methodPrefix(instance, get, span);
  w_ << ')';
  if (!reference)
    placeValue(start, property->type, get);
  if (reference && checks()) {
    w_ << ", ";
    position(span);
  }
  if (reference)
    w_ << ')';
}

/// The accessor that `property` names: its own, or the inherited half.
const PouSymbol *Emitter::accessor(const PropertySymbol *property, bool get) {
  for (const PouSymbol *p = property->owner; p != nullptr; p = p->base) {
    const auto it = p->members.find(property->name.id);
    if (it == p->members.end() || it->second->kind != SymbolKind::property)
      continue;
    const auto *own = static_cast<const PropertySymbol *>(it->second);
    if (const PouSymbol *found = get ? own->get : own->set)
      return found;
  }
  return nullptr;
}

/// `instance.Speed__set(ctx__, value);` with the value as `writeValue` writes it.
void Emitter::propertySet(const Expr *target, const std::function<void()> &writeValue) {
  const PropertySymbol *property = writtenProperty(target);
  const Expr *instance = target->kind == ExprKind::member ? as<MemberExpr>(target)->base : nullptr;
  methodPrefix(instance, accessor(property, false), target->span);
  w_ << ", ";
  writeValue();
  w_ << ");";
}

// ------------------------------------------------------------------------------------------------
// __QUERYINTERFACE, __QUERYPOINTER

void Emitter::query(const CallExpr *e) {
  const Expr *source = e->arguments[0].value;
  const Expr *target = e->arguments[1].value;
  const std::string from = temporary("from");
  const std::string has = temporary("has");
  const bool toPointer = e->builtin == Builtin::queryPointer;
  const Type *wanted = toPointer ? typeAs<PointerType>(target->type)->pointee : target->type;
  const PouSymbol *pou = typeAs<PouType>(wanted)->symbol;
  includes_.symbol(pou);
  w_ << "[&] { const ::stride::Interface " << from << " = ";
  if (isInstance(source->type)) {
    w_ << '&';
    typeIdOf(source);
  } else {
    value(source);
  }
  w_ << "; const bool " << has << " = " << from << " != nullptr && " << c_.names.qualified(pou)
     << "__is__(*" << from << "); ";
  std::string result = from;
  if (toPointer) {
    const std::string type(c_.names.qualified(pou));
    result = "reinterpret_cast<" + type + " *>(reinterpret_cast<char *>(" + from + ") - offsetof(" +
             type + ", " + pathToTypeId(pou) + "))";
  }
  const std::string stored = has + " ? " + result + " : nullptr";
  if (writtenProperty(target) != nullptr) {
    propertySet(target, [&] { w_ << stored; });
  } else {
    place(target);
    w_ << " = " << stored << ';';
  }
  w_ << " return " << has << "; }()";
}

} // namespace stc::codegen
