// What a drive is told and tells in every cycle, as numbers, and its PDOs.
#ifndef STRIDE_DRIVERS_CAN_MASTER_SIGNALS_HPP
#define STRIDE_DRIVERS_CAN_MASTER_SIGNALS_HPP

#include "drivers/can/plan/pdo_plan.hpp"

#include <array>
#include <cstdint>

namespace stride::can {

/// The value of each signal; what is signed comes with its sign in all 32 bits.
class Signals {
public:
  [[nodiscard]] uint32_t get(Signal signal) const { return values_[static_cast<size_t>(signal)]; }
  [[nodiscard]] int32_t number(Signal signal) const { return static_cast<int32_t>(get(signal)); }
  void set(Signal signal, uint32_t value) { values_[static_cast<size_t>(signal)] = value; }
  void setNumber(Signal signal, int32_t value) { set(signal, static_cast<uint32_t>(value)); }

private:
  std::array<uint32_t, kSignals> values_{};
};

/// The frame of an RPDO; what means nothing to the master is 0.
Frame encode(const Pdo &pdo, const Signals &signals);

/// Takes the values of a TPDO over. False, and nothing is: the frame has another length.
bool decode(const Pdo &pdo, const Frame &frame, Signals &signals);

} // namespace stride::can

#endif
