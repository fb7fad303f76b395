#ifndef STRIDE_COMPILER_CODEGEN_EXPRESSIONS_CONSTANTS_HPP
#define STRIDE_COMPILER_CODEGEN_EXPRESSIONS_CONSTANTS_HPP
// Constants as C++.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// A constant as it is written, texts excepted: equal ones look the same.
struct Constant {
  enum class Kind : uint8_t { Number, Real, Address, Enumerator };
  Kind kind = Kind::Number;
  const Type *type = nullptr; ///< of which it is written: no alias, no enumeration
  int64_t number = 0;
  uint64_t real = 0; ///< the bits of a double
  const EnumeratorSymbol *enumerator = nullptr;
  bool operator==(const Constant &) const = default;
};

/// The constant expression as one of `to`, which is no string.
[[nodiscard]] Constant constantOf(const ast::Expr *e, const Type *to);
void emitConstant(EmitContext &cx, const Constant &constant);

/// A constant of type `from` as one of `to`; `symbol` is the enumerator that names it, or null.
void emitLiteral(EmitContext &cx, const ConstValue &constant, const Type *from, const Type *to,
                 const Symbol *symbol = nullptr);
/// The same of a constant expression.
void emitLiteral(EmitContext &cx, const ast::Expr *e, const Type *to);
void emitNumber(EmitContext &cx, int64_t value, const Type *type);
/// The characters of a string constant in quotes.
void emitQuoted(EmitContext &cx, const ConstValue &constant, bool wide);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_EXPRESSIONS_CONSTANTS_HPP
