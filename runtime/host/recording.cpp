#include "runtime/host/recording.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace stride::host {

namespace {

constexpr std::size_t kRing = std::size_t{8} << 20;
constexpr uint64_t kMagic = 0x31434552'44525453; // "STRDREC1"

/// How the file begins; the state follows.
struct Header {
  uint64_t magic = kMagic;
  uint64_t buildHash = 0;
  uint64_t stateSize = 0;
  uint64_t stateAddress = 0; ///< Pointers in the state are addresses.
};

/// Before the inputs of each cycle.
struct CycleMark {
  uint32_t task = 0;
  uint32_t stopped = 0;
  int64_t startNs = 0;
};

/// Before each input: its size, so that a replay notices when it goes another way.
using InputMark = uint32_t;
constexpr InputMark kCycle = 0xFFFFFFFF;

} // namespace

class Recording::CycleNote final : public task::CycleHook {
public:
  CycleNote(Recording &recording, const task::TaskSet &tasks)
      : recording_(&recording), tasks_(&tasks) {}

  void beforePous(Ctx &ctx) override {
    const InputMark mark = kCycle;
    const CycleMark cycle{ctx.taskIndex, tasks_->told(ctx.taskIndex) ? 1U : 0U, ctx.cycleStartNs};
    recording_->put(mark, &cycle, sizeof cycle);
  }
  void afterPous(Ctx &) override {}

private:
  Recording *recording_;
  const task::TaskSet *tasks_;
};

Recording::Recording(const std::string &path) : path_(path), ring_(kRing) {
  file_ = std::fopen(path.c_str(), "wb");
  if (file_ == nullptr)
    throw app::Error(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
}

void Recording::begin(const app::Application &application) {
  const StrideAppV1 &app = application.description();
  Header header;
  header.buildHash = app.buildHash;
  header.stateSize = app.stateSize;
  header.stateAddress = std::bit_cast<uint64_t>(application.state());
  writeFailed_ = std::fwrite(&header, sizeof header, 1, file_) != 1 ||
                 std::fwrite(application.state(), 1, app.stateSize, file_) != app.stateSize;
}

Recording::~Recording() {
  if (file_ != nullptr)
    std::fclose(file_);
}

void Recording::addHooks(task::TaskSet &tasks) {
  for (uint32_t i = 0; i < tasks.count(); ++i) {
    notes_.push_back(std::make_unique<CycleNote>(*this, tasks));
    tasks.addHook(i, *notes_.back());
  }
}

void Recording::pass(void *value, std::size_t size) noexcept {
  put(static_cast<InputMark>(size), value, size);
}

/// Both or nothing, so that the recording ends behind a whole record.
void Recording::put(uint32_t mark, const void *data, std::size_t size) noexcept {
  const uint64_t at = put_.load(std::memory_order_relaxed);
  if (full_.load(std::memory_order_relaxed) ||
      at + sizeof mark + size - taken_.load(std::memory_order_acquire) > ring_.size()) {
    full_.store(true, std::memory_order_relaxed);
    return;
  }
  copyIn(at, &mark, sizeof mark);
  copyIn(at + sizeof mark, data, size);
  put_.store(at + sizeof mark + size, std::memory_order_release);
}

void Recording::copyIn(uint64_t at, const void *data, std::size_t size) noexcept {
  const std::size_t place = at % ring_.size();
  const std::size_t first = std::min(size, ring_.size() - place);
  std::memcpy(ring_.data() + place, data, first);
  std::memcpy(ring_.data(), static_cast<const std::byte *>(data) + first, size - first);
}

void Recording::drain() {
  const uint64_t end = put_.load(std::memory_order_acquire);
  uint64_t at = taken_.load(std::memory_order_relaxed);
  while (at != end) {
    const std::size_t place = at % ring_.size();
    const auto count = static_cast<std::size_t>(std::min<uint64_t>(end - at, ring_.size() - place));
    writeFailed_ = std::fwrite(ring_.data() + place, 1, count, file_) != count || writeFailed_;
    at += count;
    taken_.store(at, std::memory_order_release);
  }
}

std::string Recording::finish() {
  drain();
  writeFailed_ = std::fclose(file_) != 0 || writeFailed_;
  file_ = nullptr;
  if (writeFailed_)
    return fmt::format("the recording '{}' could not be written: {}", path_, std::strerror(errno));
  if (full_)
    return fmt::format("the recording '{}' ends early: it could not be written as fast as inputs "
                       "came",
                       path_);
  return {};
}

Replay::Replay(const std::string &path, const app::Application &application) : path_(path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw app::Error(fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
  std::vector<char> text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  data_.resize(text.size());
  std::memcpy(data_.data(), text.data(), text.size());
  const StrideAppV1 &app = application.description();
  Header header;
  if (!take(&header, sizeof header) || header.magic != kMagic)
    throw app::Error(fmt::format("'{}' is no recording; 'stride run --record' makes one", path));
  if (header.buildHash != app.buildHash || header.stateSize != app.stateSize)
    throw app::Error(
        fmt::format("'{}' is a recording of another build of the application; replay it "
                    "with the sources it was made with",
                    path));
  if (header.stateAddress != std::bit_cast<uint64_t>(application.state()))
    throw app::Error(
        fmt::format("'{}' cannot be replayed: the state lies at another address", path));
  state_ = at_;
  if (data_.size() - at_ < app.stateSize)
    throw app::Error(fmt::format("'{}' is cut off", path));
  at_ += app.stateSize;
}

void Replay::restoreState(const app::Application &application) const {
  std::memcpy(application.state(), data_.data() + state_, application.description().stateSize);
}

bool Replay::take(void *value, std::size_t size) noexcept {
  if (data_.size() - at_ < size)
    return false;
  std::memcpy(value, data_.data() + at_, size);
  at_ += size;
  return true;
}

std::optional<RecordedCycle> Replay::nextCycle() {
  InputMark mark = 0;
  CycleMark cycle;
  if (!problem_.empty() || at_ == data_.size())
    return std::nullopt;
  if (!take(&mark, sizeof mark) || mark != kCycle || !take(&cycle, sizeof cycle)) {
    problem_ = fmt::format("'{}' does not fit from byte {} on: the program has read fewer inputs "
                           "than in the run, or the file is cut off",
                           path_, at_);
    return std::nullopt;
  }
  return RecordedCycle{cycle.task, cycle.stopped != 0, cycle.startNs};
}

void Replay::pass(void *value, std::size_t size) noexcept {
  if (!problem_.empty())
    return;
  const std::size_t before = at_;
  InputMark mark = 0;
  if (!take(&mark, sizeof mark) || mark != size || !take(value, size))
    problem_ = fmt::format("'{}' does not fit from byte {} on: the program has read other inputs "
                           "than in the run",
                           path_, before);
}

} // namespace stride::host
