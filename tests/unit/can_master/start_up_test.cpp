// How nodes are brought into operation, and each way in which that fails.
#include "tests/unit/can_master/start_up_fixture.hpp"

namespace stride::can {
namespace {

using test::StartUpOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(StartUpOf, ADriveInOrder) {
  config.parameters = {{{0x6098, 0}, 1, 35}, {{0x6099, 1}, 4, 1000}};
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  const std::vector<std::string> &w = node.written;
  EXPECT_THAT(w, ElementsAre("1400:1/4=80000205", "1600:0/1=0", "1600:1/4=60400010",
                             "1600:2/4=607A0020", "1600:0/1=2", "1400:2/1=1", "1400:1/4=205",
                             "1401:1/4=80000305", "1402:1/4=80000405", "1403:1/4=80000505",
                             "1800:1/4=80000185", "1A00:0/1=0", "1A00:1/4=60410010",
                             "1A00:2/4=60640020", "1A00:0/1=2", "1800:2/1=1", "1800:1/4=185",
                             "1801:1/4=80000285", "1802:1/4=80000385", "1803:1/4=80000485",
                             "6098:0/1=23", "6099:1/4=3E8", w[22], w[23], "60C2:1/1=1",
                             "60C2:2/1=FD", "6060:0/1=8", "1016:1/4=7E0096", "1017:0/2=64"));
  EXPECT_THAT(w[22], HasSubstr("1020:1/4="));
  EXPECT_THAT(w[23], HasSubstr("1020:2/4="));
  EXPECT_THAT(sent, Contains("000#8205"));
  EXPECT_THAT(sent, Contains("000#0105"));
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end())) << "progress only goes on";
  EXPECT_LE(seen.back(), 99);
  EXPECT_EQ(seen.front(), 0);
  for (const int step : {0, 10, 15, 20, 25, 45, 60, 75, 85, 95})
    EXPECT_THAT(seen, Contains(step));
  const bus::DriveStatus status = master->node(0).status();
  EXPECT_TRUE(status.communication);
  EXPECT_EQ(status.position, 0x103U);
  EXPECT_EQ(status.controllerMode, 3);
  EXPECT_TRUE(host.news.empty()) << host.news.front();
}

TEST_F(StartUpOf, OneFrameInEachCycleAtMost) {
  make();
  for (int i = 0; i < 300; ++i) {
    sent.clear();
    (void)cycle();
    EXPECT_LE(std::count_if(sent.begin(), sent.end(),
                            [](const std::string &one) { return one.starts_with("605#"); }),
              1);
  }
  EXPECT_TRUE(master->node(0).started());
}

TEST_F(StartUpOf, ADriveWithoutBootUpIsAskedAfterTwoSeconds) {
  node.boots = false;
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  const auto first = std::find(seen.begin(), seen.end(), 10);
  EXPECT_NEAR(static_cast<double>(first - seen.begin()), 2000, 2);
}

TEST_F(StartUpOf, ANodeThatIsNotThere) {
  node.boots = node.answers = false;
  expectFailure("node 5 does not answer");
  EXPECT_NEAR(cycles, 2000 + 500, 5);
}

TEST_F(StartUpOf, ANodeThatStopsAnswering) {
  make();
  while (progress < 30)
    ASSERT_EQ(cycle(), bus::StartUp::Busy);
  node.answers = false;
  expectFailure("no answer in time");
  EXPECT_THAT(text(), HasSubstr("16#05040000"));
}

TEST_F(StartUpOf, AnotherKindOfDevice) {
  node.values[0x100000] = {4, 0x00030191};
  expectFailure("no drive of CiA 402");
  EXPECT_THAT(text(), HasSubstr("16#00030191"));
}

TEST_F(StartUpOf, TheWrongDevice) {
  config.identity = {0x11, 0, 0x33, 0};
  node.values[0x101801] = {4, 0x11};
  node.values[0x101802] = {4, 0x99};
  node.values[0x101803] = {4, 0x34};
  expectFailure("another device: 16#1018:3 is 16#00000034, expected 16#00000033");
}

TEST_F(StartUpOf, TheRightDevice) {
  config.identity = {0x11, 0x22, 0x33, 0x44};
  for (uint32_t i = 1; i <= 4; ++i)
    node.values[0x101800 + i] = {4, 0x11 * i};
  EXPECT_EQ(run(), bus::StartUp::Started) << text();
}

TEST_F(StartUpOf, AMappingThatIsRefused) {
  node.aborts[0x1A0002] = 0x06040041;
  expectFailure("16#1A00:2 := 16#60640020: the object cannot be mapped into a PDO");
}

TEST_F(StartUpOf, AParameterThatIsRefused) {
  config.parameters = {{{0x6098, 0}, 1, 99}};
  node.aborts[0x609800] = 0x06090030;
  expectFailure("16#6098:0 := 16#63: the value is not allowed (abort code 16#06090030)");
}

TEST_F(StartUpOf, FewPdosAreEnough) {
  for (const uint32_t missing : {0x140101U, 0x140201U, 0x140301U, 0x180101U, 0x180201U, 0x180301U})
    node.aborts[missing] = 0x06020000;
  EXPECT_EQ(run(), bus::StartUp::Started) << text();
}

TEST_F(StartUpOf, ATpdoKeepsThatNobodyMayAskForIt) {
  node.values[0x180001] = {4, 0x40000185};
  node.values[0x180101] = {4, 0x00000285};
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_THAT(node.written, Contains("1800:1/4=C0000185"));
  EXPECT_THAT(node.written, Contains("1800:1/4=40000185"));
  EXPECT_THAT(node.written, Contains("1801:1/4=80000285"));
}

TEST_F(StartUpOf, TheConfigurationIsWrittenOnce) {
  config.reset = NodeConfig::Reset::None;
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_THAT(sent, Contains("000#8005"));
  const size_t first = node.written.size();
  const int firstCycles = cycles;
  node.written.clear();
  master->node(0).reset();
  cycles = 0;
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_LT(node.written.size(), first - 20);
  EXPECT_LT(cycles, firstCycles - 40);
  // Something has changed in between.
  node.values[0x102002].value ^= 1;
  node.written.clear();
  master->node(0).reset();
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_EQ(node.written.size(), first);
}

TEST_F(StartUpOf, ADriveWithoutTheModes) {
  node.values[0x650200] = {4, 0x05}; // profile position and velocity
  expectFailure("no mode of operation");
  EXPECT_THAT(text(), HasSubstr("16#00000005"));
}

TEST_F(StartUpOf, ADriveThatInterpolates) {
  node.values[0x650200] = {4, 0x41};
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_THAT(node.written, Contains("1600:2/4=60C10120"));
  EXPECT_THAT(node.written, Contains("6060:0/1=7"));
  EXPECT_EQ(master->node(0).status().controllerMode, 3);
}

TEST_F(StartUpOf, AModeThatIsNotTaken) {
  node.modeFollows = false;
  node.values[0x606100] = {1, 1};
  expectFailure("does not take mode of operation 8: it shows 16#01");
}

TEST_F(StartUpOf, TorqueNeedsARatedTorque) {
  DriveWish wish;
  wish.node = 5;
  wish.controlType = 1;
  config.plan = planDrive(wish).plan;
  node.pdosInOperation = {"185#4002"};
  expectFailure("torque_rated");
  node.values[0x607600] = {4, 2500};
  master->node(0).reset();
  cycles = 0;
  EXPECT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_EQ(master->node(0).drive().controllerModes(), 2);
}

TEST_F(StartUpOf, ALimitedRangeOfPositions) {
  node.values[0x607B01] = {4, 0};
  node.values[0x607B02] = {4, 359999};
  expectFailure("limits the range of positions");
  node.values[0x607B01] = {4, 0x80000000};
  node.values[0x607B02] = {4, 0x7FFFFFFF};
  master->node(0).reset();
  cycles = 0;
  EXPECT_EQ(run(), bus::StartUp::Started) << text();
}

TEST_F(StartUpOf, ANodeThatStaysPreOperational) {
  node.starts = false;
  expectFailure("does not become operational");
}

TEST_F(StartUpOf, ANodeWithoutPdos) {
  node.pdosInOperation.clear();
  expectFailure("sends no PDO");
}

TEST_F(StartUpOf, PdosOfAnotherLength) {
  node.pdosInOperation = {"185#4002"};
  expectFailure("sends no PDO");
}

TEST_F(StartUpOf, TwoBootUps) {
  make();
  while (progress < 30)
    ASSERT_EQ(cycle(), bus::StartUp::Busy);
  node.say(0x700, "00");
  expectFailure("node 5 has booted twice: duplicate node id");
}

TEST_F(StartUpOf, TwoAnswers) {
  make();
  while (progress < 30)
    ASSERT_EQ(cycle(), bus::StartUp::Busy);
  node.say(0x580, "6000160000000000");
  node.say(0x580, "6000160000000000");
  EXPECT_EQ(run(), bus::StartUp::Failed);
}

TEST_F(StartUpOf, ALateBootUpBeginsAnew) {
  node.boots = false;
  make();
  while (progress < 40)
    ASSERT_EQ(cycle(), bus::StartUp::Busy);
  const size_t before = node.written.size();
  node.say(0x700, "00");
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_EQ(std::count(node.written.begin(), node.written.end(), "1600:0/1=0"), 2);
  EXPECT_GT(before, 5U);
}

TEST_F(StartUpOf, ANodeWithoutHeartbeatsIsSaidToBeSo) {
  node.aborts[0x101601] = 0x06020000;
  node.aborts[0x101700] = 0x06020000;
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_TRUE(host.heard("no consumer heartbeat (1016h)"));
  EXPECT_TRUE(host.heard("no heartbeat (1017h)"));
  EXPECT_EQ(master->node(0).supervision().kind(), Supervision::Kind::None);
}

TEST_F(StartUpOf, NodeGuarding) {
  config.guard = 0.05;
  make();
  for (int i = 0; i < 400 && !master->node(0).started(); ++i) {
    (void)cycle();
    if (std::find(sent.begin(), sent.end(), "705#R") != sent.end()) {
      node.say(0x700, "05");
      sent.clear();
    }
  }
  ASSERT_TRUE(master->node(0).started()) << text();
  EXPECT_THAT(node.written, Contains("100C:0/2=32"));
  EXPECT_THAT(node.written, Contains("100D:0/1=3"));
  EXPECT_THAT(node.written, ::testing::Not(Contains(HasSubstr("1017:0"))));
}

TEST_F(StartUpOf, TheDriveThatGivesSync) {
  config.producesSync = true;
  config.cycle = 0.0025;
  node.pdosInOperation.clear();
  make();
  while (progress < 95)
    ASSERT_EQ(cycle(), bus::StartUp::Busy) << text();
  EXPECT_EQ(node.written.back(), "1005:0/4=40000080") << "last of all";
  EXPECT_THAT(node.written, Contains("1006:0/4=9C4"));
  EXPECT_THAT(node.written, Contains("60C2:1/1=19"));
  EXPECT_THAT(node.written, Contains("60C2:2/1=FC"));
  node.say(0x180, "400203010000");
  EXPECT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_THAT(sent, ::testing::Not(Contains("080#")));
}

TEST(StartSteps, PeriodsThat60C2CanSay) {
  for (const double exact : {0.001, 0.0025, 0.00125, 0.01, 0.1, 1.0, 0.000125, 0.255, 0.00255})
    EXPECT_TRUE(isExactPeriod(exact)) << exact;
  for (const double rough : {0.003333, 0.00256, 0.001001})
    EXPECT_FALSE(isExactPeriod(rough)) << rough;
}

TEST(StartSteps, OfASyncDevice) {
  NodeConfig config;
  config.kind = NodeConfig::Kind::SyncDevice;
  config.plan.node = 127;
  config.producesSync = true;
  std::vector<StartOp> ops;
  for (const StartStep &step : startSteps(config))
    ops.push_back(step.op);
  EXPECT_THAT(ops, ElementsAre(StartOp::Reset, StartOp::BootUp, StartOp::Start, StartOp::Write,
                               StartOp::Write));
}

TEST(StartSteps, TheirProgressGoesFromZeroTo99) {
  for (uint8_t type = 0; type <= 6; ++type) {
    DriveWish wish;
    wish.controlType = type;
    wish.send = {1100, 1160, 0};
    wish.receive = {1101, 1161, 1151};
    wish.inputs = true;
    wish.probeInputs = 15;
    NodeConfig config;
    config.plan = planDrive(wish).plan;
    config.parameters.assign(40, {{0x2000, 1}, 2, 7});
    config.identity = {1, 2, 3, 4};
    uint8_t before = 0;
    for (const StartStep &step : startSteps(config)) {
      EXPECT_GE(step.progress, before);
      EXPECT_LE(step.progress, 99);
      before = step.progress;
    }
  }
}

TEST_F(StartUpOf, ObjectsOfUnknownLengthAreMeasuredBeforeTheyAreWritten) {
  config.parameters = {{{0x2031, 2}, 0, 0xFFFFFFFB}, {{0x2032, 0}, 0, 200}};
  node.values[0x203102] = {2, 7};
  node.values[0x203200] = {1, 7};
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_THAT(node.written, Contains("2031:2/2=FFFB"));
  EXPECT_THAT(node.written, Contains("2032:0/1=C8"));
}

TEST_F(StartUpOf, AValueThatDoesNotFitTheMeasuredObjectIsRefused) {
  config.parameters = {{{0x2031, 2}, 0, 256}};
  node.values[0x203102] = {1, 7};
  expectFailure("node 5, 16#2031:2: 16#100 does not fit into its 1 bytes");
}

} // namespace
} // namespace stride::can
