// How tests make an Actor of a block: what the tables of actors.cpp and administrative_actors.cpp
// have in common.
#ifndef STRIDE_TESTS_UNIT_MOTION_ACTOR_FACTORIES_HPP
#define STRIDE_TESTS_UNIT_MOTION_ACTOR_FACTORIES_HPP

#include "tests/unit/motion/actors.hpp"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace stride::test {

using Factory = std::function<Actor(AxisRig &)>;

/// The blocks that do not move an axis, by their names in docs/motion-states.md.
const std::map<std::string, Factory> &administrativeActors();

template <class Block> void setExecute(Block &b, bool execute) {
  const uint8_t value = execute ? 1 : 0;
  if constexpr (requires { b.Execute; })
    b.Execute = value;
  else if constexpr (requires { b.bExecute; })
    b.bExecute = value;
  else if constexpr (requires { b.Enable; })
    b.Enable = value;
  else if constexpr (requires { b.JogForward; })
    b.JogForward = value;
  else
    b.bEnable = value;
}

template <class Block> void showOutcome(const Block &b, Shown &s) {
  if constexpr (requires { b.bCompensating; }) { // it has no outputs for these
    s.aborted = b.stBlock.bAborted != 0;
    s.hasAborted = true;
    s.error = b.stBlock.iError != 0;
    s.errorId = static_cast<int>(b.stBlock.iError);
  }
  if constexpr (requires { b.CommandAborted; }) {
    s.aborted = b.CommandAborted != 0;
    s.hasAborted = true;
  } else if constexpr (requires { b.bCommandAborted; }) {
    s.aborted = b.bCommandAborted != 0;
    s.hasAborted = true;
  }
  if constexpr (requires { b.Error; })
    s.error = b.Error != 0;
  else if constexpr (requires { b.bError; })
    s.error = b.bError != 0;
  if constexpr (requires { b.ErrorID; })
    s.errorId = static_cast<int>(b.ErrorID);
  else if constexpr (requires { b.iErrorID; })
    s.errorId = static_cast<int>(b.iErrorID);
  else if constexpr (requires { b.nErrorID; })
    s.errorId = static_cast<int>(b.nErrorID);
  else if constexpr (requires { b.eErrorID; })
    s.errorId = static_cast<int>(b.eErrorID);
  else if constexpr (requires { b.ErrorId; })
    s.errorId = static_cast<int>(b.ErrorId);
}

template <class Block> Shown showBlock(const Block &b) {
  Shown s;
  if constexpr (requires { b.Done; })
    s.done = b.Done != 0;
  else if constexpr (requires { b.bDone; })
    s.done = b.bDone != 0;
  else if constexpr (requires { b.InVelocity; })
    s.done = b.InVelocity != 0;
  else if constexpr (requires { b.InEndVelocity; })
    s.done = b.InEndVelocity != 0;
  else if constexpr (requires { b.InTorque; })
    s.done = b.InTorque != 0;
  else if constexpr (requires { b.InGear; })
    s.done = b.InGear != 0;
  else if constexpr (requires { b.InSync; })
    s.done = b.InSync != 0;
  else if constexpr (requires { b.bInSync; })
    s.done = b.bInSync != 0;
  else if constexpr (requires { b.bCompensating; })
    s.done = b.stBlock.bRunning != 0 && b.bCompensating == 0;
  else if constexpr (requires { b.Enabled; })
    s.done = b.Enabled != 0;
  if constexpr (requires { b.bCompensating; }) {
    s.busy = b.stBlock.bRunning != 0;
    s.hasBusy = true;
  } else if constexpr (requires { b.Busy; }) {
    s.busy = b.Busy != 0;
    s.hasBusy = true;
  } else if constexpr (requires { b.bBusy; }) {
    s.busy = b.bBusy != 0;
    s.hasBusy = true;
  }
  if constexpr (requires { b.Active; })
    s.active = b.Active != 0;
  showOutcome(b, s);
  return s;
}

/// A block and what its in-out pins are bound to.
template <class Block, class Extra> struct Held {
  Block block = fresh<Block>();
  Extra extra = fresh<Extra>();
};

struct Nothing {
  void init__(Ctx & /*ctx*/) {}
};

template <class Block, class Extra>
Actor actorOf(AxisRig &rig, std::shared_ptr<Held<Block, Extra>> h) {
  h->block.Axis = &rig.axis;
  Actor a;
  a.call = [h, &rig](bool execute) {
    setExecute(h->block, execute);
    h->block.body__(rig.ctx);
  };
  a.show = [h] { return showBlock(h->block); };
  a.bind = [h](axis::AxisRef &axis) { h->block.Axis = &axis; };
  return a;
}

/// A block with inputs that `prepare(block, rig)` sets.
template <class Block, class Prepare> Factory plain(Prepare prepare) {
  return [prepare](AxisRig &rig) {
    auto h = std::make_shared<Held<Block, Nothing>>();
    prepare(h->block, rig);
    return actorOf(rig, h);
  };
}

template <class Block> Factory plain() {
  return plain<Block>([](Block &, AxisRig &) {});
}

/// A block with a second in-out pin: `prepare(block, extra)` binds it.
template <class Block, class Extra, class Prepare> Factory with(Prepare prepare) {
  return [prepare](AxisRig &rig) {
    auto h = std::make_shared<Held<Block, Extra>>();
    prepare(h->block, h->extra);
    return actorOf(rig, h);
  };
}

template <class Block> void setDynamics(Block &b) {
  if constexpr (requires { b.Velocity; })
    b.Velocity = 20;
  if constexpr (requires { b.VelocityDiff; })
    b.VelocityDiff = 20;
  if constexpr (requires { b.Acceleration; })
    b.Acceleration = 50;
  b.Deceleration = 50;
}

template <class Block> Factory moving() {
  return plain<Block>([](Block &b, AxisRig &) { setDynamics(b); });
}

} // namespace stride::test

#endif
