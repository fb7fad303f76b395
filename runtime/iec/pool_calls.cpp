// Apart from pool.cpp: only applications that use the pool define its place.
#include "runtime/iec/pool.h"

namespace stride {

namespace {

BYTE *memoryOf(Ctx &ctx) { return &root<BYTE>(ctx, poolPlace); }

} // namespace

void *poolNew(Ctx &ctx, uint64_t elementSize, int64_t count, uint64_t typeHash) {
  return pool::allocate(memoryOf(ctx), poolSize, elementSize, count, typeHash);
}

void poolDelete(Ctx &ctx, void *object, const char *file, uint32_t line, uint32_t col) {
  if (object != nullptr && !pool::release(memoryOf(ctx), poolSize, object))
    raiseDetail(ctx, ExceptionCode::AccessViolation, file, line, col,
                "__DELETE of something that __NEW has not given, or a second time");
}

uint64_t poolCount(Ctx &ctx, const void *object) {
  const PoolBlock *block =
      object == nullptr ? nullptr : pool::find(memoryOf(ctx), poolSize, object);
  return block == nullptr ? 0 : block->count;
}

void *poolNext(Ctx &ctx, uint64_t &at, const PoolBlock *&block) {
  BYTE *const memory = memoryOf(ctx);
  const uint64_t place = pool::next(memory, poolSize, at);
  if (place >= poolSize)
    return nullptr;
  block = reinterpret_cast<const PoolBlock *>(memory + place);
  at = place + block->size;
  return memory + place + sizeof(PoolBlock);
}

} // namespace stride
