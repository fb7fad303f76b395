// A program that is moved, turned, mirrored or scaled gives its path moved, turned, mirrored or
// scaled: decoder, tool correction, loops and corners depend on no coordinate, direction, side or
// unit.
#include "tests/unit/cnc/gcode_text.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/corner_path.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

struct Place {
  double x, y;
};

/// What is done to a program.
struct Symmetry {
  double scale;
  double dx, dy;
  int quarters; ///< Turns of 90 degrees, after the mirror.
  bool mirrored;

  [[nodiscard]] Place of(Place p) const {
    if (mirrored)
      p.y = -p.y;
    for (int i = 0; i < quarters; ++i)
      p = {-p.y, p.x};
    return {p.x * scale + dx, p.y * scale + dy};
  }
  [[nodiscard]] MoveType of(MoveType type) const {
    if (!mirrored || !isCircle(type))
      return type;
    return type == MoveType::Clockwise ? MoveType::Counterclockwise : MoveType::Clockwise;
  }
};

constexpr Symmetry kSame = {1, 0, 0, 0, false};
constexpr Symmetry kOthers[] = {{1, 1e4, -7e3, 0, false},   {1e-3, 0, 0, 0, false},
                                {1e3, 1e6, -1e6, 0, false}, {1.0 / 25.4, 3, 5, 3, false},
                                {1, 0, 0, 0, true},         {1024, 0, 0, 2, true},
                                {0.01, 10, 20, 1, true}};

struct Step {
  int g; ///< 1 to 3
  Place to;
  double radius;
};

std::string word(const char *letter, double value) {
  char text[40];
  std::snprintf(text, sizeof text, " %s%.17f", letter, value);
  return text;
}

/// A random program, its text in any symmetry.
struct Contour {
  explicit Contour(unsigned seed) : random(seed) {
    const auto between = [&](double least, double most) {
      return std::uniform_real_distribution<>(least, most)(random);
    };
    constexpr double kUnevenness[] = {0.6, 1.3, 3.0};
    Place at{0, 0};
    double heading = 0;
    for (int i = 0; i < 30; ++i) {
      const double way = std::exp(between(-1.2, 1.2));
      heading += between(-1, 1) * kUnevenness[seed % 3];
      at = {at.x + way * std::cos(heading), at.y + way * std::sin(heading)};
      const auto kind = random() % 6;
      steps.push_back({kind == 4 ? 2 : kind == 5 ? 3 : 1, at, way * between(0.6, 2.6)});
    }
    tool = between(0.05, 0.35);
    corner = between(0.02, 0.9);
    left = random() % 2 == 0;
  }

  [[nodiscard]] std::string text(const Symmetry &by) const {
    const Place origin = by.of({0, 0});
    std::string result = "G0" + word("X", origin.x) + word("Y", origin.y);
    result += left == by.mirrored ? "\nG42" : "\nG41";
    result += word("D", tool * by.scale) + "\n" + word("F", 100 * by.scale) +
              word("E", 1e4 * by.scale) + word("E", -1e4 * by.scale) + "\nG51" +
              word("D", corner * by.scale) + "\nG61\n";
    for (const Step &step : steps) {
      const Place to = by.of(step.to);
      const int g = step.g == 1 || !by.mirrored ? step.g : 5 - step.g;
      result += "G" + std::to_string(g) + word("X", to.x) + word("Y", to.y);
      result += step.g == 1 ? "\n" : word("R", step.radius * by.scale) + "\n";
    }
    return result;
  }

  std::mt19937 random;
  std::vector<Step> steps;
  double tool, corner; // [u]
  bool left;
};

std::vector<PathObject> decoded(const std::string &text) {
  const Scanned scanned = scanText(text);
  EXPECT_TRUE(scanned.errors.empty()) << text;
  const auto decoder = std::make_unique<Decoder>();
  const auto part = std::make_unique<Decoded>();
  std::vector<PathObject> path;
  const auto take = [&] { path.insert(path.end(), part->objects, part->objects + part->count); };
  startDecoder(*decoder, {});
  const auto count = static_cast<int64_t>(scanned.words.size());
  for (int64_t at = 0; at < count;) {
    SentenceWords sentence;
    at = sentenceAt(scanned.words.data(), count, at, sentence);
    decodeSentence(*decoder, sentence.words, sentence.count, sentence.line, *part);
    EXPECT_EQ(part->error, GCodeError::None);
    take();
  }
  decodeEnd(*decoder, *part);
  take();
  return path;
}

template <class Processor>
std::vector<PathObject> through(Processor &processor, const std::vector<PathObject> &path) {
  const Outcome outcome = runPath(processor, path, {400, 400, 0, 0});
  EXPECT_EQ(outcome.stream.phase, StreamPhase::Done);
  return outcome.objects;
}

/// The paths after the decoder and each of the processors.
std::vector<std::vector<PathObject>> pathsOf(const std::string &text) {
  std::vector<std::vector<PathObject>> paths = {decoded(text)};
  const auto tool = std::make_unique<ToolCorrection>();
  paths.push_back(through(*tool, paths.back()));
  const auto loops = std::make_unique<LoopAvoider>();
  paths.push_back(through(*loops, paths.back()));
  const auto corners = std::make_unique<SmoothPath>();
  corners->kind = PieceKind::Quintic;
  corners->rule = DistanceRule::CornerDistanceAdded;
  paths.push_back(through(*corners, paths.back()));
  return paths;
}

void expectSame(const std::vector<PathObject> &path, const std::vector<PathObject> &other,
                const Symmetry &by) {
  ASSERT_EQ(other.size(), path.size());
  const double far = std::max(std::fabs(by.dx), std::fabs(by.dy)) + 100 * by.scale;
  const double tolerance = 1e-8 * by.scale + 1e-12 * far;
  for (size_t i = 0; i < path.size(); ++i) {
    const Place end = by.of({path[i].end.coordinate[kAxisX], path[i].end.coordinate[kAxisY]});
    ASSERT_EQ(other[i].moveType, by.of(path[i].moveType)) << i;
    ASSERT_NEAR(other[i].end.coordinate[kAxisX], end.x, tolerance) << i;
    ASSERT_NEAR(other[i].end.coordinate[kAxisY], end.y, tolerance) << i;
    if (i == 0) // the way from the machine's origin
      continue;
    ASSERT_NEAR(other[i].length, path[i].length * by.scale, tolerance) << i;
  }
}

TEST(Symmetry, PathsFollowTheirProgram) {
  for (unsigned seed = 1; seed <= 24; ++seed) {
    const Contour contour(seed);
    const auto paths = pathsOf(contour.text(kSame));
    for (const Symmetry &by : kOthers) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", scale " << by.scale << ", "
                                      << by.quarters << " quarters, mirrored " << by.mirrored);
      const auto others = pathsOf(contour.text(by));
      for (size_t stage = 0; stage < paths.size(); ++stage) {
        SCOPED_TRACE(stage);
        expectSame(paths[stage], others[stage], by);
      }
    }
  }
}

} // namespace
