#include "runtime/numeric/csy/trajectory.hpp"

#include "runtime/numeric/csy/trajectory_corners.hpp"

namespace stride::csy {

using exact::isfinite;
using exact::isPositive;
using exact::smaller;
using numeric::norm;

namespace {

constexpr double kCubicRatio = 2.0;
constexpr double kQuinticRatio = 1.0 / 0.66;
constexpr double kLeastForm = 0.5;
constexpr double kMostForm = 2.0;

bool isBlend(int16_t type) noexcept {
  return type == static_cast<int16_t>(SegmentType::CubicBlend) ||
         type == static_cast<int16_t>(SegmentType::QuinticBlend) ||
         type == static_cast<int16_t>(SegmentType::ArcBlend);
}

bool isArc(int16_t type) noexcept {
  return type == static_cast<int16_t>(SegmentType::ArcByRadius) ||
         type == static_cast<int16_t>(SegmentType::ArcByCentre);
}

/// KF is in percent; 0 stands for its default.
double formOf(int16_t percent) noexcept {
  if (percent == 0)
    return 1.0;
  const double form = percent / 100.0;
  return form < kLeastForm ? kLeastForm : smaller(form, kMostForm);
}

/// Makes the pieces one after the other.
class Builder {
public:
  Builder(const TrajectoryTable &table, Trajectory &trajectory) noexcept
      : table_(table), trajectory_(trajectory) {}

  Problem build() noexcept {
    start();
    for (uint32_t i = 0; i < table_.points; ++i)
      if (!isfinite(norm(table_.point[i].position)))
        return {PathError::EqualPoints, i};
    for (uint32_t i = 1; i < table_.points; ++i) {
      const PathError error = segment(i);
      if (error != PathError::None)
        return {error, i};
      trajectory_.endOfBlend[i] = trajectory_.length;
    }
    if (trajectory_.pieces == 0)
      return {PathError::NoPoints, 0};
    return {};
  }

private:
  void start() noexcept {
    const int16_t first = table_.point[0].type;
    const bool otherSide = first == static_cast<int16_t>(SegmentType::ToolOtherSide);
    trajectory_.hasTool =
        table_.axes == 3 && (otherSide || first == static_cast<int16_t>(SegmentType::Tool));
    toolOffset_ = otherSide ? 180.0 : 0.0;
    trajectory_.pieces = 0;
    trajectory_.points = table_.points;
    trajectory_.camPoints = 1;
    trajectory_.length = 0.0;
    trajectory_.endOfLine[0] = 0.0;
    trajectory_.endOfBlend[0] = 0.0;
  }

  /// A point of the path; the angle of a tool is not a place.
  [[nodiscard]] Vector3 placeOf(uint32_t index) const noexcept {
    Vector3 place = table_.point[index].position;
    if (trajectory_.hasTool)
      place.z = 0.0;
    return place;
  }

  PathError segment(uint32_t index) noexcept {
    const TablePoint &point = table_.point[index];
    if (isArc(point.type))
      return arc(index);
    if (isBlend(point.type))
      return blend(index);
    if (point.type != static_cast<int16_t>(SegmentType::Line))
      return PathError::UnknownType;
    const double length = norm(placeOf(index) - placeOf(index - 1));
    if (!isPositive(length))
      return PathError::EqualPoints;
    if (point.parW[0] < 1)
      return PathError::NoLinePoints;
    return line(index, placeOf(index));
  }

  /// From the end of the last piece; nothing if it would have no length.
  PathError line(uint32_t index, const Vector3 &end) noexcept {
    const Vector3 begin = beginOf(index);
    const double length = norm(end - begin);
    const double whole = norm(placeOf(index) - placeOf(index - 1));
    PathError error = PathError::None;
    if (length > 1e-12 * whole)
      error = push(index, {path::lineShape(begin, end), length}, table_.point[index].parW[0]);
    trajectory_.endOfLine[index] = trajectory_.length;
    return error;
  }

  PathError arc(uint32_t index) noexcept {
    const TablePoint &point = table_.point[index];
    if (table_.axes == 3 && !trajectory_.hasTool)
      return PathError::ArcWithThreeAxes;
    if (point.parW[0] < 1)
      return PathError::NoArcPoints;
    const bool clockwise = (point.parW[3] & 1) != 0;
    const bool byRadius = point.type == static_cast<int16_t>(SegmentType::ArcByRadius);
    Stretch stretch{};
    PathError error =
        byRadius
            ? arcByRadius(placeOf(index - 1), placeOf(index), point.parF[0], clockwise, stretch)
            : arcByCentre(placeOf(index - 1), placeOf(index), {point.parF[0], point.parF[1], 0.0},
                          clockwise, stretch);
    if (error == PathError::None)
      error = push(index, stretch, point.parW[0]);
    trajectory_.endOfLine[index] = trajectory_.length;
    return error;
  }

  PathError blend(uint32_t index) noexcept {
    const TablePoint &point = table_.point[index];
    if (const PathError error = blendNumbers(point); error != PathError::None)
      return error;
    Corner corner{};
    if (const PathError error = cornerAt(index, corner); error != PathError::None)
      return error;
    Stretch stretch{};
    if (point.type == static_cast<int16_t>(SegmentType::ArcBlend)) {
      const PathError error = arcBlend(corner, (point.parW[3] & 1) != 0, stretch);
      if (error != PathError::None)
        return error;
    } else {
      stretch = polynomialBlend(corner, formOf(point.parW[2]),
                                point.type == static_cast<int16_t>(SegmentType::QuinticBlend));
    }
    if (const PathError error = line(index, corner.at - corner.before * corner.first);
        error != PathError::None)
      return error;
    taken_ = corner.second;
    return push(index, stretch, point.parW[1]);
  }

  [[nodiscard]] PathError blendNumbers(const TablePoint &point) const noexcept {
    const bool isOfArc = point.type == static_cast<int16_t>(SegmentType::ArcBlend);
    if (isOfArc && table_.axes == 3 && !trajectory_.hasTool)
      return PathError::ArcWithThreeAxes;
    if (!isPositive(point.parF[0]) || (!isOfArc && !isPositive(point.parF[1])))
      return PathError::BlendLength;
    if (point.parW[0] < 1)
      return PathError::NoLinePoints;
    if (point.parW[1] < 1)
      return isOfArc ? PathError::NoBlendArcPoints
             : point.type == static_cast<int16_t>(SegmentType::CubicBlend)
                 ? PathError::NoCubicPoints
                 : PathError::NoQuinticPoints;
    return PathError::None;
  }

  /// Directions at a point, and how long its blend is.
  PathError cornerAt(uint32_t index, Corner &corner) const noexcept {
    const TablePoint &point = table_.point[index];
    corner.at = placeOf(index);
    const Vector3 before = corner.at - placeOf(index - 1);
    const double lengthBefore = norm(before);
    if (!isPositive(lengthBefore))
      return PathError::EqualPoints;
    if (index + 1 == table_.points)
      return PathError::BlendTooLong;
    const Vector3 after = placeOf(index + 1) - corner.at;
    const double lengthAfter = norm(after);
    if (!isPositive(lengthAfter))
      return PathError::NextSegmentZero;
    if (isArc(table_.point[index + 1].type))
      return PathError::BlendTooLong;
    corner.before = before * (1.0 / lengthBefore);
    corner.after = after * (1.0 / lengthAfter);
    const bool isOfArc = point.type == static_cast<int16_t>(SegmentType::ArcBlend);
    corner.first = smaller(point.parF[0], lengthBefore - takenBefore(index));
    corner.second = smaller(isOfArc ? point.parF[0] : point.parF[1], lengthAfter);
    if (!isPositive(corner.first))
      return PathError::BlendTooLong;
    const double ratio = isOfArc ? 1.0
                         : point.type == static_cast<int16_t>(SegmentType::CubicBlend)
                             ? kCubicRatio
                             : kQuinticRatio;
    corner.first = smaller(corner.first, ratio * corner.second);
    corner.second = smaller(corner.second, ratio * corner.first);
    return PathError::None;
  }

  /// What the blend at the point before has taken from this line.
  [[nodiscard]] double takenBefore(uint32_t index) const noexcept {
    return isBlend(table_.point[index - 1].type) && index > 1 ? taken_ : 0.0;
  }

  [[nodiscard]] Vector3 beginOf(uint32_t index) const noexcept {
    const Vector3 before = placeOf(index - 1);
    const double taken = takenBefore(index);
    if (taken == 0.0)
      return before;
    const Vector3 way = placeOf(index) - before;
    return before + way * (taken / norm(way));
  }

  PathError push(uint32_t index, const Stretch &stretch, int16_t samples) noexcept {
    trajectory_.camPoints += static_cast<uint32_t>(samples);
    if (trajectory_.camPoints > kMostCamPoints)
      return PathError::TooManyCamPoints;
    trajectory_.piece[trajectory_.pieces++] = {
        stretch.shape,  trajectory_.length,
        stretch.length, table_.point[index].position.z + toolOffset_,
        index,          static_cast<uint32_t>(samples)};
    trajectory_.length += stretch.length;
    return PathError::None;
  }

  const TrajectoryTable &table_;
  Trajectory &trajectory_;
  double toolOffset_ = 0.0; ///< [deg]
  double taken_ = 0.0;      ///< by the blend before, from the line that comes now [mm]
};

Vector3 placeOn(const Trajectory &trajectory, const Piece &piece, double part) noexcept {
  Vector3 place = path::overParameter(piece.shape, part).p;
  if (trajectory.hasTool)
    place.z = piece.angle;
  return place;
}

} // namespace

Problem computeTrajectory(const TrajectoryTable &table, Trajectory &trajectory) noexcept {
  return Builder(table, trajectory).build();
}

const Piece &pieceAt(const Trajectory &trajectory, double master) noexcept {
  uint32_t low = 0;
  uint32_t high = trajectory.pieces - 1;
  while (low < high) {
    const uint32_t middle = (low + high) / 2;
    const Piece &piece = trajectory.piece[middle];
    if (master <= piece.start + piece.length)
      high = middle;
    else
      low = middle + 1;
  }
  return trajectory.piece[low];
}

Vector3 positionAt(const Trajectory &trajectory, double master) noexcept {
  const Piece &piece = pieceAt(trajectory, master);
  const double part = (master - piece.start) / piece.length;
  return placeOn(trajectory, piece, part > 0.0 ? smaller(part, 1.0) : 0.0);
}

namespace {

/// Where the path begins, and where it ends.
Vector3 beginOf(const Trajectory &trajectory) noexcept {
  return placeOn(trajectory, trajectory.piece[0], 0.0);
}

Vector3 endOf(const Trajectory &trajectory) noexcept {
  return placeOn(trajectory, trajectory.piece[trajectory.pieces - 1], 1.0);
}

CamPoint wayBack(const Trajectory &trajectory, uint32_t sample) noexcept {
  const Vector3 end = endOf(trajectory);
  const Vector3 way = beginOf(trajectory) - end;
  const double part = static_cast<double>(sample) / kSpareCamPoints;
  if (sample == kSpareCamPoints)
    return {trajectory.length + norm(way), beginOf(trajectory)};
  return {trajectory.length + norm(way) * part, end + way * part};
}

} // namespace

bool isClosed(const Trajectory &trajectory) noexcept {
  constexpr double kSame = 1e-9;
  return norm(endOf(trajectory) - beginOf(trajectory)) <= kSame * trajectory.length;
}

uint32_t loopPoints(const Trajectory &trajectory) noexcept {
  return trajectory.camPoints + (isClosed(trajectory) ? 0 : kSpareCamPoints);
}

CamPoint nextCamPoint(const Trajectory &trajectory, CamCursor &cursor) noexcept {
  const uint32_t number = cursor.next++;
  if (number == 0)
    return {0.0, beginOf(trajectory)};
  if (number >= trajectory.camPoints)
    return wayBack(trajectory, number - trajectory.camPoints + 1);
  const Piece &piece = trajectory.piece[cursor.piece];
  const double part = static_cast<double>(++cursor.sample) / piece.samples;
  CamPoint point{piece.start + piece.length * part, placeOn(trajectory, piece, part)};
  if (cursor.sample == piece.samples) {
    cursor.sample = 0;
    ++cursor.piece;
  }
  if (number + 1 == trajectory.camPoints && isClosed(trajectory))
    point.slave = beginOf(trajectory); // to the last digit, as a loop wants it
  return point;
}

void fillCams(const Trajectory &trajectory, double *master, Vector3 *slaves) noexcept {
  CamCursor cursor{};
  for (uint32_t i = 0; i < trajectory.camPoints; ++i) {
    const CamPoint point = nextCamPoint(trajectory, cursor);
    master[i] = point.master;
    slaves[i] = point.slave;
  }
}

} // namespace stride::csy
