// What a cycle of a CAN bus costs its master: SYNC, the actual values of all drives, the set values
// of all drives, all of which move. Without the system's share of sending and receiving.
#include "drivers/can/can_driver.hpp"
#include "drivers/can/schema.hpp"
#include "tests/unit/can_master/fake_bus.hpp"

#include <benchmark/benchmark.h>

#include <deque>
#include <memory>
#include <vector>

namespace {

namespace can = stride::can;

constexpr uint32_t kFirstTpdo = 0x180;
constexpr uint32_t kSecondTpdo = 0x280;

/// Drives that have been started, and say the same in every cycle.
class SteadyPort final : public can::Port {
public:
  void beginCycle() noexcept override {}
  can::SendResult send(const can::Frame &frame, can::SendClass) noexcept override {
    if (!steady && hear)
      hear(frame);
    ++sent;
    return can::SendResult::Sent;
  }
  size_t receive(std::span<can::Received> frames) noexcept override {
    size_t count = 0;
    if (steady) {
      for (; count < frames.size() && count < said.size(); ++count)
        frames[count].frame = said[count];
      return count;
    }
    for (; count < frames.size() && !answers.toReceive.empty(); ++count) {
      frames[count].frame = answers.toReceive.front();
      answers.toReceive.pop_front();
    }
    return count;
  }
  can::ControllerState state() const noexcept override { return can::ControllerState::Active; }
  can::PortCounters counters() const noexcept override { return {}; }

  bool steady = false;
  uint64_t sent = 0;
  std::vector<can::Frame> said;
  std::function<void(const can::Frame &)> hear;
  can::test::FakePort answers;
};

can::Frame pdo(uint32_t id, const char *bytes) {
  char text[40];
  std::snprintf(text, sizeof text, "%03X#%s", id, bytes);
  return can::test::frame(text);
}

struct Bus {
  explicit Bus(uint32_t drives) : setup(can::kSchema, 0.004), commands(drives) {
    auto owned = std::make_unique<SteadyPort>();
    port = owned.get();
    for (uint32_t id = 1; id <= drives; ++id) {
      setup.addDrive("X", id);
      nodes.emplace_back(port->answers, static_cast<uint8_t>(id));
      const can::Frame values = pdo(kFirstTpdo + id, "0011223300112233");
      nodes.back().pdosInOperation = {can::test::text(values),
                                      can::test::text(pdo(kSecondTpdo + id, "400208"))};
      port->said.push_back(values);
      port->said.push_back(pdo(kSecondTpdo + id, "270208"));
    }
    port->hear = [this](const can::Frame &frame) {
      for (can::test::ScriptedNode &node : nodes)
        node.hear(frame);
    };
    driver = std::make_unique<can::CanDriver>(setup, std::move(owned));
  }

  /// Cycles until all drives have started.
  uint32_t start() {
    uint32_t cycles = 0;
    std::vector<bool> started(commands.size());
    for (size_t count = 0; count < commands.size() && cycles < 100000; ++cycles) {
      driver->executeStart();
      for (size_t i = 0; i < commands.size(); ++i) {
        uint16_t progress = 0;
        stride::bus::Message message;
        if (!started[i] && driver->init(i, progress, message) == stride::bus::StartUp::Started) {
          started[i] = true;
          ++count;
        }
      }
      driver->executeEnd();
    }
    return cycles;
  }

  stride::bus::GroupSetup setup;
  std::vector<stride::bus::DriveCommand> commands;
  std::deque<can::test::ScriptedNode> nodes;
  SteadyPort *port = nullptr;
  std::unique_ptr<stride::bus::AxisDriver> driver;
};

void cycle(benchmark::State &state) {
  Bus bus(static_cast<uint32_t>(state.range(0)));
  const uint32_t startUp = bus.start();
  bus.port->steady = true;
  bus.port->sent = 0;
  for (auto _ : state) {
    bus.driver->executeStart();
    for (size_t i = 0; i < bus.commands.size(); ++i) {
      benchmark::DoNotOptimize(bus.driver->status(i));
      stride::bus::DriveCommand &command = bus.commands[i];
      command.regulatorOn = command.driveStart = true;
      command.position += 7;
      command.velocity = 1750;
      bus.driver->command(i, command);
    }
    bus.driver->executeEnd();
  }
  state.counters["frames sent"] =
      benchmark::Counter(static_cast<double>(bus.port->sent), benchmark::Counter::kAvgIterations);
  state.counters["cycles to start"] = static_cast<double>(startUp);
}
BENCHMARK(cycle)->Arg(1)->Arg(8)->Arg(32)->Arg(64);

} // namespace
