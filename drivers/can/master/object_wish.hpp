// A value that somebody wants to read or write in a node's dictionary when there is time.
#ifndef STRIDE_DRIVERS_CAN_MASTER_OBJECT_WISH_HPP
#define STRIDE_DRIVERS_CAN_MASTER_OBJECT_WISH_HPP

#include "drivers/can/plan/objects.hpp"

#include <cstdint>

namespace stride::can {

struct ObjectWish {
  enum class Kind : uint8_t { None, Read, Write };
  Kind kind = Kind::None;
  Object object;
  uint8_t size = 0;   ///< Write: 1 … 4 bytes.
  uint32_t value = 0; ///< Write.
};

/// How it has ended.
struct ObjectAnswer {
  bool done = false;  ///< FALSE: the transfer has failed.
  uint32_t value = 0; ///< Read: as many bytes as the node has sent, without a sign.
};

} // namespace stride::can

#endif
