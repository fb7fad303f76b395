#ifndef STRIDE_COMPILER_PROJECT_TOOLS_AXIS_PARAMETERS_HPP
#define STRIDE_COMPILER_PROJECT_TOOLS_AXIS_PARAMETERS_HPP
// The table behind MC_ReadParameter and MC_WriteParameter, from the attributes of AXIS_REF.

#include "compiler/semantics/program.hpp"

#include <string>

namespace stc {

/// Whether a library declares AXIS_REF.
[[nodiscard]] const TypeSymbol *findAxisRef(const Library &library);

/// The header with the table: each member with {attribute 'parameter' := '…'} with its number, the
/// one that PLCopen gives it ('plcopen'), its type, whether programs may write it
/// ('parameter_access'), and where it is. Empty, with a text in `error`, if an attribute is wrong.
[[nodiscard]] std::string axisParameterTable(const TypeSymbol &axisRef, std::string &error);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_TOOLS_AXIS_PARAMETERS_HPP
