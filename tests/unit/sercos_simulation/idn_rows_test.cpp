// The data blocks: each row makes sense, and each is read and written through the channel as it
// says.
#include "tests/unit/sercos_simulation/ring_master.hpp"

#include "drivers/sercos/protocol/pack_profile.hpp"

#include <algorithm>
#include <set>

namespace stride::sercos::simulation {
namespace {

TEST(SercosRows, AreOnesOfTheStandard) {
  SimulatedDrive drive(plainDrive());
  std::set<std::string_view> names;
  size_t standard = 0;
  for (const IdnEntry &entry : drive.list().entries()) {
    const IdnRow &row = entry.row;
    EXPECT_FALSE(row.name.empty()) << row.idn;
    EXPECT_LE(row.name.size(), 60U) << row.idn;
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    standard += row.idn < 32768 ? 1U : 0U;
    if (entry.hasLimits()) {
      EXPECT_LE(row.low, row.value) << row.idn;
      EXPECT_GE(row.high, row.value) << row.idn;
    }
    EXPECT_EQ(fitted(row.attribute, static_cast<uint64_t>(row.value)), row.value) << row.idn;
    EXPECT_TRUE(row.cyclic == 0 || (!entry.isList() && row.attribute.bytes <= 4)) << row.idn;
    EXPECT_TRUE((row.cyclic & kInMdt) == 0 || row.attribute.protection == 0) << row.idn;
    EXPECT_EQ(decodeAttribute(encode(row.attribute)), row.attribute);
  }
  EXPECT_EQ(standard, 117U) << "docs/sercos.md counts them";
}

TEST(SercosRows, EachIsReadWhole) {
  DriveScene scene;
  RingMaster &master = scene.master;
  master.toPhase2();
  EXPECT_EQ(master.ids(3, 17).size(), scene.drive.list().entries().size());
  for (const IdnEntry &entry : scene.drive.list().entries()) {
    const IdnRow &row = entry.row;
    const size_t bytes = entry.isList() ? 0 : row.attribute.bytes;
    const Answer data = master.read(3, row.idn, 7, bytes);
    ASSERT_EQ(data.error, 0) << row.idn;
    if (!entry.isList() && row.idn != 135) { // that one changes by being read
      EXPECT_EQ(fitted(row.attribute, static_cast<uint64_t>(data.number())), entry.value)
          << row.idn;
    }
    EXPECT_EQ(master.read(3, row.idn, 2, 0).text(), row.name);
    EXPECT_EQ(static_cast<uint32_t>(master.read(3, row.idn, 3, 4).number()), encode(row.attribute));
    const Answer unit = master.read(3, row.idn, 4, 0);
    EXPECT_EQ(unit.error, row.unit.empty() ? 0x4001 : 0) << row.idn;
    const Answer low = master.read(3, row.idn, 5, bytes == 0 ? 2 : bytes);
    EXPECT_EQ(low.error, entry.hasLimits() ? 0 : 0x5001) << row.idn;
  }
}

TEST(SercosRows, EachKeepsItsProtection) {
  for (unsigned phase = 2; phase <= 4; ++phase) {
    DriveScene scene;
    RingMaster &master = scene.master;
    if (phase == 2)
      master.toPhase2();
    else if (phase == 3)
      master.toPhase3();
    else
      master.toPhase4();
    for (const IdnEntry &entry : scene.drive.list().entries()) {
      const IdnRow &row = entry.row;
      if (entry.isList() || row.attribute.command)
        continue;
      const uint16_t error = master.write(3, row.idn, entry.value, row.attribute.bytes);
      const unsigned protection = row.attribute.protection;
      const uint16_t wanted = protection == 7                         ? 0x7004
                              : (protection >> (phase - 2) & 1U) != 0 ? 0x7005
                              : phase == 4 && row.idn == 47           ? 0x700A
                                                                      : 0;
      EXPECT_EQ(error, wanted) << row.idn << " in phase " << phase;
    }
    EXPECT_EQ(static_cast<unsigned>(scene.drive.phase()), phase);
  }
}

TEST(SercosRows, ListsOfTheOthers) {
  DriveScene scene;
  scene.master.toPhase2();
  EXPECT_EQ(scene.master.ids(3, 25), (std::vector<Idn>{99, 127, 128, 148, 170}));
  const std::vector<Idn> mdt = scene.master.ids(3, 188);
  for (const Idn idn : {Idn{36}, Idn{47}, Idn{80}, Idn{405}})
    EXPECT_NE(std::find(mdt.begin(), mdt.end(), idn), mdt.end());
  EXPECT_EQ(std::find(mdt.begin(), mdt.end(), 51), mdt.end());
}

TEST(SercosRows, TheDriveIsOneOfEachClass) {
  SimulatedDrive drive(plainDrive());
  for (const PackProfile profile :
       {PackProfile::BasicA, PackProfile::BasicB, PackProfile::Extended})
    for (const Idn idn : packProfileIdns(profile))
      EXPECT_NE(drive.list().find(idn), nullptr) << idn;
}

TEST(SercosRows, MoreOfThem) {
  DriveSetup setup = plainDrive();
  setup.more = {{.idn = 32768 + 4000, .name = "Mine", .attribute = {.bytes = 4}, .value = 5},
                {.idn = 47, .name = "Not this one"}};
  DriveScene scene(setup);
  scene.master.toPhase2();
  EXPECT_EQ(scene.master.read(3, 36768, 7, 4).number(), 5);
  EXPECT_EQ(scene.master.write(3, 36768, 70000, 4), 0);
  EXPECT_EQ(scene.master.read(3, 36768, 7, 4).number(), 70000);
  EXPECT_EQ(scene.master.read(3, 47, 2, 0).text(), "Position command value");
}

} // namespace
} // namespace stride::sercos::simulation
