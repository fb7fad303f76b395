// Curves at a distance from others, in a plane. Free of the C++ standard library: linked into every
// application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TRACK_OFFSET_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TRACK_OFFSET_HPP

#include "runtime/numeric/cnc/processors/plane_track.hpp"

namespace stride::cnc {

/// The line or the arc at a distance to the left; a negative distance is to the right. False if
/// nothing is left of an arc: it is bent to that side with no greater radius. [u]
bool offsetTrack(const Track &track, double left, Track &result) noexcept;

/// Where the curve at that distance begins and ends, whether there is one or not.
Vector3 offsetPlace(const Track &track, double left, bool atEnd) noexcept;

/// The curve at a distance to the left of an ellipse or a polynomial, piece by piece: a cubic from
/// the parameter `from` on, with the same places and directions at both ends, nowhere further than
/// `tolerance` from it. `step` is how far it goes at most. How far it does. [u] in
double offsetPiece(const Track &track, double left, double from, double step, double tolerance,
                   Track &piece) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TRACK_OFFSET_HPP
