// Queue files as a disk may hold them: whatever the bytes are, they are refused, or give a queue
// whose objects can be measured and checked.
#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/cnc/queue_file.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"
#include "runtime/numeric/crc32.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  namespace cnc = stride::cnc;
  std::vector<uint8_t> bytes(data, data + size);
  // The right checksum, so that the content is looked at.
  if (size >= sizeof(uint32_t)) {
    const uint32_t checksum = stride::numeric::crc32(
        0, bytes.data(), static_cast<int64_t>(size) - cnc::kQueueFileChecksumSize);
    std::memcpy(bytes.data() + size - sizeof checksum, &checksum, sizeof checksum);
  }
  std::vector<cnc::PathObject> memory(8);
  cnc::Queue queue{};
  queue.structId = cnc::kQueueStructId;
  queue.buffer = reinterpret_cast<uint8_t *>(memory.data());
  queue.size = static_cast<uint32_t>(memory.size() * sizeof(cnc::PathObject));
  if (cnc::readQueueFile(bytes.data(), static_cast<int64_t>(size), queue) !=
      cnc::QueueFileError::None)
    return 0;
  // What is written again has the same length.
  std::vector<uint8_t> again(size + 1);
  if (cnc::writeQueueFilePart(&queue, 0, again.data(), static_cast<uint32_t>(again.size())) +
          sizeof(uint32_t) !=
      size)
    std::abort();
  for (uint32_t n = 0; n < cnc::countOf(&queue); ++n) {
    cnc::PathObject &object = *cnc::objectAt(&queue, n);
    cnc::PathObject copy = object;
    static_cast<void>(cnc::calculateStart(copy));
    static_cast<void>(cnc::calculateEnd(copy));
    cnc::ObjectShape shape{};
    if (cnc::shapeOf(object, shape) == cnc::ShapeError::None && !(shape.length >= 0.0))
      std::abort();
  }
  uint32_t checked = UINT32_MAX;
  static_cast<void>(cnc::checkVelocities(&queue, checked, {0.1, 1.0}));
  return 0;
}
