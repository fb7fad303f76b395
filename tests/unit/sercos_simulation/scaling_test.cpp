// What a unit on the ring is worth, by hand.
#include "drivers/sercos/simulation/drive_scaling.hpp"

#include "tests/unit/sercos_simulation/ring_master.hpp"

namespace stride::sercos::simulation {
namespace {

struct Scaled {
  Scaled() : drive(plainDrive()) {}
  void set(Idn idn, int64_t value) { drive.list().at(idn).value = value; }
  DriveScaling scaling() {
    DriveScaling result(4096, 2e6);
    result.configure(drive.list());
    return result;
  }
  SimulatedDrive drive;
};

TEST(SercosScaling, Velocities) {
  Scaled s;
  s.set(44, 0);
  EXPECT_DOUBLE_EQ(s.scaling().velocity(), 1);
  s.set(44, 0x02); // 0.0001 turns in a minute
  EXPECT_DOUBLE_EQ(s.scaling().velocity(), 0.0001 / 60 * 4096);
  s.set(44, 0x22); // 0.000001 turns in a second
  EXPECT_DOUBLE_EQ(s.scaling().velocity(), 0.004096);
  s.set(44, 0x01); // 0.000001 m in a minute
  EXPECT_NEAR(s.scaling().velocity(), 2.0 / 60, 1e-15);
  s.set(44, 0x29);
  s.set(45, 3);
  s.set(46, -5); // 30 µm in a second
  EXPECT_NEAR(s.scaling().velocity(), 60, 1e-9);
  s.set(44, 0x0A); // 0.00003 turns in a minute
  EXPECT_NEAR(s.scaling().velocity(), 0.00003 / 60 * 4096, 1e-15);
}

TEST(SercosScaling, Accelerations) {
  Scaled s;
  EXPECT_DOUBLE_EQ(s.scaling().acceleration(), 1);
  s.set(160, 2); // 0.001 rad/s²
  EXPECT_NEAR(s.scaling().acceleration(), 4.096 / 6.283185307179586, 1e-12);
  s.set(160, 1); // 0.000001 m/s²
  EXPECT_NEAR(s.scaling().acceleration(), 2, 1e-12);
}

TEST(SercosScaling, TheShortestWay) {
  Scaled s;
  s.set(76, 0x8A);
  s.set(103, 1000);
  const DriveScaling modulo = s.scaling();
  EXPECT_EQ(modulo.wrapped(-1), 999);
  EXPECT_EQ(modulo.wrapped(1000), 0);
  EXPECT_EQ(modulo.way(-1, 0), 1);
  EXPECT_EQ(modulo.way(7000, 499), 499);
  EXPECT_EQ(modulo.way(7000, 501), -499);
  EXPECT_EQ(modulo.way(7000, 500), -500) << "half a turn";
  s.set(76, 0x0A);
  const DriveScaling absolute = s.scaling();
  EXPECT_EQ(absolute.wrapped(int64_t{1} << 31U), -2147483648LL);
  EXPECT_EQ(absolute.way(2147483640, -2147483640), 16);
}

} // namespace
} // namespace stride::sercos::simulation
