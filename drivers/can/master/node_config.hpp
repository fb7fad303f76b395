// What the master is told about one node.
#ifndef STRIDE_DRIVERS_CAN_MASTER_NODE_CONFIG_HPP
#define STRIDE_DRIVERS_CAN_MASTER_NODE_CONFIG_HPP

#include "drivers/can/master/drive402.hpp"
#include "drivers/can/master/lss.hpp"
#include "drivers/can/plan/pdo_plan.hpp"
#include "runtime/common/io_exchange.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace stride::can {

/// Whether a node gets its number by LSS before it starts up, by its identity.
struct LssConfig {
  bool wanted = false;
  bool store = false;                ///< The node keeps it when it is switched off …
  uint8_t bitRate = lss::kNoBitRate; ///< … with this bit rate, by the table of the standard.
  /// So long a node that does not answer is looked for again, since it was looked for first: it may
  /// still be booting; once more when that time is over. 0: it is looked for once. [s]
  double wait = 0;
};

/// Where the bytes of an I/O device come from and go to.
struct IoConfig {
  std::shared_ptr<common::IoExchange> exchange; ///< Null: nowhere.
  /// The first byte of each PDO, by its place in the plan.
  std::array<uint16_t, DrivePlan::kMostPdos> rpdoAt{};
  std::array<uint16_t, DrivePlan::kMostPdos> tpdoAt{};
};

/// One of the logical devices of a node.
struct DeviceConfig {
  DrivePlan plan; ///< With the number of the node.
  DriveConfig drive;
  std::vector<SdoWrite> parameters; ///< That it is given at start-up, in this order.
};

/// A node, and its first logical device.
struct NodeConfig : DeviceConfig {
  enum class Kind : uint8_t {
    Drive,
    Encoder,    ///< CiA 406.
    Io,         ///< CiA 401.
    SyncDevice, ///< It gives SYNC and nothing else.
  };
  enum class Reset : uint8_t { Communication, Node, None };
  static constexpr size_t kIdentity = 4;

  Kind kind = Kind::Drive;
  std::vector<DeviceConfig> further; ///< Drives that are the same node: its other axes.
  uint32_t encoderModulo = 0;        ///< What an encoder counts to; 0: 2^32.
  IoConfig io;
  double cycle = 0.001; ///< [s]
  Reset reset = Reset::Communication;
  /// 1018h:1 … 1018h:4: vendor, product, revision, serial number; 0: whichever.
  std::array<uint32_t, kIdentity> identity{};
  LssConfig lss;
  double sdoTimeout = 0.5;   ///< [s]
  uint32_t pdoTimeout = 3;   ///< Without a synchronous TPDO the node is silent. [cycles]
  double heartbeat = 0.1;    ///< Of the node and of the master. [s]
  double guard = 0;          ///< Node guarding instead of the node's heartbeat; 0: not. [s]
  uint8_t masterNode = 126;  ///< Whose heartbeat the node watches.
  bool producesSync = false; ///< It gives SYNC, as the last thing in its start-up.

  [[nodiscard]] size_t devices() const { return 1 + further.size(); }
  [[nodiscard]] const DeviceConfig &device(size_t place) const {
    return place == 0 ? *this : further[place - 1];
  }
};

} // namespace stride::can

#endif
