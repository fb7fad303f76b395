#ifndef STRIDE_COMPILER_CODEGEN_CPP_PART_HPP
#define STRIDE_COMPILER_CODEGEN_CPP_PART_HPP
// A callable that writes a part of the code.

#include <memory>
#include <type_traits>
#include <utility>

namespace stc::codegen {

/// What writes a part of something: called at most while the call lasts that it is passed to.
class Part {
public:
  template <class Write>
  requires(!std::is_same_v<std::remove_cvref_t<Write>, Part>)
      Part(Write &&write) // NOLINT: lambdas are passed as they are
      : object_(const_cast<void *>(static_cast<const void *>(std::addressof(write)))),
        call_([](void *object) { (*static_cast<std::remove_reference_t<Write> *>(object))(); }) {}

  void operator()() const { call_(object_); }

private:
  void *object_;
  void (*call_)(void *);
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CPP_PART_HPP
