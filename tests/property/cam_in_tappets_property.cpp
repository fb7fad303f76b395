// Tappets of MC_CamIn, seen by SMC_GetTappetValue, against a walk of the master in small steps.
#include "cam_scene.hpp"

#include "st/SM_DriveBasic/SMC_CAMTAPPETACTION.h"
#include "st/SM_DriveBasic/SMC_CAMTAPPETTYPE.h"
#include "st/SM_DriveBasic/SMC_CAMTappet.h"
#include "st/SM_PLCopen/SMC_GetTappetValue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace stride::test;
namespace db = ::st::SM_DriveBasic;
namespace pl = ::st::SM_PLCopen;

constexpr long kSteps = 16; ///< Of the walk in one unit; the master stops at even ones only.

struct Pass {
  int group;
  int action;
  bool negative;
};

struct TappetCounts {
  long passes = 0, waited = 0, pulses = 0, changes = 0;
};

/// One cam with tappets where the master never stops, and the passes of a walk over it.
class Walk {
public:
  Walk(Random &random, bool periodic, bool timed)
      : periodic_(periodic), start_(kSteps * (random.below(21) - 10)),
        length_(kSteps * (2 + random.below(30))) {
    const int count = 1 + random.below(timed ? 1 : 9);
    for (int i = 0; i < count; ++i) {
      db::SMC_CAMTappet tappet{};
      place_.push_back(start_ + 1 + 2 * random.below(static_cast<int>(length_ / 2)));
      tappet.x = static_cast<double>(place_.back()) / kSteps;
      tappet.iGroupID = static_cast<int16_t>(timed ? 9 : 1 + random.below(3));
      tappet.ctt = static_cast<int16_t>(random.below(3));
      tappet.cta = static_cast<int16_t>(timed ? 3 : random.below(3));
      if (timed) {
        tappet.dwDelay = static_cast<uint32_t>(random.chance(0.3) ? 0 : random.below(9000));
        tappet.dwDuration = static_cast<uint32_t>(random.below(12000));
      }
      tappets.push_back(tappet);
    }
  }

  [[nodiscard]] ModelCam cam() const {
    ModelCam cam;
    cam.nodes = {{static_cast<double>(start_) / kSteps, 0, 0, 0},
                 {static_cast<double>(start_ + length_) / kSteps, 10, 0, 0}};
    return cam;
  }

  /// All passes on the way from one even step to another, with the step after which they are.
  template <class Found> void walk(long from, long to, Found found) const {
    const long step = to > from ? 1 : -1;
    for (long at = from; at != to; at += step) {
      const long next = at + step; // crossed when odd
      long x = next;
      if (periodic_) {
        x = (next - start_) % length_;
        x = start_ + (x < 0 ? x + length_ : x);
      }
      for (size_t i = 0; i < tappets.size(); ++i) {
        const bool negative = step < 0;
        if (place_[i] != x || tappets[i].ctt == (negative ? 0 : 2))
          continue;
        found(Pass{tappets[i].iGroupID, tappets[i].cta, negative},
              static_cast<double>(next - from) / static_cast<double>(to - from));
      }
    }
  }

  std::vector<db::SMC_CAMTappet> tappets;
  [[nodiscard]] long start() const { return start_; }
  [[nodiscard]] long length() const { return length_; }

private:
  bool periodic_;
  long start_, length_;
  std::vector<long> place_;
};

/// A master that goes in even steps; its place in the cam is scale * master + offset.
class TappetCase {
public:
  TappetCase(uint64_t seed, bool timed)
      : random_(seed), periodic_(random_.chance(0.7)), walk_(random_, periodic_, timed),
        masterPeriod_(random_.chance(0.5) ? 2 * kSteps * (1 + random_.below(40)) : 0),
        scene_(static_cast<double>(masterPeriod_) / kSteps, 0, walk_.cam()) {
    scene_.settings.periodic = periodic_;
    scale_ = random_.chance(0.5) ? 1 : random_.chance(0.5) ? -1 : 2;
    scene_.settings.masterScaling = static_cast<double>(scale_);
    offset_ = 2 * (random_.below(200) - 100);
    scene_.settings.masterOffset = static_cast<double>(offset_) / kSteps;
    scene_.camRef.nTappets = static_cast<int16_t>(walk_.tappets.size());
    scene_.camRef.pt = walk_.tappets.data();
  }

  /// The master, anywhere in the cam.
  void begin() {
    ASSERT_GT(scene_.rig.powerUp(), 0);
    const long x = walk_.start() + 2 * random_.below(static_cast<int>(walk_.length() / 2));
    if ((x - offset_) % (2 * scale_) != 0)
      offset_ += 2;
    scene_.settings.masterOffset = static_cast<double>(offset_) / kSteps;
    at_ = (x - offset_) / scale_;
    if (masterPeriod_ > 0 && (at_ < 0 || at_ >= masterPeriod_)) {
      // Where a rotary master shows it, which must be in the cam.
      offset_ += (at_ - ((at_ % masterPeriod_) + masterPeriod_) % masterPeriod_) * scale_;
      scene_.settings.masterOffset = static_cast<double>(offset_) / kSteps;
      at_ = ((at_ % masterPeriod_) + masterPeriod_) % masterPeriod_;
    }
    scene_.master.place(static_cast<double>(at_) / kSteps);
    scene_.prepare();
    ASSERT_EQ(scene_.select.ErrorID, 0);
  }

  /// One cycle further by so many even steps; the passes are pending then.
  template <class Found> void go(long way, Found found) {
    scene_.rig.ctx.cycleStartNs += 2'000'000;
    scene_.rig.cycle([&] {
      // The position is exact; the velocity says how many turns.
      const long to = at_ + way;
      if (way != 0)
        walk_.walk(at_ * scale_ + offset_, to * scale_ + offset_, found);
      const long turns = masterPeriod_ == 0 ? 0 : floorDiv(to, masterPeriod_);
      const double shown = static_cast<double>(to - turns * masterPeriod_) / kSteps;
      scene_.master.jumpTo(shown, turns, static_cast<double>(way) / kSteps / kCamCycle);
      at_ = to;
      scene_.rig.call(scene_.camIn, true);
      ASSERT_EQ(scene_.camIn.ErrorID, 0);
      for (auto &[group, value] : values)
        callValue(group, value);
    });
  }

  void addValue(int group, bool init) {
    values.emplace_back(group, fresh<pl::SMC_GetTappetValue>());
    values.back().second.bInitValue = init;
  }

  [[nodiscard]] const auto &data() const { return scene_.camIn.Tappets; }
  [[nodiscard]] int64_t now() const { return scene_.rig.ctx.cycleStartNs; }
  Random &random() { return random_; }
  [[nodiscard]] const Walk &walk() const { return walk_; }
  [[nodiscard]] long place() const { return at_ * scale_ + offset_; }
  [[nodiscard]] long most() const { return masterPeriod_ == 0 ? 400 : masterPeriod_ / 2; }

  std::vector<std::pair<int, pl::SMC_GetTappetValue>> values;

private:
  static long floorDiv(long a, long b) { return a / b - (a % b < 0 ? 1 : 0); }
  void callValue(int group, pl::SMC_GetTappetValue &value) {
    value.iID = static_cast<int16_t>(group);
    value.Tappets = &scene_.camIn.Tappets;
    value.body__(scene_.rig.ctx);
  }

  Random random_;
  bool periodic_;
  Walk walk_;
  long masterPeriod_;
  CamScene scene_;
  long scale_ = 1, offset_ = 0, at_ = 0;
};

TEST(CamInTappets, ArePassedInOrderThreePerCycleAndNoneIsLost) {
  TappetCounts counts;
  for (int i = 0; i < casesOf(4000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    TappetCase scene(static_cast<uint64_t>(i), false);
    Random &random = scene.random();
    scene.begin();
    std::vector<bool> bits;
    for (int group = 1; group <= 3; ++group) {
      bits.push_back(random.chance(0.5));
      scene.addValue(group, bits.back());
    }
    std::deque<Pass> pending;
    long way = 0;
    for (int cycle = 0; cycle < 80 && !HasFailure(); ++cycle) {
      SCOPED_TRACE("cycle " + std::to_string(cycle));
      // Steady enough that a velocity tells the turns; a rest now and then.
      if (cycle % 10 == 0)
        way = 2 * (random.below(static_cast<int>(scene.most() / 3) + 1) -
                   static_cast<int>(scene.most() / 6));
      if (cycle % 10 > 6 || pending.size() > 40)
        way = 0;
      scene.go(cycle == 0 ? 0 : way, [&](const Pass &pass, double) {
        pending.push_back(pass);
        ++counts.passes;
      });
      const auto &data = scene.data();
      ASSERT_EQ(data.iCount, static_cast<int>(std::min<size_t>(3, pending.size())));
      counts.waited += pending.size() > 3;
      for (int k = 0; k < data.iCount; ++k) {
        const auto &event = data.aEvents.v[k];
        const Pass &pass = pending.front();
        ASSERT_EQ(event.iGroupID, pass.group);
        ASSERT_EQ(event.cta, pass.action);
        ASSERT_EQ(event.bNegative != 0, pass.negative);
        const auto bit = static_cast<size_t>(pass.group - 1);
        const bool old = bits[bit];
        bits[bit] = pass.action == 0 || (pass.action == 2 && !old);
        counts.changes += old != bits[bit];
        pending.pop_front();
      }
      for (const auto &[group, value] : scene.values)
        ASSERT_EQ(value.bTappet != 0, bits[static_cast<size_t>(group - 1)]) << group;
    }
  }
  std::cout << counts.passes << " passes, " << counts.waited << " cycles with more than three, "
            << counts.changes << " changes\n";
  EXPECT_GT(counts.passes, casesOf(40000));
  EXPECT_GT(counts.waited, casesOf(1000));
}

TEST(CamInTappets, SwitchForATime) {
  TappetCounts counts;
  for (int i = 0; i < casesOf(4000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    TappetCase scene(static_cast<uint64_t>(i), true);
    Random &random = scene.random();
    scene.begin();
    scene.addValue(9, false);
    const auto &tappet = scene.walk().tappets[0];
    struct Pulse {
      double from, to; ///< [ns]
      bool shown;
    };
    std::vector<Pulse> pulses;
    const long way = 2 * (random.below(21) - 10);
    for (int cycle = 0; cycle < 60 && !HasFailure(); ++cycle) {
      const auto before = static_cast<double>(scene.now());
      scene.go(cycle == 0 ? 0 : way, [&](const Pass &, double part) {
        const double from = before + part * 2e6 + 1000.0 * tappet.dwDelay;
        pulses.push_back({from, from + 1000.0 * tappet.dwDuration, false});
        ++counts.pulses;
      });
      if (pulses.size() > 10)
        break; // more than may be timed at once
      const auto now = static_cast<double>(scene.now());
      bool on = false;
      bool doubt = false;
      for (Pulse &pulse : pulses) {
        doubt = doubt || std::fabs(now - pulse.from) < 2 || std::fabs(now - pulse.to) < 2;
        if (now >= pulse.from && (now < pulse.to || !pulse.shown)) {
          on = true;
          pulse.shown = true;
        }
      }
      if (doubt)
        break; // half a nanosecond decides
      ASSERT_EQ(scene.values[0].second.bTappet != 0, on)
          << cycle << " way " << way << " delay " << tappet.dwDelay << " duration "
          << tappet.dwDuration;
    }
  }
  std::cout << counts.pulses << " pulses\n";
  EXPECT_GT(counts.pulses, casesOf(4000));
}

} // namespace
