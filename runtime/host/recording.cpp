#include "runtime/host/recording.hpp"

#include "runtime/app/checksum.hpp"
#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>

namespace stride::host {

namespace {

constexpr size_t kRing = size_t{8} << 20;
constexpr size_t kBlockPiece = size_t{64} << 10;
constexpr uint64_t kMagic = 0x32434552'44525453; // "STRDREC2"

app::Error cutOffTooEarly(const std::string &path) {
  return app::Error(
      fmt::format("'{}' is cut off before its first cycle: there is nothing to replay", path));
}

/// The file is a row of blocks; whole records are in each.
struct BlockHead {
  uint64_t size = 0;     ///< Of what follows.
  uint64_t checksum = 0; ///< Of this block and all before it.
};

/// How the first block begins; the script's name and the state follow.
struct Header {
  uint64_t magic = kMagic;
  uint64_t scriptChecksum = 0;
  uint64_t scriptNameSize = 0; ///< 0: without a script.
  uint64_t buildHash = 0;
  uint64_t stateSize = 0;
  uint64_t stateAddress = 0; ///< Pointers in the state are addresses.
};

/// Before the inputs of each cycle.
struct CycleMark {
  uint32_t task = 0;
  uint32_t flags = 0; ///< kEnded, kInStop, kTakesModeOver
  int64_t startNs = 0;
};
constexpr uint32_t kEnded = 1;         ///< The application had been stopped before it.
constexpr uint32_t kInStop = 2;        ///< OperatingMode::Stop.
constexpr uint32_t kTakesModeOver = 4; ///< TaskSet::takeModeOver().

/// Before each input: its size, so that a replay notices when it goes another way.
using InputMark = uint32_t;
constexpr InputMark kCycle = 0xFFFFFFFF;
constexpr InputMark kWrite = 0xFFFFFFFE;       ///< A WriteMark and the bytes: before the POUs.
constexpr InputMark kWriteBehind = 0xFFFFFFFD; ///< The same after them.
constexpr InputMark kFault = 0xFFFFFFFC;       ///< Last of all: a FaultMark and its texts.
constexpr InputMark kEnd = 0xFFFFFFFB;         ///< After the last cycle: an EndMark.

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

struct EndMark {
  uint64_t complete = 0;      ///< 0: cycles and inputs are missing.
  uint64_t stateChecksum = 0; ///< Of the state after the last cycle.
};

std::span<const std::byte> bytesOf(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}
template <class T> std::span<const std::byte> bytesOf(const T &value) {
  return std::as_bytes(std::span(&value, 1));
}

} // namespace

class Recording::CycleNote final : public task::CycleHook {
public:
  CycleNote(Recording &recording, const task::TaskSet &tasks)
      : recording_(&recording), tasks_(&tasks) {}

  void beforePous(Ctx &ctx) override {
    const uint32_t task = ctx.taskIndex;
    const bool inStop = tasks_->modeOf(task) == task::OperatingMode::Stop;
    const uint32_t flags = (tasks_->told(task) ? kEnded : 0U) | (inStop ? kInStop : 0U) |
                           (tasks_->takesModeOver(task) ? kTakesModeOver : 0U);
    const CycleMark cycle{task, flags, ctx.cycleStartNs};
    recording_->put(kCycle, bytesOf(cycle));
  }
  void afterPous(Ctx &) override {}

private:
  Recording *recording_;
  const task::TaskSet *tasks_;
};

Recording::Recording(const std::string &path)
    : path_(path), output_(path, kRing + sizeof(BlockHead), Output::Wait::Never), ring_(kRing) {}

void Recording::begin(const app::Application &application, const script::Script *script) {
  const StrideAppV1 &app = application.description();
  Header header;
  header.buildHash = app.buildHash;
  header.stateSize = app.stateSize;
  header.stateAddress = std::bit_cast<uint64_t>(application.state());
  state_ = application.state();
  stateSize_ = app.stateSize;
  if (script != nullptr) {
    header.scriptChecksum = app::crc64(bytesOf(std::string_view(script->text())));
    header.scriptNameSize = script->file().size();
  }
  writeBlock({bytesOf(header),
              bytesOf(std::string_view(script != nullptr ? script->file() : std::string())),
              {state_, stateSize_}});
}

/// What finds no room in the output's memory, which is before and after the cycles only, waits for
/// the file.
void Recording::writeBlock(std::initializer_list<std::span<const std::byte>> parts) noexcept {
  BlockHead head;
  for (const std::span<const std::byte> part : parts) {
    head.size += part.size();
    checksum_ = app::crc64(part, checksum_);
  }
  head.checksum = checksum_;
  const auto write = [&](std::span<const std::byte> part) {
    while (!part.empty()) {
      const size_t size = std::min(part.size(), kBlockPiece);
      if (!output_.ready(size) && !output_.settle())
        incomplete_ = true;
      if (incomplete_)
        return;
      output_.append({reinterpret_cast<const char *>(part.data()), size});
      part = part.subspan(size);
    }
  };
  write(bytesOf(head));
  for (const std::span<const std::byte> part : parts)
    write(part);
}

Recording::~Recording() = default;

void Recording::addHooks(task::TaskSet &tasks) {
  for (uint32_t i = 0; i < tasks.count(); ++i) {
    notes_.push_back(std::make_unique<CycleNote>(*this, tasks));
    tasks.addHook(i, *notes_.back());
  }
}

void Recording::pass(void *value, size_t size) noexcept {
  put(static_cast<InputMark>(size), {static_cast<const std::byte *>(value), size});
}

void Recording::wrote(const std::byte *place, size_t size, bool behindPous) noexcept {
  const WriteMark mark{std::bit_cast<uint64_t>(place) - std::bit_cast<uint64_t>(state_), size};
  if (mark.offset >= stateSize_ || stateSize_ - mark.offset < size)
    beyond_.store(true, std::memory_order_relaxed);
  else
    put(behindPous ? kWriteBehind : kWrite, bytesOf(mark), {place, size});
}

/// All of it or nothing, so that the recording ends after a whole record.
void Recording::put(uint32_t mark, std::span<const std::byte> first,
                    std::span<const std::byte> second) noexcept {
  const size_t size = first.size() + second.size();
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

void Recording::copyIn(uint64_t at, const void *data, size_t size) noexcept {
  const size_t place = at % ring_.size();
  const size_t first = std::min(size, ring_.size() - place);
  if (size == 0)
    return;
  std::memcpy(ring_.data() + place, data, first);
  std::memcpy(ring_.data(), static_cast<const std::byte *>(data) + first, size - first);
}

/// One block after the other, so that all of it finds room in the output's memory.
void Recording::drain() noexcept {
  const uint64_t end = put_.load(std::memory_order_acquire);
  const uint64_t at = taken_.load(std::memory_order_relaxed);
  if (at == end || (!output_.advance() && output_.error() == 0))
    return;
  const size_t place = at % ring_.size();
  const size_t first = std::min<size_t>(end - at, ring_.size() - place);
  const std::span<const std::byte> ring(ring_);
  writeBlock({ring.subspan(place, first), ring.first(end - at - first)});
  taken_.store(end, std::memory_order_release);
  output_.advance();
}

bool Recording::finish(const std::optional<task::Fault> &fault) noexcept {
  if (output_.settle())
    drain();
  const EndMark end{full_ || beyond_ ? 0U : 1U, app::crc64({state_, stateSize_})};
  writeBlock({bytesOf(kEnd), bytesOf(end)});
  if (fault && !full_) {
    const StException &exception = fault->exception;
    const std::string_view file = exception.file() != nullptr ? exception.file() : "";
    const std::string_view detail = exception.detail();
    const std::string_view task = fault->task;
    const FaultMark mark{static_cast<uint32_t>(exception.code()),
                         exception.line(),
                         exception.column(),
                         static_cast<uint32_t>(file.size()),
                         static_cast<uint32_t>(detail.size()),
                         static_cast<uint32_t>(task.size()),
                         fault->cycle,
                         fault->timeNs,
                         fault->looks};
    writeBlock({bytesOf(kFault), bytesOf(mark), bytesOf(file), bytesOf(detail), bytesOf(task)});
  }
  incomplete_ = !output_.finish() || incomplete_;
  return !incomplete_ && !beyond_ && !full_;
}

std::string Recording::problem() const {
  if (output_.error() != 0 || incomplete_)
    return fmt::format("the recording '{}' could not be written: {}", path_,
                       output_.error() != 0 ? std::strerror(output_.error()) : "nobody reads it");
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

Replay::Replay(const std::string &path, const app::Application &application,
               const script::Script *script)
    : path_(path) {
  readBlocks();
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
  const size_t left = data_.size() - at_;
  if (left < header.scriptNameSize || left - header.scriptNameSize < app.stateSize)
    throw cutOffTooEarly(path);
  std::string name(header.scriptNameSize, '\0');
  take(name.data(), name.size());
  if (script == nullptr && !name.empty())
    throw app::Error(
        fmt::format("'{}' was recorded with the script '{}': give it with --script", path, name));
  if (script != nullptr && name.empty())
    throw app::Error(fmt::format("'{}' was recorded without a script: leave --script out", path));
  if (script != nullptr &&
      header.scriptChecksum != app::crc64(bytesOf(std::string_view(script->text()))))
    throw app::Error(fmt::format("'{}' was recorded with the script '{}', but '{}' is another one, "
                                 "or was changed since",
                                 path, name, script->file()));
  state_ = at_;
  at_ += app.stateSize;
  stateSize_ = app.stateSize;
  findEnd();
}

/// What the blocks hold, in one piece. A run that was killed leaves a file without an end, which is
/// good as far as it goes.
void Replay::readBlocks() {
  std::ifstream file(path_, std::ios::binary);
  if (!file)
    throw app::Error(fmt::format("cannot read '{}': {}", path_, std::strerror(errno)));
  const std::vector<char> text((std::istreambuf_iterator<char>(file)),
                               std::istreambuf_iterator<char>());
  const std::span<const std::byte> all = std::as_bytes(std::span(text));
  data_.reserve(all.size());
  uint64_t checksum = 0;
  for (size_t at = 0; all.size() - at >= sizeof(BlockHead);) {
    BlockHead head;
    std::memcpy(&head, all.data() + at, sizeof head);
    at += sizeof head;
    uint64_t magic = kMagic;
    if (data_.empty() && all.size() - at >= sizeof magic)
      std::memcpy(&magic, all.data() + at, sizeof magic);
    if (magic != kMagic)
      return; // no recording
    if (all.size() - at < head.size)
      break;
    const std::span<const std::byte> block = all.subspan(at, head.size);
    checksum = app::crc64(block, checksum);
    if (checksum != head.checksum)
      throw app::Error(fmt::format("'{}' is damaged: the checksum of the block at byte {} is wrong",
                                   path_, at - sizeof head));
    data_.insert(data_.end(), block.begin(), block.end());
    at += head.size;
  }
  if (data_.empty() && all.size() >= sizeof(BlockHead) + sizeof kMagic)
    throw cutOffTooEarly(path_);
}

/// The last records: the end, and the exception, if one stopped the run; an endless loop must be
/// known before its cycle begins.
void Replay::findEnd() {
  const size_t begin = at_;
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
    EndMark end;
    if (mark == kEnd) {
      good = take(&end, sizeof end);
      ended_ = good;
      if (good && end.complete != 0)
        endChecksum_ = end.stateChecksum;
    } else if (mark == kCycle)
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
    const size_t before = at_;
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

void Replay::compareEnd(const app::Application &application) {
  if (problem_.empty() && endChecksum_ &&
      *endChecksum_ != app::crc64({application.state(), stateSize_}))
    problem_ = fmt::format("the replay of '{}' has gone another way than the run: its variables "
                           "have other values at the end; something reached the program that was "
                           "not recorded",
                           path_);
}

void Replay::restoreState(const app::Application &application) const {
  std::memcpy(application.state(), data_.data() + state_, application.description().stateSize);
}

bool Replay::take(void *value, size_t size) noexcept {
  if (data_.size() - at_ < size)
    return false;
  std::memcpy(value, data_.data() + at_, size);
  at_ += size;
  return true;
}

std::optional<RecordedCycle> Replay::nextCycle() {
  InputMark mark = 0;
  CycleMark cycle;
  if (!problem_.empty())
    return std::nullopt;
  if (at_ == data_.size() && !ended_)
    problem_ = fmt::format("'{}' is cut off: the run went on after the end of the replay", path_);
  if (at_ == data_.size())
    return std::nullopt;
  const size_t before = at_;
  if (take(&mark, sizeof mark) && mark == kEnd)
    return std::nullopt;
  at_ = before;
  if (!take(&mark, sizeof mark) || mark != kCycle || !take(&cycle, sizeof cycle)) {
    problem_ = fmt::format("'{}' does not fit from byte {} on: the program has read fewer inputs "
                           "than in the run, or the file is cut off",
                           path_, at_);
    return std::nullopt;
  }
  RecordedCycle recorded{.task = cycle.task, .startNs = cycle.startNs};
  recorded.stopped = (cycle.flags & kEnded) != 0;
  if ((cycle.flags & kInStop) != 0)
    recorded.mode = task::OperatingMode::Stop;
  recorded.takesModeOver = (cycle.flags & kTakesModeOver) != 0;
  return recorded;
}

void Replay::pass(void *value, size_t size) noexcept {
  if (!problem_.empty())
    return;
  const size_t before = at_;
  InputMark mark = 0;
  if (!take(&mark, sizeof mark) || mark != size || !take(value, size))
    problem_ = fmt::format("'{}' does not fit from byte {} on: the program has read other inputs "
                           "than in the run",
                           path_, before);
}

} // namespace stride::host
