// PDO plans and bus loads against numbers that stand here.
#include "drivers/can/plan/bus_load.hpp"
#include "drivers/can/plan/pdo_plan.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace stride::can {
namespace {

/// "1: 6040:0/16 607A:0/32", with `E` after the number of one by event.
std::string text(const Pdo &pdo) {
  std::string result = std::to_string(pdo.number) + (pdo.synchronous() ? ":" : "E:");
  for (const PdoEntry &one : pdo.mapped()) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, " %04X:%u/%u", one.object.index, one.object.sub, one.bits);
    result += buffer;
  }
  return result;
}

std::vector<std::string> texts(std::span<const Pdo> pdos) {
  std::vector<std::string> result;
  for (const Pdo &pdo : pdos)
    result.push_back(text(pdo));
  return result;
}

struct PlanCase {
  const char *what;
  DriveWish wish;
  std::vector<std::string> rpdos;
  std::vector<std::string> tpdos;
  uint32_t bits;
  uint8_t modes;
};

DriveWish wish(uint8_t type, bool mode = false, bool events = true) {
  DriveWish result;
  result.node = 5;
  result.controlType = type;
  result.modeInPdo = mode;
  result.eventPdos = events;
  return result;
}

DriveWish configurable(std::array<uint16_t, 3> send, std::array<uint16_t, 3> receive) {
  DriveWish result = wish(0);
  result.send = send;
  result.receive = receive;
  return result;
}

const std::vector<PlanCase> &planCases() {
  static const std::vector<PlanCase> kCases = {
      {"POS -> POS", wish(4), {"1: 6040:0/16 607A:0/32"}, {"1: 6041:0/16 6064:0/32"}, 230, 8},
      {"with modes",
       wish(4, true),
       {"1: 6040:0/16 6060:0/8 607A:0/32"},
       {"1: 6041:0/16 6061:0/8 6064:0/32"},
       250,
       8},
      {"POS, VEL -> POS, VEL",
       wish(5),
       {"1: 607A:0/32 60B1:0/32", "2E: 6040:0/16 6060:0/8"},
       {"1: 6064:0/32 606C:0/32", "2E: 6041:0/16 6061:0/8"},
       270,
       12},
      {"without event PDOs",
       wish(5, false, false),
       {"1: 6040:0/16 607A:0/32", "2: 60B1:0/32"},
       {"1: 6041:0/16 6064:0/32", "2: 606C:0/32"},
       420,
       12},
      {"VEL -> POS", wish(3), {"1: 6040:0/16 60FF:0/32"}, {"1: 6041:0/16 6064:0/32"}, 230, 4},
      {"VEL -> VEL", wish(2), {"1: 6040:0/16 60FF:0/32"}, {"1: 6041:0/16 606C:0/32"}, 230, 4},
      {"VEL ->", wish(6), {"1: 6040:0/16 60FF:0/32"}, {"1: 6041:0/16"}, 190, 4},
      {"TOR ->", wish(1), {"1: 6040:0/16 6071:0/16"}, {"1: 6041:0/16"}, 170, 2},
      {"torque, with the position back",
       configurable({1160, 0, 0}, {1101, 0, 0}),
       {"1: 6040:0/16 6071:0/16"},
       {"1: 6041:0/16 6064:0/32"},
       210,
       2},
      {"positions and torques",
       configurable({1160, 1100, 0}, {1101, 1161, 1151}),
       {"1: 6040:0/16 607A:0/32 6071:0/16"},
       {"1: 6064:0/32 6077:0/16 6078:0/16", "2E: 6041:0/16 6061:0/8"},
       135 + 135,
       10},
      {"all three",
       configurable({1110, 1160, 1100}, {1161, 1111, 1101}),
       {"1: 607A:0/32 60B1:0/32", "2: 6071:0/16", "3E: 6040:0/16 6060:0/8"},
       {"1: 6064:0/32 606C:0/32", "2: 6077:0/16", "3E: 6041:0/16 6061:0/8"},
       2 * (135 + 75),
       14},
  };
  return kCases;
}

TEST(PdoPlan, OfEachControlType) {
  for (const PlanCase &one : planCases()) {
    const PlanResult result = planDrive(one.wish);
    EXPECT_TRUE(result.notes.empty()) << one.what;
    EXPECT_EQ(texts(result.plan.receivedByDrive()), one.rpdos) << one.what;
    EXPECT_EQ(texts(result.plan.sentByDrive()), one.tpdos) << one.what;
    EXPECT_EQ(cyclicBits(result.plan), one.bits) << one.what;
    EXPECT_EQ(result.plan.controllerModes, one.modes) << one.what;
  }
}

TEST(PdoPlan, IdentifiersAreThePredefinedOnes) {
  const DrivePlan plan = planDrive(configurable({1110, 1160, 1100}, {1101, 1111, 1161})).plan;
  EXPECT_EQ(plan.node, 5);
  EXPECT_EQ(plan.rpdos[0].cobId, 0x205);
  EXPECT_EQ(plan.rpdos[1].cobId, 0x305);
  EXPECT_EQ(plan.rpdos[2].cobId, 0x405);
  EXPECT_EQ(plan.tpdos[0].cobId, 0x185);
  EXPECT_EQ(plan.tpdos[1].cobId, 0x285);
  EXPECT_EQ(plan.tpdos[2].cobId, 0x385);
}

TEST(PdoPlan, InputsAndProbesShareWhatIsThere) {
  DriveWish packed = wish(5);
  packed.inputs = true;
  packed.probeInputs = 0b0110;
  DrivePlan plan = planDrive(packed).plan;
  EXPECT_THAT(texts(plan.receivedByDrive()),
              ::testing::ElementsAre("1: 607A:0/32 60B1:0/32", "2E: 6040:0/16 6060:0/8 60B8:0/16"));
  EXPECT_THAT(texts(plan.sentByDrive()),
              ::testing::ElementsAre("1: 6064:0/32 606C:0/32", "2E: 6041:0/16 6061:0/8 60FD:0/32",
                                     "3E: 60B9:0/16 60BB:0/32"));
  EXPECT_TRUE(plan.carries(Signal::Inputs));
  EXPECT_TRUE(plan.carries(Signal::Probe1Falling));
  EXPECT_FALSE(plan.carries(Signal::Probe2Rising));
  EXPECT_EQ(plan.tpdos[1].eventTimer, 100);
  EXPECT_EQ(plan.rpdos[1].eventTimer, 0) << "that is the drive's to watch";
  EXPECT_EQ(cyclicBits(plan), 270U);

  DriveWish plain = wish(4, false, false);
  plain.inputs = true;
  plan = planDrive(plain).plan;
  EXPECT_THAT(texts(plan.sentByDrive()),
              ::testing::ElementsAre("1: 6041:0/16 6064:0/32", "2: 60FD:0/32"));
}

TEST(PdoPlan, SaysWhatItLeavesOut) {
  PlanResult result = planDrive(configurable({1100, 1150, 65535}, {1101, 7, 65535}));
  EXPECT_THAT(result.notes,
              ::testing::UnorderedElementsAre(PlanNote::CurrentNotSent, PlanNote::UserDataNotMapped,
                                              PlanNote::UnknownData));
  EXPECT_TRUE(result.usable());
  EXPECT_EQ(result.plan.sent, cyclic::kPosition);
  result = planDrive(configurable({1150, 0, 0}, {1101, 0, 0}));
  EXPECT_FALSE(result.usable());
  EXPECT_THAT(result.notes, ::testing::Contains(PlanNote::NothingSent));
  result = planDrive(wish(7));
  EXPECT_FALSE(result.usable());
  EXPECT_THAT(result.notes, ::testing::ElementsAre(PlanNote::UnknownControlType));
  for (const PlanNote note :
       {PlanNote::CurrentNotSent, PlanNote::UserDataNotMapped, PlanNote::UnknownData,
        PlanNote::UnknownControlType, PlanNote::NothingSent, PlanNote::TooMany})
    EXPECT_GT(describe(note).size(), 10U);
}

TEST(PdoPlan, NoPlanHasMoreThanAFrameHoldsOrATwiceUsedIdentifier) {
  std::mt19937 random(7);
  const std::array<uint16_t, 10> numbers = {0,    1100, 1101, 1110, 1111,
                                            1150, 1151, 1160, 1161, 65535};
  const auto any = [&] { return numbers[random() % numbers.size()]; };
  for (int i = 0; i < 20000; ++i) {
    DriveWish one = configurable({any(), any(), any()}, {any(), any(), any()});
    one.node = static_cast<uint8_t>(1 + random() % kLastNode);
    one.controlType = static_cast<uint8_t>(random() % 9);
    one.modeInPdo = random() % 2 != 0;
    one.eventPdos = random() % 2 != 0;
    one.inputs = random() % 2 != 0;
    one.probeInputs = static_cast<uint8_t>(random() % 16);
    const PlanResult result = planDrive(one);
    if (!result.usable())
      continue;
    const DrivePlan &plan = result.plan;
    EXPECT_TRUE(plan.carries(Signal::Controlword));
    EXPECT_TRUE(plan.carries(Signal::Statusword));
    EXPECT_EQ(plan.carries(Signal::Position), (plan.received & cyclic::kPosition) != 0);
    EXPECT_EQ(plan.carries(Signal::ProbeStatus), one.probeInputs != 0);
    EXPECT_EQ(plan.carries(Signal::Inputs), one.inputs);
    for (const auto pdos : {plan.receivedByDrive(), plan.sentByDrive()})
      for (const Pdo &pdo : pdos) {
        EXPECT_GT(pdo.count, 0);
        EXPECT_LE(pdo.bits(), 64U);
        EXPECT_EQ(pdo.cobId & 0x7F, one.node);
      }
  }
}

// The table of axes at 80 %: 1 Mbit/s, 1 / 2 / 4 / 8 ms.
TEST(BusLoad, AxesThatFitInFourFifths) {
  struct Row {
    DriveWish wish;
    std::array<uint32_t, 4> axes;
  };
  const std::array<Row, 4> rows = {{{wish(4), {3, 6, 13, 27}},
                                    {wish(4, true), {2, 6, 12, 25}},
                                    {wish(5), {2, 5, 11, 23}},
                                    {wish(5, false, false), {1, 3, 7, 15}}}};
  for (const Row &row : rows)
    for (size_t i = 0; i < 4; ++i) {
      const uint32_t cycle = 1000U << i;
      std::vector<DrivePlan> plans(row.axes[i], planDrive(row.wish).plan);
      EXPECT_TRUE(busLoad(plans, 1000, cycle).comfortable());
      EXPECT_TRUE(busLoad(plans, 500, 2 * cycle).comfortable());
      EXPECT_LE(busLoad(plans, 1000, cycle).shortestCycle, cycle);
      plans.push_back(plans.front());
      EXPECT_FALSE(busLoad(plans, 1000, cycle).comfortable());
      EXPECT_FALSE(busLoad(plans, 500, 2 * cycle).comfortable());
      EXPECT_GT(busLoad(plans, 1000, cycle).shortestCycle, cycle);
    }
}

TEST(BusLoad, LimitsAtBelowAndAbove) {
  // 55 + 3 x 230 = 745 bits.
  const std::vector<DrivePlan> plans(3, planDrive(wish(4)).plan);
  BusLoad load = busLoad(plans, 1000, 745);
  EXPECT_EQ(load.bits, 745U);
  EXPECT_EQ(load.share, 1.0);
  EXPECT_TRUE(load.fits());
  EXPECT_EQ(load.sdoPerCycle, 1U) << "at least one, or no drive would start";
  EXPECT_FALSE(busLoad(plans, 1000, 744).fits());
  EXPECT_TRUE(busLoad(plans, 1000, 746).fits());
  EXPECT_EQ(load.shortestCycle, 1000U);
  EXPECT_EQ(busLoad(plans, 500, 2000).shortestCycle, 2000U);
  EXPECT_EQ(busLoad(plans, 125, 2000).shortestCycle, 7500U); // 7450 us
  // SDOs: 270 bits each, after 65 + 135 for a heartbeat and an EMCY.
  EXPECT_EQ(busLoad(plans, 1000, 745 + 200 + 2 * 270 - 1).sdoPerCycle, 1U);
  EXPECT_EQ(busLoad(plans, 1000, 745 + 200 + 2 * 270).sdoPerCycle, 2U);
  EXPECT_EQ(busLoad(plans, 1000, 745 + 200 + 4 * 270 - 1).sdoPerCycle, 3U);
  EXPECT_EQ(busLoad(plans, 1000, 745 + 200 + 9 * 270).sdoPerCycle, 4U);
  // No drive: SYNC alone.
  load = busLoad({}, 10, 5500);
  EXPECT_EQ(load.share, 1.0);
  EXPECT_EQ(busLoad({}, 1000, 1000).shortestCycle, 500U);
}

TEST(PdoWrites, SwitchOffMapAndSwitchOn) {
  DriveWish one = wish(4);
  one.node = 0x21;
  const std::vector<SdoWrite> writes = pdoWrites(planDrive(one).plan);
  std::vector<std::string> lines;
  for (const SdoWrite &write : writes) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%04X:%u/%u=%X%s%s", write.object.index, write.object.sub,
                  write.size, write.value, write.optional ? "?" : "",
                  write.keepNoRemote ? "r" : "");
    lines.emplace_back(buffer);
  }
  EXPECT_THAT(lines, ::testing::ElementsAre(
                         "1400:1/4=80000221", "1600:0/1=0", "1600:1/4=60400010",
                         "1600:2/4=607A0020", "1600:0/1=2", "1400:2/1=1", "1400:1/4=221",
                         "1401:1/4=80000321?", "1402:1/4=80000421?", "1403:1/4=80000521?",
                         "1800:1/4=800001A1r", "1A00:0/1=0", "1A00:1/4=60410010",
                         "1A00:2/4=60640020", "1A00:0/1=2", "1800:2/1=1", "1800:1/4=1A1r",
                         "1801:1/4=800002A1?r", "1802:1/4=800003A1?r", "1803:1/4=800004A1?r"));
}

TEST(PdoWrites, EventPdosHaveATimer) {
  const std::vector<SdoWrite> writes = pdoWrites(planDrive(wish(5)).plan);
  const auto timer = std::find_if(writes.begin(), writes.end(), [](const SdoWrite &write) {
    return write.object == Object{0x1801, 5};
  });
  ASSERT_NE(timer, writes.end());
  EXPECT_EQ(timer->value, 100U);
  EXPECT_TRUE(timer->optional);
}

TEST(ConciseDcf, HasTheLayoutOf1F22) {
  const std::vector<SdoWrite> writes = {{{0x1800, 1}, 4, 0x12345681, false, true},
                                        {{0x1401, 1}, 4, 1, true},
                                        {{0x1A00, 0}, 1, 2},
                                        {{0x1017, 0}, 2, 0x03E8}};
  EXPECT_THAT(conciseDcf(writes),
              ::testing::ElementsAre(3, 0, 0, 0,                                        //
                                     0x00, 0x18, 1, 4, 0, 0, 0, 0x81, 0x56, 0x34, 0x52, //
                                     0x00, 0x1A, 0, 1, 0, 0, 0, 2,                      //
                                     0x17, 0x10, 0, 2, 0, 0, 0, 0xE8, 0x03));
  EXPECT_THAT(conciseDcf({}), ::testing::ElementsAre(0, 0, 0, 0));
}

TEST(ConciseDcf, TheStampChangesWithEachValue) {
  std::vector<SdoWrite> writes = pdoWrites(planDrive(wish(5)).plan);
  const ConfigurationStamp stamp = stampOf(writes);
  EXPECT_NE(stamp.date, 0U);
  EXPECT_LT(stamp.time, 86400000U);
  EXPECT_EQ(stampOf(writes), stamp);
  for (SdoWrite &write : writes) {
    write.value ^= 1;
    EXPECT_FALSE(stampOf(writes) == stamp);
    write.value ^= 1;
  }
}

TEST(Objects, FormsOfObjects) {
  EXPECT_EQ(formOf({0x6071, 0}).bytes, 2);
  EXPECT_TRUE(formOf({0x6098, 0}).isSigned);
  EXPECT_EQ(formOf({0x6099, 2}).bytes, 4);
  EXPECT_EQ(formOf({0x6099, 3}).bytes, 0);
  EXPECT_EQ(signalOf({0x60C1, 1}), Signal::TargetPosition);
  EXPECT_EQ(signalOf({0x60C1, 2}), Signal::Other);
}

} // namespace
} // namespace stride::can
