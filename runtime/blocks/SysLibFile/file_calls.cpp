// SysLibFile: functions that do not wait for the disk. What they cannot answer at once they answer
// in a later cycle, when they are called with the same inputs again.
#include "runtime/blocks/host_side.hpp"

#include "st/SysLibFile/FILETIME.h"
#include "st/SysLibFile/SYSFILE_ERROR.h"
#include "st/SysLibFile/SysFileClose.h"
#include "st/SysLibFile/SysFileCopy.h"
#include "st/SysLibFile/SysFileDelete.h"
#include "st/SysLibFile/SysFileEOF.h"
#include "st/SysLibFile/SysFileGetError.h"
#include "st/SysLibFile/SysFileGetPos.h"
#include "st/SysLibFile/SysFileGetSize.h"
#include "st/SysLibFile/SysFileGetTime.h"
#include "st/SysLibFile/SysFileOpen.h"
#include "st/SysLibFile/SysFileRead.h"
#include "st/SysLibFile/SysFileRename.h"
#include "st/SysLibFile/SysFileSetPos.h"
#include "st/SysLibFile/SysFileWrite.h"

#include <cstring>

namespace {

using stride::FileAnswer;
using stride::FileError;
using stride::FileOp;
using stride::FileRequest;
using stride::StreamOp;
using Name = stride::STRING<255>;

FileAnswer ask(stride::Ctx &ctx, FileRequest request) {
  FileAnswer answer{};
  if (const stride::SystemApi *const api = stride::system::filesOf(ctx))
    api->fileAsk(api->self, &ctx, &request, &answer);
  return answer;
}

FileAnswer askByName(stride::Ctx &ctx, FileOp op, const Name &name, const char *second = nullptr) {
  FileRequest request{};
  request.op = op;
  request.name = name.s;
  request.second = second;
  return ask(ctx, request);
}

bool succeeded(const FileAnswer &answer) {
  return answer.done != 0 && answer.error == FileError::None;
}

/// The value where there is one.
stride::DWORD valueOf(const FileAnswer &answer) {
  return succeeded(answer) ? static_cast<stride::DWORD>(answer.value) : 0;
}

FileAnswer stream(stride::Ctx &ctx, StreamOp op, stride::DWORD file, void *data = nullptr,
                  uint64_t size = 0) {
  FileAnswer answer{};
  if (const stride::SystemApi *const api = stride::system::filesOf(ctx))
    api->stream(api->self, &ctx, op, file, data, size, &answer);
  return answer;
}

} // namespace

namespace st::SysLibFile {

::stride::DWORD SysFileOpen(::stride::Ctx &ctx__, ::stride::STRING<255> File,
                            ::stride::STRING<7> Mode) {
  FileRequest request{};
  request.op = FileOp::OpenStream;
  request.mode = ::stride::system::fileModeOf(Mode.s);
  const bool both =
      (request.mode & ::stride::kFileRead) != 0 && (request.mode & ::stride::kFileWrite) != 0;
  if (both || request.mode == 0)
    request.mode = 0;
  request.name = File.s;
  return valueOf(ask(ctx__, request));
}

::stride::BOOL SysFileClose(::stride::Ctx &ctx__, ::stride::DWORD File) {
  FileRequest request{};
  request.op = FileOp::CloseStream;
  request.file = File;
  return succeeded(ask(ctx__, request)) ? 1 : 0;
}

::stride::DWORD SysFileRead(::stride::Ctx &ctx__, ::stride::DWORD File, ::stride::UXINT Buffer,
                            ::stride::DWORD Size) {
  void *const data = ::stride::system::memoryAt(ctx__, Buffer, Size);
  return static_cast<::stride::DWORD>(stream(ctx__, StreamOp::Read, File, data, Size).value);
}

::stride::DWORD SysFileWrite(::stride::Ctx &ctx__, ::stride::DWORD File, ::stride::UXINT Buffer,
                             ::stride::DWORD Size) {
  void *const data = ::stride::system::memoryAt(ctx__, Buffer, Size);
  return static_cast<::stride::DWORD>(stream(ctx__, StreamOp::Write, File, data, Size).value);
}

::stride::BOOL SysFileSetPos(::stride::Ctx &ctx__, ::stride::DWORD File, ::stride::DWORD Pos) {
  return static_cast<::stride::BOOL>(
      stream(ctx__, StreamOp::SetPosition, File, nullptr, Pos).value);
}

::stride::DWORD SysFileGetPos(::stride::Ctx &ctx__, ::stride::DWORD File) {
  return static_cast<::stride::DWORD>(stream(ctx__, StreamOp::GetPosition, File).value);
}

/// Of a file that is not open, too, so that loops up to the end have one.
::stride::BOOL SysFileEOF(::stride::Ctx &ctx__, ::stride::DWORD File) {
  const FileAnswer answer = stream(ctx__, StreamOp::AtEnd, File);
  return answer.value != 0 || !succeeded(answer) ? 1 : 0;
}

::stride::DWORD SysFileGetSize(::stride::Ctx &ctx__, ::stride::STRING<255> FileName) {
  return valueOf(askByName(ctx__, FileOp::Size, FileName));
}

::stride::BOOL SysFileGetTime(::stride::Ctx &ctx__, ::stride::STRING<255> FileName,
                              FILETIME *ftFileTime) {
  FILETIME &times = *::stride::system::memoryAt<FILETIME>(
      ctx__, reinterpret_cast<::stride::UXINT>(ftFileTime), sizeof(FILETIME));
  const FileAnswer answer = askByName(ctx__, FileOp::Times, FileName);
  if (!succeeded(answer))
    return 0;
  times.dtCreation = static_cast<::stride::DT>(answer.times[0]);
  times.dtLastAccess = static_cast<::stride::DT>(answer.times[1]);
  times.dtLastModification = static_cast<::stride::DT>(answer.times[2]);
  return 1;
}

::stride::BOOL SysFileDelete(::stride::Ctx &ctx__, ::stride::STRING<255> FileName) {
  return succeeded(askByName(ctx__, FileOp::Delete, FileName)) ? 1 : 0;
}

::stride::BOOL SysFileRename(::stride::Ctx &ctx__, ::stride::STRING<255> FileOldName,
                             ::stride::STRING<255> FileNewName) {
  return succeeded(askByName(ctx__, FileOp::Rename, FileOldName, FileNewName.s)) ? 1 : 0;
}

::stride::UDINT SysFileCopy(::stride::Ctx &ctx__, ::stride::STRING<255> FileDest,
                            ::stride::STRING<255> FileSource) {
  return valueOf(askByName(ctx__, FileOp::Copy, FileSource, FileDest.s));
}

SYSFILE_ERROR SysFileGetError(::stride::Ctx &ctx__) {
  const ::stride::SystemApi *const api = ::stride::system::filesOf(ctx__);
  return static_cast<SYSFILE_ERROR>(api == nullptr ? FileError::NotPossible
                                                   : api->lastError(api->self, &ctx__));
}

} // namespace st::SysLibFile
