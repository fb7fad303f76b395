// How joints move when the tool moves: Jacobians, how near a singular pose is, and the joints'
// velocity, acceleration and jerk along a path. Free of the C++ standard library: linked into every
// application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_MOTION_OF_JOINTS_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_MOTION_OF_JOINTS_HPP

#include "runtime/numeric/kinematics/model.hpp"

#include <Eigen/SVD>

namespace stride::kinematics {

/// Columns: what a unit of each joint's velocity does to the tool: velocity of its point [u] and
/// turn rate [rad], both in the base's axes.
template <class Model> using Jacobian = Eigen::Matrix<double, 6, Model::kJoints>;

/// How fast an orientation turns, in the base's axes: the skew part of R' R^T. [rad]
template <int kOrder> Vector<double> turnRateOf(const Matrix<Jet<kOrder>> &turn) {
  Vector<double> rate = Vector<double>::Zero();
  for (int row = 0; row < 3; ++row) {
    const int from = (row + 1) % 3;
    const int to = (row + 2) % 3;
    for (int k = 0; k < 3; ++k)
      rate(row) += turn(to, k).c[1] * turn(from, k).c[0];
  }
  return rate;
}

template <class Model>
Outcome jacobianOf(const Model &model, const double *joints, Jacobian<Model> &jacobian) {
  Jet<1> moving[Model::kJoints];
  for (int i = 0; i < Model::kJoints; ++i)
    moving[i] = Jet<1>(joints[i]);
  for (int i = 0; i < Model::kJoints; ++i) {
    moving[i].c[1] = 1;
    Frame<Jet<1>> pose;
    const Outcome outcome = model.forward(moving, pose);
    if (outcome != Outcome::Done)
      return outcome;
    moving[i].c[1] = 0;
    for (int row = 0; row < 3; ++row)
      jacobian(row, i) = pose.place(row).c[1];
    jacobian.template block<3, 1>(3, i) = turnRateOf(pose.turn);
  }
  return Outcome::Done;
}

/// How many rows a task has.
constexpr int rowsOf(Task task) noexcept {
  constexpr int kRows[] = {2, 3, 3, 4, 5, 6};
  return kRows[static_cast<int>(task)];
}

/// The rows of a Jacobian that the joints answer for. A direction is seen in the tool's axes.
template <class Model>
Eigen::Matrix<double, Model::kJoints, Model::kJoints> ownRows(const Jacobian<Model> &jacobian,
                                                              const Matrix<double> &turn) {
  static_assert(rowsOf(Model::kTask) == Model::kJoints);
  constexpr Task kTask = Model::kTask;
  Eigen::Matrix<double, Model::kJoints, Model::kJoints> own;
  constexpr int kPlace = kTask == Task::Plane || kTask == Task::PlaneTurn ? 2 : 3;
  for (int row = 0; row < kPlace; ++row)
    own.row(row) = jacobian.row(row);
  if constexpr (kTask == Task::PlaneTurn || kTask == Task::PlaceTurn)
    own.row(kPlace) = jacobian.row(5);
  if constexpr (kTask == Task::PlaceDirection)
    for (int row = 0; row < 2; ++row)
      own.row(3 + row) = turn.col(row).transpose() * jacobian.template bottomRows<3>();
  if constexpr (kTask == Task::Full)
    own.template bottomRows<3>() = jacobian.template bottomRows<3>();
  return own;
}

/// How far a pose is from a singular one: the smallest singular value of the Jacobian, whose
/// lengths are divided by the model's reach; 0 in a singular pose, without a unit.
template <class Model> double distanceFromSingular(const Model &model, const double *joints) {
  Jacobian<Model> jacobian;
  Frame<double> pose;
  if (model.forward(joints, pose) != Outcome::Done ||
      jacobianOf(model, joints, jacobian) != Outcome::Done)
    return 0;
  jacobian.template topRows<3>() /= model.reach();
  for (int i = 0; i < Model::kJoints; ++i)
    if ((Model::kTurning >> i & 1U) == 0)
      jacobian.col(i) *= model.reach();
  const Eigen::Matrix<double, Model::kJoints, Model::kJoints> own =
      ownRows<Model>(jacobian, pose.turn);
  const Eigen::JacobiSVD<Eigen::Matrix<double, Model::kJoints, Model::kJoints>> svd(own);
  return svd.singularValues()(Model::kJoints - 1);
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_MOTION_OF_JOINTS_HPP
