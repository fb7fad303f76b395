#include "compiler/semantics/locations.hpp"

namespace stc {

using namespace ast;

unsigned unitBytes(char size) {
  switch (size) {
  case 'W':
    return 2;
  case 'D':
    return 4;
  case 'L':
    return 8;
  default:
    return 1;
  }
}

char sizeLetter(uint64_t bytes) {
  switch (bytes) {
  case 2:
    return 'W';
  case 4:
    return 'D';
  case 8:
    return 'L';
  default:
    return 'B';
  }
}

std::string_view areaName(Area area) {
  return area == Area::Input ? "input" : area == Area::Output ? "output" : "memory";
}

char areaLetter(Area area) { return area == Area::Input ? 'I' : area == Area::Output ? 'Q' : 'M'; }

std::string addressText(const Location &at, uint64_t bytes, Addressing addressing) {
  std::string text = std::string("%") + areaLetter(at.area);
  const auto number = [](uint64_t n) { return std::to_string(n); };
  if (at.bit >= 0) {
    text += 'X';
    return addressing == Addressing::Words
               ? text + number(at.byte / 2) + "." +
                     number(at.byte % 2 * 8 + static_cast<unsigned>(at.bit))
               : text + number(at.byte) + "." + std::to_string(at.bit);
  }
  char size = sizeLetter(bytes);
  if (addressing != Addressing::Bytes && at.byte % unitBytes(size) != 0)
    size = 'B';
  text += size;
  return text + number(addressing == Addressing::Bytes ? at.byte : at.byte / unitBytes(size));
}

const VarSymbol *locatedVariable(const Expr *expr) {
  const Symbol *symbol = nullptr;
  if (expr->kind == ExprKind::Name)
    symbol = as<NameExpr>(expr)->symbol;
  else if (expr->kind == ExprKind::Member && as<MemberExpr>(expr)->bit < 0)
    symbol = as<MemberExpr>(expr)->symbol;
  if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
    return nullptr;
  const auto *variable = static_cast<const VarSymbol *>(symbol);
  return variable->location != nullptr ? variable : nullptr;
}

const Location *locationOf(const Expr *expr) {
  if (expr->kind == ExprKind::Direct)
    return as<DirectExpr>(expr)->location;
  const VarSymbol *variable = locatedVariable(expr);
  return variable == nullptr ? nullptr : variable->location;
}

bool isBitField(const Expr *expr) {
  const Symbol *symbol = expr->kind == ExprKind::Name     ? as<NameExpr>(expr)->symbol
                         : expr->kind == ExprKind::Member ? as<MemberExpr>(expr)->symbol
                                                          : nullptr;
  return symbol != nullptr && symbol->kind == SymbolKind::Variable &&
         static_cast<const VarSymbol *>(symbol)->isBit;
}

bool isBitPlace(const Expr *expr) {
  if ((expr->kind == ExprKind::Member && as<MemberExpr>(expr)->bit >= 0) || isBitField(expr))
    return true;
  const Location *at = locationOf(expr);
  return at != nullptr && at->bit >= 0;
}

} // namespace stc
