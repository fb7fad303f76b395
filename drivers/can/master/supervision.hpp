// Whether a node is alive, and in which NMT state: boot-up, heartbeat, node guarding. [CiA 301,
// 7.2.8]
#ifndef STRIDE_DRIVERS_CAN_MASTER_SUPERVISION_HPP
#define STRIDE_DRIVERS_CAN_MASTER_SUPERVISION_HPP

#include "drivers/can/port/frame.hpp"

#include <cstdint>

namespace stride::can {

/// Commands of the NMT master.
enum class NmtCommand : uint8_t {
  None = 0,
  Start = 0x01,
  Stop = 0x02,
  PreOperational = 0x80,
  ResetNode = 0x81,
  ResetCommunication = 0x82,
};

/// The states that nodes report.
namespace nmt {
inline constexpr uint8_t kBootUp = 0x00;
inline constexpr uint8_t kStopped = 0x04;
inline constexpr uint8_t kOperational = 0x05;
inline constexpr uint8_t kPreOperational = 0x7F;
inline constexpr uint8_t kUnknown = 0xFF; ///< It has not said anything yet.
} // namespace nmt

/// The frame of a command to a node.
Frame nmtFrame(NmtCommand command, uint8_t node);

/// Supervises one node.
class Supervision {
public:
  enum class Kind : uint8_t { None, Heartbeat, Guarding };

  explicit Supervision(uint8_t node) : node_(node) {}

  /// The node is being reset: nothing is known of it.
  void clear();
  /// From now on it must be heard every `period` cycles, or be asked so often.
  void begin(Kind kind, uint32_t period);

  /// A frame with the identifier of its heartbeat; others than one byte mean nothing.
  void received(const Frame &frame);
  /// A cycle has passed.
  void cycle();

  /// Guarding: the node is to be asked now; asked() says that it has been.
  [[nodiscard]] bool asks() const { return asks_; }
  [[nodiscard]] Frame question() const;
  void asked() { asks_ = false; }

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] uint8_t state() const { return state_; }
  /// Messages of boot-up since clear().
  [[nodiscard]] uint32_t bootUps() const { return bootUps_; }
  /// It has not been heard for too long: 1.5 periods of its heartbeat, three of guarding, never
  /// less than 3 cycles.
  [[nodiscard]] bool lost() const { return kind_ != Kind::None && silent_ >= limit_; }
  /// Guarding: answers whose toggle bit was that of the answer before.
  [[nodiscard]] uint32_t repeated() const { return repeated_; }

private:
  uint32_t period_ = 0; ///< [cycles]
  uint32_t limit_ = 0;  ///< [cycles]
  uint32_t silent_ = 0; ///< [cycles]
  uint32_t toAsk_ = 0;  ///< Guarding: cycles until the next question.
  uint32_t bootUps_ = 0;
  uint32_t repeated_ = 0;
  uint8_t node_;
  uint8_t state_ = nmt::kUnknown;
  Kind kind_ = Kind::None;
  bool toggle_ = false; ///< Guarding: what the next answer must have.
  bool asks_ = false;
};

} // namespace stride::can

#endif
