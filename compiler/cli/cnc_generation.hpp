#ifndef STRIDE_COMPILER_CLI_CNC_GENERATION_HPP
#define STRIDE_COMPILER_CLI_CNC_GENERATION_HPP
// Which SoftMotion says what words of a CNC program mean.

#include <string>

namespace stc::cli {

/// Whether words mean what SoftMotion 3 means: as the command says (`2.3`, `3`, or nothing), or the
/// project of the file.
[[nodiscard]] bool isSoftMotion3(const std::string &path, const std::string &said);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_CNC_GENERATION_HPP
