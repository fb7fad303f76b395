// Changes of velocity with limited jerk that begin and end without acceleration, and motions over a
// way made of two of them: the textbook's formulas.
#ifndef STRIDE_TESTS_ORACLE_PATH_S_CURVE_HPP
#define STRIDE_TESTS_ORACLE_PATH_S_CURVE_HPP

#include <vector>

namespace stride::oracle {

/// A part of a motion with constant jerk, from a state on.
struct Phase {
  double duration;     ///< [s]
  double jerk;         ///< [u/s^3]
  double way;          ///< At its start. [u]
  double velocity;     ///< At its start. [u/s]
  double acceleration; ///< At its start. [u/s^2]
};

/// The state `time` after the start of a phase, as a phase of no duration.
Phase after(const Phase &phase, double time);

/// How long the velocity takes to change by `change`, from and to no acceleration. [s]
double changeTime(double change, double acceleration, double jerk);
/// The way of that. [u]
double changeWay(double from, double to, double acceleration, double jerk);
/// The phases of that, at most three, from a way on.
std::vector<Phase> changePhases(double way, double from, double to, double acceleration,
                                double jerk);

/// The shortest time from rest to rest over a way, in closed form. [s]
double restToRestTime(double way, double velocity, double acceleration, double jerk);

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_S_CURVE_HPP
