// A compiler without libraries.
#ifndef STRIDE_TESTS_SUPPORT_NO_LIBRARY_HPP
#define STRIDE_TESTS_SUPPORT_NO_LIBRARY_HPP

#include "compiler/semantics/program.hpp"

#include <string_view>
#include <vector>

namespace stc::test {

/// Knows no library and no name.
class NoLibrary final : public LibraryIndex {
public:
  std::vector<Entry> find(std::string_view) const override { return {}; }
  bool isLibrary(std::string_view) const override { return false; }
  bool answersTo(std::string_view, std::string_view) const override { return false; }
  std::vector<Name> names() const override { return {}; }
  std::vector<Entry> files(std::string_view) const override { return {}; }
};

} // namespace stc::test

#endif // STRIDE_TESTS_SUPPORT_NO_LIBRARY_HPP
