// SysLibMem.
#include "runtime/blocks/host_side.hpp"

#include "st/SysLibMem/SysMemCmp.h"
#include "st/SysLibMem/SysMemCpy.h"
#include "st/SysLibMem/SysMemForceSwap.h"
#include "st/SysLibMem/SysMemMove.h"
#include "st/SysLibMem/SysMemSet.h"
#include "st/SysLibMem/SysMemSwap.h"

#include <cstring>

namespace {

using stride::system::copyMemory;
using stride::system::memoryAt;

stride::DINT sign(int order) { return order < 0 ? -1 : order > 0 ? 1 : 0; }

bool hasOrder(stride::UDINT size) { return size == 2 || size == 4 || size == 8; }

} // namespace

namespace st::SysLibMem {

::stride::DWORD SysMemCpy(::stride::Ctx &ctx__, ::stride::UXINT pDest, ::stride::UXINT pSrc,
                          ::stride::UDINT udiCount) {
  return copyMemory(ctx__, pDest, pSrc, udiCount);
}

::stride::DWORD SysMemMove(::stride::Ctx &ctx__, ::stride::UXINT pDest, ::stride::UXINT pSrc,
                           ::stride::UDINT udiCount) {
  return copyMemory(ctx__, pDest, pSrc, udiCount);
}

::stride::DWORD SysMemSet(::stride::Ctx &ctx__, ::stride::UXINT pDest, ::stride::UDINT udiValue,
                          ::stride::UDINT udiCount) {
  ::stride::BYTE *const target = memoryAt(ctx__, pDest, udiCount);
  if (udiCount != 0)
    std::memset(target, static_cast<int>(udiValue & 0xFF), udiCount);
  return static_cast<::stride::DWORD>(pDest);
}

::stride::DINT SysMemCmp(::stride::Ctx &ctx__, ::stride::UXINT pBuffer1, ::stride::UXINT pBuffer2,
                         ::stride::UDINT udiCount) {
  const ::stride::BYTE *const a = memoryAt(ctx__, pBuffer1, udiCount);
  const ::stride::BYTE *const b = memoryAt(ctx__, pBuffer2, udiCount);
  return udiCount == 0 ? 0 : sign(std::memcmp(a, b, udiCount));
}

/// All processors of Stride have Intel's order.
::stride::DINT SysMemSwap(::stride::Ctx &, ::stride::UXINT, ::stride::UDINT udiSize,
                          ::stride::UDINT) {
  return hasOrder(udiSize) ? 0 : -1;
}

::stride::DINT SysMemForceSwap(::stride::Ctx &ctx__, ::stride::UXINT pbyBuffer,
                               ::stride::UDINT udiSize, ::stride::UDINT udiCount) {
  if (!hasOrder(udiSize))
    return -1;
  const uint64_t size = uint64_t{udiSize} * udiCount;
  ::stride::BYTE *const values = memoryAt(ctx__, pbyBuffer, size);
  for (uint64_t at = 0; at < size; at += udiSize)
    for (uint64_t i = 0; i < udiSize / 2; ++i) {
      const ::stride::BYTE kept = values[at + i];
      values[at + i] = values[at + udiSize - 1 - i];
      values[at + udiSize - 1 - i] = kept;
    }
  return static_cast<::stride::DINT>(size);
}

} // namespace st::SysLibMem
