#include "runtime/host/retain_reset.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stride::host {

namespace fs = std::filesystem;

void resetRetained(ResetKind kind, const std::string &file, app::RetainFiles &files) {
  if (!fs::exists(file + ".a") && !fs::exists(file + ".b")) {
    fmt::print("There are no retained data in '{}'.\n", file);
    return;
  }
  const app::RetainLock lock(file);
  if (kind == ResetKind::Origin) {
    app::RetainStore(file, files).clear();
    fmt::print("All variables start with their initial values.\n");
    return;
  }
  app::RetainStore store(file, files);
  std::vector<std::string> problems;
  const std::optional<app::RetainImage> image = store.load(problems);
  for (const std::string &problem : problems)
    fmt::print(stderr, "warning: retained data: {}\n", problem);
  if (!image) {
    fmt::print("There are no retained data in '{}'.\n", file);
    return;
  }
  if (kind == ResetKind::Warm) {
    fmt::print("{} RETAIN and PERSISTENT variables keep their values; all others start with their "
               "initial values, as at every start.\n",
               image->layout.variables().size());
    return;
  }
  const app::RetainImage kept = app::withoutRetains(*image, kSymPersistent);
  const std::vector<std::byte> layout = kept.layout.encode();
  // Into both files, so that none is left with the old values to fall back on.
  for (int i = 0; i < 2; ++i)
    store.save(image->head.application, image->head.buildHash, layout, kept.values);
  fmt::print("{} PERSISTENT variables keep their values; RETAIN and all others start with their "
             "initial values.\n",
             kept.layout.variables().size());
}

} // namespace stride::host
