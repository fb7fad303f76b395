// Checks that the project replaces by functions of its own: CheckBounds, CheckDivInt …

#include "compiler/codegen/emitter.hpp"

#include <limits>

namespace stc::codegen {

using namespace ast;

const PouSymbol *Emitter::ownCheck(ImplicitCheck check) {
  const PouSymbol *pou = c_.program.implicitChecks[static_cast<std::size_t>(check)];
  if (pou == nullptr || isCheck_ || !checks())
    return nullptr;
  includes_.symbol(pou);
  return pou;
}

void Emitter::checkedIndex(const Expr *index, const ArrayType *array) {
  const auto fits = [](std::int64_t v) {
    return v >= std::numeric_limits<std::int32_t>::min() &&
           v <= std::numeric_limits<std::int32_t>::max();
  };
  const PouSymbol *own =
      fits(array->low) && fits(array->high) ? ownCheck(ImplicitCheck::bounds) : nullptr;
  if (own == nullptr) {
    value(index);
    return;
  }
  w_ << c_.names.qualified(own) << '(' << ctx() << ", static_cast<::stride::DINT>(";
  value(index);
  w_ << "), " << array->low << ", " << array->high << ')';
}

bool Emitter::openRangeCheck(const SubrangeType *range) {
  const Type *base = range->base;
  const bool wide = bitWidth(base) == 64;
  const PouSymbol *own =
      ownCheck(isSignedInteger(base)
                   ? (wide ? ImplicitCheck::rangeLongSigned : ImplicitCheck::rangeSigned)
                   : (wide ? ImplicitCheck::rangeLongUnsigned : ImplicitCheck::rangeUnsigned));
  if (own == nullptr)
    return false;
  w_ << c_.names.qualified(own) << '(' << ctx() << ", ";
  return true;
}

bool Emitter::openDivisorCheck(const BinaryExpr *e) {
  if (e->right->constant != nullptr) // never zero: that has been reported
    return false;
  const Type *type = underlying(e->operandType);
  // What the operands were before widening; the check of a wider type serves as well.
  const Type *narrow = e->common != nullptr ? underlying(e->common) : type;
  std::vector<ImplicitCheck> candidates;
  if (type->kind == TypeKind::real)
    candidates = {ImplicitCheck::divReal, ImplicitCheck::divLreal};
  else if (type->kind == TypeKind::lreal)
    candidates = {ImplicitCheck::divLreal};
  else {
    const unsigned width = bitWidth(narrow);
    if (isBitString(narrow) || isUnsignedInteger(narrow)) {
      if (width <= 8)
        candidates.push_back(ImplicitCheck::divByte);
      if (width <= 16)
        candidates.push_back(ImplicitCheck::divWord);
      if (width <= 32)
        candidates.push_back(ImplicitCheck::divDword);
    }
    const bool isSigned = isSignedInteger(narrow);
    if (width < 16 || (width == 16 && isSigned))
      candidates.push_back(ImplicitCheck::divInt);
    if (width < 32 || (width == 32 && isSigned))
      candidates.push_back(ImplicitCheck::divDint);
    candidates.push_back(ImplicitCheck::divLint);
  }
  for (const ImplicitCheck candidate : candidates) {
    const PouSymbol *own = ownCheck(candidate);
    if (own == nullptr)
      continue;
    w_ << "static_cast<" << this->type(type) << ">(" << c_.names.qualified(own) << '(' << ctx()
       << ", ";
    return true;
  }
  return false;
}

void Emitter::checkedPointer(const Expr *pointer) {
  const PouSymbol *own = ownCheck(ImplicitCheck::pointer);
  if (own == nullptr) {
    value(pointer);
    return;
  }
  const Type *pointee = typeAs<PointerType>(underlying(pointer->type))->pointee;
  const std::string to(type(pointer->type));
  includes_.complete(pointee);
  const std::string_view target = type(pointee);
  w_ << "reinterpret_cast<" << to << ">(" << c_.names.qualified(own) << '(' << ctx()
     << ", reinterpret_cast<" << type(own->parameters().front()->type) << ">(";
  const bool writing = writing_;
  writing_ = false;
  value(pointer);
  writing_ = writing;
  w_ << "), sizeof(" << target << "), alignof(" << target << "), " << (writing ? "true" : "false")
     << "))";
}

} // namespace stc::codegen
