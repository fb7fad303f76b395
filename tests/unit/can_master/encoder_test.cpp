// Encoders of a drive group: nodes of CiA 406, and second encoders of drives.
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock.h>

namespace stride::can {
namespace {

class EncoderOf : public test::CanBusTest {
protected:
  EncoderOf() {
    addDrive(5);
    encoder = &setup.addEncoder("E", 20).parameters;
  }
  /// The encoder's node, which counts to that; 0: 2^32.
  test::ScriptedNode &addNode(uint32_t range) {
    test::ScriptedNode &node = nodes.emplace_back(inbox, uint8_t{20});
    node.values[0x100000] = {4, 0x00020196};
    node.values[0x600200] = {4, range};
    return node;
  }
  void count(const std::string &bytes) {
    nodes[1].pdosInOperation = nodes[1].atSync = {"294#" + bytes};
  }
  void startAll() {
    make();
    commands.resize(setup.drives.size());
    started.assign(setup.drives.size(), false);
    ASSERT_NO_FATAL_FAILURE(start());
  }
  bool works() const { return driver->encoderWorks(0); }

  bus::SetupParameters *encoder;
};

TEST_F(EncoderOf, ItIsANodeAndTellsItsPositionAtSync) {
  addNode(0xFFFFFFFF).pdosInOperation = {"294#78563412"};
  make();
  EXPECT_FALSE(works());
  startAll();
  cycles(100);
  EXPECT_TRUE(works());
  EXPECT_EQ(driver->encoder(0), 0x12345678U);
  count("FFFFFFFF");
  cycles(2);
  EXPECT_EQ(driver->encoder(0), 0xFFFFFFFFU) << "no sign";
  EXPECT_THAT(nodes[1].written, ::testing::Contains("1801:1/4=294"));
  EXPECT_THAT(nodes[1].written, ::testing::Contains("1A01:1/4=60040020"));
  EXPECT_THAT(nodes[1].written, ::testing::Not(::testing::Contains(::testing::HasSubstr("6060"))));
}

TEST_F(EncoderOf, WithoutItsPdoItDoesNotWorkUntilTheyComeAgain) {
  addNode(0).pdosInOperation = {"294#01000000"};
  startAll();
  cycles(100);
  ASSERT_TRUE(works());
  nodes[1].atSync.clear();
  cycles(2);
  EXPECT_TRUE(works());
  cycle();
  EXPECT_FALSE(works());
  EXPECT_TRUE(communicates(0)) << "the drive goes on";
  EXPECT_TRUE(host.heard("node 20 is silent"));
  count("07000000");
  cycles(3);
  EXPECT_TRUE(works());
  EXPECT_EQ(driver->encoder(0), 7U);
}

TEST_F(EncoderOf, AnotherDeviceIsNone) {
  addNode(0).values[0x100000] = {4, 0x00020192};
  make();
  commands.resize(1);
  started.assign(1, false);
  cycles(3000);
  EXPECT_TRUE(started[0]) << "the drive starts without it";
  EXPECT_FALSE(works());
  EXPECT_TRUE(host.heard("node 20 is no encoder of CiA 406: its device type (16#1000:0) is "
                         "16#00020192 and not 16#....0196"));
  // With the drives it begins anew.
  nodes[1].values[0x100000] = {4, 0x00000196};
  nodes[1].pdosInOperation = {"294#01000000"};
  driver->reset(0);
  started[0] = false;
  cycles(3000);
  EXPECT_TRUE(works());
}

TEST_F(EncoderOf, WhereItWrapsMustBeKnown) {
  encoder->add({"dwEncoderModulo", "", 8192});
  addNode(4096).pdosInOperation = {"294#01000000"};
  make();
  commands.resize(1);
  started.assign(1, false);
  cycles(3000);
  EXPECT_FALSE(works());
  EXPECT_TRUE(host.heard("counts to 4096 (16#6002:0): dwEncoderModulo must be that, and is 8192"));
  nodes[1].values[0x600200] = {4, 8192};
  driver->reset(0);
  started[0] = false;
  cycles(3000);
  EXPECT_TRUE(works());
}

TEST_F(EncoderOf, ItsMappingMayBeFixed) {
  test::ScriptedNode &node = addNode(0);
  node.pdosInOperation = {"294#05000000"};
  for (const auto &[object, value] :
       {std::pair<uint32_t, uint32_t>{0x1A0100, 1}, {0x1A0101, 0x60040020}}) {
    node.values[object] = {static_cast<uint8_t>(object == 0x1A0100 ? 1 : 4), value};
    node.writeAborts[object] = 0x06010002;
  }
  startAll();
  cycles(100);
  EXPECT_TRUE(works());
  EXPECT_EQ(driver->encoder(0), 5U);
}

TEST_F(EncoderOf, ADriveThatHasTwo) {
  encoder->add({"second_of", "x", 0});
  // 6064h and 60E4h:1 fill the first TPDO; the statusword comes by event.
  nodes[0].pdosInOperation = {"185#E8030000FEFFFFFF", "285#400200"};
  startAll();
  EXPECT_TRUE(works());
  EXPECT_EQ(driver->encoder(0), 0xFFFFFFFEU);
  EXPECT_EQ(driver->status(0).position, 1000U);
  EXPECT_THAT(nodes[0].written, ::testing::Contains("1A00:2/4=60E40120"));
  nodes[0].atSync.clear();
  cycles(5);
  EXPECT_FALSE(works());
}

TEST(EncoderPlans, HaveNodesOfTheirOwn) {
  bus::GroupSetup setup(kSchema, 0.001);
  setup.addDrive("X", 5);
  setup.addEncoder("A", 5);
  setup.addEncoder("B", 0);
  setup.addEncoder("C", 126);
  setup.addEncoder("D", 7);
  setup.addEncoder("E", 7);
  setup.addEncoder("F", 7).parameters.add({"second_of", "X", 0});
  setup.addEncoder("G", 8);
  const GroupPlan plan = planGroup(setup);
  for (size_t i = 0; i < 5; ++i)
    EXPECT_FALSE(plan.encoders[i].fault.empty()) << i;
  EXPECT_TRUE(plan.encoders[5].fault.empty());
  EXPECT_EQ(plan.encoders[5].drive, 0U);
  EXPECT_TRUE(plan.encoders[6].fault.empty());
  EXPECT_EQ(plan.encoders[6].plan.node, 8);
  bus::GroupFindings findings;
  checkGroup(setup, findings);
  EXPECT_EQ(findings.size(), 5U);
}

} // namespace
} // namespace stride::can
