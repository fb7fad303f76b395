// Pasted at the top of every mutated copy: which mutant is active. STRIDE_MUTANT is its number;
// STRIDE_MUTATION_REACHED names a file with a byte for each mutant, which becomes 1 when control
// reaches the function that it is in.
#ifndef STRIDE_TESTS_MUTATION_MUTATION_H
#define STRIDE_TESTS_MUTATION_MUTATION_H

namespace stride_mutation {

// Generated code includes this, too: no header of the system, and no name that one of them
// declares.
extern "C" char *stride_mutation_getenv(const char *) __asm__("getenv");
extern "C" int stride_mutation_open(const char *, int, ...) __asm__("open");
extern "C" int stride_mutation_close(int) __asm__("close");
extern "C" void *stride_mutation_mmap(void *, unsigned long, int, int, int, long) __asm__("mmap");

inline constexpr unsigned long kMost = 4096;

inline int chosen() noexcept {
  int number = 0;
  for (const char *c = stride_mutation_getenv("STRIDE_MUTANT"); c != nullptr && *c != 0; ++c)
    number = 10 * number + (*c - '0');
  return number;
}
inline unsigned char *openReached() noexcept {
  const char *const path = stride_mutation_getenv("STRIDE_MUTATION_REACHED");
  const int file = path != nullptr ? stride_mutation_open(path, 2) : -1; // O_RDWR
  if (file < 0)
    return nullptr;
  void *const bytes = stride_mutation_mmap(nullptr, kMost, 3, 1, file, 0); // read and write, shared
  stride_mutation_close(file);
  return bytes == reinterpret_cast<void *>(-1) ? nullptr : static_cast<unsigned char *>(bytes);
}

inline const int active = chosen();
inline unsigned char *const reached = openReached();

constexpr bool on(int number) noexcept {
  if (__builtin_is_constant_evaluated())
    return false;
  if (reached != nullptr)
    reached[number] = 1;
  return active == number;
}

} // namespace stride_mutation

#endif
