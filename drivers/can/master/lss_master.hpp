// Layer setting services: gives nodes their numbers over the bus. [CiA 305] Without a port of its
// own: whoever uses it says how a request is sent and its answer is waited for.
#ifndef STRIDE_DRIVERS_CAN_MASTER_LSS_MASTER_HPP
#define STRIDE_DRIVERS_CAN_MASTER_LSS_MASTER_HPP

#include "drivers/can/master/lss.hpp"

#include <cstdint>
#include <functional>
#include <optional>

namespace stride::can {

class LssMaster {
public:
  /// Vendor, product, revision, serial number. [1018h]
  using Identity = lss::Identity;
  /// Sends a request; its answer, if there is one in time. Without `awaits` nobody answers.
  using Exchange = std::function<std::optional<Frame>(const Frame &request, bool awaits)>;

  static constexpr uint16_t kRequestId = lss::kRequestId;
  static constexpr uint16_t kAnswerId = lss::kAnswerId;
  /// The number of a node that has none.
  static constexpr uint8_t kNoNode = lss::kNoNode;

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
