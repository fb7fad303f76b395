// Heartbeat, guarding, EMCY, and the codes of PDOs.
#include "drivers/can/master/emcy.hpp"
#include "drivers/can/master/signals.hpp"
#include "drivers/can/master/supervision.hpp"
#include "drivers/can/master/texts.hpp"
#include "tests/unit/can_master/script.hpp"

#include <gtest/gtest.h>

#include <random>

namespace stride::can {
namespace {

void cycles(Supervision &supervision, int count) {
  for (int i = 0; i < count; ++i)
    supervision.cycle();
}

TEST(Heartbeat, IsLostAfterOneAndAHalfPeriods) {
  // Period, and the cycle in which it is lost: 1.5 periods, but never less than 3 cycles.
  for (const auto &[period, limit] : std::vector<std::pair<uint32_t, int>>{
           {100, 150}, {101, 152}, {10, 15}, {2, 3}, {1, 3}, {3, 5}}) {
    Supervision supervision(5);
    supervision.begin(Supervision::Kind::Heartbeat, period);
    cycles(supervision, limit - 1);
    EXPECT_FALSE(supervision.lost()) << period;
    cycles(supervision, 1);
    EXPECT_TRUE(supervision.lost()) << period;
    cycles(supervision, 1000);
    EXPECT_TRUE(supervision.lost());
    supervision.received(test::frame("705#05"));
    EXPECT_FALSE(supervision.lost()) << "it is back";
    cycles(supervision, limit - 1);
    EXPECT_FALSE(supervision.lost());
  }
}

TEST(Heartbeat, SaysTheState) {
  Supervision supervision(5);
  EXPECT_EQ(supervision.state(), nmt::kUnknown);
  EXPECT_FALSE(supervision.lost()) << "nobody watches";
  supervision.received(test::frame("705#00"));
  EXPECT_EQ(supervision.bootUps(), 1U);
  EXPECT_EQ(supervision.state(), nmt::kBootUp);
  supervision.received(test::frame("705#7F"));
  EXPECT_EQ(supervision.state(), nmt::kPreOperational);
  supervision.received(test::frame("705#0505")); // no heartbeat has two bytes
  supervision.received(test::frame("705#"));
  supervision.received(test::frame("705#R"));
  EXPECT_EQ(supervision.state(), nmt::kPreOperational);
  EXPECT_FALSE(supervision.asks());
  supervision.clear();
  EXPECT_EQ(supervision.bootUps(), 0U);
}

TEST(Guarding, AsksAndCountsOnlyAnswersThatToggle) {
  Supervision supervision(5);
  supervision.begin(Supervision::Kind::Guarding, 10);
  supervision.cycle();
  ASSERT_TRUE(supervision.asks());
  EXPECT_EQ(test::text(supervision.question()), "705#R");
  supervision.asked();
  supervision.received(test::frame("705#05"));
  EXPECT_EQ(supervision.state(), nmt::kOperational);
  cycles(supervision, 9);
  EXPECT_FALSE(supervision.asks());
  cycles(supervision, 1);
  EXPECT_TRUE(supervision.asks());
  supervision.asked();
  supervision.received(test::frame("705#85"));
  EXPECT_EQ(supervision.repeated(), 0U);
  cycles(supervision, 29);
  EXPECT_FALSE(supervision.lost());
  supervision.received(test::frame("705#85")); // it repeats itself
  EXPECT_EQ(supervision.repeated(), 1U);
  cycles(supervision, 1);
  EXPECT_TRUE(supervision.lost()) << "three periods";
  supervision.received(test::frame("705#05"));
  EXPECT_FALSE(supervision.lost());
  // After a boot-up the bit begins anew.
  supervision.received(test::frame("705#00"));
  supervision.received(test::frame("705#7F"));
  EXPECT_EQ(supervision.state(), nmt::kPreOperational);
}

TEST(Nmt, Commands) {
  EXPECT_EQ(test::text(nmtFrame(NmtCommand::Start, 5)), "000#0105");
  EXPECT_EQ(test::text(nmtFrame(NmtCommand::PreOperational, 127)), "000#807F");
  EXPECT_EQ(test::text(nmtFrame(NmtCommand::ResetNode, 1)), "000#8101");
  EXPECT_EQ(test::text(nmtFrame(NmtCommand::ResetCommunication, 9)), "000#8209");
}

TEST(EmcyMessages, TheLastEightAreKept) {
  EmcyRing ring;
  EXPECT_EQ(ring.code(), 0);
  for (int i = 1; i <= 11; ++i) {
    Frame frame = test::frame("085#0031FF0102030405");
    frame.data[0] = static_cast<uint8_t>(i);
    ring.received(frame);
  }
  EXPECT_EQ(ring.count(), 11U);
  EXPECT_EQ(ring.code(), 0x310B);
  for (size_t age = 0; age < EmcyRing::kKept; ++age)
    EXPECT_EQ(ring.message(age).code, 0x3100 + 11 - age);
  EXPECT_EQ(ring.message(0).errorRegister, 0xFF);
  EXPECT_EQ(ring.message(0).detail, (std::array<uint8_t, 5>{1, 2, 3, 4, 5}));
  ring.received(test::frame("085#01"));
  ring.received(test::frame("085#"));
  EXPECT_EQ(ring.count(), 11U) << "half a code is none";
  ring.received(test::frame("085#0000"));
  EXPECT_EQ(ring.code(), 0) << "the error has gone";
  ring.clear();
  EXPECT_EQ(ring.count(), 0U);
}

TEST(EmcyMessages, EveryCodeHasAText) {
  for (uint32_t code = 0; code <= 0xFFFF; ++code)
    ASSERT_FALSE(errorText(static_cast<uint16_t>(code)).empty());
  EXPECT_NE(errorText(0x2310), errorText(0x2000));
  EXPECT_NE(errorText(0x3210), errorText(0x3220));
  EXPECT_NE(errorText(0x8611).find("following error"), std::string_view::npos);
  EXPECT_TRUE(isCommunicationWarning(0x8110));
  EXPECT_TRUE(isCommunicationWarning(0x8150));
  EXPECT_TRUE(isCommunicationWarning(0x8210));
  EXPECT_FALSE(isCommunicationWarning(0x8151));
  EXPECT_FALSE(isCommunicationWarning(0x810F));
  EXPECT_FALSE(isCommunicationWarning(0x8611));
}

Pdo pdo(const std::vector<PdoEntry> &entries) {
  Pdo result;
  result.cobId = 0x285;
  for (const PdoEntry &entry : entries)
    result.entries[result.count++] = entry;
  return result;
}

TEST(PdoCode, LeastByteFirst) {
  const Pdo one = pdo({{{0x6040, 0}, 16}, {{0x6060, 0}, 8}, {{0x607A, 0}, 32}});
  Signals signals;
  signals.set(Signal::Controlword, 0x120F);
  signals.setNumber(Signal::Mode, -1);
  signals.setNumber(Signal::TargetPosition, -2);
  EXPECT_EQ(test::text(encode(one, signals)), "285#0F12FFFEFFFFFF");
}

TEST(PdoCode, ReadsSignsAndSkipsWhatItDoesNotKnow) {
  const Pdo one = pdo({{{0x6041, 0}, 16}, {{0x2001, 0}, 8}, {{0x6077, 0}, 16}, {{0x6061, 0}, 8}});
  Signals signals;
  ASSERT_TRUE(decode(one, test::frame("285#37 16 55 FE FF 08"), signals));
  EXPECT_EQ(signals.get(Signal::Statusword), 0x1637U);
  EXPECT_EQ(signals.number(Signal::Torque), -2);
  EXPECT_EQ(signals.number(Signal::ModeDisplay), 8);
  EXPECT_EQ(signals.get(Signal::Other), 0U);
  for (const char *other : {"285#", "285#3716", "285#37 16 55 FE FF", "285#00 00 00 00 00 00 00"}) {
    EXPECT_FALSE(decode(one, test::frame(other), signals));
    EXPECT_EQ(signals.get(Signal::Statusword), 0x1637U) << "nothing is taken of it";
  }
}

TEST(PdoCode, ThereAndBackAgain) {
  std::mt19937 random(5);
  for (int run = 0; run < 20000; ++run) {
    std::vector<PdoEntry> entries;
    uint32_t bits = 0;
    Signals sent;
    std::vector<Signal> used;
    for (size_t i = 0; i < 6; ++i) {
      const SignalObject &row = kSignalObjects[random() % kSignalObjects.size()];
      if (bits + row.bits > 64 || std::find(used.begin(), used.end(), row.signal) != used.end())
        continue;
      bits += row.bits;
      entries.push_back({row.object, row.bits});
      used.push_back(row.signal);
      int32_t value = static_cast<int32_t>(random());
      if (row.bits == 16)
        value = row.isSigned ? static_cast<int16_t>(value) : static_cast<uint16_t>(value);
      if (row.bits == 8)
        value = static_cast<int8_t>(value);
      sent.setNumber(row.signal, value);
    }
    const Pdo one = pdo(entries);
    Signals received;
    ASSERT_TRUE(decode(one, encode(one, sent), received));
    for (const Signal signal : used) // set values are the master's, whatever a drive shows
      ASSERT_EQ(received.number(signal), signal < Signal::Statusword ? 0 : sent.number(signal));
  }
}

// A PDO whose entries are longer than a frame, and signals longer than numbers.
TEST(PdoCode, NonsenseInAPlanHurtsNobody) {
  const Pdo one = pdo({{{0x6064, 0}, 64}, {{0x6041, 0}, 16}, {{0x606C, 0}, 0}});
  Signals signals;
  signals.set(Signal::Statusword, 7);
  EXPECT_FALSE(decode(one, test::frame("285#1122334455667788"), signals));
  Frame frame = encode(one, signals);
  EXPECT_EQ(frame.data[0], 0);
}

TEST(Texts, OfNumbersAndObjects) {
  EXPECT_EQ(std::string_view(HexText(0)), "16#0");
  EXPECT_EQ(std::string_view(HexText(0x60640020)), "16#60640020");
  EXPECT_EQ(std::string_view(HexText(0x12, 8)), "16#00000012");
  EXPECT_EQ(std::string_view(HexText(0xABCDEF12, 1)), "16#ABCDEF12");
  EXPECT_EQ(std::string_view(ObjectText({0x1018, 2})), "16#1018:2");
  EXPECT_EQ(std::string_view(ObjectText({0xFFFF, 255})), "16#FFFF:255");
}

} // namespace
} // namespace stride::can
