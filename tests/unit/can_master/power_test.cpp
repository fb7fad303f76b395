// The power state machine against a model of this test's own: which words a drive may be told in
// which state, and what a drive makes of them.
#include "drivers/can/master/power.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>

namespace stride::can {
namespace {

/// The state by single bits, as the table of CiA 402 names them.
PowerState modelState(unsigned word) {
  const bool readyToSwitchOn = (word & 1U) != 0;
  const bool switchedOn = (word & 2U) != 0;
  const bool operationEnabled = (word & 4U) != 0;
  const bool fault = (word & 8U) != 0;
  const bool quickStop = (word & 0x20U) != 0; // not active
  const bool switchOnDisabled = (word & 0x40U) != 0;
  const bool none = !readyToSwitchOn && !switchedOn && !operationEnabled;
  const bool all = readyToSwitchOn && switchedOn && operationEnabled;
  if (switchOnDisabled)
    return none && !fault ? PowerState::SwitchOnDisabled : PowerState::Unknown;
  if (fault)
    return none ? PowerState::Fault : all ? PowerState::FaultReaction : PowerState::Unknown;
  if (none)
    return PowerState::NotReady;
  if (all)
    return quickStop ? PowerState::Enabled : PowerState::QuickStop;
  if (!quickStop || !readyToSwitchOn || operationEnabled)
    return PowerState::Unknown;
  return switchedOn ? PowerState::SwitchedOn : PowerState::Ready;
}

/// What a controlword means to a drive: by bits, 'x' is any.
enum class Order {
  None,
  Shutdown,        // x x x x 0 x x x | x 1 1 0
  SwitchOn,        // 0 1 1 1
  EnableOperation, // 1 1 1 1
  DisableVoltage,  // x x 0 x
  QuickStop,       // x 0 1 x
  FaultReset,      // rising bit 7
};
Order orderOf(unsigned word) {
  if ((word & 0x80U) != 0)
    return Order::FaultReset;
  if ((word & 2U) == 0)
    return Order::DisableVoltage;
  if ((word & 4U) == 0)
    return Order::QuickStop;
  if ((word & 1U) == 0)
    return Order::Shutdown;
  return (word & 8U) != 0 ? Order::EnableOperation : Order::SwitchOn;
}

/// Where a drive goes from a state; itself: the order means nothing there.
PowerState next(PowerState state, Order order) {
  switch (state) {
  case PowerState::SwitchOnDisabled:
    return order == Order::Shutdown ? PowerState::Ready : state;
  case PowerState::Ready:
    if (order == Order::SwitchOn)
      return PowerState::SwitchedOn;
    return order == Order::DisableVoltage || order == Order::QuickStop
               ? PowerState::SwitchOnDisabled
               : state;
  case PowerState::SwitchedOn:
    if (order == Order::EnableOperation)
      return PowerState::Enabled;
    if (order == Order::Shutdown)
      return PowerState::Ready;
    return order == Order::DisableVoltage || order == Order::QuickStop
               ? PowerState::SwitchOnDisabled
               : state;
  case PowerState::Enabled:
    if (order == Order::SwitchOn)
      return PowerState::SwitchedOn;
    if (order == Order::Shutdown)
      return PowerState::Ready;
    if (order == Order::QuickStop)
      return PowerState::QuickStop;
    return order == Order::DisableVoltage ? PowerState::SwitchOnDisabled : state;
  case PowerState::QuickStop:
    return order == Order::DisableVoltage ? PowerState::SwitchOnDisabled : state;
  case PowerState::Fault:
    return order == Order::FaultReset ? PowerState::SwitchOnDisabled : state;
  default:
    return state;
  }
}

unsigned statuswordOf(PowerState state) {
  static constexpr std::array<unsigned, 9> kWords = {0x00, 0x40, 0x21, 0x23, 0x27,
                                                     0x07, 0x0F, 0x08, 0x41};
  return kWords[static_cast<size_t>(state)];
}

/// Orders that have a meaning in the state, so none that a drive must guess.
bool isLegal(PowerState state, unsigned word) {
  static const std::set<unsigned> kKnown = {0x00, 0x02, 0x06, 0x07, 0x0F, 0x80};
  if (!kKnown.contains(word))
    return false;
  if (word == 0x00)
    return true;
  switch (state) {
  case PowerState::SwitchOnDisabled:
    return word == 0x06;
  case PowerState::Ready:
    return word == 0x06 || word == 0x07;
  case PowerState::SwitchedOn:
    return word == 0x06 || word == 0x07 || word == 0x0F;
  case PowerState::Enabled:
    return word == 0x02 || word == 0x06 || word == 0x07 || word == 0x0F;
  case PowerState::QuickStop:
    return word == 0x02 || word == 0x0F;
  case PowerState::Fault:
    return word == 0x80;
  default:
    return false;
  }
}

constexpr std::array<PowerTarget, 4> kTargets = {PowerTarget::Off, PowerTarget::SwitchedOn,
                                                 PowerTarget::Enabled, PowerTarget::QuickStop};

PowerParameters parameters(PowerOff off = PowerOff::DisableVoltage) {
  PowerParameters result;
  result.off = off;
  result.timeout = 20;
  result.resetTime = 10;
  return result;
}

TEST(Power, TheStateOfAllStatuswords) {
  for (unsigned word = 0; word <= 0xFFFF; ++word)
    ASSERT_EQ(powerStateOf(static_cast<uint16_t>(word)), modelState(word)) << std::hex << word;
  for (unsigned state = 0; state < kPowerStates; ++state)
    EXPECT_FALSE(nameOf(static_cast<PowerState>(state)).empty());
}

// Every statusword after every other state, with each target, with and without acknowledgement.
TEST(Power, AllStatuswordsAreAnsweredLegally) {
  for (unsigned before = 0; before < kPowerStates; ++before)
    for (unsigned word = 0; word <= 0xFFFF; ++word)
      for (const PowerTarget target : kTargets)
        for (const bool acknowledge : {false, true}) {
          PowerControl power(parameters());
          power.seen(static_cast<uint16_t>(statuswordOf(static_cast<PowerState>(before))));
          power.demand(target, acknowledge);
          power.seen(static_cast<uint16_t>(word));
          power.demand(target, acknowledge);
          ASSERT_TRUE(isLegal(modelState(word), power.controlword()))
              << before << ' ' << std::hex << word << ' ' << power.controlword();
          const bool fault = before >= 6 && before <= 7 && !acknowledge;
          if (fault || (word & 8U) != 0 || target != PowerTarget::Enabled) {
            ASSERT_NE(power.controlword(), 0x0F) << before << ' ' << std::hex << word;
          }
        }
}

/// A drive that makes one transition for each word, and shows its state `delay` cycles later.
class ModelDrive {
public:
  explicit ModelDrive(size_t delay) : shown_(delay, statuswordOf(PowerState::SwitchOnDisabled)) {}

  unsigned statusword() const { return shown_.front(); }
  void told(unsigned word) {
    const bool reset = (word & 0x80U) != 0;
    const Order order = reset && resetBefore_ ? Order::None : orderOf(word);
    resetBefore_ = reset;
    if (persistent && state == PowerState::Fault && order == Order::FaultReset)
      return;
    state = next(state, order);
  }
  void step() {
    shown_.erase(shown_.begin());
    shown_.push_back(statuswordOf(state));
  }

  PowerState state = PowerState::SwitchOnDisabled;
  bool persistent = false;

private:
  std::vector<unsigned> shown_;
  bool resetBefore_ = false;
};

/// Runs until the drive is there; the words that were sent, each once in a row.
std::vector<unsigned> wordsUntil(PowerControl &power, ModelDrive &drive, PowerTarget target,
                                 PowerState wanted, bool acknowledge = false) {
  std::vector<unsigned> words;
  for (int i = 0; i < 40; ++i) {
    power.seen(static_cast<uint16_t>(drive.statusword()));
    power.demand(target, acknowledge);
    if (words.empty() || words.back() != power.controlword())
      words.push_back(power.controlword());
    drive.told(power.controlword());
    drive.step();
  }
  EXPECT_EQ(drive.state, wanted);
  return words;
}

TEST(Power, OneTransitionForEachSeenState) {
  for (const size_t delay : {1U, 2U, 3U}) {
    PowerControl power(parameters());
    ModelDrive drive(delay);
    using Words = std::vector<unsigned>;
    EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Off, PowerState::SwitchOnDisabled), Words{0});
    EXPECT_EQ(wordsUntil(power, drive, PowerTarget::SwitchedOn, PowerState::SwitchedOn),
              (Words{6, 7}));
    EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled), Words{0xF});
    EXPECT_EQ(wordsUntil(power, drive, PowerTarget::SwitchedOn, PowerState::SwitchedOn), Words{7});
    EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled), Words{0xF});
    EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Off, PowerState::SwitchOnDisabled),
              (Words{7, 6, 0}));
    EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled),
              (Words{6, 7, 0xF}));
    EXPECT_EQ(wordsUntil(power, drive, PowerTarget::QuickStop, PowerState::QuickStop), Words{2});
    EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Off, PowerState::SwitchOnDisabled), Words{0});
    EXPECT_FALSE(power.stuck());
    EXPECT_FALSE(power.fault());
  }
}

TEST(Power, AShutDownDriveStaysReady) {
  PowerControl power(parameters(PowerOff::Shutdown));
  ModelDrive drive(2);
  using Words = std::vector<unsigned>;
  EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Off, PowerState::Ready), Words{6});
  EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled), (Words{7, 0xF}));
  EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Off, PowerState::Ready), (Words{7, 6}));
}

TEST(Power, AFaultIsResetByAnEdge) {
  PowerControl power(parameters());
  ModelDrive drive(2);
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled);
  drive.state = PowerState::Fault;
  using Words = std::vector<unsigned>;
  EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Fault), (Words{0xF, 0}));
  EXPECT_TRUE(power.fault());
  EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled, true),
            (Words{0x80, 6, 7, 0xF}));
  EXPECT_FALSE(power.fault());
}

TEST(Power, APersistentFaultGetsOneResetOfLimitedTime) {
  PowerControl power(parameters());
  ModelDrive drive(1);
  drive.persistent = true;
  drive.state = PowerState::Fault;
  drive.step();
  for (int pulse = 0; pulse < 3; ++pulse) {
    uint32_t high = 0;
    for (int i = 0; i < 40; ++i) {
      power.seen(static_cast<uint16_t>(drive.statusword()));
      power.demand(PowerTarget::Enabled, true);
      high += power.controlword() == 0x80 ? 1 : 0;
      EXPECT_TRUE(i < 10 || power.controlword() == 0) << "never left high";
      drive.told(power.controlword());
      drive.step();
    }
    EXPECT_EQ(high, 10U);
    EXPECT_TRUE(power.fault());
    power.demand(PowerTarget::Enabled, false); // and again
  }
  drive.persistent = false;
  using Words = std::vector<unsigned>;
  EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Off, PowerState::SwitchOnDisabled, true),
            (Words{0x80, 0}));
  EXPECT_FALSE(power.fault());
}

TEST(Power, AFaultThatGoesByItselfMustBeAcknowledged) {
  PowerControl power(parameters());
  ModelDrive drive(2);
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled);
  drive.state = PowerState::Fault;
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Fault);
  drive.state = PowerState::SwitchOnDisabled;
  EXPECT_EQ(wordsUntil(power, drive, PowerTarget::Enabled, PowerState::SwitchOnDisabled),
            std::vector<unsigned>{0});
  EXPECT_TRUE(power.fault());
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled, true);
}

TEST(Power, AnAcknowledgementInVainDoesNotCountLater) {
  PowerControl power(parameters());
  ModelDrive drive(1);
  drive.persistent = true;
  drive.state = PowerState::Fault;
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Fault, true);
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Fault, false);
  drive.state = PowerState::SwitchOnDisabled;
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::SwitchOnDisabled, false);
  EXPECT_TRUE(power.fault());
}

TEST(Power, ATransitionThatDoesNotComeTimesOut) {
  for (const unsigned cycles : {19U, 20U, 21U}) {
    PowerControl power(parameters());
    for (unsigned i = 0; i < cycles; ++i) {
      power.seen(0x21);
      power.demand(PowerTarget::Enabled, false);
    }
    EXPECT_EQ(power.stuck(), cycles >= 20) << cycles;
    if (cycles > 20) {
      EXPECT_EQ(power.controlword(), 0) << "it stays off";
    }
    if (!power.stuck())
      continue;
    power.demand(PowerTarget::Enabled, true);
    EXPECT_FALSE(power.stuck());
    EXPECT_EQ(power.controlword(), 7) << "once more";
  }
}

TEST(Power, EachTransitionHasItsTime) {
  PowerControl power(parameters());
  for (const unsigned word : {0x40U, 0x21U, 0x23U, 0x27U})
    for (int i = 0; i < 19; ++i) {
      power.seen(static_cast<uint16_t>(word));
      power.demand(PowerTarget::Enabled, false);
    }
  for (int i = 0; i < 100; ++i) {
    power.seen(0x27);
    power.demand(PowerTarget::Enabled, false);
  }
  EXPECT_FALSE(power.stuck());
}

TEST(Power, ADriveOutOfReachIsSwitchedOffUntilSomebodyAcknowledges) {
  PowerControl power(parameters());
  ModelDrive drive(2);
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled);
  power.reach(false);
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::SwitchOnDisabled, true);
  power.reach(true);
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::SwitchOnDisabled);
  wordsUntil(power, drive, PowerTarget::Enabled, PowerState::Enabled, true);
}

// Whatever happens: words are legal for the state that was seen, no drive is enabled after a fault
// that nobody has acknowledged, and bit 7 is not held for longer than allowed.
TEST(Power, RandomLives) {
  std::mt19937 random(3);
  for (int life = 0; life < 300; ++life) {
    PowerControl power(
        parameters(random() % 2 != 0 ? PowerOff::Shutdown : PowerOff::DisableVoltage));
    ModelDrive drive(1 + random() % 3);
    PowerTarget target = PowerTarget::Off;
    bool acknowledge = false;
    bool faulty = false; // since the last acknowledgement
    unsigned held = 0;
    for (int i = 0; i < 500; ++i) {
      if (random() % 20 == 0)
        target = kTargets[random() % kTargets.size()];
      if (random() % 30 == 0)
        acknowledge = !acknowledge;
      if (random() % 60 == 0)
        drive.state = static_cast<PowerState>(random() % 8);
      drive.persistent = random() % 3 == 0;
      const unsigned seen = drive.statusword();
      power.seen(static_cast<uint16_t>(seen));
      faulty = faulty || (seen & 8U) != 0;
      if (acknowledge)
        faulty = (seen & 8U) != 0;
      power.demand(target, acknowledge);
      const unsigned word = power.controlword();
      ASSERT_TRUE(isLegal(modelState(seen), word)) << std::hex << seen << ' ' << word;
      if (word == 0x0F) {
        ASSERT_EQ(target, PowerTarget::Enabled);
        ASSERT_EQ(modelState(seen) == PowerState::SwitchedOn ||
                      modelState(seen) == PowerState::Enabled,
                  true);
        ASSERT_FALSE(power.fault());
      }
      if ((seen & 8U) != 0) {
        ASSERT_TRUE(power.fault());
      }
      held = word == 0x80 ? held + 1 : 0;
      ASSERT_LE(held, 10U);
      drive.told(word);
      drive.step();
    }
  }
}

} // namespace
} // namespace stride::can
