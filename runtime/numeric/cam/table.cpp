#include "runtime/numeric/cam/table.hpp"

#include "runtime/numeric/cam/piece_search.hpp"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cam {
namespace {

template <class T> double numberAt(const void *data, int64_t index) noexcept {
  T value;
  __builtin_memcpy(&value, static_cast<const char *>(data) + index * int64_t{sizeof value},
                   sizeof value);
  return static_cast<double>(value);
}

/// The places of an even table, numbered from 0 to last().
template <class T> class EvenPlaces {
public:
  explicit EvenPlaces(const Curve &curve) noexcept
      : curve_(curve), last_(curve.open ? curve.count : curve.count - 1),
        step_((curve.end - curve.start) / static_cast<double>(last_)) {}

  int64_t last() const noexcept { return last_; }
  double x(int64_t i) const noexcept {
    return i == last_ ? curve_.end : curve_.start + static_cast<double>(i) * step_;
  }
  double y(int64_t i) const noexcept {
    if (i == curve_.count)
      return curve_.slave.of(numberAt<T>(curve_.data, 0)) + curve_.rise;
    return curve_.slave.of(numberAt<T>(curve_.data, i));
  }

  uint32_t pieceAt(double x, uint32_t /*hint*/) const noexcept {
    const double place =
        (x - curve_.start) * (static_cast<double>(last_) / (curve_.end - curve_.start));
    const auto pieces = static_cast<uint32_t>(last_);
    const uint32_t i =
        place > 0.0 ? (place < pieces ? static_cast<uint32_t>(place) : pieces - 1) : 0;
    // The quotient is rounded; the places decide.
    if (i > 0 && x < this->x(i))
      return i - 1;
    return i + 1 < pieces && x >= this->x(int64_t{i} + 1) ? i + 1 : i;
  }

private:
  const Curve &curve_;
  int64_t last_;
  double step_;
};

/// The places of a table of pairs.
template <class T> class PairPlaces {
public:
  explicit PairPlaces(const Curve &curve) noexcept : curve_(curve) {}

  int64_t last() const noexcept { return curve_.count - 1; }
  double x(int64_t i) const noexcept { return curve_.master.of(numberAt<T>(curve_.data, 2 * i)); }
  double y(int64_t i) const noexcept {
    return curve_.slave.of(numberAt<T>(curve_.data, 2 * i + 1));
  }

  uint32_t pieceAt(double x, uint32_t hint) const noexcept {
    return cam::pieceAt(x, static_cast<uint32_t>(last()), hint,
                        (curve_.end - curve_.start) / static_cast<double>(last()),
                        [this](uint32_t i) { return this->x(i); });
  }

private:
  const Curve &curve_;
};

/// Calls `visitor` with the places of a table.
template <template <class> class Places, class Visitor>
auto visitNumbers(const Curve &table, const Visitor &visitor) noexcept {
  switch (table.element) {
  case Element::Int:
    return visitor(Places<int16_t>(table));
  case Element::Uint:
    return visitor(Places<uint16_t>(table));
  case Element::Dint:
    return visitor(Places<int32_t>(table));
  case Element::Udint:
    return visitor(Places<uint32_t>(table));
  case Element::Real:
    return visitor(Places<float>(table));
  default:
    return visitor(Places<double>(table));
  }
}

template <class Visitor> auto visitPlaces(const Curve &table, const Visitor &visitor) noexcept {
  return table.form == Form::PairTable ? visitNumbers<PairPlaces>(table, visitor)
                                       : visitNumbers<EvenPlaces>(table, visitor);
}

/// Length and slope of a piece.
struct Secant {
  double length;
  double slope;
};

/// Those of piece `i`; beyond the ends those of the other end.
template <class Places> Secant secant(const Places &places, int64_t i) noexcept {
  if (i < 0)
    i += places.last();
  else if (i >= places.last())
    i -= places.last();
  const double length = places.x(i + 1) - places.x(i);
  return {length, (places.y(i + 1) - places.y(i)) / length};
}

/// The slope between two pieces: of the parabola through the three places.
double slopeBetween(const Secant &left, const Secant &right) noexcept {
  return (right.length * left.slope + left.length * right.slope) / (left.length + right.length);
}

/// The slope of that parabola at its other end.
double slopeAtEnd(const Secant &near, const Secant &far) noexcept {
  return near.slope + (near.slope - far.slope) * near.length / (near.length + far.length);
}

template <class Places>
TablePiece pieceOfPlaces(const Places &places, bool cubic, bool periodic, uint32_t index) noexcept {
  const double left = places.x(index);
  const double y0 = places.y(index);
  const double length = places.x(int64_t{index} + 1) - left;
  const double slope = (places.y(int64_t{index} + 1) - y0) / length;
  if (!cubic)
    return {left, length, y0, slope, 0.0, 0.0};
  const Secant here{length, slope};
  const bool first = !periodic && index == 0;
  const bool last = !periodic && index + 1 == places.last();
  double m0 = slope;
  double m1 = slope;
  if (!first) {
    const Secant before = secant(places, int64_t{index} - 1);
    m0 = slopeBetween(before, here);
    if (last)
      m1 = slopeAtEnd(here, before);
  }
  if (!last) {
    const Secant behind = secant(places, int64_t{index} + 1);
    m1 = slopeBetween(here, behind);
    if (first)
      m0 = slopeAtEnd(here, behind);
  }
  return {left,
          length,
          y0,
          m0,
          (3.0 * slope - 2.0 * m0 - m1) / length,
          (m0 + m1 - 2.0 * slope) / (length * length)};
}

bool isScale(const Scale &scale) noexcept {
  return exact::isfinite(scale.zero) && exact::isfinite(scale.base) &&
         exact::isfinite(scale.factor) && scale.factor != 0.0;
}

} // namespace

TablePiece tablePiece(const Curve &table, bool periodic, uint32_t index) noexcept {
  return visitPlaces(table, [&](const auto &places) {
    return pieceOfPlaces(places, table.cubic, periodic, index);
  });
}

Point evaluateTable(const Curve &table, double x, bool periodic, uint32_t &index) noexcept {
  return visitPlaces(table, [&](const auto &places) -> Point {
    index = places.pieceAt(x, index);
    const TablePiece piece = pieceOfPlaces(places, table.cubic, periodic, index);
    const double way = x - piece.left;
    if (!table.cubic)
      return {piece.y0 + piece.m * way, piece.m, 0.0, 0.0};
    return {piece.y0 + (piece.m + (piece.c2 + piece.c3 * way) * way) * way,
            piece.m + (2.0 * piece.c2 + 3.0 * piece.c3 * way) * way,
            2.0 * piece.c2 + 6.0 * piece.c3 * way, 6.0 * piece.c3};
  });
}

double endOfTablePiece(const Curve &table, uint32_t index) noexcept {
  return visitPlaces(table, [&](const auto &places) { return places.y(int64_t{index} + 1); });
}

double riseOfTable(const Curve &table) noexcept {
  return visitPlaces(table,
                     [](const auto &places) { return places.y(places.last()) - places.y(0); });
}

CurveError checkTableForm(const Curve &table) noexcept {
  const bool pairs = table.form == Form::PairTable;
  if (sizeOf(table.element) == 0 || table.count < (table.open && !pairs ? 1 : 2) ||
      !exact::isfinite(table.rise))
    return CurveError::NoCurve;
  if (!isScale(table.slave) || (pairs && !(isScale(table.master) && table.master.factor > 0.0)))
    return CurveError::Scaling;
  return CurveError::None;
}

bool areGoodTablePieces(const Curve &table, uint32_t first, uint32_t end) noexcept {
  return visitPlaces(table, [&](const auto &places) {
    double left = places.x(first);
    bool good = exact::isfinite(left) && exact::isfinite(places.y(first));
    for (uint32_t i = first; i < end && good; ++i) {
      const double right = places.x(int64_t{i} + 1);
      good = right > left && exact::isfinite(right - left) &&
             exact::isfinite(places.y(int64_t{i} + 1));
      left = right;
    }
    return good;
  });
}

} // namespace stride::cam
