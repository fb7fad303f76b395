// When a motion will be where: what its law says of the time ahead, and how much of that stays.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_MOTION_TIMES_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_MOTION_TIMES_HPP

#include "runtime/numeric/path/motion.hpp"

namespace stride::path {

/// The time until the motion is at a way that it has not passed; kInfinity: the law does not lead
/// there, or has to wait on the way until it is told to go on. [u] in, [s] out
double timeTo(const Motion &motion, double way) noexcept;

/// How much of the law ahead could stay as it is: at most motion.keep. See Motion::promise. [s]
double promisable(const Motion &motion) noexcept;

/// Where the motion rests next, and when. `time` kInfinity: that is not planned yet.
struct NextRest {
  double time; ///< [s]
  double way;  ///< [u]
};
NextRest nextRest(const Motion &motion) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_MOTION_TIMES_HPP
