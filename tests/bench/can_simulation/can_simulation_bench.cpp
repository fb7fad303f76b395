// What a cycle of a simulated CAN bus costs, with its drives in cyclic position mode.
#include "drivers/can/simulation/drive402.hpp"
#include "drivers/can/simulation/simulated_bus.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <memory>
#include <vector>

namespace {

using namespace stride::can;

Frame frameOf(uint16_t id, std::initializer_list<unsigned> bytes) {
  Frame frame;
  frame.id = id;
  for (const unsigned byte : bytes)
    frame.data[frame.length++] = static_cast<uint8_t>(byte);
  return frame;
}

/// 4 drives and less at 1 ms, 64 at 16 ms: the bus is equally full.
void cycle(benchmark::State &state) {
  const auto drives = static_cast<uint8_t>(state.range(0));
  simulation::BusSetup setup;
  setup.cycleNs = drives <= 4 ? 1'000'000 : drives * int64_t{250'000};
  setup.sendQueue = 200;
  simulation::SimulatedBus bus(setup);
  Port &port = bus.port(bus.addPort());
  std::vector<std::unique_ptr<simulation::SimulatedDrive402>> all;
  for (uint8_t id = 1; id <= drives; ++id) {
    simulation::Drive402Setup drive;
    drive.node.id = id;
    drive.drive.mechanics.cycle = static_cast<double>(setup.cycleNs) / 1e9;
    drive.drive.switchCycles = 1;
    all.push_back(std::make_unique<simulation::SimulatedDrive402>(drive));
    bus.attach(*all.back());
  }
  bus.runUntil(30'000'000);
  for (auto &drive : all) {
    for (const auto &[index, value] : {std::pair<uint16_t, uint32_t>{0x1400, 0x200U + drive->id()},
                                       {0x1800, 0x40000180U + drive->id()}}) {
      drive->write(index, 1, value | 0x80000000U);
      const auto mapping = static_cast<uint16_t>(index + 0x200);
      drive->write(mapping, 0, 0);
      drive->write(mapping, 1, index == 0x1400 ? 0x60400010 : 0x60410010);
      drive->write(mapping, 2, index == 0x1400 ? 0x607A0020 : 0x60640020);
      drive->write(mapping, 0, 2);
      drive->write(index, 2, 1);
      drive->write(index, 1, value);
    }
    drive->write(0x60C2, 1, static_cast<uint64_t>(setup.cycleNs / 1'000'000));
    drive->write(0x6060, 0, 8);
  }
  port.send(frameOf(0, {1, 0}), SendClass::Service);
  std::array<Received, 256> received;
  uint64_t frames = 0;
  unsigned count = 0;
  for (auto unused : state) {
    (void)unused;
    port.beginCycle();
    port.send(frameOf(0x80, {}), SendClass::Process);
    benchmark::DoNotOptimize(port.receive(received));
    ++count;
    const unsigned word = count < 5 ? 6 : count < 10 ? 7 : 15;
    for (uint8_t id = 1; id <= drives; ++id)
      port.send(frameOf(static_cast<uint16_t>(0x200 + id),
                        {word, 0, count & 0xFFU, count >> 8U & 0xFFU, 0, 0}),
                SendClass::Process);
  }
  frames = bus.counters().frames;
  state.counters["frames/s"] =
      benchmark::Counter(static_cast<double>(frames), benchmark::Counter::kIsRate);
}
BENCHMARK(cycle)->Arg(1)->Arg(4)->Arg(8)->Arg(32)->Arg(64)->Unit(benchmark::kMicrosecond);

} // namespace
