#include "drivers/sercos/plan/group_plan.hpp"
#include "drivers/sercos/schema.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stride::sercos::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Cyclic, ControlTypesAreStandardTelegrams) {
  std::vector<std::string> errors;
  CyclicWish wish;
  wish.controlType = 5;
  CyclicPlan plan = planCyclic(wish, errors);
  EXPECT_EQ(plan.telegramType, 5);
  EXPECT_THAT(plan.mdt.objects(), ElementsAre(CyclicObject{47, 4}, CyclicObject{36, 4}));
  EXPECT_THAT(plan.at.objects(), ElementsAre(CyclicObject{51, 4}, CyclicObject{40, 4}));
  EXPECT_EQ(plan.mdt.bytes(), 12U);
  EXPECT_EQ(plan.mdt.placeOf(36), 8U);
  EXPECT_EQ(plan.controllerModes, 1 << 3 | 1 << 2);
  EXPECT_EQ(plan.received, 3);
  wish.controlType = 1;
  plan = planCyclic(wish, errors);
  EXPECT_EQ(plan.telegramType, 1);
  EXPECT_EQ(plan.mdt.bytes(), 6U);
  EXPECT_EQ(plan.at.bytes(), 4U);
  EXPECT_EQ(plan.controllerModes, 1 << 1);
  EXPECT_EQ(plan.received, 0);
}

TEST(Cyclic, MoreMakesAnApplicationTelegram) {
  std::vector<std::string> errors;
  CyclicWish wish;
  wish.controlType = 4;
  wish.more = {{189, 4}, {84, 2}};
  const CyclicPlan plan = planCyclic(wish, errors);
  EXPECT_EQ(plan.telegramType, 7);
  EXPECT_THAT(plan.at.objects(),
              ElementsAre(CyclicObject{51, 4}, CyclicObject{189, 4}, CyclicObject{84, 2}));
  EXPECT_EQ(plan.received, 1 | 4);
  wish.more.assign(8, {189, 4});
  (void)planCyclic(wish, errors);
  EXPECT_THAT(errors, testing::SizeIs(7)); // the same again and again
  wish.more.clear();
  for (Idn idn = 100; idn < 108; ++idn)
    wish.more.push_back({idn, 4});
  errors.clear();
  (void)planCyclic(wish, errors);
  EXPECT_THAT(errors, ElementsAre(HasSubstr("8 objects")));
}

TEST(IdnValue, Encodes) {
  IdnValue value;
  std::string error;
  ASSERT_TRUE(parseIdnValue(" p-0-12 := 16#FFFF ", value, error));
  EXPECT_EQ(value.idn, 32768 + 12);
  std::array<uint8_t, 8> bytes{};
  size_t count = 0;
  EXPECT_EQ(encodeValue(value, {.bytes = 2}, bytes, count), EncodeFault::None);
  EXPECT_EQ(count, 2U);
  value.numbers[0] = 65536;
  EXPECT_EQ(encodeValue(value, {.bytes = 2}, bytes, count), EncodeFault::Range);
  value.numbers[0] = -32768;
  EXPECT_EQ(encodeValue(value, {.bytes = 2}, bytes, count), EncodeFault::None);
  value.numbers[0] = -32769;
  EXPECT_EQ(encodeValue(value, {.bytes = 2}, bytes, count), EncodeFault::Range);
  ASSERT_TRUE(parseIdnValue("S-0-0016 := S-0-0051, 40", value, error));
  EXPECT_EQ(encodeValue(value, {.bytes = 2}, bytes, count), EncodeFault::NotOne);
  EXPECT_EQ(encodeValue(value, {.bytes = 2, .list = true}, bytes, count), EncodeFault::None);
  EXPECT_EQ(count, 4U);
  EXPECT_EQ(bytes[0], 51);
  ASSERT_TRUE(parseIdnValue("S-0-0142 := 'a := b'", value, error));
  EXPECT_EQ(value.text, "a := b");
  EXPECT_EQ(encodeValue(value, {.bytes = 2, .list = true}, bytes, count), EncodeFault::NoText);
  EXPECT_EQ(encodeValue(value, {.bytes = 1, .list = true}, bytes, count), EncodeFault::None);
  for (const char *text :
       {"S-0-0041", "X-0-0041 := 1", "S-0-0041 :=", "S-0-0041 := 1;", "S-0-0041 := 'a"})
    EXPECT_FALSE(parseIdnValue(text, value, error)) << text;
}

bus::GroupSetup group(size_t drives, double cycle, double megabits) {
  bus::GroupSetup setup(kSchema, cycle);
  setup.parameters.add({"wParam1", "", megabits});
  for (size_t i = 0; i < drives; ++i)
    setup.addDrive("D" + std::to_string(i), static_cast<uint32_t>(i + 1));
  return setup;
}

TEST(GroupPlan, TelegramsMustFit) {
  // 12 bytes each way: an AT of 96 + 24 bits, stuffed by a fifth, and two flags.
  EXPECT_EQ(planGroup(group(4, 0.003, 2)).fault, "");
  EXPECT_EQ(planGroup(group(8, 0.001, 4)).fault, "");
  const GroupPlan plan = planGroup(group(16, 0.001, 2));
  EXPECT_THAT(plan.fault, HasSubstr("us of the cycle of 1 ms at 2 MBit/s"));
  EXPECT_EQ(plan.timing.shortestCycle, 3000U);
  EXPECT_EQ(planGroup(group(16, 0.003, 2)).fault, "");
}

TEST(GroupPlan, CycleAndBaudRate) {
  EXPECT_THAT(planGroup(group(1, 0.0015, 2)).fault, HasSubstr("1500 us"));
  EXPECT_THAT(planGroup(group(1, 0.002, 5)).fault, HasSubstr("wParam1 says 5"));
  bus::GroupSetup setup(kSchema, 0.002);
  setup.parameters.add({"BaudRate", "8000", 8000});
  EXPECT_EQ(planGroup(setup).megabits, 8U);
  EXPECT_EQ(planGroup(bus::GroupSetup(kSchema, 0.002)).megabits, 2U);
}

TEST(GroupPlan, Addresses) {
  bus::GroupSetup setup(kSchema, 0.004);
  setup.addDrive("A", 3);
  setup.addDrive("B", 3);
  setup.addDrive("C", 0);
  setup.addDrive("D", 254);
  const GroupPlan plan = planGroup(setup);
  EXPECT_THAT(plan.faults, ElementsAre(HasSubstr("same wDriveId"), HasSubstr("same wDriveId"),
                                       HasSubstr("1 to 254"), ""));
}

TEST(GroupPlan, DescribesItself) {
  const bus::GroupPlanText text = describeGroup(group(2, 0.003, 2));
  EXPECT_THAT(text.text, HasSubstr("S-0-0047, S-0-0036 -> S-0-0051, S-0-0040"));
}

} // namespace
} // namespace stride::sercos::test
