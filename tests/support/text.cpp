#include "tests/support/text.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace stride::test {

namespace fs = std::filesystem;

std::string readFile(const fs::path &path) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void writeFile(const fs::path &path, std::string_view content) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out)
    throw std::runtime_error("cannot write " + path.string());
}

std::vector<std::string> splitLines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    lines.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos)
      break;
    text.remove_prefix(end + 1);
  }
  return lines;
}

std::vector<std::string> splitWords(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  bool inWord = false;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '\'' || c == '"') {
      quote = c;
      inWord = true;
    } else if (c == ' ' || c == '\t' || c == '\r') {
      if (inWord)
        words.push_back(std::exchange(word, {}));
      inWord = false;
    } else {
      word += c;
      inWord = true;
    }
  }
  if (inWord)
    words.push_back(word);
  return words;
}

std::string replaceAll(std::string text, std::string_view from, std::string_view to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

static std::vector<std::string> canonicalLines(std::string_view text) {
  std::vector<std::string> lines = splitLines(text);
  for (std::string &line : lines)
    line.erase(line.find_last_not_of(" \t\r") + 1);
  while (!lines.empty() && lines.back().empty())
    lines.pop_back();
  return lines;
}

std::string canonical(std::string_view text) {
  std::string result;
  for (const std::string &line : canonicalLines(text))
    result += line + '\n';
  return result;
}

namespace {

struct DiffLine {
  char mark;
  std::string_view text;
};

using Lines = std::vector<std::string>;

// The lines between the common start and end, by longest common subsequence; large texts are simply
// shown as removed and added.
void diffMiddle(const Lines &a, const Lines &b, size_t begin, size_t endA, size_t endB,
                std::vector<DiffLine> &out) {
  const size_t n = endA - begin;
  const size_t m = endB - begin;
  constexpr size_t kLargest = 4'000'000;
  size_t i = 0;
  size_t j = 0;
  if (n * m <= kLargest) {
    std::vector<unsigned> length((n + 1) * (m + 1), 0);
    const auto at = [&](size_t x, size_t y) -> unsigned & { return length[x * (m + 1) + y]; };
    for (size_t x = n; x-- > 0;)
      for (size_t y = m; y-- > 0;)
        at(x, y) = a[begin + x] == b[begin + y] ? at(x + 1, y + 1) + 1
                                                : std::max(at(x + 1, y), at(x, y + 1));
    while (i < n && j < m) {
      if (a[begin + i] == b[begin + j]) {
        out.push_back({' ', a[begin + i]});
        ++i;
        ++j;
      } else if (at(i + 1, j) >= at(i, j + 1)) {
        out.push_back({'-', a[begin + i++]});
      } else {
        out.push_back({'+', b[begin + j++]});
      }
    }
  }
  while (i < n)
    out.push_back({'-', a[begin + i++]});
  while (j < m)
    out.push_back({'+', b[begin + j++]});
}

} // namespace

std::string diff(std::string_view expected, std::string_view actual) {
  const Lines a = canonicalLines(expected);
  const Lines b = canonicalLines(actual);
  if (a == b)
    return {};
  size_t begin = 0;
  while (begin < a.size() && begin < b.size() && a[begin] == b[begin])
    ++begin;
  size_t tail = 0;
  while (tail < a.size() - begin && tail < b.size() - begin &&
         a[a.size() - 1 - tail] == b[b.size() - 1 - tail])
    ++tail;

  std::vector<DiffLine> lines;
  for (size_t i = 0; i < begin; ++i)
    lines.push_back({' ', a[i]});
  diffMiddle(a, b, begin, a.size() - tail, b.size() - tail, lines);
  for (size_t i = a.size() - tail; i < a.size(); ++i)
    lines.push_back({' ', a[i]});

  constexpr size_t kContext = 3;
  std::string result;
  bool gap = false;
  for (size_t i = 0; i < lines.size(); ++i) {
    const size_t from = i >= kContext ? i - kContext : 0;
    const size_t to = std::min(lines.size(), i + kContext + 1);
    bool near = false;
    for (size_t k = from; k < to; ++k)
      near = near || lines[k].mark != ' ';
    if (near) {
      result += lines[i].mark;
      result += ' ';
      result += lines[i].text;
      result += '\n';
    } else if (!gap) {
      result += "  ...\n";
    }
    gap = !near;
  }
  return result;
}

ScratchDirectory::ScratchDirectory() {
  std::string name = (fs::temp_directory_path() / "stride-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error("cannot create a temporary directory");
  path_ = name;
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

} // namespace stride::test
