// Counts the calls of operator new in this test program; not with AddressSanitizer, which has its
// own.
#include <cstdlib>
#include <new>

namespace {
size_t count = 0;
}

namespace stride::test {
size_t allocations();
size_t allocations() { return count; }
} // namespace stride::test

#if !defined(__SANITIZE_ADDRESS__)
void *operator new(size_t size) {
  ++count;
  if (void *memory = std::malloc(size != 0 ? size : 1))
    return memory;
  throw std::bad_alloc();
}
void operator delete(void *memory) noexcept { std::free(memory); }
void operator delete(void *memory, size_t) noexcept { std::free(memory); }
#endif
