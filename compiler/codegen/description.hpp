#ifndef STRIDE_COMPILER_CODEGEN_DESCRIPTION_HPP
#define STRIDE_COMPILER_CODEGEN_DESCRIPTION_HPP
// What the runtime is told of the application: StrideAppV1.

#include "compiler/codegen/codegen.hpp"
#include "compiler/codegen/plc_tables.hpp"
#include "compiler/codegen/type_table.hpp"

#include <string>

namespace stc::codegen {

/// What the description names.
struct Described {
  const Program &program;
  const AppConfig &config;
  const TypeTable &types;
  const PlcTables &plc;
  bool hasExit;                  ///< there is an exit__
  bool hasReinit;                ///< there is a reinit__
  bool hasCopies;                ///< there is a settle__
  std::string bootupErrorLength; ///< of g_strBootupError
  std::string bootupErrorOffset;
};

/// The definition of the constant, but for what build.cpp completes.
[[nodiscard]] std::string description(const Described &app);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_DESCRIPTION_HPP
