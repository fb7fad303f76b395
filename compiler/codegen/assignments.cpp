// Assignments: the place is found before the value is computed, whatever the value's calls do to
// what leads to the place.

#include "compiler/codegen/emitter.hpp"
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
  if (target->type->kind != TypeKind::array && target->type->kind != TypeKind::structure)
    return false;
  while (true) {
    switch (target->kind) {
    case ExprKind::deref:
      return true;
    case ExprKind::index:
      target = as<IndexExpr>(target)->base;
      if (target->type != nullptr && target->type->kind == TypeKind::pointer)
        return true;
      continue;
    case ExprKind::member: {
      const Type *base = as<MemberExpr>(target)->base->type;
      if (base != nullptr && base->kind == TypeKind::structure && typeAs<StructType>(base)->isUnion)
        return true;
      target = as<MemberExpr>(target)->base;
      continue;
    }
    default:
      return false;
    }
  }
}

} // namespace

void Emitter::storeTo(std::string_view target, const Type *type, const Expr *value) {
  if (type->kind == TypeKind::reference) {
    w_ << target << " = ";
    address(value);
    w_ << ';';
    return;
  }
  if (isString(type) && stringInto(target, value))
    return;
  if (isString(type) && isString(value->type) &&
      (value->constant != nullptr || value->type != type)) {
    w_ << "::stride::assign(" << target << ", ";
    if (value->constant != nullptr)
      quoted(*value->constant, type->kind == TypeKind::wstring);
    else
      raw(value);
    w_ << ");";
    return;
  }
  // Copying a block copies no binding of its in-outs: the target keeps its own.
  const bool bindings = c_.layouts.hasBindings(type);
  w_ << (bindings ? "::stride::assignBound(" : "") << target << (bindings ? ", " : " = ");
  if (type->kind == TypeKind::functionBlock && isInstance(value->type) && value->type != type) {
    raw(value); // the part of a block that it extends
    const std::string path =
        pathToBase(typeAs<PouType>(value->type)->symbol, typeAs<PouType>(type)->symbol);
    w_ << '.' << std::string_view(path).substr(0, path.size() - 1);
  } else if (bindings && value->type == type) {
    raw(value); // only what assign__ takes of it is copied
  } else {
    valueAs(value, type);
  }
  w_ << (bindings ? ");" : ";");
}

// -------------------------------------------------------------------------------------------------
// finding places

/// A value, not a place, whose methods may take its address.
bool Emitter::isBlockValue(const Expr *e) const {
  const PropertySymbol *property = writtenProperty(e);
  const PouSymbol *from = property != nullptr         ? accessor(property, true)
                          : e->kind == ExprKind::call ? as<CallExpr>(e)->pou
                                                      : nullptr;
  return from != nullptr && from->result != nullptr &&
         from->result->type->kind != TypeKind::reference && Addressed::holdsBlock(e->type);
}

void Emitter::findPlace(Found &found, const Expr *place, bool always) {
  const Expr *at = containerOf(place); // also because nothing can be bound to a packed field
  if (c_.analysis.placeEffects(at, pou_) == effectNone && !(always && at->kind == ExprKind::index))
    return;
  const std::string name = temporary("to");
  if (isBlockValue(at)) { // in a place of its own for as long as something is done with it
    includes_.complete(at->type);
    w_ << "::stride::OnDataStack<" << type(at->type) << "> " << name << "__local(" << ctx() << ", ";
    raw(at);
    w_ << "); auto &" << name << " = " << name << "__local.value(); ";
    found.set(at, name);
    return;
  }
  writing_ = true;
  const std::string text = placeText(at);
  writing_ = false;
  const bool packed = isMisaligned(at);
  if (packed) {
    w_ << "auto &" << name << " = reinterpret_cast<::stride::Unaligned<" << type(at->type)
       << "> &>(" << text << "); ";
  } else {
    const bool mayBeValue = at->kind == ExprKind::call || writtenProperty(at) != nullptr;
    w_ << (mayBeValue ? "auto &&" : "auto &") << name << " = " << text << "; ";
  }
  found.set(at, packed ? name + ".v" : name);
}

void Emitter::findTarget(Found &found, const Expr *target) {
  if (writtenProperty(target) == nullptr)
    findPlace(found, target);
  else if (target->kind == ExprKind::member && !isNamespace(as<MemberExpr>(target)->base))
    findObject(found, as<MemberExpr>(target)->base);
}

void Emitter::findObject(Found &found, const Expr *object) {
  if (object->type->kind != TypeKind::interface) {
    findPlace(found, object);
    return;
  }
  const std::string name = temporary("object");
  w_ << "const ::stride::Interface " << name << " = ";
  interfaceOf(object, object->span);
  w_ << "; ";
  found.set(object, name);
}

// -------------------------------------------------------------------------------------------------
// statements

void Emitter::store(const Expr *target, const Expr *value) {
  if (writtenProperty(target) != nullptr) {
    propertySet(target, [&] { valueAs(value, target->type); });
    return;
  }
  if (isBitPlace(target)) {
    bitStore(target, [&] { valueAs(value, target->type); });
    return;
  }
  writing_ = true;
  const std::string to = writableText(target);
  writing_ = false;
  if (mayOverlap(target) && !c_.layouts.hasBindings(target->type)) {
    includes_.complete(target->type);
    w_ << "::stride::copy(" << to << ", ";
    valueAs(value, target->type);
    w_ << ");";
    return;
  }
  storeTo(to, target->type, value);
}

/// `a := b := value`: the places from left to right, then the value, which goes from right to left.
void Emitter::assignValue(const AssignStmt *s) {
  unsigned places = effectNone;
  for (const Expr *target : s->targets)
    places |= c_.analysis.targetEffects(target, pou_);
  const bool finds = s->targets.size() > 1 ? places != effectNone
                                           : Analysis::orderShows(places, effects(s->value));
  Found found(*this);
  if (finds) {
    w_ << "{ ";
    for (const Expr *target : s->targets)
      findTarget(found, target);
  }
  store(s->targets.back(), s->value);
  for (std::size_t i = s->targets.size() - 1; i-- > 0;) {
    w_ << ' ';
    const Expr *from = s->targets[i + 1];
    const std::size_t start = w_.size();
    raw(from);
    const std::string source = w_.cut(start);
    outputTo(s->targets[i], source, from->type, s->span);
  }
  w_ << (finds ? " }" : "");
}

/// `r REF= place`: what holds the reference is found first.
void Emitter::assignReference(const AssignStmt *s) {
  const Expr *target = s->targets.back();
  const bool isMember =
      target->kind == ExprKind::member && !isNamespace(as<MemberExpr>(target)->base);
  const unsigned where = isMember ? c_.analysis.placeEffects(as<MemberExpr>(target)->base, pou_)
                         : target->kind == ExprKind::index ? c_.analysis.placeEffects(target, pou_)
                                                           : unsigned{effectNone};
  const bool finds = Analysis::orderShows(where, c_.analysis.placeEffects(s->value, pou_));
  Found found(*this);
  w_ << (finds ? "{ " : "");
  if (finds && isMember)
    findPlace(found, as<MemberExpr>(target)->base);
  if (finds && !isMember) {
    const std::string name = temporary("to");
    w_ << "auto &" << name << " = ";
    slot(target);
    w_ << "; " << name;
  } else {
    slot(target);
  }
  w_ << " = ";
  addressAs(s->value, target->type);
  w_ << (finds ? "; }" : ";");
}

/// `S=`, `R=`: the places are found even where the condition is not met.
void Emitter::setOrReset(const AssignStmt *s) {
  const std::string_view set = s->op == AssignOp::set ? "true" : "false";
  unsigned places = effectNone;
  for (const Expr *target : s->targets)
    places |= c_.analysis.targetEffects(target, pou_);
  const bool finds = (places & (effectRaises | effectCalls)) != 0 ||
                     Analysis::orderMatters(places, effects(s->value));
  Found found(*this);
  if (finds) {
    w_ << "{ ";
    for (const Expr *target : s->targets)
      findTarget(found, target);
  }
  w_ << "if (";
  condition(s->value);
  w_ << ") { ";
  for (const Expr *target : s->targets) {
    if (isBitPlace(target))
      bitStore(target, [&] { w_ << set; });
    else if (writtenProperty(target) != nullptr)
      propertySet(target, [&] { w_ << set; });
    else
      w_ << writableText(target) << " = " << set << ';';
    w_ << ' ';
  }
  w_ << (finds ? "} }" : "}");
}

void Emitter::assign(const AssignStmt *s) {
  begin(s->span);
  switch (s->op) {
  case AssignOp::reference:
    assignReference(s);
    break;
  case AssignOp::set:
  case AssignOp::reset:
    setOrReset(s);
    break;
  case AssignOp::assign:
    assignValue(s);
    break;
  }
  end();
}

} // namespace stc::codegen
