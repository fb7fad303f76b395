#ifndef STRIDE_COMPILER_PROJECT_CSY_SOURCES_HPP
#define STRIDE_COMPILER_PROJECT_CSY_SOURCES_HPP
// The modules of [[csy]] as Structured Text.

#include "compiler/project/config.hpp"

namespace stc {

/// Declares for each module what stands in its registers, and a hidden program that serves its
/// channels. It becomes the first one of the task of its axes: what programs write into registers
/// counts from the next cycle on. What is wrong is reported; then the result is not to be used.
[[nodiscard]] SyntheticSource csyDeclarations(ProjectConfig &config, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_CSY_SOURCES_HPP
