// Any bytes as PLCopen XML.
#include "compiler/import/plcopen_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string_view text(reinterpret_cast<const char *>(data), size);
  stc::import::Model model;
  stc::import::readPlcOpen("fuzz.xml", text, model);
  for (const stc::import::Object &object : model.objects)
    if (object.name.empty() || object.origin.line == 0)
      std::abort();
  // A file that cannot be read adds nothing.
  if (!model.unreadable.empty() && !model.objects.empty())
    std::abort();
  return 0;
}
