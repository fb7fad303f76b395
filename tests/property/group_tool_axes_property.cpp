// Groups that drive random movements on which the tool axes go evenly (OrientationMode.Axis),
// through wrists in line, too; corners between them, and to other movements.
#include "group_drive.hpp"

#include <cstdlib>

namespace {

using namespace stride::test;

TEST(GroupToolAxes, GoEvenlyWithinLimits) {
  const char *const only = std::getenv("STRIDE_GROUP_CASE");
  const int cases = wanted(40);
  const char *const parts = std::getenv("STRIDE_GROUP_PARTS");
  const int rarely = parts != nullptr ? std::atoi(parts) : 32;
  int failed = 0;
  int64_t looked = 0;
  int64_t inLine = 0;
  for (int i = only != nullptr ? std::atoi(only) : 0; i < cases && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    GroupDrive drive(5000U + static_cast<unsigned>(i), rarely, i % 2 == 1, true);
    drive.run(6);
    failed += drive.hasFailed() ? 1 : 0;
    looked += drive.givenLooked();
    inLine += drive.inLine();
  }
  printf("%d of %d met an obstacle; %lld places, %lld times through a wrist in line\n", failed,
         cases, static_cast<long long>(looked), static_cast<long long>(inLine));
  EXPECT_GE(looked, int64_t{300} * cases);
  EXPECT_GE(inLine, cases < 12 ? 0 : cases / 4);
  EXPECT_LE(failed, cases / 5);
}

} // namespace
