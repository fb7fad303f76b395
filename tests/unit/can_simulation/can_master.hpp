// A person with a CAN adapter: writes frames by hand, from the standards, and looks at what comes.
#ifndef STRIDE_TESTS_UNIT_CAN_SIMULATION_CAN_MASTER_HPP
#define STRIDE_TESTS_UNIT_CAN_SIMULATION_CAN_MASTER_HPP

#include "tests/unit/can_simulation/bus_scene.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace stride::can::simulation {

inline uint32_t wordAt(const Frame &frame, size_t place, size_t bytes) {
  uint32_t value = 0;
  for (size_t i = bytes; i-- > 0;)
    value = value << 8U | frame.data[place + i];
  return value;
}

struct Master {
  explicit Master(const BusSetup &setup = {}) : bus(setup), station(bus.addPort()) {}

  Port &port() { return bus.port(station); }

  void send(uint16_t id, std::initializer_list<unsigned> bytes,
            SendClass sendClass = SendClass::Service) {
    port().send(frameOf(id, bytes), sendClass);
  }

  /// One cycle: what has come goes to `seen`.
  void cycle(int count = 1) {
    while (count-- > 0) {
      port().beginCycle();
      for (const Received &received : takeAll(port()))
        seen.push_back(received);
    }
  }

  /// The same, with SYNC at its beginning.
  void syncCycle(int count = 1) {
    while (count-- > 0) {
      port().beginCycle();
      port().send(frameOf(0x80), SendClass::Process);
      for (const Received &received : takeAll(port()))
        seen.push_back(received);
    }
  }

  /// The last frame with that identifier; forgets all.
  std::optional<Frame> last(uint16_t id) {
    std::optional<Frame> found;
    for (const Received &received : seen)
      if (received.frame.id == id)
        found = received.frame;
    seen.clear();
    return found;
  }

  size_t count(uint16_t id) const {
    size_t found = 0;
    for (const Received &received : seen)
      found += received.frame.id == id ? 1U : 0U;
    return found;
  }

  /// One request and its answer.
  std::optional<Frame> ask(uint8_t node, std::initializer_list<unsigned> bytes) {
    seen.clear();
    send(static_cast<uint16_t>(0x600 + node), bytes);
    cycle(2);
    return last(static_cast<uint16_t>(0x580 + node));
  }

  /// Expedited download; the abort code, 0: none, 1: no answer.
  uint32_t write(uint8_t node, uint16_t index, uint8_t sub, uint32_t value, unsigned bytes) {
    const auto answer =
        ask(node, {0x23U | (4 - bytes) << 2U, index & 0xFFU, static_cast<unsigned>(index >> 8U),
                   sub, value & 0xFFU, value >> 8U & 0xFFU, value >> 16U & 0xFFU, value >> 24U});
    if (!answer)
      return 1;
    return answer->data[0] == 0x80 ? wordAt(*answer, 4, 4) : 0;
  }

  /// Expedited upload; nothing: an abort, whose code is in `aborted`.
  std::optional<uint32_t> read(uint8_t node, uint16_t index, uint8_t sub = 0) {
    const auto answer =
        ask(node, {0x40, index & 0xFFU, static_cast<unsigned>(index >> 8U), sub, 0, 0, 0, 0});
    if (!answer || answer->data[0] == 0x80) {
      aborted = answer ? wordAt(*answer, 4, 4) : 1;
      return std::nullopt;
    }
    return wordAt(*answer, 4, 4 - (answer->data[0] >> 2U & 3U));
  }

  /// A PDO with other contents; from pre-operational. 0: it has all been taken.
  uint32_t configure(uint8_t node, bool transmit, uint8_t number, uint32_t cobId, uint8_t type,
                     std::initializer_list<uint32_t> map) {
    const auto parameters = static_cast<uint16_t>((transmit ? 0x1800 : 0x1400) + number);
    const auto mapping = static_cast<uint16_t>(parameters + 0x200);
    const uint32_t flags = transmit ? 0x40000000U : 0U;
    uint32_t code = write(node, parameters, 1, 0x80000000U | flags | cobId, 4);
    code = code == 0 ? write(node, mapping, 0, 0, 1) : code;
    uint8_t sub = 0;
    for (const uint32_t entry : map)
      code = code == 0 ? write(node, mapping, ++sub, entry, 4) : code;
    code = code == 0 ? write(node, mapping, 0, sub, 1) : code;
    code = code == 0 ? write(node, parameters, 2, type, 1) : code;
    return code == 0 ? write(node, parameters, 1, flags | cobId, 4) : code;
  }

  SimulatedBus bus;
  Station station;
  std::vector<Received> seen;
  uint32_t aborted = 0;
};

} // namespace stride::can::simulation

#endif
