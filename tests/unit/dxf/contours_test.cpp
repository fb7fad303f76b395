// What belongs together becomes one contour; contours come in a good order.
#include "tests/unit/dxf/drawing_support.hpp"

namespace stc::test {
namespace {

double number(std::mt19937 &random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}

/// A ring of lines and arcs around a place, as single entities in any order and direction, whose
/// ends are off by some way.
std::string brokenRing(std::mt19937 &random, Spot centre, double size, double off) {
  const int count = std::uniform_int_distribution(3, 9)(random);
  std::vector<Spot> spots;
  for (int i = 0; i < count; ++i) {
    const double r = size * number(random, 0.7, 1);
    const double a = 2 * M_PI * i / count;
    spots.push_back({centre[0] + r * std::cos(a), centre[1] + r * std::sin(a)});
  }
  std::vector<std::string> entities;
  for (size_t i = 0; i < spots.size(); ++i) {
    Spot a = spots[i];
    Spot b = spots[(i + 1) % spots.size()];
    for (Spot *spot : {&a, &b}) {
      const double turn = number(random, 0, 2 * M_PI);
      *spot = {(*spot)[0] + off / 2 * std::cos(turn), (*spot)[1] + off / 2 * std::sin(turn)};
    }
    const bool backwards = random() % 2 == 0;
    if (random() % 2 == 0) {
      entities.push_back("0\nLINE\n8\n0\n" + place(10, backwards ? b : a) +
                         place(11, backwards ? a : b));
      continue;
    }
    const double bulge = number(random, -0.3, 0.3);
    entities.push_back("0\nLWPOLYLINE\n8\n0\n70\n0\n" + place(10, backwards ? b : a) +
                       group(42, backwards ? -bulge : bulge) + place(10, backwards ? a : b));
  }
  std::shuffle(entities.begin(), entities.end(), random);
  std::string text;
  for (const std::string &one : entities)
    text += one;
  return text;
}

TEST(DxfContours, EndsWithinEpsilonAreJoined) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    DxfImport how;
    how.epsilon = seed % 3 == 0 ? 0.05 : 0.001;
    const double off = how.epsilon * 0.99;
    const std::string text =
        drawingOf(brokenRing(random, {7, -3}, 30, off) + brokenRing(random, {80, 20}, 25, off));
    const Imported result = import(text, how);
    ASSERT_EQ(result.error, "") << text;
    EXPECT_EQ(result.programs.at(0).contours, 2U) << text;
    EXPECT_EQ(result.programs[0].closed, 2U) << text;
    // The path is in one piece, and ends where it began.
    const std::vector<PathObject> path = pathOf(result.programs[0].text);
    size_t begins = 0;
    for (size_t i = 0; i < path.size(); ++i) {
      if (path[i].moveType != MoveType::Positioning)
        continue;
      if (i != 0) {
        EXPECT_EQ(path[i - 1].end.coordinate[0], path[begins].end.coordinate[0]);
        EXPECT_EQ(path[i - 1].end.coordinate[1], path[begins].end.coordinate[1]);
      }
      begins = i;
    }
    // No place is off by more than the gap that was closed.
    how.epsilon = 1e-6;
    const Imported exact = import(text, how);
    EXPECT_GT(exact.programs.at(0).contours, 2U);
    expectSame(curvesOf(path), curvesOf(pathOf(exact.programs[0].text)), off + 1e-4, text);
    if (HasFatalFailure())
      return;
  }
}

TEST(DxfContours, GapsOfMoreThanEpsilonStay) {
  const auto contours = [](double gap, double epsilon) {
    DxfImport how;
    how.epsilon = epsilon;
    return import(drawingOf(fmt::format("0\nLINE\n8\n0\n10\n0\n20\n0\n11\n5\n21\n0\n0\nLINE\n8\n0\n"
                                        "10\n{}\n20\n0\n11\n9\n21\n4\n",
                                        5 + gap)),
                  how)
        .programs.at(0)
        .contours;
  };
  EXPECT_EQ(contours(0.0999, 0.1), 1U);
  EXPECT_EQ(contours(0.1001, 0.1), 2U);
}

TEST(DxfContours, WhereSeveralMeetTheStraightestGoesOn) {
  const std::string text = drawingOf(
      "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n5\n21\n0\n0\nLINE\n8\n0\n10\n5\n20\n0\n11\n5\n21\n"
      "4\n0\nLINE\n8\n0\n10\n9\n20\n0.5\n11\n5\n21\n0\n");
  EXPECT_EQ(import(text).programs.at(0).text,
            "% a.dxf\nN10 G17\nN20 G0 X0 Y0\nN30 G1 X5 Y0\nN40 G1 X9 Y0.5\nN50 G0 X5 Y0\n"
            "N60 G1 X5 Y4\n");
}

/// Entities apart from each other: the travel is never longer than in the order of the drawing.
TEST(DxfContours, TravelIsNeverLongerThanDrawn) {
  double all = 0;
  double drawn = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const RandomDrawing drawing(seed, 1);
    DxfImport how;
    how.start[0] = 3.0 * seed;
    how.start[1] = -5;
    const Imported result = import(drawing.text(), how);
    ASSERT_EQ(result.programs.size(), 1U);
    const DxfProgram &program = result.programs[0];
    EXPECT_LE(program.travel, program.drawnTravel * (1 + 1e-12));
    all += program.travel;
    drawn += program.drawnTravel;
    // It is what the program has.
    double travel = 0;
    Spot here{how.start[0], how.start[1]};
    for (const PathObject &object : pathOf(program.text)) {
      const Spot end{object.end.coordinate[0], object.end.coordinate[1]};
      if (object.moveType == MoveType::Positioning)
        travel += away(here, end);
      here = end;
    }
    EXPECT_NEAR(travel, program.travel, 1e-6);
  }
  EXPECT_LT(all, 0.75 * drawn);
}

TEST(DxfContours, TheOrderOfAGridIsNearlyTheBest) {
  // 400 holes with a distance of 10: no order is shorter than 399 · 10 less the holes' widths.
  std::vector<std::string> holes;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y)
      holes.push_back(fmt::format("0\nCIRCLE\n8\n0\n10\n{}\n20\n{}\n40\n1\n", 10 * x, 10 * y));
  std::mt19937 random(5);
  std::shuffle(holes.begin(), holes.end(), random);
  std::string text;
  for (const std::string &hole : holes)
    text += hole;
  const Imported result = import(drawingOf(text));
  EXPECT_LT(result.programs.at(0).travel, 1.25 * 3990);
  EXPECT_GT(result.programs[0].drawnTravel, 20000);
  EXPECT_EQ(import(drawingOf(text)).programs[0].text, result.programs[0].text);
}

struct Ring {
  Spot centre;
  double radius;
};

/// Circles within circles: some rings with rings in them.
std::vector<Ring> nestedRings(std::mt19937 &random) {
  std::vector<Ring> rings;
  const std::function<void(Ring, int)> fill = [&](const Ring &outer, int depth) {
    rings.push_back(outer);
    if (depth == 0)
      return;
    for (const double side : {-0.5, 0.5})
      if (random() % 4 != 0)
        fill({{outer.centre[0] + side * outer.radius, outer.centre[1] + 0.1 * outer.radius},
              outer.radius * number(random, 0.2, 0.35)},
             depth - 1);
  };
  for (int i = 0; i < 3; ++i)
    fill({{100.0 * i, number(random, -50, 50)}, 40}, 3);
  std::shuffle(rings.begin(), rings.end(), random);
  return rings;
}

std::string circlesOf(const std::vector<Ring> &rings) {
  std::string text;
  for (const Ring &ring : rings)
    text += "0\nCIRCLE\n8\n0\n" + place(10, ring.centre) + group(40, ring.radius);
  return drawingOf(text);
}

TEST(DxfContours, InsideComesFirst) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const std::vector<Ring> rings = nestedRings(random);
    DxfImport how;
    how.insideFirst = true;
    const Imported result = import(circlesOf(rings), how);
    std::vector<Ring> order;
    for (const PathObject &object : pathOf(result.programs.at(0).text))
      if (isCut(object))
        order.push_back({{object.shape[0], object.shape[1]}, object.shape[2]});
    ASSERT_EQ(order.size(), rings.size());
    for (size_t i = 0; i < order.size(); ++i)
      for (size_t j = i + 1; j < order.size(); ++j)
        EXPECT_FALSE(away(order[i].centre, order[j].centre) < order[i].radius - order[j].radius)
            << "seed " << seed;
    EXPECT_LE(result.programs[0].travel, result.programs[0].drawnTravel * (1 + 1e-12));
  }
}

/// The tool is outside of the outermost rings and inside of those within them, and so on.
TEST(DxfContours, TheToolIsOnTheSideOfTheWaste) {
  for (const DxfTool tool : {DxfTool::Left, DxfTool::Right}) {
    std::mt19937 random(3);
    const std::vector<Ring> rings = nestedRings(random);
    DxfImport how;
    how.tool = tool;
    how.toolRadius = 0.15;
    how.leadIn = 0.25;
    const Imported result = import(circlesOf(rings), how);
    EXPECT_TRUE(result.warnings.empty());
    const std::vector<PathObject> path = pathOf(result.programs.at(0).text);
    size_t seen = 0;
    for (size_t i = 2; i < path.size(); ++i) {
      const PathObject &object = path[i];
      if (!isCircle(object.moveType))
        continue;
      ++seen;
      const Spot centre{object.shape[0], object.shape[1]};
      const auto around = std::count_if(rings.begin(), rings.end(), [&](const Ring &ring) {
        return away(ring.centre, centre) < ring.radius - object.shape[2] - 1e-6;
      });
      const bool outside = around % 2 == 0;
      const bool clockwise = object.moveType == MoveType::Clockwise;
      EXPECT_EQ(clockwise, outside == (tool == DxfTool::Left));
      // The lead-in begins there, straight beside the contour.
      const PathObject &in = path[i - 1];
      const Spot from{in.start.coordinate[0], in.start.coordinate[1]};
      EXPECT_NEAR(away(from, centre), object.shape[2] + (outside ? 0.25 : -0.25), 1e-8);
      EXPECT_NEAR(in.length, 0.25, 1e-8);
      EXPECT_EQ(in.toolRadius, 0.15);
    }
    EXPECT_EQ(seen, rings.size());
  }
}

/// Loops are looked for after the lead-in: with it the whole contour would be one, as it ends where
/// the lead-in does.
TEST(DxfContours, LoopsBeginAfterTheLeadIn) {
  DxfImport how;
  how.tool = DxfTool::Right;
  how.toolRadius = 0.5;
  how.leadIn = 2;
  how.avoidLoops = true;
  how.on = {"H1"};
  how.off = {"H-1"};
  EXPECT_EQ(import(circlesOf({{{10, 0}, 6}}), how).programs.at(0).text,
            "% a.dxf\nN10 G17\nN20 G0 X2 Y0\nN30 G42 D0.5\nN40 G1 X4 Y0 H1 L0\nN50 G61\n"
            "N60 G3 I6 J0 H-1 O1\nN70 G60\nN80 G40\n");
}

TEST(DxfContours, ALeadInMeetsNoContour) {
  // Outside of 11, inside of 10, outside of 8: between the last two a lead-in of 3 has no room, and
  // one of 1.5 has.
  DxfImport how;
  how.tool = DxfTool::Left;
  how.leadIn = 3;
  const Imported result = import(circlesOf({{{0, 0}, 10}, {{0, 0}, 11}, {{0, 0}, 8}}), how);
  EXPECT_TRUE(result.warnings.empty());
  std::vector<double> from;
  for (const PathObject &object : pathOf(result.programs.at(0).text))
    if (object.moveType == MoveType::Line)
      from.push_back(std::hypot(object.start.coordinate[0], object.start.coordinate[1]));
  std::sort(from.begin(), from.end());
  ASSERT_EQ(from.size(), 3U);
  EXPECT_NEAR(from[0], 8.5, 1e-8);
  EXPECT_NEAR(from[1], 9.5, 1e-8);
  EXPECT_NEAR(from[2], 14, 1e-8);
}

TEST(DxfContours, FunctionsAndDepthStandAroundEachContour) {
  DxfImport how;
  how.feed = 20;
  how.words = "E500 E-400";
  how.safeZ = 5;
  how.depth = -1.5;
  how.plungeFeed = 4;
  how.on = {"M3 K6000", "H1"};
  how.off = {"M5", "H-1"};
  how.start[1] = -2.5;
  how.back = true;
  EXPECT_EQ(import(drawingOf("0\nLINE\n8\nCut (1)\n10\n3\n20\n0\n11\n7\n21\n2\n"), how)
                .programs.at(0)
                .text,
            "% a.dxf\nN10 G17\nN20 G0 Z5 F20 E500 E-400\nN30 G0 X3 Y0 (Cut  1 )\nN40 M3 K6000\n"
            "N50 G1 Z-1.5 F4\nN60 G1 X7 Y2 F20 H1 L0 H-1 O1\nN70 G0 Z5\nN80 M5\nN90 G0 X0 Y-2.5\n");
  how = {};
  how.words = "X5X";
  EXPECT_EQ(
      import(drawingOf("0\nLINE\n8\n0\n10\n3\n20\n0\n11\n7\n21\n2\n"), how).error.substr(0, 35),
      "SE0882 0: the program would be wron");
}

} // namespace
} // namespace stc::test
