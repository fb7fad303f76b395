#include "runtime/numeric/cam/cam_file.hpp"

#include "runtime/numeric/crc32.hpp"
#include "runtime/numeric/exact_math.hpp"

#include <stddef.h>

namespace stride::cam {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

// Looks like no text, and shows when something has changed line ends.
constexpr uint8_t kMagic[8] = {0x89, 'C', 'A', 'M', '\r', '\n', 0x1A, '\n'};

/// Where the members stand in the header.
enum Offset : int32_t {
  kVersionAt = 8,
  kFormAt = 10,
  kElementAt = 11,
  kInterpolationAt = 12,
  kFlagsAt = 13,
  kReservedAt = 14,
  kElementsAt = 16,
  kTappetsAt = 20,
  kStartAt = 24,
  kEndAt = 32,
  kRiseAt = 40,
  kNameAt = 48,
  kNameEnd = kNameAt + 81,
};
static_assert(kNameEnd <= kCamFileHeaderSize);

// What else changes the bytes needs another version.
static_assert(sizeof(Node) == 32 && sizeof(Segment) == 128 && sizeof(TableScaling) == 32);

template <class Value> void put(uint8_t *bytes, int32_t offset, Value value) noexcept {
  __builtin_memcpy(bytes + offset, &value, sizeof value);
}

template <class Value> Value get(const uint8_t *bytes, int32_t offset) noexcept {
  Value value;
  __builtin_memcpy(&value, bytes + offset, sizeof value);
  return value;
}

/// What lies between `from` and `to` of every `size` bytes becomes 0 in bytes that begin at
/// `offset`.
void clearGaps(int64_t from, int64_t to, int64_t size, int64_t offset, uint8_t *bytes,
               int64_t count) noexcept {
  for (int64_t i = 0; i < count; ++i) {
    const int64_t inside = (offset + i) % size;
    if (inside >= from && inside < to)
      bytes[i] = 0;
  }
}

/// Copies what `data` has of the bytes `offset` to `offset + count`; 0 after `size`.
void copyPart(const void *data, int64_t size, int64_t offset, uint8_t *bytes,
              int64_t count) noexcept {
  const int64_t there = size - offset < count ? size - offset : count;
  if (there > 0)
    __builtin_memcpy(bytes, static_cast<const uint8_t *>(data) + offset,
                     static_cast<size_t>(there));
  for (int64_t i = there < 0 ? 0 : there; i < count; ++i)
    bytes[i] = 0;
}

bool isTable(const CamFileHeader &header) noexcept {
  return header.form == Form::EvenTable || header.form == Form::PairTable;
}

int64_t sizeInMemory(const CamFileHeader &header) noexcept {
  if (header.elements == 0)
    return 0;
  return elementBlockSize(header.form, header.element, header.elements);
}

} // namespace

int64_t fileElementsSize(const CamFileHeader &header) noexcept {
  return (sizeInMemory(header) + 7) / 8 * 8;
}

int64_t camFileSize(const CamFileHeader &header) noexcept {
  return kCamFileHeaderSize + fileElementsSize(header) +
         int64_t{header.tappets} * int64_t{sizeof(FileTappet)} + kCamFileChecksumSize;
}

void writeCamFileHeader(const CamFileHeader &header, uint8_t *bytes) noexcept {
  __builtin_memset(bytes, 0, kCamFileHeaderSize);
  __builtin_memcpy(bytes, kMagic, sizeof kMagic);
  put(bytes, kVersionAt, kCamFileVersion);
  put(bytes, kFormAt, static_cast<uint8_t>(header.form));
  if (isTable(header)) {
    put(bytes, kElementAt, static_cast<uint8_t>(header.element));
    put(bytes, kInterpolationAt, static_cast<uint8_t>(header.cubic ? 3 : 1));
    put(bytes, kFlagsAt, static_cast<uint8_t>(header.open ? 1 : 0));
  }
  put(bytes, kElementsAt, header.elements);
  put(bytes, kTappetsAt, header.tappets);
  put(bytes, kStartAt, header.start);
  put(bytes, kEndAt, header.end);
  put(bytes, kRiseAt, header.open ? header.rise : 0.0);
  for (int32_t i = 0; i < 80 && header.name[i] != 0; ++i)
    bytes[kNameAt + i] = static_cast<uint8_t>(header.name[i]);
}

CamFileError readCamFileHeader(const uint8_t *bytes, CamFileHeader &header) noexcept {
  for (size_t i = 0; i < sizeof kMagic; ++i)
    if (bytes[i] != kMagic[i])
      return CamFileError::Version;
  if (get<uint16_t>(bytes, kVersionAt) != kCamFileVersion)
    return CamFileError::Version;
  header = {};
  header.form = static_cast<Form>(bytes[kFormAt]);
  const uint8_t flags = bytes[kFlagsAt];
  const uint8_t interpolation = bytes[kInterpolationAt];
  if (isTable(header)) {
    header.element = static_cast<Element>(bytes[kElementAt]);
    if (sizeOf(header.element) == 0 || (interpolation != 1 && interpolation != 3) ||
        flags > (header.form == Form::EvenTable ? 1 : 0))
      return CamFileError::Form;
    header.cubic = interpolation == 3;
    header.open = flags == 1;
  } else if ((header.form != Form::Nodes && header.form != Form::Segments) ||
             bytes[kElementAt] != 0 || interpolation != 0 || flags != 0) {
    return CamFileError::Form;
  }
  header.elements = get<uint32_t>(bytes, kElementsAt);
  header.tappets = get<uint32_t>(bytes, kTappetsAt);
  header.start = get<double>(bytes, kStartAt);
  header.end = get<double>(bytes, kEndAt);
  header.rise = get<double>(bytes, kRiseAt);
  if (get<uint16_t>(bytes, kReservedAt) != 0 || (header.elements == 0 && header.tappets == 0) ||
      header.elements > kCamFileMaxCount || header.tappets > kCamFileMaxCount ||
      !exact::isfinite(header.start) || !exact::isfinite(header.end) ||
      !exact::isfinite(header.rise) || !(header.start < header.end))
    return CamFileError::Damaged;
  __builtin_memcpy(header.name, bytes + kNameAt, sizeof header.name);
  return header.name[80] == 0 ? CamFileError::None : CamFileError::Damaged;
}

void writeFileElements(const CamFileHeader &header, const void *data, int64_t offset,
                       uint8_t *bytes, int64_t count) noexcept {
  const int64_t size = sizeInMemory(header);
  copyPart(data, size, offset, bytes, count);
  if (header.form == Form::Segments)
    clearGaps(__builtin_offsetof(Segment, law) + sizeof(Law), sizeof(Segment), sizeof(Segment),
              offset, bytes, count);
  if (isTable(header) && size > 0) {
    const int64_t numbers =
        header.form == Form::PairTable ? 2 * int64_t{header.elements} : int64_t{header.elements};
    clearGaps(numbers * sizeOf(header.element), size - int64_t{sizeof(TableScaling)}, size + 8,
              offset, bytes, count);
  }
}

void writeFileTappets(const FileTappet *tappets, int64_t offset, uint8_t *bytes,
                      int64_t count) noexcept {
  copyPart(tappets, offset + count, offset, bytes, count);
  constexpr int64_t kGap = __builtin_offsetof(FileTappet, unused);
  clearGaps(kGap, kGap + int64_t{sizeof(FileTappet::unused)}, sizeof(FileTappet), offset, bytes,
            count);
}

uint32_t camFileChecksum(uint32_t before, const void *bytes, int64_t count) noexcept {
  return numeric::crc32(before, bytes, count);
}

Curve curveOfFile(const CamFileHeader &header, const void *data) noexcept {
  Curve curve;
  curve.start = header.start;
  curve.end = header.end;
  curve.form = header.form;
  curve.element = header.element;
  curve.cubic = header.cubic;
  curve.open = header.open;
  curve.rise = header.open ? header.rise : 0.0;
  curve.count = static_cast<int32_t>(header.elements);
  attachElements(curve, data);
  return curve;
}

CamFileError openCamFile(const uint8_t *bytes, int64_t size, CamFile &file) noexcept {
  if (size < kCamFileHeaderSize) {
    for (int64_t i = 0; i < size && i < int64_t{sizeof kMagic}; ++i)
      if (bytes[i] != kMagic[i])
        return CamFileError::Version;
    return CamFileError::Truncated;
  }
  if (const CamFileError error = readCamFileHeader(bytes, file.header); error != CamFileError::None)
    return error;
  const int64_t whole = camFileSize(file.header);
  if (size < whole)
    return CamFileError::Truncated;
  const int64_t content = whole - kCamFileChecksumSize;
  if (size > whole || camFileChecksum(0, bytes, content) != get<uint32_t>(bytes + content, 0))
    return CamFileError::Damaged;
  file.elements = bytes + kCamFileHeaderSize;
  // NOLINTNEXTLINE: the bytes of a file, aligned as the caller promises.
  file.tappets = reinterpret_cast<const FileTappet *>(bytes + kCamFileHeaderSize +
                                                      fileElementsSize(file.header));
  if (file.header.elements == 0)
    return CamFileError::None;
  return checkCurve(curveOfFile(file.header, file.elements)) == CurveError::None
             ? CamFileError::None
             : CamFileError::Damaged;
}

void writeCamFile(const CamFileHeader &header, const void *elements, const FileTappet *tappets,
                  uint8_t *bytes) noexcept {
  writeCamFileHeader(header, bytes);
  const int64_t elementBytes = fileElementsSize(header);
  writeFileElements(header, elements, 0, bytes + kCamFileHeaderSize, elementBytes);
  writeFileTappets(tappets, 0, bytes + kCamFileHeaderSize + elementBytes,
                   int64_t{header.tappets} * int64_t{sizeof(FileTappet)});
  const int64_t content = camFileSize(header) - kCamFileChecksumSize;
  const uint32_t checksum = camFileChecksum(0, bytes, content);
  __builtin_memcpy(bytes + content, &checksum, sizeof checksum);
}

} // namespace stride::cam
