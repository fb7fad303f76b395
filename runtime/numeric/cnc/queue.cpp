#include "runtime/numeric/cnc/queue.hpp"

namespace stride::cnc {
namespace {

constexpr uint32_t kStep = sizeof(PathObject);

/// What the other task writes is read once, and seen together with what it wrote before.
template <class Value> Value readShared(const Value &variable) noexcept {
  return __atomic_load_n(&variable, __ATOMIC_ACQUIRE);
}
template <class Value> void writeShared(Value &variable, Value value) noexcept {
  __atomic_store_n(&variable, value, __ATOMIC_RELEASE);
}

/// A queue in places instead of bytes, as it is at this moment.
struct Ring {
  PathObject *objects;
  uint32_t places;
  uint32_t read;  ///< < places
  uint32_t write; ///< < places, or equal if the ring is filled to the end of its memory.

  uint32_t count() const noexcept { return write >= read ? write - read : places - read + write; }
  uint32_t free() const noexcept { return places - count(); }
  /// n < 2 * places
  uint32_t wrapped(uint32_t n) const noexcept { return n < places ? n : n - places; }
};

/// Where objects begin and how many fit.
QueueError openMemory(const Queue *queue, Ring &ring) noexcept {
  const auto address = reinterpret_cast<uintptr_t>(queue);
  if (queue == nullptr || address % alignof(Queue) != 0 || queue->structId != kQueueStructId)
    return QueueError::NoQueue;
  const auto buffer = reinterpret_cast<uintptr_t>(queue->buffer);
  const uint64_t skipped =
      (alignof(PathObject) - buffer % alignof(PathObject)) % alignof(PathObject);
  const uint64_t bytes =
      queue->size != 0 ? uint64_t{queue->size} : uint64_t{queue->capacity} * kStep + skipped;
  if (queue->buffer == nullptr || bytes < skipped + 2ULL * kStep)
    return QueueError::NoBuffer;
  // Positions are of 32 bits.
  const uint64_t places = (bytes - skipped) / kStep;
  constexpr uint64_t kMost = UINT32_MAX / kStep;
  ring.places = static_cast<uint32_t>(places < kMost ? places : kMost);
  ring.objects = reinterpret_cast<PathObject *>(buffer + skipped);
  return QueueError::None;
}

QueueError openRing(const Queue *queue, Ring &ring) noexcept {
  const QueueError error = openMemory(queue, ring);
  if (error != QueueError::None)
    return error;
  const uint32_t read = readShared(queue->readPosition);
  const uint32_t write = readShared(queue->writePosition);
  ring.read = read / kStep;
  ring.write = write / kStep;
  if (read % kStep != 0 || write % kStep != 0 || ring.read > ring.places ||
      ring.write > ring.places)
    return QueueError::Positions;
  // Both at the end of the memory: an empty queue.
  if (read == write && ring.write == ring.places)
    ring.write = 0;
  if (ring.read == ring.places)
    ring.read = 0;
  return QueueError::None;
}

bool usable(const Queue *queue, Ring &ring) noexcept {
  return openRing(queue, ring) == QueueError::None;
}

bool isFull(const Queue &queue, const Ring &ring) noexcept {
  const uint32_t told = readShared(queue.reserved);
  const uint32_t asked = told > kReservedPlaces ? told : kReservedPlaces;
  const uint32_t reserved = asked < ring.places ? asked : ring.places - 1;
  return ring.free() <= reserved;
}

/// bFull, which both tasks write: whoever comes last says what is so.
void tellFull(Queue &queue, const Ring &ring) noexcept {
  writeShared(queue.full, static_cast<uint8_t>(isFull(queue, ring)));
}

/// How many objects of this path have been removed; 0 if somebody else has moved the first one.
uint32_t removedOf(const Queue &queue) noexcept {
  const bool known =
      queue.removedEnd == queue.readPosition && queue.pathSeen == readShared(queue.path);
  return known ? queue.removed : 0;
}

/// Whether the objects lie in a row up to the end of the memory, which they may fill.
bool endsWithMemory(const Queue &queue, const Ring &ring) noexcept {
  return readShared(queue.writePosition) == ring.places * kStep;
}

/// How many places hold objects that have been removed at the front. One is left out at least,
/// which may just be written.
uint32_t kept(const Queue &queue, const Ring &ring) noexcept {
  if (endsWithMemory(queue, ring))
    return queue.readPosition / kStep;
  const uint32_t moved = readShared(queue.moved);
  const uint32_t others = moved > 1 ? moved : 1;
  return ring.free() > others ? ring.free() - others : 0;
}

void removeFirst(Queue &queue, Ring &ring) noexcept {
  const uint32_t path = readShared(queue.path);
  const bool begins = queue.pathSeen != path && queue.pathPosition == ring.read * kStep;
  queue.removed = begins || queue.removedEnd != queue.readPosition ? 1 : queue.removed + 1;
  if (begins)
    queue.pathSeen = path;
  ++ring.read;
  // At the end of the memory with nothing after it, the position stays there.
  if (ring.read == ring.places && ring.write != ring.places)
    ring.read = 0;
  if (ring.count() == 0 && readShared(queue.endOfList) != 0)
    writeShared(queue.pathRead, path);
  queue.removedEnd = ring.read * kStep;
  writeShared(queue.readPosition, ring.read * kStep);
}

} // namespace

QueueError checkQueue(const Queue *queue) noexcept {
  Ring ring;
  return openRing(queue, ring);
}

uint32_t capacityOf(const Queue *queue) noexcept {
  Ring ring;
  return usable(queue, ring) ? ring.places - 1 : 0;
}

PathObject *placesOf(const Queue *queue, uint32_t &count) noexcept {
  Ring ring{};
  const bool there = openMemory(queue, ring) == QueueError::None;
  count = there ? ring.places : 0;
  return there ? ring.objects : nullptr;
}

uint32_t countOf(const Queue *queue) noexcept {
  Ring ring;
  return usable(queue, ring) ? ring.count() : 0;
}

bool isFull(const Queue *queue) noexcept {
  Ring ring;
  return !usable(queue, ring) || isFull(*queue, ring);
}

PathObject *append(Queue *queue, const PathObject *object) noexcept {
  Ring ring;
  if (object == nullptr || !usable(queue, ring) || ring.free() <= 1)
    return nullptr;
  if (ring.write == ring.places)
    ring.write = 0;
  // What was before has been read to its end: this object begins a path.
  if (readShared(queue->pathRead) == queue->path) {
    queue->pathPosition = ring.write * kStep;
    writeShared(queue->path, queue->path + 1);
  }
  PathObject &place = ring.objects[ring.write];
  copyObject(place, *object);
  ring.write = ring.wrapped(ring.write + 1);
  if (queue->moved != 0)
    writeShared(queue->moved, queue->moved - 1);
  writeShared(queue->writePosition, ring.write * kStep);
  tellFull(*queue, ring);
  return &place;
}

PathObject *placeAhead(const Queue *queue, uint32_t n) noexcept {
  Ring ring;
  if (!usable(queue, ring) || n + 1 >= ring.free())
    return nullptr;
  return ring.objects + ring.wrapped(ring.wrapped(ring.write) + n);
}

bool prepare(Queue *queue, uint32_t n, const PathObject *object) noexcept {
  PathObject *place = placeAhead(queue, n);
  if (place == nullptr || object == nullptr)
    return false;
  // What was there has been removed, and is now lost.
  if (queue->moved <= n)
    writeShared(queue->moved, n + 1);
  copyObject(*place, *object);
  return true;
}

void setReserved(Queue *queue, uint32_t places) noexcept {
  Ring ring;
  writeShared(queue->reserved, places);
  if (usable(queue, ring))
    tellFull(*queue, ring);
}

PathObject *objectAt(const Queue *queue, uint32_t n) noexcept {
  Ring ring;
  return usable(queue, ring) && n < ring.count() ? ring.objects + ring.wrapped(ring.read + n)
                                                 : nullptr;
}

PathObject *objectFromEnd(const Queue *queue, uint32_t n) noexcept {
  Ring ring;
  return usable(queue, ring) && n < ring.count()
             ? ring.objects + ring.wrapped(ring.read + ring.count() - 1 - n)
             : nullptr;
}

uint32_t appendedSince(const Queue *queue, uint32_t position) noexcept {
  Ring ring;
  if (!usable(queue, ring))
    return 0;
  const uint32_t place = position / kStep;
  if (position % kStep != 0 || place > ring.places)
    return ring.count();
  // At the end of the memory or at its beginning: the same.
  const uint32_t since =
      (ring.write % ring.places + ring.places - place % ring.places) % ring.places;
  const bool all = place != ring.write && since == 0;
  return all || since > ring.count() ? ring.count() : since;
}

uint32_t uncheckedOf(const Queue *queue) noexcept {
  const uint32_t end = readShared(queue->checkedEnd);
  return end != 0 ? appendedSince(queue, end - 1) : 0;
}

void tellChecked(Queue *queue, uint32_t position) noexcept {
  writeShared(queue->checkedEnd, position + 1);
}

void tellNobodyChecks(Queue *queue) noexcept { writeShared(queue->checkedEnd, 0U); }

bool replaceAt(Queue *queue, uint32_t n, const PathObject *object) noexcept {
  PathObject *place = objectAt(queue, n);
  if (place == nullptr || object == nullptr)
    return false;
  copyObject(*place, *object);
  return true;
}

bool removeAt(Queue *queue, uint32_t n) noexcept {
  Ring ring;
  if (!usable(queue, ring) || n >= ring.count())
    return false;
  if (n == 0) {
    removeFirst(*queue, ring);
  } else {
    for (uint32_t i = n; i + 1 < ring.count(); ++i)
      copyObject(ring.objects[ring.wrapped(ring.read + i)],
                 ring.objects[ring.wrapped(ring.read + i + 1)]);
    ring.write = ring.wrapped(ring.read + ring.count() - 1);
    writeShared(queue->moved, queue->moved + 1);
    writeShared(queue->writePosition, ring.write * kStep);
  }
  tellFull(*queue, ring);
  return true;
}

uint32_t historyOf(const Queue *queue) noexcept {
  Ring ring;
  if (!usable(queue, ring))
    return 0;
  const uint32_t removed = removedOf(*queue);
  const uint32_t most = kept(*queue, ring);
  return removed < most ? removed : most;
}

PathObject *objectOfHistory(const Queue *queue, uint32_t n) noexcept {
  Ring ring;
  return usable(queue, ring) && n < historyOf(queue)
             ? ring.objects + ring.wrapped(ring.read + ring.places - 1 - n)
             : nullptr;
}

bool isSyncing(const Queue *queue) noexcept {
  Ring ring;
  if (!usable(queue, ring))
    return false;
  for (uint32_t n = 0; n < ring.count(); ++n) {
    const PathObject &object = ring.objects[ring.wrapped(ring.read + n)];
    if (object.moveType == MoveType::Function && object.switchId[0] == kSynchronise)
      return true;
  }
  return false;
}

bool restore(Queue *queue) noexcept {
  Ring ring;
  if (!usable(queue, ring))
    return false;
  const uint32_t removed = removedOf(*queue);
  if (removed > kept(*queue, ring))
    return false;
  if (endsWithMemory(*queue, ring)) {
    ring.read = queue->readPosition / kStep - removed;
    ring.write = ring.places;
  } else {
    ring.read = ring.wrapped(ring.read + ring.places - removed);
  }
  queue->removed = 0;
  queue->removedEnd = ring.read * kStep;
  writeShared(queue->pathRead, readShared(queue->path) - 1);
  writeShared(queue->readPosition, ring.read * kStep);
  tellFull(*queue, ring);
  return true;
}

bool clear(Queue *queue) noexcept {
  Ring ring;
  if (openMemory(queue, ring) == QueueError::NoQueue)
    return false;
  queue->readPosition = queue->writePosition = 0;
  queue->full = queue->endOfList = 0;
  queue->path = queue->pathPosition = queue->moved = queue->pathSeen = queue->removed =
      queue->removedEnd = queue->pathRead = queue->checkedEnd = 0;
  return true;
}

bool setSize(Queue *queue, uint32_t bytes) noexcept {
  Ring ring;
  if (openMemory(queue, ring) == QueueError::NoQueue)
    return false;
  if (bytes != queue->size && countOf(queue) != 0)
    return false;
  if (bytes != queue->size) {
    clear(queue);
    queue->size = bytes;
    queue->capacity = bytes / kStep;
  }
  return true;
}

} // namespace stride::cnc
