#include "compiler/codegen/places/located.hpp"

#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/initial/initializers.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/codegen/statements/assignments.hpp"
#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/plain_data.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// The variable that a bit or part belongs to.
const Expr *bitOwner(const Expr *e) {
  while (e->kind == ExprKind::Member && as<MemberExpr>(e)->bit >= 0)
    e = as<MemberExpr>(e)->base;
  return e;
}

/// `Bit(image__m[3], 5`: the end of the runtime function's name and the first arguments.
void openImageBit(EmitContext &cx, const Expr *e, const Location &at, bool writes) {
  const bool shared = cx.isShared(bitOwner(e));
  const std::string_view base = cx.area(at.area);
  if (!at.isSlot) {
    const bool loads = shared && !writes;
    cx.out << (shared && writes ? "SharedBit(" : "Bit(") << (loads ? "::stride::load(" : "") << base
           << '[' << at.byte << (loads ? "]), " : "], ") << int{at.bit};
    return;
  }
  cx.out << (shared ? "SharedBitAt(" : "BitAt(") << base << ", ";
  if (e->kind == ExprKind::Member && !isNamespace(as<MemberExpr>(e)->base))
    emitMemberSlot(cx, as<MemberExpr>(e));
  else
    emitField(cx, locatedVariable(e));
}

/// `Bit(x, 5`, `Part<::stride::BYTE>(x, 1`
void openBit(EmitContext &cx, const Expr *e, bool writes) {
  const Expr *owner = bitOwner(e);
  const bool shared = cx.isShared(owner);
  const bool loads = shared && !writes;
  // `lw.%W1.%B0` is one part of lw.
  uint64_t first = 0;
  for (const Expr *part = e; part != owner; part = as<MemberExpr>(part)->base)
    first += static_cast<uint64_t>(as<MemberExpr>(part)->bit) * as<MemberExpr>(part)->width;
  const unsigned width = as<MemberExpr>(e)->width;
  cx.out << (shared && writes ? "Shared" : "");
  if (width == 1)
    cx.out << "Bit(";
  else
    cx.out << "Part<" << cx.type(e->type) << ">(";
  cx.out << (loads ? "::stride::load(" : "");
  emitPlace(cx, owner);
  cx.out << (loads ? ")" : "") << ", " << first / width;
}

void openBitAccess(EmitContext &cx, const Expr *e, bool writes) {
  if (const Location *at = locationOf(e))
    openImageBit(cx, e, *at, writes);
  else
    openBit(cx, e, writes);
}

std::string locatedText(EmitContext &cx, const Location &at, const Type *type, Part slot) {
  return cx.text([&] { emitLocated(cx, at, type, slot); });
}

/// `target = value;` on lines of its own.
void initPlace(EmitContext &cx, std::string_view place, const Type *type, const Expr *init) {
  cx.begin(cx.modes.init.span);
  emitStoreTo(cx, place, type, init);
  cx.end();
}

/// Values of the type are zero before: it has no default that a zero replaces.
bool isZeroed(const EmitContext &cx, const Type *type) { return !cx.run.layouts.needsInit(type); }

/// The same for a bit of the image.
void initBit(EmitContext &cx, const Location &at, std::string_view slot, const Type *type,
             const Expr *init) {
  cx.begin(cx.modes.init.span);
  const std::string_view base = cx.area(at.area);
  if (at.isSlot)
    cx.out << "::stride::setBitAt(" << base << ", " << slot;
  else
    cx.out << "::stride::setBit(" << base << '[' << at.byte << "], " << int{at.bit};
  cx.out << ", ";
  emitValueAs(cx, init, type);
  cx.out << ");";
  cx.end();
}

} // namespace

void emitLocated(EmitContext &cx, const Location &at, const Type *type, Part slot) {
  const std::string_view base = cx.area(at.area);
  const bool aligned = at.isSlot || at.byte % alignmentOf(type) == 0;
  cx.out << (aligned ? "::stride::at<" : "::stride::unaligned<") << cx.type(type) << ">(" << base
         << ", ";
  if (at.isSlot)
    slot();
  else
    cx.out << at.byte;
  cx.out << (aligned ? ")" : ").v");
}

void emitBitValue(EmitContext &cx, const Expr *e) {
  cx.out << "::stride::get";
  openBitAccess(cx, e, false);
  cx.out << ')';
}

void emitBitStore(EmitContext &cx, const Expr *e, Part value) {
  if (isBitField(e)) {
    emitPlace(cx, e);
    cx.out << " = ";
    value();
    cx.out << ';';
    return;
  }
  cx.out << "::stride::set";
  openBitAccess(cx, e, true);
  cx.out << ", ";
  value();
  cx.out << ");";
}

void initLocated(EmitContext &cx, std::string_view target, const VarSymbol *variable) {
  const Location &at = *variable->location;
  const Expr *init = cx.run.layouts.initOf(variable);
  if (at.bit >= 0) {
    if (init != nullptr)
      initBit(cx, at, target, variable->type, init);
    return;
  }
  const std::string place = locatedText(cx, at, variable->type, [&] { cx.out << target; });
  if (init == nullptr || init->kind == ExprKind::Aggregate) {
    initWritten(cx, place, variable->type, Layouts::written(variable));
    if (init != nullptr) {
      const Scoped<bool> zeroed(cx.modes.init.zeroed, isZeroed(cx, variable->type));
      initValue(cx, place, variable->type, init);
    }
    return;
  }
  initPlace(cx, place, variable->type, init);
}

void copyPlaced(EmitContext &cx, const VarSymbol *v) {
  const Location &at = *v->location;
  const auto place = [&](std::string_view object) {
    emitLocated(cx, at, v->type, [&] { cx.out << object << fieldName(v); });
  };
  cx.out.line();
  if (at.bit >= 0) {
    const std::string_view area = cx.area(at.area);
    cx.out << "::stride::setSharedBitAt(" << area << ", this->" << fieldName(v)
           << ", ::stride::getSharedBitAt(" << area << ", from." << fieldName(v) << "));";
  } else {
    const bool isScalar = isScalarValue(v->type);
    cx.out << (isScalar ? "::stride::shared(" : "");
    place("this->");
    cx.out << (isScalar ? ") = ::stride::load(" : " = ");
    place("from.");
    cx.out << (isScalar ? ");" : ";");
  }
  cx.end();
}

void initConfigured(EmitContext &cx, const SlotPlace &entry) {
  const Scoped<Initialised> mode(
      cx.modes.init,
      {entry.decl->name.span.valid() ? entry.decl->name.span : entry.decl->path->span});
  const Expr *init = entry.decl->init;
  std::string place;
  const Type *type = nullptr;
  if (entry.placed && entry.variable != nullptr) {
    type = entry.variable->type;
    if (entry.at.bit >= 0) {
      initBit(cx, entry.at, {}, type, init);
      return;
    }
    place = locatedText(cx, entry.at, type, [] {});
  } else {
    type = entry.path.steps.empty() ? static_cast<const VarSymbol *>(entry.path.root)->type
                                    : typeAt(entry.path);
    place = std::string(cx.root(rootOf(entry.path))) + pathInRoot(entry.path);
  }
  cx.modes.init.zeroed = isZeroed(cx, type);
  if (init->kind == ExprKind::Aggregate)
    initValue(cx, place, type, init);
  else
    initPlace(cx, place, type, init);
}

} // namespace stc::codegen
