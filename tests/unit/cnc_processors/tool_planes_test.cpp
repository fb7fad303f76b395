// Tool correction and loops in planes other than that of X and Y: the same path, in that plane.
#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include "tests/unit/cnc/gcode_text.hpp"
#include "tests/unit/cnc_processors/contours.hpp"
#include "tests/unit/cnc_processors/sampled_path.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

struct Frame {
  Point x, y, n;
  [[nodiscard]] Point of(const Point &p) const { return x * p[0] + y * p[1] + n * p[2]; }
};

Vector3 vector(const Point &p) { return {p[0], p[1], p[2]}; }

/// The first axis's direction of a plane with a normal is any one at a right angle.
Frame around(const Point &normal) {
  const Point n = normal * (1 / sizeOf(normal));
  Point x = outer(n, std::fabs(n[0]) < 0.5 ? Point{1, 0, 0} : Point{0, 0, 1});
  x = x * (1 / sizeOf(x));
  return {x, outer(n, x), n};
}

PathObject in(const Frame &frame, PathObject o) {
  for (Position *position : {&o.start, &o.end}) {
    const Point p =
        frame.of({position->coordinate[0], position->coordinate[1], position->coordinate[2]});
    std::copy(p.begin(), p.end(), position->coordinate);
  }
  o.planeX = vector(frame.x);
  o.planeY = vector(frame.y);
  o.normal = vector(frame.n);
  return o;
}

std::vector<PathObject> in(const Frame &frame, std::vector<PathObject> path) {
  for (PathObject &o : path)
    o = in(frame, o);
  return path;
}

std::vector<PathObject> corrected(const std::vector<PathObject> &path, ToolEntry entry) {
  const auto tool = std::make_unique<ToolCorrection>();
  std::memset(static_cast<void *>(tool.get()), 0, sizeof *tool);
  tool->rules.entry = entry;
  const Outcome run = runPath(*tool, path, {50, 500, 0, 0});
  EXPECT_EQ(run.stream.phase, StreamPhase::Done);
  const auto loops = std::make_unique<LoopAvoider>();
  const Outcome rest = runPath(*loops, run.objects, {500, 500, 0, 0});
  EXPECT_EQ(rest.stream.phase, StreamPhase::Done);
  return rest.objects;
}

/// Whether `path` is what `flat` is, in the frame: type, shape, length, and what goes along.
void expectSame(const std::vector<PathObject> &flat, const Frame &frame,
                const std::vector<PathObject> &path) {
  ASSERT_EQ(path.size(), flat.size());
  for (size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(path[i].moveType, flat[i].moveType) << i;
    EXPECT_NEAR(path[i].length, flat[i].length, 1e-9) << i;
    EXPECT_EQ(path[i].marks, flat[i].marks) << i;
    EXPECT_NEAR(path[i].end.coordinate[kAxisA], flat[i].end.coordinate[kAxisA], 1e-9) << i;
    for (const double part : {0.0, 0.3, 0.7, 1.0})
      EXPECT_LT(sizeOf(placeAt(path[i], part) - frame.of(placeAt(flat[i], part))), 1e-9) << i;
  }
}

/// Corners inside and outside, arcs that shrink and grow, one that vanishes, a spline, a slot that
/// is too thin, a helix, an M function, another axis.
std::vector<PathObject> contour(uint8_t side) {
  contours::Drawing d;
  d.radius = 2;
  d.rapid(-3, -8);
  d.line(0, 0).marks = side | kAvoidLoops;
  d.line(30, 2);
  d.add(MoveType::Function, {30, 2}).switchId[0] = 5;
  d.arc({30, 12}, 90);
  PathObject &up = d.line(40, 20);
  up.end.coordinate[kAxisZ] = 4;
  up.end.coordinate[kAxisA] = 30;
  up.length = std::hypot(8, 4);
  d.line(35, 21);
  d.line(35, 40);
  d.line(32, 40);
  d.line(32, 21);
  d.arc({32, 20}, 90);
  d.spline({10, 25}, {-25, 5}, {-30, -10});
  d.arc({10, 15}, 100);
  d.line(-10, 8);
  d.line(-14, -6).marks = kEndToolCorrection | kEndAvoidLoops;
  d.line(-18, -8);
  for (size_t i = 5; i < d.path.size(); ++i)
    for (Position *position : {&d.path[i].start, &d.path[i].end}) {
      position->coordinate[kAxisZ] = 4;
      position->coordinate[kAxisA] = 30;
    }
  return d.path;
}

TEST(ToolPlanes, AreAllAlike) {
  const Frame frames[] = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, // G18
                          {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, // G19
                          around({1, 2, 2}),
                          around({-0.3, 0.1, -1})};
  for (const uint8_t side : {uint8_t{kToolLeft}, uint8_t{kToolRight}})
    for (const ToolEntry entry : {ToolEntry::Positioning, ToolEntry::Ramp}) {
      const std::vector<PathObject> flat = corrected(contour(side), entry);
      EXPECT_GT(flat.size(), 12U);
      for (const Frame &frame : frames)
        expectSame(flat, frame, corrected(in(frame, contour(side)), entry));
    }
}

/// SMC_ToolRadiusCorr's ramps, written in G-code for each plane.
TEST(ToolPlanes, HaveRampsInGCode) {
  struct Plane {
    const char *begin;
    char axes[4];   ///< Of what is X, Y, Z there.
    char centre[3]; ///< Likewise I, J.
    Frame frame;
  };
  const Plane planes[] = {
      {"G17\n", "XYZ", "IJ", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {"G18\n", "ZXY", "KI", {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}},
      {"G19\n", "YZX", "JK", {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}},
  };
  std::vector<PathObject> flat;
  for (const Plane &plane : planes) {
    std::string text = plane.begin;
    text += "F20 E100 E-100\nG1 x5 y5\nG41 D2\nG1 x10 y10\nG1 x30 y12\nG1 x32 y30 z4\n"
            "G3 x22 y40 i-10\nG1 x5 y38 P7\nG1 x8 y20\nG2 x4 y16 j-4\nG40\nG1 x0 y5\nG1 x-5 y0\n";
    for (char &c : text) {
      if (c >= 'x' && c <= 'z')
        c = plane.axes[c - 'x'];
      else if (c == 'i' || c == 'j')
        c = plane.centre[c - 'i'];
    }
    const DecodedText decoded = decodeWords(scanText(text).words, {}, false, 1000, true);
    ASSERT_EQ(decoded.error, GCodeError::None) << text;
    const std::vector<PathObject> path = corrected(decoded.objects, ToolEntry::Ramp);
    if (flat.empty())
      flat = path;
    EXPECT_GT(path.size(), 8U);
    expectSame(flat, plane.frame, path);
  }
  // The ramps lead to the shifted contour and away from it.
  EXPECT_LT(sizeOf(endOf(flat[0]) - Point{5, 5, 0}), 1e-12);
  const Point along{20 / std::hypot(20, 2), 2 / std::hypot(20, 2), 0};
  EXPECT_LT(sizeOf(endOf(flat[1]) - (Point{10, 10, 0} + Point{-along[1], along[0], 0} * 2)), 1e-9);
  EXPECT_LT(sizeOf(startOf(flat.back()) - Point{0, 5, 4}), 1e-9);
}

} // namespace
