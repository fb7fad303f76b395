#include "compiler/source/stack.hpp"

#include <pthread.h>

namespace stc {

const char *endOfStack() {
  pthread_attr_t attributes;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0)
    return nullptr;
  void *end = nullptr;
  size_t size = 0;
  const bool known = ::pthread_attr_getstack(&attributes, &end, &size) == 0;
  ::pthread_attr_destroy(&attributes);
  return known ? static_cast<const char *>(end) : nullptr;
}

} // namespace stc
