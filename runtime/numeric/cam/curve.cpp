#include "runtime/numeric/cam/curve.hpp"

#include "runtime/numeric/cam/piece_search.hpp"
#include "runtime/numeric/cam/table.hpp"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cam {
namespace {

const Node &node(const Curve &curve, uint32_t index) noexcept {
  return static_cast<const Node *>(curve.data)[index];
}

const Segment &segment(const Curve &curve, uint32_t index) noexcept {
  return static_cast<const Segment *>(curve.data)[index];
}

bool isFiniteNode(const Node &node) noexcept {
  return exact::isfinite(node.x) && exact::isfinite(node.y) && exact::isfinite(node.v) &&
         exact::isfinite(node.a);
}

bool isGoodQuintic(const Node &left, const Node &right) noexcept {
  return isFiniteNode(left) && isFiniteNode(right) && right.x > left.x &&
         exact::isfinite(right.x - left.x);
}

bool isFiniteSegment(const Segment &segment) noexcept {
  bool good = exact::isfinite(segment.start) && segment.end > segment.start &&
              exact::isfinite(segment.end - segment.start) && exact::isfinite(segment.stroke) &&
              segment.lawBegin >= 0.0 && segment.lawBegin <= 1.0 && segment.lawEnd >= 0.0 &&
              segment.lawEnd <= 1.0 &&
              isUsable({segment.law, segment.parameter, segment.inflexion});
  for (const double coefficient : segment.coefficients)
    good = good && exact::isfinite(coefficient);
  return good;
}

/// Whether pieces from `first` to `last` are the ones of the curve, but for the last digits.
bool spans(const Curve &curve, double first, double last) noexcept {
  const double tolerance = 1e-9 * (curve.end - curve.start);
  return exact::fabs(first - curve.start) <= tolerance &&
         exact::fabs(last - curve.end) <= tolerance;
}

} // namespace

int32_t sizeOf(Element element) noexcept {
  switch (element) {
  case Element::Int:
  case Element::Uint:
    return 2;
  case Element::Dint:
  case Element::Udint:
  case Element::Real:
    return 4;
  case Element::Lreal:
    return 8;
  }
  return 0;
}

CurveError checkForm(const Curve &curve) noexcept {
  if (curve.data == nullptr || !exact::isfinite(curve.start) || !exact::isfinite(curve.end) ||
      !(curve.end > curve.start) || !exact::isfinite(curve.end - curve.start))
    return CurveError::NoCurve;
  switch (curve.form) {
  case Form::EvenTable:
  case Form::PairTable:
    return checkTableForm(curve);
  case Form::Nodes:
    if (curve.count >= 2 &&
        spans(curve, node(curve, 0).x, node(curve, static_cast<uint32_t>(curve.count - 1)).x))
      return CurveError::None;
    break;
  case Form::Segments:
    if (curve.count >= 1 && spans(curve, segment(curve, 0).start,
                                  segment(curve, static_cast<uint32_t>(curve.count - 1)).end))
      return CurveError::None;
    break;
  }
  return CurveError::NoCurve;
}

bool areGoodPieces(const Curve &curve, uint32_t first, uint32_t end) noexcept {
  if (curve.form != Form::Nodes && curve.form != Form::Segments)
    return areGoodTablePieces(curve, first, end);
  for (uint32_t i = first; i < end; ++i)
    if (!(curve.form == Form::Nodes
              ? isGoodQuintic(node(curve, i), node(curve, i + 1))
              : isFiniteSegment(segment(curve, i)) &&
                    (i == 0 || segment(curve, i).start == segment(curve, i - 1).end)))
      return false;
  return true;
}

CurveError checkCurve(const Curve &curve) noexcept {
  if (const CurveError error = checkForm(curve); error != CurveError::None)
    return error;
  return areGoodPieces(curve, 0, pieceCount(curve)) ? CurveError::None : CurveError::NoCurve;
}

uint32_t pieceCount(const Curve &curve) noexcept {
  const auto count = static_cast<uint32_t>(curve.count);
  const bool whole = curve.form == Form::Segments || (curve.form == Form::EvenTable && curve.open);
  return whole ? count : count - 1;
}

Segment pieceOf(const Curve &curve, uint32_t piece, bool periodic) noexcept {
  if (curve.form == Form::Segments)
    return segment(curve, piece);
  if (curve.form == Form::Nodes)
    return makeSegment({}, node(curve, piece), node(curve, piece + 1));
  const TablePiece part = tablePiece(curve, periodic, piece);
  const double h = part.length;
  return {part.left,
          part.left + h,
          {part.y0, part.m * h, part.c2 * h * h, part.c3 * h * h * h, 0.0, 0.0, 0.0, 0.0},
          0.0,
          0.0,
          1.0,
          0.0,
          0.5,
          Law::Polynomial};
}

double endOfPiece(const Curve &curve, uint32_t piece) noexcept {
  if (curve.form == Form::Segments)
    return evaluateSegment(segment(curve, piece), segment(curve, piece).end).y;
  if (curve.form == Form::Nodes)
    return node(curve, piece + 1).y;
  return endOfTablePiece(curve, piece);
}

Point evaluateQuintic(const Node &left, const Node &right, double x) noexcept {
  const double h = right.x - left.x;
  const double perWay = 1.0 / h;
  const double u = (x - left.x) / h;
  const double v0 = left.v * h;
  const double v1 = right.v * h;
  const double a0 = left.a * h * h;
  const double a1 = right.a * h * h;
  const double d = right.y - left.y;
  const double c2 = 0.5 * a0;
  const double c3 = 10.0 * d - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1;
  const double c4 = -15.0 * d + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1;
  const double c5 = 6.0 * d - 3.0 * v0 - 3.0 * v1 - 0.5 * a0 + 0.5 * a1;
  const double y = left.y + (v0 + (c2 + (c3 + (c4 + c5 * u) * u) * u) * u) * u;
  const double v = v0 + (2.0 * c2 + (3.0 * c3 + (4.0 * c4 + 5.0 * c5 * u) * u) * u) * u;
  const double a = 2.0 * c2 + (6.0 * c3 + (12.0 * c4 + 20.0 * c5 * u) * u) * u;
  const double j = 6.0 * c3 + (24.0 * c4 + 60.0 * c5 * u) * u;
  return {y, v * perWay, a * perWay * perWay, j * perWay * perWay * perWay};
}

Segment makeSegment(const LawShape &shape, const Node &left, const Node &right) noexcept {
  const double h = right.x - left.x;
  const double d = right.y - left.y;
  const double v0 = left.v * h;
  const double v1 = right.v * h;
  const bool harmonic = shape.law == Law::Harmonic;
  const double a0 = harmonic ? 0.0 : left.a * h * h;
  const double a1 = harmonic ? 0.0 : right.a * h * h;
  Segment out{left.x,
              right.x,
              {left.y, v0, 0.5 * a0, 0.0, 0.0, 0.0, 0.0, 0.0},
              0.0,
              0.0,
              1.0,
              shape.parameter,
              shape.inflexion,
              shape.law};
  if (shape.law == Law::Polynomial) {
    out.coefficients[3] = 10.0 * d - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1;
    out.coefficients[4] = -15.0 * d + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1;
    out.coefficients[5] = 6.0 * d - 3.0 * v0 - 3.0 * v1 - 0.5 * a0 + 0.5 * a1;
    return out;
  }
  // The velocity goes over in a cubic; the law does what is left of the way.
  out.coefficients[3] = (3.0 * (v1 - v0) - 2.0 * a0 - a1) / 3.0;
  out.coefficients[4] = 0.25 * (a0 + a1 - 2.0 * (v1 - v0));
  out.stroke = d - (0.5 * (v0 + v1) + (a0 - a1) / 12.0);
  return out;
}

Point evaluateSegment(const Segment &segment, double x) noexcept {
  const double h = segment.end - segment.start;
  const double u = (x - segment.start) / h;
  const double *c = segment.coefficients;
  double y = c[7];
  double v = 0.0;
  double a = 0.0;
  double j = 0.0;
  for (int i = 6; i >= 0; --i) { // Horner, with the derivatives (divided by 2 and 6)
    j = j * u + a;
    a = a * u + v;
    v = v * u + y;
    y = y * u + c[i];
  }
  a *= 2.0;
  j *= 6.0;
  if (segment.law != Law::Polynomial) {
    const double extent = segment.lawEnd - segment.lawBegin;
    const Point law = evaluateLaw({segment.law, segment.parameter, segment.inflexion},
                                  segment.lawBegin + extent * u);
    const double stroke = segment.stroke;
    y += stroke * law.y;
    v += stroke * extent * law.v;
    a += stroke * extent * extent * law.a;
    j += stroke * extent * extent * extent * law.j;
  }
  return {y, v / h, a / (h * h), j / (h * h * h)};
}

Point evaluateCurve(const Curve &curve, double x, bool periodic, uint32_t &index) noexcept {
  if (curve.form != Form::Nodes && curve.form != Form::Segments)
    return evaluateTable(curve, x, periodic, index);
  const uint32_t pieces = pieceCount(curve);
  const double length = (curve.end - curve.start) / pieces;
  if (curve.form == Form::Nodes) {
    index = pieceAt(x, pieces, index, length, [&](uint32_t i) { return node(curve, i).x; });
    return evaluateQuintic(node(curve, index), node(curve, index + 1), x);
  }
  index = pieceAt(x, pieces, index, length, [&](uint32_t i) { return segment(curve, i).start; });
  return evaluateSegment(segment(curve, index), x);
}

double riseOf(const Curve &curve) noexcept {
  const auto last = static_cast<uint32_t>(curve.count - 1);
  switch (curve.form) {
  case Form::Nodes:
    return node(curve, last).y - node(curve, 0).y;
  case Form::Segments:
    return evaluateSegment(segment(curve, last), curve.end).y -
           evaluateSegment(segment(curve, 0), curve.start).y;
  default:
    return riseOfTable(curve);
  }
}

} // namespace stride::cam
