// How a slave gets onto a curve while its master covers a way: one quintic over the master, so that
// position, velocity and acceleration are continuous at both ends as long as the master's are.
// Pure numerics.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_APPROACH_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_APPROACH_HPP

#include "runtime/numeric/cam/curve.hpp"
#include "runtime/numeric/motion_state.hpp"

namespace stride::cam {

/// The way from a node to another; `end.x` may be smaller than `begin.x`, for a master that runs
/// backwards. Both x are not the same. evaluateQuintic(begin, end, x) is the course between them.
struct Approach {
  Node begin;
  Node end;
};

/// The place of a slave whose motion over time is `slave`, at the master position `x`, where the
/// master moves with `velocity` [master u/s] and `acceleration` [master u/s^2]. False if there is
/// none: the slave moves while the master is at rest, or nearly so.
bool placeOver(const numeric::MotionState &slave, double x, double velocity, double acceleration,
               Node &place) noexcept;

/// The motion over time of a slave at `place`, by the chain rule.
numeric::MotionState motionOver(const Point &place, double velocity, double acceleration) noexcept;

/// The distance that the slave covers if its slope goes evenly from that of `begin` to that of
/// `end`, whatever their places. A slave that ends elsewhere has to make up for it. [slave u]
double evenWay(const Approach &approach) noexcept;

/// Whether the slave moves, somewhere between the nodes, against the direction in which it is to
/// leave the second one (without a slope there: against the direction from the first to the
/// second). What is smaller than the rounding of the course does not count.
bool reverses(const Approach &approach) noexcept;

} // namespace stride::cam

#endif
