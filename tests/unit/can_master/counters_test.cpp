// What programs see of a bus: SMC_CAN_COUNTERS.
#include "tests/unit/can_master/can_bus.hpp"

#include "st/SM_CAN/SMC_CAN_COUNTERS.h"

namespace stride::can {
namespace {

using Counters = ::st::SM_CAN::SMC_CAN_COUNTERS;

class CountersOf : public test::CanBusTest {
protected:
  CountersOf() {
    addDrive(5);
    make();
  }
  Counters shown{};
};

TEST_F(CountersOf, AnotherLayoutIsLeftAlone) {
  EXPECT_FALSE(driver->bindGroupData(&shown, ::st::SM_CAN::SMC_CAN_COUNTERS__layout__ + 1));
  cycles(10);
  EXPECT_EQ(shown.udiFramesSent, 0U);
}

TEST_F(CountersOf, TheyFollowTheBusCycleByCycle) {
  ASSERT_TRUE(driver->bindGroupData(&shown, ::st::SM_CAN::SMC_CAN_COUNTERS__layout__));
  ASSERT_NO_FATAL_FAILURE(start());
  const uint32_t before = shown.udiFramesSent;
  const uint32_t received = shown.udiFramesReceived;
  heartbeats = false;
  cycles(7); // SYNC and an RPDO, answered by a TPDO
  EXPECT_GE(shown.udiFramesSent - before, 13U);
  EXPECT_GE(shown.udiFramesReceived - received, 6U);
  EXPECT_EQ(shown.byBusState, 0);

  port->give("080#");
  cycle();
  EXPECT_EQ(shown.udiForeignSyncs, 1U);

  port->late = 2;
  cycles(3);
  port->late = 0;
  cycle();
  EXPECT_EQ(shown.udiSetValuesLate, 3U);

  port->portCounters = {.dropped = 11, .errorFrames = 4'294'967'299U, .restarts = 2, .unlogged = 1};
  port->controller = ControllerState::Passive;
  cycle();
  EXPECT_EQ(shown.udiFramesLost, 11U);
  EXPECT_EQ(shown.udiErrorFrames, 3U) << "wraps";
  EXPECT_EQ(shown.udiRestarts, 2U);
  EXPECT_EQ(shown.byBusState, 2);

  port->result = SendResult::QueueFull;
  cycle();
  const uint32_t full = shown.udiSendQueueFull;
  EXPECT_GE(full, 1U);
  port->result = SendResult::Sent;
  port->controller = ControllerState::BusOff;
  cycle();
  EXPECT_EQ(shown.byBusState, 3);
  port->controller = ControllerState::Down;
  cycle();
  EXPECT_EQ(shown.byBusState, 4);
}

TEST_F(CountersOf, TheApplicationMayMove) {
  ASSERT_TRUE(driver->bindGroupData(&shown, ::st::SM_CAN::SMC_CAN_COUNTERS__layout__));
  cycles(3);
  Counters moved = shown;
  ASSERT_TRUE(driver->bindGroupData(&moved, ::st::SM_CAN::SMC_CAN_COUNTERS__layout__));
  const uint32_t before = shown.udiFramesSent;
  cycles(3);
  EXPECT_EQ(shown.udiFramesSent, before);
  EXPECT_GT(moved.udiFramesSent, before);
}

} // namespace
} // namespace stride::can
