#include "runtime/iec/pool.h"

#include <cstring>

namespace stride {

namespace pool {

namespace {

constexpr uint64_t kHeader = sizeof(PoolBlock);
constexpr uint64_t kGrain = 16;

PoolBlock *blockAt(BYTE *memory, uint64_t at) { return reinterpret_cast<PoolBlock *>(memory + at); }

/// The block's size; one that has never been used reaches to the end.
uint64_t sizeOf(const PoolBlock &block, uint64_t at, uint64_t size) {
  return block.size == 0 ? size - at : block.size;
}

} // namespace

void *allocate(BYTE *memory, uint64_t size, uint64_t elementSize, int64_t count,
               uint64_t typeHash) {
  if (count < 1 || elementSize == 0 || static_cast<uint64_t>(count) > size / elementSize)
    return nullptr;
  const uint64_t wanted =
      kHeader + (elementSize * static_cast<uint64_t>(count) + kGrain - 1) / kGrain * kGrain;
  for (uint64_t at = 0; at + kHeader <= size;) {
    PoolBlock &block = *blockAt(memory, at);
    uint64_t own = sizeOf(block, at, size);
    if (block.typeHash != 0) {
      at += own;
      continue;
    }
    // Free blocks behind each other become one.
    while (at + own + kHeader <= size && blockAt(memory, at + own)->typeHash == 0)
      own += sizeOf(*blockAt(memory, at + own), at + own, size);
    block.size = own;
    if (own < wanted) {
      at += own;
      continue;
    }
    if (own - wanted >= kHeader + kGrain) {
      PoolBlock &rest = *blockAt(memory, at + wanted);
      rest = {own - wanted, 0, 0, 0};
      block.size = wanted;
    }
    block.typeHash = typeHash == 0 ? 1 : typeHash;
    block.count = static_cast<uint64_t>(count);
    block.elementSize = elementSize;
    BYTE *object = memory + at + kHeader;
    std::memset(object, 0, block.size - kHeader);
    return object;
  }
  return nullptr;
}

PoolBlock *find(BYTE *memory, uint64_t size, const void *object) {
  const auto *wanted = static_cast<const BYTE *>(object);
  for (uint64_t at = 0; at + kHeader <= size;) {
    PoolBlock &block = *blockAt(memory, at);
    if (memory + at + kHeader == wanted)
      return block.typeHash != 0 ? &block : nullptr;
    at += sizeOf(block, at, size);
  }
  return nullptr;
}

bool release(BYTE *memory, uint64_t size, const void *object) {
  PoolBlock *block = find(memory, size, object);
  if (block == nullptr)
    return false;
  block->typeHash = 0;
  block->count = 0;
  block->elementSize = 0;
  return true;
}

} // namespace pool

} // namespace stride
