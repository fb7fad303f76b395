// One node that is late, and two with one number.
#include "drivers/can/master/pdo_balance.hpp"

#include "tests/unit/can_master/can_bus.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <utility>

namespace stride::can {
namespace {

using CanBus = test::CanBusTest;

TEST(PdoBalance, ThreeMoreThanSyncsAreASecondNode) {
  PdoBalance balance;
  balance.count(3, 1);
  EXPECT_FALSE(balance.second());
  balance.count(2, 1);
  EXPECT_TRUE(balance.second());
  for (int i = 0; i < 1000; ++i)
    balance.count(0, 1);
  EXPECT_TRUE(balance.second()) << "until the node starts anew";
}

TEST(PdoBalance, SeveralSyncsInACycleHaveSeveralAnswers) {
  PdoBalance balance;
  for (int i = 0; i < 1000; ++i)
    balance.count(2, 2);
  EXPECT_FALSE(balance.second());
}

/// At the depth of the queue, and one beyond it.
TEST(PdoBalance, ABacklogIsAsDeepAsAQueue) {
  for (const int late : {1, 2, 5, 63, 64, 66, 67}) {
    PdoBalance balance;
    for (int i = 0; i < late; ++i)
      balance.count(0, 1);
    balance.count(static_cast<uint32_t>(late + 1), 1);
    EXPECT_EQ(balance.second(), late - PdoBalance::kDeepestBacklog >= PdoBalance::kMostExcess)
        << late;
  }
}

TEST(PdoBalance, ASingleFrameTooManyIsForgotten) {
  PdoBalance balance;
  for (int i = 0; i < 50; ++i) {
    balance.count(2, 1);
    for (uint32_t k = 0; k < PdoBalance::kForget; ++k)
      balance.count(1, 1);
    ASSERT_FALSE(balance.second()) << i;
  }
  for (int i = 0; i < 3; ++i) { // one cycle too few between them
    balance.count(2, 1);
    for (uint32_t k = 0; k + 1 < PdoBalance::kForget; ++k)
      balance.count(1, 1);
  }
  EXPECT_TRUE(balance.second());
}

/// Whatever its scheduler does, a node that answers each SYNC once is one node; two are found in
/// time, whatever theirs do.
TEST(PdoBalance, RandomDelays) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const unsigned pause = 1 + seed % 64; // longest, in cycles
    PdoBalance alone;
    PdoBalance both;
    std::array<uint32_t, 2> owed{};
    std::array<uint32_t, 2> sleeps{};
    for (int i = 0; i < 500; ++i) {
      std::array<uint32_t, 2> answers{};
      for (size_t k = 0; k < 2; ++k) {
        ++owed[k];
        if (sleeps[k] > 0)
          --sleeps[k];
        else if (random() % 20 == 0)
          sleeps[k] = static_cast<uint32_t>(random() % pause);
        if (sleeps[k] == 0)
          answers[k] = std::exchange(owed[k], 0);
      }
      alone.count(answers[0], 1);
      both.count(answers[0] + answers[1], 1);
      ASSERT_FALSE(alone.second()) << seed << " in cycle " << i;
    }
    EXPECT_TRUE(both.second()) << seed;
  }
}

/// A drive whose processor does something else for some cycles, and then answers all SYNCs.
class LateNode : public CanBus, public ::testing::WithParamInterface<int> {};

TEST_P(LateNode, ThatAnswersAllAtOnceIsOneNode) {
  addDrive(3).add({"pdo_timeout", "", 100});
  addDrive(4);
  start();
  const std::string one = nodes[0].atSync.front();
  for (int round = 0; round < 40; ++round) {
    nodes[0].atSync.clear();
    cycles(GetParam());
    nodes[0].atSync.assign(static_cast<size_t>(GetParam()) + 1, one);
    cycle();
    nodes[0].atSync = {one};
    cycles(round % 3);
    ASSERT_TRUE(communicates(0)) << round;
    ASSERT_TRUE(communicates(1)) << round;
  }
  EXPECT_FALSE(host.heard("duplicate"));
}

TEST_P(LateNode, TwoNodesAreFoundAfterAnyGap) {
  addDrive(3).add({"pdo_timeout", "", 100});
  addDrive(4);
  start();
  const std::string one = nodes[0].atSync.front();
  nodes[0].atSync.clear();
  cycles(GetParam());
  nodes[0].atSync = {one, one};
  const int bound = std::min(GetParam(), PdoBalance::kDeepestBacklog) + PdoBalance::kMostExcess;
  cycles(bound - 1);
  EXPECT_TRUE(communicates(1));
  cycle();
  EXPECT_FALSE(communicates(0));
  EXPECT_FALSE(communicates(1));
  EXPECT_TRUE(host.heard("duplicate node id"));
}

INSTANTIATE_TEST_SUITE_P(ByCycles, LateNode, ::testing::Values(1, 2, 5, 63));

/// A cycle may begin between two PDOs of one SYNC, again and again.
TEST_F(CanBus, OneOfTwoPdosMayComeInTheNextCycle) {
  bus::SetupParameters &drive = addDrive(3);
  drive.add({"rpdo1.map", "6040h\n607Ah", 0});
  drive.add({"tpdo1.map", "6041h", 0});
  drive.add({"tpdo2.map", "6064h", 0});
  const std::string status = "183#4002";
  const std::string position = "283#B80B0000";
  nodes[0].pdosInOperation = {status, position};
  start();
  for (int i = 0; i < 200; ++i) {
    nodes[0].atSync = {status};
    cycle();
    nodes[0].atSync = {position, status, position};
    cycle();
    ASSERT_TRUE(communicates(0)) << i;
  }
  nodes[0].atSync = {status, position, position};
  cycles(PdoBalance::kMostExcess);
  EXPECT_FALSE(communicates(0));
  EXPECT_TRUE(host.heard("duplicate node id"));
}

TEST_F(CanBus, NodesAnswerAForeignSyncToo) {
  addDrive(3);
  start();
  const std::string one = nodes[0].atSync.front();
  nodes[0].atSync = {"080#", one, one};
  cycles(300);
  EXPECT_TRUE(communicates(0));
  EXPECT_TRUE(host.heard("somebody else gives SYNC"));
}

} // namespace
} // namespace stride::can
