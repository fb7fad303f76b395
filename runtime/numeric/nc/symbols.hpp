// Names of local variables while programs are read: those of all programs that call each other,
// one after the other in one memory. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_SYMBOLS_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_SYMBOLS_HPP

#include "runtime/numeric/cnc/gcode_reader.hpp"
#include "runtime/numeric/nc/code.hpp"
#include "runtime/numeric/nc/token.hpp"

namespace stride::nc {

/// Parameters and local variables of a program at most: MAX_SUBPROGRAM_PARAMS.
inline constexpr int32_t kMostLocals = 21;
/// Memory for their names.
inline constexpr int32_t kSymbolBytes = 4096;

/// Names: each is its length, its type, its characters.
struct Symbols {
  int32_t used;
  uint8_t bytes[kSymbolBytes];
};

/// Those of one program.
struct Scope {
  int32_t start; ///< In Symbols::bytes.
  int32_t count;
};

/// Which local variable of the program has this name; -1: none.
int32_t findLocal(const Symbols &symbols, const Scope &scope, const ProgramLine &line,
                  const Token &name, ValueType &type) noexcept;

/// Adds one. False: there is no room.
bool addLocal(Symbols &symbols, Scope &scope, const ProgramLine &line, const Token &name,
              ValueType type) noexcept;

/// Which variable of the list has the name between the signs; -1: none that a program can use.
int32_t findVariable(const cnc::VariableList *list, const ProgramLine &line, const Token &name,
                     uint8_t &type) noexcept;

/// SMC_VARTYPE besides those that SMC_NCDecoder knows.
inline constexpr uint8_t kBoolVariable = 23;
inline constexpr uint8_t kTextVariable = 24;
/// Characters that a variable of kTextVariable holds at least.
inline constexpr int32_t kTextVariableLength = 80;

/// What the value of a variable with this SMC_VARTYPE is.
ValueType typeOfVariable(uint8_t type) noexcept;

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_SYMBOLS_HPP
