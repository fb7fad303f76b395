#include "runtime/numeric/cnc/queue_file.hpp"

#include "runtime/numeric/crc32.hpp"

#include <stddef.h>

namespace stride::cnc {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
// What changes the bytes of an object needs another version.
static_assert(sizeof(PathObject) == 872);

constexpr int64_t kObject = sizeof(PathObject);

// Looks like no text, and shows when something has changed line ends.
constexpr uint8_t kQueueMagic[8] = {0x89, 'C', 'N', 'Q', '\r', '\n', 0x1A, '\n'};

/// Where the members stand in the header; what is between them is 0.
constexpr int32_t kFileVersionAt = 8;
constexpr int32_t kGeneratorAt = 10;
constexpr int32_t kObjectSizeAt = 12;
constexpr int32_t kCountAt = 16;
constexpr int32_t kProgramNameAt = 24;
static_assert(kProgramNameAt + 81 <= kQueueFileHeaderSize);

template <class Value> void putAt(uint8_t *bytes, int32_t offset, Value value) noexcept {
  __builtin_memcpy(bytes + offset, &value, sizeof value);
}

template <class Value> Value valueAt(const uint8_t *bytes, int32_t offset) noexcept {
  Value value;
  __builtin_memcpy(&value, bytes + offset, sizeof value);
  return value;
}

template <class Value, size_t kCount>
void copyAll(Value (&to)[kCount], const Value (&from)[kCount]) noexcept {
  for (size_t i = 0; i < kCount; ++i)
    to[i] = from[i];
}

/// Member by member, so that what is between them stays.
void copyPosition(Position &to, const Position &from) noexcept {
  to.frame = from.frame;
  to.axes = from.axes;
  to.sProfile = from.sProfile;
  copyAll(to.coordinate, from.coordinate);
}

bool isGenerator(uint8_t generator) noexcept {
  constexpr Generator kAll[] = {kByDecoder,         kByAvoidLoop,  kByLimitCircularVelocities,
                                kByRoundPath,       kBySmoothPath, kByToolCorr,
                                kByRotateQueue,     kByScaleQueue, kByTranslateQueue,
                                kByCheckVelocities, kByEditor};
  bool known = false;
  for (const Generator one : kAll)
    known = known || one == generator;
  return known;
}

QueueFileHeader headerOf(const Queue &queue) noexcept {
  QueueFileHeader header{};
  header.count = countOf(&queue);
  header.generator = queue.generator;
  for (int32_t i = 0; i < 80 && queue.programName[i] != 0; ++i)
    header.name[i] = queue.programName[i];
  return header;
}

} // namespace

int64_t queueFileSize(uint32_t count) noexcept {
  return kQueueFileHeaderSize + count * kObject + kQueueFileChecksumSize;
}

void writeQueueFileHeader(const QueueFileHeader &header, uint8_t *bytes) noexcept {
  __builtin_memset(bytes, 0, kQueueFileHeaderSize);
  __builtin_memcpy(bytes, kQueueMagic, sizeof kQueueMagic);
  putAt(bytes, kFileVersionAt, kQueueFileVersion);
  putAt(bytes, kGeneratorAt, header.generator);
  putAt(bytes, kObjectSizeAt, static_cast<uint32_t>(kObject));
  putAt(bytes, kCountAt, header.count);
  for (int32_t i = 0; i < 80 && header.name[i] != 0; ++i)
    bytes[kProgramNameAt + i] = static_cast<uint8_t>(header.name[i]);
}

QueueFileError readQueueFileHeader(const uint8_t *bytes, QueueFileHeader &header) noexcept {
  if (__builtin_memcmp(bytes, kQueueMagic, sizeof kQueueMagic) != 0 ||
      valueAt<uint16_t>(bytes, kFileVersionAt) != kQueueFileVersion ||
      valueAt<uint32_t>(bytes, kObjectSizeAt) != kObject)
    return QueueFileError::Version;
  header = {};
  header.count = valueAt<uint32_t>(bytes, kCountAt);
  const uint8_t generator = bytes[kGeneratorAt];
  header.generator = isGenerator(generator) ? generator : uint8_t{kByNobody};
  for (int32_t i = 0; i < 80 && bytes[kProgramNameAt + i] != 0; ++i)
    header.name[i] = static_cast<char>(bytes[kProgramNameAt + i]);
  return QueueFileError::None;
}

void writeFileObject(const PathObject &object, uint8_t *bytes) noexcept {
  alignas(PathObject) uint8_t memory[sizeof(PathObject)];
  __builtin_memset(memory, 0, sizeof memory);
  auto &to = *reinterpret_cast<PathObject *>(memory); // NOLINT: the same bytes
  to.number = object.number;
  to.sourceLine = object.sourceLine;
  to.moveType = object.moveType;
  copyPosition(to.start, object.start);
  copyPosition(to.end, object.end);
  copyAll(to.shape, object.shape);
  copyAll(to.parameterRange, object.parameterRange);
  to.toolRadius = object.toolRadius;
  to.velocity = object.velocity;
  to.velocityEnd = object.velocityEnd;
  to.acceleration = object.acceleration;
  to.deceleration = object.deceleration;
  to.length = object.length;
  to.marks = object.marks;
  copyAll(to.switchPosition, object.switchPosition);
  copyAll(to.switchId, object.switchId);
  to.sentence = object.sentence;
  to.smoothAxes = object.smoothAxes;
  copyAll(to.moreShape, object.moreShape);
  to.planeX = object.planeX;
  to.planeY = object.planeY;
  to.normal = object.normal;
  to.features = object.features;
  to.program = object.program;
  copyAll(to.additional, object.additional);
  to.cornerDistance = object.cornerDistance;
  copyAll(to.startSlope, object.startSlope);
  copyAll(to.endSlope, object.endSlope);
  copyAll(to.limits, object.limits);
  to.probe = object.probe;
  to.slopes = object.slopes;
  to.planar = object.planar;
  to.orientation = object.orientation;
  to.modes = object.modes;
  copyAll(to.system, object.system);
  to.tool = object.tool;
  __builtin_memcpy(bytes, memory, sizeof memory);
}

void mendFileObject(PathObject &object) noexcept { object.planar = object.planar != 0 ? 1 : 0; }

uint32_t writeQueueFilePart(const Queue *queue, uint64_t offset, uint8_t *bytes,
                            uint32_t count) noexcept {
  const uint32_t objects = countOf(queue);
  uint32_t done = 0;
  while (done < count) {
    uint8_t piece[kObject];
    uint64_t inside = offset + done;
    uint64_t size = kQueueFileHeaderSize;
    if (inside < size) {
      if (checkQueue(queue) != QueueError::None)
        return 0;
      writeQueueFileHeader(headerOf(*queue), piece);
    } else {
      const uint64_t n = (inside - kQueueFileHeaderSize) / kObject;
      if (n >= objects)
        break;
      inside = (inside - kQueueFileHeaderSize) % kObject;
      size = kObject;
      writeFileObject(*objectAt(queue, static_cast<uint32_t>(n)), piece);
    }
    const uint64_t left = size - inside;
    const uint32_t part = left < count - done ? static_cast<uint32_t>(left) : count - done;
    __builtin_memcpy(bytes + done, piece + inside, part);
    done += part;
  }
  return done;
}

void setQueueContent(Queue &queue, const QueueFileHeader &header) noexcept {
  clear(&queue);
  uint32_t places = 0;
  PathObject *objects = placesOf(&queue, places);
  for (uint32_t i = 0; i < header.count; ++i)
    mendFileObject(objects[i]);
  queue.writePosition = header.count * sizeof(PathObject);
  queue.endOfList = 1;
  queue.generator = header.generator;
  __builtin_memcpy(queue.programName, header.name, sizeof queue.programName);
  queue.full = isFull(&queue);
}

QueueFileError readQueueFile(const uint8_t *bytes, int64_t size, Queue &queue) noexcept {
  QueueFileHeader header{};
  if (size < kQueueFileHeaderSize)
    return QueueFileError::Truncated;
  if (const QueueFileError error = readQueueFileHeader(bytes, header);
      error != QueueFileError::None)
    return error;
  const int64_t whole = queueFileSize(header.count);
  if (size < whole)
    return QueueFileError::Truncated;
  const int64_t content = whole - kQueueFileChecksumSize;
  const auto sum = valueAt<uint32_t>(bytes + content, 0);
  if (size > whole || numeric::crc32(0, bytes, content) != sum)
    return QueueFileError::Damaged;
  uint32_t places = 0;
  PathObject *objects = placesOf(&queue, places);
  if (header.count > places)
    return QueueFileError::Room;
  if (header.count > 0)
    __builtin_memcpy(objects, bytes + kQueueFileHeaderSize, header.count * sizeof(PathObject));
  setQueueContent(queue, header);
  return QueueFileError::None;
}

} // namespace stride::cnc
