// Any bytes as an ST file to be formatted: its tokens and comments stay (format() sees to that
// itself), and a text without syntax errors is formatted to one that is formatted to itself.
#include "compiler/syntax/format.hpp"
#include "compiler/syntax/parser.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

void demand(bool condition) {
  if (!condition)
    std::abort();
}

bool isWellFormed(const stc::SourceFile &file) {
  stc::Interner interner;
  stc::Arena arena;
  stc::Diagnostics diagnostics;
  stc::parse(file, interner, arena, diagnostics);
  return !diagnostics.hasErrors();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  stc::Sources sources;
  const stc::FileId id =
      sources.addBytes("fuzz.st", std::string(reinterpret_cast<const char *>(data), size));
  stc::FormatStyle style;
  if (size % 3 == 1)
    style.width = 40;
  const std::optional<std::string> once = stc::format(sources.file(id), style);
  if (!isWellFormed(sources.file(id)))
    return 0;
  demand(once.has_value());
  const stc::FileId result = sources.add("fuzz.st", *once);
  demand(isWellFormed(sources.file(result)));
  demand(stc::format(sources.file(result), style) == once);
  return 0;
}
