// Limits of single axes through whole chains: SMC_ExtendedVelocityChecks, SMC_LimitDynamics,
// SMC_SmoothBSpline, SMC_SmoothMerge and the limits of SMC_Interpolator, with random feeds,
// overrides, stops and single steps. What counts are the differences of set positions.
#include "tests/property/cnc_chain_rig.hpp"
#include "tests/support/cases.hpp"

#include "st/SM_CNC/SMC_INT_VELMODE.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

namespace {

using namespace stride::test;
namespace cnc = stride::cnc;

/// More cases by hand: STRIDE_PATH_CASES=10000.
int wantedRuns(int cases) {
  const char *const more = std::getenv("STRIDE_PATH_CASES");
  return more != nullptr ? std::atoi(more) : casesOf(cases);
}

/// X, Y, Z, A, P.
constexpr size_t kJudged = 5;
using Axes = std::array<double, kJudged>;

Axes axesOf(const ::st::SM_CNC::SMC_POSINFO &p) { return {p.dX, p.dY, p.dZ, p.dA, p.dA1}; }

struct Limits {
  Axes velocity, acceleration; ///< infinite: none
};

struct Run {
  std::string text, names;
  std::vector<size_t> places;
  Limits limits;      ///< In each cycle.
  bool inObjectsOnly; ///< Accelerations count within an object.
  Axes ipoVelocity{}, ipoAcceleration{};
  int16_t mode = 0;
};

std::string coordinate(Random &random, char letter, double range) {
  return letter + std::to_string(random.uniform(-range, range)) + " ";
}

std::string motions(Random &random, bool linesOnly, bool finely) {
  std::string text;
  const int sentences = 5 + random.below(25);
  for (int i = 0; i < sentences; ++i) {
    const int kind = random.below(16);
    if (kind == 0)
      text += "M7\n";
    else if (kind == 1)
      text += "G4 T0.02\n";
    else if (kind == 2)
      text += "G0 " + coordinate(random, 'X', 20) + coordinate(random, 'Y', 20) + "\n";
    else if (kind < 6 && !linesOnly)
      text += (random.chance(0.5) ? "G2 " : "G3 ") + coordinate(random, 'X', 20) +
              coordinate(random, 'Y', 20) + "R" + std::to_string(random.uniform(29, 60)) + "\n";
    else {
      text += "G1 ";
      const double range = finely ? 5 : 20;
      text += coordinate(random, 'X', range) + coordinate(random, 'Y', range);
      for (const char letter : {'Z', 'A', 'P'})
        if (random.chance(0.3))
          text += coordinate(random, letter, range);
      if (random.chance(0.2))
        text += "F" + std::to_string(random.uniform(20, 200));
      text += "\n";
    }
  }
  return text;
}

constexpr Axes kNone = {INFINITY, INFINITY, INFINITY, INFINITY, INFINITY};

Run randomRun(Random &random) {
  Run run;
  const char *const chains[] = {"l", "e", "", "bxl", "ml", "b", "be", "sl"};
  run.names = chains[random.below(8)];
  const auto has = [&run](char name) { return run.names.find(name) != std::string::npos; };
  run.limits = {kNone, kNone};
  run.inObjectsOnly = true;
  run.text = "G1 X5 F" + std::to_string(random.uniform(20, 200)) + " E" +
             std::to_string(random.uniform(200, 3000)) + " E-" +
             std::to_string(random.uniform(200, 3000)) + "\n";
  if (has('e')) {
    const double v = random.uniform(3, 40);
    const double a = random.uniform(30, 400);
    run.text += "FA" + std::to_string(v) + " FP" + std::to_string(2 * v) + " EA" +
                std::to_string(a) + " EA-" + std::to_string(a) + " G1 X0\n";
    run.limits.velocity[3] = v;
    run.limits.velocity[4] = 2 * v;
    run.limits.acceleration[3] = a;
  }
  if (has('l')) {
    run.limits.velocity.fill(kLimitedVelocity);
    run.limits.acceleration.fill(kLimitedAcceleration);
  }
  if (run.names.empty() || run.names == "b") {
    run.inObjectsOnly = false;
    for (const size_t axis : {0U, 1U, 2U, 4U}) {
      run.limits.velocity[axis] = run.ipoVelocity[axis] = random.uniform(10, 100);
      run.limits.acceleration[axis] = run.ipoAcceleration[axis] = random.uniform(100, 3000);
    }
  }
  run.text += motions(random, has('b') || has('m'), has('b'));
  for (size_t i = 0; i <= run.names.size(); ++i)
    run.places.push_back(static_cast<size_t>(6 + random.below(30)));
  const int16_t modes[] = {st::SM_CNC::SMC_INT_VELMODE__TRAPEZOID,
                           st::SM_CNC::SMC_INT_VELMODE__QUADRATIC};
  // Only a limited jerk slows down at kinks for the limits of axes (bLimitKinks).
  run.mode = modes[run.inObjectsOnly ? random.below(2) : 1];
  return run;
}

/// Judges set positions.
class AxisJudge {
public:
  explicit AxisJudge(const Run &run) : run_(run) {}
  double velocity = 0, acceleration = 0; ///< The greatest, as parts of their limits.

  void look(const ::st::SM_CNC::SMC_Interpolator &ipo, bool wild) {
    if (ipo.bWorking == 0 && ipo.bDone == 0)
      return;
    const Axes here = axesOf(ipo.piSetPosition);
    const double time = 1e-6 * ipo.dwIpoTime;
    Axes speed{};
    for (size_t i = 0; i < kJudged && count_ > 0; ++i) {
      speed[i] = (here[i] - at_[i]) / time;
      velocity = std::max(velocity, std::fabs(speed[i]) / run_.limits.velocity[i]);
    }
    calm_ = wild ? 0 : calm_ + 1;
    const double length = ipo.dActObjectLength; // tells an object from its neighbours
    const bool same = length == length_ && length_ == before_ && ipo.dVel > 0;
    if (count_ > 1 && calm_ > 2 && (same || !run_.inObjectsOnly))
      for (size_t i = 0; i < kJudged; ++i)
        acceleration = std::max(acceleration, std::fabs(speed[i] - speed_[i]) / time /
                                                  run_.limits.acceleration[i]);
    speed_ = speed;
    at_ = here;
    before_ = length_;
    length_ = length;
    ++count_;
  }

private:
  const Run &run_;
  Axes at_{}, speed_{};
  int count_ = 0, calm_ = 0;
  double length_ = -1, before_ = -1;
};

void set(::st::SM_CNC::SMC_Interpolator &ipo, const Run &run) {
  ipo.iVelMode = run.mode;
  ipo.dwIpoTime = 2000;
  ipo.dJerkMax = 20000;
  ipo.dOverride = 1;
  ipo.dQuickDeceleration = 4000;
  for (size_t i = 0; i < 3; ++i) {
    ipo.adMaxVelAxis.v[i] = run.ipoVelocity[i];
    ipo.adMaxAccAxis.v[i] = run.ipoAcceleration[i];
  }
  ipo.adMaxVelAxis.v[3] = run.ipoVelocity[4];
  ipo.adMaxAccAxis.v[3] = run.ipoAcceleration[4];
}

void disturb(::st::SM_CNC::SMC_Interpolator &ipo, Random &random) {
  const auto change = [&](stride::BOOL &flag, double on, double off) {
    const bool next = flag != 0 ? !random.chance(off) : random.chance(on);
    flag = static_cast<stride::BOOL>(next);
  };
  change(ipo.bSlow_Stop, 0.005, 0.05);
  change(ipo.bEmergency_Stop, 0.001, 0.2);
  change(ipo.bWaitAtNextStop, 0.01, 0.1);
  change(ipo.bSingleStep, 0.005, 0.05);
  if (random.chance(0.01))
    ipo.dOverride = random.chance(0.2) ? 0 : random.uniform(0, 1);
  if (random.chance(0.03))
    ipo.dOverride = 1;
}

struct Judged {
  double velocity, acceleration;
};

Judged driveRun(uint64_t seed) {
  Random random(seed);
  const Run run = randomRun(random);
  SCOPED_TRACE("seed " + std::to_string(seed) + ", processors \"" + run.names + "\", mode " +
               std::to_string(run.mode) + "\n" + run.text);
  Chain chain(run.text, run.names, run.places);
  auto &ipo = *chain.interpolator;
  set(ipo, run);
  AxisJudge judge(run);
  std::array<double, kJudged> end{};
  constexpr int kMost = 120000; // a sharp bend makes an object very slow
  int cycle = 0;
  int rest = 0;
  for (; cycle < kMost && ipo.bDone == 0; ++cycle) {
    for (int k = 0; k < (cycle == 0 ? 1 : random.below(3)); ++k)
      chain.decode(true);
    for (int k = 0; k < (cycle == 0 ? 1 : random.below(4)); ++k)
      for (size_t i = 0; i < chain.processors.size(); ++i)
        chain.process(i, true);
    if (cycle < 1500)
      disturb(ipo, random);
    else {
      ipo.bSlow_Stop = ipo.bEmergency_Stop = ipo.bWaitAtNextStop = ipo.bSingleStep = 0;
      ipo.dOverride = 1;
    }
    ipo.bAcknM = static_cast<stride::BOOL>(random.chance(0.3));
    chain.checkVelocities(true);
    const cnc::Queue *queue = cnc::queueOf(chain.last());
    if (const PathObject *last = cnc::objectFromEnd(queue, 0); last != nullptr)
      end = {last->end.coordinate[cnc::kAxisX], last->end.coordinate[cnc::kAxisY],
             last->end.coordinate[cnc::kAxisZ], last->end.coordinate[cnc::kAxisA],
             last->end.coordinate[cnc::kAxisP]};
    chain.interpolate(true);
    judge.look(ipo, ipo.bEmergency_Stop != 0);
    rest = ipo.dVel > 0 || cycle < 1500 ? 0 : rest + 1;
    EXPECT_LT(rest, 500) << "it rests for ever";
    EXPECT_EQ(ipo.bError, 0) << ipo.wErrorID;
    for (const ProcessorBlock &p : chain.processors)
      EXPECT_FALSE(p.failed());
    if (testing::Test::HasFailure())
      return {};
  }
  if (cycle < kMost) {
    EXPECT_EQ(axesOf(ipo.piSetPosition), end);
  }
  EXPECT_LE(judge.velocity, 1 + 1e-6);
  // Curves are looked at at some places only; at a kink an axis may jump by what a cycle allows,
  // besides what the path accelerates.
  const bool curves = run.names.find_first_of("bs") != std::string::npos ||
                      run.text.find("G2") != std::string::npos ||
                      run.text.find("G3") != std::string::npos;
  EXPECT_LE(judge.acceleration, run.inObjectsOnly ? (curves ? 1.05 : 1 + 1e-6) : 2);
  return {judge.velocity, judge.acceleration};
}

} // namespace

TEST(CncChainLimits, HoldForEachAxisInEachCycle) {
  for (int i = 0; i < wantedRuns(60) && !HasFailure(); ++i)
    driveRun(300'000 + static_cast<uint64_t>(i));
}
