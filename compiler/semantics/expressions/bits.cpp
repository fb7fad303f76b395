// Bits and parts of integers: `w.3`, `w.cBit`, `w.%B1`.

#include "compiler/semantics/expressions/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/names/names.hpp"

namespace stc::sema {

using namespace ast;

bool bitByName(Context &c, MemberExpr *expr) {
  const Type *base = underlying(expr->base->type);
  if (!isInteger(base))
    return false;
  Symbol *symbol = lookup(c, expr->name);
  if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
    return false;
  auto *variable = static_cast<VarSymbol *>(symbol);
  if (!variable->isConstant || !isInteger(underlying(typeOf(c, variable))))
    return false;
  checkInitOf(c, variable);
  if (variable->constant == nullptr)
    return false;
  const int64_t bit = variable->constant->integer;
  if (bit < 0 || bit >= bitWidth(base)) {
    auto &d = c.report(Code::BitOutOfRange, expr->name.span,
                       typeName(expr->base->type) + " has no bit " + std::to_string(bit),
                       "the bits are 0 to " + std::to_string(bitWidth(base) - 1));
    noteDeclaration(d, variable);
    expr->bit = 0;
    return true;
  }
  expr->bit = static_cast<int32_t>(bit);
  variable->uses |= kUseRead; // the bit's number is all that is left of the name
  return true;
}

const Type *checkBit(Context &c, MemberExpr *expr) {
  const Type *base = expr->name ? expr->base->type : check(c, expr->base);
  if (isError(base))
    return base;
  const Type *u = underlying(base);
  const bool part = expr->width > 1;
  const std::string what = part ? "part" : "bit";
  if (!isInteger(u) || base->kind == TypeKind::Enumeration) {
    auto &d = c.report(Code::BitOutOfRange, expr->span,
                       typeName(base) + " has no " + what + "s to select",
                       "only possible on integers and bit strings");
    if (isReal(u))
      d.help("look at the bytes of a REAL through a UNION or a pointer");
    else if (base->kind == TypeKind::Enumeration)
      d.help("convert it first: `" + typeName(u) + "_TO_WORD(…)`");
    return elementaryType(TypeKind::Error);
  }
  const unsigned count = bitWidth(u) / expr->width;
  if (static_cast<unsigned>(expr->bit) >= count) {
    static constexpr std::string_view kParts[] = {"", "byte", "word", "double word", "long word"};
    const std::string_view name = kParts[expr->width == 8    ? 1
                                         : expr->width == 16 ? 2
                                         : expr->width == 32 ? 3
                                         : expr->width == 64 ? 4
                                                             : 0];
    const std::string noun = part ? std::string(name) : what;
    c.report(Code::BitOutOfRange, expr->span,
             typeName(base) + " has no " + noun + " " + std::to_string(expr->bit),
             count == 0   ? "it is narrower than that"
             : count == 1 ? "there is only " + noun + " 0"
                          : "the " + noun + "s are 0 to " + std::to_string(count - 1));
    return elementaryType(TypeKind::Error);
  }
  switch (expr->width) {
  case 8:
    return elementaryType(TypeKind::Byte);
  case 16:
    return elementaryType(TypeKind::Word);
  case 32:
    return elementaryType(TypeKind::Dword);
  case 64:
    return elementaryType(TypeKind::Lword);
  default:
    return elementaryType(TypeKind::Boolean);
  }
}

} // namespace stc::sema
