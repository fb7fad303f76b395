// Any bytes as stride.toml: read, checked against the schema, and turned into declarations.
#include "compiler/project/config.hpp"
#include "compiler/source/render.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  stc::Sources sources;
  stc::Diagnostics diagnostics;
  const stc::FileId id =
      sources.addBytes("stride.toml", std::string(reinterpret_cast<const char *>(data), size));
  stc::ProjectConfig config = stc::readConfig(sources.file(id), diagnostics);
  stc::resolveTasks(config, {}, stc::ProgramCheck::Existing, diagnostics);
  (void)stc::plcDeclarations(config, {}, diagnostics);
  for (const stc::Diagnostic &diagnostic : diagnostics.all())
    (void)stc::renderText(diagnostic, sources);
  return 0;
}
