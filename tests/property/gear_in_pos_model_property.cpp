// MC_GearInPos and MC_Phasing against plain models: one polynomial over the master, from place to
// place; a distance that is kept.
#include "tests/support/kinematics.hpp"

#include "cam_scene.hpp"

#include "st/SM_PLCopen/MC_GearInPos.h"
#include "st/SM_PLCopen/MC_Phasing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace stride::test;
namespace pl = ::st::SM_PLCopen;
namespace state = stride::axis::state;

using Places = std::vector<std::pair<long double, long double>>;

/// The value at `x` of the polynomial through the places (Neville).
long double valueThrough(const Places &places, long double x) {
  std::vector<long double> y;
  for (const auto &place : places)
    y.push_back(place.second);
  for (size_t d = 1; d < places.size(); ++d)
    for (size_t i = 0; i + d < places.size(); ++i)
      y[i] = ((x - places[i + d].first) * y[i] + (places[i].first - x) * y[i + 1]) /
             (places[i].first - places[i + d].first);
  return y[0];
}

/// The slave over its turns: its velocities tell how many.
class Unwrapped {
public:
  explicit Unwrapped(const stride::axis::AxisRef &axis)
      : axis_(axis), shown_(axis.fSetPosition), velocity_(axis.fSetVelocity) {
    position = shown_;
  }
  void next() {
    long double way = static_cast<long double>(axis_.fSetPosition) - shown_;
    if (axis_.iMovementType == 0) {
      const long double about = (velocity_ + axis_.fSetVelocity) / 2 * kCamCycle;
      way += axis_.fPositionPeriod * std::round((about - way) / axis_.fPositionPeriod);
    }
    position += way;
    shown_ = axis_.fSetPosition;
    velocity_ = axis_.fSetVelocity;
  }
  long double position;

private:
  const stride::axis::AxisRef &axis_;
  double shown_, velocity_;
};

TEST(GearInPosModel, LeadsByOnePolynomialOverTheMasterIntoGear) {
  int polynomials = 0;
  int waited = 0;
  int reversed = 0;
  for (int i = 0; i < casesOf(2000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    AxisRig rig(kCamCycle);
    rig.axis.dwRatioTechUnitsDenom = 100;
    rig.axis.fSWMaxDeceleration = 1e6;
    const double slavePeriod = random.chance(0.5) ? random.magnitude(0, 3) : 0;
    if (slavePeriod > 0)
      rig.makeRotary(slavePeriod);
    const double ahead = random.magnitude(0, 2); // from the start to where they are coupled
    const double masterPeriod = random.chance(0.5) ? ahead * random.uniform(1.05, 4) : 0;
    ModelMaster master(kCamCycle, masterPeriod);
    const double direction = random.sign();
    const int cycles = 60 + random.below(200);
    const double speed = direction * ahead / cycles / kCamCycle;
    auto gear = fresh<pl::MC_GearInPos>();
    gear.Master = &master.ref;
    gear.Slave = &rig.axis;
    gear.RatioNumerator = random.below(201) - 100;
    gear.RatioDenominator = 1 + random.below(100);
    if (random.chance(0.3))
      gear.RatioDenominator = -gear.RatioDenominator;
    const long double ratio = static_cast<long double>(gear.RatioNumerator) / gear.RatioDenominator;
    ASSERT_GT(rig.powerUp(), 0);
    master.place(random.uniform(-100, 100));
    for (int k = 0; k < 3; ++k)
      rig.cycle([&] { master.step(speed); });
    const double here = master.position() + speed * kCamCycle; // in the cycle of the edge
    const double there = here + direction * ahead;
    gear.MasterSyncPosition =
        masterPeriod > 0 ? stride::test::onCircle(there, masterPeriod) : there;
    const long double sync = master.total() + speed * kCamCycle + direction * ahead;
    gear.SlaveSyncPosition = random.uniform(-1, 1) * (slavePeriod > 0 ? slavePeriod : 100);
    if (slavePeriod > 0)
      gear.SlaveSyncPosition = stride::test::onCircle(gear.SlaveSyncPosition, slavePeriod);
    const double distance = random.chance(0.3) ? 0 : ahead * random.uniform(0.5, 0.99);
    gear.MasterStartDistance = distance;
    const bool reverse = random.chance(0.1);
    double velocity = speed;
    double factor = 1;
    Places samples;
    Unwrapped slave(rig.axis);
    long double turns = 0;
    bool coupled = false;
    const long double size = 100 + slavePeriod + std::fabs(ratio) * ahead;
    long double aBefore = 0;
    long double vBefore = 0;
    long double last = slave.position;
    long double top = 0;
    for (int cycle = 0; cycle < 4 * cycles && !HasFailure(); ++cycle) {
      SCOPED_TRACE("cycle " + std::to_string(cycle));
      bool stop = false;
      rig.cycle([&] {
        // It goes unevenly, but does not turn round.
        if (cycle > 0 && random.chance(0.05))
          factor = random.uniform(0.5, 2);
        velocity += std::clamp(speed * factor - velocity, -std::fabs(speed) * 0.01,
                               std::fabs(speed) * 0.01);
        if (cycle == 0)
          velocity = speed;
        if (reverse && samples.size() == 20 &&
            (sync - master.total()) * direction > 5 * std::fabs(speed) * kCamCycle)
          velocity = -speed;
        master.step(velocity);
        rig.call(gear, true);
        const long double left = (sync - master.total()) * direction;
        if (reverse && velocity * direction < 0) {
          stop = true;
          return;
        }
        ASSERT_EQ(gear.ErrorID, 0);
        ASSERT_TRUE(gear.Busy);
        if (std::fabs(left) < 1e-9L * ahead || left < -0.5L * ahead ||
            std::fabs(left - distance) < 1e-9L * ahead) {
          stop = left < -0.5L * ahead;
          slave.next();
          last = slave.position;
          aBefore = rig.axis.fSetAcceleration;
          vBefore = rig.axis.fSetVelocity;
          if (left > 1e-9L * ahead)
            samples.clear();
          return;
        }
        ASSERT_EQ(gear.InSync != 0, left < 0);
        const bool syncing = left > 0 && (distance == 0 || left < distance);
        if (cycle > 1) {
          ASSERT_EQ(gear.StartSync != 0, syncing);
        }
        slave.next();
        const long double T = kCamCycle;
        const long double v = rig.axis.fSetVelocity;
        const long double a = rig.axis.fSetAcceleration;
        top = std::max(top, std::fabs(a));
        // Between two cycles it may be greater than in both.
        const long double most = 1.5L * std::max({std::fabs(a), std::fabs(aBefore), 0.2L * top,
                                                  1e-4L * std::fabs(ratio * speed) / T});
        ASSERT_LE(std::fabs(v - vBefore), most * T + 1e-9L * size / T) << "velocity jumps";
        ASSERT_LE(std::fabs(slave.position - last - T * (v + vBefore) / 2),
                  most * T * T / 2 + 1e-9L * size)
            << "position jumps";
        last = slave.position;
        vBefore = v;
        aBefore = a;
        if (left < 0) {
          const long double wanted =
              gear.SlaveSyncPosition + ratio * (master.total() - sync) + turns;
          long double off = slave.position - wanted;
          if (slavePeriod > 0)
            off -= slavePeriod * std::round(off / slavePeriod);
          ASSERT_LE(std::fabs(off), 1e-9L * size) << "off the ratio";
          ASSERT_LE(std::fabs(v - ratio * master.velocity()),
                    1e-9L * std::fabs(ratio * master.velocity()) + 1e-12L);
          coupled = true;
        } else if (syncing && cycle > 1) {
          ASSERT_TRUE(gear.Active);
          samples.emplace_back(master.total() - sync, slave.position);
        } else if (!syncing) {
          ASSERT_EQ(v, 0) << "too early";
          ++waited;
        }
      });
      if (stop)
        break;
    }
    if (reverse && velocity * direction < 0 && !HasFailure()) {
      ++reversed;
      for (int k = 0; k < 3; ++k)
        rig.cycle([&] {
          master.step(velocity);
          rig.call(gear, true);
        });
      ASSERT_EQ(gear.ErrorID, 775);
      ASSERT_FALSE(gear.StartSync);
      ASSERT_FALSE(gear.InSync);
      ASSERT_FALSE(gear.Busy);
      continue;
    }
    ASSERT_TRUE(coupled);
    if (samples.size() >= 12) {
      // Four of its places, its end and its end's slope make it.
      Places fixed;
      for (size_t k = 0; k < 6; ++k)
        fixed.push_back(samples[k * (samples.size() - 1) / 5]);
      for (const auto &sample : samples)
        ASSERT_LE(std::fabs(sample.second - valueThrough(fixed, sample.first)),
                  1e-6L * (size + std::fabs(sample.second)));
      const long double end = valueThrough(fixed, 0);
      long double off = end - gear.SlaveSyncPosition;
      if (slavePeriod > 0)
        off -= slavePeriod * std::round(off / slavePeriod);
      ASSERT_LE(std::fabs(off), 1e-5L * size) << "ends elsewhere";
      const long double h = 1e-3L * ahead;
      const long double slope = (valueThrough(fixed, h) - valueThrough(fixed, -h)) / (2 * h);
      ASSERT_LE(std::fabs(slope - ratio), 1e-3L * size / ahead) << "ends with another slope";
      ++polynomials;
    }
  }
  std::cout << polynomials << " polynomials, " << waited << " cycles waited, " << reversed
            << " reversed\n";
  EXPECT_GT(polynomials, casesOf(1000));
  EXPECT_GT(waited, casesOf(1000));
  EXPECT_GT(reversed, casesOf(50));
}

TEST(PhasingModel, KeepsTheDistanceThatItHasMade) {
  int done = 0;
  for (int i = 0; i < casesOf(800) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    AxisRig rig(kCamCycle);
    rig.axis.dwRatioTechUnitsDenom = 100;
    rig.axis.fSWMaxDeceleration = 1e6;
    rig.axis.eRampType = static_cast<int16_t>(random.below(4));
    const double slavePeriod = random.chance(0.5) ? random.magnitude(1, 3) : 0;
    if (slavePeriod > 0)
      rig.makeRotary(slavePeriod);
    const double masterPeriod = random.chance(0.5) ? random.magnitude(1, 3) : 0;
    ModelMaster master(kCamCycle, masterPeriod);
    auto phasing = fresh<pl::MC_Phasing>();
    phasing.Master = &master.ref;
    phasing.Slave = &rig.axis;
    const double unit = 10;
    const double seconds = kCamCycle * random.magnitude(1, 2);
    phasing.Velocity = unit / seconds;
    phasing.Acceleration = phasing.Velocity / seconds * random.magnitude(0, 1);
    phasing.Deceleration = phasing.Acceleration * random.magnitude(-0.5, 0.5);
    phasing.Jerk = phasing.Acceleration / seconds * random.magnitude(0, 1);
    phasing.PhaseShift = unit * random.uniform(-3, 3);
    const double speed = random.chance(0.3) ? 0 : phasing.Velocity * random.uniform(-1, 1);
    ASSERT_GT(rig.powerUp(), 0);
    master.place(random.uniform(-100, 100));
    rig.cycle([&] { master.step(speed); });
    double velocity = speed;
    Unwrapped slave(rig.axis);
    long double vBefore = 0;
    long double last = slave.position;
    const long double distance = slave.position - master.total();
    long double after = 0;
    int shown = 0;
    const long double limit =
        std::max(phasing.Acceleration, phasing.Deceleration) * 1.5708 * (1 + 1e-6);
    for (int cycle = 0; cycle < 40000 && shown < 40 && !HasFailure(); ++cycle) {
      SCOPED_TRACE("cycle " + std::to_string(cycle));
      rig.cycle([&] {
        // Even until it is done, then any.
        if (shown > 0)
          velocity += phasing.Velocity * random.uniform(-0.02, 0.02);
        master.step(velocity);
        rig.call(phasing, true);
        ASSERT_EQ(phasing.ErrorID, 0);
        ASSERT_TRUE(phasing.Busy);
        slave.next();
        const long double v = rig.axis.fSetVelocity;
        const long double T = kCamCycle;
        const long double ahead = slave.position - master.total();
        if (shown == 0) {
          ASSERT_LE(std::fabs(v - vBefore), limit * T + 1e-9L * phasing.Velocity) << "velocity";
          ASSERT_LE(std::fabs(slave.position - last - T * (v + vBefore) / 2),
                    limit * T * T / 2 + 1e-9L * (unit + slavePeriod))
              << "position";
          ASSERT_LE(std::fabs(v - speed),
                    std::max<long double>(phasing.Velocity, std::fabs(speed)) * (1 + 1e-6L));
        } else {
          ASSERT_TRUE(phasing.Done);
          ASSERT_LE(std::fabs(ahead - after), 1e-9L * (unit + slavePeriod + masterPeriod))
              << "distance";
          ASSERT_LE(std::fabs(v - velocity), 1e-9L * phasing.Velocity);
        }
        if (phasing.Done) {
          if (shown == 0)
            after = ahead;
          ++shown;
        }
        vBefore = v;
        last = slave.position;
      });
    }
    ASSERT_GE(shown, 40) << "not done";
    ++done;
    if (speed == 0) {
      ASSERT_LE(std::fabs(after - distance - phasing.PhaseShift), 1e-9L * (unit + slavePeriod));
    } else if (rig.axis.eRampType == 0) {
      // What it lost until it had the master's velocity; in which cycle that was nobody says.
      const long double lost = speed * std::fabs(speed) / (2 * phasing.Acceleration);
      ASSERT_LE(std::fabs(after - (distance - lost + phasing.PhaseShift)),
                2 * std::fabs(speed) * kCamCycle + 1e-9L * unit);
    }
  }
  EXPECT_EQ(done, casesOf(800));
}

} // namespace
