// Stations without a protocol, for tests of a simulated bus.
#ifndef STRIDE_TESTS_UNIT_CAN_SIMULATION_BUS_SCENE_HPP
#define STRIDE_TESTS_UNIT_CAN_SIMULATION_BUS_SCENE_HPP

#include "drivers/can/simulation/simulated_bus.hpp"

#include <cstdint>
#include <deque>
#include <initializer_list>
#include <vector>

namespace stride::can::simulation {

inline Frame frameOf(uint16_t id, std::initializer_list<unsigned> bytes = {}) {
  Frame frame;
  frame.id = id;
  for (const unsigned byte : bytes)
    frame.data[frame.length++] = static_cast<uint8_t>(byte);
  return frame;
}

/// Sends what a test says, when it says so, and keeps what it hears.
class Puppet : public Node {
public:
  struct Order {
    int64_t timeNs;
    Frame frame;
  };

  void powerOn(int64_t /*nowNs*/) noexcept override {}
  bool receive(const Frame &frame, int64_t nowNs) noexcept override {
    heard.push_back({frame, nowNs});
    return true;
  }
  void advance(int64_t nowNs) noexcept override {
    while (!orders.empty() && orders.front().timeNs <= nowNs) {
      ready.push_back(orders.front().frame);
      orders.pop_front();
    }
  }
  [[nodiscard]] int64_t nextNs() const noexcept override {
    return orders.empty() ? kNever : orders.front().timeNs;
  }
  bool transmit(Frame &frame) noexcept override {
    if (ready.empty())
      return false;
    frame = ready.front();
    ready.pop_front();
    return true;
  }
  void recovered(int64_t /*nowNs*/) noexcept override { ++recoveries; }

  std::deque<Order> orders;
  std::deque<Frame> ready;
  std::vector<Received> heard;
  int recoveries = 0;
};

inline std::vector<Received> takeAll(Port &port) {
  std::vector<Received> all(1000);
  all.resize(port.receive(all));
  return all;
}

} // namespace stride::can::simulation

#endif
