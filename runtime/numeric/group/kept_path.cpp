#include "runtime/numeric/group/kept_path.hpp"

#include "runtime/numeric/group/path_making.hpp"

namespace stride::group {

using exact::smaller;

void keepPath(const GroupMotion &group, KeptPath &kept) noexcept {
  __builtin_memcpy(kept.movement, group.movement, sizeof kept.movement);
  kept.course = group.motion.course;
  kept.first = group.first;
  kept.next = group.next;
  kept.looked = group.looked;
  kept.lookedWay = group.lookedWay;
  kept.lookedStep = group.lookedStep;
  for (int32_t k = 0; k < kAxes; ++k) {
    kept.lookedReference[k] = group.lookedReference[k];
    kept.axes[k] = group.axes[k];
  }
  kept.way = group.motion.way;
  kept.dwell = group.dwell;
  kept.dwelling = group.dwelling;
  kept.gate = group.motion.gate;
}

uint64_t keptMovement(const KeptPath &kept) noexcept {
  return kept.first < kept.next ? kept.movement[static_cast<uint64_t>(kept.first) % kMovements].id
                                : 0;
}

namespace {

/// Forgets movements; a group that goes with a system does so on.
void restart(GroupMotion &group, const double (&axes)[kAxes]) noexcept {
  double velocity[kAxes];
  double acceleration[kAxes];
  __builtin_memcpy(velocity, group.velocity, sizeof velocity);
  __builtin_memcpy(acceleration, group.acceleration, sizeof acceleration);
  const bool carried = isCarried(group);
  reset(group, axes);
  if (!carried)
    return;
  __builtin_memcpy(group.velocity, velocity, sizeof velocity);
  __builtin_memcpy(group.acceleration, acceleration, sizeof acceleration);
}

} // namespace

void suspend(GroupMotion &group) noexcept {
  for (int64_t k = group.first; k < group.next; ++k)
    setOutcome(group, movementAt(group, k).id, Outcome::Interrupted);
  double axes[kAxes];
  __builtin_memcpy(axes, group.axes, sizeof axes);
  restart(group, axes);
}

void resume(GroupMotion &group, const KeptPath &kept) noexcept {
  restart(group, kept.axes);
  __builtin_memcpy(group.movement, kept.movement, sizeof group.movement);
  group.motion.course = kept.course;
  group.motion.way = kept.way;
  group.motion.gate = kept.gate;
  group.first = kept.first;
  group.next = kept.next;
  group.looked = kept.looked;
  group.lookedWay = kept.lookedWay;
  group.lookedStep = kept.lookedStep;
  __builtin_memcpy(group.lookedReference, kept.lookedReference, sizeof group.lookedReference);
  group.dwell = kept.dwell;
  group.dwelling = kept.dwelling;
  for (int64_t k = group.first; k < group.next; ++k)
    setOutcome(group, movementAt(group, k).id, Outcome::Queued);
}

void resumeCarried(GroupMotion &group, const KeptPath &kept) noexcept {
  const auto keptAt = [&kept](int64_t number) -> const Movement & {
    return kept.movement[static_cast<uint64_t>(number) % kMovements];
  };
  if (kept.first == kept.next)
    return;
  const Movement &active = keptAt(kept.first);
  const bool begun = kept.first <= kept.looked && kept.way >= active.begin;
  if (begun && kept.way < legBegin(active)) {
    resume(group, kept);
    return;
  }
  restart(group, kept.axes);
  for (int64_t k = kept.first; k < kept.next; ++k)
    append(group, keptAt(k).id, keptAt(k).leg, keptAt(k).order);
  if (!begun)
    return;
  Movement &movement = movementAt(group, group.first);
  const double along = active.entry + (kept.way - legBegin(active));
  movement.entry = group.lookedWay = smaller(along, movement.leg.length);
}

void abortInterrupted(GroupMotion &group) noexcept {
  for (uint8_t &outcome : group.outcome)
    if (outcome == static_cast<uint8_t>(Outcome::Interrupted))
      outcome = static_cast<uint8_t>(Outcome::Aborted);
  for (OldOutcome &old : group.old)
    if (old.outcome == Outcome::Interrupted)
      old.outcome = Outcome::Aborted;
}

} // namespace stride::group
