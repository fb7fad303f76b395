// Any bytes as a source of Siemens SCL.
#include "compiler/import/scl_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  using namespace stc::import;
  Model model;
  readScl("x.scl", {reinterpret_cast<const char *>(data), size}, model);
  for (const Object &each : model.objects)
    if (each.text.empty() || each.text.back() != '\n' || each.origin.line == 0)
      std::abort();
  for (const Remark &each : model.leftOut)
    if (each.text.empty())
      std::abort();
  return 0;
}
