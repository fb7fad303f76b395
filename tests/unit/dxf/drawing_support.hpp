// Random drawings with places that the test computes of their parameters, and the paths of programs
// by theirs.
#ifndef STRIDE_TESTS_UNIT_DXF_DRAWING_SUPPORT_HPP
#define STRIDE_TESTS_UNIT_DXF_DRAWING_SUPPORT_HPP

#include "compiler/assets/dxf/dxf.hpp"
#include "tests/unit/cnc_processors/sampled_path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace stc::test {

using stride::cnc::MoveType;
using stride::cnc::PathObject;
using Spot = std::array<double, 2>;
using Curve = std::vector<Spot>; ///< Places of it, close to each other.

inline double away(const Spot &a, const Spot &b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// The sections around entities.
inline std::string drawingOf(const std::string &entities, const std::string &blocks = "",
                             const std::string &header = "") {
  return "0\nSECTION\n2\nHEADER\n" + header + "0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n" + blocks +
         "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

inline std::string group(int code, double value) { return fmt::format("{}\n{}\n", code, value); }
inline std::string place(int code, const Spot &spot) {
  return group(code, spot[0]) + group(code + 10, spot[1]);
}

struct Imported {
  std::vector<DxfProgram> programs;
  std::string error; ///< Code, line and message.
  std::vector<std::string> warnings;
};

inline Imported import(const std::string &text, const DxfImport &how = {}) {
  Sources sources;
  Diagnostics diagnostics;
  Imported result;
  auto programs = importDxf(sources.file(sources.addBytes("a.dxf", text)), how, diagnostics);
  EXPECT_EQ(programs.has_value(), !diagnostics.hasErrors());
  for (const Diagnostic &one : diagnostics.all()) {
    EXPECT_TRUE(one.severity != Severity::Error || !one.helps.empty());
    const uint32_t line = one.labels.empty() ? 0 : sources.position(one.labels[0].span).line;
    (one.severity == Severity::Error ? result.error : result.warnings.emplace_back()) =
        fmt::format("{} {}: {}", codeName(one.code), line, one.message);
  }
  if (programs)
    result.programs = std::move(*programs);
  return result;
}

/// The path of a program without errors.
inline std::vector<PathObject> pathOf(const std::string &text) {
  Sources sources;
  Diagnostics diagnostics;
  std::vector<PathObject> path;
  const auto program = readCnc(sources.file(sources.add("a.cnc", text)), diagnostics);
  if (program)
    checkCnc(*program, diagnostics);
  for (const Diagnostic &one : diagnostics.all()) {
    EXPECT_EQ(codeName(one.code), "SE0887") << one.message << "\n" << text;
  }
  if (program)
    (void)decodeCnc(*program, [&](const PathObject &object) {
      path.push_back(object);
      return true;
    });
  return path;
}

inline bool isCut(const PathObject &object) {
  return isMotion(object) && object.moveType != MoveType::Positioning;
}

/// So many lines are nowhere further than 1e-4 from an object.
inline int linesOf(const PathObject &object) {
  if (!isCurve(object.moveType))
    return 1;
  if (!isCircle(object.moveType) && !isEllipse(object.moveType))
    return 300;
  const double radius = object.shape[isCircle(object.moveType) ? 2 : 4];
  const double sweep = std::abs(object.parameterRange[1]) * M_PI / 180;
  return static_cast<int>(std::ceil(sweep / std::sqrt(8e-4 / radius))) + 1;
}

/// Places of a path but for its positioning.
inline std::vector<Curve> curvesOf(const std::vector<PathObject> &path) {
  std::vector<Curve> curves;
  for (const PathObject &object : path) {
    if (!isCut(object))
      continue;
    const int count = linesOf(object);
    Curve curve;
    for (int i = 0; i <= count; ++i) {
      const auto at = stride::cnc::test::placeAt(object, 1.0 * i / count);
      curve.push_back({at[0], at[1]});
    }
    curves.push_back(curve);
  }
  return curves;
}

inline double distance(const Spot &spot, const Spot &a, const Spot &b) {
  const double dx = b[0] - a[0];
  const double dy = b[1] - a[1];
  const double square = dx * dx + dy * dy;
  const double part =
      square > 0 ? std::clamp(((spot[0] - a[0]) * dx + (spot[1] - a[1]) * dy) / square, 0.0, 1.0)
                 : 0.0;
  return std::hypot(a[0] + part * dx - spot[0], a[1] + part * dy - spot[1]);
}

/// Curves that are asked how near places are.
class Nearness {
public:
  Nearness(const std::vector<Curve> &curves, double within) : within_(within) {
    constexpr size_t kChunk = 24;
    for (const Curve &curve : curves)
      for (size_t begin = 0; begin + 1 < curve.size(); begin += kChunk) {
        Chunk chunk{&curve[begin], std::min(kChunk, curve.size() - 1 - begin), {}};
        chunk.box = {1e300, 1e300, -1e300, -1e300};
        for (size_t i = 0; i <= chunk.lines; ++i) {
          const Spot &spot = chunk.first[i];
          chunk.box = {std::min(chunk.box[0], spot[0]), std::min(chunk.box[1], spot[1]),
                       std::max(chunk.box[2], spot[0]), std::max(chunk.box[3], spot[1])};
        }
        chunks_.push_back(chunk);
      }
  }
  [[nodiscard]] bool isNear(const Spot &spot) const {
    for (const Chunk &chunk : chunks_) {
      if (spot[0] < chunk.box[0] - within_ || spot[1] < chunk.box[1] - within_ ||
          spot[0] > chunk.box[2] + within_ || spot[1] > chunk.box[3] + within_)
        continue;
      for (size_t i = 0; i < chunk.lines; ++i)
        if (distance(spot, chunk.first[i], chunk.first[i + 1]) <= within_)
          return true;
    }
    return false;
  }

private:
  struct Chunk {
    const Spot *first;
    size_t lines;
    std::array<double, 4> box;
  };
  double within_;
  std::vector<Chunk> chunks_;
};

/// Every place of one is on the other, and the other way round.
inline void expectSame(const std::vector<Curve> &a, const std::vector<Curve> &b, double within,
                       const std::string &text) {
  const Nearness nearA(a, within);
  const Nearness nearB(b, within);
  for (const Curve &curve : a)
    for (size_t i = 0; i < curve.size(); i += 9)
      ASSERT_TRUE(nearB.isNear(curve[i]))
          << fmt::format("{} of {} to {}\n", fmt::join(curve[i], " "),
                         fmt::join(curve.front(), " "), fmt::join(curve.back(), " "))
          << text;
  for (const Curve &curve : b)
    for (size_t i = 0; i < curve.size(); i += 9)
      ASSERT_TRUE(nearA.isNear(curve[i]))
          << fmt::format("{} of {} to {}\n", fmt::join(curve[i], " "),
                         fmt::join(curve.front(), " "), fmt::join(curve.back(), " "))
          << text;
}

/// Basis functions of a B-spline, as they are defined.
inline double basis(const std::vector<double> &knots, size_t i, int degree, double u) {
  if (degree == 0)
    return u >= knots[i] && u < knots[i + 1] ? 1 : 0;
  const auto p = static_cast<size_t>(degree);
  double sum = 0;
  if (knots[i + p] > knots[i])
    sum += (u - knots[i]) / (knots[i + p] - knots[i]) * basis(knots, i, degree - 1, u);
  if (knots[i + p + 1] > knots[i + 1])
    sum += (knots[i + p + 1] - u) / (knots[i + p + 1] - knots[i + 1]) *
           basis(knots, i + 1, degree - 1, u);
  return sum;
}

/// Makes entities at random, and the places that they go through.
class RandomDrawing {
public:
  explicit RandomDrawing(unsigned seed, int blocks = 3) : random_(seed) {
    using Move = std::function<Spot(Spot)>;
    for (int b = 0; b < blocks; ++b) {
      std::vector<Curve> inner;
      std::string block;
      const int count = 1 + pick(2);
      for (int i = 0; i < count; ++i)
        block += entity(inner);
      const Spot base = spot();
      blocks_ += fmt::format("0\nBLOCK\n8\n0\n2\nB{}\n70\n0\n", b) + place(10, base) + block +
                 "0\nENDBLK\n";
      const Spot at = spot();
      const double turn = number(0, 360);
      const double sx = (pick(2) == 0 ? -1 : 1) * number(0.5, 2);
      const double sy = pick(2) == 0 ? sx : (pick(2) == 0 ? -1 : 1) * number(0.5, 2);
      const bool flipped = pick(3) == 0;
      const int columns = 1 + pick(2);
      const int rows = 1 + pick(2);
      const Spot step{number(60, 90), number(-90, -60)};
      entities_ += fmt::format("0\nINSERT\n8\nL\n2\nb{}\n", b) + place(10, at) + group(41, sx) +
                   group(42, sy) + group(50, turn) +
                   fmt::format("70\n{}\n71\n{}\n", columns, rows) + group(44, step[0]) +
                   group(45, step[1]) + extrusion(flipped);
      const double c = std::cos(turn * M_PI / 180);
      const double s = std::sin(turn * M_PI / 180);
      for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
          const Move move = [=](Spot p) -> Spot {
            const double x = sx * (p[0] - base[0]) + column * step[0];
            const double y = sy * (p[1] - base[1]) + row * step[1];
            const Spot q{at[0] + c * x - s * y, at[1] + s * x + c * y};
            return {flipped ? -q[0] : q[0], q[1]};
          };
          for (Curve curve : inner) {
            std::transform(curve.begin(), curve.end(), curve.begin(), move);
            curves.push_back(curve);
          }
        }
    }
    for (int i = 0; i < 8; ++i)
      entities_ += entity(curves);
  }

  [[nodiscard]] std::string text() const { return drawingOf(entities_, blocks_); }

  std::vector<Curve> curves;

private:
  static constexpr int kPlaces = 600;

  int pick(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }
  double number(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
  }
  Spot spot() { return {number(-100, 100), number(-80, 120)}; }
  static std::string extrusion(bool flipped) {
    return flipped ? "210\n0\n220\n0.0\n230\n-1.0\n" : "";
  }

  std::string entity(std::vector<Curve> &into) {
    switch (pick(7)) {
    case 0: {
      const Spot a = spot();
      const Spot b = spot();
      into.push_back({a, b});
      return "0\nLINE\n5\nA0\n8\nL\n" + place(10, a) + place(11, b);
    }
    case 1:
    case 2:
      return arc(into);
    case 3:
      return polyline(into, true);
    case 4:
      return polyline(into, false);
    case 5:
      return ellipse(into);
    default:
      return spline(into);
    }
  }

  std::string arc(std::vector<Curve> &into) {
    const Spot centre = spot();
    const double radius = number(2, 40);
    const bool full = pick(3) == 0;
    const double from = number(0, 360);
    const double to = from + (full ? 360 : number(5, 355));
    const bool flipped = pick(3) == 0;
    Curve curve;
    for (int i = 0; i <= kPlaces; ++i) {
      const double a = (from + (to - from) * i / kPlaces) * M_PI / 180;
      const double x = centre[0] + radius * std::cos(a);
      curve.push_back({flipped ? -x : x, centre[1] + radius * std::sin(a)});
    }
    into.push_back(curve);
    return (full ? "0\nCIRCLE\n8\nL\n" : "0\nARC\n8\nL\n") + place(10, centre) + group(40, radius) +
           (full ? "" : group(50, from) + group(51, std::fmod(to, 360))) + extrusion(flipped);
  }

  /// From a to b: the arc through the place that the bulge says, beside the middle of the chord.
  static void bulge(const Spot &a, const Spot &b, double bulge, Curve &curve) {
    if (bulge == 0) {
      curve.push_back(a);
      return;
    }
    const double dx = (b[0] - a[0]) / 2;
    const double dy = (b[1] - a[1]) / 2;
    const double top = bulge; // as a part of half the chord, to the right of the way
    const double radius = std::hypot(dx, dy) * (1 + top * top) / (2 * std::abs(top));
    const Spot apex{a[0] + dx + dy * top, a[1] + dy - dx * top};
    // From the apex towards the other side lies the centre.
    const double size = std::hypot(dx, dy) * std::abs(top);
    const Spot centre{apex[0] - dy * top / size * radius, apex[1] + dx * top / size * radius};
    const double from = std::atan2(a[1] - centre[1], a[0] - centre[0]);
    const double sweep = 4 * std::atan(bulge);
    for (int i = 0; i < kPlaces; ++i)
      curve.push_back({centre[0] + radius * std::cos(from + sweep * i / kPlaces),
                       centre[1] + radius * std::sin(from + sweep * i / kPlaces)});
  }

  std::string polyline(std::vector<Curve> &into, bool light) {
    const int count = 2 + pick(4);
    const bool closed = pick(2) == 0;
    const bool flipped = pick(4) == 0;
    std::vector<Spot> spots;
    std::vector<double> bulges;
    for (int i = 0; i < count; ++i) {
      spots.push_back(spot());
      bulges.push_back(pick(2) == 0 ? 0 : number(-2, 2));
    }
    Curve curve;
    for (int i = 0; i + (closed ? 0 : 1) < count; ++i) {
      const auto at = static_cast<size_t>(i);
      bulge(spots[at], spots[(at + 1) % spots.size()], bulges[at], curve);
    }
    curve.push_back(closed ? spots.front() : spots.back());
    if (flipped)
      for (Spot &one : curve)
        one[0] = -one[0];
    into.push_back(curve);
    std::string text =
        light ? fmt::format("0\nLWPOLYLINE\n8\nL\n90\n{}\n70\n{}\n", count, closed ? 1 : 0)
              : fmt::format("0\nPOLYLINE\n8\nL\n66\n1\n70\n{}\n", closed ? 1 : 0);
    text += light ? "" : extrusion(flipped);
    for (size_t i = 0; i < spots.size(); ++i)
      text += (light ? "" : "0\nVERTEX\n8\nL\n") + place(10, spots[i]) +
              (bulges[i] != 0 ? group(42, bulges[i]) : "");
    return text + (light ? extrusion(flipped) : "0\nSEQEND\n");
  }

  std::string ellipse(std::vector<Curve> &into) {
    const Spot centre = spot();
    const Spot main{number(-40, 40), number(1, 40)};
    const double ratio = number(0.1, 1);
    const bool full = pick(3) == 0;
    const bool flipped = pick(3) == 0;
    const double from = full ? 0 : number(0, 6);
    const double to = full ? 2 * M_PI : from + number(0.1, 6.1);
    Curve curve;
    for (int i = 0; i <= kPlaces; ++i) {
      const double t = from + (to - from) * i / kPlaces;
      const double side = flipped ? -ratio : ratio;
      curve.push_back({centre[0] + main[0] * std::cos(t) - main[1] * side * std::sin(t),
                       centre[1] + main[1] * std::cos(t) + main[0] * side * std::sin(t)});
    }
    into.push_back(curve);
    return "0\nELLIPSE\n8\nL\n" + place(10, centre) + place(11, main) + group(40, ratio) +
           group(41, from) + group(42, to) + extrusion(flipped);
  }

  std::string spline(std::vector<Curve> &into) {
    const int degree = 1 + pick(5);
    const auto p = static_cast<size_t>(degree);
    const size_t n = p + 1 + static_cast<size_t>(pick(5));
    std::vector<double> knots;
    const bool clamped = pick(3) != 0;
    double knot = number(-3, 3);
    for (size_t i = 0; i < n + p + 1; ++i) {
      const bool same = clamped && ((i > 0 && i <= p) || i > n);
      knot += same ? 0 : number(0.3, 2);
      knots.push_back(knot);
    }
    std::vector<double> weights;
    std::vector<Spot> control;
    for (size_t i = 0; i < n; ++i)
      control.push_back(spot());
    if (pick(2) == 0)
      for (size_t i = 0; i < n; ++i)
        weights.push_back(number(0.3, 3));
    Curve curve;
    // Between knots, however near to each other they are.
    constexpr size_t kBetween = 1000;
    for (size_t k = 0; k <= kBetween * (n - p); ++k) {
      const size_t span = std::min(p + k / kBetween, n - 1);
      const double part = 1.0 * static_cast<double>(k - (span - p) * kBetween) / kBetween;
      const double u = knots[span] + (knots[span + 1] - knots[span]) * std::min(part, 1 - 1e-9);
      Spot sum{};
      double weight = 0;
      for (size_t i = 0; i < n; ++i) {
        const double w = basis(knots, i, degree, u) * (weights.empty() ? 1 : weights[i]);
        sum = {sum[0] + w * control[i][0], sum[1] + w * control[i][1]};
        weight += w;
      }
      curve.push_back({sum[0] / weight, sum[1] / weight});
    }
    into.push_back(curve);
    std::string text =
        fmt::format("0\nSPLINE\n8\nL\n70\n8\n71\n{}\n72\n{}\n73\n{}\n", degree, knots.size(), n);
    for (const double one : knots)
      text += group(40, one);
    for (const double one : weights)
      text += group(41, one);
    for (const Spot &one : control)
      text += place(10, one) + "30\n0\n";
    return text;
  }

  std::mt19937 random_;
  std::string entities_;
  std::string blocks_;
};

} // namespace stc::test

#endif // STRIDE_TESTS_UNIT_DXF_DRAWING_SUPPORT_HPP
