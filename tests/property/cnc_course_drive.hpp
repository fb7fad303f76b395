// Random programs as objects of a queue, and an interpolator that drives them, cycle by cycle.
#ifndef STRIDE_TESTS_PROPERTY_CNC_COURSE_DRIVE_HPP
#define STRIDE_TESTS_PROPERTY_CNC_COURSE_DRIVE_HPP

#include "runtime/numeric/cnc/corner.hpp"
#include "runtime/numeric/cnc/interpolator_objects.hpp"
#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"

#include "tests/oracle/path/path_check.hpp"
#include "tests/oracle/path/random_program.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace stride::test {

using numeric::Vector3;

/// A program that can be driven, with what judges it.
struct Problem {
  std::vector<cnc::PathObject> objects; ///< Checked for velocities.
  oracle::PathChain chain = oracle::PathChain(oracle::Place{});
  path::AxesLimits axes{};
  double jerk = 0;      ///< [u/s^3]
  double tolerance = 0; ///< Of blends; 0: there are none. [u]
  double cycle = 0;     ///< [s]
};

/// The same motion in `factor` times its time.
inline void retime(oracle::RandomProgram &program, double factor) {
  for (oracle::ProgramMove &move : program.moves) {
    move.velocity /= factor;
    move.acceleration /= factor * factor;
    move.deceleration /= factor * factor;
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    program.axisVelocity[axis] /= factor;
    program.axisAcceleration[axis] /= factor * factor;
  }
  program.jerk /= factor * factor * factor;
}

/// How long the moves would take from rest to rest each, about. [s]
inline double roughTime(const oracle::RandomProgram &program, const oracle::PathChain &chain) {
  double sum = 0;
  for (size_t i = 0; i < program.moves.size(); ++i) {
    const oracle::ProgramMove &move = program.moves[i];
    double velocity = move.velocity;
    double acceleration = std::min(move.acceleration, move.deceleration);
    for (size_t axis = 0; axis < 3; ++axis) {
      velocity = std::min(velocity, program.axisVelocity[axis]);
      acceleration = std::min(acceleration, program.axisAcceleration[axis]);
    }
    const double length = chain.elements()[i].length;
    sum += length / velocity +
           2 * std::min(std::sqrt(length / acceleration), velocity / acceleration) +
           2 * std::cbrt(length / program.jerk);
  }
  return sum;
}

inline Vector3 vectorOf(const oracle::Point &point) { return {point[0], point[1], point[2]}; }

inline cnc::PathObject objectOf(const oracle::ProgramMove &move,
                                const oracle::ChainElement &element, int32_t number) {
  cnc::PathObject object{};
  object.number = object.sourceLine = number;
  object.moveType = cnc::MoveType::Line;
  object.start.axes = object.end.axes = 7;
  for (size_t axis = 0; axis < 3; ++axis) {
    object.start.coordinate[axis] = move.start[axis];
    object.end.coordinate[axis] = move.end[axis];
  }
  object.velocity = object.velocityEnd = move.velocity;
  object.acceleration = move.acceleration;
  object.deceleration = move.deceleration;
  if (element.isArc) {
    const bool clockwise = move.kind == oracle::MoveKind::Clockwise;
    object.moveType = clockwise ? cnc::MoveType::Clockwise : cnc::MoveType::Counterclockwise;
    const Vector3 radial = vectorOf(element.radial);
    const double radius = numeric::norm(radial);
    object.planeX = radial * (1 / radius);
    object.planeY = vectorOf(element.lateral) * ((clockwise ? -1 : 1) / radius);
    object.normal = vectorOf(move.normal);
    const Vector3 centre = vectorOf(element.centre);
    object.shape[0] = numeric::dot(centre, object.planeX);
    object.shape[1] = numeric::dot(centre, object.planeY);
    object.shape[2] = radius;
    object.shape[3] = numeric::dot(centre, object.normal);
    object.parameterRange[1] = (clockwise ? 1 : -1) * element.sweep * 180 / M_PI;
  }
  EXPECT_EQ(cnc::calculateLength(object), cnc::ShapeError::None);
  return object;
}

/// All corners of the objects become curves that leave them by no more than `tolerance`.
inline std::vector<cnc::PathObject> blended(const std::vector<cnc::PathObject> &objects,
                                            double tolerance) {
  std::vector<cnc::PathObject> result;
  auto blender = std::make_unique<cnc::Blender>();
  blender->rules = {exact::kInfinity, tolerance, tolerance, exact::kInfinity, 1e-6};
  cnc::PathObject ready[2];
  for (const cnc::PathObject &object : objects) {
    const int32_t count = cnc::blendNext(*blender, object, ready);
    result.insert(result.end(), ready, ready + count);
  }
  if (cnc::blendEnd(*blender, ready[0]) != 0)
    result.push_back(ready[0]);
  return result;
}

/// A queue in memory.
class Belt {
public:
  explicit Belt(size_t places) : memory_(places) {
    queue.structId = cnc::kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(memory_.data());
    queue.size = static_cast<uint32_t>(memory_.size() * sizeof(cnc::PathObject));
    queue.generator = cnc::kByCheckVelocities;
    queue.reserved = cnc::kReservedPlaces;
  }
  Belt(const Belt &) = delete;
  Belt &operator=(const Belt &) = delete;

  cnc::Queue queue{};

private:
  std::vector<cnc::PathObject> memory_;
};

inline void checkAll(std::vector<cnc::PathObject> &objects) {
  Belt belt(objects.size() + 1);
  for (const cnc::PathObject &object : objects)
    EXPECT_NE(cnc::append(&belt.queue, &object), nullptr);
  belt.queue.endOfList = 1;
  uint32_t checked = belt.queue.readPosition;
  EXPECT_EQ(cnc::checkVelocities(&belt.queue, checked, {0, -1}), cnc::VelocityError::None);
  for (size_t i = 0; i < objects.size(); ++i)
    objects[i] = *cnc::objectAt(&belt.queue, static_cast<uint32_t>(i));
}

/// From rest to the velocity, at least. [s]
inline constexpr double kLeastRamp = 0.0005;

/// A program of a seed that takes some seconds at most, as a rule.
inline Problem randomCourse(uint64_t seed, double mostTime = 2) {
  Random random(seed);
  oracle::ProgramOptions options;
  options.passages = 3;
  options.mostMoves = 25;
  options.anyPlane = random.chance(0.3);
  options.leastScale = 1e-2;
  options.greatestScale = 10;
  oracle::RandomProgram program = oracle::randomProgram(seed, options);
  Problem problem;
  problem.chain = oracle::chainOf(program.moves);
  const double time = roughTime(program, problem.chain);
  retime(program, std::min(1.0, mostTime / time));
  for (oracle::ProgramMove &move : program.moves)
    for (double *const change : {&move.acceleration, &move.deceleration})
      *change = std::min(*change, move.velocity / kLeastRamp);
  problem.jerk = program.jerk;
  for (size_t axis = 0; axis < 3; ++axis) {
    if (random.chance(0.7))
      problem.axes.velocity[axis] = program.axisVelocity[axis];
    if (random.chance(0.7))
      problem.axes.acceleration[axis] = program.axisAcceleration[axis];
  }
  for (size_t i = 0; i < program.moves.size(); ++i)
    problem.objects.push_back(
        objectOf(program.moves[i], problem.chain.elements()[i], static_cast<int32_t>(i)));
  if (random.chance(0.5)) {
    problem.tolerance = program.tolerance;
    problem.objects = blended(problem.objects, problem.tolerance);
  }
  checkAll(problem.objects);
  problem.cycle = random.magnitude(-3, -2);
  return problem;
}

/// Drives the objects of a problem and keeps every sample.
class Drive {
public:
  Drive(const Problem &problem, path::LawKind law, double cycle, size_t places = 0)
      : problem_(problem),
        belt(places != 0 ? places : problem.objects.size() + cnc::kReservedPlaces + 1) {
    command.queue = &belt.queue;
    command.cycle = cycle;
    command.override = 1;
    command.jerk = problem.jerk;
    command.law = law;
    command.share = 1;
    command.limits = problem.axes;
    command.limitKinks = true;
    command.budget = 64 * std::max(1, static_cast<int>(cycle * 1000));
  }

  /// Puts at most `most` objects into the queue, as long as there is room.
  void fill(size_t most = SIZE_MAX) {
    for (; most > 0 && fed < problem_.objects.size() && !cnc::isFull(&belt.queue); --most)
      EXPECT_NE(cnc::append(&belt.queue, &problem_.objects[fed++]), nullptr);
    if (fed == problem_.objects.size())
      belt.queue.endOfList = 1;
  }

  void begin() {
    cnc::start(*interpolator, command);
    samples.clear();
    const cnc::Position &start = problem_.objects.front().start;
    samples.push_back({0, 0, {start.coordinate[0], start.coordinate[1], start.coordinate[2]}});
    sources = {0};
  }

  /// One cycle. The samples count from the last one at rest at the start.
  const cnc::Progress &step() {
    const path::Motion &motion = interpolator->motion;
    const Clock before{motion};
    cnc::cycle(*interpolator, command);
    const cnc::Progress &progress = interpolator->progress;
    if (parts > 1 && progress.length > 0 && motion.way > before.way)
      sampleWithin(before);
    EXPECT_EQ(interpolator->error, 0);
    EXPECT_GE(progress.length, 0);
    way += interpolator->backwards ? -progress.length : progress.length;
    ++cycles;
    moved = moved || progress.length > 0;
    if (!moved)
      ++delay;
    source = progress.source >= 0 ? progress.source : source;
    const double *at = progress.position.coordinate;
    if (interpolator->phase != cnc::Phase::Filling) {
      samples.push_back({static_cast<double>(cycles) * command.cycle, way, {at[0], at[1], at[2]}});
      sources.push_back(source);
    }
    lookAtObject(progress);
    return progress;
  }

  /// Whether it is through, or has failed.
  [[nodiscard]] bool isOver() const {
    return interpolator->phase == cnc::Phase::Finished || interpolator->phase == cnc::Phase::Failed;
  }

  /// To the end; how long it moved. `each` is called before each cycle.
  template <class Each> double finish(Each each, int64_t mostCycles = 1'000'000) {
    while (!isOver() && cycles < mostCycles && !testing::Test::HasFailure()) {
      each();
      step();
    }
    EXPECT_EQ(interpolator->phase, cnc::Phase::Finished)
        << "stuck at " << way << " of " << problem_.chain.length();
    return static_cast<double>(cycles - delay) * command.cycle;
  }
  double finish() {
    return finish([] {});
  }

  /// Between two samples. [s]
  [[nodiscard]] double sampleTime() const { return command.cycle / parts; }

private:
  /// How far the motion is in its law.
  struct Clock {
    int64_t first;
    double since, cycle;
    int64_t cycles;
    double way;
    bool resting, gate;

    /// Before a cycle: a law that has come to its end begins anew.
    explicit Clock(const path::Motion &motion)
        : first(motion.law.first), since(motion.since), cycle(motion.cycle), cycles(motion.cycles),
          way(motion.way), resting(motion.resting), gate(motion.gate), atRest(isAtRest(motion)) {}
    void putInto(path::Motion &motion) const {
      motion.law.first = first;
      motion.since = since;
      motion.cycle = cycle;
      motion.cycles = cycles;
      motion.way = way;
      motion.resting = resting;
      motion.gate = gate;
    }
    bool atRest;
  };

  /// Goes over the cycle that is over once more, in parts, by the law that it went by.
  void sampleWithin(const Clock &before) {
    path::Motion &motion = interpolator->motion;
    const Clock after(motion);
    before.putInto(motion);
    motion.gate = false;
    motion.since =
        before.atRest ? 0 : before.since + before.cycle * static_cast<double>(before.cycles);
    motion.cycles = 0;
    motion.cycle = 0;
    for (int part = 1; part < parts; ++part) {
      const path::WayState state = path::move(motion, sampleTime(), true);
      const double time = (static_cast<double>(cycles) + static_cast<double>(part) / parts);
      samples.push_back(
          {time * command.cycle, way + (motion.way - before.way), placeAt(motion.way)});
      sources.push_back(problem_.objects[object_].sourceLine);
      lookAtMotion(sources.back(), state);
    }
    EXPECT_LE(motion.way, after.way);
    after.putInto(motion);
  }

  /// Where the path is at a way of the motion, which never gets less.
  oracle::Place placeAt(double wayOfMotion) {
    if (!segment_) {
      segment_ = std::make_unique<path::Segment>();
      EXPECT_EQ(cnc::describeSegment(problem_.objects[0], *segment_), cnc::ShapeError::None);
    }
    while (wayOfMotion >= objectBegin_ + segment_->length &&
           object_ + 1 < problem_.objects.size()) {
      objectBegin_ += segment_->length;
      ++object_;
      EXPECT_EQ(cnc::describeSegment(problem_.objects[object_], *segment_), cnc::ShapeError::None);
    }
    const path::PathPoint point =
        path::pointAt(*segment_, std::min(wayOfMotion - objectBegin_, segment_->length));
    return {point.at[0], point.at[1], point.at[2]};
  }

  /// The limits of the object that it is in.
  void lookAtObject(const cnc::Progress &progress) {
    mostOverride = std::max(mostOverride, std::fabs(command.override));
    if (progress.source < 0 || command.twoWays)
      return;
    lookAtMotion(progress.source, progress.motion);
  }
  void lookAtMotion(int32_t move, const path::WayState &motion) {
    const auto of = [&](double cnc::PathObject::*limit) { return limitOf(move, limit); };
    EXPECT_LE(motion.velocity, of(&cnc::PathObject::velocity) * mostOverride * (1 + 1e-6));
    if (command.law == path::LawKind::Sigmoid)
      return;
    EXPECT_LE(motion.acceleration, of(&cnc::PathObject::acceleration) * (1 + 1e-6) + 1e-9);
    EXPECT_GE(motion.acceleration,
              -std::max(of(&cnc::PathObject::deceleration), command.quickDeceleration) *
                      (1 + 1e-6) -
                  1e-9);
  }
  /// That of a move of the program; its blend's is not greater.
  double limitOf(int32_t source, double cnc::PathObject::*limit) {
    while (at_ + 1 < problem_.objects.size() && problem_.objects[at_].sourceLine < source)
      ++at_;
    return problem_.objects[at_].*limit;
  }

  const Problem &problem_;
  size_t at_ = 0;                          ///< The first object of the move where it is.
  size_t object_ = 0;                      ///< The object where the last sample within a cycle is.
  double objectBegin_ = 0;                 ///< Way at its start. [u]
  std::unique_ptr<path::Segment> segment_; ///< Of it.

public:
  Belt belt;
  cnc::Command command{};
  std::unique_ptr<cnc::Interpolator> interpolator = std::make_unique<cnc::Interpolator>();
  std::vector<oracle::Sample> samples;
  std::vector<int32_t> sources; ///< By sample: the move of the program, or the blend after it.
  int32_t source = 0;
  int parts = 1;  ///< Samples of a cycle, but where it stands still.
  double way = 0; ///< [u]
  double mostOverride = 1;
  int64_t cycles = 0;
  int64_t delay = 0; ///< Cycles until it moved.
  size_t fed = 0;
  bool moved = false;
};

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_CNC_COURSE_DRIVE_HPP
