// Device descriptions in XML.
#include "compiler/assets/eds/device.hpp"
#include "compiler/assets/eds/xml.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

namespace stc::eds {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char *kXdd = R"(<?xml version="1.0" encoding="utf-8"?>
<!-- <CANopenObject index="7777"/> -->
<ISO15745ProfileContainer xmlns="http://www.canopen.org/xml/1.1">
  <ISO15745Profile><ProfileBody xsi:type="ProfileBody_Device_CANopen">
    <co:DeviceIdentity>
      <vendorName>Acme &amp; Sons</vendorName>
      <vendorID>0x1AB</vendorID>
      <productName>Servo</productName>
      <productID>0x12</productID>
    </co:DeviceIdentity>
    <parameterList>
      <parameter uniqueID="UID_1017" access="readWrite">
        <label lang="en">Heartbeat</label><UINT/>
        <defaultValue value="0"/>
        <actualValue value="0x64"/>
      </parameter>
    </parameterList>
  </ProfileBody></ISO15745Profile>
  <ISO15745Profile><ProfileBody xsi:type="ProfileBody_CommunicationNetwork_CANopen">
    <CANopenObjectList>
      <CANopenObject index="1000" name="Device type" objectType="7" dataType="0007"
                     accessType="const" defaultValue="0x20192" PDOmapping="no"/>
      <CANopenObject index="1017" name="Heartbeat" objectType="7" PDOmapping="no"
                     uniqueIDRef="UID_1017"/>
      <CANopenObject index="1A00" name="TPDO &#39;1&#x27;" objectType="9" subNumber="2">
        <CANopenSubObject subIndex="00" name="Count" objectType="7" dataType="0005"
                          accessType="rw" defaultValue="1"/>
        <CANopenSubObject subIndex="01" name="a > b" objectType="7" dataType="0007"
                          accessType="rw" defaultValue="0x60410010"/>
      </CANopenObject>
      <CANopenObject index="6041" name="Statusword" objectType="7" dataType="0006"
                     accessType="ro" PDOmapping="TPDO"/>
      <CANopenObject index="xyz" objectType="7"/>
    </CANopenObjectList>
    <NetworkManagement>
      <CANopenGeneralFeatures nrOfRxPDO="4" nrOfTxPDO="3" layerSettingServiceSlave="true"/>
      <baudRate><supportedBaudRate value="500 Kbps"/><supportedBaudRate value="1000 Kbps"/></baudRate>
      <deviceCommissioning nodeID="12" actualBaudRate="500 Kbps"/>
    </NetworkManagement>
  </ProfileBody></ISO15745Profile>
</ISO15745ProfileContainer>
)";

TEST(Xdd, AWholeDevice) {
  const Device device = readXdd(kXdd);
  ASSERT_EQ(device.notes.size(), 1U);
  EXPECT_EQ(device.notes[0].text, "\"xyz\" is no index of an object");
  EXPECT_EQ(device.notes[0].line, 33U);
  EXPECT_EQ(device.identity.vendorName, "Acme & Sons");
  EXPECT_EQ(device.identity.vendor, 0x1ABU);
  EXPECT_EQ(device.identity.product, 0x12U);
  EXPECT_EQ(device.objects.size(), 5U);
  EXPECT_EQ(device.find(0x1000, 0)->value()->number, 0x20192);
  EXPECT_EQ(device.find(0x1000, 0)->access, Access::Const);
  EXPECT_EQ(device.find(0x1017, 0)->value()->number, 100);
  EXPECT_EQ(device.find(0x1017, 0)->type, 0x06);
  EXPECT_EQ(device.find(0x1017, 0)->access, Access::ReadWrite);
  EXPECT_EQ(device.find(0x1A00, 1)->name, "a > b");
  EXPECT_TRUE(device.find(0x6041, 0)->mappable);
  EXPECT_EQ(device.receivePdos, 4);
  EXPECT_EQ(device.transmitPdos, 3);
  EXPECT_TRUE(device.settable);
  EXPECT_EQ(device.bitRates, 1U << 5U | 1U << 7U);
  EXPECT_EQ(device.nodeId, 12);
  EXPECT_EQ(device.bitRate, 500U);
}

TEST(Xdd, SomethingElseIsNoted) {
  EXPECT_THAT(readXdd("hello <b/>").notes.front().text, HasSubstr("no CANopenObject"));
  EXPECT_THAT(readXdd("hello\n<b>").notes.front().text, HasSubstr("the XML ends here"));
  EXPECT_EQ(readXdd("hello\n<b>").notes.front().line, 2U);
  // Entities are not expanded, and what stands before an error counts.
  EXPECT_EQ(
      readXdd("<!DOCTYPE a [<!ENTITY x 'y'>]><a><vendorName>&x;</vendorName>").identity.vendorName,
      "&x;");
  EXPECT_THAT(readXdd("").objects, IsEmpty());
}

TEST(Xml, TagsAndTheirParts) {
  XmlTags tags(
      "<r><a x='1' y=\"2>3\"/>text <!-- <no/> --><n:b  z = 'q' >&lt;&#65;&unknown;</n:b><c/></r>");
  XmlTag tag;
  ASSERT_TRUE(tags.next(tag));
  EXPECT_EQ(tag.name, "r");
  ASSERT_TRUE(tags.next(tag));
  EXPECT_EQ(tag.name, "a");
  EXPECT_TRUE(tag.opens && tag.closes);
  EXPECT_EQ(tag["x"], "1");
  EXPECT_EQ(tag["y"], "2>3");
  EXPECT_EQ(tag["none"], "");
  EXPECT_EQ(tags.text(), "text");
  ASSERT_TRUE(tags.next(tag));
  EXPECT_EQ(tag.name, "b");
  EXPECT_EQ(tag["z"], "q");
  EXPECT_EQ(tags.text(), "<A&unknown;");
  ASSERT_TRUE(tags.next(tag));
  EXPECT_TRUE(!tag.opens && tag.closes);
  ASSERT_TRUE(tags.next(tag));
  EXPECT_EQ(tag.name, "c");
  ASSERT_TRUE(tags.next(tag));
  EXPECT_TRUE(tag.name == "r" && tag.closes && !tag.opens);
  EXPECT_FALSE(tags.next(tag));
}

} // namespace
} // namespace stc::eds
