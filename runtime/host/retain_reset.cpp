#include "runtime/host/retain_reset.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace stride::host {

namespace fs = std::filesystem;

static std::string keptText(size_t count, const char *kind) {
  return count == 1 ? fmt::format("1 {} variable keeps its value", kind)
                    : fmt::format("{} {} variables keep their values", count, kind);
}

/// What cannot be printed shows in the exit code.
static void tell(const std::string &line) { std::fputs(line.c_str(), stdout); }

bool resetRetained(ResetKind kind, const std::string &file, Messages &messages,
                   app::RetainFiles &files) {
  if (!fs::exists(file + ".a") && !fs::exists(file + ".b")) {
    messages.say({"error: there are no retained data in '", file, "'"});
    return false;
  }
  const app::RetainLock lock(file);
  if (kind == ResetKind::Origin) {
    app::RetainStore(file, files).clear();
    tell("All variables start with their initial values.\n");
    return true;
  }
  app::RetainStore store(file, files);
  std::vector<std::string> problems;
  const std::optional<app::RetainImage> image = store.load(problems);
  for (const std::string &problem : problems)
    messages.say({"warning: retained data: ", problem});
  if (!image) {
    messages.say({"error: there are no retained data in '", file, "'"});
    return false;
  }
  if (kind == ResetKind::Warm) {
    tell(fmt::format("{}; all others start with their initial values, as at every start.\n",
                     keptText(image->layout.variables().size(), "RETAIN and PERSISTENT")));
    return true;
  }
  const app::RetainImage kept = app::withoutRetains(*image, kSymPersistent);
  const std::vector<std::byte> layout = kept.layout.encode();
  // Into both files, so that none is left with the old values to fall back on.
  for (int i = 0; i < 2; ++i)
    store.save(image->head.application, image->head.buildHash, layout, kept.values);
  tell(fmt::format("{}; RETAIN and all others start with their initial values.\n",
                   keptText(kept.layout.variables().size(), "PERSISTENT")));
  return true;
}

} // namespace stride::host
