#include "runtime/iec/pool.h"

#include <cstring>

namespace stride {

namespace pool {

namespace {

constexpr uint64_t kHeader = sizeof(PoolBlock);
constexpr uint64_t kFree = ~uint64_t{0};

uint64_t *usedOf(BYTE *memory, uint64_t size) {
  return reinterpret_cast<uint64_t *>(memory + size);
}
uint64_t *startsOf(BYTE *memory, uint64_t size) { return usedOf(memory, size) + mapWords(size); }
PoolBlock *blockAt(BYTE *memory, uint64_t at) { return reinterpret_cast<PoolBlock *>(memory + at); }

/// The bits of [first, end) that are in the word with this number.
uint64_t maskOf(uint64_t word, uint64_t first, uint64_t end) {
  const uint64_t low = first > word * 64 ? first - word * 64 : 0;
  const uint64_t high = end < (word + 1) * 64 ? end - word * 64 : 64;
  return (high == 64 ? ~uint64_t{0} : (uint64_t{1} << high) - 1) & (~uint64_t{0} << low);
}

/// The last bit of [first, end) that is set, or kFree.
uint64_t lastUsed(const uint64_t *map, uint64_t first, uint64_t end) {
  for (uint64_t word = (end - 1) / 64 + 1; word-- > first / 64;) {
    const uint64_t set = __atomic_load_n(&map[word], __ATOMIC_RELAXED) & maskOf(word, first, end);
    if (set != 0)
      return word * 64 + 63 - static_cast<uint64_t>(__builtin_clzll(set));
  }
  return kFree;
}

void clear(uint64_t *map, uint64_t first, uint64_t end) {
  for (uint64_t word = first / 64; word * 64 < end; ++word)
    __atomic_fetch_and(&map[word], ~maskOf(word, first, end), __ATOMIC_RELEASE);
}

/// Sets all bits of [first, end); none, when another task has some of them.
bool claim(uint64_t *map, uint64_t first, uint64_t end) {
  for (uint64_t word = first / 64; word * 64 < end; ++word) {
    const uint64_t mask = maskOf(word, first, end);
    uint64_t old = __atomic_load_n(&map[word], __ATOMIC_RELAXED);
    do {
      if ((old & mask) != 0) {
        if (word * 64 > first)
          clear(map, first, word * 64);
        return false;
      }
    } while (!__atomic_compare_exchange_n(&map[word], &old, old | mask, true, __ATOMIC_ACQUIRE,
                                          __ATOMIC_RELAXED));
  }
  return true;
}

/// The grain where the object's block begins; kFree for what cannot be an object.
uint64_t grainOf(const BYTE *memory, uint64_t size, const void *object) {
  const auto address = reinterpret_cast<uint64_t>(object);
  const uint64_t at = address - reinterpret_cast<uint64_t>(memory) - kHeader; // huge: in front
  return at < size && at % kGrain == 0 ? at / kGrain : kFree;
}

} // namespace

void *allocate(BYTE *memory, uint64_t size, uint64_t elementSize, int64_t count,
               uint64_t typeHash) {
  if (count < 1 || elementSize == 0 || static_cast<uint64_t>(count) > size / elementSize)
    return nullptr;
  const uint64_t grains =
      kHeader / kGrain + (elementSize * static_cast<uint64_t>(count) + kGrain - 1) / kGrain;
  uint64_t *used = usedOf(memory, size);
  for (uint64_t first = 0; first + grains <= size / kGrain;) {
    if (const uint64_t last = lastUsed(used, first, first + grains); last != kFree) {
      first = last + 1;
      continue;
    }
    if (!claim(used, first, first + grains))
      continue;
    const uint64_t at = first * kGrain;
    std::memset(memory + at + kHeader, 0, grains * kGrain - kHeader);
    *blockAt(memory, at) = {grains * kGrain, typeHash, static_cast<uint64_t>(count), elementSize};
    __atomic_fetch_or(&startsOf(memory, size)[first / 64], uint64_t{1} << first % 64,
                      __ATOMIC_RELEASE);
    return memory + at + kHeader;
  }
  return nullptr;
}

PoolBlock *find(BYTE *memory, uint64_t size, const void *object) {
  const uint64_t grain = grainOf(memory, size, object);
  if (grain == kFree)
    return nullptr;
  const uint64_t word = __atomic_load_n(&startsOf(memory, size)[grain / 64], __ATOMIC_ACQUIRE);
  return (word >> grain % 64 & 1U) != 0 ? blockAt(memory, grain * kGrain) : nullptr;
}

bool release(BYTE *memory, uint64_t size, const void *object) {
  const uint64_t grain = grainOf(memory, size, object);
  if (grain == kFree)
    return false;
  // Of tasks that give the same object back, one finds the bit.
  const uint64_t bit = uint64_t{1} << grain % 64;
  if ((__atomic_fetch_and(&startsOf(memory, size)[grain / 64], ~bit, __ATOMIC_ACQ_REL) & bit) == 0)
    return false;
  clear(usedOf(memory, size), grain, grain + blockAt(memory, grain * kGrain)->size / kGrain);
  return true;
}

uint64_t next(const BYTE *memory, uint64_t size, uint64_t at) {
  const auto *starts = reinterpret_cast<const uint64_t *>(memory + size) + mapWords(size);
  const uint64_t first = (at + kGrain - 1) / kGrain;
  for (uint64_t word = first / 64; word < mapWords(size); ++word) {
    uint64_t set = starts[word];
    if (word == first / 64)
      set &= ~uint64_t{0} << first % 64;
    if (set != 0)
      return (word * 64 + static_cast<uint64_t>(__builtin_ctzll(set))) * kGrain;
  }
  return size;
}

void enter(BYTE *memory, uint64_t size, uint64_t at) {
  const uint64_t first = at / kGrain;
  claim(usedOf(memory, size), first, first + blockAt(memory, at)->size / kGrain);
  startsOf(memory, size)[first / 64] |= uint64_t{1} << first % 64;
}

} // namespace pool

} // namespace stride
