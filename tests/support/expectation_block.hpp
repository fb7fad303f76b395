// Golden files carry what is expected of them: the lines starting with `//!` at their end.
#ifndef STRIDE_TESTS_SUPPORT_EXPECTATION_BLOCK_HPP
#define STRIDE_TESTS_SUPPORT_EXPECTATION_BLOCK_HPP

#include <string>
#include <string_view>

namespace stride::test {

/// A golden file's two parts.
struct GoldenText {
  std::string source;   ///< what is given to the compiler
  std::string expected; ///< the expected output; every line ends in '\n'
};

/// Separates the trailing `//!` block, and the empty line before it, from the source. The source
/// does not contain the block, so that positions at the end of the file do not depend on it.
GoldenText splitExpectation(std::string_view file);

/// The file with this expectation: the inverse of splitExpectation.
std::string joinExpectation(std::string_view source, std::string_view expected);

/// The value of a `// NAME: value` line among the comment lines at the top of a source; empty if
/// there is none.
std::string directive(std::string_view source, std::string_view name);

} // namespace stride::test

#endif // STRIDE_TESTS_SUPPORT_EXPECTATION_BLOCK_HPP
