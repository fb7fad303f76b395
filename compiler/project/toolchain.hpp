#ifndef STRIDE_COMPILER_PROJECT_TOOLCHAIN_HPP
#define STRIDE_COMPILER_PROJECT_TOOLCHAIN_HPP
// The C++ compiler and everything besides the generated code that a result depends on.

#include "compiler/project/config.hpp"
#include "compiler/project/installation.hpp"
#include "compiler/project/user_cache.hpp"
#include "compiler/source/content_hash.hpp"
#include "compiler/source/diagnostic.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stc {

struct Toolchain {
  Installation installation;
  std::filesystem::path compiler; ///< absolute
  std::filesystem::path launcher; ///< what starts it, absolute; empty: nothing
  /// All but include folders, mapped paths, input and output.
  std::vector<std::string> compileFlags;
  std::vector<std::string> onceFlags;    ///< the same for units that run once in a cycle
  std::vector<std::string> numericFlags; ///< the same for units that compute with arrays of reals

  /// As TranslationUnit has it.
  [[nodiscard]] const std::vector<std::string> &flagsOf(bool runsOnce, bool isNumeric) const {
    return runsOnce ? onceFlags : isNumeric ? numericFlags : compileFlags;
  }
};

/// Path of a program as execvp finds it, absolute; or empty.
[[nodiscard]] std::filesystem::path findProgram(const std::string &name);

/// Sets the tool chain's launcher to the one that stride.toml names. False when it is not
/// installed, which has been reported.
[[nodiscard]] bool findLauncher(Launcher launcher, Toolchain &toolchain, Diagnostics &diagnostics);

/// Sets the flags that generated code is compiled with; `debug`: quick to compile and for the
/// debugger.
void setFlags(Toolchain &toolchain, const Installation &installation, bool debug);

/// The command that makes the application `linked` of the objects: a library, or a program that
/// needs none (`isStatic`); `isCross`: for another machine.
[[nodiscard]] std::vector<std::string>
linkCommand(const Toolchain &toolchain, bool isStatic, bool isCross,
            const std::filesystem::path &linked, const std::vector<std::filesystem::path> &objects);

/// What identifies the tool chain: the compiler with its parts (its stages, assembler, linker), the
/// flags, the environment that changes what it does, Stride's headers and all headers of the system
/// that these include, each file with size, times and inode. What the compiler says about itself is
/// kept in the cache; `work` is a folder to ask it in.
[[nodiscard]] ContentHash identityOf(const Toolchain &toolchain, const UserCache &cache,
                                     const std::filesystem::path &work);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_TOOLCHAIN_HPP
