// Any bytes as a drawing: refused, or it becomes programs without errors, and these drawings.
#include "compiler/assets/dxf/dxf.hpp"
#include "compiler/source/render.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

/// Drawings that become a path of so many bytes are looked at no further.
constexpr size_t kMostText = 200'000;

void checkProgram(const std::string &text) {
  stc::Sources sources;
  stc::Diagnostics diagnostics;
  const auto program = stc::readCnc(sources.file(sources.add("a.cnc", text)), diagnostics);
  if (!program)
    std::abort();
  stc::checkCnc(*program, diagnostics);
  if (diagnostics.hasErrors() || !stc::exportDxf(*program, {}, diagnostics))
    std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  stc::Sources sources;
  stc::Diagnostics diagnostics;
  const stc::FileId id =
      sources.addBytes("a.dxf", std::string(reinterpret_cast<const char *>(data), size));
  stc::DxfImport how;
  // Splines may become a million pieces: few of them here, so that it stays quick.
  how.tolerance = 1;
  if (size != 0) {
    how.insideFirst = (data[size - 1] & 1) != 0;
    how.tool = (data[size - 1] & 2) != 0 ? stc::DxfTool::Left : stc::DxfTool::None;
    how.leadIn = (data[size - 1] & 4) != 0 ? 2 : 0;
  }
  const auto programs = stc::importDxf(sources.file(id), how, diagnostics);
  if (programs.has_value() == diagnostics.hasErrors())
    std::abort();
  if (programs)
    for (const stc::DxfProgram &program : *programs)
      if (program.text.size() < kMostText)
        checkProgram(program.text);
  for (const stc::Diagnostic &diagnostic : diagnostics.all())
    (void)stc::renderText(diagnostic, sources);
  return 0;
}
