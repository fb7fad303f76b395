// The guest's part of the test of power failures: says what it finds in a retain file, then saves
// one generation after the other and says each that is safe.
#include "runtime/app/error.hpp"
#include "runtime/app/retain_store.hpp"
#include "tests/unit/app/app_model.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace {

constexpr int64_t kWords = 5000;

int go(const std::string &file, bool readOnly) {
  using namespace stride;
  test::AppModel model;
  model.root("G", "x", model.array(model.elementary(Kind::UDINT), 1, kWords), kSymRetain);
  const app::RetainLayout layout(model.finish(), app::kRetained);
  const std::vector<std::byte> encoded = layout.encode();
  app::RetainStore store(file);
  std::vector<std::string> problems;
  const std::optional<app::RetainImage> image = store.load(problems);
  for (const std::string &problem : problems)
    std::printf("problem %s\n", problem.c_str());
  uint32_t generation = 0;
  if (image) {
    std::vector<uint32_t> values(kWords);
    std::memcpy(values.data(), image->values.data(), image->values.size());
    generation = values[0];
    if (std::any_of(values.begin(), values.end(), [&](uint32_t v) { return v != generation; }))
      std::printf("torn\n");
  }
  std::printf("\nfound %u end\n", generation); // after whatever the kernel has written
  std::fflush(stdout);
  if (readOnly)
    return 0;
  for (;;) {
    ++generation;
    const std::vector<uint32_t> values(kWords, generation);
    store.save("model", 1, encoded, std::as_bytes(std::span(values)));
    std::printf("safe %u end\n", generation);
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char **argv) {
  try {
    return go(argc > 1 ? argv[1] : "retain", argc > 2);
  } catch (const stride::app::Error &error) {
    std::printf("problem %s\n", error.what());
    return 1;
  }
}
