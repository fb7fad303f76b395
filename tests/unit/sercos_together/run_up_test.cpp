// The way up with the master: how long it takes, and every word of it.
#include "tests/unit/sercos_together/together.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace stride::sercos {
namespace {

class SercosRunUp : public testing::TestWithParam<size_t> {};

TEST_P(SercosRunUp, OfSoManyDrives) {
  const size_t count = GetParam();
  Together all({.drives = count, .megabits = count > 8 ? 16U : 2U});
  const size_t cycles = all.runUp();
  ASSERT_TRUE(all.allStarted()) << all.messages[0].text();
  EXPECT_EQ(all.master->actualPhase(), Phase::Four);
  EXPECT_EQ(all.master->counters().atLost, 0U);
  EXPECT_EQ(all.master->counters().mstLost, 0U);
  for (size_t i = 0; i < count; ++i) {
    EXPECT_EQ(all.drives[i]->phase(), Phase::Four);
    EXPECT_FALSE(all.drives[i]->hasError());
    EXPECT_FALSE(all.drives[i]->hasTorque());
    EXPECT_EQ(static_cast<int32_t>(all.status(i).position), 1000 * static_cast<int32_t>(i) - 70);
  }
  // Phase 1 asks all 254 addresses; in phase 2 the drives share the ring, in phase 3 they do not.
  EXPECT_GT(cycles, 254U);
  EXPECT_LT(cycles, 1500U + 400U * count);
  const size_t before = all.cycles;
  all.run(1000);
  EXPECT_EQ(all.cycles, before + 1000);
  EXPECT_TRUE(all.allStarted());
  EXPECT_EQ(all.master->counters().atLost, 0U);
}

INSTANTIATE_TEST_SUITE_P(Sizes, SercosRunUp, testing::Values(1, 4, 8, 32));

TEST(SercosRunUp, EveryTelegramAndSpeed) {
  for (const uint8_t type : {uint8_t{2}, uint8_t{4}, uint8_t{5}})
    for (const uint32_t megabits : {2U, 4U, 8U, 16U}) {
      Together all({.drives = 2, .cycle = 0.002, .megabits = megabits, .controlType = type});
      all.runUp();
      EXPECT_TRUE(all.allStarted()) << int{type} << ' ' << megabits << ": "
                                    << all.messages[0].text() << all.messages[1].text();
    }
}

TEST(SercosRunUp, ThePackProfile) {
  for (const PackProfile profile : {PackProfile::BasicA, PackProfile::Extended}) {
    Together all({.drives = 1, .controlType = 4, .profile = profile, .rotary = true});
    all.runUp();
    EXPECT_TRUE(all.allStarted()) << all.messages[0].text();
  }
  Together velocities(
      {.drives = 1, .controlType = 2, .profile = PackProfile::BasicB, .rotary = true});
  velocities.runUp();
  EXPECT_TRUE(velocities.allStarted()) << velocities.messages[0].text();
}

// ---- what stops it

TEST(SercosRunUp, WhatTheDriveRefusesIsToldWithItsReason) {
  struct Case {
    std::function<void(Together &)> disturb;
    const char *told;
  };
  const Case cases[] = {
      {[](Together &all) { all.drives[1]->setAddress(7); }, "address 2 does not answer"},
      {[](Together &all) { all.drives[1]->setAddress(1); }, "answers more than once"},
      {[](Together &all) { all.drives[1]->faults().leaves = true; }, "does not answer"},
      {[](Together &all) { all.drives[1]->faults().distortAts = 1000; }, "distorted"},
      {[](Together &all) { all.drives[1]->faults().mute = true; }, "does not answer"},
      {[](Together &all) {
         all.drives[1]->faults().refuses = true;
         all.drives[1]->faults().refused = idns::kAtStart;
       },
       "S-0-0006"},
      {[](Together &all) {
         all.drives[1]->faults().refuses = true;
         all.drives[1]->faults().refused = idns::kTelegramType;
         all.drives[1]->faults().reason = 0x7005;
       },
       "write-protected at this time"},
      {[](Together &all) { all.drives[1]->faults().failPhase3 = true; }, "S-0-0127"},
      {[](Together &all) { all.drives[1]->faults().failPhase4 = true; }, "S-0-0128"},
      {[](Together &all) { all.drives[1]->faults().busyCycles = 60; }, "does not answer"},
      {[](Together &all) { all.ring.faults().open = true; }, "the ring is open"},
      {[](Together &all) { all.ring.faults().leastLight = 101; }, "no light"},
      {[](Together &all) { all.drives[1]->faults().baudRate = 4; }, "does not answer"},
  };
  for (const Case &one : cases) {
    Together all({.drives = 3});
    one.disturb(all);
    all.runUp();
    EXPECT_TRUE(all.anyFailed()) << one.told;
    all.run(3);
    std::string told;
    for (const bus::Message &message : all.messages)
      told += std::string(message.text()) + '\n';
    EXPECT_NE(told.find(one.told), std::string::npos) << one.told << " in\n" << told;
    for (const auto &drive : all.drives)
      EXPECT_FALSE(drive->hasTorque());
  }
}

TEST(SercosRunUp, TenCyclesOfBusyAreBorne) {
  for (const uint32_t busy : {1U, 5U, 8U}) {
    Together all({.drives = 2});
    all.drives[0]->faults().busyCycles = busy;
    all.runUp();
    EXPECT_TRUE(all.allStarted()) << busy << ": " << all.messages[0].text();
  }
}

TEST(SercosRunUp, TooManyForTheirCycle) {
  Together all({.drives = 32, .cycle = 0.001});
  all.runUp();
  EXPECT_TRUE(all.anyFailed());
  all.run(2);
  EXPECT_NE(all.messages[0].text().find("the telegrams need"), std::string_view::npos)
      << all.messages[0].text();
}

// ---- every word

/// A line for each step of the service channels and each change of the phase.
class Trace {
public:
  void take(const MasterTelegrams &sent, const RingAnswers &answers) {
    mdt(sent); // of the cycle that ends
    ++cycle_;
    if (sent.phase != phase_) {
      phase_ = sent.phase;
      line("MST phase %u", static_cast<unsigned>(phase_));
    }
    for (const DriveTelegram &at : answers.ats())
      answer(at);
  }
  [[nodiscard]] std::string text() const { return text_.str(); }

private:
  void mdt(const MasterTelegrams &sent) {
    const bool all = sent.mdtAddress == kBroadcast;
    if (!sent.mdt || all != (phase_ >= Phase::Three) || phase_ == Phase::Zero)
      return; // nobody understands it
    if (phase_ == Phase::One && sent.mdtAddress <= 5)
      line("MDT to %u", sent.mdtAddress);
    if (phase_ == Phase::Two)
      step(sent.mdtAddress, wordAt(sent.mdtData, 0), wordAt(sent.mdtData, 2));
    for (size_t i = 0; all && i < 4; ++i) {
      const size_t place = i * (sent.mdtLength / 4U);
      step(static_cast<uint8_t>(i + 1), wordAt(sent.mdtData, place),
           wordAt(sent.mdtData, place + 2));
    }
  }
  template <class... Args> void line(const char *format, Args... args) {
    std::array<char, 120> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, args...);
    text_ << cycle_ << ' ' << buffer.data() << '\n';
  }
  void answer(const DriveTelegram &at) {
    const uint16_t status = wordAt(at.data, 0);
    if (phase_ == Phase::One) {
      line("AT of %u: %04X %04X", at.address, status, wordAt(at.data, 2));
      return;
    }
    uint32_t &last = answers_[at.address];
    const uint32_t now = status | uint32_t{wordAt(at.data, 2)} << 16U;
    if (now != last)
      line("  %u < %04X %04X", at.address, status, wordAt(at.data, 2));
    last = now;
  }
  void step(uint8_t address, uint16_t control, uint16_t word) {
    uint32_t &last = steps_[address];
    const uint32_t now = control | uint32_t{word} << 16U;
    if (now != last)
      line("%u > %04X %04X", address, control, word);
    last = now;
  }

  std::ostringstream text_;
  std::array<uint32_t, 256> answers_{};
  std::array<uint32_t, 256> steps_{};
  size_t cycle_ = 0;
  Phase phase_ = Phase::Zero;
};

/// The configuration of the manual's 11.2: 3 ms, 2 MBit/s, four drives.
TEST(SercosRunUp, FourDrivesWordByWord) {
  Together all({});
  Trace trace;
  all.watch->watch = [&](const MasterTelegrams &sent, const RingAnswers &answers) {
    trace.take(sent, answers);
  };
  all.runUp();
  ASSERT_TRUE(all.allStarted());
  const std::string path =
      std::string(STRIDE_SOURCE_DIR) + "/tests/unit/sercos_together/run_up_of_four.txt";
  if (std::getenv("STRIDE_BLESS") != nullptr)
    std::ofstream(path) << trace.text();
  std::ifstream file(path);
  std::ostringstream wanted;
  wanted << file.rdbuf();
  EXPECT_TRUE(trace.text() == wanted.str())
      << "another run-up than in run_up_of_four.txt; STRIDE_BLESS=1 writes it anew";
}

} // namespace
} // namespace stride::sercos
