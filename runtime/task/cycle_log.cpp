#include "runtime/task/cycle_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace stride::task {

void CycleLog::put(const char *text) noexcept {
  for (Line &line : lines_) {
    uint32_t expected = kFree;
    if (!line.state.compare_exchange_strong(expected, kFilling, std::memory_order_acquire,
                                            std::memory_order_relaxed))
      continue;
    line.number = next_.fetch_add(1, std::memory_order_relaxed);
    const size_t length = ::strnlen(text, kLineSize - 1);
    std::memcpy(line.text, text, length);
    line.text[length] = 0;
    line.state.store(kFull, std::memory_order_release);
    return;
  }
  lost_.fetch_add(1, std::memory_order_relaxed);
}

std::vector<std::string> CycleLog::take() {
  std::vector<std::pair<uint64_t, std::string>> found;
  for (Line &line : lines_) {
    if (line.state.load(std::memory_order_acquire) != kFull)
      continue;
    found.emplace_back(line.number, line.text);
    line.state.store(kFree, std::memory_order_release);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> lines;
  for (auto &[number, text] : found)
    lines.push_back(std::move(text));
  if (const uint64_t lost = lost_.exchange(0, std::memory_order_relaxed); lost != 0)
    lines.push_back(fmt::format("warning: {} more lines of the program are not shown", lost));
  return lines;
}

} // namespace stride::task
