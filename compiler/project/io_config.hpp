#ifndef STRIDE_COMPILER_PROJECT_IO_CONFIG_HPP
#define STRIDE_COMPILER_PROJECT_IO_CONFIG_HPP
// [[io]] of stride.toml: devices of the process image.

#include "compiler/project/config.hpp"
#include "compiler/toml/schema.hpp"

namespace stc {

/// Reads one device with its channels and adds it to the configuration. What is wrong is reported.
void readIoDevice(const CheckedSection &section, ProjectConfig &config, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_IO_CONFIG_HPP
