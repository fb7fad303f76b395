// __NEW and __DELETE: a pool of fixed size within the application's state.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_POOL_H
#define STRIDE_RUNTIME_IEC_POOL_H

#include "runtime/iec/ctx.h"
#include "runtime/iec/types.h"

namespace stride {

/// In front of every object of the pool; blocks follow each other without gaps. A block of size 0
/// is memory that has never been used, up to the pool's end.
struct PoolBlock {
  uint64_t size;     ///< Of the block with this header, a multiple of 16. [bytes]
  uint64_t typeHash; ///< TypeDesc::layoutHash of the elements; 0: the block is free.
  uint64_t count;    ///< Number of elements.
  uint64_t elementSize;
};
static_assert(sizeof(PoolBlock) == 32, "part of the state's layout");

/// The pool of an application with N bytes, headers included.
template <uint64_t N> struct Pool {
  static_assert(N % 16 == 0, "whole blocks");
  alignas(16) BYTE memory[N];
};

/// Where the pool lies in the state, and its size; defined by an application that uses it.
extern const ULINT poolPlace;
extern const ULINT poolSize;

/// Zeroed room for `count` elements in the first free block that is large enough; null when there
/// is none (or for a count below 1).
void *poolNew(Ctx &ctx, uint64_t elementSize, int64_t count, uint64_t typeHash);
/// Gives an object back. Null is ignored; what is not an object of the pool (any more) raises
/// AccessViolation at the position.
void poolDelete(Ctx &ctx, void *object, const char *file, uint32_t line, uint32_t col);
/// Number of elements behind a pointer that __NEW has given; 0 for all others.
uint64_t poolCount(Ctx &ctx, const void *object);

/// __NEW: the memory as a pointer.
template <class T> inline T *newObjects(Ctx &ctx, int64_t count, uint64_t typeHash) {
  return static_cast<T *>(poolNew(ctx, sizeof(T), count, typeHash));
}

namespace pool {

// The same on any memory, for tests and for what carries a pool over.
void *allocate(BYTE *memory, uint64_t size, uint64_t elementSize, int64_t count, uint64_t typeHash);
/// False: not an object of the pool.
bool release(BYTE *memory, uint64_t size, const void *object);
/// The header of an object, or null.
PoolBlock *find(BYTE *memory, uint64_t size, const void *object);

} // namespace pool

} // namespace stride

#endif
