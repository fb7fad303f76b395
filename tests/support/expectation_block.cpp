#include "tests/support/expectation_block.hpp"
#include "tests/support/text.hpp"

namespace stride::test {

namespace {

constexpr std::string_view kMarker = "//!";

// Where the line that ends just before `end` starts.
size_t lineStart(std::string_view text, size_t end) {
  if (end == 0)
    return 0;
  const size_t newline = text.rfind('\n', end - 1);
  return newline == std::string_view::npos ? 0 : newline + 1;
}

// The end of the line before position `at`, without its '\n' ("at" is a line's start).
size_t previousLineEnd(size_t at) { return at == 0 ? 0 : at - 1; }

} // namespace

GoldenText splitExpectation(std::string_view file) {
  std::string_view text = file;
  while (!text.empty() && text.back() == '\n')
    text.remove_suffix(1);
  size_t block = file.size(); // start of the block found so far
  size_t end = text.size();
  while (end > 0) {
    const size_t start = lineStart(text, end);
    if (!text.substr(start, end - start).starts_with(kMarker))
      break;
    block = start;
    end = previousLineEnd(start);
  }
  if (block == file.size())
    return {std::string(file), {}};

  GoldenText result;
  for (const std::string &line : splitLines(file.substr(block))) {
    std::string_view content = line;
    if (!content.starts_with(kMarker))
      break; // empty lines after the block
    content.remove_prefix(kMarker.size());
    if (content.starts_with(' '))
      content.remove_prefix(1);
    result.expected += std::string(content) + '\n';
  }
  if (block >= 1 && (block == 1 || file[block - 2] == '\n') && file[block - 1] == '\n')
    --block; // the empty line before the block
  result.source = file.substr(0, block);
  return result;
}

std::string joinExpectation(std::string_view source, std::string_view expected) {
  std::string file(source);
  if (!file.empty() && file.back() != '\n')
    file += '\n';
  const std::string text = canonical(expected);
  if (text.empty())
    return file;
  if (!file.empty())
    file += '\n';
  for (const std::string &line : splitLines(text)) {
    file += kMarker;
    file += line.empty() ? "" : " " + line;
    file += '\n';
  }
  return file;
}

std::string directive(std::string_view source, std::string_view name) {
  const std::string prefix = "// " + std::string(name) + ":";
  for (const std::string &line : splitLines(source)) {
    if (!line.starts_with("//"))
      break;
    if (!line.starts_with(prefix))
      continue;
    const size_t first = line.find_first_not_of(" \t", prefix.size());
    const size_t last = line.find_last_not_of(" \t\r");
    return first == std::string::npos ? "" : line.substr(first, last + 1 - first);
  }
  return {};
}

} // namespace stride::test
