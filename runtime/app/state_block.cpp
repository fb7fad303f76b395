#include "runtime/app/state_block.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <sys/mman.h>

#include <bit>
#include <utility>

namespace stride::app {

namespace {

constexpr std::size_t kPage = 4096;
constexpr uint64_t kFourGiB = uint64_t{1} << 32;
constexpr uint64_t kFirstBase = uint64_t{1} << 29;

void *mapAt(uint64_t base, std::size_t size) {
  void *wanted = std::bit_cast<void *>(base);
  void *got = ::mmap(wanted, size, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
  if (got == MAP_FAILED)
    return nullptr;
  if (got != wanted) { // a kernel that does not know MAP_FIXED_NOREPLACE
    ::munmap(got, size);
    return nullptr;
  }
  return got;
}

} // namespace

StateBlock::StateBlock(std::size_t size) : size_(size) {
  mapped_ = (size + kPage - 1) / kPage * kPage;
  if (mapped_ == 0)
    mapped_ = kPage;
  void *memory = nullptr;
  for (uint64_t base = kFirstBase; memory == nullptr && base + mapped_ <= kFourGiB;
       base += kFirstBase)
    memory = mapAt(base, mapped_);
  if (memory == nullptr) {
    memory = ::mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
      throw Error(fmt::format("the system has no {} bytes for the application's state", size));
  }
  data_ = static_cast<std::byte *>(memory);
}

StateBlock::StateBlock(StateBlock &&other) noexcept { *this = std::move(other); }

StateBlock &StateBlock::operator=(StateBlock &&other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

StateBlock::~StateBlock() {
  if (data_ != nullptr)
    ::munmap(data_, mapped_);
}

bool StateBlock::belowFourGiB() const { return std::bit_cast<uint64_t>(data_) + size_ <= kFourGiB; }

} // namespace stride::app
