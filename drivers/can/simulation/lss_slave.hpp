// Layer setting services: a node gets its identifier over the bus. [CiA 305]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_LSS_SLAVE_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_LSS_SLAVE_HPP

#include "drivers/can/port/frame.hpp"

#include <array>
#include <cstdint>

namespace stride::can::simulation {

/// The identifier of a node that has none.
inline constexpr uint8_t kUnconfigured = 255;

class LssSlave {
public:
  /// Vendor, product, revision, serial number.
  using Identity = std::array<uint32_t, 4>;

  LssSlave(const Identity &identity, uint8_t id) : identity_(identity), stored_(id), next_(id) {}

  static constexpr uint16_t kRequestId = 0x7E5;
  static constexpr uint16_t kAnswerId = 0x7E4;

  /// The supply was switched on: it has what was stored for good.
  void powerOn();
  /// The communication is reset: the identifier is this one now.
  uint8_t activate();

  void receive(const Frame &frame) noexcept;
  bool transmit(Frame &frame) noexcept;
  /// A node without an identifier has been given one, and begins with it; asked once.
  bool takeStart() noexcept;

private:
  void answer(uint8_t command, uint32_t value = 0) noexcept;
  void switchState(bool configuration) noexcept;
  void select(uint8_t part, uint32_t number) noexcept;
  void identify(uint8_t part, uint32_t number) noexcept;
  void fastScan(const Frame &frame) noexcept;
  void configure(const Frame &frame) noexcept;

  Identity identity_;
  uint8_t stored_;
  uint8_t next_; ///< After the next reset.
  uint8_t active_ = kUnconfigured;
  bool configuration_ = false; ///< Else it waits.
  uint8_t selected_ = 0;       ///< Parts of the identity that have fitted in a row.
  uint8_t identified_ = 0;     ///< The same, for questions who is there.
  uint8_t scanned_ = 0;        ///< The part that the fast scan is at.
  bool start_ = false;
  bool answers_ = false;
  Frame answer_;
};

} // namespace stride::can::simulation

#endif
