#include "compiler/project/precompiled_headers.hpp"

#include "compiler/project/file_system.hpp"

#include <utility>

namespace stc {

namespace fs = std::filesystem;

namespace {

/// So many units gain what the headers cost.
constexpr size_t kFewestUnits = 8;

constexpr std::string_view kKind = ".gch";

} // namespace

bool precompilesHeaders(const Toolchain &toolchain, size_t units) {
  return toolchain.launcher.empty() && units >= kFewestUnits;
}

std::optional<PrecompilingFailed> precompileHeaders(const UserCache &cache,
                                                    const ContentHash &identity,
                                                    std::vector<std::string> compile,
                                                    const fs::path &sources, const fs::path &work) {
  const fs::path header = sources / kPrecompiledHeaders;
  const fs::path compiled = header.string() + std::string(kKind);
  if (!writeFile(header, "#include \"runtime/iec/ops.h\"\n"))
    return PrecompilingFailed{};
  ContentHash hash = identity;
  const std::string key = hash.add(kPrecompiledHeaders).hex();
  if (cache.fetch(key, kKind, compiled))
    return std::nullopt;
  // Without a lock: two builds at a time do it twice.
  compile.insert(compile.end(), {"-x", "c++-header", header.string(), "-o", compiled.string()});
  Job job{std::move(compile), {}, sources.string(), work.string()};
  JobResult result = runJobs({job}).front();
  if (result.status != 0)
    return PrecompilingFailed{std::move(job), std::move(result)};
  if (cache.publish(key, kKind, compiled)) // without it the next build takes longer, no more
    cache.prune(key, kKind);
  return std::nullopt;
}

} // namespace stc
