// The master of a CANopen bus: SYNC, PDOs, SDOs, NMT and heartbeats of all its nodes, in cycles.
#ifndef STRIDE_DRIVERS_CAN_MASTER_MASTER_HPP
#define STRIDE_DRIVERS_CAN_MASTER_MASTER_HPP

#include "drivers/can/master/lss_assignment.hpp"
#include "drivers/can/master/node.hpp"
#include "drivers/can/master/node_config.hpp"
#include "drivers/can/port/port.hpp"
#include "runtime/bus/news.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace stride::can {

struct MasterConfig {
  /// The nodes with drives, in the order of the axes; after them others.
  std::vector<NodeConfig> nodes;
  double cycle = 0.001;     ///< [s]
  double heartbeat = 0.1;   ///< The master's own. [s]
  double timeStamp = 0;     ///< Period of its time stamps; 0: none. [s]
  uint8_t node = 126;       ///< The master's number.
  uint32_t sdoPerCycle = 1; ///< SDO frames that go out in a cycle at most …
  /// … but while nodes start up, and so send and are sent no PDOs yet, as many as a bus with that
  /// many bits in a cycle has room for; 0: not known.
  uint64_t bitsPerCycle = 0;
  bool givesSync = true; ///< Else a node does.
  /// So long a cycle waits at most for the PDOs that SYNC has asked for; 0: they are those of the
  /// SYNC before. [ns]
  int64_t readWaitNs = 0;
};

/// What has happened on the bus since the beginning.
struct MasterCounters {
  uint64_t syncMissed = 0;    ///< Cycles without the SYNC of a node that gives it.
  uint64_t syncTwice = 0;     ///< Cycles with more than one.
  uint64_t foreignSyncs = 0;  ///< SYNCs of others, while the master gives SYNC.
  uint64_t sendQueueFull = 0; ///< Frames for which the interface had no room.
  uint64_t setValuesLate = 0; ///< Cycles whose PDOs had not all gone out when the next one began.
  uint64_t readsLate = 0;     ///< Cycles that have waited for PDOs in vain.
  uint64_t overloads = 0;     ///< Cycles with more frames than are read in one.
  uint64_t framesSent = 0;
  uint64_t framesReceived = 0;
};

class Master {
public:
  Master(const MasterConfig &config, std::unique_ptr<Port> port);
  Master(const Master &) = delete; // its nodes know where it is
  Master &operator=(const Master &) = delete;
  ~Master() = default;

  void attach(bus::DriverHost &host) { news_.attach(host); }
  [[nodiscard]] bus::News &news() { return news_; }

  /// First in a cycle: SYNC, and what has come.
  void executeStart();
  /// Last in a cycle: PDOs, and the rest as there is room.
  void executeEnd();

  /// Waits for the SYNC of a node until that time of the system's monotonic clock. Returns how many
  /// have come since the last executeStart. [ns]
  uint32_t awaitSync(int64_t monotonicNs);
  /// There has been one in this cycle.
  [[nodiscard]] bool syncRuns() const { return syncs_ > 0 || config_.givesSync; }

  /// It is a node that gives SYNC.
  [[nodiscard]] bool nodeGivesSync() const { return !config_.givesSync; }

  [[nodiscard]] size_t nodeCount() const { return nodes_.size(); }
  [[nodiscard]] Node &node(size_t index) { return nodes_[index]; }
  [[nodiscard]] const Node &node(size_t index) const { return nodes_[index]; }
  [[nodiscard]] const MasterCounters &counters() const { return counters_; }
  [[nodiscard]] Port &port() { return *port_; }
  [[nodiscard]] const Port &port() const { return *port_; }

  [[nodiscard]] ControllerState busState() const { return state_; }
  /// The bus is off, or the interface is down.
  [[nodiscard]] bool busLost() const {
    return state_ == ControllerState::BusOff || state_ == ControllerState::Down;
  }
  /// What keeps the whole bus from working, for people; nothing set: it works.
  void problem(bus::Message &text) const;

private:
  enum class Kind : uint8_t { None, Tpdo, Sdo, Heartbeat, Emcy, Sync, Lss };
  /// For whom a frame is.
  struct Route {
    Kind kind = Kind::None;
    uint8_t node = 0;   ///< Index.
    uint8_t place = 0;  ///< Tpdo …
    uint8_t device = 0; ///< … and of which of the node's logical devices.
  };

  static constexpr size_t kNobody = static_cast<size_t>(-1);

  void addRoutes(uint8_t index);
  void addPdoRoutes(uint8_t index);
  void useOtherPdos(size_t index);
  void giveSync();
  void sayLost();
  void watchBus();
  void receiveAll();
  void awaitPdos();
  [[nodiscard]] bool lacksPdos() const;
  void take(const Frame &frame);
  void judgeSync();
  void judgeSetValues();
  bool send(const Frame &frame, SendClass sendClass);
  void sendPdos();
  void sendCommands();
  void serveLss();
  bool awaitsBootUps();
  void numberNext();
  void numbered();
  void sendLss();
  void sendHeartbeat();
  void sendTime();
  void sendSdos();
  [[nodiscard]] uint32_t roomForSdos() const;

  MasterConfig config_;
  std::unique_ptr<Port> port_;
  bus::News news_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> cyclicBits_; ///< Of each node's synchronous PDOs.
  std::array<Route, Frame::kLastId + 1> routes_{};
  CobIdSet cobIds_;              ///< As planned.
  std::vector<Received> frames_; ///< Of a cycle.
  size_t early_ = 0;             ///< Frames that have come while SYNC was awaited.
  MasterCounters counters_;
  uint64_t dropped_ = 0;
  uint64_t restarts_ = 0;
  uint32_t heartbeatCycles_;
  uint32_t toHeartbeat_ = 0;
  uint32_t timeCycles_; ///< Of the time stamps; 0: there are none.
  uint32_t toTime_ = 0;
  uint64_t cycles_ = 0;      ///< Since the beginning.
  uint32_t syncs_ = 0;       ///< In this cycle.
  uint32_t lateInRow_ = 0;   ///< Cycles whose set values were late.
  uint32_t missedInRow_ = 0; ///< Cycles without SYNC.
  size_t nextSdo_ = 0;       ///< Whose turn it is.
  LssAssignment lss_;
  size_t lssNode_ = kNobody;               ///< Who is being given its number …
  size_t nextLss_ = 0;                     ///< … and whose turn is next.
  NmtCommand resetNmt_ = NmtCommand::None; ///< To be sent to …
  uint8_t resetNode_ = 0;                  ///< … a number that a node had before.
  uint32_t toBoot_ = 0;                    ///< For so long those are waited for at most. [cycles]
  ControllerState state_ = ControllerState::Active;
  bool syncSeen_ = false;
  bool saidForeign_ = false;
  bool saidUnlogged_ = false;
  bool saidOverload_ = false;
};

} // namespace stride::can

#endif
