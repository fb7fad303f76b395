#include "compiler/codegen/places/own_checks.hpp"

#include "compiler/codegen/expressions/expressions.hpp"

#include <limits>

namespace stc::codegen {

using namespace ast;

const PouSymbol *ownCheck(EmitContext &cx, ImplicitCheck check) {
  const PouSymbol *pou = cx.run.program.implicitChecks[static_cast<size_t>(check)];
  // The project's checks are for its own code: that of its libraries is the same everywhere.
  if (pou == nullptr || cx.isCheck() || !cx.checks() || !cx.run.own->isUser)
    return nullptr;
  cx.includes.symbol(pou);
  return pou;
}

void emitCheckedIndex(EmitContext &cx, const Expr *index, const ArrayType *array) {
  const auto fits = [](int64_t v) {
    return v >= std::numeric_limits<int32_t>::min() && v <= std::numeric_limits<int32_t>::max();
  };
  const PouSymbol *own =
      fits(array->low) && fits(array->high) ? ownCheck(cx, ImplicitCheck::Bounds) : nullptr;
  if (own == nullptr) {
    emitValue(cx, index);
    return;
  }
  cx.out << cx.run.names.qualified(own) << '(' << cx.ctx() << ", static_cast<::stride::DINT>(";
  emitValue(cx, index);
  cx.out << "), " << array->low << ", " << array->high << ')';
}

bool openRangeCheck(EmitContext &cx, const SubrangeType *range) {
  const Type *base = range->base;
  const bool wide = bitWidth(base) == 64;
  const PouSymbol *own =
      ownCheck(cx, isSignedInteger(base)
                       ? (wide ? ImplicitCheck::RangeLongSigned : ImplicitCheck::RangeSigned)
                       : (wide ? ImplicitCheck::RangeLongUnsigned : ImplicitCheck::RangeUnsigned));
  if (own == nullptr)
    return false;
  cx.out << cx.run.names.qualified(own) << '(' << cx.ctx() << ", ";
  return true;
}

namespace {

/// The checks that serve for a divisor, best first. `narrow` is what the operands were before
/// widening; the check of a wider type serves as well.
std::vector<ImplicitCheck> divisorChecks(const Type *type, const Type *narrow) {
  using enum ImplicitCheck;
  if (type->kind == TypeKind::Real)
    return {DivReal, DivLreal};
  if (type->kind == TypeKind::Lreal)
    return {DivLreal};
  std::vector<ImplicitCheck> checks;
  const unsigned width = bitWidth(narrow);
  const auto addIf = [&](bool serves, ImplicitCheck check) {
    if (serves)
      checks.push_back(check);
  };
  const bool isUnsigned = isBitString(narrow) || isUnsignedInteger(narrow);
  addIf(isUnsigned && width <= 8, DivByte);
  addIf(isUnsigned && width <= 16, DivWord);
  addIf(isUnsigned && width <= 32, DivDword);
  const bool isSigned = isSignedInteger(narrow);
  addIf(width < 16 || (width == 16 && isSigned), DivInt);
  addIf(width < 32 || (width == 32 && isSigned), DivDint);
  addIf(true, DivLint);
  return checks;
}

} // namespace

bool openDivisorCheck(EmitContext &cx, const BinaryExpr *e) {
  if (e->right->constant != nullptr) // never zero: that has been reported
    return false;
  const Type *type = underlying(e->operandType);
  const Type *narrow = e->common != nullptr ? underlying(e->common) : type;
  for (const ImplicitCheck check : divisorChecks(type, narrow)) {
    const PouSymbol *own = ownCheck(cx, check);
    if (own == nullptr)
      continue;
    cx.out << "static_cast<" << cx.type(type) << ">(" << cx.run.names.qualified(own) << '('
           << cx.ctx() << ", ";
    return true;
  }
  return false;
}

void emitCheckedPointer(EmitContext &cx, const Expr *pointer) {
  const PouSymbol *own = ownCheck(cx, ImplicitCheck::Pointer);
  if (own == nullptr) {
    emitValue(cx, pointer);
    return;
  }
  const Type *pointee = typeAs<PointerType>(underlying(pointer->type))->pointee;
  const std::string to(cx.type(pointer->type));
  cx.includes.complete(pointee);
  const std::string_view target = cx.type(pointee);
  cx.out << "reinterpret_cast<" << to << ">(" << cx.run.names.qualified(own) << '(' << cx.ctx()
         << ", reinterpret_cast<" << cx.type(own->parameters().front()->type) << ">(";
  const bool writing = cx.modes.writing;
  {
    const Scoped<bool> reading(cx.modes.writing, false);
    emitValue(cx, pointer);
  }
  cx.out << "), sizeof(" << target << "), alignof(" << target << "), "
         << (writing ? "true" : "false") << "))";
}

} // namespace stc::codegen
