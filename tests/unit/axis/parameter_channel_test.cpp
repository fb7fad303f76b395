#include "runtime/axis/parameter_channel.hpp"

#include "tests/unit/axis/axis_rig.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace {

namespace axis = stride::axis;
namespace bus = stride::bus;
using axis::Asked;
using axis::ChannelKind;
using axis::ChannelResult;
using axis::ChannelStep;

/// A drive that takes questions and answers them when the test says so.
class SlowDriver final : public bus::AxisDriver {
public:
  void executeStart() override {}
  void executeEnd() override {}
  bus::StartUp init(size_t, uint16_t &, bus::Message &) override { return bus::StartUp::Started; }
  void reset(size_t) override {}
  bus::DriveStatus status(size_t) const override {
    bus::DriveStatus status;
    status.communication = true;
    return status;
  }
  void command(size_t, const bus::DriveCommand &) override {}
  uint8_t controllerModes(size_t) const override { return 1U << 3; }
  bool startParameter(size_t, const bus::ParameterRequest &request) override {
    if (busy)
      return false;
    asked = request;
    ++started;
    return true;
  }
  bool pollParameter(size_t, bus::ParameterAnswer &answer) override {
    if (!answers)
      return false;
    answer.value = asked.number * 1.5;
    answer.name = "a name that is much longer than the forty characters there is room for";
    return true;
  }
  void cancelParameter(size_t) override { ++cancelled; }

  bool busy = false;
  bool answers = false;
  int started = 0;
  int cancelled = 0;
  bus::ParameterRequest asked;
};

struct Channel : testing::Test {
  Channel() {
    auto own = std::make_unique<SlowDriver>();
    driver = own.get();
    group = std::make_unique<bus::DriveGroup>(std::move(own), groupRef,
                                              std::vector<axis::AxisRef *>{&ref}, 0.001);
    cycle(2);
  }
  void cycle(int count = 1) {
    for (int i = 0; i < count; ++i) {
      group->executeStart();
      group->executeEnd();
    }
  }
  uint32_t ask(int32_t number) {
    return axis::askDrive(ref, ChannelKind::Read, number, axis::ChannelForm::Number, 0.0);
  }
  ChannelResult result() const { return static_cast<ChannelResult>(ref.stChannel.byResult); }

  axis::AxisRef ref = stride::test::fresh<axis::AxisRef>();
  bus::AxisGroupRef groupRef = stride::test::fresh<bus::AxisGroupRef>();
  SlowDriver *driver = nullptr;
  std::unique_ptr<bus::DriveGroup> group;
};

TEST_F(Channel, AsksForWhatItCanCarryOnly) {
  ASSERT_NE(ask(4), 0U);
  cycle();
  EXPECT_EQ(driver->asked.form, bus::ParameterForm::Number);
  EXPECT_EQ(driver->asked.forms,
            bus::formBit(bus::ParameterForm::Number) | bus::formBit(bus::ParameterForm::Bool))
      << "neither raw bits nor bytes";
}

TEST(ByteString, KeepsAsManyBytesAsItHasRoomFor) {
  using bus::ByteString;
  for (const size_t size :
       {size_t{0}, ByteString::kMost - 1, ByteString::kMost, ByteString::kMost + 1, size_t{1000}}) {
    std::string text;
    for (size_t i = 0; i < size; ++i)
      text += static_cast<char>(i % 251); // zeros, too
    const ByteString bytes{std::string_view(text)};
    EXPECT_EQ(bytes.size(), std::min(size, ByteString::kMost));
    EXPECT_EQ(bytes.text(), text.substr(0, ByteString::kMost));
    EXPECT_EQ(bytes == ByteString{std::string_view(text).substr(0, bytes.size() / 2)}, size == 0);
  }
}

TEST_F(Channel, AnswersOneQuestionAtATime) {
  driver->answers = true;
  uint32_t claim = ask(4);
  ASSERT_NE(claim, 0U);
  EXPECT_EQ(ask(5), 0U) << "occupied";
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Waiting);
  cycle();
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Answered);
  EXPECT_EQ(ref.stChannel.fValue, 6.0);
  EXPECT_EQ(result(), ChannelResult::Done);
  cycle(5);
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Answered) << "it stays";
  EXPECT_EQ(ask(5), 0U) << "still occupied";
  axis::leaveDrive(ref, claim);
  EXPECT_EQ(claim, 0U);
  EXPECT_NE(ask(5), 0U);
}

TEST_F(Channel, WaitsForADriverThatIsBusy) {
  driver->busy = true;
  driver->answers = true;
  const uint32_t claim = ask(4);
  cycle(100);
  EXPECT_EQ(driver->started, 0);
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Waiting);
  driver->busy = false;
  cycle();
  EXPECT_EQ(driver->started, 1);
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Answered);
}

TEST_F(Channel, GivesUpAfterAThousandCycles) {
  const uint32_t claim = ask(4);
  cycle(1000);
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Waiting);
  cycle(2);
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Answered);
  EXPECT_EQ(result(), ChannelResult::Late);
  EXPECT_EQ(driver->cancelled, 1);
}

TEST_F(Channel, GivesUpOnADriverThatStaysBusy) {
  driver->busy = true;
  const uint32_t claim = ask(4);
  cycle(1001);
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Answered);
  EXPECT_EQ(result(), ChannelResult::Late);
  EXPECT_EQ(driver->cancelled, 0);
}

TEST_F(Channel, AnAnswerThatNobodyFetchesIsDropped) {
  driver->answers = true;
  const uint32_t claim = ask(4);
  cycle(1000);
  EXPECT_EQ(ask(5), 0U);
  cycle(3);
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Lost);
  EXPECT_NE(ask(5), 0U);
}

TEST_F(Channel, AnAbandonedQuestionFreesTheWay) {
  uint32_t claim = ask(4);
  cycle(3);
  axis::leaveDrive(ref, claim);
  EXPECT_EQ(ask(5), 0U) << "the driver is still at it";
  driver->answers = true;
  cycle();
  EXPECT_NE(ask(5), 0U);
  EXPECT_EQ(driver->started, 1);
}

TEST_F(Channel, AQuestionAbandonedBeforeItWasAskedIsNot) {
  uint32_t claim = ask(4);
  axis::leaveDrive(ref, claim);
  cycle();
  EXPECT_EQ(driver->started, 0);
  EXPECT_NE(ask(5), 0U);
}

TEST_F(Channel, LeavingWhatIsNotOnesOwnDoesNothing) {
  uint32_t none = 0;
  axis::leaveDrive(ref, none);
  const uint32_t claim = ask(4);
  uint32_t other = claim + 1;
  axis::leaveDrive(ref, other);
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Waiting);
  EXPECT_EQ(axis::pollDrive(ref, claim + 1), Asked::Lost);
}

TEST_F(Channel, AResetOfTheGroupAnswersWithAnError) {
  const uint32_t claim = ask(4);
  cycle(2);
  ++groupRef.udiResetsAsked;
  cycle(6);
  EXPECT_EQ(axis::pollDrive(ref, claim), Asked::Answered);
  EXPECT_EQ(result(), ChannelResult::Failed);
  EXPECT_EQ(driver->cancelled, 1);
}

TEST_F(Channel, TextsThatAreTooLongAreCut) {
  driver->answers = true;
  const uint32_t claim =
      axis::askDrive(ref, ChannelKind::Describe, 0, axis::ChannelForm::Number, 0.0);
  cycle();
  ASSERT_EQ(axis::pollDrive(ref, claim), Asked::Answered);
  EXPECT_STREQ(ref.stChannel.sName.s, "a name that is much longer than the fort");
}

TEST_F(Channel, ClaimNumbersWrapWithoutZero) {
  ref.stChannel.udiClaims = 0xFFFFFFFF;
  EXPECT_EQ(ask(4), 1U);
}

TEST_F(Channel, ADriverWithoutParametersKnowsNone) {
  stride::bus::ParameterAnswer answer;
  EXPECT_TRUE(driver->bus::AxisDriver::startParameter(0, {}));
  EXPECT_TRUE(driver->bus::AxisDriver::pollParameter(0, answer));
  EXPECT_EQ(answer.result, bus::ParameterAnswer::Result::Unknown);
}

/// Two threads ask, a third one is the group: everybody gets the answer to his own question.
TEST_F(Channel, ThreadsDoNotMixUpTheirAnswers) {
  driver->answers = true;
  std::atomic<int> finished{0};
  std::atomic<int> wrong{0};
  const auto asker = [&](int32_t first) {
    for (int i = 0; i < 3000; ++i) {
      const int32_t number = first + i;
      uint32_t claim = 0;
      while ((claim = ask(number)) == 0)
        std::this_thread::yield();
      while (axis::pollDrive(ref, claim) == Asked::Waiting)
        std::this_thread::yield();
      if (axis::pollDrive(ref, claim) != Asked::Answered || ref.stChannel.fValue != number * 1.5)
        ++wrong;
      axis::leaveDrive(ref, claim);
    }
    ++finished;
  };
  std::thread a(asker, 1);
  std::thread b(asker, 100000);
  while (finished < 2) {
    if (axis::channelStep(ref.stChannel) != ChannelStep::Answered) // an answer gets old by cycles
      cycle();
    std::this_thread::yield();
  }
  a.join();
  b.join();
  EXPECT_EQ(wrong, 0);
}

} // namespace
