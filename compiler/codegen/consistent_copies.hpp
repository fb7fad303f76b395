#ifndef STRIDE_COMPILER_CODEGEN_CONSISTENT_COPIES_HPP
#define STRIDE_COMPILER_CODEGEN_CONSISTENT_COPIES_HPP
// What app.cpp holds for variables with {attribute 'consistent'} (runtime/iec/consistent.h).

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

class ConsistentCopies {
public:
  ConsistentCopies(Context &context, size_t tasks) : c_(context), tasks_(tasks) {}

  [[nodiscard]] bool empty() const { return all().empty(); }
  /// Members of App__.
  [[nodiscard]] std::string members();
  /// Definitions of copiesPlace, in namespaces.
  [[nodiscard]] std::string places();
  /// Statements that come first in init__.
  [[nodiscard]] std::string begin();
  /// The function settle__.
  [[nodiscard]] std::string settle();
  /// Statements before what a task calls, and after it.
  [[nodiscard]] std::string take(size_t task);
  [[nodiscard]] std::string give(size_t task);

private:
  [[nodiscard]] const std::vector<ConsistentVariable> &all() const {
    return c_.program.sharing.consistent;
  }
  std::string member(const ConsistentVariable &v);
  std::string live(const ConsistentVariable &v);

  Context &c_;
  size_t tasks_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CONSISTENT_COPIES_HPP
