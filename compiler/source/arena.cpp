#include "compiler/source/arena.hpp"

#include <sys/mman.h>

namespace stc {

namespace {

constexpr size_t kSmallBlock = size_t{64} * 1024;
/// A page fault for each of these, where the system gives huge pages, instead of 512. What is
/// smaller than this together does without: a huge page is cleared as a whole.
constexpr size_t kHugePage = size_t{2} * 1024 * 1024;

} // namespace

void Arena::addBlock(size_t least) {
  const size_t unit = bytes_ < kHugePage ? kSmallBlock : kHugePage;
  const size_t size = (least + unit - 1) / unit * unit;
  blocks_.emplace_back(static_cast<std::byte *>(
      std::aligned_alloc(unit == kHugePage ? kHugePage : alignof(std::max_align_t), size)));
  if (blocks_.back() == nullptr)
    throw std::bad_alloc();
  if (unit == kHugePage) // only takes longer where it cannot be had
    static_cast<void>(::madvise(blocks_.back().get(), size, MADV_HUGEPAGE));
  bytes_ += size;
  cursor_ = blocks_.back().get();
  end_ = cursor_ + size;
}

} // namespace stc
