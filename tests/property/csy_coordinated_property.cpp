// Coordinated groups of a TSX CSY 85: on the line, together, within all limits, in the time of a
// trapezoid.
#include "gear_scene.hpp"
#include "motion_problems.hpp"

#include "runtime/iec/image.h"
#include "runtime/numeric/csy/register_map.hpp"

#include "st/CSY/CSY_COORDINATED.h"
#include "st/CSY/CSY_MODULE.h"
#include "st/CSY/T_CSY_COORD.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace {

using stride::BOOL;
using stride::Ctx;
using stride::UDINT;
using stride::test::casesOf;
using stride::test::fresh;
using stride::test::kGearCycle;
using stride::test::poweredAxis;
using stride::test::Random;
namespace csy = ::st::CSY;
namespace registers = stride::csy;

constexpr uint32_t kGroupChannel = 18;
constexpr size_t kArea = 4096; ///< bytes of each area; st::image__…__at__ are multiples of it

/// A channel's registers in an image of their own.
class Registers {
public:
  csy::T_CSY_COORD channel{};

  Registers() {
    // The members of T_CSY_EXCHANGE, then those of the table, in its order.
    auto *place = reinterpret_cast<UDINT *>(&channel);
    registers::Register row;
    const uint8_t kind = registers::kindOfChannel(kGroupChannel);
    for (const bool exchange : {true, false})
      for (size_t i = 0; registers::registerAt(kind, i, row); ++i) {
        if (std::string_view(row.symbol).starts_with("EXCH_") != exchange)
          continue;
        const registers::ImagePlace at = registers::placeOf(row);
        *place++ = at.bit < 0 ? at.byte : at.byte * 8 + static_cast<UDINT>(at.bit);
      }
    EXPECT_EQ(static_cast<void *>(place), static_cast<void *>(&channel + 1));
  }

  void set(UDINT output, bool value) {
    stride::setBitAt(image_.data() + kArea, output, value ? BOOL{1} : BOOL{0});
  }
  [[nodiscard]] bool get(UDINT input) const { return stride::getBitAt(image_.data(), input) != 0; }
  template <class T> T &memory(UDINT place) {
    return stride::at<T>(image_.data() + 2 * kArea, place);
  }
  Ctx context() {
    Ctx ctx{};
    ctx.state = image_.data();
    ctx.loopBudget = 1000000;
    return ctx;
  }

private:
  alignas(8) std::array<stride::BYTE, 3 * kArea> image_{};
};

struct Member {
  stride::axis::AxisRef axis = poweredAxis(0);
  float target = 0;
  float speed = 0; ///< the command's; 0: none
  double start = 0;
  double way = 0;
  double speedUnit = 1; ///< positions per second of a speed
  double accelUnit = 1;
};

struct Scene {
  Random random;
  Registers registers;
  csy::CSY_MODULE module = fresh<csy::CSY_MODULE>();
  csy::CSY_COORDINATED group = fresh<csy::CSY_COORDINATED>();
  std::vector<Member> members;
  std::vector<double> before; ///< velocities of a cycle ago
  size_t reference = 0;

  explicit Scene(uint64_t seed) : random(seed), members(2 + seed % 7) {
    module.fCycle = kGearCycle;
    module.bPresent = 1;
    group.iChannel = kGroupChannel;
    group.Module = &module;
    group.Channel = &registers.channel;
    for (size_t i = 0; i < members.size(); ++i) {
      const size_t channel = (i + seed) % 12;
      group.aiConfigured.v[i] = static_cast<int16_t>(channel + 1);
      fill(members[i], module.astAxis.v[channel]);
    }
    before.resize(members.size());
    allow(true);
    step();
    allow(true);
    registers.set(registers.channel.CONTROL_ACQUIRE, true);
    registers.set(registers.channel.CONTROL_CLEAR_FLT, true);
    step();
    step();
    EXPECT_TRUE(registers.get(registers.channel.AXIS_READY));
  }

  csy::CSY_AXIS_DATA &dataOf(size_t i) { return module.astAxis.v[group.aiConfigured.v[i] - 1]; }

  void fill(Member &member, csy::CSY_AXIS_DATA &data) {
    data.bConfigured = data.bReady = data.bInCommand = 1;
    data.pAxis = &member.axis;
    data.fScale = random.magnitude(-2, 2);
    member.speedUnit = random.magnitude(0, 1);
    member.accelUnit = random.magnitude(-1, 1);
    data.fSpeedScale = data.fScale * member.speedUnit;
    data.fAccelScale = data.fScale * member.accelUnit;
    data.stActive.ACCEL = static_cast<float>(random.magnitude(2, 3));
    data.stActive.DECEL = static_cast<float>(random.magnitude(2, 3));
    data.stActive.DECEL_MAX = random.chance(0.5) ? data.stActive.DECEL * 3 : 0.0F;
    data.stActive.SPEED_MAX =
        random.chance(0.6) ? static_cast<float>(random.magnitude(1, 2)) : 0.0F;
    constexpr int16_t kShapes[] = {100, 125, 150, 175, 200};
    data.stActive.ACCEL_TYPE = random.chance(0.5) ? int16_t{100} : kShapes[random.below(5)];
    member.start = random.uniform(-20, 20);
    member.axis.fSetPosition = member.start * data.fScale;
  }

  void allow(bool resume) {
    const csy::T_CSY_COORD &c = registers.channel;
    for (const UDINT bit :
         {c.ALLOW_ACQUIRE, c.ALLOW_ENABLE, c.ALLOW_MOVE, c.ALLOW_NOT_FASTSTOP, c.ALLOW_NOT_FLT})
      registers.set(bit, true);
    registers.set(c.ALLOW_RESUME, resume);
    registers.set(c.CONTROL_RESUME, resume);
  }

  /// Sends 513 with random targets; the first members may stay.
  void command() {
    for (size_t i = 0; i < members.size(); ++i) {
      Member &member = members[i];
      member.start = member.axis.fSetPosition / dataOf(i).fScale;
      member.target = static_cast<float>(random.uniform(-20, 20));
      if (i == 0 && random.chance(0.2)) { // the next one gives the speed
        member.axis.fSetPosition = 0;
        member.start = member.target = 0;
      }
      member.speed =
          i == 0 || random.chance(0.3) ? static_cast<float>(random.magnitude(0.5, 1.5)) : 0.0F;
      member.way = static_cast<double>(member.target) - member.start;
    }
    reference = members[0].way != 0 ? 0 : 1;
    if (members[reference].speed == 0)
      members[reference].speed = 7.5F;
    registers.memory<int16_t>(registers.channel.ACTION_CMD) = 513;
    for (size_t i = 0; i < members.size(); ++i) {
      // Position and speed in turn: a register of two words takes eight bytes.
      const UDINT place = registers.channel.PARAM_CMD_3 + static_cast<UDINT>(16 * i);
      registers.memory<float>(place) = members[i].target;
      registers.memory<float>(place + 8) = members[i].speed;
    }
    registers.memory<int16_t>(registers.channel.base__.EXCH_STS) = 2;
  }

  void step() {
    for (size_t i = 0; i < before.size(); ++i)
      before[i] = members[i].axis.fSetVelocity;
    for (Member &member : members) {
      member.axis.bMovedInThisCycle = 0;
      member.axis.bTravelGiven = 0;
    }
    Ctx ctx = registers.context();
    group.body__(ctx);
  }

  /// How far the group is along its line, by the member with the longest way.
  double part() {
    size_t longest = 0;
    for (size_t i = 0; i < members.size(); ++i)
      if (std::fabs(members[i].way) > std::fabs(members[longest].way))
        longest = i;
    return (place(longest) - members[longest].start) / members[longest].way;
  }
  double place(size_t i) { return members[i].axis.fSetPosition / dataOf(i).fScale; }

  /// What a limit of member i is for the whole line, as a part of it. [1/s], [1/s²]
  double ofLine(size_t i, double limit) { return limit / std::fabs(members[i].way); }

  /// Speed, acceleration and deceleration of the line.
  std::array<double, 3> dynamics() {
    std::array<double, 3> all{1e300, 1e300, 1e300};
    for (size_t i = 0; i < members.size(); ++i) {
      if (members[i].way == 0)
        continue;
      const csy::CSY_AXIS_PARAMETERS &active = dataOf(i).stActive;
      for (const float speed : {active.SPEED_MAX, members[i].speed})
        if (speed > 0)
          all[0] = std::min(all[0], ofLine(i, static_cast<double>(speed) * members[i].speedUnit));
      all[1] =
          std::min(all[1], ofLine(i, static_cast<double>(active.ACCEL) * members[i].accelUnit));
      all[2] =
          std::min(all[2], ofLine(i, static_cast<double>(active.DECEL) * members[i].accelUnit));
    }
    return all;
  }

  void checkLine() {
    const double at = part();
    ASSERT_GE(at, -1e-12);
    ASSERT_LE(at, 1 + 1e-12);
    for (size_t i = 0; i < members.size(); ++i) {
      ASSERT_NEAR(place(i), members[i].start + at * members[i].way, 1e-9) << i;
      if (at == 1.0) { // nothing is left to brake on
        ASSERT_NEAR(members[i].axis.fSetVelocity / dataOf(i).fScale, 0, 1e-6) << i;
      }
    }
  }

  void checkLimits(bool isStopping) {
    const double shape = dataOf(0).stActive.ACCEL_TYPE / 100.0;
    for (size_t i = 0; i < members.size(); ++i) {
      const csy::CSY_AXIS_DATA &data = dataOf(i);
      const double velocity = std::fabs(members[i].axis.fSetVelocity) / data.fSpeedScale;
      const double last = std::fabs(before[i]) / data.fSpeedScale;
      constexpr double kSlack = 1 + 1e-9;
      for (const float limit : {data.stActive.SPEED_MAX, members[i].speed})
        ASSERT_LE(velocity, limit > 0 ? static_cast<double>(limit) * kSlack : 1e300);
      const double change =
          (velocity - last) / kGearCycle * members[i].speedUnit / members[i].accelUnit;
      ASSERT_LE(change, shape * static_cast<double>(data.stActive.ACCEL) * kSlack + 1e-6);
      if (!isStopping) {
        ASSERT_GE(change, -shape * static_cast<double>(data.stActive.DECEL) * kSlack - 1e-6);
      }
    }
  }

  void checkArrival() {
    for (size_t i = 0; i < members.size(); ++i) {
      ASSERT_EQ(members[i].axis.fSetPosition,
                static_cast<double>(members[i].target) * dataOf(i).fScale);
      ASSERT_EQ(members[i].axis.nAxisState, stride::axis::state::kStandstill);
      ASSERT_EQ(dataOf(i).iMovedBy, 0);
    }
  }

  [[nodiscard]] bool moves() const { return !registers.get(registers.channel.PROFILE_END); }
  int16_t error() { return registers.memory<int16_t>(registers.channel.ERROR_CMD); }
};

/// Time of a trapezoid over the way 1.
double trapezoid(const std::array<double, 3> &dynamics) {
  const auto [speed, rising, falling] = dynamics;
  const double ramps = speed * speed / 2 * (1 / rising + 1 / falling);
  if (ramps <= 1)
    return speed / rising + speed / falling + (1 - ramps) / speed;
  const double peak = std::sqrt(2 / (1 / rising + 1 / falling));
  return peak / rising + peak / falling;
}

TEST(CsyCoordinatedProperty, ArrivesTogetherInTheTimeOfATrapezoid) {
  int trapezoids = 0;
  for (int seed = 0; seed < casesOf(200); ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(static_cast<uint64_t>(seed));
    scene.command();
    const auto dynamics = scene.dynamics();
    const double duration = trapezoid(dynamics);
    int cycles = 0;
    do {
      scene.step();
      ASSERT_EQ(scene.error(), 0);
      ++cycles;
      ASSERT_NO_FATAL_FAILURE(scene.checkLine());
      ASSERT_NO_FATAL_FAILURE(scene.checkLimits(false));
      for (size_t i = 0; i < scene.members.size(); ++i) // all or none
        ASSERT_EQ(scene.members[i].axis.fSetVelocity != 0,
                  scene.moves() && scene.members[i].way != 0)
            << "cycle " << cycles;
    } while (scene.moves() && cycles < 1000000);
    scene.checkArrival();
    if (scene.dataOf(0).stActive.ACCEL_TYPE == 100) {
      ++trapezoids;
      ASSERT_NEAR(cycles, std::ceil(duration / kGearCycle), 1.0) << duration;
    } else {
      ASSERT_GE(cycles + 1, duration / kGearCycle * 0.99); // a softer one is not faster
    }
  }
  EXPECT_GT(trapezoids, casesOf(200) / 3);
}

TEST(CsyCoordinatedProperty, StopsOnTheLineAndGoesOn) {
  int halted = 0;
  for (int seed = 0; seed < casesOf(200); ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(static_cast<uint64_t>(seed) + 100000);
    scene.command();
    const double duration = trapezoid(scene.dynamics());
    bool stopping = false;
    const bool member = scene.random.chance(0.5); // a member's bits hold, or the group's
    int16_t worst = 0;
    int cycles = 0;
    for (; cycles < 2000000; ++cycles) {
      if (cycles > 0 && scene.random.chance(2 * kGearCycle / duration)) {
        stopping = !stopping;
        const int16_t stop = stopping ? static_cast<int16_t>(scene.random.chance(0.1) ? 3 : 1) : 0;
        worst = std::max(worst, stop);
        if (member || stop == 3)
          scene.dataOf(1).iStop = stop;
        else
          scene.allow(!stopping);
        if (!stopping) {
          scene.dataOf(1).iStop = 0;
          scene.allow(true);
        }
      }
      scene.step();
      ASSERT_EQ(scene.error(), 0);
      ASSERT_NO_FATAL_FAILURE(scene.checkLine());
      ASSERT_NO_FATAL_FAILURE(scene.checkLimits(true));
      if (!scene.moves())
        break;
    }
    ASSERT_FALSE(scene.moves());
    if (worst < 3 || scene.part() == 1.0) {
      scene.checkArrival();
    } else {
      ++halted;
      for (const Member &each : scene.members)
        ASSERT_EQ(each.axis.fSetVelocity, 0);
    }
  }
  EXPECT_GT(halted, 0);
}

TEST(CsyCoordinatedProperty, HoldsNearTheEndStayBeforeIt) {
  for (int seed = 0; seed < casesOf(200); ++seed) {
    SCOPED_TRACE(seed);
    const auto start = [&](Scene &scene) {
      scene.dataOf(0).stActive.ACCEL_TYPE = 200;
      scene.command();
      scene.step();
      EXPECT_EQ(scene.error(), 0);
    };
    Scene undisturbed(static_cast<uint64_t>(seed));
    start(undisturbed);
    int cycles = 1;
    for (; undisturbed.moves(); ++cycles)
      undisturbed.step();
    Scene scene(static_cast<uint64_t>(seed));
    start(scene);
    // While it brakes, at its peak or past it.
    const int hold = static_cast<int>(cycles * Random(static_cast<uint64_t>(seed)).uniform(0.6, 1));
    int i = 1;
    for (; i < hold; ++i)
      scene.step();
    scene.allow(false);
    for (; !scene.registers.get(scene.registers.channel.HOLDING) && i < 2 * cycles + 10; ++i) {
      scene.step();
      ASSERT_NO_FATAL_FAILURE(scene.checkLine());
    }
    ASSERT_TRUE(scene.registers.get(scene.registers.channel.HOLDING));
    scene.allow(true);
    for (; scene.moves() && i < 4 * cycles + 100; ++i) {
      scene.step();
      ASSERT_NO_FATAL_FAILURE(scene.checkLine());
    }
    scene.checkArrival();
  }
}

} // namespace
