// Passes of tappets against a walk in small steps, on a grid where everything is exact, and against
// counting.
#include "runtime/axis/cam/tappets.hpp"

#include "motion_problems.hpp"

#include "st/SM_DriveBasic/SMC_CAMTAPPETACTION.h"
#include "st/SM_DriveBasic/SMC_CAMTAPPETTYPE.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace {

namespace cam = stride::cam;
using stride::test::Random;

constexpr double kGrid = 0.125;

struct Pass {
  int group;
  bool negative;
  bool operator==(const Pass &) const = default;
};

/// A cam from `start` to `start + length`, in grid steps, and its tappets.
struct Cam {
  long start;
  long length;
  bool periodic;
  std::vector<cam::Tappet> tappets;

  cam::TappetList list() const {
    return {tappets.data(), static_cast<int32_t>(tappets.size()),
            static_cast<double>(start) * kGrid, static_cast<double>(start + length) * kGrid,
            periodic};
  }
  cam::Place place(long position) const {
    if (!periodic)
      return {0, static_cast<double>(position) * kGrid};
    const long period = (position - start) / length - ((position - start) % length < 0 ? 1 : 0);
    return {period, static_cast<double>(position - period * length) * kGrid};
  }
};

Cam randomCam(Random &random) {
  Cam made{random.below(41) - 20, 1 + random.below(40), random.chance(0.6), {}};
  const int count = random.below(8);
  for (int i = 0; i < count; ++i) {
    cam::Tappet tappet{};
    // Also outside of the cam, and several at one place.
    tappet.x =
        static_cast<double>(made.start - 2 + random.below(static_cast<int>(made.length) + 5)) *
        kGrid;
    if (random.chance(0.2))
      tappet.x = static_cast<double>(made.start + (random.chance(0.5) ? made.length : 0)) * kGrid;
    tappet.iGroupID = static_cast<int16_t>(i);
    tappet.ctt = static_cast<int16_t>(random.below(3));
    made.tappets.push_back(tappet);
  }
  return made;
}

bool wants(const cam::Tappet &tappet, bool negative) {
  return tappet.ctt == 1 || (tappet.ctt == 2) == negative;
}

/// Walks step by step and asks every tappet whether it is at this place.
class Walker {
public:
  Walker(const Cam &cam, long position) : cam_(cam), position_(position) {}

  void walkTo(long target) {
    while (position_ != target) {
      const bool negative = target < position_;
      if (first_ && !negative)
        passAt(position_, false);
      first_ = false;
      passAt(negative ? position_ : position_ + 1, negative);
      position_ += negative ? -1 : 1;
    }
  }

  std::vector<Pass> passes;

private:
  void passAt(long position, bool negative) {
    if (!cam_.periodic) {
      passTappetsAt(position, negative);
      return;
    }
    const long length = cam_.length;
    const long inside = cam_.start + ((position - cam_.start) % length + length) % length;
    if (inside != cam_.start) {
      passTappetsAt(inside, negative);
    } else {
      passTappetsAt(negative ? inside : inside + length, negative);
      passTappetsAt(negative ? inside + length : inside, negative);
    }
  }
  void passTappetsAt(long inside, bool negative) {
    if (inside < cam_.start || inside > cam_.start + cam_.length)
      return;
    for (const cam::Tappet &tappet : cam_.tappets)
      if (tappet.x == static_cast<double>(inside) * kGrid && wants(tappet, negative))
        passes.push_back({tappet.iGroupID, negative});
  }

  const Cam &cam_;
  long position_;
  bool first_ = true;
};

void takeAll(cam::TappetState &state, const cam::TappetList &list, std::vector<Pass> &passes) {
  cam::TappetEvent event{};
  while (cam::nextTappet(state, list, event))
    passes.push_back({event.iGroupID, event.bNegative != 0});
}

long randomStep(Random &random, const Cam &cam) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.2)
    return 0;
  if (kind < 0.7)
    return random.below(7) - 3;
  return random.below(static_cast<int>(8 * cam.length) + 1) - 4 * cam.length;
}

TEST(TappetsProperty, AllPassesInOrderAsAWalkFindsThem) {
  Random random(7001);
  int passes = 0;
  for (int i = 0; i < stride::test::casesOf(40000); ++i) {
    const Cam made = randomCam(random);
    const cam::TappetList list = made.list();
    long position = random.below(201) - 100;
    Walker walker(made, position);
    cam::TappetState state{};
    cam::beginTappets(state, made.place(position), 0);
    std::vector<Pass> seen;
    for (int cycle = 1; cycle < 12; ++cycle) {
      position += randomStep(random, made);
      walker.walkTo(position);
      cam::followTappets(state, list, made.place(position), 0.0, cycle);
      takeAll(state, list, seen);
    }
    passes += static_cast<int>(seen.size());
    ASSERT_EQ(seen, walker.passes) << "case " << i;
  }
  EXPECT_GT(passes, stride::test::casesOf(100000));
}

TEST(TappetsProperty, ThreeInACycleAndTheRestInOrderLater) {
  Random random(7002);
  int waited = 0;
  for (int i = 0; i < stride::test::casesOf(30000); ++i) {
    const Cam made = randomCam(random);
    const cam::TappetList list = made.list();
    long position = random.below(201) - 100;
    Walker walker(made, position);
    cam::TappetState state{};
    cam::TappetData data{};
    cam::beginTappets(state, made.place(position), 0);
    std::vector<Pass> seen;
    const auto report = [&](int cycle) {
      cam::followTappets(state, list, made.place(position), 0.0, cycle);
      cam::beginReport(data);
      cam::reportTappets(data, state, list);
      ASSERT_LE(data.iCount, 3);
      for (int event = 0; event < data.iCount; ++event)
        seen.push_back({data.aEvents.v[event].iGroupID, data.aEvents.v[event].bNegative != 0});
      waited += seen.size() < walker.passes.size();
    };
    for (int cycle = 1; cycle < 12; ++cycle) { // fewer than 16 turns
      position += randomStep(random, made);
      walker.walkTo(position);
      report(cycle);
    }
    const auto needed = walker.passes.size() - seen.size();
    for (size_t cycle = 0; cycle <= needed / 3; ++cycle)
      report(12);
    ASSERT_EQ(seen, walker.passes) << "case " << i;
    report(13);
    ASSERT_EQ(data.iCount, 0);
  }
  EXPECT_GT(waited, stride::test::casesOf(10000));
}

TEST(TappetsProperty, HysteresisOverlooksWhatComesBackLess) {
  Random random(7003);
  for (int i = 0; i < stride::test::casesOf(20000); ++i) {
    const Cam made = randomCam(random);
    const cam::TappetList list = made.list();
    const long hysteresis = random.below(8);
    long position = random.below(201) - 100;
    long seenAt = position; // what the walk is told
    int direction = 0;
    Walker walker(made, position);
    cam::TappetState state{};
    cam::beginTappets(state, made.place(position), 0);
    std::vector<Pass> seen;
    for (int cycle = 1; cycle < 20; ++cycle) {
      position += randomStep(random, made);
      const long way = position - seenAt;
      const int turned = way > 0 ? 1 : -1;
      if (way != 0 && (direction == 0 || turned == direction || std::abs(way) > hysteresis)) {
        direction = turned;
        seenAt = position;
        walker.walkTo(position);
      }
      cam::followTappets(state, list, made.place(position), static_cast<double>(hysteresis) * kGrid,
                         cycle);
      takeAll(state, list, seen);
    }
    ASSERT_EQ(seen, walker.passes) << "case " << i;
  }
}

/// Any numbers: every tappet is passed forwards and back in turns, as often as its place says; and
/// looking more often at the same course changes nothing.
TEST(TappetsProperty, NeitherLostNorDoubled) {
  Random random(7004);
  for (int i = 0; i < stride::test::casesOf(20000); ++i) {
    const double start = random.uniform(-1, 1) * random.magnitude(-3, 4);
    const double length = random.magnitude(-2, 4);
    std::vector<cam::Tappet> tappets(static_cast<size_t>(1 + random.below(5)));
    for (size_t t = 0; t < tappets.size(); ++t) {
      tappets[t].x = start + random.uniform(0, 1) * length;
      tappets[t].iGroupID = static_cast<int16_t>(t);
      tappets[t].ctt = st::SM_DriveBasic::SMC_CAMTAPPETTYPE__TAPPET_all;
    }
    const cam::TappetList list{tappets.data(), static_cast<int32_t>(tappets.size()), start,
                               start + length, true};
    const auto placeAt = [&](double position) {
      return cam::placeOf({position, 0.0}, start, length);
    };
    double position = random.uniform(-20, 20) * length;
    const cam::Place first = placeAt(position);
    cam::Place last = first;
    cam::TappetState coarse{};
    cam::TappetState fine{};
    cam::beginTappets(coarse, first, 0);
    cam::beginTappets(fine, first, 0);
    std::vector<Pass> coarseSeen;
    std::vector<Pass> fineSeen;
    for (int cycle = 1; cycle < 10; ++cycle) {
      const double from = position;
      position += random.uniform(-1, 1) * length * random.magnitude(-2, 0.7);
      for (int part = 1; part <= 5; ++part) {
        const double between = part == 5 ? position : from + (position - from) * part / 5;
        cam::followTappets(fine, list, placeAt(between), 0.0, cycle);
        takeAll(fine, list, fineSeen);
      }
      last = placeAt(position);
      cam::followTappets(coarse, list, last, 0.0, cycle);
      takeAll(coarse, list, coarseSeen);
    }
    ASSERT_EQ(coarseSeen, fineSeen) << "case " << i;
    std::map<int, long> net;
    for (const Pass &pass : coarseSeen)
      net[pass.group] += pass.negative ? -1 : 1;
    for (const cam::Tappet &tappet : tappets) {
      const auto level = [&](cam::Place place) {
        return place.period + (place.position >= tappet.x ? 1 : 0);
      };
      ASSERT_EQ(net[tappet.iGroupID], level(last) - level(first)) << "case " << i;
    }
  }
}

/// A bit that on, off and invert switch is the same whether all periods of a leap are looked at or
/// some are skipped.
TEST(TappetsProperty, SkippedPeriodsSwitchNothing) {
  Random random(7005);
  int changes = 0;
  for (int i = 0; i < stride::test::casesOf(20000); ++i) {
    Cam made = randomCam(random);
    made.periodic = true;
    for (cam::Tappet &tappet : made.tappets)
      tappet.cta = static_cast<int16_t>(random.below(3));
    const cam::TappetList list = made.list();
    const long from = random.below(101) - 50;
    const long to = from + (random.below(61) - 30) * made.length + random.below(20);
    const bool initial = random.chance(0.5);
    bool bits[2] = {initial, initial};
    for (const bool skip : {false, true}) {
      cam::TappetState state{};
      cam::beginTappets(state, made.place(from), 0);
      cam::followTappets(state, list, made.place(to), 0.0, 1);
      if (skip)
        cam::skipPeriods(state);
      cam::TappetEvent event{};
      int taken = 0;
      while (cam::nextTappet(state, list, event)) {
        ++taken;
        bool &bit = bits[skip ? 1 : 0];
        bit = event.cta == st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_on ||
              (event.cta == st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_inv && !bit);
      }
      if (skip) {
        ASSERT_LE(taken, 5 * list.count);
      }
    }
    ASSERT_EQ(bits[0], bits[1]) << "case " << i;
    changes += bits[0] != initial;
  }
  EXPECT_GT(changes, stride::test::casesOf(3000));
}

} // namespace
