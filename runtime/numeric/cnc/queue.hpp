// The queue that path objects are handed on in: SMC_OUTQUEUE, a ring in memory of the user. Objects
// begin at the first address there that they can begin at, and one place always stays free, so that
// an empty queue and a full one differ. One task may append while another one removes the first
// object: each writes members of its own only. Free of the C++ standard library: linked into every
// application.
// Source: SoftMotion V2.3 manual, section 6.6; history and reserve are SoftMotion 3's.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_QUEUE_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_QUEUE_HPP

#include "runtime/numeric/cnc/path_object.hpp"

namespace stride::cnc {

/// Queue::structId of every queue.
inline constexpr uint16_t kQueueStructId = 0x9878;
/// How many places are free in a full queue, at least.
inline constexpr uint32_t kReservedPlaces = 3;

/// Queue::generator: who has filled it.
enum Generator : uint8_t {
  kByDecoder = 1,
  kByAvoidLoop = 10,
  kByLimitCircularVelocities = 11,
  kByRoundPath = 12,
  kBySmoothPath = 13,
  kByToolCorr = 14,
  kByRotateQueue = 30,
  kByScaleQueue = 31,
  kByTranslateQueue = 32,
  kByNobody = 250,
  kByCheckVelocities = 254,
  kByEditor = 255,
};

/// SMC_OUTQUEUE. The user sets `buffer` and `size` and leaves the rest 0.
struct Queue {
  uint16_t structId;      ///< kQueueStructId
  uint8_t *buffer;        ///< The user's memory.
  uint32_t size;          ///< Of that. [bytes]
  uint32_t readPosition;  ///< Of the first object, from where objects begin. [bytes]
  uint32_t writePosition; ///< Of the place for the next one. [bytes] May be the end of the memory.
  uint8_t full;           ///< bFull, as of the last change; isFull() looks.
  uint8_t endOfList;      ///< bEndOfList: the path is complete.
  uint8_t generator;      ///< Generator
  // SoftMotion 3:
  uint32_t capacity;         ///< nCapacity: places, where size is 0.
  uint8_t recheckVelocities; ///< bReCheckVelocities
  char programName[81];      ///< strProgramName
  uint32_t reserved;         ///< nNumReservedEntries: how many places are free in a full queue.
  // Stride's own, hidden in ST. Of who appends:
  uint32_t path;         ///< Number of the path that is being appended.
  uint32_t pathPosition; ///< Where it begins. [bytes]
  uint32_t moved;        ///< Places after writePosition that objects were moved away from.
  // Of who removes:
  uint32_t pathSeen;   ///< Number of the path that objects are removed of.
  uint32_t removed;    ///< How many of it have been.
  uint32_t removedEnd; ///< readPosition thereafter. [bytes]
  uint32_t pathRead;   ///< Number of the last path that has been removed to its end.
  // Of SMC_CheckVelocities:
  double dryRunVelocity; ///< Greatest velocity, override included; 0: none. [u/s]
  uint32_t checkedEnd;   ///< writePosition up to which it has looked, plus 1; 0: it looks at none.
};

/// What is wrong with a queue.
enum class QueueError : uint8_t {
  None,
  NoQueue,   ///< Null, or something else.
  NoBuffer,  ///< Null, or without room for two objects.
  Positions, ///< Outside of the memory, or between two objects.
};

QueueError checkQueue(const Queue *queue) noexcept;

/// How many objects fit, one place left free; 0 if the queue is unusable.
uint32_t capacityOf(const Queue *queue) noexcept;

/// Where objects begin in the memory, and how many have room; null and 0 if that is unusable.
PathObject *placesOf(const Queue *queue, uint32_t &count) noexcept;

/// How many objects there are; 0 if the queue is unusable.
uint32_t countOf(const Queue *queue) noexcept;

/// Whether who fills the queue shall wait, and who reads it may begin: no more than the reserved
/// places are free. TRUE for an unusable queue.
bool isFull(const Queue *queue) noexcept;

/// Appends a copy. Where it is, or null: the queue is unusable or has not one place left.
PathObject *append(Queue *queue, const PathObject *object) noexcept;

/// The n-th free place (0) after the last object: who appends may prepare objects there that nobody
/// sees before they are appended, each where it is. Null: there is no such place.
PathObject *placeAhead(const Queue *queue, uint32_t n) noexcept;

/// Writes a copy into placeAhead(n). False: there is none.
bool prepare(Queue *queue, uint32_t n, const PathObject *object) noexcept;

/// Says how many places shall be free in a full queue, at least kReservedPlaces.
void setReserved(Queue *queue, uint32_t places) noexcept;

/// The n-th object from the first one (0) on, or null.
PathObject *objectAt(const Queue *queue, uint32_t n) noexcept;

/// The n-th object from the last one (0) back, or null.
PathObject *objectFromEnd(const Queue *queue, uint32_t n) noexcept;

/// How many objects at the end of the queue have been appended since its writePosition was
/// `position`; all of them if that is no position.
uint32_t appendedSince(const Queue *queue, uint32_t position) noexcept;

/// How many objects at the end of the queue SMC_CheckVelocities has still to look at: one task may
/// append and check, while another one drives what is checked.
uint32_t uncheckedOf(const Queue *queue) noexcept;

/// Says up to which writePosition SMC_CheckVelocities has looked, or that it looks no longer: then
/// nobody waits for it.
void tellChecked(Queue *queue, uint32_t position) noexcept;
void tellNobodyChecks(Queue *queue) noexcept;

/// Puts a copy in the place of the n-th object.
bool replaceAt(Queue *queue, uint32_t n, const PathObject *object) noexcept;

/// Removes the n-th object. Any other than the first one moves the objects after it, and only who
/// appends may do that.
bool removeAt(Queue *queue, uint32_t n) noexcept;

/// How many removed objects of this path are still as they were.
uint32_t historyOf(const Queue *queue) noexcept;

/// The n-th of them, from the one that was removed last (0) back; or null.
PathObject *objectOfHistory(const Queue *queue, uint32_t n) noexcept;

/// Whether the queue is to become empty before it is filled again: an object says so
/// (kSynchronise).
bool isSyncing(const Queue *queue) noexcept;

/// Puts all removed objects of the path back. False if one of them is lost.
bool restore(Queue *queue) noexcept;

/// Empties the queue and forgets the path; the memory stays.
bool clear(Queue *queue) noexcept;

/// Says how large the memory is. False if there are objects in the queue and that changes anything.
bool setSize(Queue *queue, uint32_t bytes) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_QUEUE_HPP
