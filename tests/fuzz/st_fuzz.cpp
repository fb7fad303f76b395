// Any bytes as an ST file: read, parsed, checked and the diagnostics drawn.
#include "compiler/semantics/program.hpp"
#include "compiler/source/render.hpp"
#include "compiler/syntax/parser.hpp"
#include "tests/support/no_library.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  stc::Program program;
  const stc::FileId id =
      program.sources.addBytes("fuzz.st", std::string(reinterpret_cast<const char *>(data), size));
  stc::ast::File *file =
      stc::parse(program.sources.file(id), program.interner, program.arena, program.diagnostics);
  if (!program.diagnostics.hasErrors())
    stc::check(program, {file}, stc::test::NoLibrary());
  program.diagnostics.sort();
  for (const stc::Diagnostic &diagnostic : program.diagnostics.all()) {
    (void)stc::renderText(diagnostic, program.sources);
    (void)stc::renderJson(diagnostic, program.sources);
  }
  return 0;
}
