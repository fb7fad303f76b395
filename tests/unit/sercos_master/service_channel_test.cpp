#include "drivers/sercos/master/parameter_transfer.hpp"
#include "drivers/sercos/master/service_channel.hpp"

#include "tests/unit/sercos_master/scripted_ring.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace stride::sercos::test {
namespace {

class ServiceChannelTest : public testing::Test {
protected:
  /// Telegrams until the transfer has ended.
  int run(int most = 200) {
    for (int i = 1; i <= most; ++i) {
      drive.receive(words({channel.control(), channel.info()}));
      const DriveTelegram telegram = drive.telegram();
      char line[16];
      std::snprintf(line, sizeof line, "%04X %04X", channel.control(), channel.info());
      trace.emplace_back(line);
      channel.received(wordAt(telegram.bytes(), 0), wordAt(telegram.bytes(), 2));
      if (channel.state() != ServiceChannel::State::Busy)
        return i;
    }
    return -1;
  }
  Bytes got() const { return {channel.bytes().begin(), channel.bytes().end()}; }

  ScriptedDrive drive{7};
  ServiceChannel channel{10};
  std::vector<std::string> trace;
};

TEST_F(ServiceChannelTest, NumberTakesItsIdnItsAttributeAndItsWords) {
  drive.blocks[47] = block4(0xFFFF1234);
  ASSERT_TRUE(channel.read(47, Element::Data));
  EXPECT_FALSE(channel.read(51, Element::Data)); // one at a time
  EXPECT_EQ(run(), 5);
  EXPECT_EQ(channel.state(), ServiceChannel::State::Done);
  EXPECT_EQ(channel.number(), -60876);
  // Element << 3, end 4, write 2, MHS 1 turning; the low word first.
  EXPECT_EQ(trace, (std::vector<std::string>{"000F 002F", "0018 0000", "001D 0000", "0038 0000",
                                             "003D 0000"}));
  ASSERT_TRUE(channel.read(47, Element::Data)); // still open, and its attribute is known
  EXPECT_EQ(run(), 2);
}

TEST_F(ServiceChannelTest, UnsignedIsNotSigned) {
  drive.blocks[15] = block2(0x8001);
  channel.read(15, Element::Data);
  EXPECT_EQ(run(), 4);
  EXPECT_EQ(channel.number(), 0x8001);
}

TEST_F(ServiceChannelTest, ListsAndTextsBeginWithTheirLengths) {
  drive.blocks[95].data = {'o', 'p', 'e', 'n', '!'};
  channel.read(95, Element::Data);
  EXPECT_EQ(run(), 3 + 2 + 3);
  EXPECT_EQ(got(), (Bytes{'o', 'p', 'e', 'n', '!'}));
  drive.blocks[95].name = "Diagnosis";
  channel.read(95, Element::Name);
  EXPECT_EQ(run(), 2 + 5);
  EXPECT_EQ(got().size(), 9U);
  drive.blocks[16].data = {};
  channel.read(16, Element::Data);
  EXPECT_EQ(run(), 3 + 2);
  EXPECT_TRUE(got().empty());
}

TEST_F(ServiceChannelTest, Writes) {
  const Bytes two = word(4711);
  channel.write(15, two);
  EXPECT_EQ(run(), 4);
  EXPECT_EQ(channel.state(), ServiceChannel::State::Done);
  const Bytes list = words({51, 40, 84});
  channel.write(16, list);
  run();
  EXPECT_EQ(drive.written, (std::vector<std::string>{"S15=4711", "S16=51,40,84"}));
  const Bytes odd = {'a', 'b', 'c'};
  channel.write(95, odd);
  run();
  EXPECT_EQ(drive.blocks[95].data, odd);
  channel.write(16, {});
  run();
  EXPECT_TRUE(drive.blocks[16].data.empty());
}

/// Bytes that tell whether one of them is at another place.
Bytes pattern(size_t count) {
  Bytes bytes(count);
  for (size_t i = 0; i < count; ++i)
    bytes[i] = static_cast<uint8_t>(i * 7 + i / 251);
  return bytes;
}

TEST_F(ServiceChannelTest, ListsAreAsLongAsTheirLengthWordsCanSay) {
  for (const size_t size : {1024U, 1025U, 1026U, 16384U, 65530U, 65531U, 65532U}) {
    const Bytes bytes = pattern(size);
    ASSERT_TRUE(channel.write(95, bytes)) << size;
    ASSERT_GT(run(40000), 0) << size;
    ASSERT_EQ(channel.state(), ServiceChannel::State::Done) << size;
    EXPECT_EQ(drive.blocks[95].data, bytes) << size;
    channel.release();
    ASSERT_TRUE(channel.read(95, Element::Data));
    // Its attribute is known: two lengths, and a word for two bytes.
    EXPECT_EQ(run(40000), static_cast<int>(2 + (size + 1) / 2));
    EXPECT_EQ(got(), bytes) << size;
    channel.release();
  }
  EXPECT_FALSE(channel.write(95, pattern(65533)));
  EXPECT_FALSE(channel.write(95, pattern(65536)));
}

TEST_F(ServiceChannelTest, AListThatSaysMoreThanThereCanBe) {
  drive.blocks[95].data = pattern(65534);
  ASSERT_TRUE(channel.read(95, Element::Data));
  EXPECT_EQ(run(), 3 + 2);
  EXPECT_EQ(channel.state(), ServiceChannel::State::Failed);
  EXPECT_EQ(channel.error(), 0);
  EXPECT_FALSE(channel.timedOut());
  drive.blocks[95].data = pattern(5); // and the next one is none the worse for it
  ASSERT_TRUE(channel.read(95, Element::Data));
  EXPECT_GT(run(), 0);
  EXPECT_EQ(got(), pattern(5));
}

/// A list by questions for four bytes each, as the blocks of SercosDrive ask them.
class ListInPieces : public ServiceChannelTest {
protected:
  bus::ParameterAnswer ask(bus::ParameterRequest::Kind kind, size_t piece, uint32_t raw = 0) {
    bus::ParameterRequest request;
    request.kind = kind;
    request.form = bus::ParameterForm::Raw;
    request.number = static_cast<int32_t>(95U | static_cast<uint32_t>(piece) << 19U);
    request.raw = raw;
    transfer.start(request);
    bus::ParameterAnswer answer;
    for (int i = 0; i < 5 && !transfer.poll(answer); ++i) {
      if (transfer.wants())
        transfer.begin(channel);
      EXPECT_GT(run(40000), 0);
      transfer.finished(channel);
      if (channel.state() != ServiceChannel::State::Busy)
        channel.release();
    }
    return answer;
  }
  bus::ParameterAnswer::Result write(const Bytes &bytes) {
    for (size_t at = 0; at < bytes.size(); at += 4) {
      uint32_t word = 0;
      for (size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
        word |= uint32_t{bytes[at + i]} << 8 * i;
      if (const auto result = ask(bus::ParameterRequest::Kind::Write, 2 + at / 4, word).result;
          result != bus::ParameterAnswer::Result::Done)
        return result;
    }
    return ask(bus::ParameterRequest::Kind::Write, 1, static_cast<uint32_t>(bytes.size())).result;
  }
  Bytes read() {
    Bytes bytes(ask(bus::ParameterRequest::Kind::Read, 1).raw);
    for (size_t at = 0; at < bytes.size(); at += 4) {
      const uint32_t word = ask(bus::ParameterRequest::Kind::Read, 2 + at / 4).raw;
      for (size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
        bytes[at + i] = static_cast<uint8_t>(word >> 8 * i);
    }
    return bytes;
  }
  ParameterTransfer transfer{CyclicRecord{}};
};

TEST_F(ListInPieces, UpToTheLastPlace) {
  using Result = bus::ParameterAnswer::Result;
  for (const size_t size : {1024U, 1027U, 4096U, 16372U, 16375U, 16376U}) {
    ASSERT_EQ(write(pattern(size)), Result::Done) << size;
    EXPECT_EQ(drive.blocks[95].data, pattern(size)) << size;
    EXPECT_EQ(read(), pattern(size)) << size;
  }
  // One more does not fit: nothing is cut.
  ASSERT_EQ(ask(bus::ParameterRequest::Kind::Write, 2, 5).result, Result::Done);
  EXPECT_EQ(ask(bus::ParameterRequest::Kind::Write, 1, 16377).result, Result::Refused);
  drive.blocks[95].data = pattern(16377);
  EXPECT_EQ(ask(bus::ParameterRequest::Kind::Read, 1).result, Result::Failed);
  EXPECT_EQ(drive.blocks[95].data.size(), 16377U);
}

TEST_F(ServiceChannelTest, WhatHasAnotherLengthIsNotSent) {
  channel.write(15, dword(1));
  run();
  EXPECT_EQ(channel.error(), 0x7003);
  channel.write(47, word(1));
  run();
  EXPECT_EQ(channel.error(), 0x7002);
  EXPECT_TRUE(drive.written.empty());
}

TEST_F(ServiceChannelTest, TellsWhyItIsRefused) {
  channel.read(999, Element::Data);
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(channel.state(), ServiceChannel::State::Failed);
  EXPECT_EQ(channel.error(), 0x1001);
  EXPECT_FALSE(channel.timedOut());
  drive.blocks[15].refusal = 0x7005;
  channel.write(15, word(1));
  EXPECT_EQ(run(), 4);
  EXPECT_EQ(channel.error(), 0x7005);
  drive.blocks[15].refusal = 0; // it begins anew
  channel.write(15, word(2));
  EXPECT_EQ(run(), 4);
  EXPECT_EQ(channel.state(), ServiceChannel::State::Done);
}

TEST_F(ServiceChannelTest, WaitsWhileTheDriveIsBusy) {
  drive.busy = 9;
  channel.read(15, Element::Data);
  EXPECT_EQ(run(), 4 * 10);
  EXPECT_EQ(channel.state(), ServiceChannel::State::Done);
  drive.busy = 10;
  channel.read(44, Element::Data);
  EXPECT_EQ(run(), 10);
  EXPECT_TRUE(channel.timedOut());
  EXPECT_EQ(channel.error(), 0);
  drive.busy = 0; // the step that is late ends before the next one begins
  channel.read(44, Element::Data);
  EXPECT_GT(run(), 0);
  EXPECT_EQ(channel.state(), ServiceChannel::State::Done);
}

TEST_F(ServiceChannelTest, NobodyAnswers) {
  drive.mute = true;
  channel.read(15, Element::Data);
  EXPECT_EQ(run(), 10);
  EXPECT_TRUE(channel.timedOut());
}

TEST_F(ServiceChannelTest, WhatIsGivenUpDoesNotAnswerTheNextQuestion) {
  drive.busy = 3;
  drive.blocks[47] = block4(5);
  drive.blocks[51] = block4(6);
  channel.read(47, Element::Data);
  EXPECT_EQ(run(2), -1);
  channel.cancel();
  ASSERT_TRUE(channel.read(51, Element::Data));
  EXPECT_GT(run(), 0);
  EXPECT_EQ(channel.number(), 6);
}

} // namespace
} // namespace stride::sercos::test
