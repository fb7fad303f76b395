#include "runtime/task/statistics.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace {

using stride::task::Histogram;
using stride::task::TaskFigures;
using stride::task::TaskStatistics;

TEST(HistogramTest, EveryDurationIsInItsBucket) {
  std::mt19937_64 random(7);
  size_t last = 0;
  for (int64_t ns = 0; ns < 100000; ++ns) {
    const size_t bucket = Histogram::bucketOf(ns);
    ASSERT_LE(Histogram::lowerEnd(bucket), ns);
    ASSERT_GT(Histogram::lowerEnd(bucket + 1), ns);
    ASSERT_GE(bucket, last);
    last = bucket;
  }
  for (int i = 0; i < 100000; ++i) {
    const auto ns = static_cast<int64_t>(random() >> (24 + random() % 40));
    const size_t bucket = Histogram::bucketOf(ns);
    ASSERT_LT(bucket, Histogram::kBuckets);
    ASSERT_LE(Histogram::lowerEnd(bucket), ns);
    ASSERT_GT(Histogram::lowerEnd(bucket + 1), ns);
    // A bucket is at most 1/64 of its value wide.
    ASSERT_LE((Histogram::lowerEnd(bucket + 1) - Histogram::lowerEnd(bucket)) * 64,
              std::max<int64_t>(ns, 64));
  }
  EXPECT_EQ(Histogram::bucketOf(-5), 0U);
  EXPECT_EQ(Histogram::bucketOf(INT64_MAX), Histogram::kBuckets - 1);
}

TEST(HistogramTest, NoQuantileIsMoreThanTheGreatestRecord) {
  Histogram histogram;
  for (const int64_t ns : {1'000'003, 7, 1'000'001})
    histogram.record(ns);
  ASSERT_GT(Histogram::lowerEnd(Histogram::bucketOf(1'000'003) + 1), 1'000'004);
  EXPECT_EQ(histogram.quantile(0.99), 1'000'003);
  EXPECT_EQ(histogram.quantile(0.3), 7);
  histogram.clear();
  histogram.record(5);
  EXPECT_EQ(histogram.quantile(1.0), 5);
}

TEST(HistogramTest, QuantilesAreThoseOfTheSortedValues) {
  std::mt19937_64 random(11);
  Histogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), 0);
  std::vector<int64_t> values;
  for (int i = 0; i < 20000; ++i) {
    values.push_back(static_cast<int64_t>(random() % 1000000));
    histogram.record(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const double share : {0.001, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto index = static_cast<size_t>(share * 20000.0) - 1;
    const auto exact = static_cast<double>(values[index]);
    EXPECT_GE(static_cast<double>(histogram.quantile(share)), exact);
    EXPECT_LE(static_cast<double>(histogram.quantile(share)), exact * 65.0 / 64.0 + 1);
  }
  EXPECT_EQ(histogram.total(), 20000U);
}

TEST(HistogramTest, TheFirstAndTheLastBucketCount) {
  Histogram histogram;
  for (const int64_t ns : {int64_t{-5}, int64_t{0}, int64_t{0}})
    histogram.record(ns);
  EXPECT_EQ(histogram.total(), 3U);
  EXPECT_EQ(histogram.quantile(1.0), 0);
  histogram.record(INT64_MAX);
  EXPECT_EQ(histogram.total(), 4U);
  EXPECT_EQ(histogram.quantile(0.75), 0);
  EXPECT_EQ(histogram.quantile(0.76), Histogram::lowerEnd(Histogram::kBuckets) - 1);
  // What the records do not reach, because another thread clears them meanwhile, is the longest.
  EXPECT_EQ(histogram.quantile(1.01), Histogram::lowerEnd(Histogram::kBuckets) - 1);
  histogram.clear();
  EXPECT_EQ(histogram.total(), 0U);
}

TEST(TaskStatisticsTest, Figures) {
  TaskStatistics statistics;
  EXPECT_EQ(statistics.figures().minRunNs, 0);
  statistics.add({0, 5, 100});
  statistics.add({1000, 1020, 300});
  statistics.add({2000, 2001, 200});
  statistics.addOverruns(2);
  statistics.addWatchdogViolation();
  const TaskFigures f = statistics.figures();
  EXPECT_EQ(f.cycles, 3U);
  EXPECT_EQ(f.overruns, 2U);
  EXPECT_EQ(f.watchdogViolations, 1U);
  EXPECT_EQ(f.minRunNs, 100);
  EXPECT_EQ(f.maxRunNs, 300);
  EXPECT_EQ(f.meanRunNs(), 200);
  EXPECT_EQ(f.lastRunNs, 200);
  EXPECT_EQ(f.minIntervalNs, 981);
  EXPECT_EQ(f.maxIntervalNs, 1015);
  EXPECT_EQ(f.maxLatencyNs, 20);
}

} // namespace
