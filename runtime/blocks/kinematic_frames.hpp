// Frames and matrices of ST as those of the kinematics, and back.
#ifndef STRIDE_RUNTIME_BLOCKS_KINEMATIC_FRAMES_HPP
#define STRIDE_RUNTIME_BLOCKS_KINEMATIC_FRAMES_HPP

#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Math/SMC_Frame.h"
#include "st/SM3_Robotics/MC_COORD_REF.h"

namespace stride::kinematics {

inline Matrix<double> fromSt(const ::st::SM3_Math::SMC_Matrix3 &st) {
  Matrix<double> matrix;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      matrix(row, column) = st.m.v[row].v[column];
  return matrix;
}

inline void toSt(const Matrix<double> &matrix, ::st::SM3_Math::SMC_Matrix3 &st) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      st.m.v[row].v[column] = matrix(row, column);
}

inline Frame<double> fromSt(const ::st::SM3_Math::SMC_Frame &st) {
  return {fromSt(st.mR), {st.vT.dX, st.vT.dY, st.vT.dZ}};
}

inline void toSt(const Frame<double> &frame, ::st::SM3_Math::SMC_Frame &st) {
  toSt(frame.turn, st.mR);
  st.vT.dX = frame.place(0);
  st.vT.dY = frame.place(1);
  st.vT.dZ = frame.place(2);
}

inline Frame<double> fromSt(const ::st::SM3_Robotics::MC_COORD_REF &st) {
  return {turnFrom(Convention::Zyz, {st.A, st.B, st.C}), {st.X, st.Y, st.Z}};
}

inline void toSt(const Frame<double> &frame, ::st::SM3_Robotics::MC_COORD_REF &st) {
  const Angles angles = anglesOf(Convention::Zyz, frame.turn);
  st.X = frame.place(0);
  st.Y = frame.place(1);
  st.Z = frame.place(2);
  st.A = angles.a;
  st.B = angles.b;
  st.C = angles.c;
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_BLOCKS_KINEMATIC_FRAMES_HPP
