#include "runtime/app/low_memory.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace stride::app {

namespace {

constexpr size_t kPage = 4096;
constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;

/// Address space without access; null: it is taken.
std::byte *reserveAt(uint64_t address, size_t size) {
  void *wanted = std::bit_cast<void *>(address);
  void *got = ::mmap(wanted, size, PROT_NONE, kFlags | MAP_FIXED_NOREPLACE, -1, 0);
  if (got == MAP_FAILED)
    return nullptr;
  if (got != wanted) { // a kernel that does not know MAP_FIXED_NOREPLACE
    ::munmap(got, size);
    return nullptr;
  }
  return static_cast<std::byte *>(got);
}

} // namespace

LowMemory::LowMemory(size_t size, std::span<const uint64_t> addresses, const char *what)
    : size_(size), mapped_(std::max(kPage, (size + kPage - 1) / kPage * kPage)) {
  const size_t whole = mapped_ + 2 * kGuard;
  std::byte *begin = nullptr;
  for (const uint64_t address : addresses) {
    if (begin == nullptr && mapped_ < kFourGiB && address + mapped_ + kGuard <= kFourGiB)
      begin = reserveAt(address - kGuard, whole);
  }
  if (begin == nullptr) {
    void *anywhere = ::mmap(nullptr, whole, PROT_NONE, kFlags, -1, 0);
    begin = anywhere == MAP_FAILED ? nullptr : static_cast<std::byte *>(anywhere);
  }
  if (begin != nullptr && ::mprotect(begin + kGuard, mapped_, PROT_READ | PROT_WRITE) != 0) {
    ::munmap(begin, whole);
    begin = nullptr;
  }
  if (begin == nullptr)
    throw Error(fmt::format("the system has no {} bytes for {}", size, what));
  data_ = begin + kGuard;
}

LowMemory::LowMemory(LowMemory &&other) noexcept { *this = std::move(other); }

LowMemory &LowMemory::operator=(LowMemory &&other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

LowMemory::~LowMemory() {
  if (data_ != nullptr)
    ::munmap(data_ - kGuard, mapped_ + 2 * kGuard);
}

} // namespace stride::app
