#include "tests/unit/motion/actors.hpp"

#include "tests/unit/motion/actor_factories.hpp"

#include "st/SM_DriveBasic/MC_CAM_REF.h"
#include "st/SM_DriveBasic/SMC_CAMXYVA.h"
#include "st/SM_DriveBasic/SMC_ControlAxisByPos.h"
#include "st/SM_DriveBasic/SMC_ControlAxisByPosVel.h"
#include "st/SM_DriveBasic/SMC_ControlAxisByVel.h"
#include "st/SM_DriveBasic/SMC_FollowPosition.h"
#include "st/SM_DriveBasic/SMC_FollowPositionVelocity.h"
#include "st/SM_DriveBasic/SMC_FollowSetValues.h"
#include "st/SM_DriveBasic/SMC_FollowVelocity.h"
#include "st/SM_DriveBasic/SMC_Homing.h"
#include "st/SM_PLCopen/MC_AccelerationProfile.h"
#include "st/SM_PLCopen/MC_CamIn.h"
#include "st/SM_PLCopen/MC_CamOut.h"
#include "st/SM_PLCopen/MC_GearIn.h"
#include "st/SM_PLCopen/MC_GearInPos.h"
#include "st/SM_PLCopen/MC_GearOut.h"
#include "st/SM_PLCopen/MC_Halt.h"
#include "st/SM_PLCopen/MC_Home.h"
#include "st/SM_PLCopen/MC_Jog.h"
#include "st/SM_PLCopen/MC_MoveAdditive.h"
#include "st/SM_PLCopen/MC_MoveRelative.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/MC_Phasing.h"
#include "st/SM_PLCopen/MC_PositionProfile.h"
#include "st/SM_PLCopen/MC_StartMode.h"
#include "st/SM_PLCopen/MC_TA_REF.h"
#include "st/SM_PLCopen/MC_TP_REF.h"
#include "st/SM_PLCopen/MC_TV_REF.h"
#include "st/SM_PLCopen/MC_TorqueControl.h"
#include "st/SM_PLCopen/MC_VelocityProfile.h"
#include "st/SM_PLCopen/SMC_BacklashCompensation.h"
#include "st/SM_PLCopen/SMC_MoveContinuousAbsolute.h"
#include "st/SM_PLCopen/SMC_MoveContinuousRelative.h"
#include "st/SM_PLCopen/SMC_TrackAxis.h"
#include "st/SM_PLCopen/SMC_TrackSetValues.h"

#include <map>
#include <stdexcept>

namespace stride::test {
namespace {

namespace basic = ::st::SM_DriveBasic;
namespace pl = ::st::SM_PLCopen;

/// Steps of one second.
template <class Pair> void setStep(Pair &pair) { pair.delta_time = 1000; }

/// Set values of a Follow or ControlAxis block: where the axis is when it is first called.
template <class Block> Factory following() {
  return [](AxisRig &rig) {
    auto h = std::make_shared<Held<Block, Nothing>>();
    Actor a = actorOf(rig, h);
    if constexpr (requires { h->block.dwValueMask; })
      h->block.dwValueMask = 3; // position and velocity
    if constexpr (requires { h->block.Deceleration; })
      setDynamics(h->block);
    a.call = [h, &rig, started = false](bool execute) mutable {
      if constexpr (requires { h->block.fSetPosition; }) {
        if (!started)
          h->block.fSetPosition = rig.axis.fSetPosition;
        h->block.fSetPosition += 10 * rig.cycleSeconds;
      }
      if constexpr (requires { h->block.fSetVelocity; })
        h->block.fSetVelocity = 10;
      if constexpr (requires { h->block.iStatus; })
        h->block.iStatus = ::st::SM_CNC::SMC_INT_STATUS__IPO_CONSTANT;
      if constexpr (requires { h->block.bAvoidGaps; })
        h->block.bAvoidGaps = 0;
      started = started || execute;
      setExecute(h->block, execute);
      h->block.body__(rig.ctx);
    };
    return a;
  };
}

/// A master that runs with 10 u/s, and a cam that is a line.
struct Leader {
  axis::AxisRef ref = fresh<axis::AxisRef>();
  ::st::SM_DriveBasic::SMC_CAMXYVA places[2] = {{0, 0, 1, 0}, {100, 100, 1, 0}};
  ::st::SM_DriveBasic::MC_CAM_REF cam = fresh<::st::SM_DriveBasic::MC_CAM_REF>();

  void init__(Ctx & /*ctx*/) {
    ref.iMovementType = 1;
    ref.fTaskCycle = 0.001;
    ref.bRegulatorOn = 1;
    ref.fSetVelocity = 10;
    cam.xEnd = 100;
    cam.byType = 3;
    cam.nElements = 2;
    cam.pce = reinterpret_cast<uint8_t *>(places);
  }
};

/// A block that follows a Leader. `prepare(block, leader, slave)` sets its inputs at the first
/// edge.
template <class Block, class Prepare> Factory coupled(Prepare prepare) {
  return [prepare](AxisRig &rig) {
    auto h = std::make_shared<Held<Block, Leader>>();
    h->extra.init__(rig.ctx); // its pointer is its own
    h->block.Slave = &rig.axis;
    h->block.Master = &h->extra.ref;
    Actor a;
    a.call = [h, prepare, &rig, started = false](bool execute) mutable {
      if (execute && !started)
        prepare(h->block, h->extra, rig.axis);
      started = started || execute;
      h->extra.ref.fSetPosition += 10 * rig.cycleSeconds;
      setExecute(h->block, execute);
      h->block.body__(rig.ctx);
    };
    a.show = [h] { return showBlock(h->block); };
    a.bind = [h](axis::AxisRef &axis) { h->block.Slave = &axis; };
    return a;
  };
}

template <class Block> Factory uncoupling() {
  return [](AxisRig &rig) {
    auto h = std::make_shared<Held<Block, Nothing>>();
    h->block.Slave = &rig.axis;
    Actor a;
    a.call = [h, &rig](bool execute) {
      setExecute(h->block, execute);
      h->block.body__(rig.ctx);
    };
    a.show = [h] { return showBlock(h->block); };
    a.bind = [h](axis::AxisRef &axis) { h->block.Slave = &axis; };
    return a;
  };
}

template <class Block> Factory relative(double distance) {
  return plain<Block>([distance](Block &b, AxisRig &) {
    setDynamics(b);
    b.Distance = distance;
  });
}

/// A block with keys, which has no Done: it has what it wants at its velocity.
template <class Block> Factory keyed() {
  return [](AxisRig &rig) {
    auto h = std::make_shared<Held<Block, Nothing>>();
    setDynamics(h->block);
    Actor a = actorOf(rig, h);
    a.show = [h, &rig] {
      const Block &b = h->block;
      Shown s = showBlock(b);
      s.done = s.busy && rig.axis.fSetVelocity == b.Velocity;
      return s;
    };
    return a;
  };
}

const std::map<std::string, Factory> &positioning() {
  static const std::map<std::string, Factory> table{
      {"MC_MoveAbsolute", plain<pl::MC_MoveAbsolute>([](auto &b, AxisRig &) {
         setDynamics(b);
         b.Position = 90;
       })},
      {"MC_MoveRelative", relative<pl::MC_MoveRelative>(60)},
      {"MC_MoveAdditive", relative<pl::MC_MoveAdditive>(60)},
      {"MC_MoveSuperImposed", relative<pl::MC_MoveSuperImposed>(15)},
      {"MC_MoveVelocity", plain<pl::MC_MoveVelocity>([](auto &b, AxisRig &) {
         setDynamics(b);
         b.Direction = basic::MC_Direction__positive;
       })},
      {"SMC_MoveContinuousAbsolute", plain<pl::SMC_MoveContinuousAbsolute>([](auto &b, AxisRig &) {
         setDynamics(b);
         b.Position = 90;
         b.EndVelocity = 10;
         b.EndVelocityDirection = basic::MC_Direction__positive;
       })},
      {"SMC_MoveContinuousRelative", plain<pl::SMC_MoveContinuousRelative>([](auto &b, AxisRig &) {
         setDynamics(b);
         b.Distance = 60;
         b.EndVelocity = 10;
         b.EndVelocityDirection = basic::MC_Direction__positive;
       })},
      {"MC_Jog", keyed<pl::MC_Jog>()},
      {"MC_TorqueControl", plain<pl::MC_TorqueControl>([](auto &b, AxisRig &) { b.Torque = 2; })},
      {"MC_Halt", moving<pl::MC_Halt>()},
      {"MC_Stop", moving<pl::MC_Stop>()},
      {"MC_Home", plain<pl::MC_Home>([](auto &b, AxisRig &) {
         b.Position = 5;
         b.Deceleration = 50;
       })},
      {"SMC_Homing", plain<basic::SMC_Homing>([](auto &b, AxisRig &) {
         b.fVelocityFast = 10;
         b.fVelocitySlow = 2;
         b.fAcceleration = 50;
         b.fDeceleration = 50;
       })},
  };
  return table;
}

const std::map<std::string, Factory> &courses() {
  static const std::map<std::string, Factory> table{
      {"MC_PositionProfile",
       with<pl::MC_PositionProfile, pl::MC_TP_REF>([](auto &b, pl::MC_TP_REF &points) {
         points.Number_of_pairs = 2;
         points.IsAbsolute = 0;
         b.ArraySize = 2;
         for (int i = 0; i < 2; ++i) {
           setStep(points.MC_TP_Array.v[i]);
           points.MC_TP_Array.v[i].position = 10;
         }
         b.TimePosition = &points;
       })},
      {"MC_VelocityProfile",
       with<pl::MC_VelocityProfile, pl::MC_TV_REF>([](auto &b, pl::MC_TV_REF &points) {
         points.Number_of_pairs = 2;
         b.ArraySize = 2;
         for (int i = 0; i < 2; ++i) {
           setStep(points.MC_TV_Array.v[i]);
           points.MC_TV_Array.v[i].velocity = 10;
         }
         b.TimeVelocity = &points;
       })},
      {"MC_AccelerationProfile",
       with<pl::MC_AccelerationProfile, pl::MC_TA_REF>([](auto &b, pl::MC_TA_REF &points) {
         points.Number_of_pairs = 2;
         b.ArraySize = 2;
         for (int i = 0; i < 2; ++i) {
           setStep(points.MC_TA_Array.v[i]);
           points.MC_TA_Array.v[i].acceleration = i == 0 ? 5 : -5;
         }
         b.TimeAcceleration = &points;
       })},
      {"SMC_FollowPosition", following<basic::SMC_FollowPosition>()},
      {"SMC_FollowPositionVelocity", following<basic::SMC_FollowPositionVelocity>()},
      {"SMC_FollowVelocity", following<basic::SMC_FollowVelocity>()},
      {"SMC_FollowSetValues", following<basic::SMC_FollowSetValues>()},
      {"SMC_TrackSetValues", following<pl::SMC_TrackSetValues>()},
      {"SMC_ControlAxisByPos", following<basic::SMC_ControlAxisByPos>()},
      {"SMC_ControlAxisByPosVel", following<basic::SMC_ControlAxisByPosVel>()},
      {"SMC_ControlAxisByVel", following<basic::SMC_ControlAxisByVel>()},
  };
  return table;
}

const std::map<std::string, Factory> &couplings() {
  static const std::map<std::string, Factory> table{
      {"MC_GearIn", coupled<pl::MC_GearIn>([](auto &b, auto & /*leader*/, auto & /*slave*/) {
         b.Acceleration = 50;
         b.Deceleration = 50;
       })},
      {"MC_GearInPos", coupled<pl::MC_GearInPos>([](auto &b, auto &leader, auto &slave) {
         b.MasterSyncPosition = leader.ref.fSetPosition + 40;
         b.SlaveSyncPosition = slave.fSetPosition + 20 + 2 * slave.fSetVelocity;
       })},
      {"MC_Phasing", coupled<pl::MC_Phasing>([](auto &b, auto & /*leader*/, auto & /*slave*/) {
         setDynamics(b);
         b.PhaseShift = 15;
       })},
      {"MC_CamIn", coupled<pl::MC_CamIn>([](auto &b, auto &leader, auto & /*slave*/) {
         setDynamics(b);
         b.CamTableID.pCam = &leader.cam;
         b.CamTableID.Periodic = 1;
         b.CamTableID.MasterAbsolute = 0;
         b.CamTableID.SlaveAbsolute = 0;
         b.StartMode = pl::MC_StartMode__ramp_in;
       })},
      {"SMC_TrackAxis", coupled<pl::SMC_TrackAxis>(
                            [](auto &b, auto & /*leader*/, auto & /*slave*/) { setDynamics(b); })},
      {"SMC_BacklashCompensation",
       coupled<pl::SMC_BacklashCompensation>([](auto &b, auto & /*leader*/, auto & /*slave*/) {
         b.fBacklash = 0.5;
         b.fCompensationVel = 20;
         b.fCompensationAcc = b.fCompensationDec = 50;
       })},
      {"MC_GearOut", uncoupling<pl::MC_GearOut>()},
      {"MC_CamOut", uncoupling<pl::MC_CamOut>()},
  };
  return table;
}

} // namespace

Actor makeActor(AxisRig &rig, const std::string &block) {
  for (const auto *table : {&positioning(), &courses(), &couplings(), &administrativeActors()})
    if (const auto found = table->find(block); found != table->end())
      return found->second(rig);
  throw std::invalid_argument("no block " + block);
}

} // namespace stride::test
