// Golden tests drive the built `stride` as a user does and compare what it prints and writes with
// what stands in the repository.
#ifndef STRIDE_TESTS_GOLDEN_GOLDEN_HPP
#define STRIDE_TESTS_GOLDEN_GOLDEN_HPP

#include "tests/support/process.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stride::golden {

/// The command a single file is given to.
enum class FileKind {
  Program,     ///< `stride sim FILE --for T#10ms --print PLC_PRG`, unless a RUN line says otherwise
  Diagnostics, ///< `stride check FILE --color never`
  Format       ///< `stride fmt FILE --color never`; compared is also what then stands in the file
};

/// Runs one .st file whose expected output stands in its trailing `//!` block. The result is what
/// is wrong, ready to be printed; empty when nothing is. With `bless` the block is rewritten
/// instead. A program's `MODES` line has it run in further modes, which must print the same.
std::string runFile(FileKind kind, const std::filesystem::path &file, bool bless);

/// Runs the commands of a folder's golden.toml in a copy of the project. Result and `bless` as
/// above.
std::string runProject(const std::filesystem::path &folder, bool bless);

/// Exports a program as PLCopen XML, imports the file, runs the project: it must print what the
/// program prints. The result as above.
std::string runRoundTrip(const std::filesystem::path &file);

/// Compares the compiler's list of diagnostic codes with the golden expectations under `root` and
/// with the texts of `stride explain`. The result names what is missing; empty when nothing is.
std::string checkCoverage(const std::filesystem::path &root);

/// Runs the built `stride`.
stride::test::ProcessResult runStride(const std::vector<std::string> &arguments,
                                      const std::filesystem::path &directory);

/// Standard output followed by standard error, with the name of `directory` taken out.
std::string outputOf(const stride::test::ProcessResult &result,
                     const std::filesystem::path &directory);

/// Whether a case of this name must fail: its name starts with `fail_`.
bool mustFail(const std::filesystem::path &name);

/// A message when the exit code is not the expected one (`failure`: any code but 0, and no crash).
std::string checkExit(int exitCode, bool failure);

} // namespace stride::golden

#endif // STRIDE_TESTS_GOLDEN_GOLDEN_HPP
