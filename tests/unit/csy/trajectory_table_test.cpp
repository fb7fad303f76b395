// Reading the table of words of a path.
#include "runtime/numeric/csy/trajectory_table.hpp"

#include "path_words.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace {

using namespace stride::csy;
using stride::test::PathPoint;
using stride::test::pathWords;

struct Reading {
  std::unique_ptr<TrajectoryTable> table = std::make_unique<TrajectoryTable>();
  Problem problem;
};

Reading reading(const std::vector<int16_t> &words, uint32_t most = kMostPoints) {
  Reading result;
  result.problem =
      readTable(words.data(), static_cast<uint32_t>(words.size()), most, *result.table);
  return result;
}

TEST(CsyTable, HasTheLengthOfTheManual) {
  EXPECT_EQ(lengthOfTable(2, 5), 93U);
  EXPECT_EQ(lengthOfTable(3, 5), 104U);
  EXPECT_EQ(lengthOfTable(3, 7), 142U);
  EXPECT_EQ(pathWords(std::vector<PathPoint>(5), 2).size(), 93U);
  EXPECT_EQ(pathWords(std::vector<PathPoint>(5), 3).size(), 104U);
}

TEST(CsyTable, ReadsEveryFieldOfTwoAndThreeAxes) {
  const PathPoint second{1.5F, -2.25F, 77.0F, 10, 3, 17, 120, 257, 4.5F, 5.5F, -6.5F, 88.25F};
  for (const int axes : {2, 3}) {
    const Reading result = reading(pathWords({PathPoint{}, second}, axes));
    ASSERT_EQ(result.problem.error, PathError::None);
    EXPECT_EQ(result.table->points, 2U);
    EXPECT_EQ(result.table->axes, static_cast<uint32_t>(axes));
    EXPECT_EQ(result.table->axisIds[1], 2);
    EXPECT_EQ(result.table->axisIds[2], axes == 3 ? 3 : 0);
    const TablePoint &point = result.table->point[1];
    EXPECT_EQ(point.position.x, 1.5);
    EXPECT_EQ(point.position.y, -2.25);
    EXPECT_EQ(point.position.z, axes == 3 ? 77.0 : 0.0);
    EXPECT_EQ(point.speed, 88.25);
    EXPECT_EQ(point.parF[0], 4.5);
    EXPECT_EQ(point.parF[1], 5.5);
    EXPECT_EQ(point.parF[2], -6.5);
    EXPECT_EQ(point.type, 10);
    EXPECT_EQ(point.parW[0], 3);
    EXPECT_EQ(point.parW[1], 17);
    EXPECT_EQ(point.parW[2], 120);
    EXPECT_EQ(point.parW[3], 257);
  }
}

TEST(CsyTable, RefusesHeaders) {
  const auto spoiled = [](size_t word, int16_t value) {
    std::vector<int16_t> words = pathWords(std::vector<PathPoint>(5));
    words[word] = value;
    return reading(words).problem.error;
  };
  EXPECT_EQ(spoiled(0, 0), PathError::NoPoints);
  EXPECT_EQ(spoiled(0, -1), PathError::TooManyPoints);
  EXPECT_EQ(spoiled(0, 6), PathError::WordsPerPoint); // there are words for 5
  EXPECT_EQ(spoiled(0, 4), PathError::None);
  EXPECT_EQ(spoiled(1, 4), PathError::TooManyAxes);
  EXPECT_EQ(spoiled(1, 1), PathError::TooManyAxes);
  EXPECT_EQ(spoiled(1, 3), PathError::WordsPerPoint);
  EXPECT_EQ(spoiled(2, 16), PathError::WordsPerPoint);
  EXPECT_EQ(spoiled(2, 19), PathError::WordsPerPoint);
  EXPECT_EQ(reading({1, 2, 17, 0, 0}).problem.error, PathError::WordsPerPoint);
  EXPECT_EQ(reading({}).problem.error, PathError::WordsPerPoint);
}

TEST(CsyTable, TakesAsManyPointsAsTheFirmware) {
  const auto error = [](size_t points, uint32_t most) {
    return reading(pathWords(std::vector<PathPoint>(points)), most).problem.error;
  };
  EXPECT_EQ(error(200, kMostPoints), PathError::None);
  EXPECT_EQ(error(201, kMostPoints), PathError::TooManyPoints);
  EXPECT_EQ(error(60, kMostPointsOfOldFirmware), PathError::None);
  EXPECT_EQ(error(61, kMostPointsOfOldFirmware), PathError::TooManyPoints);
}

} // namespace
