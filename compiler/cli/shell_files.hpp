#ifndef STRIDE_COMPILER_CLI_SHELL_FILES_HPP
#define STRIDE_COMPILER_CLI_SHELL_FILES_HPP
// Files for a system on which Stride is installed, made of the table of commands and options.

#include <CLI/CLI.hpp>

#include <string>

namespace stc::cli {

/// Completion of the command's words, for bash and for zsh.
[[nodiscard]] std::string bashCompletion(const CLI::App &app);
[[nodiscard]] std::string zshCompletion(const CLI::App &app);
/// The manual page, stride(1).
[[nodiscard]] std::string manPage(const CLI::App &app, const std::string &version);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_SHELL_FILES_HPP
