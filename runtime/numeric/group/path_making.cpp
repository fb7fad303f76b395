#include "runtime/numeric/group/path_making.hpp"

#include "runtime/numeric/group/carried.hpp"
#include "runtime/numeric/path/blend.hpp"

namespace stride::group {
namespace {

using exact::kInfinity;
using exact::larger;
using exact::smaller;

constexpr double kLegParts = 64.0;    ///< A strip of a leg need not be shorter than one of these.
constexpr double kCornerParts = 16.0; ///< Likewise of a corner.
constexpr int32_t kMostCornerStrips = 48;
constexpr double kGrowth = 2.0; ///< Of strips, at most, from one to the next.
/// A corner shorter than this part of a leg is none.
constexpr double kLeastCut = 1e-6;

Track trackOf(const Leg &leg) noexcept {
  return {&leg, [](const void *track, const Series &way, PathPlace &place) {
            placeAt(*static_cast<const Leg *>(track), way, place);
          }};
}
Track trackOf(const Corner &corner) noexcept {
  return {&corner, [](const void *track, const Series &way, PathPlace &place) {
            placeAt(*static_cast<const Corner *>(track), way, place);
          }};
}

/// The arm with the limits and the configuration of a movement.
struct OrderedArm {
  AxisLimits limits[kAxes];
  Arm arm;

  /// The limits that decide how large corners are: an allowance does not change the path.
  OrderedArm(const Arm &all, const Order &order) noexcept
      : arm{all.kinematics, all.joints, all.more, limits, order.configuration} {
    for (int32_t k = 0; k < kAxes; ++k) {
      limits[k] = all.limits[k];
      limits[k].velocity *= order.velocityFactor;
      limits[k].acceleration *= order.accelerationFactor;
      limits[k].jerk *= order.jerkFactor;
      if (!order.isShared)
        continue;
      limits[k].velocity *= order.shares.velocity[k];
      limits[k].acceleration *= order.shares.acceleration[k];
      limits[k].jerk *= order.shares.jerk[k];
    }
  }
  OrderedArm(const Arm &all, const Order &order, const Allowance &allowance) noexcept
      : OrderedArm(all, order) {
    for (int32_t k = 0; k < kAxes; ++k) {
      AxisLimits &axis = limits[k];
      const AxisCap &cap = allowance.axis[k];
      axis.velocity = smaller(axis.velocity, cap.velocity);
      axis.acceleration = allowance.axisAcceleration * smaller(axis.acceleration, cap.acceleration);
      axis.jerk = allowance.axisJerk * smaller(axis.jerk, cap.jerk);
    }
  }
};

double chosen(CornerSpeed speed, double first, double second) noexcept {
  switch (speed) {
  case CornerSpeed::Smaller:
    return smaller(first, second);
  case CornerSpeed::First:
    return first;
  case CornerSpeed::Second:
    return second;
  case CornerSpeed::Greater:
    break;
  }
  return larger(first, second);
}

PathLimits allowed(const PathLimits &path, const Allowance &allowance) noexcept {
  return {path.velocity,
          allowance.pathAcceleration * smaller(path.acceleration, allowance.acceleration),
          allowance.pathAcceleration * smaller(path.deceleration, allowance.deceleration),
          allowance.pathJerk * smaller(path.jerk, allowance.jerk)};
}

/// What limits the tool in a corner.
PathLimits cornerLimits(const Movement &before, const Movement &after) noexcept {
  const PathLimits &a = before.order.path;
  const PathLimits &b = after.order.path;
  const CornerSpeed speed = after.order.cornerSpeed;
  return {chosen(speed, a.velocity, b.velocity), chosen(speed, a.acceleration, b.acceleration),
          chosen(speed, a.deceleration, b.deceleration), chosen(speed, a.jerk, b.jerk)};
}

/// The greatest velocity of a movement where its leg ends or begins [u/s], and the way between that
/// and rest [u].
struct Ramp {
  double velocity, way;
};
Ramp rampOf(const GroupMotion &group, const Arm &arm, const Movement &movement,
            bool atEnd) noexcept {
  const double(&reference)[kAxes] = group.lookedReference;
  const Leg &leg = movement.leg;
  OrderedArm ordered(arm, movement.order);
  const CarriedTrack carried(group, trackOf(leg), 0.0, movement.order.path);
  constexpr double kPart = 0.05; // of the leg, whose limits are looked at
  Look look{};
  look.from = atEnd ? (1.0 - kPart) * leg.length : 0.0;
  look.to = atEnd ? leg.length : kPart * leg.length;
  look.least = leg.length;
  for (int32_t k = 0; k < kAxes; ++k)
    look.reference[k] = reference[k];
  carried.yield(ordered.arm, look.from, reference, ordered.limits);
  path::Strip strip{};
  if (limitStrip(ordered.arm, carried.track(), movement.order.path, look, strip) != Obstacle::None)
    return {0.0, 0.0};
  const double velocity = exact::sqrt(path::squareIn(strip, 1.0));
  const double rate = smaller(atEnd ? strip.deceleration : strip.acceleration, 1.0 / strip.along);
  return {velocity,
          0.5 * velocity * path::rampTime(velocity, rate, static_cast<double>(strip.jerk))};
}

/// How much of a leg's way a unit of distance is: of the tool's path, or of the axes' places.
double wayPerDistance(const Leg &leg) noexcept {
  if (leadsTool(leg))
    return 1.0;
  double square = 0.0;
  for (int32_t k = 0; k < kArmAxes; ++k)
    square += leg.delta[k] * leg.delta[k];
  return square > 0.0 ? leg.length / exact::sqrt(square) : 0.0;
}

/// How far before and after the place where two legs meet a corner begins and ends.
struct Cuts {
  double before, after;
};

Cuts cutsOf(const GroupMotion &group, const Arm &arm, const Movement &before,
            const Movement &after) noexcept {
  const double known = group.lookedWay;
  const Order &order = after.order;
  const double mostBefore = smaller(0.5 * before.leg.length, before.leg.length - known);
  const double mostAfter = 0.5 * after.leg.length;
  if (order.transition == Transition::Distance) {
    const double perBefore = wayPerDistance(before.leg);
    const double perAfter = wayPerDistance(after.leg);
    const double distance =
        smaller(order.transitionValue, smaller(mostBefore / perBefore, mostAfter / perAfter));
    return {distance * perBefore, distance * perAfter};
  }
  if (order.transition != Transition::StartVelocity)
    return {0.0, 0.0};
  const Cuts cuts{smaller(mostBefore, order.transitionValue * rampOf(group, arm, before, true).way),
                  smaller(mostAfter, order.transitionValue * rampOf(group, arm, after, false).way)};
  // A corner that took far more of the one would bend at its very end, and be crept through.
  constexpr double kMostTimes = 16.0;
  return {smaller(cuts.before, kMostTimes * cuts.after),
          smaller(cuts.after, kMostTimes * cuts.before)};
}

/// Whether the path turns round where two legs meet, so that there is no corner.
bool turnsRound(const Leg &before, const Leg &after) noexcept {
  if (!leadsTool(before) || !leadsTool(after))
    return false;
  PathPlace end;
  PathPlace begin;
  placeAt(before, growing(before.length, 1.0), end);
  placeAt(after, growing(0.0, 1.0), begin);
  const auto direction = [](const PathPlace &place) {
    return Vector3{place.tool.place(0).c[1], place.tool.place(1).c[1], place.tool.place(2).c[1]};
  };
  return path::turnBetween(direction(end), direction(begin)) > path::kMaxTurn;
}

/// The axes at a way along a leg, for a corner where they lead.
bool axesEndOf(const Arm &arm, const Movement &movement, double way, double cut,
               const double (&reference)[kAxes], AxesEnd &end) noexcept {
  const OrderedArm ordered(arm, movement.order);
  PathPlace place;
  placeAt(movement.leg, growing(way, 1.0), place);
  end.cut = cut;
  return axesAt(ordered.arm, place, reference, end.axes) == Obstacle::None;
}

/// Makes the corner from one movement to the next. False: there is none.
bool makeCorner(const GroupMotion &group, const Arm &arm, const Movement &before, Movement &after,
                Cuts cuts) noexcept {
  if (!(cuts.before > kLeastCut * before.leg.length) ||
      !(cuts.after > kLeastCut * after.leg.length) || turnsRound(before.leg, after.leg))
    return false;
  if (leadsTool(before.leg) && leadsTool(after.leg) && before.leg.given == after.leg.given) {
    after.corner = toolCorner(before.leg, cuts.before, after.leg, cuts.after);
    return exact::isPositive(after.corner.length) && after.corner.length < kInfinity;
  }
  AxesEnd begin{};
  AxesEnd end{};
  if (!axesEndOf(arm, before, before.leg.length - cuts.before, cuts.before, group.lookedReference,
                 begin))
    return false;
  double reference[kAxes];
  for (int32_t k = 0; k < kAxes; ++k)
    reference[k] = begin.axes[k].c[0];
  if (!axesEndOf(arm, after, cuts.after, cuts.after, reference, end))
    return false;
  after.corner = axesCorner(begin, end);
  return true;
}

/// Strips that are not known to the motion yet.
struct Strips {
  path::Strip strip[kMostCornerStrips];
  int32_t count;
};

/// Where a strip ends at most that comes after one of the length `step`. No crumb is left at the
/// end. [u]
double stripEnd(double from, double step, double end) noexcept {
  constexpr double kCrumb = 0.25;
  const double most = kGrowth * step;
  return end - from <= (1.0 + kCrumb) * most ? end : from + most;
}

/// The strips of a corner that begins at a way of the motion. False: it cannot be driven.
bool lookAtCorner(OrderedArm &ordered, const CarriedTrack &carried, const PathLimits &limits,
                  const Movement &after, double begin, Look &look, Strips &strips) noexcept {
  carried.yield(ordered.arm, 0.0, look.reference, ordered.limits);
  const double length = after.corner.length;
  look.least = length / kCornerParts;
  look.to = 0.0;
  while (look.to < length) {
    if (strips.count == kMostCornerStrips)
      return false;
    const double step = look.to - look.from;
    look.goesOn = step > 0.0;
    look.from = look.to;
    look.to = step > 0.0 ? stripEnd(look.from, step, length) : length;
    path::Strip &strip = strips.strip[strips.count++];
    if (limitStrip(ordered.arm, carried.track(), limits, look, strip) != Obstacle::None)
      return false;
    strip.end = begin + look.to;
  }
  return true;
}

/// Goes on with the movement after the one that is looked at, from a way along its leg on.
void lookAtNext(GroupMotion &group, double begin, double entry) noexcept {
  ++group.looked;
  Movement &movement = movementAt(group, group.looked);
  movement.begin = begin;
  movement.entry = entry;
  movement.exit = movement.leg.length;
  movement.endChosen = movement.endKnown = false;
  group.lookedWay = entry;
  group.lookedStep = kInfinity;
}

/// Adds the corner to the next movement to the path. False: there is no corner.
bool addCorner(GroupMotion &group, const Arm &arm, const Allowance &allowance,
               int32_t &samples) noexcept {
  Movement &before = movementAt(group, group.looked);
  Movement &after = movementAt(group, group.looked + 1);
  const double exit = group.lookedWay;
  const double begin = legBegin(before) + exit - before.entry;
  Look look{};
  for (int32_t k = 0; k < kAxes; ++k)
    look.reference[k] = group.lookedReference[k];
  Strips strips;
  strips.count = 0;
  OrderedArm ordered(arm, after.order, allowance);
  const PathLimits limits = allowed(cornerLimits(before, after), allowance);
  const CarriedTrack carried(group, trackOf(after.corner), begin - group.motion.way, limits);
  const bool drivable = lookAtCorner(ordered, carried, limits, after, begin, look, strips);
  samples -= look.samples;
  if (!drivable)
    return false;
  for (int32_t i = 0; i < strips.count; ++i)
    (void)path::extend(group.motion, strips.strip[i]);
  before.exit = exit;
  before.end = begin;
  before.endKnown = true;
  for (int32_t k = 0; k < kAxes; ++k)
    group.lookedReference[k] = look.reference[k];
  return true;
}

/// Where the corner to the next movement begins along the leg that is looked at, if there is one;
/// chosen once, as soon as there is a successor.
void decideEnd(GroupMotion &group, const Arm &arm) noexcept {
  Movement &before = movementAt(group, group.looked);
  Movement &after = movementAt(group, group.looked + 1);
  before.endChosen = true;
  before.exit = before.leg.length;
  after.corner.length = 0.0;
  if (after.order.dwell > 0.0 || before.order.dwell > 0.0 || after.order.noCorner ||
      after.order.transition == Transition::None || !(after.leg.length > 0.0))
    return;
  const Cuts cuts = cutsOf(group, arm, before, after);
  if (!makeCorner(group, arm, before, after, cuts)) {
    after.corner.length = 0.0;
    return;
  }
  before.exit = before.leg.length - cuts.before;
  after.entry = cuts.after;
}

/// How far the path has to be known ahead as long as nothing is commanded that comes after it. [u]
double neededAhead(const GroupMotion &group, const Ramp &ramp) noexcept {
  constexpr double kTime = 0.2; // for plans [s]
  constexpr double kMore = 2.2;
  return kMore * ramp.way + (kTime + group.planTime + group.motion.keep) * ramp.velocity;
}

double neededWay(const GroupMotion &group) noexcept {
  const path::Course &course = group.motion.course;
  if (course.first == course.next)
    return kInfinity;
  const path::Strip &strip = path::stripAt(course, course.next - 1);
  const double velocity = exact::sqrt(path::squareIn(strip, 1.0));
  const path::Braking &braking = group.motion.wish.braking; // softer stops need more
  const auto partOf = [](double part) { return part > 0.0 ? part : 1.0; };
  const double rate = smaller(smaller(strip.acceleration, strip.deceleration),
                              partOf(braking.accelerationPart) / strip.along);
  const double jerk = static_cast<double>(strip.jerk) * partOf(braking.jerkPart);
  const double way = 0.5 * velocity * path::rampTime(velocity, rate, jerk);
  return group.motion.way + neededAhead(group, {velocity, way});
}

/// Up to where along its leg the movement that is looked at can be made known now. [u]
double lookEnd(const GroupMotion &group, const Arm &arm, const Movement &movement) noexcept {
  if (movement.endChosen)
    return movement.exit;
  const double length = movement.leg.length;
  const double way = legBegin(movement) + group.lookedWay - movement.entry;
  if (way >= neededWay(group))
    return group.lookedWay;
  if (group.lookedWay < 0.5 * length) {
    // Of one that is short for its velocity the end is needed soon: all at once is planned best.
    const Ramp ramp = rampOf(group, arm, movement, false);
    return neededAhead(group, ramp) >= 0.5 * length ? length : larger(0.5 * length, movement.entry);
  }
  constexpr double kParts = 16.0;
  return smaller(length, group.lookedWay + length / kParts);
}

/// Makes one strip of the leg known. False: nothing more for now.
bool addStrip(GroupMotion &group, const Arm &arm, const Allowance &allowance, Movement &movement,
              int32_t &samples) noexcept {
  const double end = lookEnd(group, arm, movement);
  if (!(end > group.lookedWay))
    return false;
  OrderedArm ordered(arm, movement.order, allowance);
  const PathLimits limits = allowed(movement.order.path, allowance);
  Look look{};
  look.from = group.lookedWay;
  look.to = stripEnd(group.lookedWay, group.lookedStep, end);
  look.least = movement.leg.length / kLegParts;
  for (int32_t k = 0; k < kAxes; ++k)
    look.reference[k] = group.lookedReference[k];
  const double ahead = legBegin(movement) + look.from - movement.entry - group.motion.way;
  const CarriedTrack carried(group, trackOf(movement.leg), ahead, limits);
  carried.yield(ordered.arm, look.from, look.reference, ordered.limits);
  look.to = smaller(look.to, look.from + larger(carried.reach(), look.least));
  path::Strip strip{};
  group.obstacle = limitStrip(ordered.arm, carried.track(), limits, look, strip);
  samples -= look.samples;
  if (group.obstacle != Obstacle::None)
    return false;
  strip.end = legBegin(movement) + look.to - movement.entry;
  const bool last = look.to == movement.leg.length;
  Movement *const after =
      group.looked + 1 < group.next ? &movementAt(group, group.looked + 1) : nullptr;
  strip.stop = last;
  strip.gate = last && after != nullptr && after->order.dwell > 0.0;
  if (!path::extend(group.motion, strip))
    return false;
  if (strip.gate)
    after->gated = true;
  group.lookedStep = look.to - look.from;
  group.lookedWay = look.to;
  for (int32_t k = 0; k < kAxes; ++k)
    group.lookedReference[k] = look.reference[k];
  if (last) {
    movement.endChosen = movement.endKnown = true;
    movement.end = strip.end;
  }
  return true;
}

/// Goes on to the next movement, where the present one is known to its end. False: there is none,
/// or it has to wait.
bool advance(GroupMotion &group, const Arm &arm, const Allowance &allowance, Movement &movement,
             int32_t &samples) noexcept {
  if (group.looked + 1 >= group.next)
    return false;
  Movement &after = movementAt(group, group.looked + 1);
  if (!(after.corner.length > 0.0)) {
    lookAtNext(group, movement.end, 0.0);
    return true;
  }
  if (path::roomIn(group.motion.course) < kMostCornerStrips)
    return false;
  const double entry = after.entry;
  if (addCorner(group, arm, allowance, samples)) {
    lookAtNext(group, movement.end, entry);
    return true;
  }
  after.corner.length = 0.0; // it cannot be driven: rest where the legs meet
  movement.exit = movement.leg.length;
  return true;
}

/// A movement that goes nowhere, or waits. One that waits keeps back what comes after it if the
/// motion would not stay where it is. False: nothing more for now.
bool passStill(GroupMotion &group, const Arm &arm, const Allowance &allowance, Movement &movement,
               int32_t &samples) noexcept {
  movement.endChosen = movement.endKnown = true;
  movement.end = movement.begin;
  movement.exit = 0.0;
  if (movement.order.dwell > 0.0 && !movement.gated && group.first <= group.looked)
    return false;
  return advance(group, arm, allowance, movement, samples);
}

} // namespace

void makeKnown(GroupMotion &group, const Arm &arm, const Allowance &allowance,
               int32_t samples) noexcept {
  constexpr int32_t kFewRooms = 2;
  constexpr int32_t kSamplesOfEnd = 8; // that decideEnd looks at, or a few less
  while (samples > 0 && group.obstacle == Obstacle::None && group.looked < group.next) {
    Movement &movement = movementAt(group, group.looked);
    if (movement.order.dwell > 0.0 || !(movement.leg.length > 0.0)) {
      if (!passStill(group, arm, allowance, movement, samples))
        return;
      continue;
    }
    if (!movement.endChosen && group.looked + 1 < group.next) {
      decideEnd(group, arm);
      samples -= kSamplesOfEnd;
    }
    const bool whole = movement.endChosen && group.lookedWay >= movement.exit;
    const bool goesOn = whole ? advance(group, arm, allowance, movement, samples)
                              : path::roomIn(group.motion.course) >= kFewRooms &&
                                    addStrip(group, arm, allowance, movement, samples);
    if (!goesOn)
      return;
  }
}

} // namespace stride::group
