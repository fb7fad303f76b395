// The list of errors of a node (1003h): when it is read, and what is said of it.
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

namespace stride::can {
namespace {

class ErrorList : public test::CanBusTest {
protected:
  ErrorList() { addDrive(3); }
  void hasErrors(std::initializer_list<uint32_t> entries) {
    nodes[0].values[0x100300] = {1, static_cast<uint32_t>(entries.size())};
    uint32_t sub = 0;
    for (const uint32_t entry : entries)
      nodes[0].values[0x100300 + ++sub] = {4, entry};
  }
  /// So often an object was asked for: "1003" is 0310 there.
  long asked(const std::string &object) const {
    return std::count_if(port->allSent.begin(), port->allSent.end(), [&](const Frame &frame) {
      return test::text(frame) == "603#40" + object + "00000000";
    });
  }
  void emergency(const std::string &bytes) {
    nodes[0].say(0x080, bytes);
    cycles(8);
  }
};

constexpr const char *kRegister = "011000";
constexpr const char *kCount = "031000";
constexpr const char *kNewest = "031001";

TEST_F(ErrorList, WhatAnEmcyDoesNotSayIsSaid) {
  start();
  hasErrors({0x00123210, 0x00004310});
  emergency("1032010000000000");
  EXPECT_TRUE(host.heard("node 3 reports: overvoltage of the DC link (EMCY 16#3210)"));
  EXPECT_TRUE(host.heard("node 3: the newest of 2 errors in its list (1003h) is 16#00123210: "
                         "overvoltage of the DC link"));
  EXPECT_EQ(asked(kCount), 1);
  EXPECT_EQ(asked(kNewest), 1);
  // The same once more is said once.
  emergency("1032010000000000");
  EXPECT_EQ(asked(kNewest), 2);
  EXPECT_FALSE(host.heard("in its list"));
  hasErrors({0x00134310, 0x00123210, 0x00004310});
  emergency("1043010000000000");
  EXPECT_TRUE(host.heard("the newest of 3 errors in its list (1003h) is 16#00134310"));
}

/// As often as it comes, unless it has been there all the time.
TEST_F(ErrorList, AnErrorThatGoesAndReturnsIsSaidAgain) {
  start();
  hasErrors({0x00123210});
  emergency("1032010000000000");
  EXPECT_TRUE(host.heard("in its list (1003h) is 16#00123210"));
  emergency("1032010000000000");
  EXPECT_FALSE(host.heard("in its list"));
  emergency("0000000000000000");
  EXPECT_TRUE(host.heard("node 3: its error has gone"));
  emergency("1032010000000000");
  EXPECT_TRUE(host.heard("in its list (1003h) is 16#00123210"));
}

TEST_F(ErrorList, AnErrorThatGoesWhileItIsReadIsSaidAgainWhenItReturns) {
  start();
  hasErrors({0x00123210});
  nodes[0].say(0x080, "1032010000000000");
  cycle();
  nodes[0].say(0x080, "0000000000000000");
  cycles(8);
  EXPECT_TRUE(host.heard("in its list (1003h) is 16#00123210"));
  emergency("1032010000000000");
  EXPECT_TRUE(host.heard("in its list (1003h) is 16#00123210"));
}

/// A fault without a message is over when bit 3 of the statusword falls.
TEST_F(ErrorList, AFaultThatReturnsIsSaidAgain) {
  start();
  enable(0);
  hasErrors({0x00058611});
  for (int i = 0; i < 2; ++i) {
    shows(0, 0x208, 1000);
    cycles(12);
    EXPECT_TRUE(host.heard("in its list (1003h) is 16#00058611")) << i;
    shows(0, 0x240, 1000);
    commands[0].errorAckn = true;
    cycles(3);
    commands[0].errorAckn = false;
    cycles(2);
  }
}

TEST_F(ErrorList, WhatAnEmcySaysIsNotSaidTwice) {
  start();
  hasErrors({0x00003210});
  emergency("1032010000000000");
  EXPECT_EQ(asked(kNewest), 1);
  EXPECT_FALSE(host.heard("in its list"));
}

/// The list has another error than the message: both count.
TEST_F(ErrorList, AnotherErrorThanTheEmcy) {
  start();
  hasErrors({0x00007305});
  emergency("00FF010000000000");
  EXPECT_TRUE(host.heard("the newest of 1 error in its list (1003h) is 16#00007305: sensor"));
}

TEST_F(ErrorList, AnErrorThatHasGoneIsNotAskedFor) {
  start();
  hasErrors({0x00123210});
  emergency("0000000000000000");
  EXPECT_EQ(asked(kCount), 0);
}

TEST_F(ErrorList, AnEmptyListIsNone) {
  start();
  hasErrors({});
  emergency("1032010000000000");
  EXPECT_EQ(asked(kCount), 1);
  EXPECT_EQ(asked(kNewest), 0);
  emergency("1032010000000000");
  EXPECT_EQ(asked(kCount), 2) << "it may have something the next time";
}

TEST_F(ErrorList, ANodeWithoutItIsAskedOnce) {
  start();
  emergency("1032010000000000");
  emergency("1043010000000000");
  EXPECT_EQ(asked(kCount), 1);
  // After its next start-up it may be another device.
  driver->reset(0);
  started[0] = false;
  start();
  hasErrors({0x00123210});
  emergency("1032010000000000");
  EXPECT_EQ(asked(kCount), 2);
  EXPECT_EQ(asked(kNewest), 1);
}

/// It has the object and does not give it now: that is no reason not to ask again.
TEST_F(ErrorList, ARefusalIsNotAnAbsence) {
  start();
  hasErrors({0x00123210});
  nodes[0].aborts[0x100300] = 0x08000022;
  emergency("1032010000000000");
  EXPECT_EQ(asked(kNewest), 0);
  nodes[0].aborts.clear();
  emergency("1032010000000000");
  EXPECT_EQ(asked(kNewest), 1);
}

TEST_F(ErrorList, ErrorsMeanwhileAreAskedForOnceMore) {
  start();
  hasErrors({0x00123210});
  for (int i = 0; i < 4; ++i)
    nodes[0].say(0x080, "1032010000000000");
  cycles(20);
  EXPECT_EQ(asked(kNewest), 2) << "they came at once";
  nodes[0].say(0x080, "1032010000000000");
  cycle();
  nodes[0].say(0x080, "1043010000000000"); // it is under way
  cycles(20);
  EXPECT_EQ(asked(kNewest), 4);
}

/// Without 603Fh and without a message the number of a fault is in the list.
TEST_F(ErrorList, AFaultWithoutAnyOtherNumber) {
  start();
  enable(0);
  hasErrors({0x00058611, 0x00003210});
  shows(0, 0x208, 1000);
  cycles(12);
  EXPECT_TRUE(driver->status(0).error);
  EXPECT_EQ(driver->status(0).errorId, 0x8611);
  EXPECT_TRUE(host.heard("the newest of 2 errors in its list (1003h) is 16#00058611"));
  shows(0, 0x240, 1000);
  commands[0].errorAckn = true;
  cycles(3);
  EXPECT_EQ(driver->status(0).errorId, 0);
  commands[0].errorAckn = false;
  cycles(2);
  // The next fault is asked for anew.
  hasErrors({0x00004310, 0x00058611, 0x00003210});
  shows(0, 0x208, 1000);
  cycles(12);
  EXPECT_EQ(driver->status(0).errorId, 0x4310);
}

TEST_F(ErrorList, TheNumberOfAFaultIs603FhIfTheDriveHasIt) {
  start();
  enable(0);
  hasErrors({0x00058611});
  nodes[0].values[0x603F00] = {2, 0x3210};
  shows(0, 0x208, 1000);
  cycles(12);
  EXPECT_EQ(driver->status(0).errorId, 0x3210);
  EXPECT_EQ(asked(kNewest), 1);
}

TEST_F(ErrorList, ANodeThatStartsWithAnError) {
  nodes[0].values[0x100100] = {1, 0x11};
  hasErrors({0x00128130});
  make();
  cycles(3000);
  ASSERT_TRUE(allStarted());
  EXPECT_EQ(asked(kRegister), 1);
  EXPECT_TRUE(host.heard("node 3: the newest of 1 error in its list (1003h) is 16#00128130: the "
                         "node misses heartbeat or guarding"));
  EXPECT_FALSE(host.heard("1001h")) << "the list says more";
}

TEST_F(ErrorList, ANodeThatStartsWithAnErrorAndHasNoList) {
  nodes[0].values[0x100100] = {1, 0x11};
  make();
  cycles(3000);
  ASSERT_TRUE(allStarted());
  EXPECT_TRUE(host.heard("node 3 starts with an error: its error register (1001h) is 16#11"));
  EXPECT_EQ(asked(kCount), 1);
}

TEST_F(ErrorList, ANodeThatStartsWithoutAnError) {
  nodes[0].values[0x100100] = {1, 0};
  hasErrors({0x00128130}); // long ago
  make();
  cycles(3000);
  ASSERT_TRUE(allStarted());
  EXPECT_EQ(asked(kRegister), 1);
  EXPECT_EQ(asked(kCount), 0);
  EXPECT_THAT(host.news, ::testing::IsEmpty());
}

/// Why a device refuses what it is told may be in the list.
TEST_F(ErrorList, ANodeThatCannotStart) {
  nodes[0].values[0x100100] = {1, 0x05};
  hasErrors({0x00423220});
  nodes[0].writeAborts[0x606000] = 0x08000022;
  make();
  for (int i = 0; i < 3000 && message.text().empty(); ++i) {
    cycle();
    if (i == 60)
      nodes[0].say(0x080, "2032050000000000");
  }
  EXPECT_THAT(std::string(message.text()),
              ::testing::EndsWith("; it reports: undervoltage of the DC link (EMCY 16#3220)"));
  started[0] = true; // nobody tries again
  cycles(20);
  EXPECT_TRUE(host.heard("the newest of 1 error in its list (1003h) is 16#00423220"));
  EXPECT_EQ(asked(kRegister), 1);
}

/// Who does not answer is not asked for more.
TEST_F(ErrorList, ANodeThatIsNotThere) {
  nodes[0].answers = nodes[0].boots = false;
  make();
  cycles(4000);
  EXPECT_FALSE(message.text().empty());
  EXPECT_EQ(asked(kRegister), 0);
}

} // namespace
} // namespace stride::can
