// A master's port of a simulated bus.
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_SIMULATED_PORT_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_SIMULATED_PORT_HPP

#include "drivers/can/port/port.hpp"
#include "drivers/can/simulation/simulated_bus.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stride::can::simulation {

/// A queue of frames with a fixed number of places.
template <class Item> class Queue {
public:
  explicit Queue(size_t places) : items_(places) {}

  [[nodiscard]] size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const Item &front() const { return items_[first_]; }
  bool push(const Item &item) {
    if (size_ == items_.size())
      return false;
    items_[(first_ + size_) % items_.size()] = item;
    ++size_;
    return true;
  }
  void pop() {
    first_ = (first_ + 1) % items_.size();
    --size_;
  }
  void clear() { first_ = size_ = 0; }

private:
  std::vector<Item> items_;
  size_t first_ = 0;
  size_t size_ = 0;
};

/// Frames of the class Process overtake the others in the queue, but not the one that is in the
/// mailbox of the controller.
class SimulatedPort final : public Port {
public:
  SimulatedPort(SimulatedBus &bus, Station station, const BusSetup &setup)
      : bus_(bus), station_(station), setup_(setup), process_(setup.sendQueue),
        service_(setup.sendQueue), received_(setup.receiveQueue) {}

  void beginCycle() noexcept override;
  SendResult send(const Frame &frame, SendClass sendClass) noexcept override;
  size_t receive(std::span<Received> frames) noexcept override;
  [[nodiscard]] ControllerState state() const noexcept override { return bus_.state(station_); }
  [[nodiscard]] std::string_view problem() const noexcept override {
    return state() == ControllerState::Down ? "the simulated interface is down" : "";
  }
  [[nodiscard]] PortCounters counters() const noexcept override { return counters_; }

private:
  friend class SimulatedBus;

  struct Waiting {
    Frame frame;
    int64_t readyNs = 0;
  };

  /// The next frame for the mailbox. FALSE: there is none.
  bool next(Waiting &waiting) noexcept;
  void forget() noexcept;

  SimulatedBus &bus_;
  Station station_;
  BusSetup setup_;
  Queue<Waiting> process_;
  Queue<Waiting> service_;
  Queue<Received> received_;
  PortCounters counters_;
  int64_t timeNs_ = 0;
  bool programRuns_ = false; ///< It has taken what had come.
};

} // namespace stride::can::simulation

#endif
