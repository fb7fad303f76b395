// What compiler and runtime know of a kind of I/O device before there is one. Data only.
#ifndef STRIDE_RUNTIME_IO_IO_SCHEMA_HPP
#define STRIDE_RUNTIME_IO_IO_SCHEMA_HPP

#include "runtime/common/parameter.hpp"

#include <span>
#include <string_view>

namespace stride::io {

struct IoSchema {
  std::string_view name; ///< `device` in stride.toml.
  /// What it gives does not follow from what the program does: it belongs into a recording, and a
  /// replay needs no device.
  bool external = true;
  std::span<const common::Parameter> parameters = {};  ///< Besides those of every device.
  std::span<const common::ParameterTable> tables = {}; ///< Below it, by names of their own.
  /// Not empty: such a device is a node of an axis group with this driver, which its parameter
  /// `axis_group` names; that driver exchanges its bytes (common::IoExchange).
  std::string_view bus = {};
};

} // namespace stride::io

#endif
