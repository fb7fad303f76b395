#include "compiler/project/job_pool.hpp"

#include <gtest/gtest.h>

namespace stc {
namespace {

TEST(JobPool, RunsAllAndKeepsTheirOutputApart) {
  std::vector<Job> jobs;
  for (int i = 0; i < 9; ++i)
    jobs.push_back({{"sh", "-c", "echo out " + std::to_string(i) + "; echo err >&2"}, "job"});
  const std::vector<JobResult> results = runJobs(jobs);
  for (size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].status, 0);
    EXPECT_EQ(results[i].output, "out " + std::to_string(i) + "\nerr\n");
  }
}

TEST(JobPool, ReportsExitCodesAndSignals) {
  EXPECT_EQ(runJobs({{{"sh", "-c", "exit 3"}, "job"}})[0].status, 3);
  EXPECT_EQ(runJobs({{{"sh", "-c", "kill -TERM $$"}, "job"}})[0].status, 128 + 15);
  EXPECT_EQ(runJobs({{{"/nowhere/at/all"}, "job"}})[0].status, 127);
}

TEST(JobPool, TakesMoreOutputThanAPipeHolds) {
  const std::vector<JobResult> results =
      runJobs({{{"sh", "-c", "head -c 300000 /dev/zero"}, "job"}});
  EXPECT_EQ(results[0].output.size(), 300'000U);
}

TEST(JobPool, StartsNothingAfterAFailure) {
  std::vector<Job> jobs(50, Job{{"false"}, "job"});
  size_t started = 0;
  for (const JobResult &result : runJobs(jobs, [&](size_t) { ++started; }))
    EXPECT_NE(result.status, 0);
  EXPECT_LT(started, jobs.size());
}

TEST(JobPool, QuotesForTheShell) {
  EXPECT_EQ(shellQuoted({"g++", "-I", "a b", "it's", ""}), "g++ -I 'a b' 'it'\\''s' ''");
}

} // namespace
} // namespace stc
