#include "runtime/host/test_report.hpp"

#include "runtime/common/text.hpp"
#include "runtime/iec/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace stride::host {

namespace {

/// T#1s500ms
std::string timeLiteral(int64_t ns) {
  char text[stride::text::kBufferSize];
  stride::text::formatLtime(text, ns);
  return std::string("T") + std::strchr(text, '#');
}

std::string sourceLine(const std::filesystem::path &path, uint32_t number) {
  std::ifstream in(path);
  std::string line;
  for (uint32_t i = 0; i < number; ++i)
    if (!std::getline(in, line))
      return {};
  while (!line.empty() && (line.back() == '\r' || line.back() == ' '))
    line.pop_back();
  return line;
}

/// One line: what was expected, or what happened.
std::string headline(const TestFailure &failure) {
  std::string text = failure.text;
  if (!failure.expected.empty())
    text = fmt::format("expected {}, is {}", failure.expected, failure.actual);
  if (!failure.message.empty())
    text += (text.empty() ? "" : ": ") + failure.message;
  return text.empty() ? failure.kind + " failed" : text;
}

/// For an attribute, in which a line's end would become a blank.
std::string escaped(std::string_view text) {
  std::string out = common::escapedMarkup(text);
  for (size_t i = 0; (i = out.find('\n', i)) != std::string::npos;)
    out.replace(i, 1, "&#10;");
  return out;
}

} // namespace

std::string describeFailure(const TestFailure &failure, const std::string &root) {
  const std::string when = fmt::format("cycle {}, {}", failure.cycle, timeLiteral(failure.timeNs));
  if (!failure.text.empty()) { // says itself where it was
    std::string out = "  ";
    for (const char c : failure.text)
      out += c == '\n' ? std::string("\n  ") : std::string(1, c);
    return out + "\n";
  }
  std::string out = fmt::format("  {} failed at {}:{}:{} ({})\n", failure.kind, failure.file,
                                failure.line, failure.column, when);
  const std::string line = sourceLine(std::filesystem::path(root) / failure.file, failure.line);
  const std::string number = std::to_string(failure.line);
  if (!line.empty())
    out += fmt::format("    {} | {}\n", number, line);
  const std::string margin(number.size() + 4, ' ');
  if (!failure.expected.empty())
    out += fmt::format("{} = expected {}\n{} =       is {}\n", margin, failure.expected, margin,
                       failure.actual);
  if (!failure.message.empty())
    out += fmt::format("{} = {}\n", margin, failure.message);
  return out;
}

std::string describeOmitted(uint64_t count) {
  return fmt::format("… and {} more failure{}", count, count == 1 ? "" : "s");
}

std::string junitXml(const std::string &suite, const std::vector<TestResult> &results) {
  double seconds = 0;
  size_t failures = 0;
  size_t errors = 0;
  std::string cases;
  for (const TestResult &result : results) {
    seconds += result.seconds;
    cases += fmt::format(
        "    <testcase name=\"{}\" classname=\"{}\" file=\"{}\" line=\"{}\" time=\"{:.6f}\"",
        escaped(result.name), escaped(suite), escaped(result.file), result.line, result.seconds);
    if (result.failures.empty()) {
      cases += "/>\n";
      continue;
    }
    const bool error = result.failures.back().kind == "exception";
    ++(error ? errors : failures);
    const TestFailure &shown = error ? result.failures.back() : result.failures.front();
    cases += fmt::format(">\n      <{} message=\"{}\" type=\"{}\">", error ? "error" : "failure",
                         escaped(headline(shown)), escaped(shown.kind));
    for (const TestFailure &failure : result.failures)
      cases += failure.file.empty()
                   ? escaped(headline(failure)) + "&#10;"
                   : fmt::format("{}:{}:{}: {}: {}&#10;", escaped(failure.file), failure.line,
                                 failure.column, escaped(failure.kind), escaped(headline(failure)));
    if (result.omitted != 0)
      cases += describeOmitted(result.omitted) + "&#10;";
    cases += fmt::format("</{}>\n    </testcase>\n", error ? "error" : "failure");
  }
  const std::string counts =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\" time=\"{:.6f}\"",
                  results.size(), failures, errors, seconds);
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {}>\n"
                     "  <testsuite name=\"{}\" {}>\n{}  </testsuite>\n</testsuites>\n",
                     counts, escaped(suite), counts, cases);
}

} // namespace stride::host
