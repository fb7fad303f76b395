// Any bytes as an ST file: read, parsed and the diagnostics drawn. Places must lie in the file, and
// one file must not give an endless list of errors.
#include "compiler/source/render.hpp"
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

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  stc::Sources sources;
  stc::Interner interner;
  stc::Arena arena;
  stc::Diagnostics diagnostics;
  const stc::FileId id =
      sources.addBytes("fuzz.st", std::string(reinterpret_cast<const char *>(data), size));
  const stc::ast::File *file = stc::parse(sources.file(id), interner, arena, diagnostics);
  demand(file != nullptr && file->id == id);
  // The limit per file holds for each of: syntax, characters; pragmas, literals and names may add
  // one per occurrence.
  demand(diagnostics.errorCount() <= 300 + size / 4);
  diagnostics.sort();
  for (const stc::Diagnostic &diagnostic : diagnostics.all()) {
    for (const stc::Label &label : diagnostic.labels)
      demand(label.span.begin <= label.span.end &&
             label.span.end <= sources.file(id).text().size());
    (void)stc::renderText(diagnostic, sources);
    (void)stc::renderJson(diagnostic, sources);
  }
  return 0;
}
