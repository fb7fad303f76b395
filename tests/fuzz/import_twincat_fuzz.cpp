// Any bytes as a file of TwinCAT 3.
#include "compiler/import/twincat_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  using namespace stc::import;
  Model model;
  readTwinCat("x.TcPOU", {reinterpret_cast<const char *>(data), size}, model);
  for (const Object &each : model.objects)
    if (each.text.empty() || each.text.back() != '\n' || each.origin.line == 0)
      std::abort();
  for (const Remark &each : model.leftOut)
    if (each.text.empty())
      std::abort();
  return 0;
}
