// Where the objects of a queue are, so that those near another one are found without looking at
// all: boxes around runs of places of its memory, in two levels. It is kept up to date as objects
// come. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_QUEUE_INDEX_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_QUEUE_INDEX_HPP

#include "runtime/numeric/cnc/processors/track_crossing.hpp"
#include "runtime/numeric/cnc/queue.hpp"

namespace stride::cnc {

inline constexpr uint32_t kLeaves = 8192;
/// Objects that are looked at in one call, at most.
inline constexpr uint32_t kIndexedPerCall = 64;

/// A box in half the memory, and never smaller.
struct SmallBox {
  float left, right, low, high;
};

inline bool overlap(const SmallBox &a, const SmallBox &b) noexcept {
  return a.left <= b.right && b.left <= a.right && a.low <= b.high && b.low <= a.high;
}

SmallBox smallBoxOf(const Box &box) noexcept;

/// All zeros at first.
struct QueueIndex {
  const PathObject *memory; ///< Of the queue, and
  uint32_t places;          ///< how many places: with others it begins anew.
  uint32_t perLeaf;         ///< Places of a leaf.
  uint32_t indexed;         ///< Objects from the first one on that are known.
  uint32_t first;           ///< Place of the first object.
  Plane plane;
  SmallBox nodes[2 * kLeaves]; ///< The root is [1], node n has [2 n] and [2 n + 1] below it.
};

/// Takes over what has been appended, at most kIndexedPerCall objects. False: there are more.
bool updateIndex(QueueIndex &index, const Queue *queue, const Plane &plane) noexcept;

/// The first object of the queue is about to be removed.
void forgetFirst(QueueIndex &index) noexcept;

/// What lies around an object, not tightly; of one without a shape nothing.
Box roughBox(const PathObject &object, const Plane &plane) noexcept;

/// Calls visit(n, object) for the known objects of a leaf that are near the box.
template <class Visit>
void visitLeaf(const QueueIndex &index, uint32_t leaf, const Box &box, uint32_t last,
               Visit &visit) noexcept {
  const uint32_t begin = leaf * index.perLeaf;
  for (uint32_t place = begin; place < begin + index.perLeaf && place < index.places; ++place) {
    const uint32_t n =
        place >= index.first ? place - index.first : place + index.places - index.first;
    if (n == 0 || n > last || n >= index.indexed)
      continue;
    const PathObject &object = index.memory[place];
    if (overlap(roughBox(object, index.plane), box))
      visit(n, object);
  }
}

/// Calls visit(n, object) for known objects near the box, n > 0 places after the first one and not
/// further than `last`, in any order.
template <class Visit>
void visitNear(const QueueIndex &index, const Box &box, uint32_t last, Visit visit) noexcept {
  const SmallBox rough = smallBoxOf(box);
  uint32_t stack[32];
  int32_t depth = 0;
  stack[depth++] = 1;
  while (depth > 0) {
    const uint32_t node = stack[--depth];
    if (!overlap(index.nodes[node], rough))
      continue;
    if (node >= kLeaves) {
      visitLeaf(index, node - kLeaves, box, last, visit);
      continue;
    }
    stack[depth++] = 2 * node;
    stack[depth++] = 2 * node + 1;
  }
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_QUEUE_INDEX_HPP
