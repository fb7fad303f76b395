// Blocks of a CNC chain called at random: decoder, processors, velocity check and interpolator in
// any rhythm, with queues of any size, held, stopped, slowed and acknowledged at any moment. What
// arrives is what the same chain makes without all that; nothing jumps; flags say one thing; and
// after an abort a run is, bit for bit, that of new blocks.
#include "tests/property/cnc_chain_rig.hpp"
#include "tests/support/cases.hpp"

#include "st/SM_CNC/SMC_INT_VELMODE.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

/// Where the library's globals lie; an application says so else.
const stride::ULINT st::SM_CNC::SM_CNC_Globals__globals__at__ = 0;

namespace {

using namespace stride::test;
namespace cnc = stride::cnc;
using Path = std::vector<PathObject>;

/// More cases by hand: STRIDE_PATH_CASES=10000.
int wanted(int cases) {
  const char *const more = std::getenv("STRIDE_PATH_CASES");
  return more != nullptr ? std::atoi(more) : casesOf(cases);
}

/// What is left of an object when velocities at its ends are not looked at.
PathObject geometryOf(const PathObject &object) {
  PathObject result = object;
  result.velocityEnd = 0;
  return result;
}

bool same(const PathObject &a, const PathObject &b) {
  const PathObject first = geometryOf(a);
  const PathObject second = geometryOf(b);
  return std::memcmp(static_cast<const void *>(&first), static_cast<const void *>(&second),
                     sizeof first) == 0;
}

void take(OutQueue *queue, Path &into) {
  while (const PathObject *object = cnc::objectAt(cnc::queueOf(queue), 0)) {
    into.push_back(*object);
    cnc::removeAt(cnc::queueOf(queue), 0);
  }
}

/// What the chain makes of a program without anybody who drives it.
Path madeBy(const std::string &text, const std::string &names) {
  Chain chain(text, names, std::vector<size_t>(names.size() + 1, 300));
  Path path;
  for (int cycle = 0; cycle < 4000; ++cycle) {
    chain.decode(true);
    for (size_t i = 0; i < chain.processors.size(); ++i)
      chain.process(i, true);
    take(chain.last(), path);
  }
  EXPECT_NE(chain.last()->bEndOfList, 0);
  return path;
}

/// Inputs of a cycle.
struct Inputs {
  int decodes = 1, processes = 1;
  uint32_t ipoTime = 2000; // [us]
  int16_t mode = 0;
  double jerk = 20000;
  bool slow = false, quick = false, emergency = false, wait = false, single = false,
       acknowledge = false;
  double override = 1;
};

Inputs draw(Random &random, const Inputs &before) {
  Inputs in = before;
  in.decodes = random.below(3);
  in.processes = random.below(3);
  in.acknowledge = random.chance(0.2);
  const auto change = [&](bool &flag, double on, double off) {
    flag = flag ? !random.chance(off) : random.chance(on);
  };
  change(in.slow, 0.01, 0.05);
  change(in.quick, 0.01, 0.05);
  change(in.emergency, 0.005, 0.1);
  change(in.wait, 0.01, 0.05);
  change(in.single, 0.01, 0.05);
  if (random.chance(0.01))
    in.mode = static_cast<int16_t>(random.below(5));
  if (random.chance(0.02))
    in.jerk = random.magnitude(3.5, 5);
  if (random.chance(0.05))
    in.ipoTime = static_cast<uint32_t>(500 + random.below(4000));
  if (random.chance(0.02))
    in.override = random.chance(0.3) ? 0 : random.uniform(0, 1.5);
  if (random.chance(0.05))
    in.override = 1;
  return in;
}

/// Everything back to normal, so that a run ends.
Inputs calm(const Inputs &before) {
  Inputs in;
  in.ipoTime = before.ipoTime;
  in.mode = before.mode;
  in.jerk = before.jerk;
  in.decodes = in.processes = 2;
  in.acknowledge = true;
  return in;
}

/// Decoder and processors of a cycle.
void feed(Chain &chain, const Inputs &in, bool execute, bool abort = false) {
  for (int i = 0; i < in.decodes; ++i)
    chain.decode(execute, abort);
  for (int k = 0; k < in.processes; ++k)
    for (size_t i = 0; i < chain.processors.size(); ++i)
      chain.process(i, execute, abort);
}

void drive(Chain &chain, const Inputs &in, bool execute, bool abort = false) {
  chain.checkVelocities(execute, abort);
  auto &ipo = *chain.interpolator;
  ipo.bSlow_Stop = in.slow;
  ipo.bQuick_Stop = in.quick;
  ipo.bEmergency_Stop = in.emergency;
  ipo.bWaitAtNextStop = in.wait;
  ipo.bSingleStep = in.single;
  ipo.bAcknM = in.acknowledge;
  ipo.dOverride = in.override;
  ipo.iVelMode = in.mode;
  ipo.dwIpoTime = in.ipoTime;
  ipo.dJerkMax = in.jerk;
  ipo.dQuickDeceleration = 4000;
  chain.interpolate(execute, abort);
}

/// Looks at the objects that leave the last queue.
class Departures {
public:
  void before(Chain &chain) {
    waiting_.clear();
    const cnc::Queue *queue = cnc::queueOf(chain.last());
    for (uint32_t i = 0; i < cnc::countOf(queue); ++i)
      waiting_.push_back(*cnc::objectAt(queue, i));
  }
  void after(Chain &chain) {
    const size_t left = cnc::countOf(cnc::queueOf(chain.last()));
    for (size_t i = 0; i + left < waiting_.size(); ++i)
      gone.push_back(waiting_[i]);
  }
  Path gone;

private:
  Path waiting_;
};

void expectFlags(const Chain &chain) {
  const auto &d = *chain.decoder;
  EXPECT_LE(d.bDone + d.bBusy + d.bError, 1);
  for (const ProcessorBlock &p : chain.processors)
    EXPECT_LE(p.done() + p.busy() + p.failed(), 1);
  const auto &ipo = *chain.interpolator;
  EXPECT_LE(ipo.bDone + ipo.bBusy + ipo.bError, 1);
  EXPECT_EQ(ipo.bError, 0) << ipo.wErrorID;
}

double greatest(const Path &path, double PathObject::*member) {
  double most = 0;
  for (const PathObject &o : path)
    most = std::max(most, o.*member);
  return most;
}

/// Judges set positions: the way of a cycle is no longer than dVel says, dVel changes by no more
/// than the path's accelerations allow, and it stands where it says so.
class Judge {
public:
  explicit Judge(const Path &path)
      : rise_(greatest(path, &PathObject::acceleration)),
        fall_(std::max(4000.0, greatest(path, &PathObject::deceleration))),
        fastest_(greatest(path, &PathObject::velocity)) {}

  void look(const ::st::SM_CNC::SMC_Interpolator &ipo, bool emergency) {
    if (ipo.iVelMode == st::SM_CNC::SMC_INT_VELMODE__SIGMOID)
      excess_ = M_PI / 2; // so far this law exceeds accelerations
    if (ipo.bWorking == 0 && ipo.bDone == 0)
      return;
    const auto &p = ipo.piSetPosition;
    const double time = 1e-6 * ipo.dwIpoTime;
    if (time_ > 0) {
      const double way = std::hypot(p.dX - x_, p.dY - y_);
      EXPECT_LE(way, ipo.dVel * time * (1 + 1e-9) + 1e-9) << "at " << p.dX << ", " << p.dY;
      const double change = (ipo.dVel - velocity_) / (0.5 * (time + time_));
      EXPECT_LE(change, excess_ * rise_ * (1 + 1e-6) + 1e-6);
      if (!emergency)
        EXPECT_GE(change, -excess_ * fall_ * (1 + 1e-6) - 1e-6);
      else
        EXPECT_LE(way, 1e-12);
      EXPECT_LE(ipo.dVel, 1.5 * fastest_ * (1 + 1e-9));
    }
    time_ = time;
    x_ = p.dX;
    y_ = p.dY;
    velocity_ = ipo.dVel;
  }

private:
  double rise_, fall_, fastest_;
  double excess_ = 1;
  double x_ = 0, y_ = 0, velocity_ = 0, time_ = 0;
};

struct Case {
  std::string text, names;
  std::vector<size_t> places;
  int16_t mode;
};

Case randomCase(Random &random) {
  Case c;
  const char *const chains[] = {"", "s", "r", "m", "x", "t", "c", "R", "ms", "mr", "tx", "Rcs"};
  c.names = chains[random.below(12)];
  c.text = randomPath(random, c.names.find('t') != std::string::npos);
  for (size_t i = 0; i <= c.names.size(); ++i)
    c.places.push_back(static_cast<size_t>(5 + random.below(random.chance(0.5) ? 3 : 30)));
  c.mode = static_cast<int16_t>(random.below(5));
  return c;
}

void expectSamePath(const Path &gone, const Path &made) {
  ASSERT_EQ(gone.size(), made.size());
  for (size_t i = 0; i < made.size(); ++i)
    ASSERT_TRUE(same(gone[i], made[i])) << "object " << i;
}

constexpr int kMostCycles = 60000;

/// Drives the case to its end; the inputs come from `random` for `disturbed` cycles.
void driveToTheEnd(Chain &chain, Random &random, const Path &made, int disturbed) {
  Judge judge(made);
  Departures departures;
  Inputs in;
  in.mode = chain.interpolator->iVelMode;
  int cycles = 0;
  while (chain.interpolator->bDone == 0 && cycles < kMostCycles && !testing::Test::HasFailure()) {
    in = ++cycles < disturbed ? draw(random, in) : calm(in);
    if (cycles == 1) // so that each knows the queue before it
      in.decodes = in.processes = 1;
    feed(chain, in, true);
    departures.before(chain);
    drive(chain, in, true);
    departures.after(chain);
    expectFlags(chain);
    judge.look(*chain.interpolator, in.emergency);
  }
  ASSERT_EQ(chain.interpolator->bDone, 1) << "after " << cycles << " cycles";
  expectSamePath(departures.gone, made);
}

void driveCase(uint64_t seed) {
  Random random(seed);
  const Case c = randomCase(random);
  SCOPED_TRACE("seed " + std::to_string(seed) + ", processors \"" + c.names + "\"\n" + c.text);
  const Path made = madeBy(c.text, c.names);
  Chain chain(c.text, c.names, c.places);
  chain.interpolator->iVelMode = c.mode;
  driveToTheEnd(chain, random, made, 600);
}

/// What the interpolator says, but for addresses.
std::vector<double> saidBy(const Chain &chain) {
  const auto &o = *chain.interpolator;
  const auto &p = o.piSetPosition;
  std::vector<double> said = {double(o.bDone),
                              double(o.bBusy),
                              double(o.bError),
                              double(o.wErrorID),
                              double(o.iStatus),
                              double(o.bWorking),
                              double(o.wM),
                              double(o.iActObjectSourceNo),
                              double(o.iLastSwitch),
                              double(o.dwSwitches),
                              o.dVel,
                              o.dWayPos,
                              o.vecActTangent.dX,
                              o.vecActTangent.dY,
                              o.dActObjectLength,
                              o.dActObjectLengthPos};
  if (o.bWorking != 0)
    said.insert(said.end(), {p.dX, p.dY, p.dZ, p.dA, double(p.wAuxData), double(p.wSProfile)});
  return said;
}

/// Ends a run somewhere, and drives another one beside a chain of new blocks.
void restartCase(uint64_t seed) {
  Random random(seed);
  const Case c = randomCase(random);
  SCOPED_TRACE("seed " + std::to_string(seed) + ", processors \"" + c.names + "\"\n" + c.text);
  Chain used(c.text, c.names, c.places);
  Chain fresh(c.text, c.names, c.places);
  Inputs in;
  in.mode = c.mode;
  const int before = 1 + random.below(400);
  for (int cycle = 0; cycle < before; ++cycle) {
    if (cycle > 0)
      in = draw(random, in);
    feed(used, in, true);
    drive(used, in, true);
  }
  const bool aborts = random.chance(0.5);
  in.decodes = in.processes = 1; // all see that it ends, and that it begins
  feed(used, in, false, aborts);
  drive(used, in, false, aborts);
  in = Inputs{};
  in.mode = c.mode;
  int cycles = 0;
  const auto left = used.interpolator->piSetPosition;
  while (fresh.interpolator->bDone == 0 && cycles < kMostCycles) {
    if (used.interpolator->bWorking == 0) { // it stays where it was until the path begins
      EXPECT_EQ(used.interpolator->piSetPosition.dX, left.dX);
      EXPECT_EQ(used.interpolator->piSetPosition.dY, left.dY);
    }
    if (cycles++ > 0)
      in = cycles < 400 ? draw(random, in) : calm(in);
    for (Chain *chain : {&used, &fresh}) {
      feed(*chain, in, true);
      drive(*chain, in, true);
    }
    ASSERT_EQ(saidBy(used), saidBy(fresh)) << "cycle " << cycles << ", aborted " << aborts;
  }
  EXPECT_NE(fresh.interpolator->bDone, 0);
}

/// Other programs are appended while blocks may still be at work, or after an abort: nothing is
/// left out in between.
void appendCase(uint64_t seed) {
  Random random(seed);
  const char *const chains[] = {"", "s", "r", "m", "x", "c", "R", "ms", "Rcs", "rx"};
  const std::string names = chains[random.below(10)];
  std::string text = randomPath(random, false);
  SCOPED_TRACE("seed " + std::to_string(seed) + ", processors \"" + names + "\"\n" + text);
  std::vector<size_t> places;
  for (size_t i = 0; i <= names.size(); ++i)
    places.push_back(static_cast<size_t>(6 + random.below(30)));
  Chain chain(text, names, places);
  chain.decoder->bAppend = 1;
  for (ProcessorBlock &processor : chain.processors)
    processor.append(true);
  Path path;
  for (int program = 0; program < 3; ++program) {
    const int cycles = program == 2 ? 4000 : random.below(200);
    for (int cycle = 0; cycle < cycles; ++cycle) {
      Inputs in;
      in.decodes = cycle == 0 ? 1 : random.below(3);
      in.processes = cycle == 0 ? 1 : random.below(3);
      feed(chain, in, true);
      if (random.chance(0.7))
        take(chain.last(), path);
    }
    Inputs in;
    in.decodes = in.processes = 1;
    if (program < 2) // an abort loses nothing of what blocks have held back
      feed(chain, in, false, random.chance(0.5));
    chain.program.diReadPos = 0;
  }
  take(chain.last(), path);
  EXPECT_NE(chain.last()->bEndOfList, 0);
  ASSERT_FALSE(path.empty());
  for (size_t i = 1; i < path.size(); ++i)
    for (int axis = 0; axis < cnc::kAxes; ++axis)
      ASSERT_NEAR(path[i].start.coordinate[axis], path[i - 1].end.coordinate[axis], 1e-9)
          << "object " << i << " axis " << axis;
}

} // namespace

TEST(CncChain, DrivesThePathWhateverIsCalledWhen) {
  for (int i = 0; i < wanted(60) && !HasFailure(); ++i)
    driveCase(9000 + static_cast<uint64_t>(i));
}

TEST(CncChain, DrivesThePathWhereItOnceDidNot) {
  driveCase(9184);   // a single step ended at an M function, which the motion then went past
  driveCase(11'866); // a plan began 4e-15 before the stop at a dwell, and went past it
  driveCase(9248); // it came to a dwell by rounding, before its time was over, and stayed for ever
}

TEST(CncChain, DrivesAfterAnAbortAsNewBlocksDo) {
  for (int i = 0; i < wanted(60) && !HasFailure(); ++i)
    restartCase(50'000 + static_cast<uint64_t>(i));
}

TEST(CncChain, DrivesAfterAnAbortWhereItOnceDidNot) {
  restartCase(50'978); // a stop ended some 1e-14 before the end of what is known: no plan led there
}

TEST(CncChain, AppendsWithoutAGap) {
  for (int i = 0; i < wanted(100) && !HasFailure(); ++i)
    appendCase(90'000 + static_cast<uint64_t>(i));
}
