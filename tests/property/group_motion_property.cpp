// Groups that drive random movements with random arms.
#include "group_drive.hpp"

#include <cstdlib>

namespace {

using namespace stride::test;

TEST(GroupMotion, KeepsLimitsAndArrives) {
  const char *const only = std::getenv("STRIDE_GROUP_CASE");
  const int cases = wanted(100);
  const char *const parts = std::getenv("STRIDE_GROUP_PARTS");
  const int rarely = parts != nullptr ? std::atoi(parts) : 32;
  int failed = 0;
  int64_t looked = 0;
  int64_t corners = 0;
  for (int i = only != nullptr ? std::atoi(only) : 0; i < cases && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    const bool isOfCorners = i % 4 == 3;
    GroupDrive drive(1000U + static_cast<unsigned>(i), rarely, isOfCorners);
    drive.run(6);
    failed += drive.hasFailed() ? 1 : 0;
    looked += drive.looked();
    corners += drive.cornersLooked();
  }
  printf("%d of %d met an obstacle; the tool's path at %lld places, in corners at %lld\n", failed,
         cases, static_cast<long long>(looked), static_cast<long long>(corners));
  EXPECT_GE(looked, int64_t{1000} * cases);
  EXPECT_GE(corners, cases < 4 ? 0 : int64_t{100} * cases);
  EXPECT_LE(failed, cases / 5);
}

// An axis that goes along has the peak of its acceleration between two places that are looked at.
TEST(GroupMotion, SeesPeaksBetweenSamples) {
  GroupDrive drive(1935, 1, true);
  drive.run(6);
  EXPECT_FALSE(drive.hasFailed());
  EXPECT_GE(drive.cornersLooked(), 100);
}

} // namespace
