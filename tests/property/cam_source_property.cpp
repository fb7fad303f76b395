// Cam files: written and read again they are the same; gaps are filled continuously; compiled in
// any mode the data follow the curve as closely as their numbers can.
#include "compiler/assets/cam/cam_source.hpp"
#include "compiler/source/render.hpp"
#include "tests/support/cases.hpp"
#include "tests/support/random.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace stride::test {
namespace {

using namespace stride::cam;
using stc::CamElement;
using stc::CamMode;
using stc::CamSource;

Node randomNode(Random &random, double x, double size) {
  return {x, size * random.uniform(-1, 1), random.chance(0.5) ? 0 : size * random.uniform(-1, 1),
          random.chance(0.7) ? 0 : size * random.uniform(-1, 1)};
}

/// Elements in order, some of them side by side.
CamSource randomCam(Random &random, bool mayTouch) {
  CamSource cam;
  cam.name.text = "Cam1";
  const double size = random.magnitude(-2, 4);
  const double step = random.magnitude(-2, 3);
  double x = step * random.uniform(-5, 5);
  cam.start = x;
  const int count = 2 + random.below(8);
  for (int i = 0; i < count; ++i) {
    CamElement element;
    const int kind = random.below(3);
    element.left = randomNode(random, x, size);
    if (mayTouch && i > 0 && cam.elements.back().right.x == x)
      element.left.y = cam.elements.back().right.y;
    element.right = element.left;
    if (kind != 0 || (i > 0 && cam.elements.back().right.x == x)) {
      x += step * random.uniform(0.1, 2);
      element.right = randomNode(random, x, size);
      element.kind = kind == 1 ? CamElement::Kind::Line : CamElement::Kind::Law;
    }
    if (element.kind == CamElement::Kind::Line) {
      element.left.v = element.right.v =
          (element.right.y - element.left.y) / (element.right.x - element.left.x);
      element.left.a = element.right.a = 0;
    } else if (element.kind == CamElement::Kind::Law) {
      element.shape.law = static_cast<Law>(random.below(5));
      if (element.shape.law == Law::ModifiedSine)
        element.shape.parameter = random.uniform(0, 0.99);
      if (element.shape.law != Law::Polynomial)
        element.shape.inflexion = random.uniform(0.1, 0.9);
      if (element.shape.law == Law::Harmonic) { // its own accelerations
        const Segment own = makeSegment(element.shape, element.left, element.right);
        element.left.a = evaluateSegment(own, own.start).a;
        element.right.a = evaluateSegment(own, own.end).a;
      }
    }
    cam.elements.push_back(element);
    if (!mayTouch || random.chance(0.7) || element.kind == CamElement::Kind::Point)
      x += step * random.uniform(0.1, 2);
  }
  cam.end = cam.elements.back().right.x;
  for (int i = random.below(4); i > 0; --i)
    cam.tappets.push_back(
        {random.uniform(cam.start, cam.end), static_cast<int16_t>(random.below(100)),
         static_cast<int16_t>(random.below(3)), static_cast<int16_t>(random.below(3)), 0, 0, 0});
  return cam;
}

double sizeOfCurve(const std::vector<Segment> &segments) {
  double size = 1e-300;
  for (const Segment &segment : segments)
    for (int i = 0; i <= 16; ++i)
      size = std::max(
          size,
          std::fabs(
              evaluateSegment(segment, segment.start + (segment.end - segment.start) * i / 16).y));
  return size;
}

Curve curveOf(const CamSource &cam, const std::vector<Segment> &segments) {
  Curve curve;
  curve.start = cam.start;
  curve.end = cam.end;
  curve.form = Form::Segments;
  curve.count = static_cast<int32_t>(segments.size());
  curve.data = segments.data();
  return curve;
}

TEST(CamSource, WrittenAndReadAgain) {
  Random random(70);
  for (int i = 0, n = casesOf(2000); i < n; ++i) {
    const CamSource cam = randomCam(random, true);
    const std::string text = stc::camFileText(cam, "random");
    stc::Sources sources;
    stc::Diagnostics diagnostics;
    const stc::FileId id = sources.add("Cam1.cam.toml", text);
    const auto again = stc::readCam(sources.file(id), diagnostics);
    ASSERT_TRUE(again) << text << renderText(diagnostics.all().front(), sources);
    ASSERT_EQ(again->elements.size(), cam.elements.size()) << text;
    const auto same = [](const Node &a, const Node &b) {
      return a.x == b.x && a.y == b.y && a.v == b.v && a.a == b.a;
    };
    for (size_t e = 0; e < cam.elements.size(); ++e) {
      ASSERT_TRUE(same(again->elements[e].left, cam.elements[e].left)) << text;
      ASSERT_TRUE(same(again->elements[e].right, cam.elements[e].right)) << text;
    }
    ASSERT_EQ(again->tappets.size(), cam.tappets.size());
    for (size_t t = 0; t < cam.tappets.size(); ++t)
      ASSERT_EQ(again->tappets[t].x, cam.tappets[t].x);
  }
}

TEST(CamSource, GapsAreFilledContinuously) {
  Random random(71);
  for (int i = 0, n = casesOf(5000); i < n; ++i) {
    const CamSource cam = randomCam(random, false);
    const std::vector<Segment> segments = stc::segmentsOf(cam);
    ASSERT_EQ(segments.front().start, cam.start);
    ASSERT_EQ(segments.back().end, cam.end);
    for (size_t s = 1; s < segments.size(); ++s)
      ASSERT_EQ(segments[s].start, segments[s - 1].end);
    const auto jumps = stc::jumpsOf(segments, false, 0);
    ASSERT_TRUE(jumps.empty()) << stc::camFileText(cam, "jumps") << jumps[0].what << " at "
                               << jumps[0].x;
    for (const CamElement &element : cam.elements) {
      const Curve curve = curveOf(cam, segments);
      uint32_t index = 0;
      ASSERT_NEAR(evaluateCurve(curve, element.left.x, false, index).y, element.left.y,
                  1e-9 * sizeOfCurve(segments));
    }
  }
}

TEST(CamSource, DataFollowTheCurve) {
  Random random(72);
  for (int i = 0, n = casesOf(3000); i < n; ++i) {
    CamSource cam = randomCam(random, true);
    const std::vector<Segment> segments = stc::segmentsOf(cam);
    const Curve ideal = curveOf(cam, segments);
    const double size = sizeOfCurve(segments);
    cam.compile.mode = static_cast<CamMode>(random.below(3));
    cam.compile.type = static_cast<Element>(1 + random.below(6));
    cam.compile.places = 100 + random.below(1000);
    cam.compile.cubic = random.chance(0.5);
    stc::Diagnostics diagnostics;
    const auto data = stc::compileCam(cam, diagnostics);
    if (!data) {
      // Master numbers of 16 bits may coincide, no more.
      ASSERT_TRUE(cam.compile.mode == CamMode::ElementOptimised && sizeOf(cam.compile.type) < 4)
          << diagnostics.all().front().message;
      continue;
    }
    const Curve curve = data->curve();
    ASSERT_EQ(checkCurve(curve), CurveError::None);
    const bool table = curve.form == Form::EvenTable || curve.form == Form::PairTable;
    double quantum = 0; // of the slave positions
    switch (cam.compile.type) {
    case Element::Int:
    case Element::Uint:
      quantum = 2 * size / 65535;
      break;
    case Element::Dint:
    case Element::Udint:
    case Element::Real: // also: the scale consists of REALs
      quantum = 2 * size * 1.2e-7;
      break;
    case Element::Lreal:
      break;
    }
    double steepest = 0;
    for (const Segment &segment : segments)
      for (int k = 0; k <= 32; ++k)
        steepest = std::max(
            steepest, std::fabs(evaluateSegment(segment, segment.start +
                                                             (segment.end - segment.start) * k / 32)
                                    .v));
    // A place on the master is rounded, too: the slave's position is that of where it then lies, up
    // to the REALs of the scale.
    const double shift = (std::fabs(cam.start) + std::fabs(cam.end)) * 2.4e-7;
    const double allowed =
        table ? 0.51 * quantum + 1e-9 * size +
                    (curve.form == Form::PairTable && cam.compile.type != Element::Lreal
                         ? 2 * steepest * shift
                         : 0)
              : 1e-9 * size;
    uint32_t index = 0;
    uint32_t other = 0;
    const uint32_t pieces = pieceCount(curve);
    for (uint32_t piece = 0; piece < pieces; ++piece) {
      const double x = pieceOf(curve, piece, false).start;
      const double on = evaluateCurve(ideal, x, false, index).y;
      ASSERT_NEAR(evaluateCurve(curve, x, false, other).y, on, allowed)
          << stc::camFileText(cam, "off") << static_cast<int>(cam.compile.mode) << " type "
          << static_cast<int>(cam.compile.type) << " at " << x;
    }
  }
}

/// The integral of the squared jerk, which is a polynomial of degree 4: three nodes of Gauss are
/// exact.
double roughnessOf(const std::vector<Segment> &segments) {
  double sum = 0;
  for (const Segment &segment : segments) {
    const double h = segment.end - segment.start;
    const double nodes[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
    const double weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    for (int i = 0; i < 3; ++i) {
      const double jerk = evaluateSegment(segment, segment.start + h * nodes[i]).j;
      sum += h * weights[i] * jerk * jerk;
    }
  }
  return sum;
}

TEST(CamSource, SmoothPointsCannotBeSmoother) {
  Random random(73);
  int closed = 0;
  for (int i = 0, n = casesOf(1000); i < n; ++i) {
    CamSource cam;
    cam.periodic = random.chance(0.4);
    double x = random.uniform(-3, 3);
    cam.start = x;
    for (int k = 2 + random.below(6); k >= 0; --k) {
      CamElement element;
      element.left = randomNode(random, x, 1);
      element.smooth = random.chance(0.7);
      element.given = element.smooth && random.chance(0.2) ? 1 : 0;
      element.right = element.left;
      cam.elements.push_back(element);
      cam.end = x;
      x += random.uniform(0.3, 2);
    }
    CamElement &first = cam.elements.front();
    CamElement &last = cam.elements.back();
    if (cam.periodic) {
      cam.interval = std::fabs(last.left.y - first.left.y);
      last.left.v = first.left.v;
      last.left.a = first.left.a;
      last.right = last.left;
      last.smooth = first.smooth;
      last.given = first.given;
    }
    const std::vector<CamElement> before = cam.elements;
    ASSERT_TRUE(stc::smoothen(cam));
    for (size_t k = 0; k < before.size(); ++k) {
      const CamElement &now = cam.elements[k];
      ASSERT_EQ(now.left.y, before[k].left.y);
      if (!now.smooth || now.given == 1) {
        ASSERT_EQ(now.left.v, before[k].left.v);
      }
      if (!now.smooth) {
        ASSERT_EQ(now.left.a, before[k].left.a);
      }
    }
    ASSERT_TRUE(stc::jumpsOf(stc::segmentsOf(cam), cam.periodic, cam.interval).empty());
    closed += cam.periodic && first.smooth ? 1 : 0;
    const double least = roughnessOf(stc::segmentsOf(cam));
    for (int trial = 0; trial < 20; ++trial) {
      CamSource other = cam;
      const double step = random.magnitude(-4, 0);
      for (CamElement &element : other.elements) {
        if (element.smooth && element.given == 0)
          element.left.v += step * random.uniform(-1, 1);
        if (element.smooth)
          element.left.a += step * random.uniform(-1, 1);
        element.right = element.left;
      }
      if (other.periodic) {
        other.elements.back().left.v = other.elements.front().left.v;
        other.elements.back().left.a = other.elements.front().left.a;
        other.elements.back().right = other.elements.back().left;
      }
      ASSERT_GE(roughnessOf(stc::segmentsOf(other)), least * (1 - 1e-9) - 1e-12) << "case " << i;
    }
  }
  EXPECT_GT(closed, casesOf(100));
}

} // namespace
} // namespace stride::test
