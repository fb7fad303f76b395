#include "runtime/script/script.hpp"

#include "runtime/app/trace_columns.hpp"
#include "runtime/task/task_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace stride::script {

size_t FixedForces::add(const app::Symbol &symbol) {
  for (size_t i = 0; i < forced_.size(); ++i)
    if (forced_[i]->symbol.path() == symbol.path())
      return i;
  forced_.push_back(std::make_unique<Forced>());
  forced_.back()->symbol = symbol;
  return forced_.size() - 1;
}

void FixedForces::set(size_t number, const std::vector<std::byte> &value) noexcept {
  forced_[number]->size = value.size();
  forced_[number]->value.store(value.data(), std::memory_order_release);
}

void FixedForces::release(size_t number) noexcept {
  forced_[number]->value.store(nullptr, std::memory_order_release);
}

void FixedForces::apply(std::byte *state) const noexcept {
  for (const std::unique_ptr<Forced> &forced : forced_)
    if (const std::byte *value = forced->value.load(std::memory_order_acquire))
      forced->symbol.write(state, value, forced->size);
}

Script Script::in(const app::SymbolTable &symbols) const { return Script(symbols, text_, file_); }

void Script::takeOver(Script &fresh) noexcept {
  // Both are of one text, so that everything has the same number in both.
  for (size_t i = 0; i < threads_.size(); ++i) {
    fresh.threads_[i].next = threads_[i].next;
    fresh.threads_[i].sinceNs = threads_[i].sinceNs;
    for (size_t j = 0; j < threads_[i].steps.size(); ++j) {
      const Step &step = threads_[i].steps[j];
      Step &same = fresh.threads_[i].steps[j];
      same.failedNs = step.failedNs;
      if (step.does == Does::Force && forces_->value(step.forced) == step.value.data())
        fresh.forces_->set(same.forced, same.value);
    }
  }
  threads_.swap(fresh.threads_);
  forces_->takeOver(*fresh.forces_);
}

bool Script::passes(const Thread &thread, const Step &step, int64_t timeNs,
                    std::byte *state) noexcept {
  switch (step.does) {
  case Does::WaitAt:
    return timeNs >= step.timeNs;
  case Does::WaitFor:
    return timeNs - thread.sinceNs >= step.timeNs;
  case Does::WaitUntil:
    return step.condition.holds(state);
  case Does::WaitUntilNot:
    return !step.condition.holds(state);
  case Does::Write:
  case Does::Force:
  case Does::Release:
  case Does::Stop:
  case Does::Start:
    return true;
  }
  return true;
}

void Script::act(Step &step, int64_t timeNs, std::byte *state) noexcept {
  if (step.does == Does::Write) {
    if (!step.symbol.write(state, step.value.data(), step.value.size()) && step.failedNs < 0)
      step.failedNs = timeNs;
  } else if (step.does == Does::Force) {
    forces_->set(step.forced, step.value);
  } else if (step.does == Does::Release) {
    forces_->release(step.forced);
  } else if ((step.does == Does::Stop || step.does == Does::Start) && tasks_ != nullptr) {
    tasks_->setMode(step.does == Does::Stop ? task::OperatingMode::Stop : task::OperatingMode::Run);
  }
}

void Script::step(int64_t timeNs, std::byte *state) noexcept {
  for (Thread &thread : threads_) {
    while (thread.next < thread.steps.size()) {
      Step &step = thread.steps[thread.next];
      if (step.does == Does::WaitFor && thread.sinceNs < 0)
        thread.sinceNs = timeNs;
      if (!passes(thread, step, timeNs, state))
        break;
      act(step, timeNs, state);
      thread.sinceNs = -1;
      ++thread.next;
      if (thread.repeats && thread.next == thread.steps.size()) {
        thread.next = 0;
        break; // at most one round at a time, whatever the script makes of its own condition
      }
    }
  }
}

int64_t Script::nextNs() const noexcept {
  int64_t next = std::numeric_limits<int64_t>::max();
  for (const Thread &thread : threads_) {
    if (thread.next == thread.steps.size())
      continue;
    const Step &step = thread.steps[thread.next];
    if (step.does == Does::WaitAt)
      next = std::min(next, step.timeNs);
    else if (step.does == Does::WaitFor && thread.sinceNs >= 0)
      next = std::min(next, thread.sinceNs + step.timeNs);
    else if (step.does != Does::WaitUntil && step.does != Does::WaitUntilNot)
      next = 0; // to be begun
  }
  return next;
}

std::vector<std::string> Script::remarks() const {
  std::vector<std::string> lines;
  const auto add = [&](const Position &at, const std::string &text) {
    lines.push_back(fmt::format("warning: {}:{}:{}: {}", file_, at.line, at.column, text));
  };
  for (const Thread &thread : threads_) {
    for (const Step &step : thread.steps) {
      if (step.failedNs < 0)
        continue;
      std::string seconds;
      app::appendSeconds(step.failedNs, seconds);
      add(step.at, fmt::format("'{}' was not written at {} s: a pointer on the way was null",
                               step.symbol.path(), seconds));
    }
    if (!thread.repeats && thread.next < thread.steps.size())
      add(thread.steps[thread.next].at, "the run ended while the script still waited here");
  }
  return lines;
}

} // namespace stride::script
