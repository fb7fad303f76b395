// Any bytes as frames for simulated nodes, with times between them: nothing crashes, time goes on,
// and a drive gets power by no other way than that of the profile.
#include "drivers/can/simulation/drive402.hpp"
#include "drivers/can/simulation/io401.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace {

using namespace stride::can;

void runUntil(simulation::Node &node, int64_t timeNs) {
  for (int rounds = 0; node.nextNs() <= timeNs; ++rounds) {
    node.advance(node.nextNs());
    if (rounds > 100'000)
      std::abort();
  }
  Frame frame;
  for (int i = 0; i < 300 && node.transmit(frame); ++i)
    if (frame.length > Frame::kMostBytes || frame.id > Frame::kLastId)
      std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  simulation::Drive402Setup setup;
  setup.node.id = 5;
  setup.node.bootNs = 1000;
  setup.drive.mechanics.cycle = 0.001;
  setup.drive.switchCycles = 1;
  simulation::SimulatedDrive402 drive(setup);
  simulation::SimulatedIo401 io({.node = {.id = 5, .bootNs = 1000}, .analogInputs = 2});
  drive.powerOn(0);
  io.powerOn(0);
  int64_t now = 2000;
  constexpr size_t kFrame = 11; // time, identifier with length, bytes
  simulation::PowerState before = drive.power();
  for (; size >= kFrame; data += kFrame, size -= kFrame) {
    now += data[0] * int64_t{100'000};
    Frame frame;
    frame.id = static_cast<uint16_t>((data[1] | data[2] << 8U) & Frame::kLastId);
    frame.length = static_cast<uint8_t>((data[2] >> 3U & 15U) % 9U);
    frame.remote = (data[2] & 0x80U) != 0;
    for (size_t i = 0; i < frame.length; ++i)
      frame.data[i] = data[3 + i];
    runUntil(drive, now);
    runUntil(io, now);
    drive.receive(frame, now);
    io.receive(frame, now);
    using simulation::PowerState;
    const PowerState state = drive.power();
    if (state == PowerState::OperationEnabled && before != state &&
        before != PowerState::SwitchedOn && before != PowerState::QuickStopActive)
      std::abort();
    before = state;
    runUntil(drive, now);
    runUntil(io, now);
    before = drive.power();
  }
  return 0;
}
