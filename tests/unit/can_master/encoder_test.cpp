// Encoders of a drive group: nodes of CiA 406, and second encoders of drives.
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock-matchers.h>

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

TEST_F(EncoderOf, PdosOfItsOwn) {
  encoder->add({"tpdo3.map", "6030h:1:16\n6004h", 0});
  encoder->add({"startup", "6000h := UINT#4\n2100h:3 := DINT#-2", 0});
  addNode(0).pdosInOperation = {"394#345678563412"};
  startAll();
  cycles(100);
  EXPECT_TRUE(works());
  EXPECT_EQ(driver->encoder(0), 0x12345678U);
  const std::vector<std::string> &w = nodes[1].written;
  for (const char *one :
       {"1802:1/4=80000394", "1A02:1/4=60300110", "1A02:2/4=60040020", "1A02:0/1=2", "1802:2/1=1",
        "1802:1/4=394", "1801:1/4=80000294", "6000:0/2=4", "2100:3/4=FFFFFFFE"})
    EXPECT_THAT(w, ::testing::Contains(one));
  EXPECT_THAT(w, ::testing::Not(::testing::Contains("1801:1/4=294"))) << "its usual one is off";
  nodes[1].atSync.clear();
  cycles(3);
  EXPECT_FALSE(works());
}

/// Its position is not known before it has come.
TEST_F(EncoderOf, APositionByEvent) {
  encoder->add({"tpdo1.map", "6004h", 0});
  encoder->add({"tpdo1.when", "", 1});
  encoder->add({"tpdo1.event", "", 0.25});
  encoder->add({"tpdo1.inhibit", "", 0.002});
  addNode(0);
  make();
  commands.resize(1);
  started.assign(1, false);
  cycles(300);
  EXPECT_FALSE(works());
  for (const char *one : {"1800:2/1=FF", "1800:3/2=14", "1800:5/2=FA", "1800:1/4=194"})
    EXPECT_THAT(nodes[1].written, ::testing::Contains(one));
  port->give("194#01020304");
  cycles(10);
  EXPECT_TRUE(works());
  EXPECT_EQ(driver->encoder(0), 0x04030201U);
  cycles(1000);
  EXPECT_TRUE(works()) << "it may stand";
  heartbeats = false;
  cycles(200);
  EXPECT_FALSE(works());
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

TEST(EncoderPlans, OfTheirOwnMustHaveThePosition) {
  bus::GroupSetup setup(kSchema, 0.001);
  setup.addDrive("X", 5);
  const auto fault = [&](const char *drive, const char *map, const char *startup = "") {
    setup.encoders.clear();
    bus::SetupParameters &encoder = setup.addEncoder("E", 8).parameters;
    encoder.add({"tpdo2.map", map, 0});
    if (*drive != '\0')
      encoder.add({"second_of", drive, 0});
    if (*startup != '\0')
      encoder.add({"startup", startup, 0});
    return planGroup(setup).encoders[0].fault;
  };
  EXPECT_EQ(fault("", "6004h"), "");
  EXPECT_EQ(fault("", "6004h\n2100h:0:32"), "") << "64 bits";
  EXPECT_EQ(fault("", "6004h\n2100h:0:40"),
            "`tpdo2`: it has 72 bits, and 64 is what a PDO has room for");
  EXPECT_EQ(fault("", "6030h:1:16"), "none of its own TPDOs has the position (6004h)");
  EXPECT_EQ(fault("", "6004h:0:16"), "`6004h:0:16` in `tpdo2`: this object has 32 bits");
  EXPECT_EQ(fault("", "6004h\n6503h"), "`6503h` in `tpdo2`: the length of this object is not known "
                                       "here: write its bits, as in 2031h:2:16");
  EXPECT_EQ(fault("", "6004h", "1801h:1 := UDINT#5"),
            "`1801h:1 := UDINT#5` in `startup`: what is written there is the matter of the tables "
            "`tpdo1` … `tpdo4`");
  EXPECT_EQ(fault("X", "6004h"), "it is the second encoder of a drive, which has its PDOs: `tpdo2` "
                                 "belongs into the section of the drive");
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
