// A question for the drive's service channel.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_SERVICE_WISH_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_SERVICE_WISH_HPP

#include "drivers/sercos/protocol/idn.hpp"

#include <cstdint>

namespace stride::sercos {

struct ServiceWish {
  enum class Kind : uint8_t {
    None,
    Read,  ///< The operation data, one number.
    State, ///< Of a procedure command.
    Write, ///< Two bytes.
    Text,  ///< The operation data, a text: it is said, and nobody else gets it.
  };
  Kind kind = Kind::None;
  Idn idn = 0;
  uint16_t value = 0; ///< Write.

  friend bool operator==(const ServiceWish &, const ServiceWish &) = default;
};

struct ServiceAnswer {
  bool done = false; ///< FALSE: refused, or no answer in time.
  int64_t value = 0; ///< Read, State.
  bool heard = true; ///< FALSE: no answer in time.
};

} // namespace stride::sercos

#endif
