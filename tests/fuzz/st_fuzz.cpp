// Any bytes as an ST file: read, parsed, checked and the diagnostics drawn.
#include "compiler/semantics/program.hpp"
#include "compiler/source/render.hpp"
#include "compiler/syntax/parser.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace {

// A compiler without libraries.
class NoLibraries final : public stc::LibraryIndex {
public:
  std::vector<Entry> find(std::string_view) const override { return {}; }
  bool isLibrary(std::string_view) const override { return false; }
  std::vector<std::string_view> names() const override { return {}; }
  std::vector<Entry> files(std::string_view) const override { return {}; }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  stc::Program program;
  const stc::FileId id =
      program.sources.addBytes("fuzz.st", std::string(reinterpret_cast<const char *>(data), size));
  stc::ast::File *file =
      stc::parse(program.sources.file(id), program.interner, program.arena, program.diagnostics);
  if (!program.diagnostics.hasErrors())
    stc::check(program, {file}, NoLibraries());
  program.diagnostics.sort();
  for (const stc::Diagnostic &diagnostic : program.diagnostics.all()) {
    (void)stc::renderText(diagnostic, program.sources);
    (void)stc::renderJson(diagnostic, program.sources);
  }
  return 0;
}
