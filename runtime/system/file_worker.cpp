// The file service's thread: everything that may wait for the disk.
#include "runtime/system/file_job.hpp"
#include "runtime/system/file_service.hpp"
#include "runtime/system/file_stream.hpp"
#include "runtime/system/handle.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <new>

#include <sys/stat.h>

namespace stride::system {

namespace {

const char *reason(FileError error) {
  switch (error) {
  case FileError::NoSpace:
    return "the disk is full";
  case FileError::AccessDenied:
    return "it may not be written";
  case FileError::TooLarge:
    return "it has become too large";
  default:
    return "the disk reports an error";
  }
}

} // namespace

void FileService::Stream::copyIn(uint64_t at, const void *data, uint64_t size) noexcept {
  const uint64_t place = at % kRing;
  const uint64_t first = std::min(size, kRing - place);
  std::memcpy(ring.get() + place, data, first);
  std::memcpy(ring.get(), static_cast<const std::byte *>(data) + first, size - first);
}

void FileService::Stream::copyOut(uint64_t at, void *data, uint64_t size) const noexcept {
  const uint64_t place = at % kRing;
  const uint64_t first = std::min(size, kRing - place);
  std::memcpy(data, ring.get() + place, first);
  std::memcpy(static_cast<std::byte *>(data) + first, ring.get(), size - first);
}

void FileService::work() {
  for (bool last = false; !last;) {
    while (::sem_wait(&work_) != 0 && errno == EINTR) {
    }
    last = ending_.load(std::memory_order_acquire);
    workOnce();
  }
}

void FileService::workOnce() {
  for (;;) {
    Job *const job = next();
    drainAll(); // what was written before the job was asked for, perhaps just now
    if (job == nullptr)
      return;
    try {
      execute(*job);
    } catch (const std::bad_alloc &) {
      job->answer.error = FileError::Device;
      job->answer.value = 0;
    }
    job->state.store(job->taker == Job::Taker::Nobody ? Job::kFree : Job::kDone,
                     std::memory_order_release);
  }
}

FileService::Job *FileService::next() {
  Job *oldest = nullptr;
  for (size_t i = 0; i < kJobs; ++i)
    if (jobs_[i].state.load(std::memory_order_acquire) == Job::kQueued &&
        (oldest == nullptr || jobs_[i].ticket < oldest->ticket))
      oldest = &jobs_[i];
  return oldest;
}

void FileService::execute(Job &job) {
  Outcome outcome;
  switch (job.op) {
  case FileOp::None:
    outcome.error = FileError::NotPossible;
    break;
  case FileOp::Open:
    outcome = job.mode == 0 ? Outcome{FileError::BadMode, 0} : disk_.open(job.name, job.mode);
    break;
  case FileOp::Close:
    outcome = disk_.close(job.file);
    break;
  case FileOp::Read:
    outcome = disk_.read(job.file, job.data.get(), job.size);
    break;
  case FileOp::Write:
    outcome = disk_.write(job.file, job.data.get(), job.size);
    break;
  case FileOp::SetPosition:
    outcome = disk_.setPosition(job.file, job.position);
    break;
  case FileOp::GetPosition:
    outcome = disk_.position(job.file);
    break;
  case FileOp::AtEnd:
    outcome = disk_.atEnd(job.file);
    break;
  case FileOp::Size:
    outcome = disk_.size(job.name);
    break;
  case FileOp::Times:
    outcome = disk_.times(job.name, job.answer.times);
    break;
  case FileOp::Delete:
    outcome = disk_.remove(job.name);
    break;
  case FileOp::Rename:
    outcome = disk_.rename(job.name, job.second);
    break;
  case FileOp::Copy:
    outcome = disk_.copy(job.name, job.second);
    break;
  case FileOp::OpenStream:
    outcome = openStream(job);
    break;
  case FileOp::CloseStream:
    outcome = closeStream(job.file);
    break;
  }
  job.answer.error = outcome.error;
  job.answer.value = outcome.value;
}

Outcome FileService::openStream(const Job &job) {
  if (job.mode == 0)
    return {FileError::BadMode, 0};
  Stream *stream = nullptr;
  for (size_t i = 0; i < kStreams && stream == nullptr; ++i)
    if (streams_[i].state.load(std::memory_order_acquire) == Stream::kFree)
      stream = &streams_[i];
  if (stream == nullptr)
    return {FileError::TooMany, 0};
  const bool reads = (job.mode & kFileWrite) == 0;
  // What needs memory comes before there is a file to be closed.
  if (!reads && stream->ring == nullptr)
    stream->ring = std::make_unique<std::byte[]>(Stream::kRing);
  stream->name = job.name;
  Outcome opened;
  stream->position = 0;
  if (reads) {
    opened = disk_.load(job.name, stream->image, settings_.largest);
    stream->length = stream->image.size();
  } else {
    opened = disk_.openFile(job.name, job.mode);
    stream->file = opened.error == FileError::None ? static_cast<int>(opened.value) : -1;
    stream->appends = (job.mode & kFileAppend) != 0;
    struct stat about {};
    stream->length = opened.error == FileError::None && ::fstat(stream->file, &about) == 0
                         ? static_cast<uint64_t>(about.st_size)
                         : 0;
    stream->position = stream->appends ? stream->length : 0;
  }
  if (opened.error != FileError::None)
    return {opened.error, 0};
  stream->put.store(0, std::memory_order_relaxed);
  stream->taken.store(0, std::memory_order_relaxed);
  stream->error.store(FileError::None, std::memory_order_relaxed);
  stream->lost = 0;
  const uint32_t generation = Handle::next(stream->generation.load(std::memory_order_relaxed));
  stream->generation.store(generation, std::memory_order_relaxed);
  stream->state.store(reads ? Stream::kReading : Stream::kWriting, std::memory_order_release);
  const Handle handle(static_cast<size_t>(stream - streams_.get()), generation);
  return {FileError::None, handle.number()};
}

Outcome FileService::closeStream(uint32_t file) {
  const Handle handle(file);
  if (handle.index() >= kStreams || streams_[handle.index()].generation != handle.generation() ||
      streams_[handle.index()].state.load(std::memory_order_acquire) == Stream::kFree)
    return {FileError::BadHandle, 0};
  return finishStream(streams_[handle.index()]);
}

void FileService::finishStreams() {
  for (size_t i = 0; i < kStreams; ++i)
    if (streams_[i].state.load(std::memory_order_acquire) != Stream::kFree)
      (void)finishStream(streams_[i]);
}

/// What is in the ring is written, the file closed, the place free.
Outcome FileService::finishStream(Stream &stream) {
  // A task that was at it when another one closed it; one that an exception stopped stays there.
  while (stream.user.load() != 0 && !ending_.load(std::memory_order_acquire))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  Outcome result;
  if (stream.file >= 0) {
    drain(stream);
    result.error = stream.error.load(std::memory_order_relaxed);
    const Outcome end = Disk::finish(stream.file, true);
    stream.file = -1;
    sayLosses(stream, result.error, end.error);
    if (result.error == FileError::None)
      result.error = end.error;
  }
  stream.image = {};
  stream.state.store(Stream::kFree, std::memory_order_release);
  return result;
}

/// `end`: of closing it.
void FileService::sayLosses(const Stream &stream, FileError error, FileError end) noexcept {
  try {
    if (stream.lost != 0)
      say("file '" + stream.name + "': " + reason(error) + "; " + std::to_string(stream.lost) +
          " bytes that the program wrote are lost");
    else if (end != FileError::None)
      say("file '" + stream.name + "': " + reason(end) +
          " when it is closed; what the program wrote may be lost");
  } catch (const std::bad_alloc &) {
    unsaid_.store(true);
  }
}

/// Writes what is in the ring, neighbours together.
void FileService::drain(Stream &stream) {
  uint64_t at = stream.taken.load(std::memory_order_relaxed);
  const uint64_t end = stream.put.load(std::memory_order_acquire);
  while (at != end) {
    uint64_t start = 0;
    uint64_t size = 0;
    while (at != end) {
      Stream::Record record;
      stream.copyOut(at, &record, sizeof record);
      if (size != 0 && record.position != start + size)
        break;
      if (size == 0)
        start = record.position;
      stream.copyOut(at + sizeof record, scratch_.data() + size, record.size);
      size += record.size;
      at += sizeof record + record.size;
    }
    if (stream.error.load(std::memory_order_relaxed) != FileError::None) {
      stream.lost += size;
    } else {
      const Outcome written = stream.appends
                                  ? Disk::writeAll(stream.file, scratch_.data(), size)
                                  : Disk::writeAllAt(stream.file, scratch_.data(), size, start);
      stream.lost += size - written.value;
      if (written.error != FileError::None)
        stream.error.store(written.error, std::memory_order_release);
    }
    stream.taken.store(at, std::memory_order_release);
  }
}

void FileService::drainAll() {
  for (size_t i = 0; i < kStreams; ++i)
    if (streams_[i].file >= 0 && streams_[i].state.load(std::memory_order_acquire) != Stream::kFree)
      drain(streams_[i]);
}

void FileService::say(std::string text) {
  const std::lock_guard lock(newsMutex_);
  news_.push_back(std::move(text));
}

} // namespace stride::system
