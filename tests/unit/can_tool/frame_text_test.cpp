// What `stride can monitor` says of frames, with a project and without.
#include "drivers/can/io_schema.hpp"
#include "drivers/can/schema.hpp"
#include "drivers/can/tool/frame_text.hpp"
#include "tests/unit/can_master/script.hpp"

#include <gtest/gtest.h>

namespace stride::can::tool {
namespace {

/// A drive, an encoder, an I/O device, and a drive that cannot be on the bus.
bus::GroupSetup group() {
  bus::GroupSetup setup(kSchema, 0.002);
  setup.addDrive("Lift", 3).parameters.add({"wControlType", "", 4});
  setup.addDrive("Wrong", 200);
  setup.addEncoder("Scale", 20);
  bus::IoSetup &io = setup.ios.emplace_back();
  io.name = "Valves";
  io.inputBytes = 3;
  io.outputBytes = 1;
  io.parameters = bus::SetupParameters({{}, io::can::kSchema.parameters, io::can::kSchema.tables});
  io.parameters.add({"node", "", 30});
  io.parameters.add({"analog_inputs", "", 1});
  return setup;
}

std::string said(const std::string &frame, const std::vector<KnownDrive> &known) {
  return describe(can::test::frame(frame), known);
}

TEST(FrameTexts, WithAProjectValuesHaveTheirNames) {
  const bus::GroupSetup groups[] = {group()};
  const std::vector<KnownDrive> known = knownNodes(groups);
  ASSERT_EQ(known.size(), 3U) << "but for the one that cannot be there";
  EXPECT_EQ(said("183#27065FECFFFF", known),
            "TPDO1 of Lift: statusword 0627h operation enabled, position -5025");
  EXPECT_EQ(said("203#0F0000010000", known),
            "RPDO1 of Lift: controlword 000Fh, target position 256");
  EXPECT_EQ(said("183#2706", known), "TPDO1 of Lift has 2 bytes, planned are 6");
  EXPECT_EQ(said("294#FFFFFFFF", known), "TPDO2 of Scale: encoder position FFFFFFFFh");
  EXPECT_EQ(said("19E#A5", known), "TPDO1 of Valves: 6000h:1 A5h");
  EXPECT_EQ(said("29E#3412", known), "TPDO2 of Valves: 6401h:1 1234h");
  EXPECT_EQ(said("21E#01", known), "RPDO1 of Valves: 6200h:1 1h");
}

TEST(FrameTexts, WithoutAProjectTheyAreThoseOfTheConnectionSet) {
  EXPECT_EQ(said("183#27065FECFFFF", {}), "TPDO1 of node 3");
  EXPECT_EQ(said("41E#00", {}), "RPDO3 of node 30");
  EXPECT_EQ(said("000#8200", {}), "NMT all: reset communication");
  EXPECT_EQ(said("000#0103", {}), "NMT node 3: start");
  EXPECT_EQ(said("080#", {}), "SYNC");
  EXPECT_EQ(said("083#1023050000000000", {}), "EMCY of node 3: 2310h, error register 05h");
  EXPECT_EQ(said("083#0000000000000000", {}), "EMCY of node 3: no error any more");
  EXPECT_EQ(said("603#4064600000000000", {}), "SDO to node 3: read 6064h");
  EXPECT_EQ(said("583#4364600039050000", {}), "SDO from node 3: 6064h is 1337");
  EXPECT_EQ(said("603#2F99600223000000", {}), "SDO to node 3: write 6099h:2 := 35");
  EXPECT_EQ(said("583#8034120000000206", {}),
            "SDO from node 3: abort 1234h, there is no such object");
  EXPECT_EQ(said("703#05", {}), "node 3 is operational");
  EXPECT_EQ(said("703#R", {}), "node 3 is asked for its state");
  EXPECT_EQ(said("77F#00", {}), "node 127 is boot-up");
}

TEST(FrameTexts, WhateverTheFrameIsThereIsAText) {
  const bus::GroupSetup groups[] = {group()};
  const std::vector<KnownDrive> known = knownNodes(groups);
  Frame frame;
  for (uint32_t id = 0; id <= Frame::kLastId; ++id)
    for (uint8_t length = 0; length <= Frame::kMostBytes; ++length) {
      frame.id = static_cast<uint16_t>(id);
      frame.length = length;
      frame.data.fill(static_cast<uint8_t>(id * 7 + length));
      (void)describe(frame, known);
    }
  EXPECT_EQ(line(can::test::frame("181#2706"), 1'234'000),
            "   0.001234  181 [2] 27 06                  ");
}

} // namespace
} // namespace stride::can::tool
