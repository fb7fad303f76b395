#ifndef STRIDE_TESTS_PROPERTY_MOVE_PROBLEM_HPP
#define STRIDE_TESTS_PROPERTY_MOVE_PROBLEM_HPP
// A move with limited jerk, as planParabolic() is asked for it.

#include "runtime/numeric/profile/parabolic.hpp"

#include <ostream>

namespace stride::test {

struct MoveProblem {
  motion::State start;
  double target;
  double endVelocity;
  motion::JerkLimits limits;
};

/// As an initialiser, so that a case that failed can be tried again.
inline std::ostream &operator<<(std::ostream &out, const MoveProblem &p) {
  out.precision(17);
  return out << "{{" << p.start.position << ", " << p.start.velocity << ", " << p.start.acceleration
             << "}, " << p.target << ", " << p.endVelocity << ", {" << p.limits.velocity << ", "
             << p.limits.acceleration << ", " << p.limits.deceleration << ", " << p.limits.jerk
             << "}}";
}

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_MOVE_PROBLEM_HPP
