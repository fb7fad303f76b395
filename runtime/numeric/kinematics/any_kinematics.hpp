// One of the library's kinematics, chosen at run time: an arm, perhaps a hand, perhaps a tool; with
// the axes' zero positions and limits. It is plain data that may be copied byte by byte, so that a
// state can hold it. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_ANY_KINEMATICS_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_ANY_KINEMATICS_HPP

#include "runtime/numeric/kinematics/kinematics_ref.hpp"
#include "runtime/numeric/kinematics/tables.hpp"

namespace stride::kinematics {

/// Where an axis may stand. [u], [°]
struct JointRange {
  bool limited;
  double lower, upper;
};

struct AnyKinematics {
  ArmKind arm;   ///< None: it is not set
  HandKind hand; ///< None: the flange is the tool
  bool hasTool;
  double armMeasure[kMostArmMeasures]; ///< members of the arm's model in their order [u], [rad]
  double handMeasure[kMostHandMeasures];
  double offset[kMostJoints]; ///< where each axis stands when its joint is at zero [u], [°]
  JointRange range[kMostJoints];
  double toolPlace[3];   ///< the tool's point in the frame of the last joint [u]
  double toolTurn[3][3]; ///< its axes there, as columns; of use only if `hasTool`

  template <class Model> void setArm(ArmKind kind, const Model &model) noexcept {
    static_assert(kMeasuresOf<Model> <= kMostArmMeasures);
    arm = kind;
    if constexpr (kMeasuresOf < Model >> 0)
      __builtin_memcpy(armMeasure, &model, sizeof model);
  }
  template <class Model> void setHand(HandKind kind, const Model &model) noexcept {
    static_assert(kMeasuresOf<Model> <= kMostHandMeasures);
    hand = kind;
    if constexpr (kMeasuresOf < Model >> 0)
      __builtin_memcpy(handMeasure, &model, sizeof model);
  }
  void setTool(const Frame<double> &tool) noexcept;
  void clearTool() noexcept { hasTool = false; }

  [[nodiscard]] int joints() const;
  [[nodiscard]] unsigned turning() const;
  [[nodiscard]] Task task() const;
  [[nodiscard]] double reach() const;
  /// Done, WrongMeasures, WrongCoupling, WrongLimits or WrongTool.
  [[nodiscard]] Outcome check() const;

  /// As KinematicsRef has them.
  Outcome forward(const double *axes, Frame<double> &tool) const;
  Outcome forward(const Jet<3> *axes, Frame<Jet<3>> &tool) const;
  [[nodiscard]] Posture postureOf(const double *axes) const;
  Outcome inverse(const Frame<double> &tool, Posture posture, const double *reference,
                  double *axes) const;
  Outcome inverse(const Frame<Jet<3>> &tool, Posture posture, const double *reference,
                  Jet<3> *axes) const;
  [[nodiscard]] double distanceFromSingular(const double *axes) const;
  bool splits(unsigned &toolAxes) const;
  /// The posture of the placing axes, whose arm ends in the tool's point as it is held now.
  [[nodiscard]] Posture placingPostureOf(const double *axes) const;
  Outcome place(const Vector<double> &point, Posture posture, const double *reference,
                double *axes) const;
  Outcome place(const Vector<Jet<3>> &point, Posture posture, const double *reference,
                Jet<3> *axes) const;

  /// How it looks to a group. For the time of a call.
  [[nodiscard]] KinematicsRef ref() const noexcept;
};

/// What a configuration of the library's kinematics holds.
Configuration configurationOf(Posture posture) noexcept;
Posture postureOf(const Configuration &configuration) noexcept;

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_ANY_KINEMATICS_HPP
