// Random cams in every form, and a plain implementation of what they mean: long double, linear
// search, formulas as the literature prints them.
#ifndef STRIDE_TESTS_PROPERTY_RANDOM_CURVES_HPP
#define STRIDE_TESTS_PROPERTY_RANDOM_CURVES_HPP

#include "runtime/numeric/cam/curve.hpp"

#include "tests/support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace stride::test {

using Real = long double;

/// A curve and the memory it lies in.
struct MadeCurve {
  cam::Curve curve;
  std::vector<unsigned char> memory;

  template <class T> void put(const std::vector<T> &values) {
    memory.resize(values.size() * sizeof(T));
    std::memcpy(memory.data(), values.data(), memory.size());
    curve.data = memory.data();
  }
};

inline cam::LawShape randomShape(Random &random) {
  cam::LawShape shape;
  shape.law = static_cast<cam::Law>(random.below(5));
  shape.parameter = random.chance(0.5) ? 0.25 : random.uniform(0.0, 0.95);
  shape.inflexion = random.chance(0.5) ? 0.5 : random.uniform(0.1, 0.9);
  return shape;
}

/// Ascending places.
inline std::vector<double> randomPlaces(Random &random, int count, double start, double length) {
  std::vector<double> parts(static_cast<size_t>(count - 1));
  double sum = 0.0;
  for (double &part : parts)
    sum += part = random.uniform(0.1, 1.0);
  std::vector<double> places{start};
  for (const double part : parts)
    places.push_back(places.back() + length * part / sum);
  return places;
}

inline MadeCurve randomNodes(Random &random, int count) {
  MadeCurve made;
  const double length = random.magnitude(-1, 3);
  const double height = random.magnitude(-1, 3);
  std::vector<cam::Node> nodes;
  for (const double x : randomPlaces(random, count, random.uniform(-500, 500), length)) {
    const double slope = height * count / length;
    nodes.push_back({x, random.uniform(-height, height),
                     random.chance(0.3) ? 0.0 : random.uniform(-slope, slope),
                     random.chance(0.3) ? 0.0 : random.uniform(-slope, slope) * count / length});
  }
  made.curve.form = cam::Form::Nodes;
  made.curve.count = count;
  made.curve.start = nodes.front().x;
  made.curve.end = nodes.back().x;
  made.put(nodes);
  return made;
}

/// Laws between random places; `pure`: also pieces of laws and polynomials of degree 7.
inline MadeCurve randomSegments(Random &random, int count, bool pure = false) {
  MadeCurve made = randomNodes(random, count + 1);
  std::vector<cam::Node> nodes(static_cast<size_t>(count) + 1);
  std::memcpy(nodes.data(), made.memory.data(), made.memory.size());
  std::vector<cam::Segment> segments;
  for (size_t i = 0; i + 1 < nodes.size(); ++i) {
    cam::Segment segment = cam::makeSegment(randomShape(random), nodes[i], nodes[i + 1]);
    if (pure) {
      for (double &coefficient : segment.coefficients)
        coefficient = random.chance(0.3) ? 0.0 : random.uniform(-10, 10);
      segment.lawBegin = random.chance(0.3) ? 0.0 : random.uniform(0.0, 1.0);
      segment.lawEnd = random.chance(0.3) ? 1.0 : random.uniform(0.0, 1.0);
      segment.stroke = random.uniform(-20, 20);
    }
    segments.push_back(segment);
  }
  made.curve.form = cam::Form::Segments;
  made.curve.count = count;
  made.put(segments);
  return made;
}

/// A whole number of the element type, or any; `ascent`: between 0 and 1, where it is.
template <class T> T randomNumber(Random &random, double ascent = -1.0) {
  const double part = ascent < 0.0 ? random.uniform(0.0, 1.0) : ascent;
  if constexpr (std::numeric_limits<T>::is_integer) {
    const auto low = static_cast<double>(std::numeric_limits<T>::min());
    const auto high = static_cast<double>(std::numeric_limits<T>::max());
    return static_cast<T>(std::floor(low + 0.999 * part * (high - low)));
  } else {
    return static_cast<T>(-300.0 + 700.0 * part);
  }
}

template <class T>
MadeCurve randomTable(Random &random, cam::Element element, bool pairs, int count) {
  MadeCurve made;
  cam::Curve &curve = made.curve;
  std::vector<T> numbers;
  for (int i = 0; i < count; ++i) {
    if (pairs)
      numbers.push_back(randomNumber<T>(random, (i + random.uniform(0.1, 0.6)) / count));
    numbers.push_back(randomNumber<T>(random));
  }
  curve.form = pairs ? cam::Form::PairTable : cam::Form::EvenTable;
  curve.element = element;
  curve.count = count;
  curve.cubic = random.chance(0.5);
  const double span = static_cast<double>(std::numeric_limits<T>::is_integer
                                              ? static_cast<Real>(std::numeric_limits<T>::max()) -
                                                    static_cast<Real>(std::numeric_limits<T>::min())
                                              : 700.0L);
  const double zero = static_cast<double>(std::numeric_limits<T>::is_integer
                                              ? static_cast<Real>(std::numeric_limits<T>::min())
                                              : -300.0L);
  curve.master = {zero, random.uniform(-100, 100), random.magnitude(-1, 3) / span};
  curve.slave = {zero, random.uniform(-100, 100), random.sign() * random.magnitude(-1, 3) / span};
  made.put(numbers);
  if (pairs) {
    curve.start = curve.master.of(static_cast<double>(numbers[0]));
    curve.end = curve.master.of(static_cast<double>(numbers[numbers.size() - 2]));
  } else {
    curve.start = random.uniform(-500, 500);
    curve.end = curve.start + random.magnitude(-1, 3);
    curve.open = random.chance(0.3);
    curve.rise = curve.open && random.chance(0.5) ? random.uniform(-100, 100) : 0.0;
  }
  return made;
}

inline MadeCurve randomTable(Random &random, bool pairs, int count) {
  switch (random.below(6)) {
  case 0:
    return randomTable<int16_t>(random, cam::Element::Int, pairs, count);
  case 1:
    return randomTable<uint16_t>(random, cam::Element::Uint, pairs, count);
  case 2:
    return randomTable<int32_t>(random, cam::Element::Dint, pairs, count);
  case 3:
    return randomTable<uint32_t>(random, cam::Element::Udint, pairs, count);
  case 4:
    return randomTable<float>(random, cam::Element::Real, pairs, count);
  default:
    return randomTable<double>(random, cam::Element::Lreal, pairs, count);
  }
}

/// Of any form, with 2 to `most` places.
inline MadeCurve randomCurve(Random &random, int most) {
  const int count = 2 + random.below(most - 1);
  switch (random.below(5)) {
  case 0:
    return randomNodes(random, count);
  case 1:
    return randomSegments(random, count);
  case 2:
    return randomSegments(random, count, true);
  case 3:
    return randomTable(random, false, count);
  default:
    return randomTable(random, true, count);
  }
}

/// A plain value with its derivatives.
struct Plain {
  Real y, v, a, j;
};

inline const Real kPiReal = std::acos(Real{-1});

/// Up to the middle, of symmetric laws.
inline Plain plainHalf(const cam::LawShape &shape, Real u) {
  const Real pi = kPiReal;
  using std::cos, std::sin;
  switch (shape.law) {
  case cam::Law::Harmonic:
    return {(1 - cos(pi * u)) / 2, pi / 2 * sin(pi * u), pi * pi / 2 * cos(pi * u),
            -pi * pi * pi / 2 * sin(pi * u)};
  case cam::Law::Cycloidal:
    return {u - sin(2 * pi * u) / (2 * pi), 1 - cos(2 * pi * u), 2 * pi * sin(2 * pi * u),
            4 * pi * pi * cos(2 * pi * u)};
  case cam::Law::ModifiedSine: {
    // From the acceleration a sin / a cos by integration with a = 1, then to the height 1/2.
    const Real b = Real{shape.parameter} / 2;
    const Real k = b > 0 ? pi / (2 * b) : 0;
    const Real m = pi / (1 - 2 * b);
    const Real vb = b > 0 ? 1 / k : 0;
    const Real yb = b > 0 ? b / k - 1 / (k * k) : 0;
    const auto fall = [&](Real w) {
      return Plain{yb + vb * w + (1 - cos(m * w)) / (m * m), vb + sin(m * w) / m, cos(m * w),
                   -m * sin(m * w)};
    };
    const Real scale = Real{1} / 2 / fall(Real{1} / 2 - b).y;
    const Plain p = u < b ? Plain{u / k - sin(k * u) / (k * k), (1 - cos(k * u)) / k, sin(k * u),
                                  k * cos(k * u)}
                          : fall(u - b);
    return {p.y * scale, p.v * scale, p.a * scale, p.j * scale};
  }
  case cam::Law::ModifiedTrapezoid: {
    const Real a = 8 * pi / (2 + pi);
    const Real k = 4 * pi;
    if (u < Real{1} / 8)
      return {a * (u / k - sin(k * u) / (k * k)), a / k * (1 - cos(k * u)), a * sin(k * u),
              a * k * cos(k * u)};
    const Real y1 = a * (Real{1} / 8 / k - 1 / (k * k));
    const Real v1 = a / k;
    if (u < Real{3} / 8) {
      const Real w = u - Real{1} / 8;
      return {y1 + v1 * w + a * w * w / 2, v1 + a * w, a, 0};
    }
    const Real w = u - Real{3} / 8;
    return {y1 + v1 / 4 + a / 32 + (v1 + a / 4) * w + a * (1 - cos(k * w)) / (k * k),
            v1 + a / 4 + a * sin(k * w) / k, a * cos(k * w), -a * k * sin(k * w)};
  }
  case cam::Law::Polynomial:
    break;
  }
  return {0, 0, 0, 0};
}

inline Plain plainLaw(const cam::LawShape &shape, Real u) {
  if (shape.law == cam::Law::Polynomial)
    return {0, 0, 0, 0};
  const bool second = u > Real{shape.inflexion};
  const Real width = 2 * (second ? 1 - Real{shape.inflexion} : Real{shape.inflexion});
  const Plain p = plainHalf(shape, (second ? 1 - u : u) / width);
  const Real sign = second ? -1 : 1;
  return {second ? 1 - width * p.y : width * p.y, p.v, sign * p.a / width, p.j / (width * width)};
}

inline Plain plainPolynomial(const std::vector<Real> &c, Real u) {
  Plain p{0, 0, 0, 0};
  for (size_t i = 0; i < c.size(); ++i) {
    const auto n = static_cast<Real>(i);
    p.y += c[i] * std::pow(u, n);
    p.v += i < 1 ? 0 : n * c[i] * std::pow(u, n - 1);
    p.a += i < 2 ? 0 : n * (n - 1) * c[i] * std::pow(u, n - 2);
    p.j += i < 3 ? 0 : n * (n - 1) * (n - 2) * c[i] * std::pow(u, n - 3);
  }
  return p;
}

inline Real plainNumber(const MadeCurve &made, int64_t index) {
  const auto at = [&]<class T>(T /*type*/) {
    T value;
    std::memcpy(&value, made.memory.data() + static_cast<size_t>(index) * sizeof(T), sizeof(T));
    return static_cast<Real>(value);
  };
  switch (made.curve.element) {
  case cam::Element::Int:
    return at(int16_t{});
  case cam::Element::Uint:
    return at(uint16_t{});
  case cam::Element::Dint:
    return at(int32_t{});
  case cam::Element::Udint:
    return at(uint32_t{});
  case cam::Element::Real:
    return at(float{});
  case cam::Element::Lreal:
    break;
  }
  return at(double{});
}

/// A table's places in technical units, the missing one of an open table included.
inline void plainPlaces(const MadeCurve &made, std::vector<Real> &x, std::vector<Real> &y) {
  const cam::Curve &curve = made.curve;
  const auto scaled = [](const cam::Scale &scale, Real number) {
    return scale.base + (number - scale.zero) * scale.factor;
  };
  const bool pairs = curve.form == cam::Form::PairTable;
  const int count = curve.count + (curve.open ? 1 : 0);
  for (int i = 0; i < count; ++i) {
    const bool missing = i == curve.count;
    if (pairs)
      x.push_back(scaled(curve.master, plainNumber(made, 2 * i)));
    else
      x.push_back(curve.start + (Real{curve.end} - curve.start) * i / (count - 1));
    y.push_back(scaled(curve.slave, plainNumber(made, missing ? 0
                                                      : pairs ? 2 * i + 1
                                                              : i)) +
                (missing ? Real{curve.rise} : 0));
  }
}

/// The slope at place `i`: that of the parabola through it and its neighbours, by Lagrange.
inline Real plainSlope(const std::vector<Real> &x, const std::vector<Real> &y, int i,
                       bool periodic) {
  const int last = static_cast<int>(x.size()) - 1;
  const auto px = [&](int k) {
    return k < 0      ? x[static_cast<size_t>(k + last)] - (x[static_cast<size_t>(last)] - x[0])
           : k > last ? x[static_cast<size_t>(k - last)] + (x[static_cast<size_t>(last)] - x[0])
                      : x[static_cast<size_t>(k)];
  };
  const auto py = [&](int k) {
    return k < 0      ? y[static_cast<size_t>(k + last)] - (y[static_cast<size_t>(last)] - y[0])
           : k > last ? y[static_cast<size_t>(k - last)] + (y[static_cast<size_t>(last)] - y[0])
                      : y[static_cast<size_t>(k)];
  };
  if (!periodic && last == 1)
    return (y[1] - y[0]) / (x[1] - x[0]);
  const int middle = periodic ? i : std::clamp(i, 1, last - 1);
  const Real at = px(i);
  Real slope = 0;
  for (int k = middle - 1; k <= middle + 1; ++k) {
    const int m = k == middle - 1 ? middle : middle - 1;
    const int n = k == middle + 1 ? middle : middle + 1;
    slope += py(k) * ((at - px(m)) + (at - px(n))) / ((px(k) - px(m)) * (px(k) - px(n)));
  }
  return slope;
}

/// The curve at `x`, which is inside of it; `piece` is the one that counts.
inline Plain plainPiece(const MadeCurve &made, size_t piece, Real x, bool periodic) {
  const cam::Curve &curve = made.curve;
  std::vector<Real> c;
  Real left = 0;
  Real length = 1;
  Plain law{0, 0, 0, 0};
  if (curve.form == cam::Form::Nodes) {
    cam::Node n[2];
    std::memcpy(n, made.memory.data() + piece * sizeof(cam::Node), sizeof n);
    left = n[0].x;
    length = Real{n[1].x} - n[0].x;
    const Real v0 = n[0].v * length, v1 = n[1].v * length;
    const Real a0 = n[0].a * length * length, a1 = n[1].a * length * length;
    const Real d = Real{n[1].y} - n[0].y;
    c = {n[0].y,
         v0,
         a0 / 2,
         10 * d - 6 * v0 - 4 * v1 - Real{3} / 2 * a0 + a1 / 2,
         -15 * d + 8 * v0 + 7 * v1 + Real{3} / 2 * a0 - a1,
         6 * d - 3 * v0 - 3 * v1 - a0 / 2 + a1 / 2};
  } else if (curve.form == cam::Form::Segments) {
    cam::Segment s;
    std::memcpy(&s, made.memory.data() + piece * sizeof s, sizeof s);
    left = s.start;
    length = Real{s.end} - s.start;
    c.assign(std::begin(s.coefficients), std::end(s.coefficients));
    const Real extent = Real{s.lawEnd} - s.lawBegin;
    const Plain p =
        plainLaw({s.law, s.parameter, s.inflexion}, s.lawBegin + extent * (x - left) / length);
    const Real stroke = s.stroke;
    law = {stroke * p.y, stroke * p.v * extent, stroke * p.a * extent * extent,
           stroke * p.j * extent * extent * extent};
  } else {
    std::vector<Real> px;
    std::vector<Real> py;
    plainPlaces(made, px, py);
    left = px[piece];
    length = px[piece + 1] - left;
    const Real d = py[piece + 1] - py[piece];
    if (curve.cubic) {
      const Real m0 = plainSlope(px, py, static_cast<int>(piece), periodic) * length;
      const Real m1 = plainSlope(px, py, static_cast<int>(piece) + 1, periodic) * length;
      c = {py[piece], m0, 3 * d - 2 * m0 - m1, m0 + m1 - 2 * d};
    } else {
      c = {py[piece], d};
    }
  }
  Plain p = plainPolynomial(c, (x - left) / length);
  p = {p.y + law.y, p.v + law.v, p.a + law.a, p.j + law.j};
  return {p.y, p.v / length, p.a / (length * length), p.j / (length * length * length)};
}

/// Where piece `piece` begins.
inline double beginOf(const MadeCurve &made, uint32_t piece) {
  return cam::pieceOf(made.curve, piece, false).start;
}

} // namespace stride::test

#endif
