#ifndef STRIDE_COMPILER_CLI_VERSION_HPP
#define STRIDE_COMPILER_CLI_VERSION_HPP

namespace stc::cli {

/// `stride 0.1.0 (1a2b3c4d5e6f, 2026-11-23)`: with the commit that it was built from, if it was
/// built from a repository. Defined in a generated file.
[[nodiscard]] const char *versionText();

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_VERSION_HPP
