// SysLibStr.
#include "runtime/blocks/host_side.hpp"

#include "st/SysLibStr/SysStrCmp.h"
#include "st/SysLibStr/SysStrCpy.h"
#include "st/SysLibStr/SysStrLen.h"

#include <cstring>

using stride::system::copyMemory;
using stride::system::memoryAt;
using stride::system::textLengthAt;

namespace st::SysLibStr {

::stride::DINT SysStrLen(::stride::Ctx &ctx__, ::stride::UXINT pString) {
  return static_cast<::stride::DINT>(textLengthAt(ctx__, pString));
}

::stride::DWORD SysStrCpy(::stride::Ctx &ctx__, ::stride::UXINT pDest, ::stride::UXINT pSrc) {
  return copyMemory(ctx__, pDest, pSrc, textLengthAt(ctx__, pSrc) + 1);
}

::stride::DINT SysStrCmp(::stride::Ctx &ctx__, ::stride::UXINT pString1, ::stride::UXINT pString2) {
  const char *const a = memoryAt<char>(ctx__, pString1, textLengthAt(ctx__, pString1) + 1);
  const char *const b = memoryAt<char>(ctx__, pString2, textLengthAt(ctx__, pString2) + 1);
  const int order = std::strcmp(a, b);
  return order < 0 ? -1 : order > 0 ? 1 : 0;
}

} // namespace st::SysLibStr
