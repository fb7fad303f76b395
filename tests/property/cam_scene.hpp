// One slave, one master, one cam and MC_CamIn, cycle by cycle without an application.
#ifndef STRIDE_TESTS_PROPERTY_CAM_SCENE_HPP
#define STRIDE_TESTS_PROPERTY_CAM_SCENE_HPP

#include "cam_model.hpp"
#include "motion_problems.hpp"

#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_CamIn.h"
#include "st/SM_PLCopen/MC_CamTableSelect.h"

#include <utility>

namespace stride::test {

inline constexpr double kCamCycle = 0.002;

/// One slave, one master, one cam.
struct CamScene {
  AxisRig rig{kCamCycle};
  ModelMaster master;
  ModelCam cam;
  CamSettings settings;
  CamRef camRef;
  ::st::SM_PLCopen::MC_CamTableSelect select = fresh<::st::SM_PLCopen::MC_CamTableSelect>();
  ::st::SM_PLCopen::MC_CamIn camIn = fresh<::st::SM_PLCopen::MC_CamIn>();

  CamScene(double masterPeriod, double slavePeriod, ModelCam theCam)
      : master(kCamCycle, masterPeriod), cam(std::move(theCam)), camRef(cam.ref()) {
    rig.axis.dwRatioTechUnitsDenom = 100;
    if (slavePeriod > 0)
      rig.makeRotary(slavePeriod);
  }

  /// The slave's position becomes `position` without a motion. Needs power.
  void placeSlave(double position) {
    auto set = fresh<::st::SM_PLCopen::MC_SetPosition>();
    set.Axis = &rig.axis;
    set.Position = position;
    rig.cycle([&] { rig.call(set, true); });
    ASSERT_EQ(set.ErrorID, 0);
  }

  /// MC_CamTableSelect and all inputs of MC_CamIn; moves nothing.
  void prepare() {
    select.Master = &master.ref;
    select.Slave = &rig.axis;
    select.CamTable = &camRef;
    select.Periodic = settings.periodic;
    select.MasterAbsolute = settings.masterAbsolute;
    rig.call(select, false);
    rig.call(select, true);
    camIn.Master = &master.ref;
    camIn.Slave = &rig.axis;
    camIn.CamTableID = select.CamTableID;
    camIn.MasterOffset = settings.masterOffset;
    camIn.MasterScaling = settings.masterScaling;
    camIn.SlaveOffset = settings.slaveOffset;
    camIn.SlaveScaling = settings.slaveScaling;
  }

  /// Shifts the cam so that the master is in it, `part` of the way through: elsewhere MC_CamIn
  /// does not start.
  void putCamUnderMaster(double part) {
    const double x = cam.start() + part * static_cast<double>(cam.length());
    settings.masterOffset =
        settings.masterAbsolute ? x - master.position() * settings.masterScaling : x;
    camIn.MasterOffset = settings.masterOffset;
  }

  [[nodiscard]] bool rotarySlave() const { return rig.axis.iMovementType == 0; }

  /// The slave's position minus `position`, on a rotary axis the shorter way.
  [[nodiscard]] long double offFrom(long double position) const {
    const long double off = rig.axis.fSetPosition - position;
    if (!rotarySlave())
      return off;
    const long double period = rig.axis.fPositionPeriod;
    return off - period * std::round(off / period);
  }
};

/// How the master goes on.
class MasterCourse {
public:
  /// Velocities so that `length` is passed in 1/5 cycle to 10,000 cycles.
  MasterCourse(Random &random, double length)
      : random_(random), top_(length / kCamCycle * random.magnitude(-4, 0.7)) {}

  double next() {
    if (random_.chance(0.05)) {
      wanted_ = random_.chance(0.2) ? 0 : top_ * random_.uniform(-1, 1);
      rate_ = top_ * random_.magnitude(-2, 0);
    }
    velocity_ += std::clamp(wanted_ - velocity_, -rate_, rate_);
    return velocity_;
  }

private:
  Random &random_;
  double top_;
  double wanted_ = 0, rate_ = 0, velocity_ = 0;
};

/// A cam from 0 on, from 0 on.
inline ModelCam cornerCam(Random &random) {
  ModelCam cam;
  do
    cam = randomCam(random, true);
  while (cam.type != 3);
  const double x0 = cam.nodes.front().dX;
  const double y0 = cam.nodes.front().dY;
  for (auto &node : cam.nodes) {
    node.dX -= x0;
    node.dY -= y0;
  }
  return cam;
}

/// Any settings.
inline CamSettings randomSettings(Random &random, const ModelCam &cam) {
  CamSettings s;
  s.periodic = random.chance(0.6);
  s.masterAbsolute = random.chance(0.6);
  s.relative = random.chance(0.4);
  if (random.chance(0.6))
    s.masterScaling = random.sign() * random.magnitude(-2, 2);
  if (random.chance(0.5))
    s.masterOffset = static_cast<double>(cam.length()) * random.uniform(-2, 2);
  if (random.chance(0.5))
    s.slaveScaling = random.sign() * random.magnitude(-2, 2);
  if (random.chance(0.5))
    s.slaveOffset = random.uniform(-500, 500);
  return s;
}

} // namespace stride::test

#endif
