// From one cam to the next, by a second MC_CamIn that waits (BufferMode) and by another CamTableID:
// nothing of the master's way gets lost, and no tappet.
#include "cam_scene.hpp"

#include "st/SM_DriveBasic/SMC_CAMTAPPETTYPE.h"
#include "st/SM_DriveBasic/SMC_CAMTappet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace stride::test;
namespace db = ::st::SM_DriveBasic;
namespace pl = ::st::SM_PLCopen;

constexpr int kBuffered = 1;

/// A cam whose tappets lie in heaps, some of them at its very end, each with a group of its own.
struct TappetCam {
  ModelCam cam;
  CamRef ref;
  std::vector<db::SMC_CAMTappet> tappets;
  std::vector<int> order; ///< Groups as they are passed forwards.

  TappetCam(Random &random, int firstGroup) : cam(cornerCam(random)), ref(cam.ref()) {
    const auto length = static_cast<double>(cam.length());
    const int count = 4 + random.below(8);
    for (int i = 0; i < count; ++i) {
      db::SMC_CAMTappet tappet{};
      tappet.x = length *
                 (random.chance(0.6) ? random.uniform(0.95, 0.999) : random.uniform(0.001, 0.999));
      tappet.iGroupID = static_cast<int16_t>(firstGroup + i);
      tappet.ctt = static_cast<int16_t>(db::SMC_CAMTAPPETTYPE__TAPPET_pos);
      tappets.push_back(tappet);
    }
    std::vector<db::SMC_CAMTappet> sorted = tappets;
    std::sort(sorted.begin(), sorted.end(), [](const auto &a, const auto &b) { return a.x < b.x; });
    for (const auto &tappet : sorted)
      order.push_back(tappet.iGroupID);
    ref.nTappets = static_cast<int16_t>(count);
    ref.pt = tappets.data();
  }
  TappetCam(const TappetCam &) = delete;
};

/// What an instance of MC_CamIn tells, call by call.
struct Listener {
  uint64_t reports = 0;
  std::vector<int> groups;
  std::vector<int64_t> times;

  void listen(const pl::SMC_TappetData &data) {
    if (data.ulReports == reports)
      return;
    reports = data.ulReports;
    for (int i = 0; i < data.iCount; ++i) {
      groups.push_back(data.aEvents.v[i].iGroupID);
      times.push_back(data.aEvents.v[i].liTime);
    }
  }
};

pl::MC_CAM_ID idOf(CamScene &scene, CamRef &ref, bool periodic) {
  auto select = fresh<pl::MC_CamTableSelect>();
  select.Master = &scene.master.ref;
  select.Slave = &scene.rig.axis;
  select.CamTable = &ref;
  select.Periodic = periodic;
  select.MasterAbsolute = select.SlaveAbsolute = 0;
  scene.rig.call(select, true);
  EXPECT_EQ(select.ErrorID, 0);
  return select.CamTableID;
}

/// Two cams, one after the other, under a master that goes forwards in them.
struct Handover {
  Random random;
  TappetCam first{random, 1};
  TappetCam second{random, 101};
  bool periodic = random.chance(0.5);
  double scaling = random.chance(0.5) ? 1 : random.sign() * random.magnitude(-1, 1);
  double stretch = random.chance(0.5) ? 1 : random.sign() * random.magnitude(-1, 1);
  double shortest = static_cast<double>(std::min(first.cam.length(), second.cam.length()));
  double longest = static_cast<double>(std::max(first.cam.length(), second.cam.length()));
  CamScene scene;
  double velocity = shortest / scaling / kCamCycle * random.uniform(0.01, 0.3);
  long double begun = 0; ///< The master's place where the first cam begins.
  long double base = 0;  ///< The slave's.

  explicit Handover(uint64_t seed)
      : random(seed), scene(random.chance(0.5) ? shortest * random.magnitude(-0.5, 1) : 0,
                            random.chance(0.5) ? random.magnitude(-1, 3) : 0, first.cam) {
    scene.settings.masterScaling = scaling;
    scene.settings.slaveScaling = stretch;
    EXPECT_GT(scene.rig.powerUp(), 0);
    scene.placeSlave(random.uniform(-100, 100));
    scene.master.place(random.uniform(-100, 100));
    scene.prepare();
    scene.camIn.CamTableID = idOf(scene, first.ref, periodic);
    scene.camIn.StartMode = 1;
    // As fast as a rotary master can be seen to go.
    if (scene.master.isRotary())
      velocity = std::clamp(velocity, -0.4 * scene.master.ref.fPositionPeriod / kCamCycle,
                            0.4 * scene.master.ref.fPositionPeriod / kCamCycle);
  }

  void begin() {
    begun = scene.master.total();
    base = scene.rig.axis.fSetPosition;
  }
  /// The master's way in the cams since the start of the first one.
  [[nodiscard]] long double way() const { return (scene.master.total() - begun) * scaling; }

  /// The slave is where the second cam has it, that begins where the first one ends.
  void checkSecond() const {
    const long double x = way() - first.cam.length();
    ASSERT_GE(x, 0);
    if (x > second.cam.length())
      return; // it has begun again, or is over
    const long double y = base + stretch * (first.cam.rise() + second.cam.at(x).y);
    const long double size =
        std::fabs(static_cast<long double>(stretch)) * (first.cam.scale().y + second.cam.scale().y);
    ASSERT_LE(std::fabs(scene.offFrom(y)), 1e-9L * size + 1e-9L) << static_cast<double>(x);
  }
};

/// Each tappet once, in order, those of `before` first; a cam that goes on begins with its first
/// one again.
void checkPasses(const Listener &seen, const std::vector<int> &before,
                 const std::vector<int> &order) {
  ASSERT_GE(seen.groups.size(), before.size());
  for (size_t i = 0; i < seen.groups.size(); ++i)
    ASSERT_EQ(seen.groups[i],
              i < before.size() ? before[i] : order[(i - before.size()) % order.size()])
        << i;
  ASSERT_TRUE(std::is_sorted(seen.times.begin(), seen.times.end()));
}

TEST(CamHandover, ACamThatHasWaitedBeginsWhereTheLastOneHasEnded) {
  int cases = 0;
  int sameCycle = 0;
  for (int i = 0; i < casesOf(1500) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Handover h(static_cast<uint64_t>(i));
    if (h.longest > 10 * h.shortest)
      continue; // thousands of cycles
    ++cases;
    const bool secondIsCalledFirst = h.random.chance(0.5);
    auto next = h.scene.camIn;
    next.CamTableID = idOf(h.scene, h.second.ref, h.periodic);
    next.BufferMode = kBuffered;
    Listener first;
    Listener second;
    int active = 0;
    for (int cycle = 0; active < 6 && !HasFailure(); ++cycle) {
      SCOPED_TRACE("cycle " + std::to_string(cycle));
      ASSERT_LT(cycle, 2000);
      h.scene.rig.ctx.cycleStartNs += 2'000'000;
      h.scene.rig.cycle([&] {
        h.scene.master.step(h.velocity);
        if (cycle == 0)
          h.begin();
        if (secondIsCalledFirst && cycle > 0)
          h.scene.rig.call(next, true);
        h.scene.rig.call(h.scene.camIn, true);
        if (!secondIsCalledFirst || cycle == 0)
          h.scene.rig.call(next, true);
        first.listen(h.scene.camIn.Tappets);
        second.listen(next.Tappets);
        ASSERT_EQ(h.scene.camIn.ErrorID, 0);
        ASSERT_EQ(next.ErrorID, 0);
        ASSERT_EQ(next.Active != 0, next.InSync != 0);
        if (next.Active == 0)
          return;
        sameCycle +=
            active == 0 && h.way() - h.first.cam.length() <= h.velocity * h.scaling * kCamCycle;
        ++active;
        h.checkSecond();
      });
    }
    // What the first one has passed comes in threes.
    for (int k = 0; k < 8; ++k)
      h.scene.rig.cycle([&] {
        h.scene.rig.call(h.scene.camIn, true);
        first.listen(h.scene.camIn.Tappets);
      });
    ASSERT_EQ(first.groups.size(), h.first.order.size());
    checkPasses(first, h.first.order, h.second.order);
    checkPasses(second, {}, h.second.order);
  }
  std::cout << cases << " cases, " << sameCycle << " in the same cycle\n";
  EXPECT_GT(sameCycle, cases / 3);
}

TEST(CamHandover, AnotherCamTableIDLosesNoTappet) {
  int cases = 0;
  int waited = 0;
  for (int i = 0; i < casesOf(1500) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Handover h(static_cast<uint64_t>(i));
    if (h.longest > 10 * h.shortest)
      continue; // thousands of cycles
    ++cases;
    Listener seen;
    bool changed = false;
    // Until the second cam is passed, too.
    const long double both = h.first.cam.length() + 0.99L * h.second.cam.length();
    for (int cycle = 0; cycle == 0 || h.way() < both; ++cycle) {
      ASSERT_LT(cycle, 2000);
      h.scene.rig.ctx.cycleStartNs += 2'000'000;
      h.scene.rig.cycle([&] {
        if (cycle > 0)
          h.scene.master.step(h.velocity);
        else
          h.begin();
        h.scene.rig.call(h.scene.camIn, true);
        if (cycle == 0)
          h.scene.camIn.CamTableID = idOf(h.scene, h.second.ref, h.periodic);
        const size_t before = seen.groups.size();
        seen.listen(h.scene.camIn.Tappets);
        ASSERT_EQ(h.scene.camIn.ErrorID, 0);
        if (!changed && h.way() > h.first.cam.length()) {
          changed = true;
          waited += before + 3 < h.first.order.size();
          h.checkSecond();
        }
      });
      if (HasFailure())
        return;
    }
    for (int k = 0; k < 8; ++k) {
      h.scene.rig.ctx.cycleStartNs += 2'000'000;
      h.scene.rig.cycle([&] {
        h.scene.master.step(0);
        h.scene.rig.call(h.scene.camIn, true);
        seen.listen(h.scene.camIn.Tappets);
      });
    }
    checkPasses(seen, h.first.order, h.second.order);
  }
  std::cout << cases << " cases, tappets have waited in " << waited << "\n";
  EXPECT_GT(waited, cases / 5);
}

} // namespace
