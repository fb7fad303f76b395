#ifndef STRIDE_COMPILER_CODEGEN_CPP_SCOPED_HPP
#define STRIDE_COMPILER_CODEGEN_CPP_SCOPED_HPP
// Modes that end with a scope.

#include <utility>

namespace stc::codegen {

/// Gives a variable another value until the scope ends.
template <class T> class Scoped {
public:
  Scoped(T &variable, T value) : variable_(variable), before_(std::move(variable)) {
    variable_ = std::move(value);
  }
  ~Scoped() { variable_ = std::move(before_); }
  Scoped(const Scoped &) = delete;
  Scoped &operator=(const Scoped &) = delete;

private:
  T &variable_;
  T before_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CPP_SCOPED_HPP
