// Faults of all kinds at any time, with all layers from the program to the ring: an axis says why
// it stops, others go on, nothing jumps, and the way of docs/sercos.md brings every axis back.
// STRIDE_STACK=FIRST:COUNT takes other seeds.
#include "tests/support/cases.hpp"
#include "tests/unit/sercos_together/stack_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

namespace stride::test {
size_t allocations();
} // namespace stride::test

namespace stride::sercos {
namespace {

enum class Trouble : uint8_t {
  RingOpen,
  Off,
  Leaves,
  LoseAts,
  DistortAts,
  LoseMdts,
  LoseMsts,
  RingLosesMsts,
  RingDistortsMsts,
  Dark,
  OtherBaudRate,
  OtherAddress,
  Refuses,
  FailPhase3,
  FailPhase4,
  LeadDown, ///< The ring falls by others' doing, or a program leads it to a phase.
  ServiceWords,
  // Only these concern one drive alone.
  Mute,
  Busy,
  Error,
  MainPower,
  StatusWord,
  kCount,
};

/// What happens from one cycle on, for so many cycles, to a drive or to all.
struct Event {
  Trouble trouble;
  size_t drive;
  int cycles;
  uint32_t detail;
};

constexpr size_t kDrives = 3;

class Chaos {
public:
  explicit Chaos(unsigned seed) : random(seed), stack(seed % 3 == 0 ? 0.004 : 0.002) {
    for (uint32_t i = 0; i < kDrives; ++i) {
      bus::SetupParameters &drive = stack.add(2 + 3 * i);
      const double start = std::array{0.0, 2'147'480.0, -2'147'480.0, 12.0}[random() % 4];
      drive.add({"physics.start_position", "", start});
      drive.add({"physics.home_switch_from", "", start + 20});
      drive.add({"physics.home_switch_to", "", start + 25});
      drive.add({"physics.switch_cycles", "", static_cast<double>(1 + random() % 4)});
    }
    stack.make();
    stack.ring->damage = [this](RingAnswers &answers) { damage(answers); };
  }

  Event next() {
    Event event{};
    event.trouble = static_cast<Trouble>(random() % static_cast<unsigned>(Trouble::kCount));
    event.drive = random() % kDrives;
    event.cycles = 1 + static_cast<int>(random() % (random() % 3 == 0 ? 300 : 12));
    event.detail = static_cast<uint32_t>(random());
    return event;
  }

  /// Whether it is nothing to the other drives: the ring stays in phase 4.
  static bool isAlone(const Event &event) { return event.trouble >= Trouble::Mute; }

  void begin(const Event &event) {
    simulation::RingFaults &ring = stack.ring->network.ring().faults();
    simulation::SimulatedDrive &drive = stack.drive(event.drive);
    simulation::DeviceFaults &faults = drive.faults();
    const uint32_t few = 1 + event.detail % 4;
    switch (event.trouble) {
    case Trouble::RingOpen:
      ring.open = true;
      ring.openBefore = event.detail % (kDrives + 1);
      break;
    case Trouble::Off:
      faults.off = true;
      break;
    case Trouble::Leaves:
      faults.leaves = true;
      break;
    case Trouble::LoseAts:
      faults.loseAts = few;
      break;
    case Trouble::DistortAts:
      faults.distortAts = few;
      break;
    case Trouble::LoseMdts:
      faults.loseMdts = few;
      break;
    case Trouble::LoseMsts:
      faults.loseMsts = few;
      break;
    case Trouble::RingLosesMsts:
      ring.loseMsts = few;
      break;
    case Trouble::RingDistortsMsts:
      ring.distortMsts = few;
      break;
    case Trouble::Dark:
      ring.leastLight = 101;
      break;
    case Trouble::Mute:
      faults.mute = true;
      break;
    case Trouble::Busy:
      faults.busyCycles = few * few;
      break;
    case Trouble::Error:
      drive.fail(static_cast<uint16_t>(1 + event.detail % 60000));
      break;
    case Trouble::MainPower:
      drive.setMainPower(false);
      break;
    default:
      beginStartUp(event, faults);
      break;
    }
    now = event;
    damaged = event.trouble == Trouble::StatusWord ? std::min(few, 2U) : few * 5;
  }

  /// What shows when the ring comes up again only.
  void beginStartUp(const Event &event, simulation::DeviceFaults &faults) {
    switch (event.trouble) {
    case Trouble::OtherBaudRate:
      faults.baudRate = 16;
      break;
    case Trouble::OtherAddress:
      faults.answersAs = static_cast<uint8_t>(event.detail % 12);
      break;
    case Trouble::Refuses: {
      constexpr std::array<Idn, 12> kIdns = {1, 2, 6, 7, 8, 9, 10, 15, 32, 76, 127, 99};
      constexpr std::array<uint16_t, 4> kReasons = {0x1001, 0x7002, 0x7004, 0x7008};
      faults.refuses = true;
      faults.refused = kIdns[event.detail % kIdns.size()];
      faults.reason = kReasons[event.detail / 16 % kReasons.size()];
      break;
    }
    case Trouble::FailPhase3:
      faults.failPhase3 = true;
      break;
    case Trouble::FailPhase4:
      faults.failPhase4 = true;
      break;
    case Trouble::LeadDown:
      stack.driver->ringControl().commandPhase(static_cast<Phase>(event.detail % 5));
      return;
    default:
      return;
    }
    if (event.detail / 64 % 2 == 0) // the ring comes up again, with that
      stack.ring->network.ring().faults().loseMsts = 3;
  }

  /// What drives say is not what they are.
  void damage(RingAnswers &answers) {
    if (now.trouble != Trouble::StatusWord && now.trouble != Trouble::ServiceWords)
      return;
    const uint8_t address = stack.drive(now.drive).address();
    for (size_t i = 0; i < answers.count && damaged > 0; ++i) {
      DriveTelegram &telegram = answers.telegrams[i];
      if (telegram.address != address)
        continue;
      --damaged;
      if (now.trouble == Trouble::StatusWord) {
        constexpr std::array<unsigned, 9> kBits = {3, 5, 6, 8, 9, 11, 13, 14, 15};
        const unsigned bit = kBits[now.detail / 8 % kBits.size()];
        telegram.data[bit / 8] ^= static_cast<uint8_t>(1U << bit % 8);
      } else if (now.detail % 2 == 0) {
        telegram.data[0] |= 4U; // an error in the word that follows
      } else {
        telegram.data[2] ^= static_cast<uint8_t>(now.detail >> 8U); // lists, lengths, states …
        telegram.data[3] ^= static_cast<uint8_t>(now.detail >> 20U);
      }
    }
  }

  void end() {
    stack.ring->network.ring().faults() = {};
    for (size_t i = 0; i < kDrives; ++i) {
      stack.drive(i).faults() = {};
      stack.drive(i).setMainPower(true);
    }
    if (now.trouble == Trouble::LeadDown)
      stack.driver->ringControl().commandPhase(Phase::Four);
    now = {Trouble::kCount, 0, 0, 0};
  }

  /// One cycle, after which all must be as it should.
  void cycle(bool alone, size_t concerned) {
    std::array<double, kDrives> before{};
    std::array<bool, kDrives> powered{};
    for (size_t i = 0; i < kDrives; ++i) {
      before[i] = stack.axes[i]->axis.fSetPosition;
      // A drive that is stopped may have found its reference, and count from there.
      powered[i] = axis::isPowered(stack.axes[i]->axis) &&
                   stack.axes[i]->axis.nAxisState != axis::state::kHoming &&
                   stack.axes[i]->stop.Execute == 0;
    }
    stack.cycle();
    const double step = StackAxis::kVelocity * stack.setup.cycleSeconds + 1e-6;
    for (size_t i = 0; i < kDrives; ++i) {
      const axis::AxisRef &axis = stack.axes[i]->axis;
      if (powered[i] && axis::isPowered(axis) && axis.nAxisState != axis::state::kHoming) {
        ASSERT_LE(std::fabs(axis.fSetPosition - before[i]), step) << "axis " << i;
      }
      if (stack.axes[i]->errs() && stack.groupRef.wState == axis::kNormalOperation) {
        ASSERT_NE(axis.wFBErrorID, 0) << "axis " << i << " says why";
      }
      if (alone && i != concerned && stack.groupRef.udiResetsAsked == 0) {
        ASSERT_FALSE(stack.axes[i]->errs()) << "axis " << i << " goes on";
      }
    }
    ASSERT_EQ(stack.judge.complaint(), "");
  }

  std::mt19937 random;
  Stack stack;
  Event now{Trouble::kCount, 0, 0, 0};
  uint32_t damaged = 0; ///< Telegrams that are still to be.
};

std::string describe(const Stack &stack) {
  std::string states;
  for (const auto &one : stack.axes)
    states += " [state " + std::to_string(one->axis.nAxisState) + " error " +
              std::to_string(one->axis.wFBErrorID) + "/" + std::to_string(one->axis.wErrorID) +
              " communication " + std::to_string(one->axis.bCommunication) + " comstate " +
              std::to_string(one->axis.wCommunicationState) + "]";
  return states + " group " + std::to_string(stack.groupRef.wState) + " " +
         std::string(stack.group->bootupError());
}

/// Without faults any more, all axes move again.
void comeBack(Chaos &chaos, const std::string &told) {
  constexpr int kPatience = 20000; // cycles
  Stack &stack = chaos.stack;
  for (auto &one : stack.axes) {
    one->homes = false;
    one->done = 0;
  }
  const auto moved = [&stack] {
    return std::all_of(stack.axes.begin(), stack.axes.end(),
                       [](const auto &one) { return one->done >= 2; });
  };
  for (int i = 0; i < kPatience && !moved(); ++i) {
    chaos.cycle(false, 0);
    if (::testing::Test::HasFatalFailure())
      FAIL() << "after" << told << " in cycle " << i;
  }
  ASSERT_TRUE(moved()) << told << ": not all came back:" << describe(stack);
}

void episode(unsigned seed) {
  Chaos chaos(seed);
  Stack &stack = chaos.stack;
  std::string told = " seed " + std::to_string(seed);
  const bool inStartUp = chaos.random() % 4 == 0;
  if (!inStartUp) {
    ASSERT_TRUE(stack.moveAll(1, 8000)) << told << describe(stack);
  }
  stack.axes[0]->homes = chaos.random() % 3 == 0;
  stack.axes[0]->stopsHomes = static_cast<int>(chaos.random() % 2 * (1 + chaos.random() % 200));
  const auto quiet = static_cast<int>(chaos.random() % (inStartUp ? 1500 : 300));
  for (int i = 0; i < quiet; ++i) {
    chaos.cycle(!inStartUp, kDrives);
    if (::testing::Test::HasFatalFailure())
      FAIL() << told << " in cycle " << i;
  }
  const unsigned many = 1 + static_cast<unsigned>(chaos.random() % 3 == 0 ? chaos.random() % 4 : 0);
  for (unsigned k = 0; k < many; ++k) {
    const Event event = chaos.next();
    told += " " + std::to_string(static_cast<int>(event.trouble)) + "@" +
            std::to_string(event.drive) + "x" + std::to_string(event.cycles) + "d" +
            std::to_string(event.detail);
    const size_t before = test::allocations();
    chaos.begin(event);
    const bool alone = many == 1 && !inStartUp && Chaos::isAlone(event);
    for (int i = 0; i < event.cycles; ++i) {
      chaos.cycle(alone, event.drive);
      if (::testing::Test::HasFatalFailure())
        FAIL() << "during" << told << " in cycle " << i;
    }
    chaos.end();
    ASSERT_EQ(test::allocations(), before) << told;
  }
  comeBack(chaos, told);
}

TEST(SercosStack, FaultsAtAnyTime) {
  unsigned first = 0;
  auto count = static_cast<unsigned>(test::casesOf(60));
  if (const char *const given = std::getenv("STRIDE_STACK"); given != nullptr) {
    char *end = nullptr;
    first = static_cast<unsigned>(std::strtoul(given, &end, 10));
    count = *end == ':' ? static_cast<unsigned>(std::strtoul(end + 1, nullptr, 10)) : 1;
  }
  for (unsigned seed = first; seed < first + count; ++seed) {
    episode(seed);
    if (HasFatalFailure())
      return;
  }
}

/// MC_Stop in a reference run, at each moment of it: the drive stops by itself, and set values take
/// it over at rest.
TEST(SercosStack, AReferenceRunThatIsStoppedDoesNotJump) {
  for (int after = 1; after < 260; after += 3) {
    Stack stack(0.002, 60);
    bus::SetupParameters &drive = stack.add(5);
    drive.add({"physics.home_switch_from", "", 20});
    drive.add({"physics.home_switch_to", "", 25});
    stack.make();
    StackAxis &one = *stack.axes[0];
    one.homes = true;
    one.stopsHomes = after;
    double before = 0;
    for (int i = 0; i < 4000 && one.stops + one.homed == 0; ++i) {
      stack.cycle();
      ASSERT_EQ(stack.judge.complaint(), "") << "stopped after " << after << " in cycle " << i;
      before = one.axis.fSetPosition;
    }
    ASSERT_EQ(one.stops + one.homed, 1) << after;
    one.homes = false;
    one.stopsHomes = 0;
    stack.cycle();
    EXPECT_NEAR(one.axis.fSetPosition, before, 0.02) << after;
  }
}

} // namespace
} // namespace stride::sercos
