// The system libraries' way to the host.
#ifndef STRIDE_RUNTIME_BLOCKS_HOST_SIDE_HPP
#define STRIDE_RUNTIME_BLOCKS_HOST_SIDE_HPP

#include "runtime/system/system_api.h"

namespace stride::system {

/// Null where the application runs without one.
inline const SystemApi *apiOf(const Ctx &ctx) {
  return ctx.host != nullptr && ctx.host->size >= sizeof(HostApi) ? ctx.host->system : nullptr;
}

/// The same where there are files: in cycles.
inline const SystemApi *filesOf(const Ctx &ctx) {
  const SystemApi *const api = apiOf(ctx);
  return api != nullptr && api->fileStart != nullptr ? api : nullptr;
}

/// The bytes behind an address. Raises AccessViolation when they are not the application's.
template <class T = BYTE> T *memoryAt(Ctx &ctx, UXINT address, uint64_t size) {
  T *const at = reinterpret_cast<T *>(address);
  const SystemApi *const api = apiOf(ctx);
  if (size != 0 && (api == nullptr || api->owns(api->self, &ctx, at, size) == 0))
    raisePointer(ctx, at, nullptr, 0, 0);
  return at;
}

/// Copies bytes, which may overlap; the target's address. Raises as memoryAt does.
DWORD copyMemory(Ctx &ctx, UXINT to, UXINT from, uint64_t size);

/// Length of the text at an address. Raises as memoryAt does when it has no end there.
uint64_t textLengthAt(Ctx &ctx, UXINT address);

/// FileMode for 'r', 'w+' …; 0: none of them.
uint32_t fileModeOf(const char *text);

} // namespace stride::system

#endif
