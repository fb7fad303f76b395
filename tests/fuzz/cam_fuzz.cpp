// Any bytes as a cam file: read, compiled, turned into declarations, written again.
#include "compiler/assets/cam/cam_source.hpp"
#include "compiler/source/render.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  stc::Sources sources;
  stc::Diagnostics diagnostics;
  const stc::FileId id =
      sources.addBytes("Cam1.cam.toml", std::string(reinterpret_cast<const char *>(data), size));
  if (const std::optional<stc::CamSource> cam = stc::readCam(sources.file(id), diagnostics)) {
    (void)stc::camDeclarations({*cam}, {}, diagnostics);
    if (const std::optional<stc::CamData> compiled = stc::compileCam(*cam, diagnostics);
        compiled && compiled->header.elements != 0) {
      uint32_t index = 0;
      for (const double x : {cam->start, (cam->start + cam->end) / 2, cam->end})
        if (!std::isfinite(
                stride::cam::evaluateCurve(compiled->curve(), x, cam->periodic, index).y))
          std::abort();
    }
    (void)stc::camFileText(*cam, "again");
  }
  for (const stc::Diagnostic &diagnostic : diagnostics.all())
    (void)stc::renderText(diagnostic, sources);
  return 0;
}
