// __NEW and __DELETE: a pool of fixed size within the application's state. All tasks use it at
// once: nobody locks, nobody waits for another task.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_POOL_H
#define STRIDE_RUNTIME_IEC_POOL_H

#include "runtime/iec/ctx.h"
#include "runtime/iec/types.h"

namespace stride {

/// Before every object of the pool.
struct PoolBlock {
  uint64_t size;     ///< Of the block with this header, a multiple of 16. [bytes]
  uint64_t typeHash; ///< TypeDesc::layoutHash of the elements.
  uint64_t count;    ///< Number of elements.
  uint64_t elementSize;
};
static_assert(sizeof(PoolBlock) == 32, "part of the state's layout");

namespace pool {

inline constexpr uint64_t kGrain = 16;

/// Words of a map with one bit for every 16 bytes of a pool.
constexpr uint64_t mapWords(uint64_t size) { return (size / kGrain + 63) / 64; }
/// Bytes of a pool for `size` bytes of objects, with its two maps.
constexpr uint64_t wholeSize(uint64_t size) { return size + 2 * mapWords(size) * sizeof(uint64_t); }

} // namespace pool

/// The pool of an application with N bytes, headers included. All zero: empty.
template <uint64_t N> struct Pool {
  static_assert(N % 16 == 0, "whole blocks");
  alignas(16) BYTE memory[N];
  uint64_t used[pool::mapWords(N)];   ///< A bit for every 16 bytes: they belong to a block.
  uint64_t starts[pool::mapWords(N)]; ///< The same: a complete block begins there.
};

/// Where the pool lies in the state, and its size; defined by an application that uses it.
extern const ULINT poolPlace;
extern const ULINT poolSize;

/// Zeroed room for `count` elements at the first place that is large enough; null when there is
/// none (or for a count below 1).
void *poolNew(Ctx &ctx, uint64_t elementSize, int64_t count, uint64_t typeHash);
/// Gives an object back. Null is ignored; what is not an object of the pool (any more) raises
/// AccessViolation at the position.
void poolDelete(Ctx &ctx, void *object, const char *file, uint32_t line, uint32_t col);
/// Number of elements behind a pointer that __NEW has given; 0 for all others.
uint64_t poolCount(Ctx &ctx, const void *object);

/// The first object whose block begins at or after `at`, which moves beyond it; null when there is
/// none any more. `block` is its header.
void *poolNext(Ctx &ctx, uint64_t &at, const PoolBlock *&block);

/// __NEW: the memory as a pointer.
template <class T> inline T *newObjects(Ctx &ctx, int64_t count, uint64_t typeHash) {
  return static_cast<T *>(poolNew(ctx, sizeof(T), count, typeHash));
}

namespace pool {

// The same on any memory of wholeSize(size) bytes, for tests and for what carries a pool over.
void *allocate(BYTE *memory, uint64_t size, uint64_t elementSize, int64_t count, uint64_t typeHash);
/// False: not an object of the pool.
bool release(BYTE *memory, uint64_t size, const void *object);
/// The header of an object, or null.
PoolBlock *find(BYTE *memory, uint64_t size, const void *object);
/// The place of the first block at or after a place; `size` if there is none.
uint64_t next(const BYTE *memory, uint64_t size, uint64_t at);
/// Enters a block whose bytes have been put in place by hand. No task may use the pool meanwhile.
void enter(BYTE *memory, uint64_t size, uint64_t at);

} // namespace pool

} // namespace stride

#endif
