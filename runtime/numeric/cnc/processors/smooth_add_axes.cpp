#include "runtime/numeric/cnc/processors/smooth_add_axes.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {
namespace {

using exact::larger;

constexpr int32_t kAngles = 3; ///< A, B and C are the first ones.

/// The AxisBit of a bit of smoothAxes.
int32_t axisOf(int32_t number) noexcept { return kAxisA + number; }

bool hasBit(unsigned bits, int32_t n) noexcept {
  return (bits >> static_cast<unsigned>(n) & 1U) != 0;
}

bool movesInSpace(const PathObject &object) noexcept {
  const Vector3 way = placeOf(object.end) - placeOf(object.start);
  return isMotion(object) &&
         (isCurve(object.moveType) || way.x != 0.0 || way.y != 0.0 || way.z != 0.0);
}

/// The way in space; 0 where only other axes move.
double wayOf(const PathObject &object) noexcept {
  return movesInSpace(object) && exact::isPositive(object.length) ? object.length : 0.0;
}

// ---- how an axis goes over a range

/// From 0 to 1 over a way, with a slope that rises and falls evenly over the ramps.
struct Ramps {
  double length; ///< > 0 [u]
  double ramp;   ///< Of each of both. [u]

  double steepest() const noexcept { return 1.0 / (length - ramp); }
  double at(double way) const noexcept {
    const double left = length - way;
    if (way < ramp)
      return steepest() * way * way / (2.0 * ramp);
    if (left < ramp)
      return 1.0 - steepest() * left * left / (2.0 * ramp);
    return steepest() * (way - 0.5 * ramp);
  }
  double slope(double way) const noexcept {
    const double near = exact::smaller(way, length - way);
    return near < ramp ? steepest() * larger(near, 0.0) / ramp : steepest();
  }
};

/// What a range has in common.
struct Range {
  int32_t number; ///< Of the axis, by bit.
  double from;
  double to;
  Ramps ramps;
};

/// Sets the axis in an object that begins at a way of the range. Returns where it ends.
double placeObject(const Range &range, double begin, PathObject &object) noexcept {
  const double end = exact::smaller(begin + wayOf(object), range.ramps.length);
  const int32_t axis = axisOf(range.number);
  const double whole = range.to - range.from;
  const unsigned bit = 1U << static_cast<unsigned>(axis);
  object.start.coordinate[axis] = range.from + whole * range.ramps.at(begin);
  object.end.coordinate[axis] = range.from + whole * range.ramps.at(end);
  object.start.axes = static_cast<uint16_t>(object.start.axes | bit);
  object.end.axes = static_cast<uint16_t>(object.end.axes | bit);
  object.start.sProfile = static_cast<uint16_t>(object.start.sProfile & ~bit);
  object.end.sProfile = static_cast<uint16_t>(object.end.sProfile & ~bit);
  if (range.number < kAngles && isMotion(object)) {
    object.slopes |= static_cast<uint8_t>(1U << static_cast<unsigned>(range.number));
    object.startSlope[range.number] = whole * range.ramps.slope(begin);
    object.endSlope[range.number] = whole * range.ramps.slope(end);
  }
  if (isMotion(object) && !movesInSpace(object))
    (void)calculateLength(object);
  return end;
}

PathObject &waitingAt(const Output &output, int32_t n) noexcept {
  return *placeAhead(output.queue, static_cast<uint32_t>(n));
}

/// Ends the range of an axis with the last object that waits.
void closeRange(SmoothAddAxes &smooth, int32_t number, Output &output) noexcept {
  const int32_t first = smooth.begin[number];
  const int32_t last = smooth.waiting - 1;
  const int32_t axis = axisOf(number);
  smooth.begin[number] = -1;
  double length = 0.0;
  for (int32_t i = first; i <= last; ++i)
    length += wayOf(waitingAt(output, i));
  const PathObject &end = waitingAt(output, last);
  if (!(length > 0.0) || !hasBit(end.end.axes, axis))
    return;
  const double ramp = number < kAngles ? 0.5 * smooth.part * length : 0.0;
  const double target = end.end.coordinate[axis];
  const Range range{
      number, waitingAt(output, first).start.coordinate[axis], target, {length, ramp}};
  double way = 0.0;
  for (int32_t i = first; i <= last; ++i)
    way = placeObject(range, way, waitingAt(output, i));
  // Where the program wants it, to the last bit.
  for (int32_t i = last; i >= first; --i) {
    PathObject &object = waitingAt(output, i);
    object.end.coordinate[axis] = target;
    if (wayOf(object) > 0.0)
      break;
    object.start.coordinate[axis] = target;
  }
}

// ---- objects that wait

uint32_t reservedBy(const SmoothAddAxes &smooth, const Queue &queue) noexcept {
  if (smooth.raised)
    return smooth.reserved;
  return queue.reserved > kReservedPlaces ? queue.reserved : kReservedPlaces;
}

/// The queue is full when what others see and what waits fill it.
void tellReserved(SmoothAddAxes &smooth, Output &output) noexcept {
  Queue &queue = *output.queue;
  if (!smooth.raised && smooth.waiting == 0)
    return;
  smooth.reserved = reservedBy(smooth, queue);
  smooth.raised = smooth.waiting != 0;
  const auto waiting = static_cast<uint32_t>(smooth.waiting);
  setReserved(&queue, smooth.reserved + (waiting != 0 ? waiting - 1 : 0));
}

/// Lets others see the objects that no open range needs.
void release(SmoothAddAxes &smooth, Output &output) noexcept {
  int32_t count = smooth.waiting;
  for (const int32_t begin : smooth.begin)
    if (begin >= 0 && begin < count)
      count = begin;
  for (int32_t i = 0; i < count; ++i)
    (void)append(output.queue, &waitingAt(output, 0));
  smooth.waiting -= count;
  for (int32_t &begin : smooth.begin)
    if (begin >= 0)
      begin -= count;
}

Step refuse(SmoothAddAxes &smooth, StreamError error, Output &output) noexcept {
  smooth.waiting = 0;
  tellReserved(smooth, output);
  output.error = error;
  return Step::Failed;
}

/// Ends the ranges that do not go on with an object, and begins those that do with it.
void changeRanges(SmoothAddAxes &smooth, const PathObject &object, Output &output) noexcept {
  const bool jumps = object.moveType == MoveType::Jump;
  for (int32_t n = 0; n < kSmoothAxes; ++n) {
    const bool on = hasBit(object.smoothAxes, n) && !jumps;
    if (smooth.begin[n] >= 0 && (!on || hasBit(object.smoothAxes, kRangeBegins + n)))
      closeRange(smooth, n, output);
  }
  release(smooth, output);
  for (int32_t n = 0; n < kSmoothAxes; ++n)
    if (smooth.begin[n] < 0 && hasBit(object.smoothAxes, n) && isMotion(object))
      smooth.begin[n] = smooth.waiting;
}

bool isOpen(const SmoothAddAxes &smooth) noexcept {
  for (const int32_t begin : smooth.begin)
    if (begin >= 0)
      return true;
  return false;
}

} // namespace

void start(SmoothAddAxes &smooth) noexcept {
  for (int32_t &begin : smooth.begin)
    begin = -1;
  smooth.waiting = 0;
}

Step next(SmoothAddAxes &smooth, const Source &source, Output &output) noexcept {
  if (!(smooth.part >= 0.0 && smooth.part <= 1.0))
    return refuse(smooth, StreamError::SmoothingPart, output);
  PathObject object = source.object;
  changeRanges(smooth, object, output);
  if (!isOpen(smooth)) {
    tellReserved(smooth, output);
    (void)put(output, object);
    return Step::Took;
  }
  if (object.probe != 0)
    return refuse(smooth, StreamError::ProbeInRange, output);
  tellReserved(smooth, output);
  const auto waiting = static_cast<uint32_t>(smooth.waiting);
  if (waiting + reservedBy(smooth, *output.queue) > capacityOf(output.queue))
    return refuse(smooth, StreamError::RangeTooLong, output);
  if (isMotion(object) && calculateLength(object) != ShapeError::None)
    return refuse(smooth, StreamError::InvalidObject, output);
  if (!prepare(output.queue, waiting, &object))
    return Step::Again;
  ++smooth.waiting;
  tellReserved(smooth, output);
  return Step::Took;
}

Step finish(SmoothAddAxes &smooth, Ending /*ending*/, Output &output) noexcept {
  for (int32_t n = 0; n < kSmoothAxes; ++n)
    if (smooth.begin[n] >= 0)
      closeRange(smooth, n, output);
  release(smooth, output);
  tellReserved(smooth, output);
  return Step::Took;
}

void settle(SmoothAddAxes &smooth, Queue *queue, bool runs) noexcept {
  if (!runs)
    smooth.waiting = 0;
  Output output{queue, 0, StreamError::None};
  if (smooth.raised && smooth.waiting == 0)
    tellReserved(smooth, output);
}

} // namespace stride::cnc
