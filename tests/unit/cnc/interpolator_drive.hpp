// A path in memory, with the interpolator that drives it: for tests.
#ifndef STRIDE_TESTS_UNIT_CNC_INTERPOLATOR_DRIVE_HPP
#define STRIDE_TESTS_UNIT_CNC_INTERPOLATOR_DRIVE_HPP

#include "runtime/numeric/cnc/interpolator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace stride::test {

using cnc::MoveType;
using cnc::PathObject;
using cnc::Phase;
using path::LawKind;

inline constexpr double kCycle = 0.001;

/// A path in memory, with the interpolator that drives it.
struct Drive {
  std::vector<PathObject> memory;
  cnc::Queue queue{};
  std::unique_ptr<cnc::Interpolator> interpolator = std::make_unique<cnc::Interpolator>();
  cnc::Command command{};
  cnc::Position last{};
  double time = 0;
  double fastest = 0;

  explicit Drive(LawKind law = LawKind::Trapezoid, size_t places = 100) : memory(places) {
    queue.structId = cnc::kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(memory.data());
    queue.size = static_cast<uint32_t>(memory.size() * sizeof(PathObject));
    queue.generator = cnc::kByCheckVelocities;
    queue.reserved = cnc::kReservedPlaces;
    command.queue = &queue;
    command.cycle = kCycle;
    command.override = 1;
    command.jerk = 20000;
    command.law = law;
    command.share = 1;
    command.budget = 64;
    last.axes = 7;
  }

  PathObject object(MoveType type) const {
    PathObject result{};
    result.moveType = type;
    result.start = last;
    result.end = last;
    result.velocity = result.velocityEnd = 100;
    result.acceleration = 1000;
    result.deceleration = 500;
    return result;
  }

  void add(const PathObject &object) {
    ASSERT_NE(cnc::append(&queue, &object), nullptr);
    last = object.end;
  }

  PathObject &line(double x, double y, double velocityEnd = 100) {
    PathObject result = object(MoveType::Line);
    result.end.coordinate[cnc::kAxisX] = x;
    result.end.coordinate[cnc::kAxisY] = y;
    result.length = std::hypot(x - result.start.coordinate[0], y - result.start.coordinate[1]);
    result.velocityEnd = velocityEnd;
    add(result);
    return *cnc::objectFromEnd(&queue, 0);
  }

  void function(int16_t number, double k = 0) {
    PathObject result = object(MoveType::Function);
    result.switchId[0] = number;
    result.parameterRange[0] = k;
    add(result);
  }

  void start() { cnc::start(*interpolator, command); }

  const cnc::Progress &step() {
    cnc::cycle(*interpolator, command);
    time += command.cycle;
    fastest = std::max(fastest, progress().motion.velocity);
    return progress();
  }
  const cnc::Progress &progress() const { return interpolator->progress; }
  double x() const { return interpolator->position.coordinate[cnc::kAxisX]; }
  double y() const { return interpolator->position.coordinate[cnc::kAxisY]; }
  double velocity() const { return progress().motion.velocity; }

  /// Until the path has ended, or an error; how long.
  double finish(double most = 100) {
    const double begin = time;
    while (interpolator->phase != Phase::Finished && interpolator->phase != Phase::Failed &&
           time < begin + most)
      step();
    EXPECT_EQ(interpolator->phase, Phase::Finished);
    return time - begin;
  }

  template <class Until> void run(Until until, double most = 100) {
    const double end = time + most;
    while (!until()) {
      ASSERT_LT(time, end) << "at " << x() << ", " << y();
      step();
    }
  }
};

} // namespace stride::test

#endif // STRIDE_TESTS_UNIT_CNC_INTERPOLATOR_DRIVE_HPP
