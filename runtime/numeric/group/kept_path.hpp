// What is left of a group's movements at a place of their path, so that they can be gone on with
// later, from rest, along exactly the same path. Free of the C++ standard library: linked into
// every application.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_KEPT_PATH_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_KEPT_PATH_HPP

#include "runtime/numeric/group/group_motion.hpp"

namespace stride::group {

/// Trivially copyable. See GroupMotion; what has been planned is not kept.
struct KeptPath {
  Movement movement[kMovements];
  path::Course course;
  int64_t first, next, looked;
  double lookedWay, lookedStep;
  double lookedReference[kAxes];
  double axes[kAxes]; ///< Where the group has to be to go on. [u]
  double way;
  double dwell;
  bool dwelling;
  bool gate;
};

/// What is left of the movements from where the group is now, moving or not.
void keepPath(const GroupMotion &group, KeptPath &kept) noexcept;

/// The movement in which it has been kept; 0: none.
uint64_t keptMovement(const KeptPath &kept) noexcept;

/// The movements of a group at rest wait to be gone on with: it has none of its own any more.
void suspend(GroupMotion &group) noexcept;

/// A group at rest without movements goes on with those that have been kept; it is where they were.
void resume(GroupMotion &group, const KeptPath &kept) noexcept;

/// The same on a path in a system that moves, which the group follows again where it was on it. The
/// axes are elsewhere than then: of the path only the rest of a corner in which it was is known
/// from before, what comes after that is looked at anew.
void resumeCarried(GroupMotion &group, const KeptPath &kept) noexcept;

/// Movements that wait to be gone on with are aborted.
void abortInterrupted(GroupMotion &group) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_KEPT_PATH_HPP
