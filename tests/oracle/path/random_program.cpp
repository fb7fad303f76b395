#include "tests/oracle/path/random_program.hpp"

#include "tests/support/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stride::oracle {

namespace {

using stride::test::Random;

constexpr double kPi = std::numbers::pi;

Point plus(const Point &a, const Point &b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Point scaled(const Point &a, double factor) { return plus({0, 0, 0}, a, factor); }

double product(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point across(const Point &a, const Point &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point unit(const Point &a) {
  const double size = std::sqrt(product(a, a));
  return {a[0] / size, a[1] / size, a[2] / size};
}

/// Writes a program, move by move: it knows where it stands and in which direction it has come.
class ProgramWriter {
public:
  ProgramWriter(uint64_t seed, const ProgramOptions &options) : random_(seed), options_(options) {
    program_.scale =
        std::exp(random_.uniform(std::log(options.leastScale), std::log(options.greatestScale)));
    const double velocity = program_.scale * random_.magnitude(-1, 3);
    const double acceleration = velocity * velocity / program_.scale * random_.magnitude(-1.5, 2);
    program_.jerk = acceleration * acceleration / velocity * random_.magnitude(-1, 1.5);
    for (size_t axis = 0; axis < 3; ++axis) {
      program_.axisVelocity[axis] = velocity * random_.magnitude(-0.3, 0.3);
      program_.axisAcceleration[axis] = acceleration * random_.magnitude(-0.3, 0.3);
    }
    program_.tolerance = program_.scale * random_.magnitude(-4, -0.5);
    velocity_ = velocity;
    acceleration_ = acceleration;
    for (double &coordinate : place_)
      coordinate = program_.scale * random_.uniform(-3, 3);
    if (options.flat)
      place_[2] = 0;
    heading_ = anyDirection();
    newFeeds();
  }

  RandomProgram run() {
    const int passages = 1 + random_.below(options_.passages);
    for (int i = 0; i < passages; ++i) {
      const auto passage = static_cast<Passage>(random_.below(kPassages));
      program_.passages.push_back(passage);
      if (random_.chance(0.4))
        newFeeds();
      write(passage);
    }
    return std::move(program_);
  }

private:
  void write(Passage passage) {
    const double scale = program_.scale;
    switch (passage) {
    case Passage::Wander:
      for (int i = count(3, 12); i > 0; --i)
        lineBy(turned(random_.uniform(0, kPi)), scale * random_.magnitude(-2, 0.5));
      break;
    case Passage::Stairs:
      for (int i = count(4, 16); i > 0; --i)
        lineBy(turned(kPi / 2), scale * random_.magnitude(-1, 0));
      break;
    case Passage::SlightCorners:
      for (int i = count(5, 25); i > 0; --i)
        lineBy(turned(random_.magnitude(-6, -1)), scale * random_.magnitude(-2, 0));
      break;
    case Passage::Collinear: {
      const double length = scale * random_.magnitude(-4, -1.5);
      for (int i = count(20, 150); i > 0; --i)
        lineBy(heading_, length);
      break;
    }
    case Passage::Neighbours:
      for (int i = count(3, 8); i > 0; --i) {
        lineBy(turned(random_.magnitude(-2, 0.3)), scale * random_.magnitude(0, 2));
        for (int k = count(1, 4); k > 0; --k)
          lineBy(turned(random_.magnitude(-2, 0.3)), scale * random_.magnitude(-5, -3));
      }
      break;
    case Passage::Cusps:
      for (int i = count(2, 8); i > 0; --i)
        lineBy(turned(kPi - random_.magnitude(-6, -0.5)), scale * random_.magnitude(-1, 0));
      break;
    case Passage::Reversal: {
      const Point back = place_;
      lineBy(turned(random_.uniform(0, 1)), scale * random_.magnitude(-1, 0));
      lineTo(back);
      break;
    }
    case Passage::FullCircle:
      arc(scale * random_.magnitude(-2, 1), 2 * kPi, 0, random_.chance(0.5));
      break;
    case Passage::Helix: {
      const double climb = scale * random_.sign() * random_.magnitude(-1.5, 0.5);
      arc(scale * random_.magnitude(-1.5, 0.5), random_.uniform(0.2, 2) * kPi,
          options_.flat ? 0 : climb, random_.chance(0.7));
      break;
    }
    default:
      writeCurved(passage);
    }
  }

  void writeCurved(Passage passage) {
    const double scale = program_.scale;
    switch (passage) {
    case Passage::TangentArcs:
      for (int i = count(2, 10); i > 0; --i) {
        arc(scale * random_.magnitude(-1.5, 0.7), random_.uniform(0.05, 1.9 * kPi), 0, true);
        if (random_.chance(0.3))
          lineBy(heading_, scale * random_.magnitude(-2, 0));
      }
      break;
    case Passage::AnyArcs:
      for (int i = count(2, 10); i > 0; --i)
        arc(scale * random_.magnitude(-1, 0.5), random_.uniform(0.05, 1.9 * kPi), 0, false);
      break;
    case Passage::TinyArcs:
      for (int i = count(2, 6); i > 0; --i) {
        lineBy(heading_, scale * random_.magnitude(-1, 0));
        arc(scale * random_.magnitude(-5, -3), random_.uniform(0.3, 1.5 * kPi), 0, true);
      }
      break;
    case Passage::Sawtooth:
      sawtooth();
      break;
    case Passage::Polygon: {
      const int corners = count(12, 150);
      const double side = 2 * kPi * scale * random_.magnitude(-1, 0.5) / corners;
      const Point normal = anyNormal();
      for (int i = 0; i < corners; ++i)
        lineBy(turnedAround(normal, 2 * kPi / corners), side);
      break;
    }
    default:
      curve();
    }
  }

  int count(int least, int most) {
    const int bound = std::min(most, options_.mostMoves);
    return std::min(least, bound) + random_.below(std::max(1, bound - least + 1));
  }

  /// Arcs between two lines of points, bent to one side and to the other in turn.
  void sawtooth() {
    const double height = program_.scale * random_.magnitude(-1, 0);
    const double radius = height * random_.uniform(0.6, 3);
    const double pitch = height * random_.uniform(0.1, 1);
    const Point normal = anyNormal();
    const Point along = perpendicular(normal);
    const Point up = across(normal, along);
    for (int i = count(4, 30); i > 0; --i) {
      const Point chord = plus(scaled(along, pitch), up, i % 2 == 0 ? height : -height);
      arcOver(chord, std::max(radius, 0.51 * std::sqrt(product(chord, chord))), normal, i % 2 == 0);
    }
  }

  /// A smooth curve in points that a text has rounded.
  void curve() {
    const double size = program_.scale * random_.magnitude(-0.5, 0.5);
    const double rounding = program_.scale * 1e-4;
    const int points = count(40, 150);
    const Point origin = place_;
    const double fast = random_.uniform(0.5, 3);
    const double phase = random_.uniform(0, 6);
    for (int i = 1; i <= points; ++i) {
      const double t = 2.0 * i / points;
      Point at = {std::sin(fast * t), std::cos(1.7 * t + phase) - std::cos(phase),
                  options_.flat ? 0.0 : 0.3 * t * std::sin(t)};
      at = plus(origin, at, size);
      for (double &coordinate : at)
        coordinate = std::round(coordinate / rounding) * rounding;
      lineTo(at);
    }
  }

  Point anyDirection() {
    for (;;) {
      const Point any = {random_.uniform(-1, 1), random_.uniform(-1, 1),
                         options_.flat ? 0.0 : random_.uniform(-1, 1)};
      const double size = product(any, any);
      if (size > 0.01 && size < 1)
        return unit(any);
    }
  }
  Point perpendicular(const Point &normal) {
    for (;;) {
      const Point any = anyDirection();
      const Point flat = plus(any, normal, -product(any, normal));
      if (product(flat, flat) > 0.01)
        return unit(flat);
    }
  }
  /// Of the plane of an arc.
  Point anyNormal() {
    if (options_.flat)
      return {0, 0, 1};
    if (options_.anyPlane)
      return anyDirection();
    Point normal{0, 0, 0};
    normal[static_cast<size_t>(random_.below(3))] = 1;
    return normal;
  }

  [[nodiscard]] Point turnedAround(const Point &normal, double angle) const {
    const Point flat = plus(heading_, normal, -product(heading_, normal));
    if (product(flat, flat) < 1e-12)
      return heading_;
    const Point forward = unit(flat);
    return plus(scaled(forward, std::cos(angle)), across(normal, forward), std::sin(angle));
  }
  /// The heading, turned to any side.
  Point turned(double angle) {
    const Point side =
        options_.flat ? Point{-heading_[1], heading_[0], 0} : perpendicular(heading_);
    return unit(plus(scaled(heading_, std::cos(angle)), side, random_.sign() * std::sin(angle)));
  }

  void newFeeds() {
    feed_ = velocity_ * random_.magnitude(-1.5, 0.7);
    rise_ = acceleration_ * random_.magnitude(-0.5, 0.5);
    fall_ = random_.chance(0.5) ? rise_ : acceleration_ * random_.magnitude(-0.5, 0.5);
  }

  void add(MoveKind kind, const Point &end, const Point &centre, const Point &normal) {
    program_.moves.push_back({kind, place_, end, centre, normal, feed_, rise_, fall_});
    place_ = end;
  }
  void lineTo(const Point &end) {
    const Point way = plus(end, place_, -1);
    if (product(way, way) <= 0.0)
      return;
    heading_ = unit(way);
    add(MoveKind::Line, end, {0, 0, 0}, {0, 0, 0});
  }
  void lineBy(const Point &direction, double length) { lineTo(plus(place_, direction, length)); }

  /// An arc of a radius over an angle, with a climb along the normal; tangent to the heading, or
  /// not.
  void arc(double radius, double sweep, double climb, bool tangent) {
    Point normal = anyNormal();
    if (tangent && options_.anyPlane)
      normal = perpendicular(heading_);
    Point forward = perpendicular(normal);
    const Point flat = plus(heading_, normal, -product(heading_, normal));
    if (tangent && product(flat, flat) > 1e-6)
      forward = unit(flat);
    const bool clockwise = random_.chance(0.5);
    const double side = clockwise ? -1 : 1;
    const Point toCentre = scaled(across(normal, forward), side);
    const Point centre = plus(place_, toCentre, radius);
    // from the centre: out to the start and ahead
    const auto around = [&](double angle) {
      return plus(scaled(toCentre, -std::cos(angle)), forward, std::sin(angle));
    };
    Point end = plus(plus(centre, around(sweep), radius), normal, climb);
    if (sweep >= 2 * kPi)
      end = plus(place_, normal, climb);
    add(clockwise ? MoveKind::Clockwise : MoveKind::Counterclockwise, end, centre, normal);
    const double turning = radius * sweep;
    heading_ = unit(
        plus(plus(scaled(toCentre, turning * std::sin(sweep)), forward, turning * std::cos(sweep)),
             normal, climb));
  }

  /// The arc below a half circle over a chord in the plane of `normal`.
  void arcOver(const Point &chord, double radius, const Point &normal, bool clockwise) {
    const double half = 0.5 * std::sqrt(product(chord, chord));
    const Point left = unit(across(normal, chord));
    const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
    const Point centre = plus(plus(place_, chord, 0.5), left, clockwise ? -height : height);
    const Point end = plus(place_, chord, 1);
    const Point out = plus(end, centre, -1);
    add(clockwise ? MoveKind::Clockwise : MoveKind::Counterclockwise, end, centre, normal);
    heading_ = unit(scaled(across(normal, out), clockwise ? -1 : 1));
  }

  Random random_;
  const ProgramOptions &options_;
  RandomProgram program_{};
  Point place_{}, heading_{};
  double velocity_ = 0, acceleration_ = 0;
  double feed_ = 0, rise_ = 0, fall_ = 0;
};

} // namespace

RandomProgram randomProgram(uint64_t seed, const ProgramOptions &options) {
  return ProgramWriter(seed, options).run();
}

PathChain chainOf(const std::vector<ProgramMove> &moves) {
  const auto place = [](const Point &point) { return Place{point[0], point[1], point[2]}; };
  PathChain chain(moves.empty() ? Place{} : place(moves.front().start));
  for (const ProgramMove &move : moves) {
    if (move.kind == MoveKind::Line) {
      chain.addLine(place(move.end));
      continue;
    }
    const double side = move.kind == MoveKind::Clockwise ? -1 : 1;
    chain.addArc(place(move.end), move.centre, scaled(move.normal, side));
  }
  return chain;
}

} // namespace stride::oracle
