// Cam files as a disk may hold them: whatever the bytes are, they are refused or give a curve that
// can be evaluated.
#include "runtime/numeric/cam/cam_file.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  namespace cam = stride::cam;
  std::vector<double> aligned(size / sizeof(double) + 2);
  auto *bytes = reinterpret_cast<uint8_t *>(aligned.data());
  std::memcpy(bytes, data, size);
  // The right checksum, so that the content is looked at.
  if (size >= cam::kCamFileChecksumSize) {
    const uint32_t checksum =
        cam::camFileChecksum(0, bytes, static_cast<int64_t>(size) - cam::kCamFileChecksumSize);
    std::memcpy(bytes + size - sizeof checksum, &checksum, sizeof checksum);
  }
  cam::CamFile file;
  if (cam::openCamFile(bytes, static_cast<int64_t>(size), file) != cam::CamFileError::None)
    return 0;
  if (file.header.elements > 0) {
    const cam::Curve curve = cam::curveOfFile(file.header, file.elements);
    uint32_t index = 0;
    for (int i = -1; i <= 5; ++i)
      static_cast<void>(cam::evaluateCurve(curve, curve.start + (curve.end - curve.start) * i / 4.0,
                                           i % 2 == 0, index));
  }
  // What is written again has the same meaning; only names may have been cleared after their end.
  std::vector<uint8_t> again(static_cast<size_t>(cam::camFileSize(file.header)));
  cam::writeCamFile(file.header, file.elements, file.tappets, again.data());
  if (again.size() != size)
    std::abort();
  return 0;
}
