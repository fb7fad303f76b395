// A corner: the smooth way from one leg to the next. It leaves the first leg a cut before its end
// and meets the second one a cut after its start, with the same velocity and the same acceleration
// (whatever the law over the way), so that the group need not rest there. Free of the C++ standard
// library: linked into every application.
//
// Along a corner runs a parameter u from 0 to 1. Tool's point, and axes where they lead, are
// polynomials of degree 5 in u. What turns or goes along evenly on both legs is left by
// a(u), from -cut to 0, and taken up by b(u), from 0 to the other cut: both of degree 5, and at
// rest where they are 0. Where the tool's point goes on both legs, the way is the length of its
// path, so that what the command says of it counts. Else there is no such length: u over the way is
// of degree 4, and u'(way) changes smoothly from what the first leg needs to what the second one
// does.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_CORNER_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_CORNER_HPP

#include "runtime/numeric/group/leg.hpp"
#include "runtime/numeric/path/way_table.hpp"

namespace stride::group {

/// A polynomial of degree 5: the sum of c[k] * u^k. Trivially copyable.
struct Quintic {
  double c[6];
};

/// Turning about a fixed axis, by an angle per unit of a leg's way.
struct Spin {
  Vector3 about;
  double rate; ///< [rad/u]
};

/// Trivially copyable; made by the functions below.
struct Corner {
  bool byTool;         ///< The tool leads; else the axes.
  uint8_t given;       ///< If byTool: tool axes that are given by `axes`, as bits.
  bool byLength;       ///< The way is the length of its point's path.
  double length;       ///< Of the way along it.
  double first, last;  ///< u over the way at its start and at its end. [1/u]
  path::Shape place;   ///< Tool's point.
  path::WayTable ways; ///< Of that, if byLength.
  double turn[9];      ///< Orientation in the corner itself, by rows.
  Spin before, after;  ///< How the tool turns on the legs.
  Quintic leaves;      ///< a: way before the corner on the first leg.
  Quintic enters;      ///< b: way after the corner on the second leg.
  Quintic axes[kAxes]; ///< The first kArmAxes only where they lead or are given. [u]
};

/// Between two legs on which the tool leads, with the same tool axes given, or none; 0 < cuts <=
/// lengths. What the legs are beyond the corner is not looked at. [u]
Corner toolCorner(const Leg &before, double cutBefore, const Leg &after, double cutAfter) noexcept;

/// The axes at one end of a corner where they lead: series over the way of the leg there.
struct AxesEnd {
  Series axes[kAxes];
  double cut; ///< The way from there to the corner, > 0.
};

/// Between two legs at least one of which is led by the axes.
Corner axesCorner(const AxesEnd &before, const AxesEnd &after) noexcept;

/// Where it is at a way, 0 <= way <= length.
void placeAt(const Corner &corner, const Series &way, PathPlace &place) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_CORNER_HPP
