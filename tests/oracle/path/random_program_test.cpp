// That random programs are what they say: without gaps, with true arcs, and with all that is hard.
#include "tests/oracle/path/random_program.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <stdexcept>

namespace {

using namespace stride::oracle;

constexpr uint64_t kSeeds = 400;

double apart(const Point &a, const Point &b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The tangent of an element at its start or end, by a short step.
Point tangent(const ChainElement &element, double from, double to) {
  const Place a = element.at(from);
  const Place b = element.at(to);
  const double size = distance(a, b, 3);
  return {(b[0] - a[0]) / size, (b[1] - a[1]) / size, (b[2] - a[2]) / size};
}

double turnBetween(const ChainElement &before, const ChainElement &after) {
  const Point a = tangent(before, 1 - 1e-6, 1);
  const Point b = tangent(after, 0, 1e-6);
  return 2 * std::asin(std::min(1.0, 0.5 * apart(a, b)));
}

TEST(RandomProgram, HasNoGapsAndTrueArcs) {
  for (uint64_t seed = 0; seed < kSeeds && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    ProgramOptions options;
    options.anyPlane = seed % 2 == 0;
    const RandomProgram program = randomProgram(seed, options);
    ASSERT_FALSE(program.moves.empty());
    Point place = program.moves.front().start;
    for (const ProgramMove &move : program.moves) {
      ASSERT_EQ(move.start, place);
      place = move.end;
      ASSERT_TRUE(move.velocity > 0 && move.acceleration > 0 && move.deceleration > 0);
      for (const double coordinate : move.end)
        ASSERT_TRUE(std::isfinite(coordinate));
      if (move.kind == MoveKind::Line) {
        ASSERT_NE(move.start, move.end);
        continue;
      }
      const double size = std::hypot(apart(move.end, {0, 0, 0}), apart(move.start, {0, 0, 0}));
      double climb = 0;
      double ahead = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        climb += (move.end[axis] - move.start[axis]) * move.normal[axis];
        ahead += (move.centre[axis] - move.start[axis]) * move.normal[axis];
      }
      const double radius = apart(move.start, move.centre);
      EXPECT_NEAR(apart({0, 0, 0}, move.normal), 1, 1e-15);
      EXPECT_NEAR(ahead, 0, 1e-14 * size);
      EXPECT_NEAR(apart(move.end, move.centre), std::hypot(radius, climb), 1e-13 * size);
    }
    const PathChain chain = chainOf(program.moves);
    ASSERT_EQ(chain.elements().size(), program.moves.size());
    for (size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(chain.end()[axis], place[axis]);
  }
}

TEST(RandomProgram, IsFlatIfWanted) {
  ProgramOptions options;
  options.flat = true;
  options.passages = 9;
  for (uint64_t seed = 0; seed < 100; ++seed)
    for (const ProgramMove &move : randomProgram(seed, options).moves) {
      ASSERT_TRUE(move.start[2] == 0 && move.end[2] == 0);
      ASSERT_TRUE(move.kind == MoveKind::Line || move.normal[2] == 1);
    }
}

TEST(RandomProgram, IsThatOfItsSeed) {
  const RandomProgram one = randomProgram(7);
  const RandomProgram same = randomProgram(7);
  const RandomProgram other = randomProgram(8);
  ASSERT_EQ(one.moves.size(), same.moves.size());
  for (size_t i = 0; i < one.moves.size(); ++i)
    EXPECT_EQ(one.moves[i].end, same.moves[i].end);
  EXPECT_NE(one.scale, other.scale);
}

TEST(RandomProgram, ArcsOfTangentPassagesAreTangential) {
  size_t looked = 0;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    ProgramOptions options;
    options.passages = 1;
    options.anyPlane = true;
    const RandomProgram program = randomProgram(seed, options);
    if (program.passages.front() != Passage::TangentArcs)
      continue;
    const PathChain chain = chainOf(program.moves);
    for (size_t i = 1; i < chain.elements().size(); ++i, ++looked)
      EXPECT_LT(turnBetween(chain.elements()[i - 1], chain.elements()[i]), 3e-5) << seed;
  }
  EXPECT_GT(looked, 50U);
}

/// All passages occur, and with them what makes paths hard.
TEST(RandomProgram, HasAllThatIsHard) {
  std::set<Passage> passages;
  std::map<std::string, int> found;
  double leastScale = 1e9;
  double greatestScale = 0;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const RandomProgram program = randomProgram(seed);
    passages.insert(program.passages.begin(), program.passages.end());
    leastScale = std::min(leastScale, program.scale);
    greatestScale = std::max(greatestScale, program.scale);
    const double velocity = program.axisVelocity[0];
    const double acceleration = program.axisAcceleration[0];
    found["jerk is all"] += acceleration * acceleration / program.jerk > 5 * velocity;
    found["jerk is nothing"] += acceleration * acceleration / program.jerk < 0.1 * velocity;
    const PathChain chain = chainOf(program.moves);
    const std::vector<ChainElement> &elements = chain.elements();
    for (size_t i = 1; i < elements.size(); ++i) {
      const double turn = turnBetween(elements[i - 1], elements[i]);
      found["reversal"] += turn > std::numbers::pi - 1e-6;
      found["cusp"] += turn > 3 && turn < std::numbers::pi - 1e-5;
      found["slight corner"] += turn > 1e-6 && turn < 1e-2;
      found["straight on"] += turn < 1e-7;
      const double ratio = elements[i].length / elements[i - 1].length;
      found["long after short"] += ratio > 1e4;
      found["short after long"] += ratio < 1e-4;
      found["full circle"] += elements[i].isArc && elements[i].start == elements[i].end;
      found["helix"] += elements[i].isArc && elements[i].start[2] != elements[i].end[2];
    }
  }
  EXPECT_EQ(passages.size(), static_cast<size_t>(kPassages));
  EXPECT_LT(leastScale, 2e-3);
  EXPECT_GT(greatestScale, 50);
  for (const auto &[what, times] : found)
    EXPECT_GT(times, 5) << what;
}

/// The text gives back every end and centre.
TEST(ProgramText, SaysEveryMove) {
  size_t lines = 0;
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const RandomProgram program = randomProgram(seed);
    std::istringstream text(gcodeOf(program.moves));
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line.front(), '%');
    auto move = program.moves.begin();
    while (std::getline(text, line)) {
      std::istringstream words(line);
      std::map<char, double> said;
      std::string one;
      std::string second;
      words >> one >> second;
      ASSERT_EQ(one.front(), 'N');
      for (std::string word; words >> word;)
        if (word[0] != 'E' || word[1] != '-')
          said[word.front()] = std::stod(word.substr(1));
      if (second == "G92" || second == "G17" || second == "G18" || second == "G19")
        continue;
      ASSERT_NE(move, program.moves.end());
      EXPECT_EQ(second == "G1", move->kind == MoveKind::Line);
      EXPECT_NEAR(said['X'], move->end[0], 1e-14);
      EXPECT_NEAR(said['Z'], move->end[2], 1e-14);
      EXPECT_NEAR(said['F'], move->velocity, 1e-14 * move->velocity + 1e-14);
      EXPECT_NEAR(said['E'], move->acceleration, 1e-14 * move->acceleration + 1e-14);
      if (second != "G1" && move->normal[2] != 0) {
        EXPECT_NEAR(said['I'], move->centre[0] - move->start[0], 1e-14);
      }
      ++move;
      ++lines;
    }
    EXPECT_EQ(move, program.moves.end());
  }
  EXPECT_GT(lines, 1000U);
}

TEST(ProgramText, IsReadBack) {
  const std::string file = testing::TempDir() + "stride_program_text.cnc";
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<ProgramMove> written = randomProgram(seed).moves;
    std::ofstream(file) << gcodeOf(written);
    const std::vector<ProgramMove> read = movesOf(file);
    ASSERT_EQ(read.size(), written.size());
    for (size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read[i].kind, written[i].kind);
      EXPECT_LT(apart(read[i].start, written[i].start),
                2e-15 + 1e-14 * apart(written[i].start, {}));
      EXPECT_NEAR(read[i].velocity, written[i].velocity, 1e-14 * (1 + written[i].velocity));
      if (read[i].kind != MoveKind::Line) {
        EXPECT_EQ(read[i].normal, written[i].normal);
        EXPECT_LT(apart(read[i].centre, written[i].centre),
                  1e-14 * (1 + apart(written[i].centre, {})));
      }
    }
  }
  std::remove(file.c_str());
  EXPECT_THROW(movesOf(file), std::runtime_error);
}

TEST(ProgramReader, TakesSentencesWithoutNumbersAndRefusesWhatItDoesNotKnow) {
  const std::string file = testing::TempDir() + "unnumbered.cnc";
  std::ofstream(file) << "% a\nG17\n\nN5\nG1 X30 F50\nG2 X40 Y10 I10\n";
  const std::vector<ProgramMove> moves = movesOf(file);
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[1].kind, MoveKind::Clockwise);
  EXPECT_EQ(moves[1].centre[0], 40);
  std::ofstream(file) << "% a\nG5 X1\n";
  EXPECT_THROW(movesOf(file), std::runtime_error);
  std::remove(file.c_str());
}

TEST(ProgramText, IsInTheLanguage) {
  const std::vector<ProgramMove> moves = {
      {MoveKind::Line, {0, 0, 1}, {2.5, -1e-20, 1e-7}, {}, {}, 100, 20, 30},
      {MoveKind::Clockwise, {2.5, 0, 0}, {3.5, 1, 0}, {2.5, 1, 0}, {0, 0, -1}, 100, 20, 30},
      {MoveKind::Clockwise, {3.5, 1, 0}, {4.5, 1, 1}, {4.5, 1, 0}, {0, 1, 0}, 0.5, 20, 30}};
  EXPECT_EQ(gcodeOf(moves), "% random\n"
                            "N10 G92 X0 Y0 Z1\n"
                            "N20 G1 X2.5 Y0 Z0.0000001 F100 E20 E-30\n"
                            "N30 G3 X3.5 Y1 Z0 I0 J1 F100 E20 E-30\n"
                            "N40 G18\n"
                            "N50 G2 X4.5 Y1 Z1 I1 K0 F0.5 E20 E-30\n");
}

} // namespace
