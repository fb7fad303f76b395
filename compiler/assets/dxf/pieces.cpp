#include "compiler/assets/dxf/pieces.hpp"

#include <algorithm>
#include <cmath>

namespace stc::dxf {

namespace {

/// Half axes that differ by less, as a part of them, are those of a circle.
constexpr double kCircle = 1e-9;
constexpr double kFull = 2 * M_PI - 1e-12;
/// Between places of appendPlaces(). [rad]
constexpr double kPlaceAngle = 0.1;

} // namespace

double norm(Point a) { return std::hypot(a.x, a.y); }

Point unit(Point a) {
  const double size = norm(a);
  return size > 0 ? a * (1 / size) : Point{};
}

Piece lineOf(Point start, Point end) {
  Piece piece;
  piece.start = start;
  piece.end = end;
  return piece;
}

Piece arcOf(Point centre, Point first, Point second, double from, double sweep) {
  Piece piece;
  piece.kind = Piece::Kind::Arc;
  piece.centre = centre;
  // Mirrored axes: the same places with the other angle.
  if (cross(first, second) < 0) {
    second = second * -1;
    from = -from;
    sweep = -sweep;
  }
  // The main axes are those at a turn of the parameter after which both are at right angles.
  const double a = dot(first, first);
  const double b = dot(second, second);
  const double both = dot(first, second);
  const bool circle =
      std::abs(a - b) <= 2 * kCircle * std::max(a, b) && std::abs(both) <= kCircle * std::max(a, b);
  if (!circle) {
    const double turn = std::atan2(2 * both, a - b) / 2;
    const Point main = first * std::cos(turn) + second * std::sin(turn);
    second = second * std::cos(turn) - first * std::sin(turn);
    first = main;
    from -= turn;
  }
  piece.first = first;
  // Exactly at right angles.
  const Point left = unit(Point{-first.y, first.x});
  piece.second = left * (circle ? norm(first) : norm(second));
  piece.from = from;
  piece.sweep = sweep;
  piece.start = placeAt(piece, 0);
  piece.end = isFull(piece) ? piece.start : placeAt(piece, 1);
  return piece;
}

Piece parabolaOf(Point start, Point control, Point end) {
  Piece piece;
  piece.kind = Piece::Kind::Parabola;
  piece.start = start;
  piece.centre = control;
  piece.end = end;
  return piece;
}

bool isFull(const Piece &piece) {
  return piece.kind == Piece::Kind::Arc && std::abs(piece.sweep) >= kFull;
}

bool isCircular(const Piece &piece) {
  return norm(piece.first) - norm(piece.second) <= kCircle * norm(piece.first);
}

Point placeAt(const Piece &piece, double part) {
  switch (piece.kind) {
  case Piece::Kind::Arc: {
    const double angle = piece.from + piece.sweep * part;
    return piece.centre + piece.first * std::cos(angle) + piece.second * std::sin(angle);
  }
  case Piece::Kind::Parabola:
    return piece.start * ((1 - part) * (1 - part)) + piece.centre * (2 * part * (1 - part)) +
           piece.end * (part * part);
  default:
    return piece.start * (1 - part) + piece.end * part;
  }
}

Point directionAt(const Piece &piece, double part) {
  switch (piece.kind) {
  case Piece::Kind::Arc: {
    const double angle = piece.from + piece.sweep * part;
    const Point way = piece.second * std::cos(angle) - piece.first * std::sin(angle);
    return unit(piece.sweep < 0 ? way * -1 : way);
  }
  case Piece::Kind::Parabola:
    return unit((piece.centre - piece.start) * (1 - part) + (piece.end - piece.centre) * part);
  default:
    return unit(piece.end - piece.start);
  }
}

double lengthOf(const Piece &piece) {
  if (piece.kind == Piece::Kind::Line)
    return norm(piece.end - piece.start);
  if (piece.kind == Piece::Kind::Arc && isCircular(piece))
    return norm(piece.first) * std::abs(piece.sweep);
  constexpr int kChords = 64;
  double sum = 0;
  Point before = placeAt(piece, 0);
  for (int i = 1; i <= kChords; ++i) {
    const Point now = placeAt(piece, static_cast<double>(i) / kChords);
    sum += norm(now - before);
    before = now;
  }
  return sum;
}

Piece reversed(const Piece &piece) {
  Piece result = piece;
  std::swap(result.start, result.end);
  result.from = piece.from + piece.sweep;
  result.sweep = -piece.sweep;
  return result;
}

Piece between(const Piece &piece, double from, double to) {
  Piece result = piece;
  result.from = piece.from + piece.sweep * from;
  result.sweep = piece.sweep * (to - from);
  if (from != 0)
    result.start = placeAt(piece, from);
  if (to != 1)
    result.end = placeAt(piece, to);
  return result;
}

void appendPlaces(const Piece &piece, std::vector<Point> &places) {
  int count = 1;
  if (piece.kind == Piece::Kind::Arc)
    count = std::max(2, static_cast<int>(std::ceil(std::abs(piece.sweep) / kPlaceAngle)));
  else if (piece.kind == Piece::Kind::Parabola)
    count = 16;
  places.push_back(piece.start);
  for (int i = 1; i < count; ++i)
    places.push_back(placeAt(piece, static_cast<double>(i) / count));
}

} // namespace stc::dxf
