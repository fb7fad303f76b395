// CNC programs whose motions are cut, or become lines: the pieces lie on the old path.
#include "compiler/assets/cnc_edit/split.hpp"

#include "tests/unit/cnc_edit/edit_support.hpp"

#include <algorithm>
#include <cmath>

namespace stc::test {
namespace {

using stride::cnc::isMotion;
using stride::cnc::kAxisP;
using stride::cnc::test::lengthOf;
using stride::cnc::test::placeAt;
using stride::cnc::test::sizeOf;
using stride::cnc::test::tangentAt;

std::string split(const std::string &text, const CncSplit &how) {
  return edited(text, [&](const SourceFile &file, Diagnostics &diagnostics) {
    return splitCnc(file, how, diagnostics);
  });
}

std::string expand(const std::string &text, const CncExpansion &how) {
  return edited(text, [&](const SourceFile &file, Diagnostics &diagnostics) {
    return expandCnc(file, how, diagnostics);
  });
}

double angleBetween(const Point &a, const Point &b) {
  const Point up = stride::cnc::test::outer(a, b);
  return std::atan2(sizeOf(up), stride::cnc::test::inner(a, b)) * 180 / M_PI;
}

/// The place of a curve that is next to another place.
double distanceTo(const PathObject &object, const Point &place) {
  const auto at = [&](double part) { return between(placeAt(object, part), place); };
  constexpr int kPlaces = 100;
  int nearest = 0;
  for (int i = 1; i <= kPlaces; ++i)
    if (at(1.0 * i / kPlaces) < at(1.0 * nearest / kPlaces))
      nearest = i;
  double low = std::max(0.0, (nearest - 1.0) / kPlaces);
  double high = std::min(1.0, (nearest + 1.0) / kPlaces);
  for (int i = 0; i < 60; ++i) {
    const double third = (high - low) / 3;
    (at(low + third) < at(high - third) ? high : low) =
        at(low + third) < at(high - third) ? high - third : low + third;
  }
  return at(low);
}

/// One object of the old path, and what it has become.
struct Group {
  PathObject old;
  std::vector<PathObject> pieces;
};

/// Which objects of the new path belong to which old ones: pieces end where the old one does.
std::vector<Group> groupsOf(const std::string &text, const std::string &after) {
  const std::vector<PathObject> old = pathOf(text);
  const std::vector<PathObject> now = pathOf(after);
  std::vector<Group> groups;
  size_t at = 0;
  for (const PathObject &object : old) {
    Group group{object, {}};
    double left = isMotion(object) ? lengthOf(object, 300) : 0;
    do {
      if (at == now.size())
        break;
      group.pieces.push_back(now[at]);
      left -= isMotion(now[at]) ? lengthOf(now[at], 300) : 0;
      ++at;
    } while (left > 1e-3 * object.length && group.pieces.size() < 1000);
    groups.push_back(std::move(group));
  }
  EXPECT_EQ(at, now.size()) << text << after;
  return groups;
}

using Switches = std::vector<std::pair<int, double>>;

/// Switch points by their way from the start.
void addSwitches(const PathObject &object, double before, Switches &switches) {
  for (int i = 0; i < stride::cnc::kMostSwitches; ++i)
    if (object.switchId[i] != 0)
      switches.emplace_back(object.switchId[i], before + object.switchPosition[i] * object.length);
}

void expectSameSwitches(const Group &group, double tolerance, const std::string &text) {
  Switches old;
  Switches now;
  addSwitches(group.old, 0, old);
  double before = 0;
  for (const PathObject &piece : group.pieces) {
    addSwitches(piece, before, now);
    before += piece.length;
  }
  const auto less = [](const auto &a, const auto &b) {
    return std::pair(a.second, a.first) < std::pair(b.second, b.first);
  };
  std::sort(old.begin(), old.end(), less);
  std::sort(now.begin(), now.end(), less);
  ASSERT_EQ(old.size(), now.size()) << text;
  for (size_t i = 0; i < old.size(); ++i) {
    EXPECT_EQ(old[i].first, now[i].first) << text;
    EXPECT_NEAR(old[i].second, now[i].second, tolerance) << text;
  }
}

void expectSameModes(const Group &group, const std::string &text) {
  for (const PathObject &piece : group.pieces) {
    EXPECT_EQ(piece.velocity, group.old.velocity) << text;
    EXPECT_EQ(piece.acceleration, group.old.acceleration) << text;
    EXPECT_EQ(piece.deceleration, group.old.deceleration) << text;
    EXPECT_EQ(piece.features, group.old.features) << text;
    EXPECT_EQ(piece.toolRadius, group.old.toolRadius) << text;
  }
  EXPECT_NEAR(group.pieces.back().end.coordinate[kAxisP], group.old.end.coordinate[kAxisP], 1e-9);
}

TEST(CncSplit, RandomPathsStayInPieces) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const std::string text = RandomProgram(seed, true).text(8);
    CncSplit how;
    how.length = 0.5 + 0.25 * (seed % 40);
    const std::string after = split(text, how);
    ASSERT_FALSE(after.starts_with("SE")) << text << after;
    for (const Group &group : groupsOf(text, after)) {
      const std::string texts = text + after;
      ASSERT_FALSE(group.pieces.empty()) << texts;
      if (group.old.moveType == MoveType::Function) {
        EXPECT_EQ(group.pieces[0].switchId[0], group.old.switchId[0]);
        EXPECT_NEAR(group.pieces[0].end.coordinate[0], group.old.end.coordinate[0], 1e-9);
        continue;
      }
      if (!isMotion(group.old))
        continue;
      const double length = group.old.length;
      const bool whole = group.old.moveType == MoveType::Positioning;
      EXPECT_EQ(group.pieces.size(),
                whole ? 1 : std::max(1.0, std::ceil(length / how.length - 1e-9)))
          << texts;
      for (const PathObject &piece : group.pieces) {
        EXPECT_EQ(piece.moveType, group.old.moveType) << texts;
        if (!whole) {
          EXPECT_LT(piece.length, how.length * (1 + 1e-9)) << texts;
        }
        for (const double part : {0.0, 0.3, 0.8, 1.0})
          ASSERT_LT(distanceTo(group.old, placeAt(piece, part)), 1e-9) << texts;
      }
      expectSameModes(group, texts);
      expectSameSwitches(group, 1e-6, texts);
      if (HasFatalFailure())
        return;
    }
  }
}

TEST(CncSplit, OneObjectAsTheManualShowsIt) {
  CncSplit how{10, 0.5, 0};
  EXPECT_EQ(split("G1 X0 Y30 F1\nN10 G01 X40.0 Y50.0 (c)\nN20 G01 X123.0 Y73.55\n", how),
            "G1 X0 Y30 F1\nN10 G01 X20 Y40 (c)\nG1 X40 Y50\nN20 G01 X123.0 Y73.55\n");
  how.at = 0.25;
  EXPECT_EQ(split("N10 G91 \r\nN10G1X8F1", how), "SE0892 1:1: this sentence moves nothing");
  how.sentence = 3; // by its line
  EXPECT_EQ(split("G91 F1\r\nG1 X8\r\n\tY4P2H1L3 F2", how),
            "G91 F1\r\nG1 X8\r\n\tY1P0.5 F2\r\n\tG1 Y3 P1.5 H1 L2");
  how = {3, 0.5, 0};
  EXPECT_EQ(split("G0 X10 F1\n/N3 G2 I-10 E500 (full)\n", how),
            "G0 X10 F1\n/N3 G2 I-10 X-10 E500 (full)\n/G2 X10 I10\n");
  EXPECT_EQ(split("G54 X5\nG98\nN3 G3 T90 I10 J0 F1\n", how).substr(0, 61),
            "G54 X5\nG98\nN3 G3 I10 J0 X-0.606601717798 Y-10.606601717798 F1");
}

TEST(CncSplit, LimitsOfLengthAreKept) {
  const std::string text = "G1 X12 F1\n";
  EXPECT_EQ(split(text, {0, 0.5, 12}), text);
  EXPECT_EQ(split(text, {0, 0.5, 12.0000001}), text);
  EXPECT_EQ(split(text, {0, 0.5, 11.9999999}), "G1 X6 F1\nG1 X12\n");
  EXPECT_EQ(split(text, {0, 0.5, 4}), "G1 X4 F1\nG1 X8\nG1 X12\n");
  EXPECT_EQ(split(text, {0, 0.5, 1e-9}), "SE0892 1:1: this motion would have too many pieces");
}

TEST(CncSplit, LoopsAreCutWhereAllRoundsAgree) {
  EXPECT_EQ(split("G36 D3\nG91\nN1 G1 X8 F1\nG37 D-1\nG20 L1\n", {1, 0.5, 0}),
            "G36 D3\nG91\nN1 G1 X4 F1\nG1 X4\nG37 D-1\nG20 L1\n");
  EXPECT_EQ(split("G36 D3\nN1 G1 X8 F1\nX9\nG37 D-1\nG20 L1\n", {1, 0.5, 0}),
            "SE0892 2:1: this motion is another one in each round");
  EXPECT_EQ(split("G91\nN1 G1 X8 F1\nG20 L1 K1\n", {1, 0.5, 0}), // for ever
            "G91\nN1 G1 X4 F1\nG1 X4\nG20 L1 K1\n");
}

TEST(CncSplit, WhatCannotBeCutIsRefused) {
  const auto says = [](const std::string &text, const std::string &what) {
    EXPECT_EQ(split(text, {1, 0.5, 0}), "SE0892 " + what) << text;
  };
  says("N2 G1 X5 F1\n(N1)\n", "1:1: there is no sentence 1");
  says("N1 G5 X5 Y5 F1\n", "1:1: a spline cannot be cut");
  says("N1 G31 X5 F1\n", "1:1: a motion that a probe ends cannot be cut");
  says("N1 G1 X$a$ F1\n", "1:7: a variable says this value, which would have to change");
  says("G1 X$a$ F1\nN1 X5\n", "2:1: where this motion begins depends on a variable");
  says("G20 L1 K$a$\nN1 G1 X5\n", "1:8: a variable decides about this jump");
  says("N1 G1 X0 F1\n", "1:1: this motion cannot be cut");
  says("N1 G1 X5 Z7 S3 F1\n", "1:1: an axis goes in an S over all of this motion");
  says("G54 A5\nN1 G1 X5 F1\n", "1:5: the program may turn or scale its coordinates");
  says("G54 X$a$\nN1 G1 X5 F1\n", "1:5: a variable says where the coordinates begin");
  says("G1 X{1}\n", "1:1: programs with expressions and subprograms cannot be changed");
  EXPECT_EQ(split("N1 G20 L9 K1\nG1 X5\nN9 G1 X7 F1\n", {0, 0.5, 1}),
            "SE0892 2:1: this sentence is never reached");
  // What a variable says elsewhere does not matter.
  EXPECT_EQ(split("G1 X$a$ F$f$\nG91\nN1 Y8\nM3 K$k$\n", {1, 0.5, 0}),
            "G1 X$a$ F$f$\nG91\nN1 Y4\nG1 Y4\nM3 K$k$\n");
}

bool isExpanded(const PathObject &object) {
  return object.moveType == MoveType::Spline || object.moveType == MoveType::Spline3d ||
         stride::cnc::isEllipse(object.moveType);
}

TEST(CncExpand, RandomCurvesBecomeLines) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const std::string text = RandomProgram(seed, false).text(8);
    CncExpansion how;
    (seed % 2 == 0 ? how.length : how.angle) =
        seed % 2 == 0 ? 1 + 0.125 * (seed % 30) : 2.0 + seed % 30;
    const std::string after = expand(text, how);
    ASSERT_FALSE(after.starts_with("SE")) << text << after;
    const std::vector<PathObject> now = pathOf(after);
    size_t at = 0;
    for (const PathObject &old : pathOf(text)) {
      ASSERT_LT(at, now.size());
      if (!isExpanded(old)) {
        EXPECT_EQ(now[at].moveType, old.moveType) << text << after;
        EXPECT_EQ(now[at].velocity, old.velocity) << text << after;
        ++at;
        continue;
      }
      Group group{old, {}};
      const Point end = stride::cnc::test::endOf(old);
      do
        group.pieces.push_back(now[at]);
      while (between(stride::cnc::test::endOf(now[at++]), end) > 1e-8 && at < now.size());
      Point before = tangentAt(old, 0);
      for (size_t i = 0; i < group.pieces.size(); ++i) {
        const PathObject &piece = group.pieces[i];
        ASSERT_EQ(piece.moveType, MoveType::Line) << text << after;
        EXPECT_LT(distanceTo(old, placeAt(piece, 1)), 2e-9) << text << after;
        const Point direction = stride::cnc::test::operator-(placeAt(piece, 1), placeAt(piece, 0));
        if (how.angle > 0 && i > 0) {
          EXPECT_LT(angleBetween(before, direction), how.angle) << text << after;
        }
        before = direction;
      }
      if (how.length > 0) {
        EXPECT_EQ(group.pieces.size(), std::max(1.0, std::ceil(old.length / how.length - 1e-9)));
        for (const PathObject &piece : group.pieces)
          EXPECT_LT(piece.length, how.length * (1 + 1e-9));
      }
      expectSameModes(group, text + after);
      if (HasFatalFailure())
        return;
    }
    EXPECT_EQ(at, now.size()) << text << after;
  }
}

TEST(CncExpand, AFullTurnNeedsItsAngles) {
  // Half of an ellipse that is nearly a circle: chords of equal turns.
  const std::string text = "G9 X-10 I-5 R1 F1 (half)\nX-20 I-5 R1\nG1 Y5\n";
  const auto count = [&](double angle) {
    const std::string after = expand(text, {0, angle});
    return std::count(after.begin(), after.end(), '\n');
  };
  EXPECT_EQ(count(180), 2 + 2 + 1); // one line would double back beside the next one
  EXPECT_GE(count(90), 2 + 2 + 1);
  EXPECT_GE(count(30), 6 + 6 + 1);
  EXPECT_LE(count(30), 7 + 7 + 1);
}

TEST(CncExpand, TheRestStays) {
  EXPECT_EQ(
      expand("G1 X5 F1\nN2 G6 X10 Y0 I2.5 J5 H1 O0.75 E900 (c)\nX15 I2.5 J-5\nX16 G1\n", {6, 0})
          .substr(0, 40),
      "G1 X5 F1\nN2 G1 X7.5 Y2.5 E900 (c)\nG1 X10");
  const std::string none = "G1 X5 F1\nG2 I3\n";
  EXPECT_EQ(expand(none, {1, 0}), none);
  // A spline that is a line.
  EXPECT_EQ(expand("G5 X5 F1\n", {1, 0}), "G1 X5 F1\n");
}

TEST(CncExpand, VariablesAreRefused) {
  EXPECT_EQ(expand("G1 X1 F1\nG5 X2 Y5\nX$a$ Y9\nG1 X0\n", {1, 0}),
            "SE0892 3:1: the shape of a spline depends on this variable");
  EXPECT_EQ(expand("G1 X1 F1\nG5 X2 Y5\nG1 X$a$\n", {1, 0}),
            "SE0892 3:4: the shape of a spline depends on this variable");
  EXPECT_EQ(expand("G1 X$a$ F1\nG8 X-10 I-5 R0.5\n", {1, 0}),
            "SE0892 2:1: the shape of this curve depends on variables");
  EXPECT_EQ(expand("G8 X-10 I-5 R0.5 F1\n", {1e-6, 0}),
            "SE0892 1:1: this curve would become too many lines");
}

} // namespace
} // namespace stc::test
