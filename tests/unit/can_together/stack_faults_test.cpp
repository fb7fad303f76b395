// Faults of all kinds at any time, with all layers from the program to the wire: an axis says why
// it stops, others go on, nothing jumps, and the way of docs/can.md brings every axis back.
// STRIDE_STACK=FIRST:COUNT takes other seeds.
#include "tests/support/cases.hpp"
#include "tests/unit/can_together/stack_scene.hpp"
#include "tests/unit/can_together/wire_judge.hpp"

#include <cstdlib>
#include <random>

namespace stride::test {
size_t allocations();
} // namespace stride::test

namespace stride::can {
namespace {

enum class Trouble : uint8_t {
  Silent,
  Power,
  Reset,
  Statusword,
  Encoder,
  Length,
  LostTpdos,
  LostRpdos,
  LostSyncs,
  BusOff,
  Emcys,
  Fault,
  Double,
  Answers,
  Deaf,
  Heartbeats,
  OtherNmt,
  Babble,
  Mode,
  kCount,
};

/// What happens from one cycle on, for so many cycles, to a drive or to all.
struct Event {
  Trouble trouble;
  size_t drive;
  int cycles;
  uint32_t detail;
};

bool concernsAll(Trouble trouble) {
  return trouble == Trouble::LostSyncs || trouble == Trouble::BusOff ||
         trouble == Trouble::Double || trouble == Trouble::Babble;
}

class Chaos {
public:
  explicit Chaos(unsigned seed)
      : random(seed), stack(seed % 3 == 0 ? 0.004 : 0.002),
        judge(static_cast<int32_t>(StackAxis::kVelocity * stack.setup.cycleSeconds *
                                   StackAxis::kIncrements) +
              2) {
    constexpr std::array<double, 3> kTypes = {4, 5, 4};
    constexpr std::array<double, 5> kStarts = {0, 2'147'480, -2'147'480, 12, -30};
    for (uint32_t i = 0; i < 3; ++i) {
      bus::SetupParameters &drive = stack.add(2 + 3 * i, kTypes[random() % 3]);
      const double start = kStarts[random() % 5];
      drive.add({"physics.start_position", "", start});
      drive.add({"physics.home_switch_from", "", start + 20});
      drive.add({"physics.home_switch_to", "", start + 25});
      drive.add({"inputs", "", 1});
      drive.add({"power_off", "", static_cast<double>(random() % 2)});
      drive.add({"brake_release", "", random() % 2 == 0 ? 0.0 : 0.01});
      drive.add({"startup",
                 "6098h := 19\n6099h:1 := 60000\n6099h:2 := 10000\n609Ah := 2000000\n"
                 "6084h := 4000000\n6085h := 8000000",
                 0});
    }
    stack.make();
    stack.network->bus().setTap(&judge);
    for (size_t i = 0; i < 3; ++i)
      judge.watch(stack.driver->master().node(i).devices()[0].plan(), stack.network->drive(i));
  }

  Event next(bool alone) {
    Event event{};
    event.trouble = static_cast<Trouble>(random() % static_cast<unsigned>(Trouble::kCount));
    event.drive = random() % 3;
    // Where a drive says to be when it is switched on is where it begins; and one that hears SDOs
    // and SYNC, but no set values, goes where it was told last.
    const bool places = event.trouble == Trouble::Encoder || event.trouble == Trouble::LostRpdos;
    if (places && (!alone || stack.axes[event.drive]->homes))
      event.trouble = Trouble::Emcys;
    event.cycles = 1 + static_cast<int>(random() % (random() % 3 == 0 ? 300 : 12));
    event.detail = static_cast<uint32_t>(random());
    return event;
  }

  void begin(const Event &event) {
    simulation::SimulatedBus &bus = stack.network->bus();
    simulation::SimulatedDrive402 &drive = stack.network->drive(event.drive);
    const auto id = static_cast<uint8_t>(stack.setup.drives[event.drive].id);
    if (const simulation::FaultOrder order = orderOf(event, id);
        order.fault != simulation::Fault::None)
      bus.faults().order(order);
    switch (event.trouble) {
    case Trouble::Silent:
      drive.setSilent(true);
      break;
    case Trouble::Power:
      bus.setPower(1 + event.drive, false);
      break;
    case Trouble::BusOff:
      bus.forceBusOff(0);
      break;
    case Trouble::Fault:
      drive.raiseError(static_cast<uint16_t>(0x2310 + event.detail % 3 * 0x1000));
      break;
    case Trouble::Reset:
      drive.reset();
      break;
    case Trouble::Answers:
      if (event.detail % 2 == 0)
        drive.reset();
      break;
    case Trouble::Deaf:
      drive.setDeaf(true);
      if (event.detail % 2 == 0)
        drive.raiseError(0x8611);
      break;
    case Trouble::OtherNmt: {
      constexpr std::array<uint8_t, 4> kCommands = {0x02, 0x80, 0x81, 0x82};
      stack.say(0, {kCommands[event.detail % 4], id});
      break;
    }
    default:
      break;
    }
  }

  /// What happens to frames.
  simulation::FaultOrder orderOf(const Event &event, uint8_t id) const {
    using simulation::Fault;
    const uint32_t few = 1 + event.detail % 5;
    const auto order = [&event](unsigned cobId, Fault fault, uint32_t count) {
      simulation::FaultOrder result;
      result.id = static_cast<uint16_t>(cobId);
      result.fault = fault;
      result.count = std::min(count, static_cast<uint32_t>(event.cycles));
      return result;
    };
    const auto bits = [](simulation::FaultOrder result, int byte, uint32_t invert) {
      result.byte = static_cast<int16_t>(byte);
      result.invert = static_cast<uint8_t>(invert);
      return result;
    };
    switch (event.trouble) {
    case Trouble::Statusword: {
      const bool own = stack.driver->master().node(event.drive).devices()[0].plan().tpdoCount > 1;
      constexpr std::array<uint8_t, 7> kBits = {0x01, 0x02, 0x04, 0x08, 0x10, 0x20, 0x40};
      const uint8_t bit = kBits[event.detail / 8 % kBits.size()];
      // Once it has been told to leave operation, that bit would say that it has not.
      const uint32_t count = bit == 0x04 ? std::min(few, 2U) : few;
      return bits(order((own ? 0x280U : 0x180U) + id, Fault::Corrupt, count), 0, bit);
    }
    case Trouble::Encoder:
      return bits(order(0x180U + id, Fault::Corrupt, few), 2, event.detail >> 8U | 1U);
    case Trouble::Length: {
      simulation::FaultOrder result =
          order(0x180U + id + 0x100 * (event.detail % 2), Fault::Corrupt, UINT32_MAX);
      result.length = static_cast<int16_t>(event.detail / 2 % 9);
      return result;
    }
    case Trouble::Answers: {
      simulation::FaultOrder result =
          bits(order(0x580U + id, Fault::Corrupt, UINT32_MAX),
               static_cast<int>(event.detail / 8 % 9) - 1, event.detail >> 16U);
      result.count = 1 + event.detail % 6;
      if (event.detail / 128 % 3 == 0)
        result.length = static_cast<int16_t>(event.detail / 512 % 9);
      return result;
    }
    case Trouble::LostTpdos:
      return order(0x180U + id, Fault::Lose, UINT32_MAX);
    case Trouble::LostRpdos:
      return order(0x200U + id, Fault::Lose, 10);
    case Trouble::LostSyncs:
      return order(0x080, Fault::Lose, UINT32_MAX);
    case Trouble::Heartbeats:
      return order(0x700U + id, Fault::Lose, UINT32_MAX);
    default:
      return {};
    }
  }

  /// In each cycle of it.
  void goOn(const Event &event) {
    const auto id = static_cast<uint16_t>(stack.setup.drives[event.drive].id);
    if (event.trouble == Trouble::Emcys) {
      for (unsigned i = 0; i < event.detail % 5; ++i)
        stack.say(static_cast<uint16_t>(0x080 + id),
                  {static_cast<uint8_t>(random()), static_cast<uint8_t>(random() % 256), 1, 0, 0, 0,
                   0, 0});
    } else if (event.trouble == Trouble::Double) {
      stack.say(static_cast<uint16_t>(0x180 + id), {0x37, 0x06, 1, 2, 3, 4, 5, 6});
    } else if (event.trouble == Trouble::Babble) {
      for (unsigned i = 0; i < 40; ++i)
        stack.say(static_cast<uint16_t>(0x7F0 + random() % 15), {});
    } else if (event.trouble == Trouble::Mode && event.detail % 4 == 0) {
      stack.network->drive(event.drive).write(0x6060, 0, 1);
    }
  }

  void end(const Event &event) {
    switch (event.trouble) {
    case Trouble::Silent:
      stack.network->drive(event.drive).setSilent(false);
      break;
    case Trouble::Power:
      stack.network->bus().setPower(1 + event.drive, true);
      break;
    case Trouble::BusOff:
      stack.network->bus().restart(0);
      break;
    case Trouble::Deaf:
      stack.network->drive(event.drive).setDeaf(false);
      break;
    default:
      break;
    }
  }

  /// One cycle, after which all must be as it should.
  void cycle(bool alone, size_t concerned) {
    std::array<double, 3> before{};
    std::array<bool, 3> powered{};
    for (size_t i = 0; i < 3; ++i) {
      before[i] = stack.axes[i]->axis.fSetPosition;
      // A drive that is stopped may have found its reference, and count from there.
      powered[i] = axis::isPowered(stack.axes[i]->axis) &&
                   stack.axes[i]->axis.nAxisState != axis::state::kHoming &&
                   stack.axes[i]->stop.Execute == 0;
    }
    stack.cycle();
    const double step = StackAxis::kVelocity * stack.setup.cycleSeconds + 1e-6;
    for (size_t i = 0; i < 3; ++i) {
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
    ASSERT_EQ(judge.complaint(), "");
  }

  std::mt19937 random;
  Stack stack;
  WireJudge judge;
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
  constexpr int kPatience = 6000; // cycles
  Stack &stack = chaos.stack;
  stack.network->bus().faults().clear();
  stack.axes[0]->homes = false;
  for (auto &one : stack.axes)
    one->done = 0;
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
  ASSERT_TRUE(stack.moveAll(1, 3000));
  stack.axes[0]->homes = chaos.random() % 4 == 0;
  stack.axes[0]->stopsHomes = seed % 3 == 1 ? static_cast<int>(1 + seed % 197) : 0;
  const auto quiet = static_cast<int>(chaos.random() % 300);
  for (int i = 0; i < quiet; ++i)
    chaos.cycle(true, 3);
  const unsigned many = 1 + static_cast<unsigned>(chaos.random() % 3 == 0 ? chaos.random() % 4 : 0);
  std::string told = " seed " + std::to_string(seed);
  for (unsigned k = 0; k < many; ++k) {
    const Event event = chaos.next(many == 1);
    told += " " + std::to_string(static_cast<int>(event.trouble)) + "@" +
            std::to_string(event.drive) + "x" + std::to_string(event.cycles);
    const size_t before = test::allocations();
    chaos.begin(event);
    const bool alone = many == 1 && !concernsAll(event.trouble);
    for (int i = 0; i < event.cycles; ++i) {
      chaos.goOn(event);
      chaos.cycle(alone, event.drive);
      if (::testing::Test::HasFatalFailure())
        FAIL() << "during" << told << " in cycle " << i;
    }
    chaos.end(event);
    ASSERT_EQ(test::allocations(), before) << told;
  }
  comeBack(chaos, told);
}

TEST(CanStack, FaultsAtAnyTime) {
  unsigned first = 0;
  auto count = static_cast<unsigned>(test::casesOf(200));
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

/// The drive meets its limit switch before the reference, and brakes by itself.
TEST(CanStack, AReferenceRunThatFailsDoesNotJump) {
  Stack stack;
  WireJudge judge(2);
  bus::SetupParameters &drive = stack.add(5, 5);
  drive.add({"inputs", "", 1});
  drive.add({"physics.limit_positive", "", 3});
  drive.add({"physics.home_switch_from", "", 20});
  drive.add({"physics.home_switch_to", "", 25});
  drive.add({"startup",
             "6098h := 19\n6099h:1 := 150000\n6099h:2 := 10000\n609Ah := 2000000\n"
             "6084h := 4000000\n6085h := 8000000",
             0});
  stack.make();
  stack.network->bus().setTap(&judge);
  judge.watch(stack.driver->master().node(0).devices()[0].plan(), stack.network->drive(0));
  stack.axes[0]->homes = true;
  for (int i = 0; i < 3000 && stack.axes[0]->failedHomes == 0; ++i) {
    stack.cycle();
    ASSERT_EQ(judge.complaint(), "") << i;
  }
  EXPECT_EQ(stack.axes[0]->failedHomes, 1);
}

/// MC_Stop in a reference run, at each moment of it: the drive stops by itself, and set values take
/// it over at rest. It moves on at once.
TEST(CanStack, AReferenceRunThatIsStoppedDoesNotJump) {
  for (int after = 1; after < 120; ++after) {
    Stack stack;
    WireJudge judge(16 + 2); // what the acceleration allows from rest on, in the first cycle
    bus::SetupParameters &drive = stack.add(5, 5);
    drive.add({"inputs", "", 1});
    drive.add({"physics.home_switch_from", "", 8});
    drive.add({"physics.home_switch_to", "", 12});
    drive.add({"startup",
               "6098h := 19\n6099h:1 := 90000\n6099h:2 := 10000\n609Ah := 2000000\n"
               "6084h := 1500000\n6085h := 8000000",
               0});
    stack.make();
    stack.network->bus().setTap(&judge);
    judge.watch(stack.driver->master().node(0).devices()[0].plan(), stack.network->drive(0));
    StackAxis &one = *stack.axes[0];
    one.homes = true;
    one.stopsHomes = after;
    double before = 0;
    for (int i = 0; i < 1000 && one.stops == 0 && one.homed == 0; ++i) {
      stack.cycle();
      ASSERT_EQ(judge.complaint(), "") << "stopped after " << after << " in cycle " << i;
      before = one.axis.fSetPosition;
    }
    ASSERT_EQ(one.stops + one.homed, 1) << after;
    one.homes = false;
    one.stopsHomes = 0;
    WireJudge moving(static_cast<int32_t>(StackAxis::kVelocity * 2) + 2);
    stack.network->bus().setTap(&moving);
    moving.watch(stack.driver->master().node(0).devices()[0].plan(), stack.network->drive(0));
    stack.cycle();
    EXPECT_NEAR(one.axis.fSetPosition, before, 0.01) << after;
    EXPECT_TRUE(stack.moveAll(1, 300)) << after;
    ASSERT_EQ(moving.complaint(), "") << after;
  }
}

/// A statusword that says "switched on" for a cycle or two of a motion: the drive goes on where it
/// is, not where it was when it said so.
TEST(CanStack, ADriveThatSeemsToLeaveOperationIsNotLedBack) {
  for (uint32_t cycles = 1; cycles <= 2; ++cycles)
    for (int quiet = 0; quiet < 90; quiet += 7) {
      Stack stack;
      WireJudge judge(static_cast<int32_t>(StackAxis::kVelocity * 2) + 2);
      stack.add(5, 5);
      stack.make();
      stack.network->bus().setTap(&judge);
      judge.watch(stack.driver->master().node(0).devices()[0].plan(), stack.network->drive(0));
      ASSERT_TRUE(stack.moveAll(1, 3000));
      for (int i = 0; i < quiet; ++i)
        stack.cycle();
      simulation::FaultOrder order;
      order.id = 0x285;
      order.fault = simulation::Fault::Corrupt;
      order.count = cycles;
      order.byte = 0;
      order.invert = 0x04;
      stack.network->bus().faults().order(order);
      EXPECT_TRUE(stack.moveAll(2, 1000)) << "it comes back by itself";
      ASSERT_EQ(judge.complaint(), "") << cycles << " cycles after " << quiet;
    }
}

} // namespace
} // namespace stride::can
