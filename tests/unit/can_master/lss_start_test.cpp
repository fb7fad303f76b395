// Nodes that get their numbers by LSS before they start up, frame by frame.
#include "tests/unit/can_master/lss_start_fixture.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stride::can {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Kind = LssOutcome::Kind;

TEST(LssBitRate, ByTheTableOfTheStandard) {
  const std::vector<std::pair<uint32_t, uint8_t>> rates = {{1000, 0}, {800, 1}, {500, 2}, {250, 3},
                                                           {125, 4},  {50, 6},  {20, 7},  {10, 8}};
  for (const auto &[rate, index] : rates)
    EXPECT_EQ(lss::bitRateIndex(rate), index) << rate;
  for (const uint32_t rate : {0U, 100U, 999U, 1001U, 9U})
    EXPECT_EQ(lss::bitRateIndex(rate), lss::kNoBitRate) << rate;
}

/// A conversation: what is sent, and the answers by what they answer.
class AssignmentOf : public ::testing::Test {
protected:
  AssignmentOf() {
    order.identity = {0xA1B2C3D4, 0x22, 0xFFFFFFFF, 0x1234};
    order.node = 17;
    order.bitRate = 2;
    order.store = true;
    answers = {{"7E543", "4400000000000000"},
               {"7E55E", "5EFF000000000000"},
               {"7E511", "1100000000000000"},
               {"7E513", "1300000000000000"},
               {"7E517", "1700000000000000"}};
  }
  void run() {
    lss.begin(order);
    for (cycles = 0; lss.busy() && cycles < 100; ++cycles) {
      lss.cycle();
      if (!lss.pending())
        continue;
      const Frame frame = lss.nextFrame();
      sent.push_back(test::text(frame));
      lss.sent();
      if (const auto found = answers.find("7E5" + sent.back().substr(4, 2)); found != answers.end())
        lss.received(test::frame("7E4#" + found->second));
    }
    ASSERT_FALSE(lss.busy());
  }

  LssOrder order;
  LssAssignment lss{7};
  std::map<std::string, std::string> answers;
  std::vector<std::string> sent;
  int cycles = 0;
};

TEST_F(AssignmentOf, ANodeWithoutANumberForGood) {
  run();
  EXPECT_THAT(sent,
              ElementsAre("7E5#0400000000000000", "7E5#40D4C3B2A1000000", "7E5#4122000000000000",
                          "7E5#42FFFFFFFF000000", "7E5#4334120000000000", "7E5#5E00000000000000",
                          "7E5#1111000000000000", "7E5#1300020000000000", "7E5#1700000000000000",
                          "7E5#0400000000000000"));
  EXPECT_EQ(lss.outcome().kind, Kind::Assigned);
  EXPECT_EQ(lss.outcome().before, lss::kNoNode);
  EXPECT_FALSE(lss.outcome().notStored);
  EXPECT_FALSE(lss.outcome().noBitRate);
}

TEST_F(AssignmentOf, OnlyForThisTime) {
  order.store = false;
  run();
  EXPECT_EQ(sent.size(), 8U);
  EXPECT_EQ(sent[6], "7E5#1111000000000000");
  EXPECT_EQ(lss.outcome().kind, Kind::Assigned);
}

TEST_F(AssignmentOf, ABitRateThatHasNoPlaceInTheTableIsLeftOut) {
  order.bitRate = lss::kNoBitRate;
  run();
  EXPECT_THAT(sent, Not(Contains(HasSubstr("7E5#13"))));
  EXPECT_THAT(sent, Contains("7E5#1700000000000000"));
}

TEST_F(AssignmentOf, WhoHasTheNumberIsLeftAlone) {
  answers["7E55E"] = "5E11000000000000";
  run();
  EXPECT_EQ(lss.outcome().kind, Kind::Unchanged);
  EXPECT_EQ(sent.size(), 7U);
  EXPECT_EQ(sent.back(), "7E5#0400000000000000") << "it is let go";
}

TEST_F(AssignmentOf, NobodyAnswersInTime) {
  answers.clear();
  run();
  EXPECT_EQ(lss.outcome().kind, Kind::NotFound);
  EXPECT_EQ(sent.size(), 6U);
  EXPECT_EQ(sent.back(), "7E5#0400000000000000");
  EXPECT_EQ(cycles, 4 + 1 + 7 + 1 - 1) << "the time for an answer, and no longer";
}

TEST_F(AssignmentOf, TheNumberIsRefused) {
  answers["7E511"] = "1101000000000000";
  run();
  EXPECT_EQ(lss.outcome().kind, Kind::Refused);
  EXPECT_THAT(sent, Not(Contains("7E5#1700000000000000")));
  EXPECT_EQ(sent.back(), "7E5#0400000000000000");
}

TEST_F(AssignmentOf, ItCeasesToAnswer) {
  answers.erase("7E55E");
  run();
  EXPECT_EQ(lss.outcome().kind, Kind::Refused);
}

TEST_F(AssignmentOf, WhatCannotBeStoredIsToldAndNoMore) {
  answers["7E513"] = "1301000000000000";
  answers["7E517"] = "1702000000000000";
  run();
  EXPECT_EQ(lss.outcome().kind, Kind::Assigned);
  EXPECT_TRUE(lss.outcome().noBitRate);
  EXPECT_TRUE(lss.outcome().notStored);
}

/// Answers to other questions, of other lengths, or before there is a question.
TEST_F(AssignmentOf, WhatNobodyHasAskedIsNothing) {
  lss.received(test::frame("7E4#4400000000000000"));
  EXPECT_FALSE(lss.busy());
  lss.begin(order);
  for (int i = 0; i < 4; ++i) {
    lss.received(test::frame("7E4#4400000000000000"));
    lss.sent();
  }
  lss.received(test::frame("7E4#4400000000000000"));
  EXPECT_TRUE(lss.pending()) << "the last part has not been sent";
  lss.sent();
  lss.received(test::frame("7E4#44000000000000"));
  EXPECT_FALSE(lss.pending());
  lss.received(test::frame("7E4#4400000000000000"));
  EXPECT_TRUE(lss.pending());
  EXPECT_EQ(test::text(lss.nextFrame()), "7E5#5E00000000000000");
}

/// It tells that it has stored, so late that the next node is being asked already.
TEST_F(AssignmentOf, ALateAnswerIsNoneToTheNextQuestion) {
  const std::vector<std::string> steps = {"44", "5E", "11", "13", "17"};
  lss.begin(order);
  for (int i = 0; i < 4; ++i)
    lss.sent();
  for (const std::string &step : steps) {
    ASSERT_TRUE(lss.pending());
    lss.sent();
    for (const std::string &other : steps)
      if (other != step)
        lss.received(test::frame("7E4#" + other + "05000000000000"));
    ASSERT_FALSE(lss.pending()) << step;
    lss.cycle();
    lss.received(test::frame("7E4#" + answers["7E5" + (step == "44" ? "43" : step)]));
  }
  lss.sent();
  ASSERT_FALSE(lss.busy());
  EXPECT_EQ(lss.outcome().kind, Kind::Assigned);
  EXPECT_EQ(lss.outcome().before, lss::kNoNode);
  EXPECT_FALSE(lss.outcome().notStored);
  EXPECT_FALSE(lss.outcome().noBitRate);
}

TEST_F(LssStartOf, ANodeWithoutANumberStartsUp) {
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_EQ(boots, 1);
  EXPECT_LT(cycles, 400) << "nobody waits in vain";
  EXPECT_TRUE(host.heard("node 9 has got its number by LSS"));
  EXPECT_LT(place("7E5#1109000000000000"), place("000#8205")) << "no node is reset before that";
  EXPECT_LT(place("7E5#1109000000000000"), place("000#8209"));
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "7E5#1109000000000000"), 1);
  sent.clear();
  for (int i = 0; i < 2000; ++i)
    (void)cycle();
  EXPECT_THAT(sent, Not(Contains(HasSubstr("7E5#")))) << "in operation there is no LSS";
  EXPECT_TRUE(master->node(1).communication());
}

TEST_F(LssStartOf, ANodeWithAnotherNumberIsResetByThat) {
  before = 33;
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_LT(place("7E5#1109000000000000"), place("000#8221"));
  EXPECT_LT(place("000#8221"), place("000#8209"));
  EXPECT_TRUE(host.heard("node 9 has got its number by LSS, in place of 33"));
}

TEST_F(LssStartOf, ANodeWithItsNumberIsNotChanged) {
  before = 9;
  second.answers = second.boots = true;
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_THAT(sent, Not(Contains(HasSubstr("7E5#11"))));
  EXPECT_FALSE(host.heard("LSS"));
}

TEST_F(LssStartOf, ANodeWithoutLssIsServedByItsNumber) {
  hasLss = false;
  second.answers = second.boots = true;
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
}

TEST_F(LssStartOf, NobodyIsThere) {
  hasLss = false;
  EXPECT_EQ(run(), bus::StartUp::Failed);
  EXPECT_EQ(message, "node 9 does not answer: is it on, with this number and bit rate? No node "
                     "with its identity answers by LSS, either");
  EXPECT_TRUE(master->node(0).started()) << "the other one does not mind";
}

TEST_F(LssStartOf, ANumberThatIsRefused) {
  refuses = true;
  EXPECT_EQ(run(), bus::StartUp::Failed);
  EXPECT_EQ(message, "node 9: the device refuses this number (LSS)");
}

/// Else a drive that moves would be reset with the one that has its number by mistake.
TEST_F(LssStartOf, ANumberOfANodeInOperationIsNotReset) {
  hasLss = false;
  EXPECT_EQ(run(), bus::StartUp::Failed);
  ASSERT_TRUE(master->node(0).started());
  hasLss = true;
  before = 5;
  sent.clear();
  EXPECT_EQ(run(), bus::StartUp::Failed) << "started anew";
  EXPECT_EQ(message, "node 9: the device has the number of node 5, which is in operation: give it "
                     "another one (stride can lss), or stop that node first");
  EXPECT_THAT(sent, Not(Contains("000#8205")));
  EXPECT_TRUE(master->node(0).communication());
}

/// What it has stored it has after it was switched off and on.
TEST_F(LssStartOf, AStoredNumberOfANodeInOperation) {
  masterConfig.nodes[1].lss.store = true;
  hasLss = false;
  EXPECT_EQ(run(), bus::StartUp::Failed);
  hasLss = true;
  before = 5;
  EXPECT_EQ(run(), bus::StartUp::Failed) << "started anew";
  EXPECT_EQ(message, "node 9: the device has the number of node 5, which is in operation: switch "
                     "it off and on");
  stores = false;
  EXPECT_EQ(run(), bus::StartUp::Failed) << "started anew";
  EXPECT_THAT(message, HasSubstr("or stop that node first"));
}

/// A node that has been reset and is being configured would lose what it has been told.
TEST_F(LssStartOf, ANumberOfANodeThatIsStartingIsNotReset) {
  hasLss = false;
  first.starts = false; // it is told to, and waits for 2 s
  make();
  for (int i = 0; i < 900; ++i)
    (void)cycle();
  ASSERT_THAT(sent, Contains("000#0105"));
  hasLss = true;
  before = 5;
  master->node(1).reset();
  sent.clear();
  EXPECT_EQ(run(), bus::StartUp::Failed);
  EXPECT_THAT(message, HasSubstr("the device has the number of node 5, which is in operation"));
  EXPECT_THAT(sent, Not(Contains("000#8205")));
}

/// Each absent node takes its time; the patience for a boot-up begins after them.
TEST_F(LssStartOf, AfterManyAbsentNodesABootUpIsAwaited) {
  std::vector<NodeConfig> absent(4, masterConfig.nodes[1]);
  for (size_t i = 0; i < absent.size(); ++i) {
    DriveWish wish;
    wish.node = static_cast<uint8_t>(20 + i);
    wish.controlType = 4;
    absent[i].plan = planDrive(wish).plan;
    absent[i].identity[3] = static_cast<uint32_t>(100 + i);
  }
  masterConfig.nodes.insert(masterConfig.nodes.begin() + 1, absent.begin(), absent.end());
  before = 33;
  bootTime = 300;
  ASSERT_EQ(run(1 + absent.size()), bus::StartUp::Started) << message;
  EXPECT_FALSE(resetsTooEarly);
  EXPECT_EQ(boots, 1);
  EXPECT_GT(cycles, 2000 + bootTime);
}

/// A reset of the whole node would bring back the number that it has stored.
TEST_F(LssStartOf, ANodeIsResetWholeOnlyIfItKeepsItsNumber) {
  masterConfig.nodes[1].reset = NodeConfig::Reset::Node;
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_THAT(sent, Contains("000#8209"));
  EXPECT_THAT(sent, Not(Contains("000#8109")));
}
TEST_F(LssStartOf, ANodeThatStoresItsNumberIsResetWhole) {
  masterConfig.nodes[1].reset = NodeConfig::Reset::Node;
  masterConfig.nodes[1].lss.store = true;
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_THAT(sent, Contains("000#8109"));
  EXPECT_THAT(sent, Not(Contains("000#8209")));
}
TEST_F(LssStartOf, ANodeThatCannotStoreItsNumberIsNotResetWhole) {
  masterConfig.nodes[1].reset = NodeConfig::Reset::Node;
  masterConfig.nodes[1].lss.store = true;
  stores = false;
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_THAT(sent, Contains("000#8209"));
  EXPECT_THAT(sent, Not(Contains("000#8109")));
}

/// A start-up that begins anew looks for its node anew; the bus begins before anybody asks.
TEST_F(LssStartOf, EachStartUpOnce) {
  make();
  for (int i = 0; i < 50; ++i) {
    master->executeStart();
    master->executeEnd();
  }
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "7E5#1109000000000000"), 1);
  EXPECT_THAT(sent, Not(Contains("000#8209")));
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "7E5#4344000000000000"), 1);
  before = 9;
  master->node(1).reset();
  sent.clear();
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "7E5#4344000000000000"), 1);
}

} // namespace
} // namespace stride::can
