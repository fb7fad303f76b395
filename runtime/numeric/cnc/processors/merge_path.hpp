// Runs of short lines become fewer lines within a tolerance, from one queue into the next:
// SMC_SmoothMerge. Free of the C++ standard library: linked into every application.
// Source: SoftMotion 3, whose block makes polynomials of them.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_MERGE_PATH_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_MERGE_PATH_HPP

#include "runtime/numeric/cnc/chord_merge.hpp"
#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// The user sets the first members.
struct MergePath {
  static constexpr Generator kGenerator = kByNobody;
  static constexpr bool kLooksAhead = false;

  double tolerance;  ///< How far the path may be moved. [u] >= 0
  uint32_t features; ///< Which of PathObject::features have to be on; 0: all lines are merged.
  // Its own:
  Merger merger;
};

inline void start(MergePath &path) noexcept { path.merger.lines = 0; }
Step next(MergePath &path, const Source &source, Output &output) noexcept;
Step finish(MergePath &path, Ending ending, Output &output) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_MERGE_PATH_HPP
