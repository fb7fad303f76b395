// A leg: what a group drives for one command, without the corners at its ends. Either the tool goes
// along a line or a circle while it turns evenly about one axis, or while the axes that turn it
// (tool axes) go evenly; or all axes go evenly, together. Axes that go along do so evenly. Free of
// the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_LEG_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_LEG_HPP

#include "runtime/numeric/group/place.hpp"

namespace stride::group {

enum class LegKind : uint8_t {
  Line,   ///< The tool's point goes along a line.
  Circle, ///< It goes along a circle.
  Turn,   ///< It stays where it is.
  Axes    ///< The axes lead.
};

/// Trivially copyable; made by the functions below. The way along a leg is the length of the tool's
/// path [u]; of one that stays, the angle [°], or how far the tool axes go that are given (the root
/// of the sum of squares) [°], or how far the axis that goes along furthest goes [u]; where the
/// axes lead see axesLeg.
struct Leg {
  LegKind kind;
  uint8_t given;       ///< Tool axes that go evenly, as bits; 0: the tool itself turns evenly.
  double length;       ///< Of the way; 0: it goes nowhere.
  Vector3 start;       ///< Line, Turn: where it begins. Circle: the centre.
  Vector3 first;       ///< Line: over a unit of the way. Circle: to where it begins.
  Vector3 second;      ///< Circle: a quarter turn further than `first`.
  double radius;       ///< Circle. [u]
  double turn[9];      ///< Orientation at the start, by rows.
  Vector3 about;       ///< The axis that the tool turns about.
  double angle;        ///< How far over the leg. [rad]
  double from[kAxes];  ///< Axes at the start; the first kArmAxes only where they lead or are
                       ///< given. [u]
  double delta[kAxes]; ///< How far they go. [u]
};

inline bool leadsTool(const Leg &leg) noexcept { return leg.kind != LegKind::Axes; }

/// The axes that go along with the tool, at start and end. [u]
struct MoreAxes {
  double from[kMoreAxes];
  double to[kMoreAxes];
};

/// The tool goes straight from one pose to another and turns by the shortest way.
Leg lineLeg(const Pose &from, const Pose &to, const MoreAxes &more) noexcept;

/// A circle's arc: centre, and where it leads from the centre at first and a quarter turn later,
/// two vectors of the same length at a right angle; `sweep` > 0 [rad].
struct Arc {
  Vector3 centre, first, second;
  double sweep;
};

/// The tool goes along an arc, which begins at from.place, and turns to `to` by the shortest way.
Leg circleLeg(const Pose &from, const Arc &arc, const Pose &to, const MoreAxes &more) noexcept;

/// Lets tool axes (bits) of a leg that has been made go evenly from one place to another, instead
/// of the tool itself.
void giveToolAxes(Leg &leg, uint8_t given, const double (&from)[kAxes],
                  const double (&to)[kAxes]) noexcept;

/// The axes go evenly from one place to another. `perTime[k]` is the greatest velocity of axis k
/// [u/s]; the way is as long as the slowest axis needs at that, times `speed`.
Leg axesLeg(const double (&from)[kAxes], const double (&to)[kAxes], const double (&perTime)[kAxes],
            double speed) noexcept;

/// Where it is at a way, 0 <= way <= length, as a series of what `way` is one of.
void placeAt(const Leg &leg, const Series &way, PathPlace &place) noexcept;

/// The pose at its end, if the tool leads; of tool axes that are given it says nothing.
Pose endOf(const Leg &leg) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_LEG_HPP
