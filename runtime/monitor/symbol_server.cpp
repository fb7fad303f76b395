#include "runtime/monitor/symbol_server.hpp"

#include "runtime/app/condition.hpp"
#include "runtime/app/error.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/app/value_text.hpp"
#include "runtime/common/text.hpp"
#include "runtime/monitor/symbol_channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace stride::monitor {

SymbolServer::SymbolServer(task::TaskSet &tasks)
    : symbols_(std::make_unique<app::SymbolTable>(tasks.app())), tasks_(&tasks) {
  for (uint32_t i = 0; i < tasks.count(); ++i)
    channels_.push_back(std::make_unique<SymbolChannel>());
}

SymbolServer::~SymbolServer() { close(); }

void SymbolServer::addOuterHooks() {
  for (uint32_t i = 0; i < tasks_->count(); ++i)
    tasks_->addHook(i, channels_[i]->outer());
}

void SymbolServer::addInnerHooks() {
  for (uint32_t i = 0; i < tasks_->count(); ++i)
    tasks_->addHook(i, channels_[i]->inner());
}

void SymbolServer::setWriteLog(WriteLog &log) {
  for (const std::unique_ptr<SymbolChannel> &channel : channels_)
    channel->log = &log;
}

bool SymbolServer::periodic(uint32_t task) const {
  const TaskKind kind = tasks_->desc(task).kind;
  return kind == TaskKind::Cyclic || kind == TaskKind::Freewheeling;
}

uint32_t SymbolServer::taskOf(const app::Symbol &symbol) const {
  const uint32_t owner = symbol.task();
  return owner < tasks_->count() && periodic(owner) ? owner : tasks_->fastest();
}

/// Sorted into parts by task: the values of one task lie together.
std::shared_ptr<SymbolRequest> SymbolServer::newRequest(std::vector<app::Symbol> symbols) {
  if (symbols.empty())
    throw app::Error("no variable is named");
  if (symbols.size() > kValuesPerRequest)
    throw app::Error(fmt::format("{} values at once are too many; the limit is {}", symbols.size(),
                                 kValuesPerRequest));
  auto request = std::make_shared<SymbolRequest>();
  request->build_ = build_;
  size_t size = 0;
  for (app::Symbol &symbol : symbols) {
    const size_t bytes = symbols_->type(symbol).size;
    request->values_.push_back({std::move(symbol), size, bytes, false});
    size += bytes;
  }
  if (size > kBytesPerRequest)
    throw app::Error(
        fmt::format("{} bytes at once are too many; the limit is {}", size, kBytesPerRequest));
  request->memory_.resize(size);
  std::vector<uint32_t> tasks;
  for (const SymbolRequest::Value &value : request->values_) {
    request->order_.push_back(tasks.size());
    tasks.push_back(taskOf(value.symbol));
  }
  std::stable_sort(request->order_.begin(), request->order_.end(),
                   [&](size_t a, size_t b) { return tasks[a] < tasks[b]; });
  for (size_t i = 0; i < request->order_.size(); ++i) {
    const size_t number = request->order_[i];
    const uint32_t task = tasks[number];
    if (request->parts_.empty() || request->parts_.back().task != task)
      request->parts_.push_back({request.get(), task, i, i, 0});
    SymbolRequest::Part &part = request->parts_.back();
    part.last = i + 1;
    part.bytes += request->values_[number].size;
  }
  return request;
}

void SymbolServer::submit(const std::shared_ptr<SymbolRequest> &request) {
  if (closed_)
    throw app::Error("the application does not run any more");
  collect();
  // All parts or none: there is one for each task, and only this thread puts parts in.
  for (const SymbolRequest::Part &part : request->parts_) {
    if (!channels_[part.task]->hasRoom())
      throw app::Error(fmt::format("{} requests wait for task '{}'; it does not run, or not often "
                                   "enough",
                                   kMostWaiting, tasks_->desc(part.task).name));
  }
  request->open_.store(request->parts_.size(), std::memory_order_release);
  waiting_.push_back(request);
  for (SymbolRequest::Part &part : request->parts_)
    channels_[part.task]->push(part);
}

void SymbolServer::collect() {
  std::erase_if(waiting_, [](const auto &request) { return request->done(); });
}

std::shared_ptr<SymbolRequest> SymbolServer::read(const std::vector<std::string> &names) {
  const std::lock_guard lock(mutex_);
  std::vector<app::Symbol> wanted;
  for (const std::string &name : names) {
    const app::Symbol symbol = symbols_->resolve(name);
    const TypeDesc &type = symbols_->type(symbol);
    if (type.size > kBytesPerRequest)
      throw app::Error(fmt::format("symbol '{}': {} bytes at once are too many; name parts of it",
                                   name, type.size));
    std::vector<app::Symbol> leaves = symbols_->leaves(symbol);
    if (leaves.empty())
      throw app::Error(fmt::format("symbol '{}': it is {} and has no value", name, type.name));
    std::move(leaves.begin(), leaves.end(), std::back_inserter(wanted));
  }
  std::shared_ptr<SymbolRequest> request = newRequest(std::move(wanted));
  submit(request);
  return request;
}

std::shared_ptr<SymbolRequest> SymbolServer::write(const std::vector<NamedValue> &values) {
  const std::lock_guard lock(mutex_);
  std::vector<app::Symbol> wanted;
  std::vector<std::byte> bytes;
  for (const auto &[name, literal] : values) {
    wanted.push_back(app::resolveWritable(*symbols_, name));
    const std::vector<std::byte> value = app::literalBytes(*symbols_, wanted.back(), literal);
    bytes.insert(bytes.end(), value.begin(), value.end());
  }
  std::shared_ptr<SymbolRequest> request = newRequest(std::move(wanted));
  request->writes_ = true;
  request->memory_ = std::move(bytes);
  submit(request);
  return request;
}

void SymbolServer::again(const std::shared_ptr<SymbolRequest> &request) {
  const std::lock_guard lock(mutex_);
  if (!request->done() || request->dropped() || request->build_ != build_)
    throw app::Error("the request belongs to another build of the application");
  submit(request);
}

bool SymbolServer::wait(const SymbolRequest &request, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!request.done() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  return request.done() && !request.dropped();
}

bool SymbolServer::valid(const SymbolRequest &request) const {
  const std::lock_guard lock(mutex_);
  return request.done() && !request.dropped() && request.build_ == build_;
}

void SymbolServer::force(const std::vector<NamedValue> &values) {
  const std::lock_guard lock(mutex_);
  std::vector<Forced> next = forced_;
  for (const auto &[name, literal] : values) {
    app::Symbol symbol = app::resolveWritable(*symbols_, name);
    std::vector<std::byte> value = app::literalBytes(*symbols_, symbol, literal);
    const std::string key = common::lowerCase(name);
    const auto found = std::find_if(next.begin(), next.end(), [&](const Forced &forced) {
      return common::lowerCase(forced.symbol.path()) == key;
    });
    if (found != next.end())
      found->value = std::move(value);
    else
      next.push_back({std::move(symbol), std::move(value)});
  }
  if (next.size() > kMostForces)
    throw app::Error(
        fmt::format("{} forced variables are too many; the limit is {}", next.size(), kMostForces));
  forced_ = std::move(next);
  publishForces();
}

void SymbolServer::release(const std::vector<std::string> &names) {
  const std::lock_guard lock(mutex_);
  std::vector<Forced> next = forced_;
  for (const std::string &name : names) {
    const std::string key = common::lowerCase(name);
    const auto found = std::find_if(next.begin(), next.end(), [&](const Forced &forced) {
      return common::lowerCase(forced.symbol.path()) == key;
    });
    if (found == next.end())
      throw app::Error(fmt::format("'{}' is not forced", name));
    next.erase(found);
  }
  forced_ = std::move(next);
  publishForces();
}

void SymbolServer::releaseAll() {
  const std::lock_guard lock(mutex_);
  forced_.clear();
  publishForces();
}

void SymbolServer::publishForces() {
  for (const std::unique_ptr<SymbolChannel> &channel : channels_)
    channel->forces.publish(
        std::make_unique<SymbolChannel::ForceList>(SymbolChannel::ForceList{forced_}));
}

std::vector<NamedValue> SymbolServer::forced() const {
  const std::lock_guard lock(mutex_);
  std::vector<NamedValue> list;
  for (const Forced &forced : forced_)
    list.emplace_back(
        forced.symbol.path(),
        app::formatLiteral(symbols_->app(), symbols_->type(forced.symbol), forced.value.data()));
  return list;
}

bool SymbolServer::forcesTaken() const {
  const std::lock_guard lock(mutex_);
  for (uint32_t i = 0; i < channels_.size(); ++i)
    if (periodic(i) && !channels_[i]->forces.taken())
      return false;
  return true;
}

void SymbolServer::setRecorder(std::shared_ptr<Recorder> recorder) {
  const std::lock_guard lock(mutex_);
  if (closed_)
    throw app::Error("the application does not run any more");
  if (recorder_)
    recorder_->stop();
  recorder_ = std::move(recorder);
  channels_[tasks_->fastest()]->recorder.publish(
      std::make_unique<SymbolChannel::RecorderSlot>(SymbolChannel::RecorderSlot{recorder_}));
}

std::shared_ptr<Recorder> SymbolServer::recorder() const {
  const std::lock_guard lock(mutex_);
  return recorder_;
}

void SymbolServer::dropAll() {
  for (const std::unique_ptr<SymbolChannel> &channel : channels_)
    while (const SymbolRequest::Part *part = channel->pop()) {
      part->request->dropped_.store(true);
      part->request->open_.fetch_sub(1);
    }
  waiting_.clear();
}

void SymbolServer::close() {
  const std::lock_guard lock(mutex_);
  if (closed_)
    return;
  closed_ = true;
  dropAll();
  if (recorder_)
    recorder_->finish();
}

/// What takes the place of what the server has; afterwards, what had its place.
struct SymbolServer::Change::Parts {
  std::unique_ptr<app::SymbolTable> symbols;
  std::vector<Forced> forced;
  std::vector<std::unique_ptr<SymbolChannel::ForceList>> lists; // by task
  std::shared_ptr<Recorder> recorder;
  std::optional<Recorder::Carry> carry; ///< Nothing: it ends.
  std::string whyItEnds;
  std::unique_ptr<SymbolChannel::RecorderSlot> noRecorder;
};

SymbolServer::Change::Change() : parts_(std::make_unique<Parts>()) {}
SymbolServer::Change::Change(Change &&) noexcept = default;
SymbolServer::Change::~Change() = default;

SymbolServer::Change SymbolServer::prepareChange(std::unique_ptr<app::SymbolTable> symbols) const {
  const std::lock_guard lock(mutex_);
  Change change;
  Change::Parts &parts = *change.parts_;
  for (const Forced &forced : forced_) {
    const TypeDesc &before = symbols_->type(forced.symbol);
    try {
      app::Symbol symbol = app::resolveWritable(*symbols, forced.symbol.path());
      if ((symbols->type(symbol).kind == Kind::BOOL) == (before.kind == Kind::BOOL)) {
        // As it was written: an enumerator may have another number, a number another type.
        std::vector<std::byte> value = app::literalBytes(
            *symbols, symbol, app::formatLiteral(symbols_->app(), before, forced.value.data()));
        parts.forced.push_back({std::move(symbol), std::move(value)});
        continue;
      }
    } catch (const app::Error &) { // not known any more, or no value of it, which is told
    }
    change.lostForces_.push_back(forced.symbol.path());
  }
  parts.symbols = std::move(symbols);
  for (size_t i = 0; i < channels_.size(); ++i)
    parts.lists.push_back(
        std::make_unique<SymbolChannel::ForceList>(SymbolChannel::ForceList{parts.forced}));
  parts.noRecorder = std::make_unique<SymbolChannel::RecorderSlot>();
  parts.recorder = recorder_;
  try {
    if (recorder_ && !recorder_->detached())
      parts.carry.emplace(recorder_->in(*parts.symbols));
  } catch (const app::Error &error) {
    parts.whyItEnds = error.what();
  }
  return change;
}

void SymbolServer::changeApplication(Change &change) {
  const std::lock_guard lock(mutex_);
  Change::Parts &parts = *change.parts_;
  dropAll();
  const bool goesOn = recorder_ && recorder_ == parts.recorder && parts.carry;
  if (goesOn)
    recorder_->carryOver(*parts.carry);
  else
    channels_[tasks_->fastest()]->recorder.publish(std::move(parts.noRecorder));
  if (recorder_ && !goesOn && !recorder_->detached())
    parts.recorder = std::move(recorder_); // its columns describe the old build
  symbols_.swap(parts.symbols);
  forced_.swap(parts.forced);
  ++build_;
  for (size_t i = 0; i < channels_.size(); ++i)
    channels_[i]->forces.publish(std::move(parts.lists[i]));
  // A task that has not taken the list before must not apply the old one, whose symbols lead into
  // the old state; no task is in a cycle, so this thread takes it for them.
  for (const std::unique_ptr<SymbolChannel> &channel : channels_) {
    channel->forces.take();
    channel->recorder.take();
  }
}

void SymbolServer::finishChange(Change &change) {
  const std::lock_guard lock(mutex_);
  Change::Parts &parts = *change.parts_;
  if (!parts.recorder || recorder_)
    return;
  parts.recorder->detach(parts.whyItEnds);
  recorder_ = std::move(parts.recorder);
}

} // namespace stride::monitor
