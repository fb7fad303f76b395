// Tappet bits against a record of everything that has happened.
#include "motion_problems.hpp"

#include "runtime/axis/cam/tappet_bits.hpp"

#include "st/SM_DriveBasic/SMC_CAMTAPPETACTION.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace {

namespace cam = stride::cam;
using stride::test::casesOf;
using stride::test::MotionRandom;

/// One tappet bit and all its times.
struct Model {
  struct Time {
    int64_t begin;
    int64_t end;
    int64_t shown; ///< The cycle that has shown it first; -1: none yet.
  };
  bool bit = false;
  std::vector<Time> times;

  void end(int64_t now) {
    std::erase_if(times, [now](const Time &time) { return time.begin <= now; });
  }
  bool runs(int64_t now) const {
    return std::any_of(times.begin(), times.end(),
                       [now](const Time &time) { return time.begin <= now && now < time.end; });
  }
  void take(const cam::TappetEvent &event) {
    const int64_t now = event.liTime;
    if (event.cta == st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_on) {
      bit = true;
    } else if (event.cta == st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_off) {
      bit = false;
      end(now);
    } else if (event.cta == st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_inv) {
      const bool was = bit || runs(now);
      bit = !was;
      end(now);
    } else {
      const int64_t begin = now + int64_t{event.dwDelay} * 1000;
      times.push_back({begin, begin + int64_t{event.dwDuration} * 1000, -1});
    }
  }
  bool show(int64_t now) {
    bool shown = bit;
    for (Time &time : times) {
      if (time.begin > now)
        continue;
      if (time.shown < 0)
        time.shown = now;
      shown = shown || now < time.end || time.shown == now;
    }
    return shown;
  }
};

TEST(TappetBitsProperty, AreWhatTheRecordSays) {
  MotionRandom random(7101);
  int64_t changes = 0;
  for (int i = 0; i < casesOf(5000); ++i) {
    constexpr int16_t kGroups = 3;
    constexpr int16_t kTimers = 64;
    cam::TappetTimer memory[kTimers];
    int16_t count = 0;
    const cam::TappetTimers times{memory, kTimers, count};
    bool bits[kGroups] = {};
    Model models[kGroups];
    bool old[kGroups] = {};
    for (int64_t cycle = 1; cycle < 60; ++cycle) {
      const int64_t now = cycle * 1000000;
      for (int events = random.below(3); events > 0; --events) {
        cam::TappetEvent event{};
        event.iGroupID = static_cast<int16_t>(random.below(kGroups));
        event.cta = static_cast<int16_t>(random.chance(0.6) ? 3 : random.below(3));
        event.dwDelay = static_cast<uint32_t>(random.below(6000));
        event.dwDuration =
            static_cast<uint32_t>(random.chance(0.2) ? random.below(2) : random.below(8000));
        event.liTime = now - (events > 1 ? 500000 : 0);
        cam::switchTappet(bits[event.iGroupID], times, event);
        models[event.iGroupID].take(event);
      }
      for (int16_t group = 0; group < kGroups; ++group) {
        const bool shown = bits[group] || cam::isTimed(times, group, now);
        ASSERT_EQ(shown, models[group].show(now)) << "case " << i << ", cycle " << cycle;
        changes += shown != old[group];
        old[group] = shown;
      }
      cam::forgetTimes(times, now);
      if (random.chance(0.3)) { // called once more in the same cycle
        for (int16_t group = 0; group < kGroups; ++group)
          ASSERT_EQ(bits[group] || cam::isTimed(times, group, now), old[group]);
        cam::forgetTimes(times, now);
      }
      ASSERT_LE(count, kTimers);
    }
  }
  EXPECT_GT(changes, casesOf(100000));
}

/// With little room for times a bit is never FALSE where it should be TRUE, unless it is switched
/// off.
TEST(TappetBitsProperty, NoRoomLosesNoTime) {
  MotionRandom random(7102);
  int full = 0;
  for (int i = 0; i < casesOf(5000); ++i) {
    constexpr int16_t kGroups = 3;
    cam::TappetTimer memory[kGroups];
    int16_t count = 0;
    const cam::TappetTimers times{memory, kGroups, count};
    bool bit = false;
    Model models[kGroups];
    for (int64_t cycle = 1; cycle < 60; ++cycle) {
      const int64_t now = cycle * 1000000;
      for (int events = random.below(3); events > 0; --events) {
        cam::TappetEvent event{};
        event.iGroupID = static_cast<int16_t>(random.below(kGroups));
        event.cta = st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_time;
        event.dwDelay = static_cast<uint32_t>(random.below(6000));
        event.dwDuration = static_cast<uint32_t>(random.below(8000));
        event.liTime = now;
        cam::switchTappet(bit, times, event);
        models[event.iGroupID].take(event);
        ASSERT_LE(count, kGroups);
      }
      full += count == kGroups;
      for (int16_t group = 0; group < kGroups; ++group) {
        const bool shown = cam::isTimed(times, group, now);
        const bool runs = models[group].runs(now);
        ASSERT_TRUE(shown || !runs) << "case " << i << ", cycle " << cycle;
      }
      cam::forgetTimes(times, now);
    }
  }
  EXPECT_GT(full, casesOf(10000));
}

} // namespace
