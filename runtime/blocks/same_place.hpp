// For headers that read a structure of ST as one of C++: that a member is at the same place in
// both, with the same size. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_BLOCKS_SAME_PLACE_HPP
#define STRIDE_RUNTIME_BLOCKS_SAME_PLACE_HPP

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): offsetof takes names
#define STRIDE_SAME_PLACE(own, member, declared, declaredMember)                                   \
  static_assert(__builtin_offsetof(own, member) == __builtin_offsetof(declared, declaredMember) && \
                sizeof(own::member) == sizeof(declared::declaredMember))

#endif // STRIDE_RUNTIME_BLOCKS_SAME_PLACE_HPP
