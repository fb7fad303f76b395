#include "runtime/system/file_service.hpp"

#include "runtime/system/file_job.hpp"
#include "runtime/system/file_stream.hpp"
#include "runtime/system/handle.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <pthread.h>

namespace stride::system {

namespace {

/// An answer that nobody has taken for so many cycles makes room when there is none.
constexpr uint64_t kForgotten = 100;

bool sameText(const char *own, const char *given) {
  return given == nullptr ? own[0] == 0 : std::strncmp(own, given, kFileName - 1) == 0;
}

void copyText(char (&to)[kFileName], const char *from) {
  const size_t length = from == nullptr ? 0 : ::strnlen(from, kFileName - 1);
  std::memcpy(to, from == nullptr ? "" : from, length);
  to[length] = 0;
}

} // namespace

FileService::FileService(FileSettings settings, uint32_t tasks, Inputs &inputs)
    : settings_(std::move(settings)), inputs_(&inputs), disk_(settings_.root, settings_.anywhere),
      jobs_(std::make_unique<Job[]>(kJobs)), streams_(std::make_unique<Stream[]>(kStreams)),
      lastErrors_(tasks), scratch_(Stream::kRing) {
  ::sem_init(&work_, 0, 0);
}

FileService::~FileService() {
  finish();
  ::sem_destroy(&work_);
}

void FileService::lookAfter() {
  if (thread_.joinable() || ending_.load() || !wanted_.load(std::memory_order_acquire))
    return;
  // Signals are for the program's other threads.
  ::sigset_t all;
  ::sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { work(); });
  ::pthread_setname_np(thread_.native_handle(), "stride files");
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void FileService::finish() {
  if (ending_.exchange(true, std::memory_order_acq_rel))
    return;
  if (thread_.joinable()) {
    ::sem_post(&work_);
    thread_.join();
  }
  workOnce();
  finishStreams();
}

std::vector<std::string> FileService::takeNews() {
  const std::lock_guard lock(newsMutex_);
  if (unsaid_.exchange(false))
    news_.emplace_back("what the program wrote into a file is lost");
  return std::exchange(news_, {});
}

// ---- in the cycle

/// A place for a request, or null.
FileService::Job *FileService::claim(const Ctx &ctx) noexcept {
  if (ending_.load(std::memory_order_acquire))
    return nullptr;
  for (size_t i = 0; i < kJobs; ++i) {
    uint32_t expected = Job::kFree;
    if (jobs_[i].state.compare_exchange_strong(expected, Job::kFilling, std::memory_order_acquire,
                                               std::memory_order_relaxed))
      return &jobs_[i];
  }
  recycle(ctx);
  return nullptr;
}

/// Gives up the oldest answer that this task has not taken; a file that was opened is closed.
void FileService::recycle(const Ctx &ctx) noexcept {
  Job *oldest = nullptr;
  for (size_t i = 0; i < kJobs; ++i) {
    Job &job = jobs_[i];
    if (job.state.load(std::memory_order_acquire) == Job::kDone && job.task == ctx.taskIndex &&
        ctx.cycle - job.cycle > kForgotten && (oldest == nullptr || job.ticket < oldest->ticket))
      oldest = &job;
  }
  if (oldest == nullptr)
    return;
  const bool opened = oldest->answer.error == FileError::None &&
                      (oldest->op == FileOp::Open || oldest->op == FileOp::OpenStream);
  if (!opened) {
    oldest->state.store(Job::kFree, std::memory_order_release);
    return;
  }
  FileRequest close{};
  close.op = oldest->op == FileOp::Open ? FileOp::Close : FileOp::CloseStream;
  close.file = static_cast<uint32_t>(oldest->answer.value);
  oldest->taker = Job::Taker::Nobody;
  submit(ctx, *oldest, close);
}

/// Who takes the answer stands there already.
void FileService::submit(const Ctx &ctx, Job &job, const FileRequest &request) noexcept {
  job.generation.store(Handle::next(job.generation.load(std::memory_order_relaxed)),
                       std::memory_order_relaxed);
  job.task.store(ctx.taskIndex, std::memory_order_relaxed);
  job.cycle = ctx.cycle;
  job.op = request.op;
  job.mode = request.mode;
  job.file = request.file;
  job.position = request.position;
  job.size = std::min(request.size, kFileChunk);
  copyText(job.name, request.name);
  copyText(job.second, request.second);
  if (request.op == FileOp::Write)
    std::memcpy(job.data.get(), request.data, job.size);
  job.answer = {};
  job.ticket = tickets_.fetch_add(1, std::memory_order_relaxed);
  job.state.store(Job::kQueued, std::memory_order_release);
  wake();
}

void FileService::wake() noexcept {
  if (settings_.virtualTime) {
    workOnce();
    return;
  }
  wanted_.store(true, std::memory_order_release);
  ::sem_post(&work_);
}

FileService::Job *FileService::findJob(uint32_t number) noexcept {
  const Handle handle(number);
  if (handle.index() >= kJobs)
    return nullptr;
  Job &job = jobs_[handle.index()];
  const uint32_t state = job.state.load(std::memory_order_acquire);
  return (state == Job::kQueued || state == Job::kDone) && job.generation == handle.generation()
             ? &job
             : nullptr;
}

FileService::Job *FileService::findAsked(const Ctx &ctx, const FileRequest &request) noexcept {
  for (size_t i = 0; i < kJobs; ++i) {
    Job &job = jobs_[i];
    const uint32_t state = job.state.load(std::memory_order_acquire);
    if ((state == Job::kQueued || state == Job::kDone) && job.task == ctx.taskIndex &&
        job.taker == Job::Taker::Asker && job.op == request.op && job.mode == request.mode &&
        job.file == request.file && sameText(job.name, request.name) &&
        sameText(job.second, request.second))
      return &job;
  }
  return nullptr;
}

bool FileService::ready(const Ctx &ctx, const Job &job) const noexcept {
  return job.state.load(std::memory_order_acquire) == Job::kDone &&
         (!settings_.virtualTime || job.task != ctx.taskIndex ||
          ctx.cycle - job.cycle >= settings_.delayCycles);
}

void FileService::take(Job &job, void *data, uint64_t room, FileAnswer &answer) noexcept {
  answer = job.answer;
  answer.done = 1;
  if (job.op == FileOp::Read) {
    answer.value = std::min(answer.value, room);
    if (data != nullptr)
      std::memcpy(data, job.data.get(), answer.value);
  }
  job.state.store(Job::kFree, std::memory_order_release);
}

uint32_t FileService::start(const Ctx &ctx, const FileRequest &request) noexcept {
  uint32_t number = 0;
  if (!inputs_->replays()) {
    if (Job *const job = claim(ctx)) {
      job->taker = Job::Taker::Number;
      submit(ctx, *job, request);
      number = Handle(static_cast<size_t>(job - jobs_.get()),
                      job->generation.load(std::memory_order_relaxed))
                   .number();
    }
  }
  inputs_->pass(&number, sizeof number);
  return number;
}

void FileService::poll(const Ctx &ctx, uint32_t number, void *data, uint64_t room,
                       FileAnswer &answer) noexcept {
  answer = {};
  if (!inputs_->replays()) {
    Job *const job = findJob(number);
    if (job == nullptr) {
      answer.done = 1;
      answer.error = FileError::NotPossible;
    } else if (ready(ctx, *job)) {
      take(*job, data, room, answer);
    }
  }
  inputs_->pass(&answer, sizeof answer);
  if (answer.done != 0 && room != 0)
    inputs_->pass(data, std::min(answer.value, room));
}

void FileService::ask(const Ctx &ctx, const FileRequest &request, FileAnswer &answer) noexcept {
  answer = {};
  if (!inputs_->replays())
    askNow(ctx, request, answer);
  inputs_->pass(&answer, sizeof answer);
  lastErrors_[ctx.taskIndex] = answer.error;
}

void FileService::askNow(const Ctx &ctx, const FileRequest &request, FileAnswer &answer) noexcept {
  answer.error = FileError::Pending;
  Job *job = findAsked(ctx, request);
  if (job == nullptr) {
    if (request.op == FileOp::CloseStream) {
      Stream *const stream = findStream(request.file);
      if (stream == nullptr) {
        answer.done = 1;
        answer.error = FileError::BadHandle;
        return;
      }
      job = claim(ctx);
      if (job == nullptr)
        return;
      stream->state.store(Stream::kClosing);
    } else {
      job = claim(ctx);
      if (job == nullptr)
        return;
    }
    job->taker = Job::Taker::Asker;
    submit(ctx, *job, request);
  }
  if (ready(ctx, *job))
    take(*job, nullptr, 0, answer);
}

void FileService::stream(const Ctx &ctx, StreamOp op, uint32_t file, void *data, uint64_t size,
                         FileAnswer &answer) noexcept {
  answer = {};
  answer.done = 1;
  if (!inputs_->replays()) {
    Stream *const stream = findStream(file);
    if (stream == nullptr) {
      answer.error = FileError::BadHandle;
    } else if (stream->user.exchange(1) != 0) {
      answer.error = FileError::Pending;
    } else {
      if (findStream(file) == stream) // no other task has closed it just now
        use(*stream, op, data, size, answer);
      else
        answer.error = FileError::BadHandle;
      stream->user.store(0, std::memory_order_release);
      if (op == StreamOp::Write && answer.value != 0)
        wake();
    }
  }
  inputs_->pass(&answer, sizeof answer);
  if (op == StreamOp::Read)
    inputs_->pass(data, std::min(answer.value, size));
  lastErrors_[ctx.taskIndex] = answer.error;
}

FileService::Stream *FileService::findStream(uint32_t file) noexcept {
  const Handle handle(file);
  if (handle.index() >= kStreams)
    return nullptr;
  Stream &stream = streams_[handle.index()];
  const uint32_t state = stream.state.load();
  return (state == Stream::kReading || state == Stream::kWriting) &&
                 stream.generation == handle.generation()
             ? &stream
             : nullptr;
}

void FileService::use(Stream &stream, StreamOp op, void *data, uint64_t size,
                      FileAnswer &answer) noexcept {
  const bool reading = stream.state.load(std::memory_order_relaxed) == Stream::kReading;
  switch (op) {
  case StreamOp::Read:
    if (!reading) {
      answer.error = FileError::NotPossible;
      return;
    }
    answer.value = std::min<uint64_t>(size, stream.length - stream.position);
    if (answer.value != 0) // an empty file has no image
      std::memcpy(data, stream.image.data() + stream.position, answer.value);
    stream.position += answer.value;
    return;
  case StreamOp::Write:
    if (reading)
      answer.error = FileError::NotPossible;
    else
      put(stream, data, size, answer);
    return;
  case StreamOp::SetPosition:
    if (reading ? size > stream.length : stream.appends) {
      answer.error = FileError::NotPossible;
      return;
    }
    stream.position = size;
    answer.value = 1;
    return;
  case StreamOp::GetPosition:
    answer.value = stream.position;
    return;
  case StreamOp::AtEnd:
    answer.value = stream.position >= stream.length ? 1 : 0;
    return;
  }
}

/// As much as there is room for.
void FileService::put(Stream &stream, const void *data, uint64_t size,
                      FileAnswer &answer) noexcept {
  answer.error = stream.error.load(std::memory_order_acquire);
  if (answer.error != FileError::None || size == 0)
    return;
  const uint64_t at = stream.put.load(std::memory_order_relaxed);
  const uint64_t used = at - stream.taken.load(std::memory_order_acquire);
  Stream::Record record;
  if (used + sizeof record >= Stream::kRing) {
    answer.error = FileError::Pending;
    return;
  }
  record.position = stream.position;
  record.size = std::min(size, Stream::kRing - used - sizeof record);
  stream.copyIn(at, &record, sizeof record);
  stream.copyIn(at + sizeof record, data, record.size);
  stream.put.store(at + sizeof record + record.size, std::memory_order_release);
  stream.position += record.size;
  stream.length = std::max(stream.length, stream.position);
  answer.value = record.size;
  if (record.size < size)
    answer.error = FileError::Pending;
}

} // namespace stride::system
