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
constexpr InputMark kWrite = 0xFFFFFFFE;       ///< A WriteMark and the bytes: before the POUs.
constexpr InputMark kWriteBehind = 0xFFFFFFFD; ///< The same behind them.
constexpr InputMark kFault = 0xFFFFFFFC;       ///< Last of all: a FaultMark and its texts.

/// From outside into the state.
struct WriteMark {
  uint64_t offset = 0;
  uint64_t size = 0;
};

/// The exception that stopped the run.
struct FaultMark {
  uint32_t code = 0;
  uint32_t line = 0;
  uint32_t column = 0;
  uint32_t fileSize = 0;
  uint32_t detailSize = 0;
  uint32_t taskSize = 0;
  uint64_t cycle = 0;
  int64_t timeNs = 0;
  uint64_t looks = 0;
};

template <class T> std::span<const std::byte> bytesOf(const T &value) {
  return std::as_bytes(std::span(&value, 1));
}

} // namespace

class Recording::CycleNote final : public task::CycleHook {
public:
  CycleNote(Recording &recording, const task::TaskSet &tasks)
      : recording_(&recording), tasks_(&tasks) {}

  void beforePous(Ctx &ctx) override {
    const CycleMark cycle{ctx.taskIndex, tasks_->told(ctx.taskIndex) ? 1U : 0U, ctx.cycleStartNs};
    recording_->put(kCycle, bytesOf(cycle));
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
  state_ = application.state();
  stateSize_ = app.stateSize;
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
  put(static_cast<InputMark>(size), {static_cast<const std::byte *>(value), size});
}

void Recording::wrote(const std::byte *place, std::size_t size, bool behindPous) noexcept {
  const WriteMark mark{std::bit_cast<uint64_t>(place) - std::bit_cast<uint64_t>(state_), size};
  if (mark.offset >= stateSize_ || stateSize_ - mark.offset < size)
    beyond_.store(true, std::memory_order_relaxed);
  else
    put(behindPous ? kWriteBehind : kWrite, bytesOf(mark), {place, size});
}

/// All of it or nothing, so that the recording ends behind a whole record.
void Recording::put(uint32_t mark, std::span<const std::byte> first,
                    std::span<const std::byte> second) noexcept {
  const std::size_t size = first.size() + second.size();
  const uint64_t at = put_.load(std::memory_order_relaxed);
  if (full_.load(std::memory_order_relaxed) ||
      at + sizeof mark + size - taken_.load(std::memory_order_acquire) > ring_.size()) {
    full_.store(true, std::memory_order_relaxed);
    return;
  }
  copyIn(at, &mark, sizeof mark);
  copyIn(at + sizeof mark, first.data(), first.size());
  copyIn(at + sizeof mark + first.size(), second.data(), second.size());
  put_.store(at + sizeof mark + size, std::memory_order_release);
}

void Recording::copyIn(uint64_t at, const void *data, std::size_t size) noexcept {
  const std::size_t place = at % ring_.size();
  const std::size_t first = std::min(size, ring_.size() - place);
  if (size == 0)
    return;
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

std::string Recording::finish(const std::optional<task::Fault> &fault) {
  drain();
  if (fault && !full_) {
    const StException &exception = fault->exception;
    const std::string_view file = exception.file() != nullptr ? exception.file() : "";
    const std::string_view detail = exception.detail();
    const FaultMark mark{static_cast<uint32_t>(exception.code()),
                         exception.line(),
                         exception.column(),
                         static_cast<uint32_t>(file.size()),
                         static_cast<uint32_t>(detail.size()),
                         static_cast<uint32_t>(fault->task.size()),
                         fault->cycle,
                         fault->timeNs,
                         fault->looks};
    const auto write = [&](const void *data, std::size_t size) {
      writeFailed_ = std::fwrite(data, 1, size, file_) != size || writeFailed_;
    };
    write(&kFault, sizeof kFault);
    write(&mark, sizeof mark);
    for (const std::string_view text : {file, detail, std::string_view(fault->task)})
      write(text.data(), text.size());
  }
  writeFailed_ = std::fclose(file_) != 0 || writeFailed_;
  file_ = nullptr;
  if (writeFailed_)
    return fmt::format("the recording '{}' could not be written: {}", path_, std::strerror(errno));
  if (beyond_)
    return fmt::format("the recording '{}' cannot be replayed exactly: a variable was written from "
                       "outside that a pointer leads to and that is not the application's",
                       path_);
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
  stateSize_ = app.stateSize;
  findFault();
}

/// The last record, if the run was stopped by an exception: an endless loop must be known before
/// its cycle begins.
void Replay::findFault() {
  const std::size_t begin = at_;
  InputMark mark = 0;
  const auto skip = [&](uint64_t size) {
    if (data_.size() - at_ < size)
      return false;
    at_ += size;
    return true;
  };
  bool good = true;
  while (good && !fault_ && take(&mark, sizeof mark)) {
    WriteMark write;
    FaultMark fault;
    if (mark == kCycle)
      good = skip(sizeof(CycleMark));
    else if (mark == kWrite || mark == kWriteBehind)
      good = take(&write, sizeof write) && skip(write.size);
    else if (mark != kFault)
      good = skip(mark);
    else if (take(&fault, sizeof fault) &&
             data_.size() - at_ == uint64_t{fault.fileSize} + fault.detailSize + fault.taskSize) {
      const auto text = [&](uint32_t size) {
        std::string out(size, '\0');
        take(out.data(), size);
        return out;
      };
      faultFile_ = text(fault.fileSize);
      const std::string detail = text(fault.detailSize);
      fault_ = task::Fault{StException(static_cast<ExceptionCode>(fault.code),
                                       faultFile_.empty() ? nullptr : faultFile_.c_str(),
                                       fault.line, fault.column, detail.c_str()),
                           text(fault.taskSize), fault.cycle, fault.timeNs, fault.looks};
    } else {
      good = false;
    }
  }
  at_ = begin;
}

class Replay::Writes final : public task::CycleHook {
public:
  explicit Writes(Replay &replay) : replay_(&replay) {}
  void beforePous(Ctx &ctx) override {
    replay_->applyWrites(kWrite, static_cast<std::byte *>(ctx.state));
  }
  void afterPous(Ctx &ctx) override {
    replay_->applyWrites(kWriteBehind, static_cast<std::byte *>(ctx.state));
  }

private:
  Replay *replay_;
};

Replay::~Replay() = default;

void Replay::addHooks(task::TaskSet &tasks) {
  for (uint32_t i = 0; i < tasks.count(); ++i) {
    writes_.push_back(std::make_unique<Writes>(*this));
    tasks.addHook(i, *writes_.back());
  }
}

void Replay::applyWrites(uint32_t wanted, std::byte *state) noexcept {
  for (;;) {
    const std::size_t before = at_;
    InputMark mark = 0;
    WriteMark write;
    if (!problem_.empty() || !take(&mark, sizeof mark) || mark != wanted ||
        !take(&write, sizeof write) || write.offset > stateSize_ ||
        stateSize_ - write.offset < write.size || !take(state + write.offset, write.size)) {
      at_ = before; // something else, or damaged, which is noticed there
      return;
    }
  }
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
  const std::size_t before = at_;
  if (fault_ && take(&mark, sizeof mark) && mark == kFault)
    return std::nullopt;
  at_ = before;
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
