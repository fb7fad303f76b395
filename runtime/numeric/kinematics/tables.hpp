// Kinematics that are chosen at run time: of each arm and each hand a table of its functions. A
// table is found by a kind, which a state may hold (addresses of functions it may not: the next
// build has others). Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_TABLES_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_TABLES_HPP

#include "runtime/numeric/kinematics/model.hpp"

namespace stride::kinematics {

/// What places. Numbers are written into states: new ones come last.
enum class ArmKind : uint8_t {
  None,
  Gantry2,
  Gantry3,
  BeltPortal,
  Polar,
  PolarZ,
  Scara2,
  Scara2Z,
  Scara3,
  Scara3Z,
  ArmRrr,
  Palletiser,
  OffsetWristArm,
  FiveAxisTable,
  TripodLinear,
  TripodRotary,
  BipodRotary,
  Count
};

/// What turns the tool at the end of an arm.
enum class HandKind : uint8_t {
  None,
  TurningAxis, ///< one axis
  Wrist2,      ///< two axes
  Wrist3,      ///< three axes that meet in a point
  Count
};

inline constexpr int kMostArmMeasures = 6;
inline constexpr int kMostHandMeasures = 4;

template <class Scalar> struct ArmFunctions {
  Outcome (*forward)(const double *measures, const Scalar *joints, Frame<Scalar> &pose);
  Outcome (*inverse)(const double *measures, const Frame<Scalar> &pose, Posture posture,
                     const double *reference, Scalar *joints);
  /// What of an orientation is left for a hand.
  Matrix<Scalar> (*rest)(const double *measures, const Scalar *joints, const Matrix<Scalar> &turn);
  /// How far the flange has turned about z; nullptr: it is not all that it turns. [rad]
  Scalar (*heading)(const double *measures, const Scalar *joints);
};

/// The functions of one model; `measures` are the members of its structure in their order.
struct ArmTable {
  int measures;
  int joints;
  unsigned turning;
  Task task;
  bool keepsTurn; ///< the flange's axes are always those of the base
  bool upright;   ///< the flange's z axis is always that of the base
  double (*reach)(const double *measures);
  Posture (*postureOf)(const double *measures, const double *joints);
  ArmFunctions<double> numbers;
  ArmFunctions<Jet<3>> jets;
  Outcome (*rates)(const double *measures, const Jet<1> *joints, Frame<Jet<1>> &pose);
};

template <class Scalar> struct HandFunctions {
  Frame<Scalar> (*forward)(const double *measures, const Scalar *joints);
  void (*turnTo)(const double *measures, const Matrix<Scalar> &turn, Posture posture,
                 const double *reference, Scalar *joints);
  Matrix<Scalar> (*nearest)(const Matrix<Scalar> &turn);
};

struct HandTable {
  int measures;
  int joints;
  unsigned turning;
  bool aboutZ; ///< it turns the tool about the flange's z axis only
  Task (*together)(Task arm);
  Vector<double> (*offset)(const double *measures);
  bool (*postureOf)(const double *measures, const double *joints); ///< Posture::hand
  HandFunctions<double> numbers;
  HandFunctions<Jet<3>> jets;
  Frame<Jet<1>> (*rates)(const double *measures, const Jet<1> *joints);
};

/// Not for ArmKind::None.
const ArmTable &tableOf(ArmKind kind);
/// Not for HandKind::None.
const HandTable &tableOf(HandKind kind);

template <class Model> Model modelOf(const double *measures) noexcept {
  Model model{};
  if constexpr (!__is_empty(Model)) // an empty one has a byte all the same
    __builtin_memcpy(&model, measures, sizeof(Model));
  return model;
}

/// How many measures a model has.
template <class Model>
inline constexpr int kMeasuresOf = __is_empty(Model)
                                       ? 0
                                       : static_cast<int>(sizeof(Model) / sizeof(double));

/// The functions of a model for what comes after it.
template <class Model, class Scalar> constexpr void setRest(ArmFunctions<Scalar> &functions) {
  functions.rest = [](const double *measures, const Scalar *joints, const Matrix<Scalar> &turn) {
    return seenFromFlange(modelOf<Model>(measures), joints, turn);
  };
  if constexpr (kHasHeading<Model, Scalar>)
    functions.heading = [](const double *measures, const Scalar *joints) {
      return modelOf<Model>(measures).heading(joints);
    };
}

/// The functions of a model of arms. `kUpright`: see ArmTable.
template <class Model, bool kUpright> constexpr ArmTable makeArmTable() {
  static_assert(kMeasuresOf<Model> <= kMostArmMeasures && Model::kJoints <= kMostJoints);
  ArmTable table{};
  table.measures = kMeasuresOf<Model>;
  table.joints = Model::kJoints;
  table.turning = Model::kTurning;
  table.task = Model::kTask;
  table.keepsTurn = Model::kFlangeKeepsTurn;
  table.upright = kUpright;
  table.reach = [](const double *measures) { return modelOf<Model>(measures).reach(); };
  table.postureOf = [](const double *measures, const double *joints) {
    return modelOf<Model>(measures).postureOf(joints);
  };
  table.numbers.forward = [](const double *measures, const double *joints, Frame<double> &pose) {
    return modelOf<Model>(measures).forward(joints, pose);
  };
  table.numbers.inverse = [](const double *measures, const Frame<double> &pose, Posture posture,
                             const double *reference, double *joints) {
    return modelOf<Model>(measures).inverse(pose, posture, reference, joints);
  };
  setRest<Model>(table.numbers);
  setRest<Model>(table.jets);
  table.jets.forward = [](const double *measures, const Jet<3> *joints, Frame<Jet<3>> &pose) {
    return modelOf<Model>(measures).forward(joints, pose);
  };
  table.jets.inverse = [](const double *measures, const Frame<Jet<3>> &pose, Posture posture,
                          const double *reference, Jet<3> *joints) {
    return modelOf<Model>(measures).inverse(pose, posture, reference, joints);
  };
  table.rates = [](const double *measures, const Jet<1> *joints, Frame<Jet<1>> &pose) {
    return modelOf<Model>(measures).forward(joints, pose);
  };
  return table;
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_TABLES_HPP
