#include "compiler/codegen/places/places.hpp"

#include "compiler/codegen/calls/calls.hpp"
#include "compiler/codegen/calls/methods.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/places/elements.hpp"
#include "compiler/codegen/places/located.hpp"
#include "compiler/codegen/places/own_checks.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// What it is declared with in the instance, list or statics that hold it: `GVL__.`
void emitHolder(EmitContext &cx, const VarSymbol *v) {
  if (v->globals != nullptr)
    cx.out << cx.root({v->globals, false}) << '.';
  else if (v->section == Section::Stat)
    cx.out << cx.root({v->owner, true}) << '.';
}

/// A field of the block whose code is written, maybe one of its bases'.
void emitOwnField(EmitContext &cx, const VarSymbol *v) {
  if (v->section != Section::Stat && v->owner != nullptr && cx.pou != nullptr &&
      v->owner->type != nullptr && v->owner != blockOf(cx.pou) && v->owner->isBlock())
    cx.out << pathToBase(blockOf(cx.pou), v->owner);
  cx.out << fieldName(v);
}

void emitVariable(EmitContext &cx, const VarSymbol *v, Span span) {
  const std::vector<const VarSymbol *> &locals = cx.modes.loops.locals;
  if (std::find(locals.begin(), locals.end(), v) != locals.end()) {
    cx.out << mangle(v->name.text);
    return;
  }
  if (v->location != nullptr) {
    emitLocated(cx, *v->location, v->type, [&] { emitField(cx, v); });
    return;
  }
  // A VAR_IN_OUT of the block is a C++ reference in its body only, not in methods and derived ones.
  const bool slot = v->section == Section::InOut && v->owner != nullptr &&
                    v->owner->type != nullptr && v->owner != cx.pou;
  if (v->type->kind != TypeKind::Reference && !slot) {
    emitField(cx, v);
    return;
  }
  cx.includes.complete(slot ? v->type : typeAs<PointerType>(v->type)->pointee);
  emitFollowed(cx, slot ? Slot::InOut : Slot::Reference, span, [&] { emitField(cx, v); });
}

void emitName(EmitContext &cx, const NameExpr *e) {
  const Symbol *symbol = e->symbol;
  switch (symbol->kind) {
  case SymbolKind::Pou:
    cx.includes.symbol(symbol);
    cx.out << cx.root({symbol, false});
    return;
  case SymbolKind::Property:
    emitPropertyGet(cx, nullptr, static_cast<const PropertySymbol *>(symbol), e->span);
    return;
  case SymbolKind::Self:
    emitSelf(cx, static_cast<const SelfSymbol *>(symbol));
    return;
  default:
    // An in-out is declared with the name of its type only.
    if (e->type->kind == TypeKind::Array || e->type->kind == TypeKind::Structure)
      cx.includes.complete(e->type);
    emitVariable(cx, static_cast<const VarSymbol *>(symbol), e->span);
  }
}

void emitDeref(EmitContext &cx, const DerefExpr *e) {
  const Expr *pointer = e->base;
  cx.includes.complete(e->type);
  if (pointer->kind == ExprKind::Name &&
      as<NameExpr>(pointer)->symbol->kind == SymbolKind::Self) { // never null
    const auto *self = static_cast<const SelfSymbol *>(as<NameExpr>(pointer)->symbol);
    cx.out << (self->isSuper ? "this->base__" : "(*this)");
    return;
  }
  emitFollowed(cx, Slot::Reference, e->span, [&] { emitCheckedPointer(cx, pointer); });
}

/// The slot of a member, or a static one.
void emitMemberField(EmitContext &cx, const MemberExpr *e) {
  const auto *field = static_cast<const VarSymbol *>(e->symbol);
  if (field->section == Section::Stat && field->owner != nullptr)
    cx.out << cx.root({field->owner, true}) << '.' << fieldName(field);
  else
    emitMemberSlot(cx, e);
}

/// A variable of a library, a list or (as a program) the application.
void emitNamespaceMember(EmitContext &cx, const MemberExpr *e) {
  if (e->symbol->kind != SymbolKind::Pou) {
    emitVariable(cx, static_cast<const VarSymbol *>(e->symbol), e->span);
    return;
  }
  cx.includes.symbol(e->symbol);
  cx.out << cx.root({e->symbol, false});
}

void emitMember(EmitContext &cx, const MemberExpr *e, bool slotOnly) {
  if (e->symbol->kind == SymbolKind::Property) {
    emitPropertyGet(cx, e->base, static_cast<const PropertySymbol *>(e->symbol), e->span);
    return;
  }
  if (isNamespace(e->base)) {
    emitNamespaceMember(cx, e);
    return;
  }
  const auto *field = static_cast<const VarSymbol *>(e->symbol);
  if (field->location != nullptr) {
    emitLocated(cx, *field->location, field->type, [&] { emitMemberSlot(cx, e); });
    return;
  }
  if (!isIndirect(field) || slotOnly) {
    emitMemberField(cx, e);
    return;
  }
  const bool isInOut = field->section == Section::InOut;
  cx.includes.complete(isInOut ? field->type : typeAs<PointerType>(field->type)->pointee);
  if (!cx.checks() && field->type->kind == TypeKind::OpenArray) { // the slot holds it itself
    cx.out << '(';
    emitMemberField(cx, e);
    cx.out << ')';
    return;
  }
  emitFollowed(cx, isInOut ? Slot::InOut : Slot::Reference, e->span,
               [&] { emitMemberField(cx, e); });
}

/// A variable whose tasks each have a copy of their own.
void emitCopyOfTask(EmitContext &cx, const Expr *e) {
  const auto *variable = static_cast<const VarSymbol *>(symbolAt(e));
  cx.includes.symbol(variable->globals);
  cx.out << "::stride::seen<" << cx.type(variable->type) << ">(" << cx.ctx() << ", "
         << copiesPlace(cx.run.names, variable) << ')';
}

/// A value that is looked into: `f().x`
void emitValuePlace(EmitContext &cx, const Expr *e) {
  if (e->kind == ExprKind::Call && returnsBlock(as<CallExpr>(e)->pou, e->type))
    emitBlockResult(cx, e->type, [&] { emitRaw(cx, e); });
  else
    emitRaw(cx, e);
}

/// What an in-out of the POU itself is: a C++ reference.
bool isBoundHere(const EmitContext &cx, const Expr *e, const VarSymbol *v) {
  return v->section == Section::InOut && v->owner == cx.pou && e->kind == ExprKind::Name;
}

/// The expression is held as an address: writing its slot writes that.
bool holdsAddress(const EmitContext &cx, const Expr *e) {
  if (const VarSymbol *v = indirectVariable(e))
    return !isBoundHere(cx, e, v);
  return e->kind == ExprKind::Index &&
         elementBeforeReference(as<IndexExpr>(e))->kind == TypeKind::Reference;
}

} // namespace

const VarSymbol *indirectVariable(const Expr *e) {
  const Symbol *symbol = isBitPlace(e) ? nullptr : symbolAt(e);
  if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
    return nullptr;
  const auto *v = static_cast<const VarSymbol *>(symbol);
  return isIndirect(v) ? v : nullptr;
}

std::string basePath(const Type *base, const VarSymbol *field) {
  std::string path;
  if (isInstance(base) && field->owner != nullptr)
    return pathToBase(typeAs<PouType>(base)->symbol, blockOf(field->owner));
  if (base->kind != TypeKind::Structure)
    return path;
  for (const auto *s = typeAs<StructType>(base); s->base != nullptr; s = s->base) {
    if (std::find(s->fields.begin(), s->fields.end(), field) != s->fields.end())
      return path;
    path += "base__.";
  }
  return path;
}

bool returnsBlock(const PouSymbol *from, const Type *type) {
  return from != nullptr && from->result != nullptr &&
         from->result->type->kind != TypeKind::Reference && Addressed::holdsBlock(type);
}

void emitBlockResult(EmitContext &cx, const Type *type, Part value) {
  cx.out << "::stride::OnDataStack<" << cx.type(type) << ">(" << cx.ctx() << ", ";
  value();
  cx.out << ").value()";
}

void emitFollowed(EmitContext &cx, Slot slot, Span span, Part address) {
  if (!cx.checks()) {
    cx.out << "(*";
    address();
    cx.out << ')';
    return;
  }
  cx.out << (slot == Slot::InOut ? "::stride::bound(" : "::stride::deref(") << cx.ctx() << ", ";
  address();
  cx.out << ", ";
  cx.position(span);
  cx.out << ')';
}

std::string placeText(EmitContext &cx, const Expr *e) {
  return cx.text([&] { emitPlace(cx, e); });
}

std::string writableText(EmitContext &cx, const Expr *e, std::string place) {
  return cx.isShared(e) ? "::stride::shared(" + place + ")" : std::move(place);
}

std::string writableText(EmitContext &cx, const Expr *e) {
  return writableText(cx, e, placeText(cx, e));
}

void emitPlace(EmitContext &cx, const Expr *e) {
  if (const auto found = cx.found.find(e); found != cx.found.end()) {
    cx.out << found->second;
    return;
  }
  if (cx.run.program.sharing.copies.contains(e)) {
    emitCopyOfTask(cx, e);
    return;
  }
  switch (e->kind) {
  case ExprKind::Name:
    return emitName(cx, as<NameExpr>(e));
  case ExprKind::Member:
    return emitMember(cx, as<MemberExpr>(e), false);
  case ExprKind::Index:
    return emitIndex(cx, as<IndexExpr>(e), false);
  case ExprKind::Direct:
    return emitLocated(cx, *as<DirectExpr>(e)->location, e->type, [] {});
  case ExprKind::Deref:
    return emitDeref(cx, as<DerefExpr>(e));
  default:
    return emitValuePlace(cx, e);
  }
}

void emitSlot(EmitContext &cx, const Expr *e) {
  if (e->kind == ExprKind::Index) {
    emitIndex(cx, as<IndexExpr>(e), true);
    return;
  }
  if (e->kind == ExprKind::Member && !isNamespace(as<MemberExpr>(e)->base)) {
    emitMember(cx, as<MemberExpr>(e), true);
    return;
  }
  const VarSymbol *v = indirectVariable(e);
  emitHolder(cx, v);
  if (v->globals != nullptr) {
    cx.out << mangle(v->name.text);
    return;
  }
  if (v->section != Section::Stat)
    cx.uses.add(v);
  emitOwnField(cx, v);
}

void emitField(EmitContext &cx, const VarSymbol *v) {
  emitHolder(cx, v);
  if (v->globals != nullptr || v->section == Section::Stat) {
    cx.out << mangle(v->name.text);
    return;
  }
  cx.uses.add(v);
  emitOwnField(cx, v);
}

void emitAddress(EmitContext &cx, const Expr *e) {
  if (e->type->kind == TypeKind::OpenArray) { // its first element
    emitPlace(cx, e);
    cx.out << ".data";
  } else if (holdsAddress(cx, e)) {
    emitSlot(cx, e);
  } else if (e->kind == ExprKind::Deref) {
    emitValue(cx, as<DerefExpr>(e)->base);
  } else if (e->constant != nullptr && e->target != nullptr) { // 0: nothing
    emitValue(cx, e);
  } else if (givesReference(e)) {
    emitFunctionCall(cx, as<CallExpr>(e), false);
  } else {
    cx.out << '&';
    emitPlace(cx, e);
  }
}

void emitMemberSlot(EmitContext &cx, const MemberExpr *e) {
  const auto *field = static_cast<const VarSymbol *>(e->symbol);
  cx.includes.complete(e->base->type);
  emitPlace(cx, e->base);
  cx.out << '.' << basePath(e->base->type, field) << fieldName(field);
}

void emitOpenArray(EmitContext &cx, const Expr *e, const OpenArrayType *wanted) {
  if (e->type->kind == TypeKind::OpenArray) {
    emitPlace(cx, e);
    return;
  }
  cx.out << "::stride::open<" << cx.type(wanted->element) << ", " << wanted->dimensions << ">(";
  cx.includes.complete(wanted);
  cx.includes.complete(e->type);
  emitPlace(cx, e);
  cx.out << ')';
}

} // namespace stc::codegen
