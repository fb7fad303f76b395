// What can be wrong with a simulated ring and with the devices on it.
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_FAULTS_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_FAULTS_HPP

#include "drivers/sercos/protocol/idn.hpp"
#include "drivers/sercos/protocol/service_error.hpp"

#include <cstddef>
#include <cstdint>

namespace stride::sercos::simulation {

/// Of the ring itself.
struct RingFaults {
  bool open = false;        ///< The fibre is broken: no light comes back to the master, …
  size_t openBefore = 0;    ///< … nor does any come to the devices from this one of the ring on.
  uint8_t leastLight = 1;   ///< The receivers need a transmitter that is at least as bright. [%]
  uint32_t loseMsts = 0;    ///< The next ones that are lost, for all devices and the master.
  uint32_t distortMsts = 0; ///< The next ones that arrive but are wrong.
};

/// Of one device. Counters count down by themselves.
struct DeviceFaults {
  bool off = false;        ///< Without supply: its light is off, so the ring is open there.
  bool leaves = false;     ///< It takes no part, but passes the light on.
  uint32_t loseMsts = 0;   ///< MSTs that the device does not hear, …
  uint32_t loseMdts = 0;   ///< … MDTs that it does not hear, …
  uint32_t loseAts = 0;    ///< … ATs of it that do not arrive, …
  uint32_t distortAts = 0; ///< … or arrive with a wrong checksum.
  uint32_t busyCycles = 0; ///< That each step of the service channel takes longer.
  bool mute = false;       ///< The service channel does not answer at all.
  bool failPhase3 = false; ///< S-0-0127 ends with an error, without any IDN in S-0-0021.
  bool failPhase4 = false; ///< S-0-0128 ends with an error, without any IDN in S-0-0022.
  uint8_t baudRate = 0;    ///< It only understands this speed; 0: each. [MBit/s]
  uint8_t answersAs = 0;   ///< Its ATs have this address; 0: its own.
  bool refuses = false;    ///< It refuses to be given that IDN (or to open it), …
  Idn refused = 0;
  uint16_t reason = service_error::kInvalidData; ///< … with this: 1xxxh when it is opened.
};

/// Whether one of those that are counted happens now.
constexpr bool occurs(uint32_t &counter) {
  if (counter == 0)
    return false;
  --counter;
  return true;
}

} // namespace stride::sercos::simulation

#endif
