#include "compiler/source/workers.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

namespace stc {

namespace {

constexpr unsigned kMostJobs = 256;

/// What the threads of one list share.
class Queue {
public:
  Queue(size_t items, const std::function<void(size_t, unsigned)> &work)
      : items_(items), work_(work) {}

  void run(unsigned thread) {
    for (size_t item = next_++; item < items_; item = next_++) {
      try {
        work_(item, thread);
      } catch (...) {
        next_ = items_;
        keep(item);
      }
    }
  }
  void rethrow() const {
    if (thrown_)
      std::rethrow_exception(thrown_);
  }

private:
  void keep(size_t item) {
    const std::lock_guard lock(mutex_);
    if (thrown_ && thrownBy_ < item)
      return;
    thrown_ = std::current_exception();
    thrownBy_ = item;
  }

  size_t items_;
  const std::function<void(size_t, unsigned)> &work_;
  std::atomic<size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr thrown_;
  size_t thrownBy_ = 0;
};

} // namespace

unsigned defaultJobs() {
  if (const char *value = std::getenv("STRIDE_JOBS"); value != nullptr) {
    const std::string_view text(value);
    unsigned jobs = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), jobs);
    if (error == std::errc() && end == text.data() + text.size() && jobs > 0)
      return std::min(jobs, kMostJobs);
  }
  return std::clamp(std::thread::hardware_concurrency(), 1U, kMostJobs);
}

unsigned Workers::threadsFor(size_t items, size_t bytes) const {
  return bytes < least_ ? 1 : static_cast<unsigned>(std::clamp<size_t>(items, 1, most_));
}

void Workers::each(size_t items, unsigned threads,
                   const std::function<void(size_t, unsigned)> &work) {
  Queue queue(items, work);
  std::vector<std::jthread> others;
  for (unsigned thread = 1; thread < threads; ++thread) {
    try {
      others.emplace_back([&queue, thread] { queue.run(thread); });
    } catch (const std::system_error &) {
      break; // there are no more: the others do its work
    }
  }
  queue.run(0);
  others.clear(); // waits for them
  queue.rethrow();
}

} // namespace stc
