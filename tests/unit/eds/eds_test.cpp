// Electronic data sheets as makers and tools write them.
#include "compiler/assets/eds/device.hpp"
#include "compiler/assets/eds/ini.hpp"
#include "compiler/assets/eds/values.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <string>

namespace stc::eds {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char *kDrive = R"([FileInfo]
FileName=drive.eds

[DeviceInfo]
VendorName=Acme
VendorNumber=0x000001AB
ProductName=Servo 12
ProductNumber=4711
RevisionNumber=0x10002
OrderCode=S-12
BaudRate_125=1
BaudRate_1000=1
BaudRate_800=0
NrOfRXPDO=2
NrOfTXPDO=1
LSS_Supported=1

[MandatoryObjects]
SupportedObjects=1
1=0x1000

[1000]
ParameterName=Device type
ObjectType=0x7
DataType=0x0007
AccessType=const
DefaultValue=0x20192
PDOMapping=0

[OptionalObjects]
SupportedObjects=7
1=0x1400
2=0x1600
3=0x1800
4=0x1A00
5=0x6041
6=0x6060
7=0x607A

[1400]
ParameterName=RPDO 1
ObjectType=9
SubNumber=3

[1400sub1]
ParameterName=COB-ID
ObjectType=7
DataType=7
AccessType=rw
DefaultValue=$NODEID+0x80000200

[1400SUB2]
ParameterName=Type
DataType=5
AccessType=RWW
DefaultValue=255

[1600]
ObjectType=9
SubNumber=3
[1600sub0]
DataType=5
AccessType=rw
DefaultValue=0
[1600sub1]
DataType=7
AccessType=rw
DefaultValue=0x60400010
[1600sub2]
DataType=7
AccessType=rw
DefaultValue=0x607A0020

[1800]
ObjectType=9
[1800sub1]
DataType=7
AccessType=rw
DefaultValue=0x40000180 + $NodeID
[1800sub2]
DataType=5
AccessType=rw
DefaultValue=1
[1800sub3]
DataType=6
AccessType=rw
[1a00]
ObjectType=9
[1a00sub0]
DataType=5
AccessType=ro
DefaultValue=1
[1a00sub1]
DataType=7
AccessType=ro
DefaultValue=0x60410010
[1a00sub2]
DataType=7
AccessType=ro
DefaultValue=0x60640020

[6041]
ParameterName=Statusword
ObjectType=7
DataType=6
AccessType=ro
PDOMapping=1

[6060]
ParameterName=Modes of operation
ObjectType=7
DataType=2
AccessType=wo
DefaultValue=0xFF
LowLimit=-1
HighLimit=10

[607A]
ParameterName=Target position
ObjectType=7
DataType=4
AccessType=rww
PDOMapping=1
)";

TEST(Eds, AWholeDrive) {
  const Device device = readEds(kDrive);
  ASSERT_EQ(device.notes.size(), 1U);
  EXPECT_EQ(device.notes[0].text,
            "1600h maps 0 objects, and names 2: they are taken for its mapping");
  EXPECT_EQ(device.notes[0].line, 61U);
  EXPECT_EQ(device.identity.vendorName, "Acme");
  EXPECT_EQ(device.identity.vendor, 0x1ABU);
  EXPECT_EQ(device.identity.product, 4711U);
  EXPECT_EQ(device.identity.revision, 0x10002U);
  EXPECT_EQ(device.identity.orderCode, "S-12");
  EXPECT_EQ(device.bitRates, 1U << 3U | 1U << 7U);
  EXPECT_EQ(device.receivePdos, 2);
  EXPECT_EQ(device.transmitPdos, 1);
  EXPECT_TRUE(device.settable);
  EXPECT_FALSE(device.nodeId);

  const Object *type = device.find(0x1000, 0);
  ASSERT_NE(type, nullptr);
  EXPECT_EQ(type->value()->number, 0x20192);
  EXPECT_EQ(type->access, Access::Const);
  EXPECT_EQ(type->line, 22U);
  const Object *mode = device.find(0x6060, 0);
  ASSERT_NE(mode, nullptr);
  EXPECT_EQ(mode->name, "Modes of operation");
  EXPECT_EQ(mode->value()->number, -1) << "0xFF of an INTEGER8";
  EXPECT_FALSE(mode->isReadable());
  EXPECT_FALSE(mode->mappable);
  EXPECT_EQ(mode->low->number, -1);
  EXPECT_EQ(mode->high->number, 10);
  EXPECT_TRUE(device.find(0x607A, 0)->mappable);
  EXPECT_EQ(device.find(0x6064, 0), nullptr);
  EXPECT_EQ(device.find(0x1400, 0), nullptr) << "nobody describes it";
}

TEST(Eds, ItsPdos) {
  const std::vector<Pdo> pdos = pdosOf(readEds(kDrive));
  ASSERT_EQ(pdos.size(), 2U);
  EXPECT_FALSE(pdos[0].transmit);
  EXPECT_EQ(pdos[0].number, 1);
  EXPECT_EQ(pdos[0].cobId->in(5), 0x80000205);
  EXPECT_EQ(pdos[0].type, 255);
  EXPECT_THAT(pdos[0].map, ElementsAre(0x60400010, 0x607A0020)) << "though their number is 0";
  EXPECT_FALSE(pdos[0].fixedMapping);
  EXPECT_FALSE(pdos[0].hasInhibitTime);
  EXPECT_TRUE(pdos[1].transmit);
  EXPECT_EQ(pdos[1].cobId->in(127), 0x400001FF);
  EXPECT_THAT(pdos[1].map, ElementsAre(0x60410010)) << "one of two";
  EXPECT_EQ(pdos[1].places, 2U);
  EXPECT_TRUE(pdos[1].fixedMapping);
  EXPECT_TRUE(pdos[1].hasInhibitTime);
}

TEST(Eds, ADcfSaysWhatItShallBe) {
  const Device device =
      readEds("[DeviceInfo]\nVendorNumber=1\n"
              "[DeviceComissioning]\nNodeID=0x10\nBaudrate=500\nLSS_SerialNumber=77\n"
              "[1017]\nDataType=6\nAccessType=rw\nDefaultValue=0\nParameterValue=0x64\n");
  EXPECT_EQ(device.nodeId, 16);
  EXPECT_EQ(device.bitRate, 500U);
  EXPECT_EQ(device.identity.serial, 77U);
  EXPECT_EQ(device.find(0x1017, 0)->value()->number, 100);
  EXPECT_EQ(device.find(0x1017, 0)->byDefault->number, 0);
}

TEST(Eds, ManyAlike) {
  const Device device =
      readEds("[DeviceInfo]\nVendorNumber=1\n[3004]\nCompactSubObj=3\nParameterName=Sensor\n"
              "ObjectType=8\nDataType=6\nAccessType=ro\nDefaultValue=3\n"
              "[3004Name]\nNrOfEntries=1\n2=Second one\n[3004Value]\nNrOfEntries=1\n3=9\n");
  EXPECT_THAT(device.notes, IsEmpty());
  ASSERT_EQ(device.objects.size(), 4U);
  EXPECT_EQ(device.find(0x3004, 0)->value()->number, 3);
  EXPECT_EQ(device.find(0x3004, 1)->name, "Sensor1");
  EXPECT_EQ(device.find(0x3004, 2)->name, "Second one");
  EXPECT_EQ(device.find(0x3004, 2)->value()->number, 3);
  EXPECT_EQ(device.find(0x3004, 3)->value()->number, 9);
}

std::string notesOf(const std::string &text) {
  const Device device = readEds("[DeviceInfo]\nVendorNumber=1\n" + text);
  std::string all;
  for (const Note &note : device.notes)
    all += std::to_string(note.line) + ": " + note.text + "\n";
  return all;
}

TEST(Eds, WhatIsStrangeIsNotedWithItsLine) {
  const std::string good = "[1001]\nDataType=5\nAccessType=ro\n";
  EXPECT_EQ(notesOf(good), "");
  EXPECT_EQ(notesOf(good + "[1001]\nDefaultValue=1\n"),
            "6: the section [1001] stands twice: both count\n");
  EXPECT_EQ(notesOf(good + "AccessType=rw\n"),
            "6: the key accesstype stands twice: the first one counts\n");
  EXPECT_EQ(notesOf(good + "hello\n"), "6: neither a section nor a key with a value\n");
  EXPECT_EQ(notesOf(good + "[1002\nDataType=5\n"), "6: a section has no ] at its end\n");
  EXPECT_EQ(notesOf("[1002]\nDataType=5\nAccessType=rx\n"),
            "5: AccessType of 1002h:0: \"rx\" is taken for rw\n");
  EXPECT_EQ(notesOf("[1002]\nDataType=5\nPDOMapping=maybe\n"),
            "5: PDOMapping of 1002h:0: \"maybe\" is taken for 0\n");
  EXPECT_EQ(notesOf("[1002]\nDataType=5\nDefaultValue=none\n"),
            "5: DefaultValue of 1002h:0: \"none\" is no UNSIGNED8: left out\n");
  EXPECT_EQ(notesOf("[1002]\nDataType=5\nDefaultValue=0x3E ; why\n"),
            "5: DefaultValue of 1002h:0: what stands after ; is left out\n");
  EXPECT_EQ(notesOf("[1002]\nDataType=5\nDefaultValue=256\n"),
            "5: DefaultValue of 1002h:0: 256 is more than UNSIGNED8 can be\n");
  EXPECT_EQ(notesOf("[1002]\nDataType=5\nLowLimit=7\nHighLimit=6\n"),
            "3: the limits of 1002h:0 exclude each other: both are left out\n");
  EXPECT_EQ(notesOf("[1002]\nDataType=0x40\n"), "3: 1002h:0 has no data type that is known\n");
  EXPECT_EQ(notesOf("[1002]\nDataType=5\n[1002sub0]\nDataType=5\n"),
            "5: 1002h:0 stands twice: the first one counts\n");
  EXPECT_EQ(notesOf(good + "[MandatoryObjects]\n1=0x1001\n2=0x1018\n3=x\n"),
            "8: 1018h is listed, and has no section\n9: [mandatoryobjects]: \"x\" is no index\n");
  EXPECT_EQ(notesOf(good + "[OptionalObjects]\nSupportedObjects=0\n"),
            "3: 1001h has a section, and is not listed: it counts\n");
  EXPECT_THAT(notesOf(""), HasSubstr("the file has no object"));
  EXPECT_THAT(readEds("[1001]\nDataType=5\n[DeviceInfo]\n").notes.front().text,
              HasSubstr("no VendorNumber"));
}

TEST(Eds, LinesEndAndTextsAreWrittenInManyWays) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const Device device =
        readEds("\xEF\xBB\xBF[DeviceInfo]" + end + "VendorName=M\xFCller & S\xC3\xB6hne" + end +
                "; [1001]" + end + " vendornumber = 0x1 " + end + "[1008]" + end + "DataType=9" +
                end + "DefaultValue= a text = with signs " + end);
    EXPECT_EQ(device.identity.vendorName, "M\xC3\xBCller & S\xC3\xB6hne");
    EXPECT_EQ(device.identity.vendor, 1U);
    ASSERT_EQ(device.objects.size(), 1U);
    EXPECT_EQ(device.objects[0].value()->text, "a text = with signs");
    EXPECT_TRUE(device.objects[0].value()->isText);
    EXPECT_EQ(device.objects[0].line, 5U);
  }
}

TEST(Eds, NumbersAreWrittenInManyWays) {
  EXPECT_EQ(numberOf("17"), 17);
  EXPECT_EQ(numberOf(" 0x1F "), 31);
  EXPECT_EQ(numberOf("0XfF"), 255);
  EXPECT_EQ(numberOf("1Fh"), 31);
  EXPECT_EQ(numberOf("-3"), -3);
  EXPECT_EQ(numberOf("010"), 10);
  EXPECT_EQ(numberOf("0xFFFFFFFFFFFFFFFF"), -1);
  for (const char *bad : {"", "0x", "x1", "1.5", "1 2", "0x1FFFFFFFFFFFFFFFF", "--1", "h"})
    EXPECT_FALSE(numberOf(bad)) << bad;
  const auto node = [](const char *text) { return valueOf(text) ? valueOf(text)->in(5) : -1; };
  EXPECT_EQ(node("$NODEID+0x180"), 0x185);
  EXPECT_EQ(node("$NodeID + 0x80"), 0x85);
  EXPECT_EQ(node("1280+$NODEID"), 1285);
  EXPECT_EQ(node("$nodeid"), 5);
  EXPECT_EQ(node("7"), 7);
  for (const char *bad :
       {"$NODEID-1", "$NODEID 0x80", "3+$NODEID+4", "$NODEID+", "+$NODEID", "$NODE+1"})
    EXPECT_EQ(node(bad), -1) << bad;
}

TEST(Eds, ThereIsAnEndToNotesAndObjects) {
  std::string text = "[DeviceInfo]\nVendorNumber=1\n";
  for (int i = 0; i < 1000; ++i)
    text += "nonsense\n";
  const Device device = readEds(text);
  EXPECT_EQ(device.notes.size(), Device::kMostNotes);
  EXPECT_EQ(device.moreNotes, 801U);
  std::string many;
  for (unsigned i = 0x2000; i < 0x2100; ++i) {
    char line[80];
    std::snprintf(line, sizeof line, "[%04X]\nObjectType=8\nCompactSubObj=254\nDataType=5\n", i);
    many += line;
  }
  EXPECT_EQ(readEds(many).objects.size(), Device::kMostObjects);
  EXPECT_THAT(readEds(many).notes.back().text, HasSubstr("more than 20000 objects"));
}

} // namespace
} // namespace stc::eds
