// Tables of hands, and of the table that swivels, which is a hand for the workpiece.
#include "runtime/numeric/kinematics/hands.hpp"
#include "runtime/numeric/kinematics/model_tables.hpp"

namespace stride::kinematics {

template <class Hand, class Scalar> constexpr HandFunctions<Scalar> makeHandFunctions() {
  HandFunctions<Scalar> functions{};
  functions.forward = [](const double *measures, const Scalar *joints) {
    return modelOf<Hand>(measures).template forward<Scalar>(joints);
  };
  functions.turnTo = [](const double *measures, const Matrix<Scalar> &turn, Posture posture,
                        const double *reference, Scalar *joints) {
    modelOf<Hand>(measures).turnTo(turn, posture, reference, joints);
  };
  functions.nearest = [](const Matrix<Scalar> &turn) { return Hand{}.nearest(turn); };
  return functions;
}

template <class Hand> constexpr HandTable makeHandTable() {
  static_assert(kMeasuresOf<Hand> <= kMostHandMeasures);
  HandTable table{};
  table.measures = kMeasuresOf<Hand>;
  table.joints = Hand::kJoints;
  table.turning = Hand::kTurning;
  table.aboutZ = requires { Hand::kTurnsAboutZ; };
  table.together = [](Task arm) { return Hand::together(arm); };
  table.offset = [](const double *measures) { return modelOf<Hand>(measures).offset(); };
  table.postureOf = [](const double *measures, const double *joints) {
    return modelOf<Hand>(measures).postureOf(joints).hand;
  };
  table.numbers = makeHandFunctions<Hand, double>();
  table.jets = makeHandFunctions<Hand, Jet<3>>();
  table.rates = [](const double *measures, const Jet<1> *joints) {
    return modelOf<Hand>(measures).forward(joints);
  };
  return table;
}

constexpr ArmTable kFiveAxisTableTable = makeArmTable<FiveAxisTable, false>();
constexpr HandTable kTurningAxisTable = makeHandTable<TurningAxis>();
constexpr HandTable kWrist2Table = makeHandTable<Wrist2>();
constexpr HandTable kWrist3Table = makeHandTable<Wrist3>();

} // namespace stride::kinematics
