#include "runtime/blocks/SM3_Robotics/triggers.hpp"

#include "runtime/blocks/SM3_Robotics/carriers.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;
using group::Outcome;

constexpr int16_t kWrong = error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;

Trigger &triggerAt(Triggers &triggers, uint64_t id) noexcept {
  return triggers.trigger[id % kTriggers];
}

bool isOpen(TriggerStage stage) noexcept {
  return stage == TriggerStage::Prepared || stage == TriggerStage::Bound ||
         stage == TriggerStage::Placed;
}

void end(Trigger &trigger, TriggerStage stage, int16_t reason) noexcept {
  trigger.stage = stage;
  trigger.error = reason;
  trigger.active = false;
}

int16_t wrongPlane(const TriggerPlace &place) noexcept {
  constexpr double kRounding = 1e-6;
  const bool isUnit = exact::fabs(numeric::norm(place.plane.normal) - 1.0) <= kRounding;
  if (!isUnit || !(place.plane.distance >= 0.0) || !exact::isfinite(place.plane.distance))
    return kWrong;
  const bool cartesian = place.system == decl::SMC_COORD_SYSTEM__WCS ||
                         place.system == decl::SMC_COORD_SYSTEM__MCS ||
                         place.system == decl::SMC_COORD_SYSTEM__PCS_1 ||
                         place.system == decl::SMC_COORD_SYSTEM__PCS_2;
  return cartesian ? int16_t{0} : error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
}

int16_t wrongPlace(const TriggerPlace &place) noexcept {
  switch (place.kind) {
  case TriggerKind::Relative:
    return place.position >= 0.0 && place.position <= 1.0 ? int16_t{0} : kWrong;
  case TriggerKind::Distance:
    return place.position >= 0.0 && exact::isfinite(place.position) ? int16_t{0} : kWrong;
  case TriggerKind::Plane:
    return wrongPlane(place);
  }
  return kWrong;
}

/// The plane as the machine sees it, or as a moving system does.
void toMachine(const GroupRef &group, TriggerPlace &place) noexcept {
  place.carrier = carrierOf(group, place.system);
  if (place.carrier != 0)
    return;
  kinematics::Frame<double> frame;
  (void)systemInMachine(group, place.system, frame);
  group::Plane &plane = place.plane;
  plane.normal = group::plain(frame.turn * group::vectorOf(plane.normal));
  plane.distance += numeric::dot(plane.normal, group::plain(frame.place));
}

/// Where along a leg a trigger lies [u]; negative: nowhere.
double alongOf(const group::Arm &arm, const group::Leg &leg, const TriggerPlace &place) noexcept {
  constexpr double kRounding = 1e-12;
  switch (place.kind) {
  case TriggerKind::Relative:
    return place.position * leg.length;
  case TriggerKind::Distance:
    if (!group::leadsTool(leg) || place.position > leg.length * (1.0 + kRounding))
      return -1.0;
    return exact::smaller(place.position, leg.length);
  case TriggerKind::Plane:
    break;
  }
  return group::wayInPlane(arm, leg, place.plane);
}

/// What its movement has become decides about a trigger that is bound.
void followMovement(Trigger &trigger, const GroupState &state) noexcept {
  switch (group::outcomeOf(state.motion, trigger.movement)) {
  case Outcome::Aborted:
  case Outcome::Unknown:
    end(trigger, TriggerStage::Gone, 0);
    break;
  case Outcome::Failed:
    end(trigger, TriggerStage::Failed,
        state.error[trigger.movement % static_cast<uint64_t>(group::kOutcomes)]);
    break;
  case Outcome::Done:
    if (trigger.stage == TriggerStage::Bound)
      end(trigger, TriggerStage::Gone, 0);
    break;
  case Outcome::Interrupted: // where it is on the way is found anew when that goes on
    if (trigger.stage == TriggerStage::Placed)
      trigger.stage = TriggerStage::Bound;
    trigger.active = false;
    break;
  case Outcome::Waiting:
  case Outcome::Queued:
  case Outcome::Active:
    break;
  }
}

/// The time of one whose place is known.
void findTime(Trigger &trigger, const GroupState &state, int64_t startNs, double cycle) noexcept {
  constexpr double kRounding = 1e-9; // the last cycle of a motion reaches its end but for that
  const double time = group::timeTo(state.motion, trigger.way);
  cycle *= 1.0 + kRounding;
  trigger.active = time <= exact::larger(state.forecast, cycle) && !group::holds(state.motion);
  trigger.time = time;
  trigger.startNs = startNs;
  if (trigger.active && time < cycle)
    trigger.stage = TriggerStage::Reached;
}

template <class Action> void forOpen(Triggers &triggers, const Action &action) noexcept {
  for (uint64_t id = triggers.settledId + 1; id <= triggers.lastId; ++id)
    if (isOpen(triggerAt(triggers, id).stage))
      action(triggerAt(triggers, id));
  while (triggers.settledId < triggers.lastId &&
         !isOpen(triggerAt(triggers, triggers.settledId + 1).stage))
    ++triggers.settledId;
}

} // namespace

const Trigger *triggerOf(const Triggers &triggers, uint64_t id) noexcept {
  const Trigger &trigger = triggers.trigger[id % kTriggers];
  return id != 0 && trigger.id == id ? &trigger : nullptr;
}

void dropUnused(Triggers &triggers, uint64_t cycle) noexcept {
  if (triggers.cycle == cycle || triggers.prepared == 0)
    return;
  forOpen(triggers, [](Trigger &trigger) {
    if (trigger.stage == TriggerStage::Prepared)
      end(trigger, TriggerStage::Unused, 0);
  });
  triggers.prepared = 0;
}

int16_t prepareTrigger(Triggers &triggers, uint64_t cycle, const TriggerPlace &place, uint32_t most,
                       uint64_t &id) noexcept {
  dropUnused(triggers, cycle);
  if (const int16_t wrong = wrongPlace(place); wrong != 0)
    return wrong;
  if (triggers.prepared >= most || areFull(triggers))
    return kWrong;
  id = ++triggers.lastId;
  Trigger &trigger = triggerAt(triggers, id);
  trigger = Trigger{};
  trigger.id = id;
  trigger.place = place;
  trigger.stage = TriggerStage::Prepared;
  triggers.cycle = cycle;
  ++triggers.prepared;
  return 0;
}

void makeRoomForTrigger(GroupState &state) noexcept {
  if (!areFull(state.triggers))
    return;
  forOpen(state.triggers, [&](Trigger &trigger) {
    if (trigger.stage == TriggerStage::Bound &&
        group::outcomeOf(state.motion, trigger.movement) == Outcome::Interrupted)
      end(trigger, TriggerStage::Gone, 0);
  });
}

void bindTriggers(GroupRef &group, uint64_t cycle, uint64_t movement, int16_t refusal) noexcept {
  Triggers &triggers = stateOf(group).triggers;
  dropUnused(triggers, cycle);
  if (triggers.prepared == 0)
    return;
  forOpen(triggers, [&](Trigger &trigger) {
    if (trigger.stage != TriggerStage::Prepared)
      return;
    if (refusal != 0) {
      end(trigger, TriggerStage::Failed, refusal);
      return;
    }
    trigger.stage = TriggerStage::Bound;
    trigger.movement = movement;
    if (trigger.place.kind == TriggerKind::Plane)
      toMachine(group, trigger.place);
  });
  triggers.prepared = 0;
}

void locateTriggers(GroupState &state, const group::Arm &arm, uint64_t movement,
                    const group::Leg &leg) noexcept {
  forOpen(state.triggers, [&](Trigger &trigger) {
    if (trigger.stage != TriggerStage::Bound || trigger.movement != movement)
      return;
    trigger.along = alongOf(arm, leg, trigger.place);
    trigger.located = true;
    // A plane that moves in another way than the path has no place on it.
    const bool apart =
        trigger.place.kind == TriggerKind::Plane && trigger.place.carrier != state.rides;
    if (trigger.along < 0.0 || apart)
      end(trigger, TriggerStage::Failed, kWrong);
  });
}

void updateTriggers(const Ctx &ctx, GroupState &state, double cycle) noexcept {
  dropUnused(state.triggers, ctx.cycle + 1);
  forOpen(state.triggers, [&](Trigger &trigger) {
    if (trigger.stage == TriggerStage::Bound && trigger.located) {
      trigger.way = group::wayOf(state.motion, trigger.movement, trigger.along);
      if (trigger.way >= 0.0)
        trigger.stage = TriggerStage::Placed;
    }
    if (trigger.stage != TriggerStage::Prepared)
      followMovement(trigger, state);
    if (trigger.stage == TriggerStage::Placed)
      findTime(trigger, state, ctx.cycleStartNs, cycle);
  });
}

void shiftTriggers(GroupState &state, double by) noexcept {
  if (!(by > 0.0))
    return;
  forOpen(state.triggers, [by](Trigger &trigger) { trigger.way -= by; });
}

void endTriggers(GroupState &state) noexcept {
  forOpen(state.triggers, [&](Trigger &trigger) {
    if (trigger.stage == TriggerStage::Prepared)
      return;
    followMovement(trigger, state);
    if (trigger.stage != TriggerStage::Placed ||
        group::outcomeOf(state.motion, trigger.movement) != Outcome::Done)
      return;
    // But for rounding it has been reached with the end of the motion.
    const bool reached = trigger.active && trigger.way <= state.motion.motion.way;
    trigger.stage = reached ? TriggerStage::Reached : TriggerStage::Gone;
    trigger.active = reached;
  });
}

} // namespace stride::robotics
