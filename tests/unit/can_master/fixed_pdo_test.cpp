// Nodes that are several drives, and nodes whose PDOs cannot be changed, at their start-up.
#include "tests/unit/can_master/start_up_fixture.hpp"

namespace stride::can {
namespace {

using test::StartUpOf;
using ::testing::Contains;
using ::testing::HasSubstr;

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
