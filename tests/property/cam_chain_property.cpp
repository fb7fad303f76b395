// MC_CamIn from cam to cam by another CamTableID, and onto a cam over a way of the master
// (ramp_in_dist): against models that know only the places where things begin.
#include "tests/support/kinematics.hpp"

#include "cam_scene.hpp"

#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace stride::test;
namespace pl = ::st::SM_PLCopen;
namespace state = stride::axis::state;

TEST(CamChain, AnotherCamGoesOnExactlyWhereTheLastOneHasEnded) {
  int changes = 0;
  for (int i = 0; i < casesOf(3000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    std::array<ModelCam, 3> cams{cornerCam(random), cornerCam(random), cornerCam(random)};
    std::array<CamRef, 3> refs{cams[0].ref(), cams[1].ref(), cams[2].ref()};
    std::array<pl::MC_CAM_ID, 3> ids;
    double shortest = 1e300;
    long double scale = 0;
    long double slope = 0;
    for (const ModelCam &cam : cams) {
      shortest = std::min(shortest, static_cast<double>(cam.length()));
      const ModelPoint most = cam.scale();
      scale = std::max(scale, most.y);
      slope = std::max(slope, most.v);
    }
    const double masterPeriod = random.chance(0.5) ? shortest * random.magnitude(-0.5, 1) : 0;
    const double slavePeriod = random.chance(0.5) ? random.magnitude(-1, 3) : 0;
    CamScene scene(masterPeriod, slavePeriod, cams[0]);
    scene.settings.masterScaling = random.chance(0.5) ? 1 : random.magnitude(-1, 1);
    scene.settings.slaveScaling = random.chance(0.5) ? 1 : random.sign() * random.magnitude(-1, 1);
    scene.settings.masterAbsolute = false;
    scene.settings.relative = true;
    scene.settings.periodic = random.chance(0.7);
    const double ms = scene.settings.masterScaling;
    const double ss = scene.settings.slaveScaling;
    ASSERT_GT(scene.rig.powerUp(), 0);
    scene.placeSlave(random.uniform(-100, 100));
    scene.master.place(random.uniform(-100, 100));
    scene.prepare();
    for (size_t k = 0; k < 3; ++k) {
      auto select = fresh<pl::MC_CamTableSelect>();
      select.Master = &scene.master.ref;
      select.Slave = &scene.rig.axis;
      select.CamTable = &refs[k];
      select.Periodic = scene.settings.periodic;
      select.MasterAbsolute = select.SlaveAbsolute = 0;
      scene.rig.call(select, true);
      ASSERT_EQ(select.ErrorID, 0);
      ids[k] = select.CamTableID;
    }
    // At most a third of a cam per cycle, mostly forwards.
    const double top = shortest / 3 / ms / kCamCycle;
    double velocity = 0;
    double wanted = 0;
    size_t now = 0;
    size_t next = 0;
    long double zero = 0;  // the master's place where the running cam's 0 is
    long double began = 0; // ... and was when it took over: to come back there is no end
    long double base = scene.rig.axis.fSetPosition;
    long double first = 0;
    bool left = false; // a cam that is not periodic, backwards out of its start
    for (int cycle = 0; cycle < 150 && !HasFailure() && !left; ++cycle) {
      SCOPED_TRACE("cycle " + std::to_string(cycle));
      if (random.chance(0.1))
        wanted = top * random.uniform(-0.3, 1);
      velocity += std::clamp(wanted - velocity, -top / 5, top / 5);
      if (random.chance(0.1))
        next = static_cast<size_t>(random.below(3));
      scene.rig.cycle([&] {
        scene.master.step(velocity);
        if (random.chance(0.03))
          scene.master.setPosition(random.uniform(-100, 100), false);
        scene.camIn.CamTableID = ids[cycle == 0 ? now : next];
        if (cycle == 0) {
          first = scene.master.total();
          scene.camIn.StartMode = 0;
        }
        scene.rig.call(scene.camIn, true);
        ASSERT_EQ(scene.camIn.ErrorID, 0);
        const long double x = (scene.master.total() - first) * ms;
        const long double haze = ms * scene.master.haze() + 1e-12L * cams[now].length();
        bool ended = false;
        const bool isEnd = zero + 0.5L * cams[now].length() > began;
        if (cycle > 0 && isEnd && next != now && x - zero >= cams[now].length() &&
            (x - zero) - cams[now].length() >= haze) {
          zero += cams[now].length();
          base += ss * cams[now].rise();
          now = next;
          began = zero;
          ended = true;
          ++changes;
        } else if (std::fabs(x - zero - cams[now].length()) < haze ||
                   (std::fabs(x - zero) < haze && scene.master.haze() > 0)) {
          left = true; // a hair decides
          return;
        }
        long double place = x - zero;
        const ModelCam &cam = cams[now];
        if (scene.settings.periodic) {
          // The period counts from where the cam has begun.
          const long double period = std::floor(place / cam.length());
          place -= period * cam.length();
          ASSERT_TRUE(period <= 0 || next == now || !isEnd);
          // From now on the end that counts is that of this period.
          zero += period * cam.length();
          base += ss * period * cam.rise();
        } else {
          left = place < 0 || place > cam.length();
          place = std::clamp<long double>(place, 0, cam.length());
        }
        const long double y = base + ss * cam.at(place).y;
        const long double slave = std::fabs(static_cast<long double>(ss));
        ASSERT_LE(std::fabs(scene.offFrom(y)), slave * (1e-9L * scale + slope * haze) +
                                                   1e-12L * slavePeriod + 1e-14L * std::fabs(y))
            << (ended ? "at a change" : "") << " place " << static_cast<double>(place) << " of "
            << static_cast<double>(cam.length()) << " way " << velocity * ms * kCamCycle
            << (scene.settings.periodic ? " periodic" : "") << " now " << now << " next " << next
            << " end " << static_cast<int>(scene.camIn.EndOfProfile);
        if (ended) {
          ASSERT_TRUE(scene.camIn.EndOfProfile);
        }
      });
    }
  }
  std::cout << changes << " changes\n";
  EXPECT_GT(changes, casesOf(2000));
}

/// The value at `x` of the polynomial through the points (Neville).
long double through(const std::vector<std::pair<long double, long double>> &points, long double x) {
  std::vector<long double> y;
  for (const auto &point : points)
    y.push_back(point.second);
  for (size_t d = 1; d < points.size(); ++d)
    for (size_t i = 0; i + d < points.size(); ++i)
      y[i] = ((x - points[i + d].first) * y[i] + (points[i].first - x) * y[i + 1]) /
             (points[i].first - points[i + d].first);
  return y[0];
}

TEST(CamRampInDist, LeadsByOnePolynomialOverTheMasterOntoTheCam) {
  int waited = 0;
  int polynomials = 0;
  for (int i = 0; i < casesOf(1000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const ModelCam cam = cornerCam(random);
    const double length = static_cast<double>(cam.length());
    const double slavePeriod = random.chance(0.4) ? random.magnitude(-1, 3) : 0;
    const double masterPeriod = random.chance(0.5) ? length * random.magnitude(0.5, 1) : 0;
    CamScene scene(masterPeriod, slavePeriod, cam);
    CamSettings &s = scene.settings;
    s.periodic = random.chance(0.5);
    s.masterScaling = random.chance(0.5) ? 1 : random.sign() * random.magnitude(-1, 1);
    s.slaveScaling = random.chance(0.5) ? 1 : random.sign() * random.magnitude(-1, 1);
    if (slavePeriod > 0) // so that the way of a cycle is told
      s.slaveScaling = slavePeriod / static_cast<double>(cam.scale().v) / length;
    s.masterAbsolute = random.chance(0.5);
    const double sign = random.sign(); // of the motion in the cam
    ASSERT_GT(scene.rig.powerUp(), 0);
    scene.placeSlave(random.uniform(-100, 100));
    // Over 200 to 1000 cycles per cam.
    const double velocity = sign * length / s.masterScaling / kCamCycle / random.magnitude(2.3, 3);
    const double from = sign > 0 ? 0.1 : 0.9;
    const double sync = sign > 0 ? random.uniform(0.4, 0.9) : random.uniform(0.1, 0.6);
    scene.master.place(random.uniform(0, 100));
    scene.rig.cycle([&] { scene.master.step(velocity); });
    scene.rig.cycle([&] { scene.master.step(velocity); });
    // What the place of the next cycle will be.
    const double next = scene.master.position() + velocity * kCamCycle;
    const double shown = masterPeriod > 0 ? stride::test::onCircle(next, masterPeriod) : next;
    s.masterOffset = from * length - (s.masterAbsolute ? shown * s.masterScaling : 0);
    scene.prepare();
    auto &camIn = scene.camIn;
    camIn.StartMode = 5;
    camIn.MasterSyncPosition = sync * length;
    camIn.MasterStartDistance =
        random.chance(0.3) ? 0 : std::fabs(sync - from) * length * random.uniform(0.2, 0.9);
    ModelCoupling model(scene.cam, s);
    const ModelPoint scale = cam.scale();
    const long double size = std::fabs(static_cast<long double>(s.slaveScaling)) * scale.y;
    std::vector<std::pair<long double, long double>> samples;
    long double slave = 0;
    bool done = false;
    double before = scene.rig.axis.fSetPosition;
    double vBefore = 0;
    double aBefore = 0;
    long double top = 0;
    for (int cycle = 0; cycle < 1000 && !HasFailure(); ++cycle) {
      SCOPED_TRACE("cycle " + std::to_string(cycle));
      bool stop = false;
      scene.rig.cycle([&] {
        scene.master.step(velocity);
        const bool begun = cycle > 0 || model.begin(scene.master, 0);
        ASSERT_TRUE(begun);
        scene.rig.call(camIn, true);
        ASSERT_EQ(camIn.ErrorID, 0);
        const auto out = model.at(scene.master);
        const auto &axis = scene.rig.axis;
        const double left = (sync * length - static_cast<double>(out.x)) * sign;
        if (std::fabs(left) < 1e-9 * length || left < -0.05 * length) {
          stop = true; // seen enough, or a hair decides
          return;
        }
        ASSERT_EQ(camIn.InSync != 0, left < 0) << left / length;
        long double way = axis.fSetPosition - before;
        if (slavePeriod > 0)
          way -= slavePeriod * std::round(way / slavePeriod);
        slave += way;
        const long double T = kCamCycle;
        // Between two cycles it may be greater than in both.
        top = std::max<long double>(top, std::fabs(axis.fSetAcceleration));
        const long double a = std::max<long double>(
            {std::fabs(axis.fSetAcceleration), std::fabs(aBefore), 0.1L * top});
        ASSERT_LE(std::fabs(way - T * (axis.fSetVelocity + vBefore) / 2),
                  1.5L * a * T * T / 2 + 1e-9L * size + 1e-12L * slavePeriod)
            << "position jumps";
        ASSERT_LE(std::fabs(static_cast<long double>(axis.fSetVelocity) - vBefore),
                  1.5L * a * T + 1e-9L * size / T)
            << "velocity jumps";
        before = axis.fSetPosition;
        vBefore = axis.fSetVelocity;
        aBefore = axis.fSetAcceleration;
        const double distance = camIn.MasterStartDistance;
        if (left < 0) {
          done = true;
          ASSERT_LE(std::fabs(scene.offFrom(out.slave.y)), 1e-9L * size + 1e-12L * slavePeriod);
        } else if (distance > 0 && left > distance * (1 + 1e-9)) {
          ASSERT_EQ(axis.fSetVelocity, 0) << "too early";
          ++waited;
        } else if (distance == 0 ? cycle > 1 : left < distance * (1 - 1e-9)) {
          samples.emplace_back(out.x, slave);
        }
      });
      if (stop)
        break;
    }
    ASSERT_TRUE(done || HasFailure());
    if (samples.size() >= 12) {
      // Six places fix it.
      std::vector<std::pair<long double, long double>> fixed;
      for (size_t k = 0; k < 6; ++k)
        fixed.push_back(samples[k * (samples.size() - 1) / 5]);
      for (const auto &sample : samples)
        ASSERT_LE(std::fabs(sample.second - through(fixed, sample.first)),
                  1e-7L * (size + std::fabs(sample.second)));
      ++polynomials;
    }
  }
  EXPECT_GT(waited, casesOf(10000));
  EXPECT_GT(polynomials, casesOf(500));
}

} // namespace
