// Tappets at the edges: under the master at the start, at the ends of the cam, at a turn; times.
#include "runtime/axis/cam/tappets.hpp"

#include "st/SM_DriveBasic/SMC_CAMTAPPETTYPE.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace {

namespace cam = stride::cam;

/// A cam from 0 to 10 whose tappets have the groups 0, 1, 2 ... and count both ways.
class Scene {
public:
  explicit Scene(const std::vector<double> &places, bool periodic = true) : periodic_(periodic) {
    for (const double x : places) {
      cam::Tappet tappet{};
      tappet.x = x;
      tappet.iGroupID = static_cast<int16_t>(tappets_.size());
      tappet.ctt = st::SM_DriveBasic::SMC_CAMTAPPETTYPE__TAPPET_all;
      tappets_.push_back(tappet);
    }
  }

  void begin(double position) { cam::beginTappets(state_, place(position), now_); }

  /// The passes on the way to `position`: "+0 -1".
  std::string move(double position, double hysteresis = 0.0) {
    now_ += 1000;
    cam::followTappets(state_, list(), place(position), hysteresis, now_);
    return take();
  }

  std::string take() {
    std::string text;
    times.clear();
    cam::TappetEvent event{};
    while (cam::nextTappet(state_, list(), event)) {
      text += (text.empty() ? "" : " ") + std::string(event.bNegative != 0 ? "-" : "+") +
              std::to_string(event.iGroupID);
      times.push_back(event.liTime);
    }
    return text;
  }

  cam::TappetList list() const {
    return {tappets_.data(), static_cast<int32_t>(tappets_.size()), 0.0, 10.0, periodic_};
  }
  cam::Place place(double position) const {
    return periodic_ ? cam::placeOf({position, 0.0}, 0.0, 10.0) : cam::Place{0, position};
  }

  std::vector<int64_t> times; ///< Of the passes taken last.

protected:
  bool periodic_;
  std::vector<cam::Tappet> tappets_;
  cam::TappetState state_{};
  int64_t now_ = 0;
};

TEST(Tappets, AreReachedForwardsAndLeftBackwards) {
  Scene scene({5});
  scene.begin(4);
  EXPECT_EQ(scene.move(4.9), "");
  EXPECT_EQ(scene.move(5), "+0");
  EXPECT_EQ(scene.move(5), "");
  EXPECT_EQ(scene.move(4.9), "-0");
  EXPECT_EQ(scene.move(5), "+0");
  EXPECT_EQ(scene.move(6), "");
  EXPECT_EQ(scene.move(5), "");
  EXPECT_EQ(scene.move(5.5), "");
  EXPECT_EQ(scene.move(4), "-0");
}

TEST(Tappets, UnderTheMasterAtTheStartCountWhenItLeaves) {
  Scene forwards({5});
  forwards.begin(5);
  EXPECT_EQ(forwards.move(5), "");
  EXPECT_EQ(forwards.move(5.1), "+0");
  EXPECT_EQ(forwards.move(4), "-0");

  Scene backwards({5});
  backwards.begin(5);
  EXPECT_EQ(backwards.move(4.9), "-0");
  EXPECT_EQ(backwards.move(5), "+0");
}

TEST(Tappets, AtTheSeamOfAPeriodicCam) {
  Scene scene({0, 10});
  scene.begin(0);
  EXPECT_EQ(scene.move(1), "+1 +0");
  EXPECT_EQ(scene.move(9), "");
  EXPECT_EQ(scene.move(10), "+1 +0");
  EXPECT_EQ(scene.move(9), "-0 -1");
  EXPECT_EQ(scene.move(20), "+1 +0 +1 +0");
  EXPECT_EQ(scene.move(0), "-0 -1 -0 -1"); // leaves 20 and 10, reaches 0
  EXPECT_EQ(scene.move(-1), "-0 -1");
}

TEST(Tappets, AtTheEndsOfACamThatIsNotPeriodic) {
  Scene scene({0, 10, 11, -1}, false); // the last two do not exist
  scene.begin(-5);
  EXPECT_EQ(scene.move(-0.5), "");
  EXPECT_EQ(scene.move(0), "+0");
  EXPECT_EQ(scene.move(10), "+1");
  EXPECT_EQ(scene.move(25), "");
  EXPECT_EQ(scene.move(-5), "-1 -0");
}

TEST(Tappets, OfOnePlaceComeInTheOrderOfTheList) {
  Scene scene({5, 3, 5, 5});
  scene.begin(4);
  EXPECT_EQ(scene.move(6), "+0 +2 +3");
  EXPECT_EQ(scene.move(2), "-0 -2 -3 -1");
}

TEST(Tappets, HysteresisForgetsNoTurnThatIsLargeEnough) {
  Scene scene({5});
  scene.begin(4);
  EXPECT_EQ(scene.move(5, 0.5), "+0");
  EXPECT_EQ(scene.move(4.6, 0.5), "");
  EXPECT_EQ(scene.move(5.125, 0.5), "");
  EXPECT_EQ(scene.move(4.625, 0.5), ""); // 0.5 back: not more
  EXPECT_EQ(scene.move(4.5, 0.5), "-0");
  EXPECT_EQ(scene.move(5.0, 0.5), "");
  EXPECT_EQ(scene.move(5.1, 0.5), "+0");
}

TEST(Tappets, PassBetweenTwoCyclesInProportionToTheWay) {
  Scene scene({5, 6, 8});
  scene.begin(4);
  EXPECT_EQ(scene.move(8), "+0 +1 +2");
  EXPECT_EQ(scene.times, (std::vector<int64_t>{250, 500, 1000}));
  EXPECT_EQ(scene.move(6), "-2");
  EXPECT_EQ(scene.times, (std::vector<int64_t>{1000}));
}

TEST(Tappets, WhatHasNoPlaceIsNeverPassed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scene scene({nan, std::numeric_limits<double>::infinity(), 5}, false);
  scene.begin(0);
  EXPECT_EQ(scene.move(7), "+2");
  EXPECT_EQ(scene.move(nan), "");
  EXPECT_EQ(scene.move(std::numeric_limits<double>::infinity()), "");
  EXPECT_EQ(scene.move(4), "-2");
}

TEST(Tappets, OnlyTheWayAskedForCounts) {
  Scene both({5});
  cam::Tappet forwards{};
  forwards.x = 5;
  forwards.iGroupID = 1;
  forwards.ctt = st::SM_DriveBasic::SMC_CAMTAPPETTYPE__TAPPET_pos;
  cam::Tappet backwards = forwards;
  backwards.iGroupID = 2;
  backwards.ctt = st::SM_DriveBasic::SMC_CAMTAPPETTYPE__TAPPET_neg;
  const cam::Tappet tappets[] = {forwards, backwards};
  const cam::TappetList list{tappets, 2, 0.0, 10.0, false};
  cam::TappetState state{};
  cam::beginTappets(state, {0, 4}, 0);
  cam::TappetEvent event{};
  cam::followTappets(state, list, {0, 6}, 0.0, 1);
  ASSERT_TRUE(cam::nextTappet(state, list, event));
  EXPECT_EQ(event.iGroupID, 1);
  EXPECT_FALSE(cam::nextTappet(state, list, event));
  cam::followTappets(state, list, {0, 4}, 0.0, 2);
  ASSERT_TRUE(cam::nextTappet(state, list, event));
  EXPECT_EQ(event.iGroupID, 2);
  EXPECT_FALSE(cam::nextTappet(state, list, event));
}

/// The seventeenth turn has to wait until a leg is reported; what was passed on it before counts as
/// not passed.
TEST(Tappets, WaitThroughSixteenLegs) {
  Scene scene({5});
  scene.begin(4);
  cam::TappetState state{};
  const cam::TappetList list = scene.list();
  cam::beginTappets(state, {0, 4}, 0);
  for (int i = 1; i <= 17; ++i)
    cam::followTappets(state, list, {0, i % 2 == 1 ? 6.0 : 4.0}, 0.0, i);
  cam::TappetEvent event{};
  int passes = 0;
  while (cam::nextTappet(state, list, event))
    ++passes;
  EXPECT_EQ(passes, 16);
  cam::followTappets(state, list, {0, 6.0}, 0.0, 18);
  EXPECT_TRUE(cam::nextTappet(state, list, event));
}

} // namespace
