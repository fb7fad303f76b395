#include "compiler/assets/csy/path_source.hpp"

#include <algorithm>
#include <array>

namespace stc {

namespace {

using stride::csy::PathError;

struct Row {
  PathError error;
  CsyProblemText text;
};

constexpr std::array<Row, 21> kRows = {{
    {PathError::BlendLength,
     {"a blend has no length", "give `lracc1` above 0, and `lracc2` for types 1 and 2"}},
    {PathError::TooManyCamPoints,
     {"the path takes more than 4996 points of a cam", "make `NpLin` and `NpRacc` smaller"}},
    {PathError::EqualPoints,
     {"two points one after the other are the same", "leave one of them out"}},
    {PathError::ArcWithThreeAxes,
     {"arcs are for two axes", "use types 0, 1 and 2, or begin with type 100"}},
    {PathError::ArcOfHalfTurn,
     {"the path turns back, so that no arc fits", "use type 0 here, or another point"}},
    {PathError::ArcOfNoTurn, {"the path goes straight on, so that no arc fits", "use type 0 here"}},
    {PathError::TooManyPoints,
     {"the path has more points than the firmware takes", "60 with firmware 1.1, 200 with 1.2"}},
    {PathError::RadiusTooSmall,
     {"the radius is below half of the way between the points", "give a greater `R`"}},
    {PathError::NoCircle,
     {"the points do not give a circle", "type 11 needs two points; type 12 a centre beside them"}},
    {PathError::RadiusZero, {"the radius is 0", "give `R`"}},
    {PathError::BlendTooLong,
     {"nothing of a straight line is left for the blend",
      "a blend needs lines on both sides; make it, or the one before, shorter"}},
    {PathError::NoLinePoints, {"the line has no points", "give `NpLin` from 1 on"}},
    {PathError::NoCubicPoints, {"the cubic blend has no points", "give `NpRacc` from 1 on"}},
    {PathError::NoBlendArcPoints, {"the circular blend has no points", "give `NpRacc` from 1 on"}},
    {PathError::NoArcPoints, {"the arc has no points", "give `NpLin` from 1 on"}},
    {PathError::CentreOff,
     {"the centre is off by more than half of the radius", "give `Xc` and `Yc` as coordinates"}},
    {PathError::NoQuinticPoints, {"the quintic blend has no points", "give `NpRacc` from 1 on"}},
    {PathError::NoPoints, {"the path has no way", "give two points at least"}},
    {PathError::NextSegmentZero,
     {"the segment after the blend has no length", "leave one of its points out"}},
    {PathError::UnknownType,
     {"a type of segment that there is not", "types 100 and 101 are for the first point"}},
    {PathError::CamTooSmall, {"a cam has too few points", "give it 5 more than the path takes"}},
}};

} // namespace

CsyProblemText textOf(PathError error) {
  const auto *const row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row &one) { return one.error == error; });
  return row != kRows.end() ? row->text : CsyProblemText{"the path cannot be computed", ""};
}

} // namespace stc
