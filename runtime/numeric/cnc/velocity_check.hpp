// How fast a path may go from one object to the next: SMC_CheckVelocities. Free of the C++ standard
// library: linked into every application.
// Source: SoftMotion V2.3 manual, sections 3.2 and 6.2.7; jumps of other axes are SoftMotion 3's.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_VELOCITY_CHECK_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_VELOCITY_CHECK_HPP

#include "runtime/numeric/cnc/queue.hpp"

namespace stride::cnc {

/// Where the path need not stop.
struct CornerRules {
  double angle;    ///< Greatest angle of a corner; less than kLeastAngle is as that. [rad]
  double axisJump; ///< Greatest jump of the velocity of one of A to W; negative: none. [u/s]
};

/// What numbers leave of a path without corners. [rad]
inline constexpr double kLeastAngle = 1e-8;

enum class VelocityError : uint8_t {
  None,
  NoQueue,     ///< No usable queue.
  NotPositive, ///< A velocity, acceleration or deceleration of an object that moves.
};

/// Angle between the end of one object and the start of the next, 0 to pi. [rad] Infinite if one of
/// them has no direction, or their lengths are of different kinds (ObjectShape::measure).
double cornerAngle(const PathObject &before, const PathObject &after) noexcept;

/// The velocity with which `before` may end if `after` follows. [u/s]
double cornerVelocity(const PathObject &before, const PathObject &after,
                      const CornerRules &rules) noexcept;

/// Lowers the end velocities of the objects that are in the queue since its writePosition was
/// `checked`, which is then set anew, and of the one before them. That of the last object stays
/// until there is another one after it or the queue is complete. Tells the queue: who drives it
/// waits for objects to be checked.
VelocityError checkVelocities(Queue *queue, uint32_t &checked, const CornerRules &rules) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_VELOCITY_CHECK_HPP
