#include "compiler/codegen/statements/assignments.hpp"

#include "compiler/codegen/calls/builtin_calls.hpp"
#include "compiler/codegen/calls/calls.hpp"
#include "compiler/codegen/calls/methods.hpp"
#include "compiler/codegen/expressions/constants.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/places/located.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// A whole array or structure in a UNION or behind a pointer may share some of its bytes with the
/// value.
bool mayOverlap(const Expr *target) {
  if (target->type->kind != TypeKind::Array && target->type->kind != TypeKind::Structure)
    return false;
  while (true) {
    switch (target->kind) {
    case ExprKind::Deref:
      return true;
    case ExprKind::Index:
      target = as<IndexExpr>(target)->base;
      if (target->type != nullptr && target->type->kind == TypeKind::Pointer)
        return true;
      continue;
    case ExprKind::Member: {
      const Type *base = as<MemberExpr>(target)->base->type;
      if (base != nullptr && base->kind == TypeKind::Structure && typeAs<StructType>(base)->isUnion)
        return true;
      target = as<MemberExpr>(target)->base;
      continue;
    }
    default:
      return false;
    }
  }
}

// -------------------------------------------------------------------------------------------------
// finding places

/// A value, not a place, whose methods may take its address.
bool isBlockValue(const Expr *e) {
  const PropertySymbol *property = writtenProperty(e);
  if (property != nullptr)
    return returnsBlock(accessorOf(property, true), e->type);
  return e->kind == ExprKind::Call && returnsBlock(as<CallExpr>(e)->pou, e->type);
}

/// The place as checks of pointers see it that is about to be written.
std::string writtenPlaceText(EmitContext &cx, const Expr *place) {
  const Scoped<bool> writing(cx.modes.writing, true);
  return placeText(cx, place);
}

// -------------------------------------------------------------------------------------------------
// statements

void emitStore(EmitContext &cx, const Expr *target, const Expr *value) {
  if (writtenProperty(target) != nullptr) {
    emitPropertySet(cx, target, [&] { emitValueAs(cx, value, target->type); });
    return;
  }
  if (isBitPlace(target)) {
    emitBitStore(cx, target, [&] { emitValueAs(cx, value, target->type); });
    return;
  }
  const std::string to = writableText(cx, target, writtenPlaceText(cx, target));
  if (mayOverlap(target) && !cx.run.layouts.hasBindings(target->type)) {
    cx.includes.complete(target->type);
    cx.out << "::stride::copy(" << to << ", ";
    emitValueAs(cx, value, target->type);
    cx.out << ");";
    return;
  }
  emitStoreTo(cx, to, target->type, value);
}

unsigned targetEffects(EmitContext &cx, const AssignStmt *s) {
  unsigned places = kEffectNone;
  for (const Expr *target : s->targets)
    places |= cx.run.analysis.targetEffects(target, cx.pou);
  return places;
}

/// `a := b := value`: the places from left to right, then the value, which goes from right to left.
void emitValueAssignment(EmitContext &cx, const AssignStmt *s) {
  const unsigned places = targetEffects(cx, s);
  const bool finds = s->targets.size() > 1 ? places != kEffectNone
                                           : Analysis::orderShows(places, cx.effects(s->value));
  Found found(cx);
  if (finds) {
    cx.out << "{ ";
    for (const Expr *target : s->targets)
      findTarget(cx, found, target);
  }
  emitStore(cx, s->targets.back(), s->value);
  for (size_t i = s->targets.size() - 1; i-- > 0;) {
    cx.out << ' ';
    const Expr *from = s->targets[i + 1];
    const std::string source = cx.text([&] { emitRaw(cx, from); });
    emitOutputTo(cx, s->targets[i], source, from->type, s->span);
  }
  cx.out << (finds ? " }" : "");
}

/// `r REF= place`: what holds the reference is found first.
void emitReferenceAssignment(EmitContext &cx, const AssignStmt *s) {
  const Expr *target = s->targets.back();
  const bool isMember =
      target->kind == ExprKind::Member && !isNamespace(as<MemberExpr>(target)->base);
  const unsigned where =
      isMember ? cx.run.analysis.placeEffects(as<MemberExpr>(target)->base, cx.pou)
      : target->kind == ExprKind::Index ? cx.run.analysis.placeEffects(target, cx.pou)
                                        : unsigned{kEffectNone};
  const bool finds = Analysis::orderShows(where, cx.run.analysis.placeEffects(s->value, cx.pou));
  Found found(cx);
  cx.out << (finds ? "{ " : "");
  if (finds && isMember)
    findPlace(cx, found, as<MemberExpr>(target)->base);
  if (finds && !isMember) {
    const std::string name = cx.temporary("to");
    cx.out << "auto &" << name << " = ";
    emitSlot(cx, target);
    cx.out << "; " << name;
  } else {
    emitSlot(cx, target);
  }
  cx.out << " = ";
  emitAddressAs(cx, s->value, target->type);
  cx.out << (finds ? "; }" : ";");
}

/// `S=`, `R=`: the places are found even where the condition is not met.
void emitSetOrReset(EmitContext &cx, const AssignStmt *s) {
  const std::string_view set = s->op == AssignOp::Set ? "true" : "false";
  const unsigned places = targetEffects(cx, s);
  const bool finds = (places & (kEffectRaises | kEffectCalls)) != 0 ||
                     Analysis::orderMatters(places, cx.effects(s->value));
  Found found(cx);
  if (finds) {
    cx.out << "{ ";
    for (const Expr *target : s->targets)
      findTarget(cx, found, target);
  }
  cx.out << "if (";
  emitValue(cx, s->value);
  cx.out << ") { ";
  for (const Expr *target : s->targets) {
    if (isBitPlace(target))
      emitBitStore(cx, target, [&] { cx.out << set; });
    else if (writtenProperty(target) != nullptr)
      emitPropertySet(cx, target, [&] { cx.out << set; });
    else
      cx.out << writableText(cx, target) << " = " << set << ';';
    cx.out << ' ';
  }
  cx.out << (finds ? "} }" : "}");
}

} // namespace

void emitStoreTo(EmitContext &cx, std::string_view target, const Type *type, const Expr *value) {
  if (type->kind == TypeKind::Reference) {
    cx.out << target << " = ";
    emitAddress(cx, value);
    cx.out << ';';
    return;
  }
  if (isString(type) && emitStringInto(cx, target, value))
    return;
  if (isString(type) && isString(value->type) &&
      (value->constant != nullptr || value->type != type)) {
    cx.out << "::stride::assign(" << target << ", ";
    if (value->constant != nullptr)
      emitQuoted(cx, *value->constant, type->kind == TypeKind::Wstring);
    else
      emitRaw(cx, value);
    cx.out << ");";
    return;
  }
  // Copying a block copies no binding of its in-outs: the target keeps its own.
  const bool bindings = cx.run.layouts.hasBindings(type);
  if (bindings)
    cx.out << "::stride::assignBound(" << cx.ctx() << ", ";
  cx.out << target << (bindings ? ", " : " = ");
  if (type->kind == TypeKind::FunctionBlock && isInstance(value->type) && value->type != type) {
    emitRaw(cx, value); // the part of a block that it extends
    cx.out << baseSuffix(typeAs<PouType>(value->type)->symbol, typeAs<PouType>(type)->symbol);
  } else if (bindings && value->type == type) {
    emitRaw(cx, value); // only what assign__ takes of it is copied
  } else {
    emitValueAs(cx, value, type);
  }
  cx.out << (bindings ? ");" : ";");
}

void findPlace(EmitContext &cx, Found &found, const Expr *place, bool always) {
  const Expr *at = containerOf(place); // also because nothing can be bound to a packed field
  if (cx.run.analysis.placeEffects(at, cx.pou) == kEffectNone &&
      !(always && at->kind == ExprKind::Index))
    return;
  const std::string name = cx.temporary("to");
  if (isBlockValue(at)) { // in a place of its own for as long as something is done with it
    cx.includes.complete(at->type);
    cx.out << "::stride::OnDataStack<" << cx.type(at->type) << "> " << name << "__local("
           << cx.ctx() << ", ";
    emitRaw(cx, at);
    cx.out << "); auto &" << name << " = " << name << "__local.value(); ";
    found.set(at, name);
    return;
  }
  const std::string text = writtenPlaceText(cx, at);
  const bool packed = isMisaligned(at);
  if (packed) {
    cx.out << "auto &" << name << " = reinterpret_cast<::stride::Unaligned<" << cx.type(at->type)
           << "> &>(" << text << "); ";
  } else {
    const bool mayBeValue = at->kind == ExprKind::Call || writtenProperty(at) != nullptr;
    cx.out << (mayBeValue ? "auto &&" : "auto &") << name << " = " << text << "; ";
  }
  found.set(at, packed ? name + ".v" : name);
}

void findTarget(EmitContext &cx, Found &found, const Expr *target) {
  if (writtenProperty(target) == nullptr)
    findPlace(cx, found, target);
  else if (target->kind == ExprKind::Member && !isNamespace(as<MemberExpr>(target)->base))
    findObject(cx, found, as<MemberExpr>(target)->base);
}

void findObject(EmitContext &cx, Found &found, const Expr *object) {
  if (object->type->kind != TypeKind::Interface) {
    findPlace(cx, found, object);
    return;
  }
  const std::string name = cx.temporary("object");
  cx.out << "const ::stride::Interface " << name << " = ";
  emitInterface(cx, object, object->span);
  cx.out << "; ";
  found.set(object, name);
}

void emitAssignment(EmitContext &cx, const AssignStmt *s) {
  cx.begin(s->span);
  switch (s->op) {
  case AssignOp::Reference:
    emitReferenceAssignment(cx, s);
    break;
  case AssignOp::Set:
  case AssignOp::Reset:
    emitSetOrReset(cx, s);
    break;
  case AssignOp::Assign:
    emitValueAssignment(cx, s);
    break;
  }
  cx.end();
}

} // namespace stc::codegen
