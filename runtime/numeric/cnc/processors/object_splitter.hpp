// Curves in several objects: SMC_ObjectSplitter, so that what limits whole objects limits parts of
// them. Free of the C++ standard library: linked into every application.
// Source: SoftMotion 3.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_OBJECT_SPLITTER_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_OBJECT_SPLITTER_HPP

#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// Into how many parts a curve is cut at most.
inline constexpr int32_t kMostParts = 10000;

/// The user sets the first members.
struct ObjectSplitter {
  static constexpr Generator kGenerator = kByNobody;
  static constexpr bool kLooksAhead = false;

  double parameter; ///< How many parts of equal length, or the greatest length of one [u]; > 0.
  bool byLength;
  // Its own:
  PathObject rest; ///< What is still to be put out.
  int32_t left;    ///< In how many parts.
};

inline void start(ObjectSplitter &splitter) noexcept { splitter.left = 0; }
Step next(ObjectSplitter &splitter, const Source &source, Output &output) noexcept;
inline Step finish(ObjectSplitter & /*splitter*/, Ending /*ending*/, Output & /*output*/) noexcept {
  return Step::Took;
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_OBJECT_SPLITTER_HPP
