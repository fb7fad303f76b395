// A planner for paths that is easy to see through: the classic S-curve from joint to joint, without
// acceleration at joints. It is slow, and what it finds is not the best; but it keeps the limits,
// so that a good planner is never slower.
#ifndef STRIDE_TESTS_ORACLE_PATH_REFERENCE_PLANNER_HPP
#define STRIDE_TESTS_ORACLE_PATH_REFERENCE_PLANNER_HPP

#include "tests/oracle/path/s_curve.hpp"
#include "tests/oracle/path/time_optimum.hpp"

#include <span>
#include <vector>

namespace stride::oracle {

struct ReferencePlan {
  bool found;                ///< false: a limit leaves no acceleration at all.
  double time;               ///< [s]
  std::vector<Phase> phases; ///< One after the other, from rest to rest at each stop.
};

/// Cells whose velocities and accelerations are alike become one field with the strictest limits of
/// all; `ratio` >= 1 says how much they may differ. With 1 only equal cells do.
std::vector<Cell> fieldsOf(std::span<const Cell> cells, double ratio = 1.1);

/// Plans from joint to joint of fields. Between two joints there are two changes of velocity, each
/// with the acceleration that the curvature leaves at the peak between both, and even motion.
/// Joints are passed as fast as fields before and after allow; several ways to share the limit
/// between curvature and acceleration are tried. A ceiling of 0 is a stop.
ReferencePlan referencePlan(std::span<const Cell> fields, double jerk);

/// The state at a time of a plan, as a phase of no duration; at its end the last one. [s] in
Phase stateAt(const ReferencePlan &plan, double time);

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_REFERENCE_PLANNER_HPP
