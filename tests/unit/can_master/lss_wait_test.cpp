// Nodes that do not answer by LSS at first, as they are still booting (lss_wait).
#include "tests/unit/can_master/lss_start_fixture.hpp"

#include <gmock/gmock-matchers.h>

namespace stride::can {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Kind = LssOutcome::Kind;
using LssWaitOf = LssStartOf;

/// Who is still booting does not answer at first.
TEST_F(LssWaitOf, ANodeThatBootsLateIsLookedForAgain) {
  masterConfig.nodes[1].lss.wait = 2;
  make();
  hasLss = false;
  for (int i = 0; i < 1300; ++i)
    EXPECT_EQ(cycle(), bus::StartUp::Busy);
  EXPECT_TRUE(host.heard("node 9 does not answer by LSS yet: it is looked for again (lss_wait)"));
  EXPECT_THAT(sent, Not(Contains("000#8205"))) << "nobody is reset meanwhile";
  hasLss = true;
  ASSERT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_EQ(boots, 1);
  EXPECT_FALSE(host.heard("it is looked for again")) << "it is said once";
  EXPECT_TRUE(host.heard("node 9 has got its number by LSS"));
}

TEST_F(LssWaitOf, ANodeThatNeverComesIsGivenUp) {
  masterConfig.nodes[1].lss.wait = 2;
  hasLss = false;
  EXPECT_EQ(run(), bus::StartUp::Failed);
  EXPECT_THAT(message, HasSubstr("No node with its identity answers by LSS, either"));
  EXPECT_TRUE(master->node(0).started());
  // An answer is awaited for 0.5 s, a boot-up for 2 s, an SDO for 0.5 s.
  EXPECT_GT(cycles, 2000 + 2000 + 500);
  EXPECT_LT(cycles, 2000 + 2 * 510 + 2000 + 500 + 50);
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "7E5#4344000000000000"), 5);
  // With its start-up the time begins anew.
  sent.clear();
  hasLss = true;
  EXPECT_EQ(run(), bus::StartUp::Started) << message;
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "7E5#4344000000000000"), 1);
}

TEST_F(LssWaitOf, NodesThatAreLookedForAgainTakeTurns) {
  NodeConfig absent = masterConfig.nodes[1];
  DriveWish wish;
  wish.node = 20;
  wish.controlType = 4;
  absent.plan = planDrive(wish).plan;
  absent.identity[3] = 100;
  absent.lss.wait = masterConfig.nodes[1].lss.wait = 3;
  masterConfig.nodes.insert(masterConfig.nodes.begin() + 1, absent);
  make();
  hasLss = false;
  for (int i = 0; i < 1100; ++i)
    (void)cycle(2);
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "7E5#4364000000000000"), 2);
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "7E5#4344000000000000"), 1);
  hasLss = true;
  ASSERT_EQ(run(2), bus::StartUp::Started) << message;
}

/// In cycles of 1 ms: at 300 ms it is given up, just below it is not.
TEST(LssWait, LooksAgainUntilItsTimeIsOver) {
  for (const auto &[passed, again] :
       {std::pair{0, true}, {298, true}, {299, true}, {300, false}, {301, false}, {9000, false}}) {
    NodeConfig config;
    config.plan.node = 9;
    config.cycle = 0.001;
    config.lss = {.wanted = true, .wait = 0.3};
    Node node(config);
    bus::News news;
    EXPECT_EQ(node.seek().node, 9);
    for (int i = 0; i < passed; ++i)
      node.endReceive(0, news);
    node.numbered({.kind = Kind::NotFound}, news);
    EXPECT_TRUE(node.wantsNumber()) << "that one began before its time was over";
    (void)node.seek();
    node.numbered({.kind = Kind::NotFound}, news);
    EXPECT_EQ(node.wantsNumber(), again) << passed;
    node.numbered({.kind = Kind::Refused}, news);
    EXPECT_FALSE(node.wantsNumber()) << "who answers is not looked for again";
  }
}

TEST(LssWait, WithoutItANodeIsLookedForOnce) {
  NodeConfig config;
  config.plan.node = 9;
  config.lss = {.wanted = true};
  Node node(config);
  bus::News news;
  (void)node.seek();
  node.numbered({.kind = Kind::NotFound}, news);
  EXPECT_FALSE(node.wantsNumber());
}

} // namespace
} // namespace stride::can
