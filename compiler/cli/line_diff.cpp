#include "compiler/cli/line_diff.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace stc::cli {

namespace {

constexpr size_t kContext = 3;

std::vector<std::string_view> splitLines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size() - 1);
    lines.push_back(text.substr(0, end + 1));
    text.remove_prefix(end + 1);
  }
  return lines;
}

struct Edit {
  char kind; ///< ' ', '-', '+'
  std::string_view line;
};

/// The shortest way from one list of lines to the other, after E. Myers.
class Shortest {
public:
  Shortest(const std::vector<std::string_view> &a, const std::vector<std::string_view> &b)
      : a_(a), b_(b), n_(static_cast<long>(a.size())), m_(static_cast<long>(b.size())) {}

  std::vector<Edit> run() {
    std::vector<long> far(static_cast<size_t>(2 * (n_ + m_) + 3), 0);
    const long zero = n_ + m_ + 1;
    std::vector<std::vector<long>> steps;
    for (long d = 0;; ++d) {
      steps.emplace_back(far.begin() + (zero - d - 1), far.begin() + (zero + d + 2));
      for (long k = -d; k <= d; k += 2) {
        long &here = far[static_cast<size_t>(zero + k)];
        const long down = far[static_cast<size_t>(zero + k + 1)];
        const long right = far[static_cast<size_t>(zero + k - 1)] + 1;
        here = k == -d || (k != d && right - 1 < down) ? down : right;
        while (here < n_ && here - k < m_ && at(a_, here) == at(b_, here - k))
          ++here;
        if (here >= n_ && here - k >= m_)
          return back(steps, d);
      }
    }
  }

private:
  static std::string_view at(const std::vector<std::string_view> &lines, long i) {
    return lines[static_cast<size_t>(i)];
  }

  [[nodiscard]] std::vector<Edit> back(const std::vector<std::vector<long>> &steps, long d) const {
    std::vector<Edit> out;
    long x = n_;
    long y = m_;
    for (; d > 0; --d) {
      const std::vector<long> &far = steps[static_cast<size_t>(d)];
      const auto farAt = [&](long k) { return far[static_cast<size_t>(k + d + 1)]; };
      const long k = x - y;
      const bool down = k == -d || (k != d && farAt(k - 1) < farAt(k + 1));
      const long from = down ? k + 1 : k - 1;
      const long fromX = farAt(from);
      const long fromY = fromX - from;
      while (x > fromX + (down ? 0 : 1)) {
        out.push_back({' ', at(a_, --x)});
        --y;
      }
      if (down)
        out.push_back({'+', at(b_, --y)});
      else
        out.push_back({'-', at(a_, --x)});
      x = fromX;
      y = fromY;
    }
    while (x > 0)
      out.push_back({' ', at(a_, --x)});
    std::reverse(out.begin(), out.end());
    return out;
  }

  const std::vector<std::string_view> &a_;
  const std::vector<std::string_view> &b_;
  long n_;
  long m_;
};

} // namespace

std::string lineDiff(std::string_view before, std::string_view after, std::string_view name) {
  if (before == after)
    return {};
  const std::vector<std::string_view> a = splitLines(before);
  const std::vector<std::string_view> b = splitLines(after);
  const std::vector<Edit> edits = Shortest(a, b).run();
  std::string out = fmt::format("--- {}\n+++ {}, formatted\n", name, name);
  size_t oldLine = 1;
  size_t newLine = 1;
  for (size_t i = 0; i < edits.size();) {
    if (edits[i].kind == ' ') {
      ++oldLine;
      ++newLine;
      ++i;
      continue;
    }
    size_t end = i; // of the hunk
    for (size_t k = i; k < edits.size() && k <= end + 2 * kContext; ++k)
      if (edits[k].kind != ' ')
        end = k;
    const size_t begin = i - std::min(i, kContext);
    const size_t stop = std::min(edits.size(), end + kContext + 1);
    std::string body;
    size_t removed = 0;
    size_t added = 0;
    for (size_t k = begin; k < stop; ++k) {
      removed += edits[k].kind != '+';
      added += edits[k].kind != '-';
      body += edits[k].kind;
      body += edits[k].line;
      if (!body.ends_with('\n'))
        body += "\n\\ no line end\n";
    }
    out += fmt::format("@@ -{},{} +{},{} @@\n{}", oldLine - (i - begin), removed,
                       newLine - (i - begin), added, body);
    oldLine += removed - (i - begin);
    newLine += added - (i - begin);
    i = stop;
  }
  return out;
}

} // namespace stc::cli
