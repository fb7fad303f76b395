// What is known of a parameter of AXIS_REF. The table of all of them is generated from the
// attributes in stdlib/SM_DriveBasic/AXIS_REF.st.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_AXIS_PARAMETER_HPP
#define STRIDE_RUNTIME_AXIS_AXIS_PARAMETER_HPP

#include <stdint.h>

namespace stride::axis {

/// The type of a parameter.
enum class ParameterKind : uint8_t { Bool, Byte, Word, DWord, Int, LReal };

/// A member of AXIS_REF with a number.
struct AxisParameter {
  int32_t number;     ///< 1000 and more.
  int32_t plcopen;    ///< The number that PLCopen gives to the same parameter; 0: none.
  ParameterKind kind; ///< Its type.
  bool writable;      ///< Programs may write it.
  uint32_t offset;    ///< Within AXIS_REF.
};

} // namespace stride::axis

#endif
