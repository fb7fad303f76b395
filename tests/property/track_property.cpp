// Digital cam switches against a course that is looked at in small steps.
#include "motion_problems.hpp"

#include "runtime/axis/cam/track.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

namespace cam = stride::cam;
using stride::test::casesOf;
using stride::test::MotionRandom;

constexpr double kGrid = 0.125; // all places are multiples, so that nothing is rounded
constexpr int64_t kCycle = 1000000;

cam::TrackAxis axisAt(double position, double velocity, double period) {
  return {{position, 0.0}, velocity, period};
}

/// Whether `position` is within, by definition.
bool within(double position, const cam::CamSwitch &camSwitch, double period) {
  const double first = camSwitch.FirstOnPosition;
  const double last = camSwitch.LastOnPosition;
  if (period <= 0)
    return first <= last ? position >= first && position <= last
                         : position >= first || position <= last;
  if (last - first >= period)
    return true;
  const double inside = position - period * std::floor(position / period);
  const double from = first - period * std::floor(first / period);
  const double to = last - period * std::floor(last / period);
  return from <= to ? inside >= from && inside <= to : inside >= from || inside <= to;
}

cam::CamSwitch randomSwitch(MotionRandom &random, int places) {
  cam::CamSwitch camSwitch{};
  camSwitch.TrackNumber = 1;
  const int before = places / 2;
  camSwitch.FirstOnPosition = (random.below(2 * places) - before) * kGrid;
  camSwitch.LastOnPosition = (random.below(2 * places) - before) * kGrid;
  camSwitch.AxisDirection = static_cast<int16_t>(random.below(3));
  return camSwitch;
}

TEST(TrackProperty, ByPositionIsOnWithinTheRange) {
  MotionRandom random(7201);
  int on = 0;
  int looks = 0;
  for (int i = 0; i < casesOf(20000); ++i) {
    const int places = 4 + random.below(30);
    const double period = random.chance(0.6) ? places * kGrid : 0.0;
    const cam::CamSwitch camSwitch = randomSwitch(random, places);
    ASSERT_TRUE(cam::isUsable(camSwitch));
    cam::TrackOptions options{};
    options.Hysteresis = random.chance(0.5) ? random.below(6) * kGrid : 0.0;
    double position = (random.below(4 * places) - 2 * places) * kGrid;
    double reached = position; // what the hysteresis lets through
    int direction = 0;
    cam::TrackState track{};
    cam::beginTrack(track, options, axisAt(position, 0, period));
    for (int cycle = 0; cycle < 20; ++cycle) {
      position += (random.below(9) - 4) * kGrid * (random.chance(0.2) ? 10 : 1);
      const double way = position - reached;
      const int turned = way > 0 ? 1 : -1;
      if (way != 0 &&
          (direction == 0 || turned == direction || std::abs(way) > options.Hysteresis)) {
        reached = position;
        direction = turned;
      }
      const cam::TrackAxis axis = axisAt(position, 0, period);
      cam::advanceTrack(track, options, axis);
      const bool wanted =
          camSwitch.AxisDirection == 0 || (camSwitch.AxisDirection == 1) == (direction > 0);
      const bool expected = within(reached, camSwitch, period) && wanted &&
                            (camSwitch.AxisDirection == 0 || direction != 0);
      ASSERT_EQ(cam::isOn(track, options, axis, camSwitch), expected)
          << "case " << i << ", cycle " << cycle;
      on += expected;
      ++looks;
    }
  }
  EXPECT_GT(on, looks / 10);
  EXPECT_LT(on, looks * 9 / 10);
}

/// At a constant velocity the output is on from OnCompensation after the range begins to
/// OffCompensation after it ends.
TEST(TrackProperty, CompensationMovesTheEdgesInTime) {
  MotionRandom random(7202);
  int on = 0;
  for (int i = 0; i < casesOf(20000); ++i) {
    const double period = random.chance(0.5) ? random.uniform(50, 200) : 0.0;
    const double velocity = random.sign() * random.uniform(1, 400);
    cam::CamSwitch camSwitch{};
    camSwitch.TrackNumber = 1;
    const double length = period > 0 ? random.uniform(0.1, 0.9) * period : random.uniform(1, 100);
    camSwitch.FirstOnPosition = random.uniform(-100, 100);
    camSwitch.LastOnPosition = camSwitch.FirstOnPosition + length;
    cam::TrackOptions options{};
    options.OnCompensation = random.uniform(-0.3, 0.3);
    options.OffCompensation = random.uniform(-0.3, 0.3);
    const double start =
        camSwitch.FirstOnPosition + random.uniform(-1, 1) * (period > 0 ? period : 200);
    // When the axis comes in and when it goes, in every turn that matters.
    std::vector<std::pair<double, double>> ranges;
    for (int turn = period > 0 ? -40 : 0; turn <= (period > 0 ? 40 : 0); ++turn) {
      const double a = (camSwitch.FirstOnPosition + turn * period - start) / velocity;
      const double b = (camSwitch.LastOnPosition + turn * period - start) / velocity;
      ranges.emplace_back(std::min(a, b) + options.OnCompensation,
                          std::max(a, b) + options.OffCompensation);
    }
    cam::TrackState track{};
    cam::beginTrack(track, options, axisAt(start, velocity, period));
    for (int cycle = 1; cycle < 200; ++cycle) {
      const double time = cycle * 0.004;
      const cam::TrackAxis axis = axisAt(start + velocity * time, velocity, period);
      cam::advanceTrack(track, options, axis);
      bool expected = false;
      bool edge = false;
      for (const auto &[begin, end] : ranges) {
        expected = expected || (time >= begin && time <= end);
        edge = edge || std::abs(time - begin) < 1e-9 || std::abs(time - end) < 1e-9;
      }
      if (!edge) {
        ASSERT_EQ(cam::isOn(track, options, axis, camSwitch), expected)
            << "case " << i << ", cycle " << cycle;
      }
      on += expected;
    }
  }
  EXPECT_GT(on, casesOf(20000) * 20);
}

/// By time: one pulse for each pass, found by a walk in steps of the grid, from when the place was
/// passed between two cycles.
TEST(TrackProperty, ByTimeEveryPassCounts) {
  MotionRandom random(7203);
  int pulses = 0;
  for (int i = 0; i < casesOf(20000); ++i) {
    const int places = 4 + random.below(30);
    const double period = random.chance(0.6) ? places * kGrid : 0.0;
    cam::CamSwitch camSwitch = randomSwitch(random, places);
    camSwitch.CamSwitchMode = 1;
    camSwitch.Duration = static_cast<uint32_t>(1 + random.below(4));
    cam::TrackOptions options{};
    options.OffCompensation = random.chance(0.5) ? 0.0 : random.below(3) * 0.001;
    int position = random.below(4 * places) - 2 * places;
    cam::TrackState track{};
    cam::SwitchPulse pulse{};
    cam::beginTrack(track, options, axisAt(position * kGrid, 0, period));
    const double length = camSwitch.Duration * 1e6 + options.OffCompensation * 1e9;
    double end = -1.0;
    bool shown = false;
    bool moved = false;
    for (int64_t cycle = 1; cycle < 25; ++cycle) {
      const int from = position;
      position += (random.below(9) - 4) * (random.chance(0.2) ? 10 : 1);
      // Ends a pulse of an earlier cycle, before anything new.
      const int way = std::abs(position - from);
      double passedAt = -1.0;
      for (int step = 0; step < way; ++step) {
        const int sign = position > from ? 1 : -1;
        // Towards greater positions a place is passed when it is reached, else when it is left.
        const int reached = from + sign * (sign > 0 ? step + 1 : step);
        const auto is = [&](int place) {
          const double x = place * kGrid;
          return period > 0 ? std::fmod(std::abs(x - camSwitch.FirstOnPosition), period) == 0.0
                            : x == camSwitch.FirstOnPosition;
        };
        const bool start = !moved && sign > 0 && is(from);
        const bool wanted =
            camSwitch.AxisDirection == 0 || (camSwitch.AxisDirection == 1) == (sign > 0);
        moved = true;
        if (start && wanted)
          passedAt = static_cast<double>(cycle - 1);
        if (is(reached) && wanted)
          passedAt =
              static_cast<double>(cycle - 1) + std::abs(reached - from) / static_cast<double>(way);
      }
      const auto now = static_cast<double>(cycle * kCycle);
      const bool running = end >= 0;
      if (passedAt >= 0) {
        const double until = passedAt * kCycle + length;
        end = running ? std::max(end, until) : until;
        shown = running && shown && end > now;
        ++pulses;
      }
      if (end >= 0 && shown && now >= end - 0.6) // times are rounded to ns
        end = -1;
      const bool expected = end >= 0;
      shown = expected;
      const cam::TrackAxis axis = axisAt(position * kGrid, 0, period);
      const cam::TrackPass pass = cam::advanceTrack(track, options, axis);
      const bool on = cam::isPulsed(pulse, track, options, axis, camSwitch, pass,
                                    (cycle - 1) * kCycle, cycle * kCycle);
      ASSERT_EQ(on, expected) << "case " << i << ", cycle " << cycle;
    }
  }
  EXPECT_GT(pulses, casesOf(20000));
}

} // namespace
