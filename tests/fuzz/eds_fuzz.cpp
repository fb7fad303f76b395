// Any bytes as an EDS and as an XDD.
#include "compiler/assets/eds/device.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  using namespace stc::eds;
  const std::string_view text(reinterpret_cast<const char *>(data), size);
  for (const Device &device : {readEds(text), readXdd(text)}) {
    for (size_t i = 0; i < device.objects.size(); ++i) {
      const Object &object = device.objects[i];
      if (device.find(object.index, object.sub) != &object)
        std::abort();
    }
    for (const Pdo &pdo : pdosOf(device))
      if (pdo.map.size() > pdo.places)
        std::abort();
  }
  return 0;
}
