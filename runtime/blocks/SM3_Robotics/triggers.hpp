// The triggers of a group: from being prepared to being reached.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_TRIGGERS_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_TRIGGERS_HPP

#include "runtime/numeric/group/trigger.hpp"

namespace stride::robotics {

/// How many a group remembers.
inline constexpr int32_t kTriggers = 256;

/// What has become of a trigger.
enum class TriggerStage : uint8_t {
  None,
  Prepared, ///< For the next movement of the same cycle.
  Bound,    ///< To a movement.
  Placed,   ///< Where on the way of the group's motion is known.
  Reached,
  Failed, ///< See Trigger::error.
  Unused, ///< No movement came in its cycle.
  Gone    ///< With its movement.
};

enum class TriggerKind : uint8_t { Relative, Distance, Plane };

/// Where a trigger is to be.
struct TriggerPlace {
  TriggerKind kind;
  double position;    ///< Relative: 0 to 1; Distance: from the movement's start. [u]
  group::Plane plane; ///< In `system`; once it is bound, in the machine, unless that moves.
  int16_t system;     ///< SMC_COORD_SYSTEM
  int32_t carrier;    ///< Which moving system that is, 1 or 2; 0: none.
};

struct Trigger {
  uint64_t id;
  uint64_t movement;
  TriggerPlace place;
  double along;    ///< Way along the movement's leg. [u]
  double way;      ///< Of the motion. [u]
  double time;     ///< Until it is reached, since the start of the cycle in which this was found
                   ///< last. [s]
  int64_t startNs; ///< When that cycle has started.
  bool located;    ///< `along` is right.
  bool active;     ///< `time` is right.
  TriggerStage stage;
  int16_t error; ///< SMC_ERROR
};

/// Trivially copyable.
struct Triggers {
  Trigger trigger[kTriggers]; ///< By id.
  uint64_t lastId;
  uint64_t settledId; ///< What becomes of triggers up to this one is known.
  uint64_t cycle;     ///< In which the last one was prepared, plus 1.
  uint32_t prepared;  ///< In that cycle, for the next movement.
};

/// The trigger of that id; null: there is none, or no longer.
const Trigger *triggerOf(const Triggers &triggers, uint64_t id) noexcept;

/// Whether there is no room for another one.
inline bool areFull(const Triggers &triggers) noexcept {
  return triggers.lastId - triggers.settledId >= static_cast<uint64_t>(kTriggers);
}

/// Prepares one: an SMC_ERROR. `cycle`: the present one, plus 1. `most`: how many a movement can
/// have.
int16_t prepareTrigger(Triggers &triggers, uint64_t cycle, const TriggerPlace &place, uint32_t most,
                       uint64_t &id) noexcept;

/// What has been prepared before the present cycle has come to nothing.
void dropUnused(Triggers &triggers, uint64_t cycle) noexcept;

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_TRIGGERS_HPP
