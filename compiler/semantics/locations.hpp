#ifndef STRIDE_COMPILER_SEMANTICS_LOCATIONS_HPP
#define STRIDE_COMPILER_SEMANTICS_LOCATIONS_HPP
// Places in the process image.

#include "compiler/semantics/program.hpp"

#include <string>
#include <string_view>

namespace stc {

/// `input`, `output`, `memory`
[[nodiscard]] std::string_view areaName(Area area);
/// Bytes of what a size letter names: 1 for X and B, 2 for W, 4 for D, 8 for L.
[[nodiscard]] unsigned unitBytes(char size);
/// The size letter of so many bytes; B if none has that size.
[[nodiscard]] char sizeLetter(uint64_t bytes);
/// I, Q, M
[[nodiscard]] char areaLetter(Area area);
/// `%MW3`: the address of a variable of `bytes` bytes there.
[[nodiscard]] std::string addressText(const Location &at, uint64_t bytes, Addressing addressing);

/// The located variable that the expression names; null for all others.
[[nodiscard]] const VarSymbol *locatedVariable(const ast::Expr *expr);
/// The place of a located variable or a direct address; null for all others.
[[nodiscard]] const Location *locationOf(const ast::Expr *expr);
/// A bit or a part of a variable, which has no address: `w.3`, `w.%B1`, `%IX0.3`, `x AT %IX0.3`.
[[nodiscard]] bool isBitPlace(const ast::Expr *expr);
/// A variable declared as BIT: a bit place too, but one that C++ reads and writes itself.
[[nodiscard]] bool isBitField(const ast::Expr *expr);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_LOCATIONS_HPP
