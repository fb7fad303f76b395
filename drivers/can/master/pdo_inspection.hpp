// What a PDO of a node is that cannot be changed, read object by object.
#ifndef STRIDE_DRIVERS_CAN_MASTER_PDO_INSPECTION_HPP
#define STRIDE_DRIVERS_CAN_MASTER_PDO_INSPECTION_HPP

#include "drivers/can/plan/pdo_plan.hpp"

#include <array>
#include <cstdint>

namespace stride::can {

/// A PDO as the node has it.
struct FixedPdo {
  bool transmits = false;
  bool on = true;
  bool known = true;  ///< Its mapping could be read, and is one.
  uint32_t cobId = 0; ///< 1400h:1, 1800h:1, all bits. Not read of a mapping alone.
  uint32_t count = 0; ///< 1600h:0, 1A00h:0.
  Pdo pdo;            ///< Objects as the device has them.

  /// Its frame, at most. [bytes]
  [[nodiscard]] uint8_t length() const { return known ? pdo.length() : Frame::kMostBytes; }
  /// It goes on the wire at SYNCs.
  [[nodiscard]] bool cyclic() const { return transmits && on && pdo.synchronous(); }
  [[nodiscard]] bool has(const PdoEntry &entry) const;
};

class PdoInspection {
public:
  /// All of a PDO; `object`: one of its parameters.
  void begin(Object object);
  /// Its mapping only.
  void beginMapping(Object object);

  /// What is to be read next.
  [[nodiscard]] Object wish() const;
  /// It has been, or is not to be had. TRUE: nothing more is to be read.
  bool answered(bool there, uint32_t value);

  [[nodiscard]] const FixedPdo &result() const { return result_; }

private:
  enum class Step : uint8_t { CobId, Type, Count, Entry };

  [[nodiscard]] uint16_t communication() const;
  [[nodiscard]] uint16_t mapping() const;
  bool counted(bool there, uint32_t value);

  FixedPdo result_;
  Step step_ = Step::CobId;
  uint8_t count_ = 0;
};

} // namespace stride::can

#endif
