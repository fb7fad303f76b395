#include "runtime/blocks/host_side.hpp"

#include <cstring>

namespace stride::system {

uint32_t fileModeOf(const char *text) {
  uint32_t mode = 0;
  switch (text[0]) {
  case 'r':
    mode = kFileRead;
    break;
  case 'w':
    mode = kFileWrite | kFileCreate | kFileTruncate;
    break;
  case 'a':
    mode = kFileWrite | kFileCreate | kFileAppend;
    break;
  default:
    return 0;
  }
  for (const char *at = text + 1; *at != 0; ++at) {
    if (*at == '+')
      mode |= kFileRead | kFileWrite;
    else if (*at != 'b' && *at != 't')
      return 0;
  }
  return mode;
}

DWORD copyMemory(Ctx &ctx, UXINT to, UXINT from, uint64_t size) {
  const BYTE *const source = memoryAt(ctx, from, size);
  BYTE *const target = memoryAt(ctx, to, size);
  if (size != 0)
    std::memmove(target, source, size);
  return static_cast<DWORD>(to);
}

/// By pieces, so that a text may end close to the end of the memory.
uint64_t textLengthAt(Ctx &ctx, UXINT address) {
  for (uint64_t length = 0;; ++length)
    if (*memoryAt(ctx, address + length, 1) == 0)
      return length;
}

} // namespace stride::system
