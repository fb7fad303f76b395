// What unit tests have shown, as text and as JUnit XML.
#ifndef STRIDE_RUNTIME_HOST_TEST_REPORT_HPP
#define STRIDE_RUNTIME_HOST_TEST_REPORT_HPP

#include <cstdint>
#include <string>
#include <vector>

namespace stride::host {

/// A demand that was not met, an exception, or a time that ran out.
struct TestFailure {
  std::string kind;     ///< ASSERT_EQ, `exception`, `timeout`
  std::string text;     ///< exception, timeout: what happened
  std::string expected; ///< of an assertion; may be empty
  std::string actual;
  std::string message; ///< the user's
  std::string file;    ///< empty: unknown
  uint32_t line = 0;
  uint32_t column = 0;
  uint64_t cycle = 0;
  int64_t timeNs = 0;
};

struct TestResult {
  std::string name;
  std::string file; ///< where the test is declared
  uint32_t line = 0;
  std::vector<TestFailure> failures;
  uint64_t omitted = 0; ///< failures beyond the most that are kept
  uint64_t cycles = 0;
  int64_t timeNs = 0; ///< virtual
  double seconds = 0; ///< real
};

/// The line that stands for `count` failures that are not shown.
std::string describeOmitted(uint64_t count);

/// A failure as indented lines, with the line of the source below `root`.
std::string describeFailure(const TestFailure &failure, const std::string &root);

/// The usual JUnit XML: one testsuite.
std::string junitXml(const std::string &suite, const std::vector<TestResult> &results);

} // namespace stride::host

#endif
