// What the host offers to the system libraries (SysLibMem, SysLibTime, SysLibFile …), whose bodies
// are linked into the application. Free of the C++ standard library; see runtime/iec/types.h.
#ifndef STRIDE_RUNTIME_SYSTEM_SYSTEM_API_H
#define STRIDE_RUNTIME_SYSTEM_SYSTEM_API_H

#include "runtime/iec/ctx.h"
#include "runtime/iec/types.h"

namespace stride {

/// What is asked of the disk.
enum class FileOp : uint32_t {
  None = 0,
  // By name, with a file of the asynchronous blocks as their answer or subject.
  Open = 1,
  Close = 2,
  Read = 3,
  Write = 4,
  SetPosition = 5,
  GetPosition = 6,
  AtEnd = 7,
  // By name only.
  Size = 8,
  Times = 9,
  Delete = 10,
  Rename = 11,
  Copy = 12,
  // For the functions that have their answer at once: whole files read into memory, and files
  // written through a ring.
  OpenStream = 13,
  CloseStream = 14,
};

/// The numbers of SYSFILE_ERROR in stdlib/SysLibFile.
enum class FileError : uint16_t {
  None = 0,
  Pending = 1,
  NotFound = 2,
  Exists = 3,
  BadName = 4,
  BadMode = 5,
  BadHandle = 6,
  NoSpace = 7,
  AccessDenied = 8,
  TooMany = 9,
  TooLarge = 10,
  Device = 11,
  NotPossible = 12,
  Outside = 13,
};

/// How a file is opened. Combined with |.
enum FileMode : uint32_t {
  kFileRead = 1,
  kFileWrite = 2,
  kFileAppend = 4,   ///< Everything is written at the end.
  kFileCreate = 8,   ///< Created if there is none.
  kFileTruncate = 16 ///< What it held is gone.
};

/// Plain data from the cycle; names and data are copied at once.
struct FileRequest {
  FileOp op;
  uint32_t mode;     ///< FileMode; only for Open and OpenStream.
  uint32_t file;     ///< Handle.
  uint32_t reserved; ///< 0.
  uint64_t position;
  uint64_t size;
  const char *name;   ///< Or null.
  const char *second; ///< The new name; or null.
  const void *data;   ///< Write.
};

/// What came of it.
struct FileAnswer {
  BOOL done;
  FileError error;
  uint64_t value;    ///< Handle, position, size, number of bytes, 0 or 1.
  uint64_t times[3]; ///< Times: creation, last access, last change; seconds since 1970.
};

/// What is done with a stream. Each has its answer at once.
enum class StreamOp : uint32_t { Read, Write, SetPosition, GetPosition, AtEnd };

/// The longest data of one Read or Write request. [bytes]
inline constexpr uint64_t kFileChunk = 16384;
/// The longest name, end mark included.
inline constexpr uint32_t kFileName = 256;

/// Nothing here waits, allocates or throws.
struct SystemApi {
  uint32_t size;     ///< sizeof(SystemApi) of the host.
  uint32_t reserved; ///< 0.
  void *self;        ///< The host's own object.
  /// All of these bytes are the application's: its state, or live on the stack of the caller.
  BOOL (*owns)(void *self, const Ctx *ctx, const void *at, uint64_t size);
  /// Nanoseconds since 1970 at the start of the cycle.
  int64_t (*wallClock)(void *self, const Ctx *ctx);
  // Files; null outside of cycles.
  /// Starts a request; its number, or 0: no room now.
  uint32_t (*fileStart)(void *self, const Ctx *ctx, const FileRequest *request) = nullptr;
  /// Looks after it. When it is done, the number is given up; a Read's data, at most `room` bytes,
  /// are put there.
  void (*filePoll)(void *self, const Ctx *ctx, uint32_t number, void *data, uint64_t room,
                   FileAnswer *answer) = nullptr;
  /// Start and poll in one: not done, and started if it was not. Asked again with the same values
  /// it is done at some time.
  void (*fileAsk)(void *self, const Ctx *ctx, const FileRequest *request,
                  FileAnswer *answer) = nullptr;
  void (*stream)(void *self, const Ctx *ctx, StreamOp op, uint32_t file, void *data, uint64_t size,
                 FileAnswer *answer) = nullptr;
  /// Of the last of these that the task has used.
  FileError (*lastError)(void *self, const Ctx *ctx) = nullptr;
};

} // namespace stride

#endif
