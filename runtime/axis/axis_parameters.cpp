#include "runtime/axis/axis_parameters.hpp"

#include "runtime/numeric/exact_math.hpp"

#include "st/SM_DriveBasic/AXIS_REF_parameters.h"

namespace stride::axis {
namespace {

template <class T> const T &member(const AxisRef &axis, const AxisParameter &parameter) noexcept {
  return *reinterpret_cast<const T *>(reinterpret_cast<const unsigned char *>(&axis) +
                                      parameter.offset);
}

template <class T>
bool writeWhole(AxisRef &axis, const AxisParameter &parameter, double value, double least,
                double most) noexcept {
  const double rounded = value < 0.0 ? exact::ceil(value - 0.5) : exact::floor(value + 0.5);
  if (!(rounded >= least && rounded <= most))
    return false;
  const_cast<T &>(member<T>(axis, parameter)) = static_cast<T>(rounded);
  return true;
}

} // namespace

const AxisParameter *findParameter(int32_t number) noexcept {
  if (number <= 0)
    return nullptr;
  for (const AxisParameter &parameter : kAxisParameters)
    if (parameter.number == number || parameter.plcopen == number)
      return &parameter;
  return nullptr;
}

double readParameter(const AxisRef &axis, const AxisParameter &parameter) noexcept {
  switch (parameter.kind) {
  case ParameterKind::Bool:
    return member<::stride::BOOL>(axis, parameter) != 0 ? 1.0 : 0.0;
  case ParameterKind::Byte:
    return member<::stride::BYTE>(axis, parameter);
  case ParameterKind::Word:
    return member<::stride::WORD>(axis, parameter);
  case ParameterKind::DWord:
    return member<::stride::DWORD>(axis, parameter);
  case ParameterKind::Int:
    return member<::stride::INT>(axis, parameter);
  case ParameterKind::LReal:
    break;
  }
  return member<::stride::LREAL>(axis, parameter);
}

bool writeParameter(AxisRef &axis, const AxisParameter &parameter, double value) noexcept {
  if (!parameter.writable || !exact::isfinite(value))
    return false;
  switch (parameter.kind) {
  case ParameterKind::Bool:
    return writeWhole<::stride::BOOL>(axis, parameter, value, 0.0, 1.0);
  case ParameterKind::Byte:
    return writeWhole<::stride::BYTE>(axis, parameter, value, 0.0, 255.0);
  case ParameterKind::Word:
    return writeWhole<::stride::WORD>(axis, parameter, value, 0.0, 65535.0);
  case ParameterKind::DWord:
    return writeWhole<::stride::DWORD>(axis, parameter, value, 0.0, 4294967295.0);
  case ParameterKind::Int:
    return writeWhole<::stride::INT>(axis, parameter, value, -32768.0, 32767.0);
  case ParameterKind::LReal:
    break;
  }
  const_cast<double &>(member<::stride::LREAL>(axis, parameter)) = value;
  return true;
}

} // namespace stride::axis
