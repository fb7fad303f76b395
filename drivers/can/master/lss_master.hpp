// Layer setting services: gives nodes their numbers over the bus. [CiA 305] Without a port of its
// own: whoever uses it says how a request is sent and its answer is waited for.
#ifndef STRIDE_DRIVERS_CAN_MASTER_LSS_MASTER_HPP
#define STRIDE_DRIVERS_CAN_MASTER_LSS_MASTER_HPP

#include "drivers/can/port/frame.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

namespace stride::can {

/// How something has ended.
enum class LssResult : uint8_t {
  Done,
  NoAnswer,    ///< Nobody, or nobody in time.
  Refused,     ///< The node does not take it: the number, or it cannot keep it.
  WrongAnswer, ///< To another question.
};

class LssMaster {
public:
  /// Vendor, product, revision, serial number. [1018h]
  using Identity = std::array<uint32_t, 4>;
  /// Sends a request; its answer, if there is one in time. Without `awaits` nobody answers.
  using Exchange = std::function<std::optional<Frame>(const Frame &request, bool awaits)>;

  static constexpr uint16_t kRequestId = 0x7E5;
  static constexpr uint16_t kAnswerId = 0x7E4;
  /// The number of a node that has none.
  static constexpr uint8_t kNoNode = 255;

  explicit LssMaster(Exchange exchange) : exchange_(std::move(exchange)) {}

  /// Looks for one node without a number, bit by bit: with several the one whose identity is the
  /// smallest. It is selected then. Nothing: nobody answers.
  std::optional<Identity> fastScan();
  /// Selects the node with that identity.
  LssResult select(const Identity &identity);

  // Of the selected node:
  std::optional<uint8_t> node();
  LssResult setNode(uint8_t node);
  LssResult store();

  /// All nodes wait again; one that had no number begins with its new one.
  void leave();

private:
  std::optional<Frame> ask(uint8_t command, uint32_t value);
  LssResult configure(uint8_t command, uint32_t value);
  bool scan(uint32_t number, uint8_t bit, uint8_t part, uint8_t next);

  Exchange exchange_;
};

} // namespace stride::can

#endif
