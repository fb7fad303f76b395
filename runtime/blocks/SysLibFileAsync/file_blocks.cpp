// SysLibFileAsync: blocks that start a request, and look for its end in later cycles.
#include "runtime/blocks/host_side.hpp"

#include "st/SysLibFileAsync/SysFileCloseAsync.h"
#include "st/SysLibFileAsync/SysFileCopyAsync.h"
#include "st/SysLibFileAsync/SysFileDeleteAsync.h"
#include "st/SysLibFileAsync/SysFileEOFAsync.h"
#include "st/SysLibFileAsync/SysFileGetPosAsync.h"
#include "st/SysLibFileAsync/SysFileGetSizeAsync.h"
#include "st/SysLibFileAsync/SysFileGetTimeAsync.h"
#include "st/SysLibFileAsync/SysFileOpenAsync.h"
#include "st/SysLibFileAsync/SysFileReadAsync.h"
#include "st/SysLibFileAsync/SysFileRenameAsync.h"
#include "st/SysLibFileAsync/SysFileSetPosAsync.h"
#include "st/SysLibFileAsync/SysFileWriteAsync.h"

namespace {

using stride::Ctx;
using stride::FileAnswer;
using stride::FileError;
using stride::FileOp;
using stride::FileRequest;
using stride::SystemApi;

template <class Block> void clear(Block &block) {
  block.bDone = 0;
  block.bBusy = 0;
  block.bError = 0;
  block.wErrorId = 0;
}

template <class Block> void finish(Block &block, FileError error) {
  block.bActive = 0;
  block.bBusy = 0;
  block.bDone = error == FileError::None ? 1 : 0;
  block.bError = error == FileError::None ? 0 : 1;
  block.wErrorId = static_cast<stride::WORD>(error);
}

/// True: there is a request to start or to look after. When bEnable falls meanwhile, it still goes
/// to its end, and the outputs show that for one cycle.
template <class Block> bool active(Ctx &ctx, Block &block, bool &begins) {
  begins = false;
  if (block.bActive != 0) {
    if (block.bEnable == 0)
      block.bEnableOld = 0;
    return true;
  }
  if (block.bEnable == 0)
    clear(block);
  const bool rises = block.bEnable != 0 && block.bEnableOld == 0;
  block.bEnableOld = block.bEnable;
  if (!rises)
    return false;
  clear(block);
  if (stride::system::filesOf(ctx) == nullptr) {
    finish(block, FileError::NotPossible);
    return false;
  }
  block.bActive = 1;
  block.bBusy = 1;
  block.udiRequest = 0;
  begins = true;
  return true;
}

/// Starts the request where it is not under way (where there is no room, in a later cycle) or looks
/// after it; true: it is done.
template <class Block>
bool goOn(Ctx &ctx, Block &block, const FileRequest &request, FileAnswer &answer,
          void *data = nullptr, uint64_t room = 0) {
  const SystemApi *const api = stride::system::filesOf(ctx);
  if (block.udiRequest == 0) {
    block.udiRequest = api->fileStart(api->self, &ctx, &request);
    return false;
  }
  api->filePoll(api->self, &ctx, block.udiRequest, data, room, &answer);
  if (answer.done == 0)
    return false;
  block.udiRequest = 0;
  return true;
}

/// A block with one request; `take` puts a good answer into its outputs.
template <class Block, class Take>
void runOnce(Ctx &ctx, Block &block, const FileRequest &request, Take take) {
  bool begins = false;
  FileAnswer answer{};
  if (!active(ctx, block, begins) || !goOn(ctx, block, request, answer))
    return;
  if (answer.error == FileError::None)
    take(answer);
  finish(block, answer.error);
}

void nothing(const FileAnswer &) {}

FileRequest onFile(FileOp op, stride::DWORD file) {
  FileRequest request{};
  request.op = op;
  request.file = file;
  return request;
}

FileRequest onName(FileOp op, const char *name, const char *second = nullptr) {
  FileRequest request{};
  request.op = op;
  request.name = name;
  request.second = second;
  return request;
}

/// Reading and writing: in parts, as many requests as it takes.
template <class Block> void transfer(Ctx &ctx, Block &block, FileOp op, stride::DWORD &count) {
  bool begins = false;
  if (!active(ctx, block, begins))
    return;
  if (begins) {
    block.udiBefore = 0;
    count = 0;
  }
  if (block.udiRequest == 0) {
    const stride::DWORD left =
        block.dwSize - (block.udiBefore < block.dwSize ? block.udiBefore : block.dwSize);
    block.udiPart =
        left < stride::kFileChunk ? left : static_cast<stride::UDINT>(stride::kFileChunk);
  }
  stride::BYTE *const data = stride::system::memoryAt(
      ctx, reinterpret_cast<stride::UXINT>(block.pBuffer) + block.udiBefore, block.udiPart);
  FileRequest request = onFile(op, block.hFile);
  request.size = block.udiPart;
  request.data = data;
  const bool reads = op == FileOp::Read;
  FileAnswer answer{};
  if (!goOn(ctx, block, request, answer, reads ? data : nullptr, reads ? block.udiPart : 0))
    return;
  block.udiBefore += static_cast<stride::UDINT>(answer.value);
  count = block.udiBefore;
  if (answer.error != FileError::None || answer.value < block.udiPart ||
      block.udiBefore >= block.dwSize)
    finish(block, answer.error);
  else
    transfer(ctx, block, op, count); // starts the next part at once
}

} // namespace

namespace st::SysLibFileAsync {

void SysFileOpenAsync::body__(::stride::Ctx &ctx__) {
  FileRequest request = onName(FileOp::Open, stFileName.s);
  request.mode = ::stride::system::fileModeOf(stMode.s);
  runOnce(ctx__, *this, request,
          [this](const FileAnswer &answer) { hFile = static_cast<::stride::DWORD>(answer.value); });
}

void SysFileCloseAsync::body__(::stride::Ctx &ctx__) {
  runOnce(ctx__, *this, onFile(FileOp::Close, hFile), nothing);
}

void SysFileReadAsync::body__(::stride::Ctx &ctx__) {
  transfer(ctx__, *this, FileOp::Read, dwRead);
}

void SysFileWriteAsync::body__(::stride::Ctx &ctx__) {
  transfer(ctx__, *this, FileOp::Write, dwWritten);
}

void SysFileSetPosAsync::body__(::stride::Ctx &ctx__) {
  FileRequest request = onFile(FileOp::SetPosition, hFile);
  request.position = dwPos;
  runOnce(ctx__, *this, request, nothing);
}

void SysFileGetPosAsync::body__(::stride::Ctx &ctx__) {
  runOnce(ctx__, *this, onFile(FileOp::GetPosition, hFile),
          [this](const FileAnswer &answer) { dwPos = static_cast<::stride::DWORD>(answer.value); });
}

void SysFileEOFAsync::body__(::stride::Ctx &ctx__) {
  runOnce(ctx__, *this, onFile(FileOp::AtEnd, hFile),
          [this](const FileAnswer &answer) { bEOF = answer.value != 0 ? 1 : 0; });
}

void SysFileGetSizeAsync::body__(::stride::Ctx &ctx__) {
  runOnce(ctx__, *this, onName(FileOp::Size, stFName.s), [this](const FileAnswer &answer) {
    dwSize = static_cast<::stride::DWORD>(answer.value);
  });
}

void SysFileGetTimeAsync::body__(::stride::Ctx &ctx__) {
  runOnce(ctx__, *this, onName(FileOp::Times, stFileName.s), [this](const FileAnswer &answer) {
    ftFileTime.dtCreation = static_cast<::stride::DT>(answer.times[0]);
    ftFileTime.dtLastAccess = static_cast<::stride::DT>(answer.times[1]);
    ftFileTime.dtLastModification = static_cast<::stride::DT>(answer.times[2]);
  });
}

void SysFileDeleteAsync::body__(::stride::Ctx &ctx__) {
  runOnce(ctx__, *this, onName(FileOp::Delete, stFileName.s), nothing);
}

void SysFileRenameAsync::body__(::stride::Ctx &ctx__) {
  runOnce(ctx__, *this, onName(FileOp::Rename, stOldName.s, stNewName.s), nothing);
}

void SysFileCopyAsync::body__(::stride::Ctx &ctx__) {
  runOnce(
      ctx__, *this, onName(FileOp::Copy, stSourceName.s, stDestName.s),
      [this](const FileAnswer &answer) { dwCopied = static_cast<::stride::DWORD>(answer.value); });
}

} // namespace st::SysLibFileAsync
