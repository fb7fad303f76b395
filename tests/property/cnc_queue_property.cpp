// Queues of path objects against a model: two lists, of what is in the queue and of what has been
// removed of this path, and what the places of the memory hold.
#include "runtime/numeric/cnc/queue.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <deque>
#include <vector>

namespace {

using namespace stride::cnc;

enum class Step : uint8_t { Append, RemoveFirst, RemoveAny, Replace, Restore, End, Open, Clear };

class QueueWithModel {
public:
  QueueWithModel(size_t places, size_t shift, size_t rest, uint32_t reserved)
      : places_(places), held_(places), memory_((places + 1) * sizeof(PathObject) + 16) {
    queue_.structId = 0x9878;
    auto address = reinterpret_cast<uintptr_t>(memory_.data());
    const size_t padding = (8 - address % 8) % 8 + 8;
    queue_.buffer = memory_.data() + padding - shift;
    queue_.size = static_cast<uint32_t>(shift + places * sizeof(PathObject) + rest);
    queue_.reserved = reserved;
    free_ = reserved > 3 ? reserved : 3;
    if (free_ > places - 1)
      free_ = places - 1;
  }

  void apply(Step step, size_t n) {
    PathObject object{};
    object.number = ++number_;
    switch (step) {
    case Step::Append:
      append(object);
      break;
    case Step::RemoveFirst:
      remove(0);
      break;
    case Step::RemoveAny:
      remove(n);
      break;
    case Step::Replace:
      RC_ASSERT(replaceAt(&queue_, static_cast<uint32_t>(n), &object) == (n < live_.size()));
      if (n < live_.size())
        live_[n] = held_[(first_ + n) % places_] = number_;
      break;
    case Step::Restore:
      putBack();
      break;
    case Step::End:
    case Step::Open:
      queue_.endOfList = step == Step::End;
      break;
    case Step::Clear:
      RC_ASSERT(clear(&queue_));
      live_.clear();
      gone_.clear();
      first_ = 0;
      ended_ = false;
      break;
    }
    compare();
  }

private:
  void append(const PathObject &object) {
    const bool fits = live_.size() + 1 < places_;
    const PathObject *at = ::stride::cnc::append(&queue_, &object);
    RC_ASSERT((at != nullptr) == fits);
    if (!fits)
      return;
    RC_ASSERT(at->number == object.number);
    if (ended_)
      gone_.clear();
    ended_ = false;
    held_[(first_ + live_.size()) % places_] = object.number;
    live_.push_back(object.number);
  }

  void remove(size_t n) {
    RC_ASSERT(removeAt(&queue_, static_cast<uint32_t>(n)) == (n < live_.size()));
    if (n >= live_.size())
      return;
    live_.erase(live_.begin() + static_cast<int>(n));
    if (n == 0) {
      gone_.push_back(held_[first_]);
      first_ = (first_ + 1) % places_;
    }
    for (size_t i = 0; i < live_.size(); ++i)
      held_[(first_ + i) % places_] = live_[i];
    ended_ = ended_ || (live_.empty() && queue_.endOfList != 0);
  }

  void putBack() {
    const bool possible = untouched() == gone_.size();
    RC_ASSERT(restore(&queue_) == possible);
    if (!possible)
      return;
    live_.insert(live_.begin(), gone_.begin(), gone_.end());
    first_ = (first_ + places_ - gone_.size()) % places_;
    gone_.clear();
    ended_ = false;
  }

  /// How many places before the first object still hold what was there. The place that comes next
  /// does not count.
  [[nodiscard]] size_t untouched() const {
    size_t count = 0;
    while (count < gone_.size() && count + live_.size() + 1 < places_ &&
           held_[(first_ + places_ - 1 - count) % places_] == gone_[gone_.size() - 1 - count])
      ++count;
    return count;
  }

  [[nodiscard]] bool isFullNow() const { return places_ - live_.size() <= free_; }

  void compare() const {
    RC_ASSERT(checkQueue(&queue_) == QueueError::None);
    RC_ASSERT(capacityOf(&queue_) == places_ - 1);
    RC_ASSERT(countOf(&queue_) == live_.size());
    RC_ASSERT(isFull(&queue_) == isFullNow());
    for (size_t i = 0; i < live_.size(); ++i) {
      const auto n = static_cast<uint32_t>(i);
      RC_ASSERT(objectAt(&queue_, n)->number == live_[i]);
      RC_ASSERT(objectFromEnd(&queue_, n)->number == live_[live_.size() - 1 - i]);
    }
    RC_ASSERT(objectAt(&queue_, static_cast<uint32_t>(live_.size())) == nullptr);
    RC_ASSERT(objectFromEnd(&queue_, static_cast<uint32_t>(live_.size())) == nullptr);
    const size_t history = untouched();
    RC_ASSERT(historyOf(&queue_) == history);
    for (size_t i = 0; i < history; ++i)
      RC_ASSERT(objectOfHistory(&queue_, static_cast<uint32_t>(i))->number ==
                gone_[gone_.size() - 1 - i]);
    RC_ASSERT(objectOfHistory(&queue_, static_cast<uint32_t>(history)) == nullptr);
  }

  size_t places_;
  std::vector<int32_t> held_; ///< By places.
  size_t first_ = 0;          ///< The place of the first object.
  std::vector<uint8_t> memory_;
  Queue queue_{};
  size_t free_ = 0; ///< How many places a full queue has free.
  std::deque<int32_t> live_;
  std::deque<int32_t> gone_; ///< The oldest first.
  bool ended_ = false;       ///< The next object begins a path.
  int32_t number_ = 0;
};

RC_GTEST_PROP(CncQueue, DoesWhatTwoListsDo, ()) {
  QueueWithModel queue(*rc::gen::inRange<size_t>(2, 12), *rc::gen::inRange<size_t>(0, 8),
                       *rc::gen::inRange<size_t>(0, sizeof(PathObject)),
                       *rc::gen::inRange<uint32_t>(0, 14));
  const auto steps =
      *rc::gen::resize(300, rc::gen::container<std::vector<std::pair<Step, size_t>>>(rc::gen::pair(
                                rc::gen::weightedElement<Step>({{12, Step::Append},
                                                                {9, Step::RemoveFirst},
                                                                {1, Step::RemoveAny},
                                                                {1, Step::Replace},
                                                                {1, Step::Restore},
                                                                {1, Step::End},
                                                                {1, Step::Open},
                                                                {1, Step::Clear}}),
                                rc::gen::inRange<size_t>(0, 12))));
  for (const auto &[step, n] : steps)
    queue.apply(step, n);
}

} // namespace
