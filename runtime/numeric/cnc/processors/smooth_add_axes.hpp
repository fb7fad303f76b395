// Axes besides X, Y and Z go smoothly over several objects, between G71 and G70: SMC_SmoothAddAxes.
// Free of the C++ standard library: linked into every application.
// Source: SoftMotion 3.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_SMOOTH_ADD_AXES_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_SMOOTH_ADD_AXES_HPP

#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// The user sets the first member.
///
/// In a range of objects (PathObject::smoothAxes) an axis goes from where it is at the start to
/// where it is at the end; what the objects in between say of it does not count. P to W go evenly
/// with the way in space. A, B and C go with a slope that rises evenly over the first half of
/// `part` of the way and falls over the last one; in each object by the cubic with these slopes.
///
/// Objects of an open range wait in the memory of the output, behind what others see of it.
struct SmoothAddAxes {
  static constexpr Generator kGenerator = kByNobody;
  static constexpr bool kLooksAhead = false;

  double part; ///< Of the way, that A, B and C are slower on. 0 to 1.
  // Its own:
  int32_t begin[kSmoothAxes]; ///< Of the open range of an axis, from the first object that waits
                              ///< on; -1: there is none.
  int32_t waiting;            ///< How many objects wait.
  uint32_t reserved;          ///< Queue::reserved while no objects wait, if `raised`.
  bool raised;                ///< Queue::reserved counts those that wait, too.
};

void start(SmoothAddAxes &smooth) noexcept;
Step next(SmoothAddAxes &smooth, const Source &source, Output &output) noexcept;
Step finish(SmoothAddAxes &smooth, Ending ending, Output &output) noexcept;

/// After each call of the stream: gives back the places of objects that waited when it was begun
/// anew or given up.
void settle(SmoothAddAxes &smooth, Queue *queue, bool runs) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_SMOOTH_ADD_AXES_HPP
