// Whether a path leaves a box: SMC_CheckForLimits. Free of the C++ standard library: linked into
// every application.
// Source: SoftMotion 3.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_LIMIT_CHECK_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_LIMIT_CHECK_HPP

#include "runtime/numeric/cnc/queue.hpp"

namespace stride::cnc {

/// Where a path may be, and how closely that is looked at.
struct PlaceLimits {
  const Position *least;
  const Position *most;
  uint16_t axes;      ///< Which ones count, by AxisBit.
  double distance;    ///< Between places of an object that are looked at; 0: kBoxDistance. [u] >= 0
  int32_t fewest;     ///< Places besides the ends of an object, at least.
  int32_t mostPlaces; ///< At most; negative: kMostBoxPlaces.
};

inline constexpr double kBoxDistance = 10.0; ///< [u]
inline constexpr int32_t kMostBoxPlaces = 10000;

/// What has been found so far.
struct BoxFinding {
  uint16_t axes; ///< Which ones have left the box.
  int32_t line;  ///< PathObject::sourceLine of the first object that does.
};

enum class BoxError : uint8_t {
  None,
  NoQueue, ///< No usable queue.
  Object,  ///< One without a shape.
};

/// Looks at the objects that are in the queue since its writePosition was `checked`, which is then
/// set anew. Lines are looked at where they begin and end. A box without numbers is left
/// everywhere.
BoxError checkBox(const Queue *queue, uint32_t &checked, const PlaceLimits &box,
                  BoxFinding &finding) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_LIMIT_CHECK_HPP
