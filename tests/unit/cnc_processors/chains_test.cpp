// Processors one after the other: all at once with small queues does what one after the other does
// with large ones, and where the order says nothing about the path, it makes none.
#include "tests/unit/cnc_processors/contours.hpp"
#include "tests/unit/cnc_processors/outlines.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/processors/abc_slopes.hpp"
#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/axis_limits.hpp"
#include "runtime/numeric/cnc/processors/corner_path.hpp"
#include "runtime/numeric/cnc/processors/limit_circular.hpp"
#include "runtime/numeric/cnc/processors/limit_dynamics.hpp"
#include "runtime/numeric/cnc/processors/merge_path.hpp"
#include "runtime/numeric/cnc/processors/object_splitter.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"
#include "runtime/numeric/cnc/processors/transform.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <memory>
#include <string>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::contours;
using namespace stride::cnc::test;

using Path = std::vector<PathObject>;

/// A processor as others see it.
class Stage {
public:
  virtual ~Stage() = default;
  virtual void begin(Queue *output) = 0;
  virtual void step(Queue *input, Queue *output) = 0;
  virtual Path run(const Path &path) = 0;
  StreamState stream{};
};

template <class Processor> class StageOf : public Stage {
public:
  explicit StageOf(const std::function<void(Processor &)> &set) {
    std::memset(static_cast<void *>(&processor_), 0, sizeof processor_);
    if (set)
      set(processor_);
  }
  void begin(Queue *output) override {
    startStream(stream, output, Processor::kGenerator, false);
    start(processor_);
  }
  void step(Queue *input, Queue *output) override { stepStream(stream, processor_, input, output); }
  Path run(const Path &path) override {
    const Outcome outcome = runPath(processor_, path, {600, 600, 0, 0});
    EXPECT_EQ(outcome.stream.phase, StreamPhase::Done);
    return outcome.objects;
  }

private:
  Processor processor_;
};

template <class Processor>
std::unique_ptr<Stage> stage(const std::function<void(Processor &)> &set = {}) {
  return std::make_unique<StageOf<Processor>>(set);
}

std::unique_ptr<Stage> stageOf(char name) {
  switch (name) {
  case 'm':
    return stage<MergePath>([](MergePath &p) { p.tolerance = 1e-3; });
  case 't':
    return stage<ToolCorrection>([](ToolCorrection &p) { p.rules.radius = 0.7; });
  case 'l':
    return stage<LoopAvoider>();
  case 's':
    return stage<SmoothPath>([](SmoothPath &p) {
      p.distance = 0.8;
      p.passesFunctions = true;
    });
  case 'q':
    return stage<SmoothPath>([](SmoothPath &p) {
      p.distance = 0.8;
      p.kind = PieceKind::Quintic;
    });
  case 'r':
    return stage<RoundPath>([](RoundPath &p) {
      p.distance = 0.8;
      p.kind = PieceKind::Arc;
    });
  case 'x':
    return stage<ObjectSplitter>([](ObjectSplitter &p) {
      p.parameter = 1.5;
      p.byLength = true;
    });
  case 'a':
    return stage<AbcSlopes>([](AbcSlopes &p) { p.angle = 0.3; });
  case 'c':
    return stage<LimitCircular>([](LimitCircular &p) { p.acceleration = 90; });
  case 'e':
    return stage<LimitByAxes>();
  case 'd':
    return stage<LimitDynamics>([](LimitDynamics &p) {
      p.axes = 3;
      p.velocity = 30;
    });
  case 'T':
    return stage<TranslatePath>([](TranslatePath &p) {
      p.wanted = {TransformKind::Translate, {3, -7, 0}};
    });
  default:
    return stage<RotatePath>([](RotatePath &p) { p.wanted = {TransformKind::Rotate, {50, 0, 0}}; });
  }
}

Path oneAfterTheOther(const std::string &names, Path path) {
  for (const char name : names)
    path = stageOf(name)->run(path);
  return path;
}

/// All in each cycle, by queues with few places; before loops one that holds the path.
Path allAtOnce(const std::string &names, const Path &path) {
  std::vector<std::unique_ptr<OwnedQueue>> queues;
  std::vector<std::unique_ptr<Stage>> stages;
  for (size_t i = 0; i <= names.size(); ++i)
    queues.push_back(
        std::make_unique<OwnedQueue>(i < names.size() && names[i] == 'l' ? 600 : 5 + i % 3));
  for (size_t i = 0; i < names.size(); ++i) {
    stages.push_back(stageOf(names[i]));
    stages.back()->begin(&queues[i + 1]->queue);
  }
  Path result;
  size_t fed = 0;
  for (int cycle = 0; cycle < 100000 && stages.back()->stream.phase != StreamPhase::Done; ++cycle) {
    Queue &first = queues.front()->queue;
    if (fed < path.size() && !isFull(&first))
      append(&first, &path[fed++]);
    else if (fed == path.size())
      first.endOfList = 1;
    for (size_t i = 0; i < stages.size(); ++i)
      stages[i]->step(&queues[i]->queue, &queues[i + 1]->queue);
    Queue &last = queues.back()->queue;
    while (countOf(&last) > (stages.back()->stream.phase == StreamPhase::Done ? 0U : 1U)) {
      result.push_back(*objectAt(&last, 0));
      removeAt(&last, 0);
    }
  }
  EXPECT_EQ(stages.back()->stream.phase, StreamPhase::Done) << names;
  return result;
}

/// A part with a thin slot, round corners, short lines, M functions, A that turns; G51, G52 and
/// G61 for all of it.
Path part() {
  std::mt19937 random(4);
  Drawing d = comb(random, 3);
  const size_t count = d.path.size();
  for (size_t i = 0; i < count; ++i) {
    PathObject &o = d.path[i];
    o.toolRadius = 0.6;
    o.start.axes = o.end.axes = 7 | 1 << kAxisA;
    o.start.coordinate[kAxisA] = i == 0 ? 0 : d.path[i - 1].end.coordinate[kAxisA];
    o.end.coordinate[kAxisA] = static_cast<double>(i * i % 7);
    o.limits[1].velocity = 9;
    if (i % 5 == 2) {
      o.switchId[0] = static_cast<int16_t>(1 + i);
      o.switchPosition[0] = 0.4;
    }
  }
  d.path.front().marks = kToolRight | kAvoidLoops | kSmooth | kRound;
  d.path.back().marks = kEndToolCorrection | kEndAvoidLoops | kEndSmoothing;
  PathObject function = d.path[6];
  function.moveType = MoveType::Function;
  function.end = function.start;
  function.switchId[0] = 33;
  function.marks = 0;
  d.path.insert(d.path.begin() + 6, function);
  return d.path;
}

double greatestJump(const Path &path) {
  double most = 0;
  for (size_t i = 1; i < path.size(); ++i)
    for (int k = 0; k < kAxes; ++k)
      most = std::max(most, std::fabs(path[i].start.coordinate[k] - path[i - 1].end.coordinate[k]));
  return most;
}

/// Every sensible order: the tool before the loops, both before corners, cuts and slopes behind
/// them, limits wherever.
constexpr const char *kChains[] = {
    "tl",      "tlsdc",    "tlqxacde", "tlrxc",   "mtlsxaced", "mtlrecd", "ctlsd",   "Ttlscd",
    "tTlsRcd", "tlTsRced", "tlsTRd",   "dmtsaxc", "cmrsde",    "mqxdca",  "tsxRaTc", "eTRmtlq"};

TEST(Chains, DoAllAtOnceWhatTheyDoOneAfterTheOther) {
  const Path drawn = part();
  for (const std::string names : kChains) {
    const Path expected = oneAfterTheOther(names, drawn);
    const Path path = allAtOnce(names, drawn);
    ASSERT_EQ(path.size(), expected.size()) << names;
    EXPECT_EQ(std::memcmp(path.data(), expected.data(), path.size() * sizeof(PathObject)), 0)
        << names;
    EXPECT_LT(greatestJump(path), 1e-9) << names;
    int functions = 0;
    for (const PathObject &o : path) {
      functions += o.moveType == MoveType::Function ? 1 : 0;
      EXPECT_GE(o.velocity, 0) << names;
    }
    EXPECT_EQ(functions, 1) << names;
  }
}

/// How far two paths are apart, by places of both.
double apart(const Path &a, const Path &b) {
  const std::vector<Point> first = sampled(a, 40);
  const std::vector<Point> second = sampled(b, 40);
  double most = 0;
  for (const Point &p : sampled(a, 4))
    most = std::max(most, distanceTo(p, second));
  for (const Point &p : sampled(b, 4))
    most = std::max(most, distanceTo(p, first));
  return most;
}

double lengthOf(const Path &path) {
  double sum = 0;
  for (const PathObject &o : path)
    sum += o.length;
  return sum;
}

TEST(Chains, MakeTheSamePathInOtherOrders) {
  const Path drawn = part();
  // Moving it commutes with all that changes it, and limits change nothing of it.
  for (const char *family : {"tlsTR|TtlsR|tTlRs|tTRls|TRtls|cTRtdls", "tlqTR|tTRlq|TRtlq|deTtlRqc",
                             "tlrTR|TtlrR|tTRlr|TRtlr|TecRtlr", "mtlTR|TRmtl|mTtRl"}) {
    std::string names;
    Path first;
    for (const char *at = family;; ++at) {
      if (*at != '|' && *at != 0) {
        names += *at;
        continue;
      }
      const Path path = oneAfterTheOther(names, drawn);
      if (first.empty())
        first = path;
      EXPECT_EQ(path.size(), first.size()) << names;
      EXPECT_NEAR(lengthOf(path), lengthOf(first), 1e-8) << names;
      EXPECT_LT(apart(path, first), 1e-8) << names;
      names.clear();
      if (*at == 0)
        break;
    }
  }
  // What is cut in parts goes where the whole went.
  const Path whole = oneAfterTheOther("tls", drawn);
  const Path parts = oneAfterTheOther("tlsx", drawn);
  EXPECT_GT(parts.size(), whole.size());
  EXPECT_NEAR(lengthOf(parts), lengthOf(whole), 1e-9);
  EXPECT_LT(apart(parts, whole), 1e-3); // chords of longer curves
}

/// Limits that only lower something do so in any order.
TEST(Chains, LimitTheSameInOtherOrders) {
  const Path drawn = oneAfterTheOther("tls", part());
  const Path first = oneAfterTheOther("ced", drawn);
  bool lowered = false;
  for (const char *names : {"ecd", "edc", "dec", "dce", "cde"}) {
    const Path path = oneAfterTheOther(names, drawn);
    ASSERT_EQ(path.size(), first.size());
    for (size_t i = 0; i < path.size(); ++i) {
      EXPECT_DOUBLE_EQ(path[i].velocity, first[i].velocity) << names << ' ' << i;
      lowered = lowered || path[i].velocity < drawn[i].velocity;
    }
  }
  EXPECT_TRUE(lowered);
}

/// What a processor has done it does not do again.
TEST(Chains, DoNothingTwice) {
  for (const char *names : {"l", "e", "c", "d", "m"}) {
    const Path once = oneAfterTheOther(std::string("tls") + names, part());
    const Path twice = oneAfterTheOther(names, once);
    ASSERT_EQ(twice.size(), once.size()) << names;
    EXPECT_LT(apart(twice, once), 1e-12) << names;
    for (size_t i = 0; i < once.size(); ++i)
      EXPECT_DOUBLE_EQ(twice[i].velocity, once[i].velocity) << names;
  }
}

} // namespace
