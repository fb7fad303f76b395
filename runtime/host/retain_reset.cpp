#include "runtime/host/retain_reset.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stride::host {

namespace fs = std::filesystem;

static std::string keptText(std::size_t count, const char *kind) {
  return count == 1 ? fmt::format("1 {} variable keeps its value", kind)
                    : fmt::format("{} {} variables keep their values", count, kind);
}

bool resetRetained(ResetKind kind, const std::string &file, app::RetainFiles &files) {
  if (!fs::exists(file + ".a") && !fs::exists(file + ".b")) {
    fmt::print(stderr, "error: there are no retained data in '{}'\n", file);
    return false;
  }
  const app::RetainLock lock(file);
  if (kind == ResetKind::Origin) {
    app::RetainStore(file, files).clear();
    fmt::print("All variables start with their initial values.\n");
    return true;
  }
  app::RetainStore store(file, files);
  std::vector<std::string> problems;
  const std::optional<app::RetainImage> image = store.load(problems);
  for (const std::string &problem : problems)
    fmt::print(stderr, "warning: retained data: {}\n", problem);
  if (!image) {
    fmt::print(stderr, "error: there are no retained data in '{}'\n", file);
    return false;
  }
  if (kind == ResetKind::Warm) {
    fmt::print("{}; all others start with their initial values, as at every start.\n",
               keptText(image->layout.variables().size(), "RETAIN and PERSISTENT"));
    return true;
  }
  const app::RetainImage kept = app::withoutRetains(*image, kSymPersistent);
  const std::vector<std::byte> layout = kept.layout.encode();
  // Into both files, so that none is left with the old values to fall back on.
  for (int i = 0; i < 2; ++i)
    store.save(image->head.application, image->head.buildHash, layout, kept.values);
  fmt::print("{}; RETAIN and all others start with their initial values.\n",
             keptText(kept.layout.variables().size(), "PERSISTENT"));
  return true;
}

} // namespace stride::host
