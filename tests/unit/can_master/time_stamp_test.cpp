// The time of day on the bus (100h).
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock-more-matchers.h>

namespace stride::can {
namespace {

class TimeOf : public test::CanBusTest {
protected:
  void begin(double period) {
    addDrive(5);
    if (period > 0)
      setup.busParameters.add({"time_stamp", "", period});
    make();
  }
  /// The time stamps of so many cycles, with the cycle before each.
  std::vector<std::string> stamps(int count) {
    std::vector<std::string> result;
    for (int i = 0; i < count; ++i) {
      cycle();
      for (const std::string &frame : port->takeSent())
        if (frame.starts_with("100#"))
          result.push_back(std::to_string(i) + " " + frame);
    }
    return result;
  }
};

TEST_F(TimeOf, WithoutAPeriodThereIsNone) {
  begin(0);
  EXPECT_THAT(stamps(50), ::testing::IsEmpty());
}

TEST_F(TimeOf, ABusWithoutAClockBeginsIn1984) {
  begin(0.005);
  EXPECT_THAT(stamps(11), ::testing::ElementsAre("0 100#000000000000", "5 100#050000000000",
                                                 "10 100#0A0000000000"));
}

TEST_F(TimeOf, ItIsTheSystemsInMillisecondsOfTheDayAndDays) {
  begin(0.003);
  // 2024-02-29 23:59:59.999: day 14669 of TIME_OF_DAY, 86399999 ms.
  port->utc = 1709251199'999'000'000;
  EXPECT_THAT(stamps(1), ::testing::ElementsAre("0 100#FF5B26054D39"));
  port->utc = 1709251200'000'000'000;
  EXPECT_THAT(stamps(3), ::testing::ElementsAre("2 100#000000004E39"));
}

TEST_F(TimeOf, ItIsTriedAgainWhenTheQueueIsFull) {
  begin(0.010);
  port->result = SendResult::QueueFull;
  cycles(2);
  port->result = SendResult::Sent;
  EXPECT_THAT(stamps(3), ::testing::ElementsAre("0 100#020000000000"));
}

} // namespace
} // namespace stride::can
