// What a user does with sources: `stride check`, `fmt`, `build --emit cpp`, within this process.
#ifndef STRIDE_TESTS_FUZZ_COMMANDS_HPP
#define STRIDE_TESTS_FUZZ_COMMANDS_HPP

#include <filesystem>
#include <string_view>

namespace stride::fuzz {

/// A line that begins so ends a file; the rest of the line is the name of the next one.
inline constexpr std::string_view kFileMark = "//// ";

/// Writes the text to `folder`, which is emptied before, and runs the commands on it: one source,
/// or a project of several files (kFileMark; `stride.toml` and cam files may be among them). Calls
/// std::abort() where something must never be: places outside of files, C++ of a program with
/// errors, a formatter that changes what it has formatted or what the text says.
void runCommands(std::string_view text, const std::filesystem::path &folder);

} // namespace stride::fuzz

#endif // STRIDE_TESTS_FUZZ_COMMANDS_HPP
