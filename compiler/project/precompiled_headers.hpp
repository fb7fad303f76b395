#ifndef STRIDE_COMPILER_PROJECT_PRECOMPILED_HEADERS_HPP
#define STRIDE_COMPILER_PROJECT_PRECOMPILED_HEADERS_HPP
// The runtime's headers, which every unit includes, compiled once for all of them.

#include "compiler/project/job_pool.hpp"
#include "compiler/project/toolchain.hpp"
#include "compiler/project/user_cache.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// In the folder of the sources: what each unit includes before all else (`-include`). Its compiled
/// form lies beside it, where g++ looks for it.
inline constexpr std::string_view kPrecompiledHeaders = "headers__.h";

/// Whether a project of so many units has its headers compiled first: it costs 80 ms once, and
/// saves 13 ms of each unit. The objects are not quite the same (the order of their debug
/// information), so that the project alone decides, not how much of it is outdated. Not with a
/// launcher: it sends sources to other machines, or looks at what they include.
[[nodiscard]] bool precompilesHeaders(const Toolchain &toolchain, size_t units);

/// Why there are no headers: `job` could not be done.
struct PrecompilingFailed {
  Job job;
  JobResult result; ///< status 0: nothing was compiled, a file could not be written (errno)
};

/// Puts the headers and their compiled form into the folder `sources`, from the cache if it has
/// them. `compile`: the compiler with all that stands before the name of a source; `identity` of
/// the tool chain; `work`: a folder for temporary files.
[[nodiscard]] std::optional<PrecompilingFailed>
precompileHeaders(const UserCache &cache, const ContentHash &identity,
                  std::vector<std::string> compile, const std::filesystem::path &sources,
                  const std::filesystem::path &work);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_PRECOMPILED_HEADERS_HPP
