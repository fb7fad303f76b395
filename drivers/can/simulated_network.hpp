// The bus of a drive group with simulated drives at it, as `stride sim` has it.
#ifndef STRIDE_DRIVERS_CAN_SIMULATED_NETWORK_HPP
#define STRIDE_DRIVERS_CAN_SIMULATED_NETWORK_HPP

#include "drivers/can/plan/io_plan.hpp"
#include "drivers/can/port/port.hpp"
#include "drivers/can/simulation/drive402.hpp"
#include "drivers/can/simulation/encoder406.hpp"
#include "drivers/can/simulation/io401.hpp"
#include "drivers/can/simulation/simulated_bus.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace stride::can {

/// The nodes of a drive group, simulated.
struct SimulatedNodes {
  /// As configured; null: one that cannot be at the bus, or that is a further axis of one before.
  std::vector<std::unique_ptr<simulation::SimulatedDrive402>> drives;
  /// As configured; null: one that cannot be at the bus.
  std::vector<simulation::DriveAxis *> axes;
  /// Those that are nodes; they have to be attached after the drives.
  std::vector<std::unique_ptr<simulation::SimulatedEncoder406>> encoders;
  /// As configured; null: one that cannot be at the bus.
  std::vector<std::unique_ptr<simulation::SimulatedIo401>> ios;
  std::unique_ptr<simulation::CanopenNode> syncDevice; ///< Null: there is none.
};

SimulatedNodes simulatedNodes(const bus::GroupSetup &setup);

/// A bus with one drive for each of the group, and the SYNC device where one gives SYNC. It is the
/// master's port to that bus, and goes by its cycles.
class SimulatedNetwork final : public Port {
public:
  explicit SimulatedNetwork(const bus::GroupSetup &setup);

  /// Where the structure that a drive shares with programs is now; null: there is none.
  void bindData(size_t drive, void *data);
  [[nodiscard]] simulation::SimulatedBus &bus() { return bus_; }
  [[nodiscard]] simulation::SimulatedDrive402 &drive(size_t index) { return *nodes_.drives[index]; }
  [[nodiscard]] simulation::DriveAxis &axis(size_t index) { return *nodes_.axes[index]; }

  void beginCycle() noexcept override;
  SendResult send(const Frame &frame, SendClass sendClass) noexcept override {
    return port_.send(frame, sendClass);
  }
  size_t receive(std::span<Received> frames) noexcept override { return port_.receive(frames); }
  [[nodiscard]] ControllerState state() const noexcept override { return port_.state(); }
  [[nodiscard]] PortCounters counters() const noexcept override { return port_.counters(); }

private:
  /// An I/O device's world, which the program or its operator is.
  struct IoWorld {
    simulation::SimulatedIo401 *node = nullptr;
    std::shared_ptr<common::IoExchange> exchange;
    IoSide inputs;
    bool wired = false; ///< The node's outputs are its world.
  };

  void addWorlds(const bus::GroupSetup &setup);

  simulation::SimulatedBus bus_;
  Port &port_;
  SimulatedNodes nodes_;
  std::vector<IoWorld> worlds_;
};

} // namespace stride::can

#endif
