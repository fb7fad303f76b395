#include "runtime/numeric/cam/bounds.hpp"

#include "runtime/numeric/cam/extremes.hpp"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cam {
namespace {

/// One part of a piece with its derivatives, ready to be looked at anywhere.
class Part {
public:
  Part(const Smooth &y, double length, const MasterLimits &limits, Bounds &bounds) noexcept
      : y_(y), v_(derivativeOf(y)), a_(derivativeOf(v_)), bounds_(bounds),
        perVelocity_(limits.velocity / length), perAcceleration_(limits.acceleration / length),
        perCurvature_(perVelocity_ * perVelocity_) {}

  /// What the inside of the part has.
  void includeInside() const noexcept {
    includeRoots(v_); // position
    includeRoots(a_); // slope
    const Smooth j = derivativeOf(a_);
    if (perAcceleration_ == 0.0) {
      includeRoots(j);
      return;
    }
    includeRoots(combined(j, perCurvature_, a_, perAcceleration_));
    includeRoots(combined(j, perCurvature_, a_, -perAcceleration_));
  }

  /// What an end of the part has, whose position is known.
  void includeEnd(double u, double y) const noexcept {
    bounds_.position.include(y);
    includeMotion(u);
  }

  double valueAt(double u) const noexcept { return valueOf(y_, u); }

private:
  void includeRoots(const Smooth &f) const noexcept {
    double roots[kMostRoots];
    const int count = rootsOf(f, roots);
    for (int i = 0; i < count; ++i)
      includeEnd(roots[i], valueOf(y_, roots[i]));
  }

  void includeMotion(double u) const noexcept {
    const double slope = exact::fabs(valueOf(v_, u));
    const double curvature = valueOf(a_, u) * perCurvature_;
    bounds_.velocity.include(slope * perVelocity_);
    bounds_.velocity.include(-slope * perVelocity_);
    bounds_.acceleration.include(exact::larger(curvature, 0.0) + slope * perAcceleration_);
    bounds_.acceleration.include(exact::smaller(curvature, 0.0) - slope * perAcceleration_);
  }

  const Smooth &y_;
  Smooth v_;
  Smooth a_;
  Bounds &bounds_;
  double perVelocity_;
  double perAcceleration_;
  double perCurvature_;
};

Range scaledRange(const Range &range, double factor) noexcept {
  const double low = range.low * factor + 0.0; // no -0
  const double high = range.high * factor + 0.0;
  return factor < 0.0 ? Range{high, low} : Range{low, high};
}

} // namespace

void includePiece(const Curve &curve, uint32_t piece, bool periodic, const MasterLimits &limits,
                  Bounds &bounds) noexcept {
  const Segment segment = pieceOf(curve, piece, periodic);
  const double length = segment.end - segment.start;
  Smooth parts[kMostParts];
  const int count = partsOf(segment, parts);
  for (int i = 0; i < count; ++i) {
    const Part part(parts[i], length, limits, bounds);
    const double low = parts[i].low;
    const double high = parts[i].high;
    part.includeEnd(low,
                    low == 0.0 ? evaluateSegment(segment, segment.start).y : part.valueAt(low));
    part.includeEnd(high, high == 1.0 ? endOfPiece(curve, piece) : part.valueAt(high));
    part.includeInside();
  }
}

void includePieces(const Curve &curve, uint32_t first, uint32_t count, const MasterLimits &limits,
                   Bounds &bounds) noexcept {
  const uint32_t pieces = pieceCount(curve);
  const bool table = curve.form == Form::EvenTable || curve.form == Form::PairTable;
  for (uint32_t i = first; i < pieces && i - first < count; ++i) {
    includePiece(curve, i, curve.open, limits, bounds);
    if (table && curve.cubic && !curve.open && (i == 0 || i + 1 == pieces))
      includePiece(curve, i, true, limits, bounds);
  }
}

Bounds boundsOf(const Curve &curve, const MasterLimits &limits) noexcept {
  Bounds bounds;
  includePieces(curve, 0, pieceCount(curve), limits, bounds);
  return bounds;
}

Bounds scaledBounds(const Bounds &bounds, double factor) noexcept {
  return {scaledRange(bounds.position, factor), scaledRange(bounds.velocity, factor),
          scaledRange(bounds.acceleration, factor)};
}

} // namespace stride::cam
