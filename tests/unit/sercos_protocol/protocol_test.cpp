// Numbers and texts of the protocol, against what public manuals print.
#include "drivers/sercos/protocol/attribute.hpp"
#include "drivers/sercos/protocol/idn.hpp"
#include "drivers/sercos/protocol/pack_profile.hpp"
#include "drivers/sercos/protocol/service_error.hpp"
#include "drivers/sercos/protocol/telegrams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace stride::sercos {
namespace {

std::string textOf(Idn idn) {
  const IdnText text = idnText(idn);
  return {text.begin(), text.end()};
}

TEST(SercosIdn, TextAndNumber) {
  EXPECT_EQ(textOf(47), "S-0-0047");
  EXPECT_EQ(textOf(32768 + 3005), "P-0-3005");
  EXPECT_EQ(textOf(0xFFFF), "P-7-4095");
  EXPECT_EQ(parseIdn("S-0-0047"), 47);
  EXPECT_EQ(parseIdn("s-0-47"), 47);
  EXPECT_EQ(parseIdn("P-0-3005"), 35773);
  EXPECT_EQ(parseIdn("S-1-0047"), 4096 + 47);
  EXPECT_EQ(parseIdn("S-7-4095"), 0x7FFF);
  for (const char *bad : {"", "S", "S-0-", "S-0", "X-0-0001", "S-8-0001", "S-0-4096", "S-0-00001",
                          "S-0-00a1", "S 0-0001", "S-0+0001", "S-0-0001 ", "S-x-0001"})
    EXPECT_FALSE(parseIdn(bad).has_value()) << bad;
}

TEST(SercosIdn, EveryNumberComesBack) {
  for (unsigned number = 0; number <= 0xFFFF; ++number) {
    const auto idn = static_cast<Idn>(number);
    ASSERT_EQ(parseIdn(textOf(idn)), idn);
  }
}

TEST(SercosAttribute, Bits) {
  const Attribute torque = {.bytes = 2, .display = Display::Signed, .decimals = 1};
  EXPECT_EQ(encode(torque), 0x0121'0001U);
  const Attribute list = {
      .bytes = 2, .list = true, .display = Display::Idn, .protection = protect::kAlways};
  EXPECT_EQ(encode(list), 0x7055'0001U);
  const Attribute command = {
      .bytes = 2, .command = true, .display = Display::Binary, .protection = protect::kPhase3};
  EXPECT_EQ(encode(command), 0x2009'0001U);
  const Attribute text = {.factor = 7, .bytes = 1, .list = true, .display = Display::Text};
  EXPECT_EQ(encode(text), 0x0044'0007U);
  for (const Attribute &one : {torque, list, command, text})
    EXPECT_EQ(decodeAttribute(encode(one)), one);
}

TEST(SercosAttribute, EveryLengthIsOne) {
  const unsigned bytes[] = {2, 2, 4, 8, 1, 2, 4, 8};
  for (uint32_t length = 0; length < 8; ++length) {
    const Attribute attribute = decodeAttribute(length << 16U);
    EXPECT_EQ(attribute.bytes, bytes[length]);
    EXPECT_EQ(attribute.list, length >= 4);
  }
}

TEST(SercosAttribute, WritableInAPhase) {
  Attribute attribute;
  attribute.protection = protect::kPhase3 | protect::kPhase4;
  EXPECT_TRUE(attribute.writableIn(Phase::Two));
  EXPECT_FALSE(attribute.writableIn(Phase::Three));
  EXPECT_FALSE(attribute.writableIn(Phase::Four));
  EXPECT_FALSE(attribute.writableIn(Phase::One));
  EXPECT_FALSE(attribute.writableIn(Phase::Zero));
}

TEST(SercosServiceErrors, AreInOrderAndHaveTexts) {
  uint16_t last = 0;
  for (const ServiceErrorRow &row : serviceErrors()) {
    EXPECT_TRUE(row.code > last || row.code == 0);
    EXPECT_FALSE(row.text.empty());
    EXPECT_EQ(serviceErrorText(row.code), row.text);
    last = row.code;
  }
  EXPECT_EQ(last, 0x7013);
  EXPECT_EQ(serviceErrorText(0x1001), "the drive has no such IDN");
  EXPECT_EQ(serviceErrorText(0x7008), "the value is not allowed");
  EXPECT_EQ(serviceErrorText(0x7000), "an error that the standard does not have");
  EXPECT_EQ(errorOf(Element::Name, 0x7004), 0x2004);
}

TEST(SercosTelegrams, StandardOnes) {
  const auto is = [](std::span<const Idn> list, std::initializer_list<Idn> wanted) {
    return std::equal(list.begin(), list.end(), wanted.begin(), wanted.end());
  };
  EXPECT_TRUE(is(standardTelegram(4).at, {51}) && is(standardTelegram(4).mdt, {47}));
  EXPECT_TRUE(is(standardTelegram(12).at, {53}) && is(standardTelegram(12).mdt, {47}));
  EXPECT_TRUE(is(standardTelegram(5).at, {51, 40}) && is(standardTelegram(5).mdt, {47, 36}));
  EXPECT_TRUE(is(standardTelegram(13).at, {53, 40}));
  EXPECT_TRUE(is(standardTelegram(2).at, {40}) && is(standardTelegram(2).mdt, {36}));
  EXPECT_TRUE(is(standardTelegram(3).at, {51}) && is(standardTelegram(11).at, {53}));
  EXPECT_TRUE(is(standardTelegram(1).at, {}) && is(standardTelegram(1).mdt, {80}));
  EXPECT_TRUE(is(standardTelegram(7).at, {}) && is(standardTelegram(7).mdt, {}));
  EXPECT_TRUE(is(standardTelegram(0).at, {}) && is(standardTelegram(0).mdt, {}));
}

TEST(SercosPackProfile, ClassesContainWhatTheirDescriptionsSay) {
  const auto has = [](PackProfile profile, Idn idn) {
    const std::span<const Idn> all = packProfileIdns(profile);
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
    EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
    return std::find(all.begin(), all.end(), idn) != all.end();
  };
  EXPECT_TRUE(has(PackProfile::BasicA, 47));
  EXPECT_FALSE(has(PackProfile::BasicA, 36));
  EXPECT_TRUE(has(PackProfile::BasicB, 36));
  EXPECT_FALSE(has(PackProfile::BasicB, 47));
  for (const Idn idn : {Idn{47}, Idn{36}, Idn{80}, Idn{148}, Idn{170}, Idn{16}, Idn{301}})
    EXPECT_TRUE(has(PackProfile::Extended, idn)) << idn;
  EXPECT_TRUE(packProfileIdns(PackProfile::None).empty());
}

TEST(SercosWords, Modes) {
  for (uint8_t mode = 0; mode < 8; ++mode)
    EXPECT_EQ(modeOf(modeBits(mode)), mode);
  EXPECT_EQ(modeBits(1), 0x0100);
  EXPECT_EQ(modeBits(2), 0x0200);
  EXPECT_EQ(modeBits(4), 0x0800);
  EXPECT_EQ(modeOf(0xF4FF), 0) << "nothing but bits 8, 9 and 11";
}

} // namespace
} // namespace stride::sercos
