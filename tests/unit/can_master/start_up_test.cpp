// How nodes are brought into operation, and each way in which that fails.
#include "drivers/can/master/master.hpp"
#include "tests/unit/can_master/fake_bus.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stride::can {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class StartUpOf : public ::testing::Test {
protected:
  StartUpOf() {
    DriveWish wish;
    wish.node = 5;
    wish.controlType = 4;
    config.plan = planDrive(wish).plan;
    config.pdoTimeout = 3;
    node.pdosInOperation = {"185#400203010000"};
  }

  void make() {
    MasterConfig masterConfig;
    masterConfig.nodes = {config};
    masterConfig.sdoPerCycle = sdoPerCycle;
    masterConfig.givesSync = !config.producesSync;
    auto owned = std::make_unique<test::FakePort>(); // the node keeps the other one
    owned->heard = [this, raw = owned.get()](const Frame &frame) {
      sent.push_back(test::text(frame));
      node.hear(frame);
      while (!port.toReceive.empty()) {
        raw->toReceive.push_back(port.toReceive.front());
        port.toReceive.pop_front();
      }
    };
    master = std::make_unique<Master>(masterConfig, std::move(owned));
    master->attach(host);
  }

  bus::StartUp cycle() {
    master->executeStart();
    const bus::StartUp result = master->node(0).init(progress, message, master->news());
    seen.push_back(progress);
    master->executeEnd();
    ++cycles;
    return result;
  }

  bus::StartUp run(int most = 8000) {
    if (!master)
      make();
    bus::StartUp result = bus::StartUp::Busy;
    while (result == bus::StartUp::Busy && cycles < most)
      result = cycle();
    return result;
  }
  std::string text() const { return std::string(message.text()); }
  void expectFailure(const std::string &part) {
    EXPECT_EQ(run(), bus::StartUp::Failed);
    EXPECT_THAT(text(), HasSubstr(part));
    EXPECT_FALSE(master->node(0).started());
    EXPECT_FALSE(master->node(0).communication());
  }

  NodeConfig config;
  uint32_t sdoPerCycle = 1;
  test::FakePort port;
  test::ScriptedNode node{port, 5};
  test::FakeHost host;
  std::unique_ptr<Master> master;
  bus::Message message;
  std::vector<std::string> sent;
  std::vector<uint16_t> seen;
  uint16_t progress = 0;
  int cycles = 0;
};

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

/// A node that is several drives; configured are its axes 1 and 3.
class SeveralAxes : public StartUpOf {
protected:
  SeveralAxes() {
    for (const uint8_t axis : {uint8_t{1}, uint8_t{3}}) {
      DriveWish wish;
      wish.node = 5;
      wish.axis = axis;
      wish.controlType = 4;
      DeviceConfig device;
      device.plan = planDrive(wish).plan;
      device.plan.rpdos[0].cobId = static_cast<uint16_t>(0x205 + 0x100 * axis);
      device.plan.tpdos[0].cobId = static_cast<uint16_t>(0x185 + 0x100 * axis);
      if (axis == 1)
        static_cast<DeviceConfig &>(config) = device;
      else
        config.further.push_back(device);
      node.values[0x606100U + 0x80000U * axis] = {1, 8};
    }
    node.values[0x100000] = {4, 0xFFFF0191}; // its first one is an I/O device
    node.values[0x6FFF00] = {4, 0x00020192};
    node.values[0x7FFF00] = {4, 0x00020192};
    node.modeFollows = false;
    node.pdosInOperation = {"285#400203010000", "485#400204010000"};
  }
};

TEST_F(SeveralAxes, StartTogether) {
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "000#8205"), 1);
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "000#0105"), 1);
  const std::vector<std::string> &w = node.written;
  const auto at = [&](const std::string &one) {
    return std::find(w.begin(), w.end(), one) - w.begin();
  };
  EXPECT_LT(at("1640:1/4=68400010"), at("1640:2/4=687A0020"));
  EXPECT_LT(at("1440:1/4=305"), at("1441:1/4=80000000"));
  EXPECT_LT(at("18C0:1/4=485"), at("6860:0/1=8")) << "all PDOs before the first mode";
  EXPECT_LT(at("6860:0/1=8"), at("7860:0/1=8"));
  EXPECT_LT(at("7860:0/1=8"), at("1017:0/2=64"));
  EXPECT_LT(at("1017:0/2=64"), static_cast<long>(w.size()));
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(master->node(0).status(0).position, 0x103U);
  EXPECT_EQ(master->node(0).status(1).position, 0x104U);
  EXPECT_TRUE(master->node(0).status(0).communication);
  EXPECT_FALSE(master->node(0).status(1).communication) << "nobody serves it yet";
  EXPECT_EQ(master->node(0).init(progress, message, master->news(), 1), bus::StartUp::Started);
  EXPECT_TRUE(master->node(0).status(1).communication);
}

TEST_F(SeveralAxes, AnAxisThatIsNoDrive) {
  node.values[0x7FFF00] = {4, 0x00030191};
  expectFailure("node 5 is no drive of CiA 402 there: the type of that axis (16#7FFF:0) is "
                "16#00030191");
  // The other one is told as well, and then the node begins anew.
  bus::Message other;
  EXPECT_EQ(master->node(0).init(progress, other, master->news(), 1), bus::StartUp::Failed);
  EXPECT_EQ(std::string(other.text()), text());
  EXPECT_EQ(master->node(0).init(progress, other, master->news(), 1), bus::StartUp::Busy);
}

TEST_F(SeveralAxes, AnAxisThatIsNotThere) {
  node.aborts[0x164001] = 0x06020000;
  expectFailure("16#1640:1 := 16#68400010: there is no such object");
}

TEST_F(SeveralAxes, OneWithoutPdosKeepsAllFromStarting) {
  node.pdosInOperation = {"285#400203010000"};
  expectFailure("node 5 sends no PDO");
}

/// A device whose PDOs are const, and are what is planned.
class FixedPdos : public StartUpOf {
protected:
  static constexpr uint32_t kReadOnly = 0x06010002;
  void fix(uint32_t object, uint8_t size, uint32_t value) {
    node.values[object] = {size, value};
    node.writeAborts[object] = kReadOnly;
  }
  FixedPdos() {
    fix(0x160000, 1, 2);
    fix(0x160001, 4, 0x60400010);
    fix(0x160002, 4, 0x607A0020);
    fix(0x1A0000, 1, 2);
    fix(0x1A0001, 4, 0x60410010);
    fix(0x1A0002, 4, 0x60640020);
  }
};

TEST_F(FixedPdos, AreTakenAsTheyAre) {
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_THAT(node.written, Contains("1800:1/4=185"));
  EXPECT_THAT(node.written, ::testing::Not(Contains(HasSubstr("1A00"))));
  EXPECT_EQ(std::count(sent.begin(), sent.end(), "605#40001A0200000000"), 1);
}

TEST_F(FixedPdos, WithFixedIdentifiersAndTiming) {
  fix(0x140001, 4, 0x205);
  fix(0x140002, 1, 1);
  fix(0x180001, 4, 0x40000185); // nobody may ask for it
  fix(0x180002, 1, 1);
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
}

TEST_F(FixedPdos, WithAnotherTimingAreNone) {
  fix(0x180002, 1, 255);
  expectFailure("node 5, 16#1800:2 is fixed: it is 16#FF, and would have to be 16#1");
}

TEST_F(FixedPdos, WithMoreObjectsAreUsed) {
  fix(0x1A0000, 1, 3);
  fix(0x1A0001, 4, 0x60770010); // between the others
  fix(0x1A0002, 4, 0x60640020);
  fix(0x1A0003, 4, 0x60410010);
  node.pdosInOperation = {"185#0100060300004002"};
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_TRUE(host.heard("node 5: PDOs that it does not let be changed are used as they are"));
  EXPECT_EQ(master->node(0).status().position, 0x306U);
  EXPECT_EQ(master->node(0).signal(Signal::Statusword), 0x0240U);
  EXPECT_THAT(node.written, ::testing::Not(Contains(HasSubstr("1020:")))) << "no stamp for that";
}

TEST_F(FixedPdos, OfAnotherLengthThanTheyPromiseAreNone) {
  fix(0x1A0000, 1, 3);
  fix(0x1A0003, 4, 0x60770010);
  expectFailure("sends no PDO"); // the frame has six bytes
}

/// 72 bits, or a multiplexed PDO: nobody knows what is in it.
TEST_F(FixedPdos, ThatAreNoPdosAreNone) {
  fix(0x1A0000, 1, 3);
  fix(0x1A0003, 4, 0x606C0020);
  expectFailure("node 5, 16#1A00:0 is fixed: it is 16#3, and would have to be 16#2");
  master->node(0).reset();
  cycles = 0;
  fix(0x1A0000, 1, 0xFE);
  expectFailure("node 5, 16#1A00:0 is fixed: it is 16#FE, and would have to be 16#2");
}

/// What it would be told is 0, and nobody knows what that does.
TEST_F(FixedPdos, WithSetValuesOfItsMakerAreNone) {
  fix(0x160000, 1, 3);
  fix(0x160003, 4, 0x20310110);
  expectFailure("node 5, 16#1600:0 is fixed: it is 16#3, and would have to be 16#2");
}

TEST_F(FixedPdos, WithOtherObjectsAreNone) {
  fix(0x1A0002, 4, 0x60630020);
  expectFailure("node 5, 16#1A00:2 is fixed: it is 16#60630020, and would have to be 16#60640020");
}

/// Its frames are nobody's, and are counted.
TEST_F(FixedPdos, ThatCannotBeSwitchedOffAreLeftAlone) {
  fix(0x180201, 4, 0x385);
  fix(0x180202, 1, 1);
  fix(0x1A0200, 1, 1);
  fix(0x1A0201, 4, 0x60FD0020);
  node.pdosInOperation.emplace_back("385#00000000");
  make();
  const uint32_t before = master->node(0).cyclicBits();
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_TRUE(host.heard("node 5: its TPDO 3 cannot be switched off: nobody uses it, and it takes "
                         "95 bits of a cycle"));
  EXPECT_EQ(master->node(0).cyclicBits(), before + 95);
  EXPECT_THAT(node.written, ::testing::Not(Contains(HasSubstr("1020:"))));
}

TEST_F(FixedPdos, ThatSayNothingOfThemselvesCountWithAllTheirBytes) {
  node.values[0x180201] = {4, 0x385};
  node.writeAborts[0x180201] = 0x06090030; // "the value is not allowed"
  node.values[0x180202] = {1, 1};
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_TRUE(host.heard("takes 135 bits of a cycle"));
  // By event it takes no time of each cycle.
  node.values[0x180202] = {1, 254};
  master->node(0).reset();
  cycles = 0;
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_TRUE(host.heard("takes 0 bits of a cycle"));
}

TEST_F(FixedPdos, ThatAreOffAreNothing) {
  fix(0x180201, 4, 0x80000385);
  fix(0x140201, 4, 0xC0000405);
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_TRUE(host.news.empty()) << host.news.front();
}

TEST_F(FixedPdos, WithTheIdentifierOfAnotherPdoAreAnError) {
  fix(0x180201, 4, 0x205);
  expectFailure("node 5: its TPDO 3 cannot be switched off, and its COB-ID 16#205 (16#1802:1) is "
                "another PDO's of the plan");
}

TEST_F(FixedPdos, WithAnIdentifierOf29BitsDisturbNobody) {
  fix(0x180201, 4, 0x20000205);
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
}

/// What the planned one lacks another one has.
TEST_F(FixedPdos, ThatCannotBeSwitchedOffAreUsedForWhatIsWanted) {
  fix(0x1A0000, 1, 1);
  fix(0x180201, 4, 0x385);
  fix(0x180202, 1, 1);
  fix(0x1A0200, 1, 2);
  fix(0x1A0201, 4, 0x60640020);
  fix(0x1A0202, 4, 0x60410010);
  node.pdosInOperation = {"185#4002", "385#070300004002"};
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  EXPECT_TRUE(host.heard("used as they are"));
  EXPECT_FALSE(host.heard("nobody uses it"));
  EXPECT_EQ(master->node(0).status().position, 0x307U);
  // It counts as planned ones do.
  node.atSync = {"185#4002"};
  for (int i = 0; i < 5; ++i)
    (void)cycle();
  EXPECT_FALSE(master->node(0).communication());
}

TEST_F(FixedPdos, ThatLackWhatIsWantedAreNone) {
  fix(0x1A0000, 1, 1);
  fix(0x180201, 4, 0x385);
  fix(0x180202, 1, 1);
  fix(0x1A0200, 1, 1);
  fix(0x1A0201, 4, 0x60630020);
  expectFailure("node 5, 16#1A00:2 is fixed: it is 16#0, and would have to be 16#60640020");
}

TEST_F(FixedPdos, AreOthersAfterTheNextStartUp) {
  fix(0x1A0000, 1, 3);
  fix(0x1A0003, 4, 0x60770010);
  node.pdosInOperation = {"185#4002030100000000"};
  ASSERT_EQ(run(), bus::StartUp::Started) << text();
  fix(0x1A0000, 1, 2); // another device
  node.pdosInOperation = {"185#400203010000"};
  master->node(0).reset();
  cycles = 0;
  EXPECT_EQ(run(), bus::StartUp::Started) << text();
}

TEST_F(FixedPdos, WhatCannotBeReadEitherIsAFailure) {
  node.aborts[0x1A0001] = 0x06010001;
  node.values.erase(0x1A0001);
  expectFailure("16#1A00:1");
}

/// Only of PDOs: a parameter that cannot be written is none.
TEST_F(FixedPdos, OtherObjectsAreNotCompared) {
  config.parameters = {{{0x2031, 0}, 2, 7}};
  fix(0x203100, 2, 7);
  expectFailure("node 5, 16#2031");
}

} // namespace
} // namespace stride::can
