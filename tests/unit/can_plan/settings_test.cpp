// What stride.toml gives a drive besides the plan: start-up parameters and own PDOs.
#include "drivers/can/plan/bus_load.hpp"
#include "drivers/can/plan/drive_settings.hpp"
#include "drivers/can/plan/group_plan.hpp"
#include "drivers/can/plan/parameter_file.hpp"
#include "drivers/can/schema.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stride::can {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

struct Line {
  const char *text;
  uint16_t index;
  uint8_t sub;
  uint8_t size;
  uint32_t value;
};

TEST(StartUpParameters, AreObjectsAndValues) {
  const std::vector<Line> lines = {
      {"6098h := 35", 0x6098, 0, 1, 35},
      {" 6098h:0:=SINT#-1 ", 0x6098, 0, 1, 0xFF},
      {"6099h:2 := 1_000", 0x6099, 2, 4, 1000},
      {"607Ch := -2147483648", 0x607C, 0, 4, 0x80000000},
      {"605Ah := 6", 0x605A, 0, 2, 6},
      {"2031h:255 := UINT#65535", 0x2031, 255, 2, 65535},
      {"2031h:2 := uint#16#1F", 0x2031, 2, 2, 31},
      {"2031h:2 := INT#-32768", 0x2031, 2, 2, 0x8000},
      {"2031h := BYTE#2#1010", 0x2031, 0, 1, 10},
      {"2031h := BOOL#1", 0x2031, 0, 1, 1},
      {"abcdh := UDINT#4294967295", 0xABCD, 0, 4, 0xFFFFFFFF},
      {"ABCDH := DWORD#8#17", 0xABCD, 0, 4, 15},
      {"2100h:1 := REAL#-1.5", 0x2100, 1, 4, 0xBFC00000},
      {"1029h:1 := USINT#2", 0x1029, 1, 1, 2},
  };
  for (const Line &line : lines) {
    SdoWrite write;
    std::string error;
    EXPECT_TRUE(parseStartUp(line.text, write, error)) << line.text << ": " << error;
    EXPECT_EQ(write.object.index, line.index) << line.text;
    EXPECT_EQ(write.object.sub, line.sub) << line.text;
    EXPECT_EQ(write.size, line.size) << line.text;
    EXPECT_EQ(write.value, line.value) << line.text;
    EXPECT_FALSE(write.optional) << "a drive without it does not start";
  }
}

TEST(StartUpParameters, OfMoreThanFourBytes) {
  struct Row {
    const char *text;
    std::vector<uint8_t> bytes;
  };
  const std::vector<Row> rows = {
      {"2031h:3 := LINT#-2", {0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}},
      {"2031h:3 := LINT#-9223372036854775808", {0, 0, 0, 0, 0, 0, 0, 0x80}},
      {"2031h:3 := lint#16#0102030405060708", {8, 7, 6, 5, 4, 3, 2, 1}},
      {"2031h:3 := ULINT#18446744073709551615", std::vector<uint8_t>(8, 0xFF)},
      {"2031h:3 := LWORD#2#101", {5, 0, 0, 0, 0, 0, 0, 0}},
      {"2031h:3 := LREAL#-1.5", {0, 0, 0, 0, 0, 0, 0xF8, 0xBF}},
      {"2031h:3 := 'Axis 1'", {'A', 'x', 'i', 's', ' ', '1'}},
      {"2031h:3 := '#'", {'#'}},
      {"2031h:3 := 'UINT#5 := 6'", {'U', 'I', 'N', 'T', '#', '5', ' ', ':', '=', ' ', '6'}},
  };
  for (const Row &row : rows) {
    SdoWrite write;
    std::string error;
    EXPECT_TRUE(parseStartUp(row.text, write, error)) << row.text << ": " << error;
    EXPECT_EQ(write.bytes, row.bytes) << row.text;
    EXPECT_EQ(write.length(), row.bytes.size());
  }
  SdoWrite write;
  std::string error;
  const std::string text(255, 'x');
  EXPECT_TRUE(parseStartUp("2031h := '" + text + "'", write, error));
  EXPECT_EQ(write.bytes.size(), 255U);
  EXPECT_FALSE(parseStartUp("2031h := '" + text + "y'", write, error));
  EXPECT_THAT(error, HasSubstr("up to 255"));
}

TEST(StartUpParameters, LongerOnesAreInDcfAndStamp) {
  std::vector<SdoWrite> writes(2);
  std::string error;
  ASSERT_TRUE(parseStartUp("2031h:3 := LREAL#-1.5", writes[0], error));
  ASSERT_TRUE(parseStartUp("2032h := UINT#7", writes[1], error));
  EXPECT_THAT(conciseDcf(writes), ElementsAre(2, 0, 0, 0, 0x31, 0x20, 3, 8, 0, 0, 0, 0, 0, 0, 0, 0,
                                              0, 0xF8, 0xBF, 0x32, 0x20, 0, 2, 0, 0, 0, 7, 0));
  const ConfigurationStamp stamp = stampOf(writes);
  ++writes[0].bytes[0];
  EXPECT_NE(stampOf(writes), stamp);
}

TEST(StartUpParameters, ThatCannotBeSayWhy) {
  struct Row {
    const char *text;
    const char *why;
  };
  const std::vector<Row> rows = {
      {"", "an object and its value"},
      {"6098h = 35", "an object and its value"},
      {"6098 := 35", "an object is written as"},
      {"0x6098 := 35", "an object is written as"},
      {"60980h := 35", "an object is written as"},
      {"-098h := 35", "an object is written as"},
      {"6098h:256 := 35", "a subindex"},
      {"6098h:-1 := 35", "a subindex"},
      {"6098h: := 35", "a subindex"},
      {"6098h:0:8 := 35", "too many colons"},
      {"6098h := 128", "does not fit into 8 bits with a sign"},
      {"6098h := -129", "does not fit into 8 bits with a sign"},
      {"6085h := -1", "does not fit into 32 bits without a sign"},
      {"2031h := UINT#65536", "does not fit into 16 bits without a sign"},
      {"2031h := BOOL#2", "does not fit"},
      {"2031h := UDINT#99999999999999999999", "no whole number"},
      {"6098h := INT#35", "has 8 bits"},
      {"2031h := 35", "the type of this object is not known"},
      {"2031h := 16#23", "the type of this object is not known"},
      {"2031h := STRING#35", "a value has the type"},
      {"2031h := LREAL#", "this is no LREAL"},
      {"2031h := LREAL#nan", "this is no LREAL"},
      {"2031h := LINT#9223372036854775808", "does not fit into 64 bits with a sign"},
      {"2031h := LINT#-9223372036854775809", "does not fit into 64 bits with a sign"},
      {"2031h := ULINT#-1", "does not fit into 64 bits without a sign"},
      {"2031h := ULINT#18446744073709551616", "no whole number"},
      {"6098h := LINT#35", "has 8 bits"},
      {"6098h := 'a'", "no whole number"},
      {"2031h := ''", "one character at least"},
      {"2031h := 'a", "between quotes"},
      {"2031h := 'it's'", "without ' and $"},
      {"2031h := 'a$N'", "without ' and $"},
      {"2031h := '\xC3\xA4'", "of ASCII"},
      {"2031h := REAL#x", "this is no REAL"},
      {"2031h := REAL#inf", "this is no REAL"},
      {"2031h := UINT#", "no whole number"},
      {"2031h := UINT#3#1", "no whole number"},
      {"2031h := UINT#2#12", "no whole number"},
      {"6098h := ", "no whole number"},
      {"1A01h:1 := UDINT#0", "the tables `tpdo1`"},
      {"1400h:2 := USINT#1", "the tables `rpdo1`"},
      {"6060h := 8", "the controller mode"},
      {"1017h := UINT#10", "`heartbeat`"},
      {"60C2h:1 := 2", "the cycle"},
  };
  for (const Row &row : rows) {
    SdoWrite write;
    std::string error;
    EXPECT_FALSE(parseStartUp(row.text, write, error)) << row.text;
    EXPECT_THAT(error, HasSubstr(row.why)) << row.text;
  }
}

TEST(OwnPdos, EntriesAreObjectsAndTheirBits) {
  struct Row {
    const char *text;
    uint32_t index, sub, bits; // bits 0: it cannot be
    const char *why = "";
  };
  const std::vector<Row> rows = {
      {"6040h", 0x6040, 0, 16},
      {"607Ah:0", 0x607A, 0, 32},
      {"60C1h:1:32", 0x60C1, 1, 32},
      {"2031h:7:16", 0x2031, 7, 16},
      {"0005h:0:8", 0x0005, 0, 8},
      {"2031h:7:64", 0x2031, 7, 64},
      {"2031h", 0, 0, 0, "the length of this object is not known"},
      {"2031h:1", 0, 0, 0, "the length of this object is not known"},
      {"6040h:0:8", 0, 0, 0, "has 16 bits"},
      {"2031h:1:24", 0x2031, 1, 24},
      {"2031h:1:56", 0x2031, 1, 56},
      {"2031h:1:0", 0, 0, 0, "whole bytes, 8 to 64 bits"},
      {"2031h:1:20", 0, 0, 0, "whole bytes, 8 to 64 bits"},
      {"2031h:1:72", 0, 0, 0, "whole bytes, 8 to 64 bits"},
      {"2031h:1:128", 0, 0, 0, "whole bytes, 8 to 64 bits"},
      {"2031h:1:x", 0, 0, 0, "are a number"},
      {"2031h:1:8:8", 0, 0, 0, "too many colons"},
      {"", 0, 0, 0, "an object is written as"},
  };
  for (const Row &row : rows) {
    PdoEntry entry;
    std::string error;
    EXPECT_EQ(parseEntry(row.text, entry, error), row.bits != 0) << row.text << error;
    EXPECT_THAT(error, HasSubstr(row.why)) << row.text;
    if (row.bits == 0)
      continue;
    EXPECT_EQ(entry.object.index, row.index);
    EXPECT_EQ(entry.object.sub, row.sub);
    EXPECT_EQ(entry.bits, row.bits);
  }
}

class OwnPdosOf : public ::testing::Test {
protected:
  OwnPdosOf() : setup(kSchema, 0.002) {
    drive = &setup.addDrive("X", 5).parameters;
    drive->add({"wControlType", "", 4});
  }
  void map(const std::string &table, const std::string &lines) {
    drive->add({table + ".map", lines, 0});
  }
  void byEvent(const std::string &table) { drive->add({table + ".when", "event", kByEvent}); }
  GroupPlan plan() { return planGroup(setup); }
  std::vector<std::string> messages() {
    bus::GroupFindings findings;
    checkGroup(setup, findings);
    std::vector<std::string> result;
    for (const bus::GroupFinding &one : findings)
      result.push_back((one.isError ? "error: " : "warning: ") + one.message);
    return result;
  }

  bus::GroupSetup setup;
  bus::SetupParameters *drive;
};

TEST_F(OwnPdosOf, OneDirectionLeaveTheOtherAsItIs) {
  map("rpdo2", "6040h\n6060h\n607Ah");
  const GroupPlan group = plan();
  const DrivePlan &own = group.drives[0].plan;
  ASSERT_EQ(own.rpdoCount, 1);
  EXPECT_EQ(own.rpdos[0].number, 2);
  EXPECT_EQ(own.rpdos[0].cobId, 0x305);
  EXPECT_EQ(own.rpdos[0].bits(), 56U);
  ASSERT_EQ(own.tpdoCount, 1);
  EXPECT_EQ(own.tpdos[0].cobId, 0x185);
  EXPECT_EQ(own.tpdos[0].bits(), 48U);
  EXPECT_EQ(own.controllerModes, 1U << kPositionControl);
  EXPECT_EQ(group.load.bits, 55U + 125 + 115);
  EXPECT_TRUE(messages().empty());
  // The first RPDO is switched off, the second one has the mapping.
  std::vector<std::string> written;
  for (const SdoWrite &one : pdoWrites(own)) {
    char text[40];
    std::snprintf(text, sizeof text, "%04X:%u=%X", one.object.index, one.object.sub, one.value);
    written.emplace_back(text);
  }
  written.resize(8);
  EXPECT_THAT(written,
              ElementsAre("1400:1=80000205", "1401:1=80000305", "1601:0=0", "1601:1=60400010",
                          "1601:2=60600008", "1601:3=607A0020", "1601:0=3", "1401:2=1"));
}

TEST_F(OwnPdosOf, WhatTheyCarryDecides) {
  drive->add({"inputs", "", 1});
  drive->add({"probe_inputs", "", 2});
  map("rpdo1", "6040h\n60FFh\n2031h:1:8");
  map("tpdo1", "6064h\n606Ch");
  map("tpdo3", "6041h\n6061h");
  byEvent("tpdo3");
  drive->add({"tpdo3.event", "", 0.25});
  drive->add({"tpdo3.inhibit", "", 0.0057});
  const DrivePlan own = plan().drives[0].plan;
  EXPECT_EQ(own.sent, cyclic::kVelocity);
  EXPECT_EQ(own.received, cyclic::kPosition | cyclic::kVelocity);
  EXPECT_EQ(own.controllerModes, 1U << kVelocityControl);
  ASSERT_EQ(own.tpdoCount, 2);
  EXPECT_FALSE(own.tpdos[1].synchronous());
  EXPECT_EQ(own.tpdos[1].eventTimer, 250);
  EXPECT_EQ(own.tpdos[1].inhibit, 57);
  EXPECT_EQ(cyclicBits(own), worstBits(7) + worstBits(8));
  EXPECT_THAT(messages(),
              UnorderedElementsAre(HasSubstr("set value of its wControlType"),
                                   HasSubstr("inputs (60FDh)"), HasSubstr("touch probes"),
                                   HasSubstr("objects that are no set values")));
}

TEST_F(OwnPdosOf, WithoutItsWordsNoDriveCanBeServed) {
  map("rpdo1", "607Ah");
  EXPECT_THAT(messages(), ElementsAre(HasSubstr("controlword (6040h)")));
  EXPECT_EQ(messages()[0].substr(0, 6), "error:");
  map("tpdo1", "6064h");
  EXPECT_FALSE(plan().faults[0].empty());
}

TEST_F(OwnPdosOf, AndWithoutASetValue) {
  map("rpdo1", "6040h");
  EXPECT_THAT(messages(), ElementsAre(HasSubstr("no set value is sent")));
}

TEST_F(OwnPdosOf, AllThatIsWrongIsSaid) {
  map("rpdo1", "6040h\n607Ah\n6041h");
  map("rpdo2", "2031h:1:32\n2031h:2:32\n2031h:3:8");
  map("tpdo1", "6041\n6064h");
  drive->add({"startup", "6098h := 35\n6098h := 1000", 0});
  EXPECT_THAT(messages(),
              UnorderedElementsAre(
                  HasSubstr("`6041h` in `rpdo1`: the drive tells it"),
                  HasSubstr("`rpdo2`: it has 72 bits"), HasSubstr("`6041` in `tpdo1`: an object"),
                  HasSubstr("`6098h := 1000` in `startup`: the value does not fit")));
  for (const std::string &message : messages())
    EXPECT_THAT(message, HasSubstr("error: drive `X`: "));
}

TEST_F(OwnPdosOf, NinthObjectIsOneTooMany) {
  std::string lines = "6040h";
  for (int i = 1; i < 8; ++i)
    lines += "\n2031h:" + std::to_string(i) + ":8"; // 72 bits as well
  map("rpdo1", lines + "\n2031h:9:8");
  EXPECT_THAT(messages(),
              UnorderedElementsAre(HasSubstr("more than 8 objects"), HasSubstr("it has 72 bits")));
}

TEST_F(OwnPdosOf, StartUpParametersAreInConciseDcfAndText) {
  drive->add({"startup", "6099h:1 := 5000\n2031h:2 := INT#-2", 0});
  const bus::GroupPlanText text = describeGroup(setup);
  EXPECT_THAT(text.text, HasSubstr("6099h:1 := 00001388h\n"));
  EXPECT_THAT(text.text, HasSubstr("2031h:2 := FFFEh\n"));
  ASSERT_EQ(text.files.size(), 1U);
  const std::string &bytes = text.files[0].bytes;
  const std::string last("\x31\x20\x02\x02\0\0\0\xFE\xFF", 9);
  ASSERT_GT(bytes.size(), last.size());
  EXPECT_EQ(bytes.substr(bytes.size() - last.size()), last);
}

TEST(ParameterFiles, TextAndXmlAreTheSame) {
  const ParameterFile text = readParameterFile("drive;7\r\n6324992;500;16#6083:0;inc/s\r\n"
                                               "2109698;-3;16#2031:2;\n\n6330368;TRUE;;\n"
                                               "6323200;-12.0;home");
  ASSERT_EQ(text.error, "");
  ASSERT_EQ(text.writes.size(), 4U);
  EXPECT_EQ(text.writes[0].object, (Object{0x6083, 0}));
  EXPECT_EQ(text.writes[0].size, 4);
  EXPECT_EQ(text.writes[0].value, 500U);
  EXPECT_EQ(text.writes[1].object, (Object{0x2031, 2}));
  EXPECT_EQ(text.writes[1].size, 0) << "the drive knows";
  EXPECT_EQ(text.writes[1].value, 0xFFFFFFFDU);
  EXPECT_EQ(text.writes[2].value, 1U);
  EXPECT_EQ(text.writes[3].value, 0xFFFFFFF4U);
  const ParameterFile xml = readParameterFile(
      "<?xml version=\"1.0\"?>\n<DriveParameters DriveId=\"7\">\n"
      " <Parameter Number=\"6324992\" Name=\"a\" Type=\"DINT\" Unit=\"\">500</Parameter>\n"
      " <Parameter Name=\"b\" Number=\"2109698\"> -3 </Parameter>\n</DriveParameters>\n");
  ASSERT_EQ(xml.error, "");
  ASSERT_EQ(xml.writes.size(), 2U);
  EXPECT_EQ(xml.writes[1].object, (Object{0x2031, 2}));
  EXPECT_EQ(xml.writes[1].value, 0xFFFFFFFDU);
}

/// A file, and what is said of it.
struct WrongFile {
  std::string text;
  std::string error;
};
class WrongParameterFiles : public ::testing::TestWithParam<WrongFile> {};

TEST_P(WrongParameterFiles, NameTheirLine) {
  EXPECT_EQ(readParameterFile(GetParam().text).error, GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Files, WrongParameterFiles,
    ::testing::Values(
        WrongFile{"", "line 1: the file is empty"},
        WrongFile{"hello",
                  "line 1: a file with parameters begins with `drive;` and a number, or is "
                  "XML"},
        WrongFile{"drive;1\n12", "line 2: a parameter is `NUMBER;VALUE;NAME;UNIT`"},
        WrongFile{"drive;1\n\n0;1;;",
                  "line 3: the number of a parameter is index * 256 + subindex of an object"},
        WrongFile{"drive;1\n16777216;1;;",
                  "line 2: the number of a parameter is index * 256 + subindex of an object"},
        WrongFile{"drive;1\n8257536;1.5;;", "line 2: the value is no whole number of 32 bits"},
        WrongFile{"drive;1\n8257536;4294967296;;",
                  "line 2: the value is no whole number of 32 bits"},
        WrongFile{"drive;1\n8257536;4294967295;;\n8257536;-2147483649;;",
                  "line 3: the value is no whole number of 32 bits"},
        WrongFile{"drive;1\n6330368;-128;;\n6330368;128;;",
                  "line 3: the value does not fit into the object"},
        WrongFile{"drive;1\n1054464;1;;",
                  "line 2: what is written there is the matter of `heartbeat`"},
        WrongFile{"<DriveParameters>\n<Parameter Number=\"1\">2",
                  "line 2: a parameter is `<Parameter Number=\"…\" …>VALUE</Parameter>`"},
        WrongFile{"<DriveParameters>\n<Parameter Number=\"8257536\">2</Parameter>\n",
                  "line 3: the end of the file is missing"}));

} // namespace
} // namespace stride::can
