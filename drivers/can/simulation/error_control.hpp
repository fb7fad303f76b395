// Who is alive: heartbeats, node guarding, the boot-up message. [CiA 301, NMT error control]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_ERROR_CONTROL_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_ERROR_CONTROL_HPP

#include "drivers/can/port/frame.hpp"
#include "drivers/can/simulation/dictionary.hpp"
#include "drivers/can/simulation/node.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace stride::can::simulation {

/// States of a node, as heartbeats have them.
enum class NmtState : uint8_t {
  Initialising = 0x00,
  Stopped = 0x04,
  Operational = 0x05,
  PreOperational = 0x7F,
};

/// Nodes whose heartbeats a node can watch.
inline constexpr uint8_t kWatched = 4;

class ErrorControl {
public:
  /// The rows must be in the dictionary.
  explicit ErrorControl(Dictionary &dictionary);

  /// Nothing is known of anybody; `boot`: the boot-up message is to be sent.
  void reset(bool boot, int64_t nowNs) noexcept;

  /// A frame of the error control services.
  void receive(const Frame &frame, uint8_t ownId, int64_t nowNs) noexcept;
  /// 1016h or 1017h, 100Ch or 100Dh have been written.
  void configure(int64_t nowNs) noexcept;
  [[nodiscard]] Abort beforeWrite(const Entry &entry, uint64_t value) const noexcept;
  void advance(int64_t nowNs) noexcept;
  [[nodiscard]] int64_t nextNs() const noexcept;
  bool transmit(Frame &frame, uint8_t ownId, NmtState state) noexcept;
  /// The boot-up message has not gone yet: nothing else goes before it.
  [[nodiscard]] bool boots() const { return boot_; }

  /// Somebody who was watched is not heard any more; asked once.
  bool takeLost() noexcept;
  /// He is heard again; asked once.
  bool takeBack() noexcept;

private:
  struct Watch {
    Entry *entry = nullptr;
    bool heard = false; ///< The time runs.
    bool lost = false;
    int64_t lastNs = 0;
    [[nodiscard]] uint8_t node() const { return static_cast<uint8_t>(entry->value >> 16U & 0x7FU); }
    [[nodiscard]] int64_t timeNs() const;
  };

  [[nodiscard]] int64_t lifeNs() const noexcept;

  std::array<Watch, kWatched> watches_{};
  Entry &producer_;
  Entry &guardTime_;
  Entry &lifeFactor_;
  int64_t heartbeatNs_ = kNever; ///< The next one goes then.
  bool boot_ = false;
  bool heartbeat_ = false;
  bool answer_ = false; ///< To a guard.
  bool toggle_ = false;
  bool guarded_ = false;
  bool unguarded_ = false; ///< No guard has asked for the life time.
  int64_t guardedNs_ = 0;
  bool lost_ = false;
  bool back_ = false;
};

} // namespace stride::can::simulation

#endif
