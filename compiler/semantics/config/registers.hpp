#ifndef STRIDE_COMPILER_SEMANTICS_CONFIG_REGISTERS_HPP
#define STRIDE_COMPILER_SEMANTICS_CONFIG_REGISTERS_HPP
// Registers of modules (TSX CSY 85): addresses by rack, slot and channel, and variables that stand
// for a channel, `x AT %CH1.4.3 : T_CSY_IND`.

#include "compiler/semantics/config/internal.hpp"

namespace stc::sema {

/// Whether the numbers of the address are those of a register or a channel, not of bytes.
bool isRegister(const Context &c, const ast::DirectAddress &address);

/// A register of a module.
struct RegisterPlace {
  Location at;
  const Type *type = nullptr; ///< BOOL, INT, DINT or REAL
};
/// What the address names; reports what names none.
std::optional<RegisterPlace> locateRegister(Context &c, const ast::DirectAddress &address);

/// Places a variable at a register, `x AT %MF1.4.3.31 : REAL`.
void placeAtRegister(Context &c, VarSymbol *variable);
/// Checks a variable `AT %CH…`; reports a type that is not one of the channel.
void placeAtChannel(Context &c, VarSymbol *variable);
/// Places the fields of variables `AT %CH…` among `slots`.
void placeChannelFields(Context &c, std::vector<SlotPlace> &slots);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_CONFIG_REGISTERS_HPP
