#include "runtime/cam/curve.hpp"

#include "runtime/axis/exact_math.hpp"

namespace stride::cam {
namespace {

template <class T> double numberAt(const void *data, int64_t index) noexcept {
  T value;
  __builtin_memcpy(&value, static_cast<const char *>(data) + index * int64_t{sizeof value},
                   sizeof value);
  return static_cast<double>(value);
}

double number(const Curve &curve, int64_t index) noexcept {
  switch (curve.element) {
  case Element::Int:
    return numberAt<int16_t>(curve.data, index);
  case Element::Uint:
    return numberAt<uint16_t>(curve.data, index);
  case Element::Dint:
    return numberAt<int32_t>(curve.data, index);
  case Element::Udint:
    return numberAt<uint32_t>(curve.data, index);
  case Element::Real:
    return numberAt<float>(curve.data, index);
  default:
    return numberAt<double>(curve.data, index);
  }
}

const Node &node(const Curve &curve, uint32_t index) noexcept {
  return static_cast<const Node *>(curve.data)[index];
}

const Segment &segment(const Curve &curve, uint32_t index) noexcept {
  return static_cast<const Segment *>(curve.data)[index];
}

/// The places of a table, numbered from 0 to count(); on a periodic one the pieces go on at both
/// ends.
class Table {
public:
  explicit Table(const Curve &curve) noexcept
      : curve_(curve), last_(curve.open ? curve.count : curve.count - 1),
        step_((curve.end - curve.start) / static_cast<double>(last_)) {}

  int64_t last() const noexcept { return last_; }
  double step() const noexcept { return step_; }

  double x(int64_t i) const noexcept {
    if (curve_.form == Form::PairTable)
      return curve_.master.of(number(curve_, 2 * i));
    return i == last_ ? curve_.end : curve_.start + static_cast<double>(i) * step_;
  }
  double y(int64_t i) const noexcept {
    if (curve_.form == Form::PairTable)
      return curve_.slave.of(number(curve_, 2 * i + 1));
    if (curve_.open && i == last_)
      return curve_.slave.of(number(curve_, 0)) + curve_.rise;
    return curve_.slave.of(number(curve_, i));
  }

private:
  const Curve &curve_;
  int64_t last_;
  double step_;
};

/// The greatest piece that begins at or before `x`, else the first; `begin(i)` ascends.
template <class Begin>
uint32_t pieceAt(double x, uint32_t pieces, uint32_t hint, Begin begin) noexcept {
  if (hint >= pieces)
    hint = pieces - 1;
  uint32_t low = 0; // begins at or before x, or is the first
  uint32_t high = pieces;
  if (begin(hint) <= x) {
    low = hint;
    if (hint + 1 == pieces || x < begin(hint + 1))
      return hint;
    low = hint + 1;
    if (hint + 2 == pieces || x < begin(hint + 2))
      return low;
  } else if (hint == 0) {
    return 0;
  } else {
    if (begin(hint - 1) <= x)
      return hint - 1;
    high = hint - 1;
  }
  while (high - low > 1) {
    const uint32_t middle = low + (high - low) / 2;
    (begin(middle) <= x ? low : high) = middle;
  }
  return low;
}

/// Length and slope of piece `i` of a table; beyond the ends those of the other end.
struct Secant {
  double length;
  double slope;
};

Secant secant(const Table &table, int64_t i) noexcept {
  if (i < 0)
    i += table.last();
  else if (i >= table.last())
    i -= table.last();
  const double length = table.x(i + 1) - table.x(i);
  return {length, (table.y(i + 1) - table.y(i)) / length};
}

/// The slope at place `i`: of the parabola through it and its neighbours.
double slopeAt(const Table &table, int64_t i, bool periodic) noexcept {
  if (table.last() == 1 && !periodic)
    return secant(table, 0).slope;
  if (!periodic && i == 0) {
    const Secant near = secant(table, 0);
    const Secant far = secant(table, 1);
    return near.slope + (near.slope - far.slope) * near.length / (near.length + far.length);
  }
  if (!periodic && i == table.last()) {
    const Secant near = secant(table, i - 1);
    const Secant far = secant(table, i - 2);
    return near.slope + (near.slope - far.slope) * near.length / (near.length + far.length);
  }
  const Secant left = secant(table, i - 1);
  const Secant right = secant(table, i);
  return (right.length * left.slope + left.length * right.slope) / (left.length + right.length);
}

/// A piece of a table: y0 + (m + (c2 + c3 * way) * way) * way.
struct TablePiece {
  double left;
  double length;
  double y0;
  double m;
  double c2;
  double c3;
};

TablePiece tablePiece(const Table &table, bool cubic, bool periodic, uint32_t index) noexcept {
  const double left = table.x(index);
  const double y0 = table.y(index);
  const double y1 = table.y(index + 1);
  const double length = table.x(index + 1) - left;
  const double slope = (y1 - y0) / length;
  if (!cubic)
    return {left, length, y0, slope, 0.0, 0.0};
  const double m0 = slopeAt(table, index, periodic);
  const double m1 = slopeAt(table, int64_t{index} + 1, periodic);
  const double c2 = (3.0 * slope - 2.0 * m0 - m1) / length;
  const double c3 = (m0 + m1 - 2.0 * slope) / (length * length);
  return {left, length, y0, m0, c2, c3};
}

Point evaluateTable(const Curve &curve, double x, bool periodic, uint32_t &index) noexcept {
  const Table table(curve);
  const auto pieces = static_cast<uint32_t>(table.last());
  if (curve.form == Form::EvenTable) {
    const double place = (x - curve.start) / table.step();
    uint32_t i = place > 0.0 ? (place < pieces ? static_cast<uint32_t>(place) : pieces - 1) : 0;
    // The quotient is rounded; the places decide.
    if (i > 0 && x < table.x(i))
      --i;
    else if (i + 1 < pieces && x >= table.x(i + 1))
      ++i;
    index = i;
  } else {
    index = pieceAt(x, pieces, index, [&](uint32_t i) { return table.x(i); });
  }
  const TablePiece piece = tablePiece(table, curve.cubic, periodic, index);
  const double way = x - piece.left;
  if (!curve.cubic)
    return {piece.y0 + piece.m * way, piece.m, 0.0, 0.0};
  return {piece.y0 + (piece.m + (piece.c2 + piece.c3 * way) * way) * way,
          piece.m + (2.0 * piece.c2 + 3.0 * piece.c3 * way) * way,
          2.0 * piece.c2 + 6.0 * piece.c3 * way, 6.0 * piece.c3};
}

bool isFiniteNode(const Node &node) noexcept {
  return exact::isfinite(node.x) && exact::isfinite(node.y) && exact::isfinite(node.v) &&
         exact::isfinite(node.a);
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

bool isScale(const Scale &scale) noexcept {
  return exact::isfinite(scale.zero) && exact::isfinite(scale.base) &&
         exact::isfinite(scale.factor) && scale.factor != 0.0;
}

CurveError checkTableForm(const Curve &curve) noexcept {
  const bool pairs = curve.form == Form::PairTable;
  if (sizeOf(curve.element) == 0 || curve.count < (curve.open && !pairs ? 1 : 2) ||
      !exact::isfinite(curve.rise))
    return CurveError::NoCurve;
  if (!isScale(curve.slave) || (pairs && !(isScale(curve.master) && curve.master.factor > 0.0)))
    return CurveError::Scaling;
  return CurveError::None;
}

bool isGoodTablePiece(const Curve &curve, uint32_t piece) noexcept {
  const Table table(curve);
  const double left = table.x(piece);
  const double right = table.x(int64_t{piece} + 1);
  return exact::isfinite(left) && exact::isfinite(right) && right > left &&
         exact::isfinite(right - left) && exact::isfinite(table.y(piece)) &&
         exact::isfinite(table.y(int64_t{piece} + 1));
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
    return curve.count >= 2 ? CurveError::None : CurveError::NoCurve;
  case Form::Segments:
    return curve.count >= 1 ? CurveError::None : CurveError::NoCurve;
  }
  return CurveError::NoCurve;
}

bool isGoodPiece(const Curve &curve, uint32_t piece) noexcept {
  switch (curve.form) {
  case Form::Nodes: {
    const Node &left = node(curve, piece);
    const Node &right = node(curve, piece + 1);
    return isFiniteNode(left) && isFiniteNode(right) && right.x > left.x &&
           exact::isfinite(right.x - left.x);
  }
  case Form::Segments:
    return isFiniteSegment(segment(curve, piece)) &&
           (piece == 0 || segment(curve, piece).start == segment(curve, piece - 1).end);
  default:
    return isGoodTablePiece(curve, piece);
  }
}

CurveError checkCurve(const Curve &curve) noexcept {
  if (const CurveError error = checkForm(curve); error != CurveError::None)
    return error;
  const uint32_t pieces = pieceCount(curve);
  for (uint32_t i = 0; i < pieces; ++i)
    if (!isGoodPiece(curve, i))
      return CurveError::NoCurve;
  return CurveError::None;
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
  const TablePiece part = tablePiece(Table(curve), curve.cubic, periodic, piece);
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
  return Table(curve).y(int64_t{piece} + 1);
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
  const auto count = static_cast<uint32_t>(curve.count);
  switch (curve.form) {
  case Form::Nodes:
    index = pieceAt(x, count - 1, index, [&](uint32_t i) { return node(curve, i).x; });
    return evaluateQuintic(node(curve, index), node(curve, index + 1), x);
  case Form::Segments:
    index = pieceAt(x, count, index, [&](uint32_t i) { return segment(curve, i).start; });
    return evaluateSegment(segment(curve, index), x);
  default:
    return evaluateTable(curve, x, periodic, index);
  }
}

double riseOf(const Curve &curve) noexcept {
  const auto last = static_cast<uint32_t>(curve.count - 1);
  switch (curve.form) {
  case Form::Nodes:
    return node(curve, last).y - node(curve, 0).y;
  case Form::Segments:
    return evaluateSegment(segment(curve, last), curve.end).y -
           evaluateSegment(segment(curve, 0), curve.start).y;
  default: {
    const Table table(curve);
    return table.y(table.last()) - table.y(0);
  }
  }
}

} // namespace stride::cam
