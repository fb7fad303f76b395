#include "runtime/numeric/kinematics/any_kinematics.hpp"

#include "runtime/numeric/kinematics/any_parts.hpp"
#include "runtime/numeric/kinematics/hands.hpp"
#include "runtime/numeric/kinematics/motion_of_joints.hpp"
#include "runtime/numeric/quarter_turns.hpp"

namespace stride::kinematics {
namespace {

using numeric::kDegree;

template <class Scalar> const ArmFunctions<Scalar> &functionsOf(const ArmTable &table) {
  if constexpr (__is_same(Scalar, double))
    return table.numbers;
  else
    return table.jets;
}
template <class Scalar> const HandFunctions<Scalar> &functionsOf(const HandTable &table) {
  if constexpr (__is_same(Scalar, double))
    return table.numbers;
  else
    return table.jets;
}

/// The numbers of one kind of scalar for both parts of a kinematics, joints in radians.
template <class Scalar> class Parts {
public:
  explicit Parts(const AnyKinematics &kinematics)
      : kinematics_(kinematics), arm_(tableOf(kinematics.arm)), hand_(tableOf(kinematics.hand)),
        hasHand_(kinematics.hand != HandKind::None) {}

  Outcome forward(const Scalar *joints, Frame<Scalar> &end) const {
    const Outcome outcome = armForward(joints, end);
    if (hasHand_)
      end = end * functionsOf<Scalar>(hand_).forward(kinematics_.handMeasure, joints + arm_.joints);
    return outcome;
  }

  /// The frame of the last joint for a frame of the tool, of one that has a tool: its axes are
  /// those nearest to the wanted ones that the joints reach.
  Outcome endFor(const Frame<Scalar> &tool, Posture posture, const double *reference,
                 Frame<Scalar> &end) const {
    end = tool;
    const Frame<double> own = toolOf(kinematics_);
    end.turn = times(tool.turn, Matrix<double>(own.turn.transpose()));
    const Outcome outcome = reachedTurn(posture, reference, end.turn);
    end.place -= times(end.turn, own.place);
    return outcome;
  }

  /// As Coupled::inverse, which knows its parts when it is compiled.
  Outcome inverse(const Frame<Scalar> &end, Posture posture, const double *reference,
                  Scalar *joints) const {
    const ArmFunctions<Scalar> &arm = functionsOf<Scalar>(arm_);
    if (!hasHand_)
      return arm.inverse(kinematics_.armMeasure, end, posture, reference, joints);
    const HandFunctions<Scalar> &hand = functionsOf<Scalar>(hand_);
    Scalar *handJoints = joints + arm_.joints;
    const double *handReference = reference + arm_.joints;
    if (arm.heading != nullptr && hand_.aboutZ)
      return inverseAboutZ(end, posture, reference, joints);
    Frame<Scalar> flange{hand.nearest(end.turn), end.place};
    if (arm_.keepsTurn) {
      hand.turnTo(kinematics_.handMeasure, flange.turn, posture, handReference, handJoints);
      flange.place -= hand.forward(kinematics_.handMeasure, handJoints).place;
      return arm.inverse(kinematics_.armMeasure, flange, posture, reference, joints);
    }
    flange.place -= times(flange.turn, hand_.offset(kinematics_.handMeasure));
    const Outcome outcome = arm.inverse(kinematics_.armMeasure, flange, posture, reference, joints);
    if (outcome != Outcome::Done)
      return outcome;
    hand.turnTo(kinematics_.handMeasure, arm.rest(kinematics_.armMeasure, joints, flange.turn),
                posture, handReference, handJoints);
    return Outcome::Done;
  }

private:
  /// Both parts turn the tool about z: what the arm does not, the hand does.
  Outcome inverseAboutZ(const Frame<Scalar> &end, Posture posture, const double *reference,
                        Scalar *joints) const {
    const ArmFunctions<Scalar> &arm = functionsOf<Scalar>(arm_);
    const Scalar heading = turnAboutZ(end.turn);
    const Frame<Scalar> flange{
        end.turn, flangePlace(end.place, heading, hand_.offset(kinematics_.handMeasure))};
    const Outcome outcome = arm.inverse(kinematics_.armMeasure, flange, posture, reference, joints);
    if (outcome == Outcome::Done)
      joints[arm_.joints] =
          nearTo(reference[arm_.joints], heading - arm.heading(kinematics_.armMeasure, joints));
    return outcome;
  }

  Outcome armForward(const Scalar *joints, Frame<Scalar> &flange) const {
    return functionsOf<Scalar>(arm_).forward(kinematics_.armMeasure, joints, flange);
  }

  /// Of a wanted orientation of the last joint what the joints reach, as far as a tool's point
  /// needs it (check() has seen to it that this is known).
  Outcome reachedTurn(Posture posture, const double *reference, Matrix<Scalar> &turn) const {
    if (hasHand_) {
      const HandFunctions<Scalar> &hand = functionsOf<Scalar>(hand_);
      turn = hand.nearest(turn);
      if (!arm_.keepsTurn)
        return Outcome::Done;
      Scalar joints[kMostJoints];
      hand.turnTo(kinematics_.handMeasure, turn, posture, reference + arm_.joints, joints);
      turn = hand.forward(kinematics_.handMeasure, joints).turn;
      return Outcome::Done;
    }
    if (arm_.task == Task::Full)
      return Outcome::Done;
    if (arm_.task == Task::PlaneTurn || arm_.task == Task::PlaceTurn) {
      turn = aboutZ(turnAboutZ(turn));
      return Outcome::Done;
    }
    if (arm_.task == Task::PlaceDirection) {
      // The orientation of such a machine does not depend on the place.
      Frame<Scalar> frame{turn, Vector<Scalar>::Zero()};
      Scalar joints[kMostJoints];
      const Outcome outcome = functionsOf<Scalar>(arm_).inverse(kinematics_.armMeasure, frame,
                                                                posture, reference, joints);
      if (outcome == Outcome::Done)
        (void)armForward(joints, frame);
      turn = frame.turn;
      return outcome;
    }
    // The flange keeps its turn, or only its z axis counts, which is upright.
    turn = Matrix<Scalar>::Identity();
    return Outcome::Done;
  }

  const AnyKinematics &kinematics_;
  const ArmTable &arm_;
  const HandTable &hand_;
  bool hasHand_;
};

bool isFinite(const double *numbers, int count) {
  for (int i = 0; i < count; ++i)
    if (!exact::isfinite(numbers[i]))
      return false;
  return true;
}

/// Whether measures are numbers whose fourth powers (bendArm) are numbers, too, and are not lost.
bool areMeasures(const double *numbers, int count) {
  constexpr double kLeast = 1e-50;
  constexpr double kMost = 1e50;
  for (int i = 0; i < count; ++i) {
    const double size = exact::fabs(numbers[i]);
    if (!(size <= kMost) || (size < kLeast && size > 0.0))
      return false;
  }
  return true;
}

/// Whether the parts have a way back from a pose.
bool fitTogether(const AnyKinematics &kinematics) {
  if (kinematics.hand == HandKind::None)
    return true;
  const ArmTable &arm = tableOf(kinematics.arm);
  if (arm.task != Task::Plane && arm.task != Task::Place)
    return false; // it turns its tool by itself
  if (kinematics.hand == HandKind::TurningAxis)
    return arm.upright;
  if (kinematics.hand == HandKind::Wrist3)
    return arm.task == Task::Place;
  // Where the roll axis is depends on a joint that is known only after the arm's.
  const double *roll = kinematics.handMeasure + 1;
  return arm.task == Task::Place &&
         (arm.keepsTurn || (roll[0] == 0 && roll[1] == 0 && roll[2] == 0));
}

/// Whether it is known where the tool's point is before the arm's joints are.
bool toolFits(const AnyKinematics &kinematics) {
  const double *place = kinematics.toolPlace;
  const bool alongZ = place[0] == 0 && place[1] == 0;
  const ArmTable &arm = tableOf(kinematics.arm);
  if (arm.keepsTurn)
    return true;
  if (kinematics.hand == HandKind::Wrist2)
    return alongZ;
  if (kinematics.hand != HandKind::None || (arm.task != Task::Plane && arm.task != Task::Place))
    return true;
  return alongZ && (arm.upright || place[2] == 0);
}

double &valueIn(double &number) { return number; }
double &valueIn(Jet<3> &number) { return number.c[0]; }

template <class Scalar>
Outcome forwardOf(const AnyKinematics &kinematics, const Scalar *axes, Frame<Scalar> &tool) {
  if (kinematics.arm == ArmKind::None)
    return Outcome::NotSet;
  Scalar joints[kMostJoints];
  const unsigned turning = kinematics.turning();
  const int count = kinematics.joints();
  for (int i = 0; i < count; ++i) {
    joints[i] = axes[i] - Scalar(kinematics.offset[i]);
    if ((turning >> i & 1U) != 0)
      joints[i] = joints[i] * kDegree;
  }
  const Outcome outcome = Parts<Scalar>(kinematics).forward(joints, tool);
  if (!kinematics.hasTool)
    return outcome;
  const Frame<double> own = toolOf(kinematics);
  tool.place += times(tool.turn, own.place);
  tool.turn = times(tool.turn, own.turn);
  return outcome;
}

template <class Scalar>
Outcome inverseOf(const AnyKinematics &kinematics, const Frame<Scalar> &tool, Posture posture,
                  const double *reference, Scalar *axes) {
  if (kinematics.arm == ArmKind::None)
    return Outcome::NotSet;
  const unsigned turning = kinematics.turning();
  const int count = kinematics.joints();
  double near[kMostJoints];
  for (int i = 0; i < count; ++i) {
    near[i] = reference[i] - kinematics.offset[i];
    if ((turning >> i & 1U) != 0)
      near[i] *= kDegree;
  }
  const Parts<Scalar> parts(kinematics);
  Frame<Scalar> end;
  Outcome outcome = kinematics.hasTool ? parts.endFor(tool, posture, near, end) : Outcome::Done;
  Scalar joints[kMostJoints];
  if (outcome == Outcome::Done)
    outcome = parts.inverse(kinematics.hasTool ? end : tool, posture, near, joints);
  if (outcome != Outcome::Done)
    return outcome;
  for (int i = 0; i < count; ++i) {
    const bool turns = (turning >> i & 1U) != 0;
    axes[i] = (turns ? joints[i] / kDegree : joints[i]) + Scalar(kinematics.offset[i]);
    if (!exact::isfinite(valueIn(axes[i])))
      return Outcome::Unreachable; // the pose is none of numbers, or much too far
    if (!bringIntoRange(kinematics.range[i], turns, valueIn(axes[i])))
      outcome = Outcome::OutOfLimits;
  }
  return outcome;
}

using AnyJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMostJoints>;
using AnySquare = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                kMostJoints, kMostJoints>;

/// As jacobianOf and ownRows do with a model: the rows that the joints answer for.
Outcome ownJacobian(const AnyKinematics &kinematics, const double *joints, AnySquare &own) {
  const int count = kinematics.joints();
  Jet<1> moving[kMostJoints];
  for (int i = 0; i < count; ++i)
    moving[i] = Jet<1>(joints[i]);
  AnyJacobian jacobian(6, count);
  Frame<Jet<1>> pose;
  for (int i = 0; i < count; ++i) {
    moving[i].c[1] = 1;
    const Outcome outcome = ratesOf(kinematics, moving, pose);
    if (outcome != Outcome::Done)
      return outcome;
    moving[i].c[1] = 0;
    const Vector<double> rate = turnRateOf(pose.turn);
    for (int row = 0; row < 3; ++row) {
      jacobian(row, i) = pose.place(row).c[1];
      jacobian(3 + row, i) = rate(row);
    }
  }
  const Task task = kinematics.task();
  own.resize(count, count);
  const int place = task == Task::Plane || task == Task::PlaneTurn ? 2 : 3;
  for (int row = 0; row < place; ++row)
    own.row(row) = jacobian.row(row);
  if (task == Task::PlaneTurn || task == Task::PlaceTurn)
    own.row(place) = jacobian.row(5);
  else if (task == Task::Full)
    own.bottomRows<3>() = jacobian.bottomRows<3>();
  else if (task == Task::PlaceDirection)
    for (int row = 0; row < 2; ++row)
      for (int i = 0; i < count; ++i) {
        double rate = 0;
        for (int k = 0; k < 3; ++k)
          rate += pose.turn(k, row).c[0] * jacobian(3 + k, i);
        own(3 + row, i) = rate;
      }
  return Outcome::Done;
}

const AnyKinematics &self(const void *kinematics) {
  return *static_cast<const AnyKinematics *>(kinematics);
}

constexpr KinematicsTable makeTable() {
  KinematicsTable table{};
  table.joints = [](const void *kinematics) { return self(kinematics).joints(); };
  table.turning = [](const void *kinematics) { return self(kinematics).turning(); };
  table.task = [](const void *kinematics) { return self(kinematics).task(); };
  table.reach = [](const void *kinematics) { return self(kinematics).reach(); };
  table.check = [](const void *kinematics) { return self(kinematics).check(); };
  table.forward = [](const void *kinematics, const double *joints, Frame<double> &tool) {
    return self(kinematics).forward(joints, tool);
  };
  table.forwardJets = [](const void *kinematics, const Jet<3> *joints, Frame<Jet<3>> &tool) {
    return self(kinematics).forward(joints, tool);
  };
  table.configurationOf = [](const void *kinematics, const double *joints) {
    return configurationOf(self(kinematics).postureOf(joints));
  };
  table.inverse = [](const void *kinematics, const Frame<double> &tool,
                     const Configuration &configuration, const double *reference, double *joints) {
    return self(kinematics).inverse(tool, postureOf(configuration), reference, joints);
  };
  table.inverseJets = [](const void *kinematics, const Frame<Jet<3>> &tool,
                         const Configuration &configuration, const double *reference,
                         Jet<3> *joints) {
    return self(kinematics).inverse(tool, postureOf(configuration), reference, joints);
  };
  table.distanceFromSingular = [](const void *kinematics, const double *joints) {
    return self(kinematics).distanceFromSingular(joints);
  };
  table.splits = [](const void *kinematics, unsigned &toolAxes) {
    return self(kinematics).splits(toolAxes);
  };
  table.placingConfigurationOf = [](const void *kinematics, const double *joints) {
    return configurationOf(self(kinematics).placingPostureOf(joints));
  };
  table.place = [](const void *kinematics, const Vector<double> &point,
                   const Configuration &configuration, const double *reference, double *joints) {
    return self(kinematics).place(point, postureOf(configuration), reference, joints);
  };
  table.placeJets = [](const void *kinematics, const Vector<Jet<3>> &point,
                       const Configuration &configuration, const double *reference,
                       Jet<3> *joints) {
    return self(kinematics).place(point, postureOf(configuration), reference, joints);
  };
  return table;
}

constexpr KinematicsTable kTable = makeTable();

} // namespace

void AnyKinematics::setTool(const Frame<double> &tool) noexcept {
  hasTool = true;
  for (int row = 0; row < 3; ++row) {
    toolPlace[row] = tool.place(row);
    for (int column = 0; column < 3; ++column)
      toolTurn[row][column] = tool.turn(row, column);
  }
}

int AnyKinematics::joints() const {
  if (arm == ArmKind::None)
    return 0;
  return tableOf(arm).joints + (hand == HandKind::None ? 0 : tableOf(hand).joints);
}

unsigned AnyKinematics::turning() const {
  if (arm == ArmKind::None)
    return 0;
  const ArmTable &table = tableOf(arm);
  return table.turning |
         (hand == HandKind::None ? 0U
                                 : tableOf(hand).turning << static_cast<unsigned>(table.joints));
}

Task AnyKinematics::task() const {
  const Task own = tableOf(arm).task;
  return hand == HandKind::None ? own : tableOf(hand).together(own);
}

double AnyKinematics::reach() const {
  if (arm == ArmKind::None)
    return 0;
  const double own = tableOf(arm).reach(armMeasure);
  return hand == HandKind::None ? own : own + tableOf(hand).offset(handMeasure).norm();
}

Outcome AnyKinematics::check() const {
  if (arm == ArmKind::None)
    return Outcome::NotSet;
  if (joints() > kMostJoints)
    return Outcome::WrongCoupling;
  const ArmTable &table = tableOf(arm);
  const int handMeasures = hand == HandKind::None ? 0 : tableOf(hand).measures;
  if (!areMeasures(armMeasure, table.measures) || !areMeasures(handMeasure, handMeasures) ||
      !areMeasures(offset, joints()))
    return Outcome::WrongMeasures;
  const double zero[kMostJoints] = {};
  Frame<double> pose;
  if (table.numbers.forward(armMeasure, zero, pose) == Outcome::WrongMeasures)
    return Outcome::WrongMeasures;
  if (!fitTogether(*this))
    return Outcome::WrongCoupling;
  for (int i = 0; i < joints(); ++i)
    if (range[i].limited && !(range[i].lower <= range[i].upper))
      return Outcome::WrongLimits;
  if (!hasTool)
    return Outcome::Done;
  return isFinite(toolPlace, 3) && isFinite(toolTurn[0], 9) && toolFits(*this) ? Outcome::Done
                                                                               : Outcome::WrongTool;
}

Outcome AnyKinematics::forward(const double *axes, Frame<double> &tool) const {
  return forwardOf(*this, axes, tool);
}
Outcome AnyKinematics::forward(const Jet<3> *axes, Frame<Jet<3>> &tool) const {
  return forwardOf(*this, axes, tool);
}

Posture AnyKinematics::postureOf(const double *axes) const {
  if (arm == ArmKind::None)
    return {};
  double joint[kMostJoints];
  const unsigned turns = turning();
  const int count = joints();
  for (int i = 0; i < count; ++i) {
    joint[i] = axes[i] - offset[i];
    if ((turns >> i & 1U) != 0)
      joint[i] *= kDegree;
  }
  Posture posture = tableOf(arm).postureOf(armMeasure, joint);
  if (hand != HandKind::None)
    posture.hand = tableOf(hand).postureOf(handMeasure, joint + tableOf(arm).joints);
  return posture;
}

Outcome AnyKinematics::inverse(const Frame<double> &tool, Posture posture, const double *reference,
                               double *axes) const {
  return inverseOf(*this, tool, posture, reference, axes);
}
Outcome AnyKinematics::inverse(const Frame<Jet<3>> &tool, Posture posture, const double *reference,
                               Jet<3> *axes) const {
  return inverseOf(*this, tool, posture, reference, axes);
}

double AnyKinematics::distanceFromSingular(const double *axes) const {
  if (arm == ArmKind::None)
    return 0;
  double joint[kMostJoints];
  for (int i = 0; i < joints(); ++i) {
    joint[i] = axes[i] - offset[i];
    if ((turning() >> i & 1U) != 0)
      joint[i] *= kDegree;
  }
  AnySquare own;
  if (ownJacobian(*this, joint, own) != Outcome::Done)
    return 0;
  const int place = task() == Task::Plane || task() == Task::PlaneTurn ? 2 : 3;
  own.topRows(place) /= reach();
  for (int i = 0; i < joints(); ++i)
    if ((turning() >> i & 1U) == 0)
      own.col(i) *= reach();
  const Eigen::JacobiSVD<AnySquare> svd(own);
  return svd.singularValues()(joints() - 1);
}

KinematicsRef AnyKinematics::ref() const noexcept { return {kTable, this}; }

Configuration configurationOf(Posture posture) noexcept {
  Configuration configuration{};
  configuration.bytes[0] = static_cast<uint8_t>(
      (posture.backwards ? 1U : 0U) | (posture.elbow ? 2U : 0U) | (posture.hand ? 4U : 0U));
  return configuration;
}

Posture postureOf(const Configuration &configuration) noexcept {
  const unsigned bits = configuration.bytes[0];
  return {.backwards = (bits & 1U) != 0, .elbow = (bits & 2U) != 0, .hand = (bits & 4U) != 0};
}

} // namespace stride::kinematics
