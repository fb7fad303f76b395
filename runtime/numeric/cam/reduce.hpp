// Cams with fewer places, and tables of cams. For tools: allocates; not part of applications.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_REDUCE_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_REDUCE_HPP

#include "runtime/numeric/cam/curve.hpp"

#include <span>
#include <vector>

namespace stride::cam {

struct XY {
  double x; ///< [master u]
  double y; ///< [slave u]
};

/// Some of the points, so few that straight lines between them still pass all others within
/// `tolerance` >= 0 in y [slave u]; the two lines then differ nowhere by more. The first and the
/// last are kept. x must ascend. The fewest that do so, as long as no line bridges more than 2048
/// points; longer bridges are not looked for. Source: H. Imai, M. Iri, Computational-geometric
/// methods for polygonal approximations of a curve, 1986, for subsets of the points and distances
/// in y.
std::vector<XY> reducePoints(std::span<const XY> points, double tolerance);

/// Places with velocity and acceleration, between which quintics stay within `tolerance` > 0 of the
/// curve [slave u] at every master position: the difference is bounded by its extremes, not by
/// samples. Start and end are kept, and every place lies on the curve; where velocity or
/// acceleration jump, the place has their mean. Each quintic reaches as far as doubling and halving
/// finds. Empty if the curve's position jumps by more than the tolerance, or more than `most`
/// places would be necessary. `periodic` as for evaluateCurve.
std::vector<Node> reduceCurve(const Curve &curve, bool periodic, double tolerance,
                              size_t most = 32767);

/// The slave positions of an even table with `count` places: at least 2, or 1 if `open`, which
/// leaves out the last one (manual, section 4.4.3).
std::vector<double> sampleEven(const Curve &curve, bool periodic, int count, bool open);

/// How many places the least table of sampleElements has.
int leastElements(const Curve &curve);

/// The pairs of a table with `count` places, element-optimised (manual, section 4.4.3): lines, that
/// is pieces of constant velocity, get a place at either end and no more, the others are shared out
/// over the rest as evenly as possible. A curve of nothing but lines shares them out over the
/// lines. Empty if count < leastElements(curve).
std::vector<XY> sampleElements(const Curve &curve, bool periodic, int count);

} // namespace stride::cam

#endif
