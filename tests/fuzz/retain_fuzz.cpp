// Retained data as a file may hold them: whatever the bytes are, they are refused or taken over
// without harm.
#include "runtime/app/error.hpp"
#include "runtime/app/retain_image.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  using namespace stride;
  try {
    const app::RetainImage image =
        app::decodeImage(std::as_bytes(std::span(data, size)), /*checked=*/false);
    if (image.layout.description().stateSize > 1U << 20)
      return 0;
    const app::RetainImage cold = app::withoutRetains(image, kSymPersistent);
    const app::RetainRestore restore(cold.layout.description(), cold.layout, image);
    std::vector<std::byte> state(cold.layout.description().stateSize + 8);
    static_cast<void>(restore.apply(state.data()));
  } catch (const app::Error &) {
    return 0;
  }
  return 0;
}
