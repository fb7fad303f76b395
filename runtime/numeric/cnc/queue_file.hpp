// The bytes of files that hold the queue of a path (docs/cnc-paths.md): what SMC_ReadNCQueue reads
// and SMC_WriteNCQueue writes.
//
// A file is header, objects, checksum, little endian and without gaps. An object is in the file as
// it is in memory; what is between its members is 0. Free of the C++ standard library: linked into
// every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_QUEUE_FILE_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_QUEUE_FILE_HPP

#include "runtime/numeric/cnc/queue.hpp"

namespace stride::cnc {

inline constexpr uint16_t kQueueFileVersion = 2;
inline constexpr int32_t kQueueFileHeaderSize = 112;
inline constexpr int32_t kQueueFileChecksumSize = 4;

/// What is wrong with a file.
enum class QueueFileError : uint8_t {
  None,
  Version,   ///< No queue, or of another version.
  Truncated, ///< It ends too early.
  Damaged,   ///< Wrong checksum, or bytes after the end.
  Room,      ///< The memory is too small for its objects.
};

/// The header of a file.
struct QueueFileHeader {
  uint32_t count;    ///< How many objects there are.
  uint8_t generator; ///< Generator: who has made the queue.
  char name[81];     ///< Of the program. Ends with 0.
};

/// Bytes of a whole file.
int64_t queueFileSize(uint32_t count) noexcept;

/// Writes kQueueFileHeaderSize bytes.
void writeQueueFileHeader(const QueueFileHeader &header, uint8_t *bytes) noexcept;

/// Reads kQueueFileHeaderSize bytes. A generator that there is not becomes kByNobody.
QueueFileError readQueueFileHeader(const uint8_t *bytes, QueueFileHeader &header) noexcept;

/// Writes sizeof(PathObject) bytes.
void writeFileObject(const PathObject &object, uint8_t *bytes) noexcept;

/// What the bytes of an object must be so that it can be used: flags are 0 or 1.
void mendFileObject(PathObject &object) noexcept;

/// Writes the bytes `offset` to `offset + count` of the file that the queue makes, without its
/// checksum. How many there were; 0 after the end.
uint32_t writeQueueFilePart(const Queue *queue, uint64_t offset, uint8_t *bytes,
                            uint32_t count) noexcept;

/// Says that the first `count` places of the queue's memory hold a complete path.
void setQueueContent(Queue &queue, const QueueFileHeader &header) noexcept;

/// Reads a whole file into the memory of a queue.
QueueFileError readQueueFile(const uint8_t *bytes, int64_t size, Queue &queue) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_QUEUE_FILE_HPP
