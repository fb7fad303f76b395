// Random machines of every kinematics, and joints for them.
#ifndef STRIDE_TESTS_PROPERTY_RANDOM_KINEMATICS_HPP
#define STRIDE_TESTS_PROPERTY_RANDOM_KINEMATICS_HPP

#include "runtime/numeric/kinematics/hands.hpp"
#include "runtime/numeric/kinematics/parallel.hpp"

#include <random>
#include <type_traits>

namespace stride::kinematics::random {

class Random {
public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  /// A length, or 0 in one of five.
  double offset(double most) { return between(0, 1) < 0.2 ? 0.0 : between(-most, most); }

private:
  std::mt19937_64 engine_{20261124};
};

inline Scara2 make(Random &random, const Scara2 *) {
  return {.firstArm = random.between(0.1, 1), .secondArm = random.between(0.1, 1)};
}
inline Scara2Z make(Random &random, const Scara2Z *) {
  return {make(random, static_cast<Scara2 *>(nullptr))};
}
inline Scara3 make(Random &random, const Scara3 *) {
  return {.arms = make(random, static_cast<Scara2 *>(nullptr)), .thirdArm = random.offset(0.3)};
}
inline Scara3Z make(Random &random, const Scara3Z *) {
  return {make(random, static_cast<Scara3 *>(nullptr))};
}
inline PolarZ make(Random &, const PolarZ *) { return {}; }
inline RigidTool makeTool(Random &random) {
  return {.toolX = random.offset(0.2), .toolY = random.offset(0.2), .toolZ = random.offset(0.2)};
}
inline TurningAxis make(Random &random, const TurningAxis *) { return {makeTool(random)}; }
inline Wrist2 make(Random &random, const Wrist2 *) {
  return {.toolLength = random.offset(0.3),
          .rollX = random.offset(0.1),
          .rollY = random.offset(0.1),
          .rollZ = random.offset(0.1)};
}
inline Wrist3 make(Random &random, const Wrist3 *) { return {makeTool(random)}; }
inline Gantry2 make(Random &, const Gantry2 *) { return {}; }
inline Gantry3 make(Random &, const Gantry3 *) { return {}; }
inline ArmRrr make(Random &random, const ArmRrr *) {
  return {.d1 = random.offset(1),
          .a1 = random.offset(0.2),
          .a2 = random.between(0.2, 1),
          .d3 = random.offset(0.1),
          .a3 = random.offset(0.1),
          .d4 = random.between(0.2, 1)};
}
inline Palletiser make(Random &random, const Palletiser *) {
  return {.shoulderHeight = random.offset(1),
          .shoulderFront = random.offset(0.2),
          .upperArm = random.between(0.2, 1),
          .forearm = random.between(0.2, 1),
          .handFront = random.offset(0.2),
          .handDown = random.offset(0.2)};
}
inline OffsetWristArm make(Random &random, const OffsetWristArm *) {
  const double upper = random.between(0, 1) < 0.5 ? -1 : 1;
  const double fore = random.between(0, 1) < 0.5 ? -1 : 1;
  return {.d1 = random.offset(0.2),
          .a2 = upper * random.between(0.2, 0.6),
          .a3 = fore * random.between(0.2, 0.6),
          .d4 = random.offset(0.2),
          .d5 = random.offset(0.1),
          .d6 = random.offset(0.1)};
}
inline FiveAxisTable make(Random &random, const FiveAxisTable *) {
  return {.centreX = random.offset(0.3),
          .centreY = random.offset(0.3),
          .centreZ = random.offset(0.3),
          .tableHeight = random.offset(0.1)};
}
template <class Arm, class Hand>
Coupled<Arm, Hand> make(Random &random, const Coupled<Arm, Hand> *) {
  return {make(random, static_cast<Arm *>(nullptr)), make(random, static_cast<Hand *>(nullptr))};
}
inline BeltPortal make(Random &random, const BeltPortal *) {
  return random.between(0, 1) < 0.5 ? kHGantry2 : kTGantry2;
}
inline TripodLinear make(Random &random, const TripodLinear *) {
  return {.outerRadius = random.between(0.3, 0.5),
          .innerRadius = random.between(0, 0.2),
          .rod = random.between(0.9, 1.5),
          .lean = random.between(-0.2, 0.2),
          .firstAngle = random.between(-3, 3)};
}
inline TripodRotary make(Random &random, const TripodRotary *) {
  return {.upperArm = random.between(0.2, 0.4),
          .rod = random.between(0.9, 1.2),
          .motorRadius = random.between(0.1, 0.3),
          .plateRadius = random.between(0.03, 0.1),
          .firstAngle = random.between(-3, 3)};
}
inline BipodRotary make(Random &random, const BipodRotary *) {
  return {.motorDistance = random.between(0.1, 0.4),
          .upperArm = random.between(0.2, 0.4),
          .rod = random.between(0.9, 1.2),
          .plateDistance = random.between(0, 0.1)};
}

template <class Model> Model makeModel(Random &random) {
  return make(random, static_cast<Model *>(nullptr));
}

/// How many joints swing arms that rods hold together.
template <class Model> inline constexpr int kSwinging = 0;
template <> inline constexpr int kSwinging<TripodRotary> = 3;
template <> inline constexpr int kSwinging<BipodRotary> = 2;
template <class Hand> inline constexpr int kSwinging<Coupled<TripodRotary, Hand>> = 3;

/// Joints of parallel kinematics stay where their rods hold; others turn all the way round, and a
/// bit more.
template <class Model> void drawJoints(Random &random, double (&joint)[kMostJoints]) {
  for (int i = 0; i < Model::kJoints; ++i) {
    const bool turns = (Model::kTurning >> i & 1U) != 0;
    joint[i] = turns ? random.between(-4, 4) : random.between(-0.1, 0.1);
  }
  for (int i = 0; i < kSwinging<Model>; ++i)
    joint[i] = random.between(-0.6, 1.2);
  if (std::is_same_v<Model, PolarZ>)
    joint[1] = random.between(0.01, 1);
}

} // namespace stride::kinematics::random

#endif // STRIDE_TESTS_PROPERTY_RANDOM_KINEMATICS_HPP
