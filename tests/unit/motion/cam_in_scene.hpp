#ifndef STRIDE_TESTS_UNIT_MOTION_CAM_IN_SCENE_HPP
#define STRIDE_TESTS_UNIT_MOTION_CAM_IN_SCENE_HPP
// Cams and scenes for the tests of MC_CamIn.

#include "tests/property/cam_scene.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace stride::test {

/// Straight.
inline ModelCam line(double length, double height) {
  ModelCam cam;
  cam.nodes = {{0, 0, height / length, 0}, {length, height, height / length, 0}};
  return cam;
}

/// From rest to rest.
inline ModelCam hill(double length, double height) {
  ModelCam cam;
  cam.nodes = {{0, 0, 0, 0}, {length / 2, height, 0, 0}, {length, 0, 0, 0}};
  return cam;
}

/// A scene in power, the master at `position`, nothing started.
inline std::unique_ptr<CamScene> ready(const ModelCam &cam, double masterPeriod = 0,
                                       double slavePeriod = 0, double position = 0) {
  auto scene = std::make_unique<CamScene>(masterPeriod, slavePeriod, cam);
  EXPECT_GT(scene->rig.powerUp(), 0);
  scene->master.place(position);
  scene->prepare();
  EXPECT_EQ(scene->select.ErrorID, 0);
  return scene;
}

/// One cycle in which the master moves on with `velocity`.
inline void go(CamScene &scene, double velocity, bool execute = true) {
  scene.rig.cycle([&] {
    scene.master.step(velocity);
    scene.rig.call(scene.camIn, execute);
  });
}

} // namespace stride::test

#endif // STRIDE_TESTS_UNIT_MOTION_CAM_IN_SCENE_HPP
