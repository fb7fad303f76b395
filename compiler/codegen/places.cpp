// Places that are no plain C++ variables: the process image, bits and parts.

#include "compiler/codegen/emitter.hpp"

namespace stc::codegen {

using namespace ast;

std::string_view Emitter::area(Area area) {
  static constexpr std::string_view kNames[] = {"i__", "q__", "m__"};
  const auto index = static_cast<std::size_t>(area);
  areas_ |= 1U << index;
  usesContext_ = true;
  return kNames[index];
}

const Expr *Emitter::bitOwner(const Expr *e) {
  while (e->kind == ExprKind::member && as<MemberExpr>(e)->bit >= 0)
    e = as<MemberExpr>(e)->base;
  return e;
}

void Emitter::bitAccess(const Expr *e, std::string_view bound) {
  if (const Location *at = locationOf(e)) {
    const std::string_view base = area(at->area);
    if (!at->isSlot) {
      w_ << "Bit(" << base << '[' << at->byte << "], " << int{at->bit};
      return;
    }
    w_ << "BitAt(" << base << ", ";
    if (e->kind == ExprKind::member && !isNamespace(as<MemberExpr>(e)->base))
      slotOf(as<MemberExpr>(e));
    else
      field(locatedVariable(e));
    return;
  }
  // `lw.%W1.%B0` is one part of lw.
  std::uint64_t first = 0;
  for (const Expr *part = e; part != bitOwner(e); part = as<MemberExpr>(part)->base)
    first += static_cast<std::uint64_t>(as<MemberExpr>(part)->bit) * as<MemberExpr>(part)->width;
  const unsigned width = as<MemberExpr>(e)->width;
  if (width == 1)
    w_ << "Bit(";
  else
    w_ << "Part<" << type(e->type) << ">(";
  if (bound.empty())
    place(bitOwner(e));
  else
    w_ << bound;
  w_ << ", " << first / width;
}

void Emitter::bitValue(const Expr *e) {
  w_ << "::stride::get";
  bitAccess(e, {});
  w_ << ')';
}

void Emitter::initLocated(std::string_view target, const VarSymbol *variable) {
  const Location &at = *variable->location;
  const Expr *init = c_.layouts.initOf(variable);
  if (at.bit >= 0) {
    if (init == nullptr)
      return;
    begin(initSpan_);
    const std::string_view base = area(at.area);
    if (at.isSlot)
      w_ << "::stride::setBitAt(" << base << ", " << target;
    else
      w_ << "::stride::setBit(" << base << '[' << at.byte << "], " << int{at.bit};
    w_ << ", ";
    valueAs(init, variable->type);
    w_ << ");";
    end();
    return;
  }
  const std::size_t start = w_.size();
  located(at, variable->type, [&] { w_ << target; });
  const std::string place = w_.cut(start);
  if (init == nullptr || init->kind == ExprKind::aggregate) {
    writtenDefault(place, variable->type, Layouts::written(variable));
    if (init != nullptr)
      initValue(place, variable->type, init);
    return;
  }
  begin(initSpan_);
  storeTo(place, variable->type, init);
  end();
}

} // namespace stc::codegen
