#include "runtime/numeric/cnc/processors/queue_index.hpp"

namespace stride::cnc {
namespace {

constexpr Box kEmpty{exact::kInfinity, -exact::kInfinity, exact::kInfinity, -exact::kInfinity};

constexpr SmallBox kNothing{__builtin_huge_valf(), -__builtin_huge_valf(), __builtin_huge_valf(),
                            -__builtin_huge_valf()};

float below(double x) noexcept {
  constexpr float kRounding = 1.2e-7F;
  const auto f = static_cast<float>(x);
  return f - (__builtin_fabsf(f) * kRounding + 1e-30F);
}

SmallBox unite(const SmallBox &a, const SmallBox &b) noexcept {
  return {a.left < b.left ? a.left : b.left, a.right > b.right ? a.right : b.right,
          a.low < b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}

void add(Box &box, const Box &other) noexcept {
  box.left = exact::smaller(box.left, other.left);
  box.right = exact::larger(box.right, other.right);
  box.low = exact::smaller(box.low, other.low);
  box.high = exact::larger(box.high, other.high);
}

Box around(const Vector3 &a, const Vector3 &b) noexcept {
  return {exact::smaller(a.x, b.x), exact::larger(a.x, b.x), exact::smaller(a.y, b.y),
          exact::larger(a.y, b.y)};
}

void clear(QueueIndex &index, const PathObject *memory, uint32_t places, const Plane &plane,
           uint32_t first) noexcept {
  index.memory = memory;
  index.places = places;
  index.perLeaf = (places + kLeaves - 1) / kLeaves;
  index.indexed = 0;
  index.first = first;
  index.plane = plane;
  for (SmallBox &box : index.nodes)
    box = kNothing;
}

/// A place is filled for the first time, or again.
void put(QueueIndex &index, uint32_t place) noexcept {
  const uint32_t leaf = place / index.perLeaf;
  const SmallBox box = smallBoxOf(roughBox(index.memory[place], index.plane));
  // Objects further on in the same leaf that are still there keep the box as it is.
  const bool isBegin = place % index.perLeaf == 0;
  const bool isShared = index.first / index.perLeaf == leaf && index.first > place;
  uint32_t node = kLeaves + leaf;
  index.nodes[node] = isBegin && !isShared ? box : unite(index.nodes[node], box);
  for (node /= 2; node > 0; node /= 2)
    index.nodes[node] = isBegin ? unite(index.nodes[uint64_t{2} * node], index.nodes[2 * node + 1])
                                : unite(index.nodes[node], box);
}

} // namespace

SmallBox smallBoxOf(const Box &box) noexcept {
  return {below(box.left), -below(-box.right), below(box.low), -below(-box.high)};
}

Box roughBox(const PathObject &object, const Plane &plane) noexcept {
  switch (object.moveType) {
  case MoveType::Line:
  case MoveType::Positioning:
    return around(inPlane(object.start, plane), inPlane(object.end, plane));
  case MoveType::Clockwise:
  case MoveType::Counterclockwise: {
    // The ends may be off by 1 %, and the circle goes through them.
    Box box = around(inPlane(object.start, plane), inPlane(object.end, plane));
    const double r = exact::fabs(object.shape[2]) * 1.05;
    add(box, {object.shape[0] - r, object.shape[0] + r, object.shape[1] - r, object.shape[1] + r});
    return box;
  }
  case MoveType::Jump:
  case MoveType::Function:
    return kEmpty;
  default:
    break;
  }
  Track track;
  return trackOf(object, plane, track) == TrackError::None ? boxOf(track) : kEmpty;
}

bool updateIndex(QueueIndex &index, const Queue *queue, const Plane &plane) noexcept {
  uint32_t places = 0;
  const PathObject *memory = placesOf(queue, places);
  const uint32_t first = queue->readPosition / static_cast<uint32_t>(sizeof(PathObject)) % places;
  const bool isSame = index.memory == memory && index.places == places && index.first == first &&
                      isSamePlane(index.plane, plane);
  if (!isSame)
    clear(index, memory, places, plane, first);
  const uint32_t count = countOf(queue);
  if (index.indexed > count) // somebody else has removed objects
    clear(index, memory, places, plane, first);
  for (uint32_t i = 0; i < kIndexedPerCall && index.indexed < count; ++i) {
    put(index, (first + index.indexed) % places);
    ++index.indexed;
  }
  return index.indexed == count;
}

void forgetFirst(QueueIndex &index) noexcept {
  if (index.indexed == 0)
    return;
  --index.indexed;
  index.first = index.first + 1 < index.places ? index.first + 1 : 0;
}

} // namespace stride::cnc
