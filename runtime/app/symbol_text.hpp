// The tables of an application's types, members, enumerators and roots, made of lines of text.
#ifndef STRIDE_RUNTIME_APP_SYMBOL_TEXT_HPP
#define STRIDE_RUNTIME_APP_SYMBOL_TEXT_HPP

#include "runtime/app/abi.h"

#include <vector>

namespace stride::app {

/// A description with all tables. Those that SymbolLines stand for are made and held here; the rest
/// is where the description has it. Copies would point to the tables of the first one.
class DescribedApplication {
public:
  /// `given` is of this ABI version. Throws Error when its lines are not as SymbolLines says; what
  /// they say is for validate().
  explicit DescribedApplication(const StrideAppV1 &given);
  DescribedApplication(const DescribedApplication &) = delete;
  DescribedApplication &operator=(const DescribedApplication &) = delete;

  const StrideAppV1 &description() const { return description_; }

private:
  StrideAppV1 description_;
  std::vector<char> text_; // names end with 0
  std::vector<TypeDesc> types_;
  std::vector<MemberDesc> members_;
  std::vector<EnumeratorDesc> enumerators_;
  std::vector<RootDesc> roots_;

  class Reader;
};

} // namespace stride::app

#endif
