#ifndef STRIDE_COMPILER_PROJECT_TESTS_HPP
#define STRIDE_COMPILER_PROJECT_TESTS_HPP
// Unit tests in ST: function blocks with {attribute 'test'}.

#include "compiler/project/config.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stc {

/// A FUNCTION_BLOCK with {attribute 'test'}.
struct TestBlock {
  std::string name;      ///< with its namespaces
  Span place;            ///< of its name
  int64_t cycleNs = 0;   ///< {attribute 'test_cycle' := 'T#1ms'}; 0: not given
  int64_t timeoutNs = 0; ///< {attribute 'test_timeout' := 'T#10s'}
};

/// The tests among the declarations, in their order; wrong attributes are reported.
[[nodiscard]] std::vector<TestBlock> findTests(const std::vector<ast::File *> &files,
                                               Diagnostics &diagnostics);

/// Takes the tests out of the declarations.
void removeTests(const std::vector<ast::File *> &files, Arena &arena);

/// Name of the PROGRAM that runs the tests, and of its variable that says which one.
inline constexpr const char *kTestProgram = "Test__Run";

/// That PROGRAM, which has an instance of every test and calls one.
[[nodiscard]] SyntheticSource testProgram(const std::vector<TestBlock> &tests);

/// Replaces the tasks by one that calls the PROGRAM, and serves all axis groups.
void configureTests(ProjectConfig &config);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_TESTS_HPP
