#include "runtime/host/retain_reset.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/retain_store.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>

namespace stride::host {

namespace {

namespace fs = std::filesystem;

void removeFile(const fs::path &path) {
  std::error_code error;
  fs::remove(path, error);
  if (error)
    throw app::Error(fmt::format("cannot remove '{}': {}", path.string(), error.message()));
}

/// The older one first: up to the last moment the newest is what a start would find.
void removeAll(const std::string &file) {
  std::array<fs::path, 2> files = {file + ".a", file + ".b"};
  std::error_code error;
  const auto first = fs::last_write_time(files[0], error);
  const auto second = fs::last_write_time(files[1], error);
  if (!error && second < first)
    std::swap(files[0], files[1]);
  removeFile(file + ".new");
  for (const fs::path &path : files)
    removeFile(path);
  const std::string folder = fs::path(file).parent_path().string();
  static_cast<void>(app::systemFiles().syncFolder(folder.empty() ? "." : folder));
}

} // namespace

void resetRetained(ResetKind kind, const std::string &file) {
  if (!fs::exists(file + ".a") && !fs::exists(file + ".b")) {
    fmt::print("There are no retained data in '{}'.\n", file);
    return;
  }
  const app::RetainLock lock(file);
  if (kind == ResetKind::Origin) {
    removeAll(file);
    fmt::print("All variables start with their initial values.\n");
    return;
  }
  app::RetainStore store(file);
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
