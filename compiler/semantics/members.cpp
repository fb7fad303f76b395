// Methods, properties, THIS and SUPER where they are used; values of interface type.

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/suggest.hpp"

namespace stc {

using namespace ast;

PropertySymbol *Checker::propertyOf(const Expr *expr) {
  const Symbol *symbol = expr->kind == ExprKind::name     ? as<NameExpr>(expr)->symbol
                         : expr->kind == ExprKind::member ? as<MemberExpr>(expr)->symbol
                                                          : nullptr;
  if (symbol == nullptr || symbol->kind != SymbolKind::property)
    return nullptr;
  return const_cast<PropertySymbol *>(static_cast<const PropertySymbol *>(symbol));
}

Symbol *Checker::lookupInPou(PouSymbol *pou, Ident id) {
  for (PouSymbol *p = pou; p != nullptr; p = p->owner) {
    VarSymbol *v = findVariable(p, id);
    if (v != nullptr && (p == pou || v->section != Section::temp)) // VAR_TEMP is the body's own
      return v;
    if (p->owner == nullptr && !p->isFunction()) {
      if (Symbol *member = memberNamed(p, id))
        return member;
    }
  }
  return nullptr;
}

Symbol *Checker::lookupSelf(const Name &name) {
  const bool isSuper = name.id->lower == "super";
  if (!isSuper && name.id->lower != "this")
    return nullptr;
  PouSymbol *block = scope_.pou == nullptr ? nullptr : blockOf(scope_.pou);
  if (block == nullptr || block->isFunction() || block->isInterface() ||
      (isSuper && block->base == nullptr))
    return nullptr;
  auto *symbol = arena_.make<SelfSymbol>();
  symbol->kind = SymbolKind::self;
  symbol->name = name;
  symbol->library = block->library;
  symbol->block = isSuper ? block->base : block;
  symbol->isSuper = isSuper;
  return symbol;
}

/// Edition 3 writes `THIS.x` and `SUPER()` for what CODESYS writes as `THIS^.x` and `SUPER^()`.
void Checker::followSelf(Expr *&expr) {
  if (expr->kind != ExprKind::name)
    return;
  const Name &name = as<NameExpr>(expr)->name;
  if (name.id->lower != "this" && name.id->lower != "super")
    return;
  const Symbol *symbol = lookup(name);
  if (symbol == nullptr || symbol->kind != SymbolKind::self)
    return;
  auto *deref = arena_.make<DerefExpr>();
  deref->span = expr->span;
  deref->base = expr;
  expr = deref;
}

/// THIS or SUPER where there is none; true when it was one of them.
bool Checker::reportSelf(const Name &name) {
  const bool isSuper = name.id->lower == "super";
  if (!isSuper && name.id->lower != "this")
    return false;
  const PouSymbol *block = scope_.pou == nullptr ? nullptr : blockOf(scope_.pou);
  if (isSuper && block != nullptr && block->isBlock()) {
    auto &d = report(Code::noSelf, name.span,
                     "there is no SUPER: `" + std::string(block->name.text) + "` extends no block",
                     "no base block");
    noteDeclaration(d, block);
    d.help("write `FUNCTION_BLOCK " + std::string(block->name.text) + " EXTENDS …`");
  } else {
    report(Code::noSelf, name.span,
           std::string(isSuper ? "SUPER" : "THIS") + " is only possible inside of a function block",
           "there is no instance here");
  }
  return true;
}

bool Checker::insideOf(const PouSymbol *owner) const {
  return scope_.pou != nullptr && owner != nullptr &&
         derivesFrom(blockOf(scope_.pou), blockOf(owner));
}

/// Reports a member that may not be used here.
bool Checker::requireAccess(Span span, const Symbol *member, const PouSymbol *owner,
                            Access access) {
  std::string_view word;
  std::string who;
  switch (access) {
  case Access::privateA:
    if (scope_.pou != nullptr && blockOf(scope_.pou) == owner)
      return true;
    word = "PRIVATE";
    who = "only `" + std::string(owner->name.text) + "` itself can use it";
    break;
  case Access::protectedA:
    if (insideOf(owner))
      return true;
    word = "PROTECTED";
    who = "only `" + std::string(owner->name.text) + "` and blocks that extend it can use it";
    break;
  case Access::internalA:
    if (seesInternals(member->library, owner->space))
      return true;
    word = "INTERNAL";
    who = owner->space != nullptr ? "only the namespace `" + owner->space->path + "` can use it"
                                  : "only the library `" + member->library->name + "` can use it";
    break;
  default:
    return true;
  }
  auto &d = report(Code::memberNotVisible, span,
                   "`" + std::string(owner->name.text) + "." + std::string(member->name.text) +
                       "` is " + std::string(word),
                   who);
  noteDeclaration(d, member);
  return false;
}

const Type *Checker::useProperty(Expr *expr, PropertySymbol *property, const Name &name) {
  declare(property->owner);
  const bool writing = assignTarget_ == expr;
  const Type *type = property->type;
  const bool isReference = type->kind == TypeKind::reference;
  if (isReference)
    type = typeAs<PointerType>(type)->pointee;
  const PouSymbol *accessor = writing && !isReference ? property->set : property->get;
  if (accessor == nullptr && property->owner->isBlock()) { // a base may have the other half
    for (const PouSymbol *b = property->owner->base; b != nullptr && accessor == nullptr;
         b = b->base) {
      const auto it = b->members.find(property->name.id);
      if (it != b->members.end() && it->second->kind == SymbolKind::property) {
        const auto *other = static_cast<const PropertySymbol *>(it->second);
        accessor = writing && !isReference ? other->set : other->get;
      }
    }
  }
  if (accessor == nullptr) {
    const std::string text(name.text);
    auto &d = writing ? report(Code::propertyReadOnly, name.span,
                               "the property `" + text + "` cannot be written", "it has no SET")
                      : report(Code::propertyWriteOnly, name.span,
                               "the property `" + text + "` cannot be read", "it has no GET");
    noteDeclaration(d, property);
    return elementaryType(TypeKind::error);
  }
  if (!requireAccess(name.span, property, accessor->owner, memberAccess(accessor)))
    return elementaryType(TypeKind::error);
  return type;
}

/// A property is no variable: nothing can refer to it.
bool Checker::rejectProperty(const Expr *expr, std::string_view action) {
  const Expr *at = expr;
  while (true) {
    if (const PropertySymbol *property = propertyOf(at)) {
      if (property->type == nullptr || property->type->kind == TypeKind::reference)
        return false;
      const bool part = at != expr;
      auto &d = report(Code::propertyNotVariable, expr->span,
                       "cannot " + std::string(action) + (part ? " a part of" : "") +
                           " the property `" + std::string(property->name.text) + "`",
                       part ? "its GET gives a copy" : "a property is no variable");
      noteDeclaration(d, property);
      d.help(part ? "copy the property into a variable, change that, and assign it back"
                  : "copy it into a variable first");
      return true;
    }
    switch (at->kind) {
    case ExprKind::member:
      if (isError(at->type) || as<MemberExpr>(at)->base->type == nullptr)
        return false;
      at = as<MemberExpr>(at)->base;
      break;
    case ExprKind::index:
      at = as<IndexExpr>(at)->base;
      break;
    default:
      return false;
    }
  }
}

const Type *Checker::checkTarget(Expr *expr) {
  const Expr *saved = assignTarget_;
  assignTarget_ = expr;
  const Type *type = check(expr);
  assignTarget_ = saved;
  return type;
}

// ------------------------------------------------------------------------------------------------
// calls

/// The method that a callee of the form `instance.m` names, or null; `base` becomes the type of
/// `instance` when that has been checked.
PouSymbol *Checker::methodOf(Expr *callee, const Type *&base) {
  base = nullptr;
  if (callee->kind != ExprKind::member || as<MemberExpr>(callee)->bit >= 0)
    return nullptr;
  auto *member = as<MemberExpr>(callee);
  followSelf(member->base);
  if (resolveNamespace(member->base) != nullptr)
    return nullptr;
  base = check(member->base);
  if (!isInstance(base) && base->kind != TypeKind::interface)
    return nullptr;
  PouSymbol *pou = typeAs<PouType>(base)->symbol;
  declare(pou);
  Symbol *symbol = memberNamed(pou, member->name.id);
  if (symbol == nullptr || symbol->kind != SymbolKind::pou)
    return nullptr;
  member->symbol = symbol;
  return static_cast<PouSymbol *>(symbol);
}

const Type *Checker::checkMethodCall(CallExpr *expr, PouSymbol *method) {
  Expr *callee = expr->callee;
  const Name &name =
      callee->kind == ExprKind::name ? as<NameExpr>(callee)->name : as<MemberExpr>(callee)->name;
  declare(method->owner);
  declare(method);
  callee->type = elementaryType(TypeKind::none);
  expr->pou = method;
  expr->resolved = Callee::method;
  requireAccess(name.span, method, method->owner, memberAccess(method));
  if (method->isAbstract() && callee->kind == ExprKind::member) {
    const Expr *object = as<MemberExpr>(callee)->base;
    if (object->kind == ExprKind::deref && as<DerefExpr>(object)->base->kind == ExprKind::name) {
      const Symbol *self = as<NameExpr>(as<DerefExpr>(object)->base)->symbol;
      if (self != nullptr && self->kind == SymbolKind::self &&
          static_cast<const SelfSymbol *>(self)->isSuper) {
        auto &d = report(Code::abstractCall, name.span,
                         "`" + std::string(method->owner->name.text) + "." +
                             std::string(method->name.text) + "` is ABSTRACT",
                         "the base has no such method to run");
        noteDeclaration(d, method);
      }
    }
  }
  bindArguments(expr, method);
  if (method->result == nullptr)
    return elementaryType(TypeKind::none);
  const Type *type = method->result->type;
  return type->kind == TypeKind::reference ? typeAs<PointerType>(type)->pointee : type;
}

// ------------------------------------------------------------------------------------------------
// interfaces

/// Words for an instance, interface or pointer that does not convert to the interface `to`.
void Checker::reportNoInterface(Expr *expr, const Type *from, const Type *to) {
  const std::string name = typeName(to);
  const PouSymbol *wanted = typeAs<PouType>(to)->symbol;
  const std::string text(program_.sources.text(expr->span));
  if (from->kind == TypeKind::interface) {
    auto &d = report(Code::needsQuery, expr->span,
                     "not every `" + typeName(from) + "` is also `" + name + "`",
                     "this is `" + typeName(from) + "`");
    noteDeclaration(d, wanted);
    d.help("ask at run time: `__QUERYINTERFACE(" + text +
           ", target)` gives TRUE and sets the "
           "target when the instance has it");
    return;
  }
  auto &d = report(Code::noSuchInterface, expr->span,
                   isInstance(from) ? "`" + typeName(from) + "` does not implement `" + name + "`"
                                    : "expected an instance that implements `" + name +
                                          "`, found " + typeName(from),
                   "this is " + typeName(from));
  if (isInstance(from)) {
    const PouSymbol *pou = typeAs<PouType>(from)->symbol;
    noteDeclaration(d, pou);
    if (pou->isBlock() && pou->library->isUser)
      d.help("declare it: `FUNCTION_BLOCK " + std::string(pou->name.text) + " IMPLEMENTS " + name +
             "`");
  } else if (from->kind == TypeKind::pointer && isInstance(typeAs<PointerType>(from)->pointee)) {
    d.help("follow the pointer: `" + text + "^`");
  }
}

/// Converts to an interface; true when nothing more is to do.
bool Checker::coerceToInterface(Expr *expr, const Type *type) {
  const Type *from = expr->type;
  if (type->kind != TypeKind::interface)
    return false;
  if (expr->constant != nullptr && from->kind == TypeKind::anyInteger &&
      expr->constant->integer == 0) {
    setTarget(expr, type);
    return true;
  }
  const bool convertible = (isInstance(from) || from->kind == TypeKind::interface) &&
                           convertsTo(typeAs<PouType>(from)->symbol, typeAs<PouType>(type)->symbol);
  if (!convertible) {
    reportNoInterface(expr, from, type);
    return true;
  }
  const bool isReference = expr->kind == ExprKind::call &&
                           as<CallExpr>(expr)->resolved == Callee::method &&
                           as<CallExpr>(expr)->pou->result->type->kind == TypeKind::reference;
  if (isInstance(from) && !isReference && expr->kind != ExprKind::name &&
      expr->kind != ExprKind::member && expr->kind != ExprKind::index &&
      expr->kind != ExprKind::deref) {
    report(Code::notAssignable, expr->span, "an interface needs an instance that stays",
           "this is a copy that goes away")
        .help("store it in a variable first");
    return true;
  }
  if (isInstance(from) && rejectProperty(expr, "refer to"))
    return true;
  setTarget(expr, type);
  return true;
}

const Type *Checker::checkQuery(CallExpr *expr) {
  const Type *boolean = elementaryType(TypeKind::boolean);
  const bool toPointer = expr->builtin == Builtin::queryPointer;
  if (!requireCount(expr, 2, 2))
    return elementaryType(TypeKind::error);
  Expr *source = expr->arguments[0].value;
  Expr *target = expr->arguments[1].value;
  const Type *from = source->type;
  const Type *to = target->type;
  if (isError(from) || isError(to))
    return boolean;
  if (from->kind != TypeKind::interface && !isInstance(from))
    return argumentError(expr, 0, "an interface variable or an instance");
  if (isInstance(from) && !hasTypeId(typeAs<PouType>(from)->symbol))
    return argumentError(expr, 0, "an instance of a block with interfaces or bases");
  if (toPointer ? to->kind != TypeKind::pointer ||
                      typeAs<PointerType>(to)->pointee->kind != TypeKind::functionBlock
                : to->kind != TypeKind::interface)
    return argumentError(expr, 1,
                         toPointer ? "a POINTER TO a function block" : "an interface variable");
  if (toPointer) {
    PouSymbol *pou = typeAs<PouType>(typeAs<PointerType>(to)->pointee)->symbol;
    declare(pou);
    if (!hasTypeId(pou))
      return argumentError(expr, 1, "a POINTER TO a block with interfaces or bases");
  }
  requireVariable(target, "assign to");
  return boolean;
}

const Type *Checker::checkIsValidRef(CallExpr *expr) {
  if (!requireCount(expr, 1, 1))
    return elementaryType(TypeKind::error);
  Expr *value = expr->arguments[0].value;
  if (isError(value->type) || isReference(value))
    return elementaryType(TypeKind::boolean);
  const Symbol *symbol = value->kind == ExprKind::name     ? as<NameExpr>(value)->symbol
                         : value->kind == ExprKind::member ? as<MemberExpr>(value)->symbol
                                                           : nullptr;
  const auto *variable = symbol != nullptr && symbol->kind == SymbolKind::variable
                             ? static_cast<const VarSymbol *>(symbol)
                             : nullptr;
  if (variable == nullptr || variable->section != Section::inOut ||
      variable->type->kind == TypeKind::openArray)
    return argumentError(expr, 0, "a REFERENCE TO variable");
  return elementaryType(TypeKind::boolean);
}

} // namespace stc
