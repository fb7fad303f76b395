// Runs of lines become fewer lines within a tolerance: programs that CAM systems write approximate
// curves by points that are much closer together than anybody needs. Free of the C++ standard
// library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_CHORD_MERGE_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_CHORD_MERGE_HPP

#include "runtime/numeric/cnc/path_object.hpp"

namespace stride::cnc {

/// How many lines become one at most.
inline constexpr int32_t kMostMerged = 128;

/// Merges the lines of a path whose objects come one after the other. Trivially copyable; begins as
/// Merger{tolerance}.
///
/// A line stands for several if one can go along it and along these at the same time, never
/// backwards, without ever being further than the tolerance from each other: so every programmed
/// place is near the result, and the result is near the programmed path, in the same order. Each of
/// the axes besides X, Y, Z is at most the tolerance away, too, at the same time.
struct Merger {
  double tolerance;                 ///< >= 0 [u]
  PathObject run;                   ///< From the start of the first line to the end of the last.
  double place[kMostMerged][kAxes]; ///< Where the lines before the last one end.
  int32_t lines;                    ///< How many `run` is; 0: there is none.
};

/// Takes the next object; what is ready is put out, at most two. How many. Only lines in space that
/// agree in velocity, accelerations and everything else, without marks, switch points or probes,
/// are merged; all other objects end a run and stay as they are. A merged line has the numbers of
/// the first.
int32_t mergeNext(Merger &merger, const PathObject &object, PathObject (&ready)[2]) noexcept;

/// At the end of the path: puts out the last run. How many.
int32_t mergeEnd(Merger &merger, PathObject &ready) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_CHORD_MERGE_HPP
