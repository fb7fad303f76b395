// One node of the bus: its start-up, its PDOs, its SDO channel, and whether it is alive.
#ifndef STRIDE_DRIVERS_CAN_MASTER_NODE_HPP
#define STRIDE_DRIVERS_CAN_MASTER_NODE_HPP

#include "drivers/can/master/drive402.hpp"
#include "drivers/can/master/emcy.hpp"
#include "drivers/can/master/lss_assignment.hpp"
#include "drivers/can/master/node_config.hpp"
#include "drivers/can/master/parameter_transfer.hpp"
#include "drivers/can/master/pdo_balance.hpp"
#include "drivers/can/master/sdo_client.hpp"
#include "drivers/can/master/start_up.hpp"
#include "drivers/can/master/supervision.hpp"
#include "drivers/can/port/port.hpp"
#include "runtime/bus/news.hpp"

#include <array>
#include <cstdint>

namespace stride::can {

/// Why a node is lost until its start-up begins anew.
enum class NodeLoss : uint8_t {
  None,
  Restarted,       ///< It has booted in operation.
  LeftOperational, ///< It says so.
  Bus,             ///< Off, or the interface is down.
  Duplicate,       ///< Two nodes have one number.
};
std::string_view describe(NodeLoss loss);

class Node {
public:
  explicit Node(const NodeConfig &config);

  // Frames with its identifiers.
  void tpdo(size_t place, const Frame &frame);
  void sdoAnswer(const Frame &frame) { sdo_.received(frame); }
  void heartbeat(const Frame &frame) { supervision_.received(frame); }
  void emcy(const Frame &frame, bus::News &news);

  /// An I/O device: lets those who use its bytes know whether it works.
  void showIo() noexcept;

  /// Before the frames of a cycle …
  void beginReceive();
  /// … and after them: judges what has come. `syncs`: that there have been since the last time.
  void endReceive(uint32_t syncs, bus::News &news);
  /// There has been a SYNC.
  void syncPassed() { atSync_ = {}; }
  /// All its synchronous TPDOs have come since the last SYNC.
  [[nodiscard]] bool pdosComplete() const;
  /// Makes the RPDOs of the cycle.
  void makePdos();

  /// RPDOs: whether one is due, and how its sending has ended.
  [[nodiscard]] size_t rpdoCount() const { return config_.plan.rpdoCount; }
  [[nodiscard]] bool rpdoDue(size_t place) const { return rpdos_[place].due; }
  [[nodiscard]] const Frame &rpdo(size_t place) const { return rpdos_[place].frame; }
  void rpdoSent(size_t place, bool taken);
  /// What it is told comes too late, cycle after cycle.
  void setLate(bool late) { late_ = late; }
  /// All RPDOs of the cycle have been tried.
  void endOfPdos(bus::News &news);

  // What else it is told: one frame after the other, as there is room.
  [[nodiscard]] NmtCommand nmt() const { return nmt_; }
  void nmtSent() { nmt_ = NmtCommand::None; }
  [[nodiscard]] Supervision &supervision() { return supervision_; }
  [[nodiscard]] SdoClient &sdo() { return sdo_; }

  /// It is still to be given its number by LSS …
  [[nodiscard]] bool wantsNumber() const { return wantsNumber_; }
  [[nodiscard]] LssOrder lssOrder() const;
  /// … which has ended so.
  void numbered(const LssOutcome &outcome, bus::News &news);
  /// Devices with its number have been reset, so that one of them begins with another.
  void resetByLss();
  /// By LSS it begins anew, and has not booted since.
  [[nodiscard]] bool boots() const { return boots_; }
  /// Nodes of the bus get their numbers.
  void setLssBusy(bool busy) { lssBusy_ = busy; }

  bus::StartUp init(uint16_t &progress, bus::Message &message, bus::News &news);
  void reset();
  void lose(NodeLoss loss, bus::News &news);

  [[nodiscard]] bus::DriveStatus status() const;
  [[nodiscard]] bool communication() const;
  [[nodiscard]] bool started() const { return phase_ == Phase::Started; }
  /// In operation, or on the way to it: a reset would undo what it has been told.
  [[nodiscard]] bool inUse() const {
    return started() || (phase_ == Phase::Starting && startUp_.isReset());
  }
  [[nodiscard]] NodeLoss loss() const { return loss_; }
  /// In operation more synchronous PDOs have come than it may send.
  [[nodiscard]] bool duplicate() const;
  [[nodiscard]] Drive402 &drive() { return drive_; }
  [[nodiscard]] const Drive402 &drive() const { return drive_; }
  [[nodiscard]] ParameterTransfer &parameters() { return parameters_; }
  [[nodiscard]] const EmcyRing &emcyRing() const { return emcy_; }
  [[nodiscard]] const NodeConfig &config() const { return config_; }
  [[nodiscard]] uint8_t number() const { return config_.plan.node; }
  /// As its last PDO says.
  [[nodiscard]] uint32_t signal(Signal signal) const { return signals_.get(signal); }

private:
  enum class Phase : uint8_t { Idle, Starting, Started, Failed };
  enum class SdoUser : uint8_t { None, Drive, Parameter };

  struct Rpdo {
    Frame frame;
    Frame last;           ///< That has gone out …
    uint32_t refresh = 0; ///< … and cycles until it goes out again, by event.
    bool due = false;
    bool known = false; ///< The drive has what it was told last.
  };

  void watch(bus::News &news);
  void watchDrive(bus::News &news);
  [[nodiscard]] bool isDrive() const { return config_.kind == NodeConfig::Kind::Drive; }
  [[nodiscard]] bool isIo() const { return config_.kind == NodeConfig::Kind::Io; }
  bool takeOver(size_t place, const Frame &frame);
  [[nodiscard]] Frame rpdoFrame(size_t place) const;
  void countPdos(uint32_t syncs);
  void started(bus::News &news);
  void serveSdo(bus::News &news);
  void wishAnswered(bus::News &news);
  void beginWish(const ObjectWish &wish);
  void sayLacks(bus::News &news) const;

  NodeConfig config_;
  Signals signals_;
  SdoClient sdo_;
  Supervision supervision_;
  EmcyRing emcy_;
  StartUp startUp_;
  DriveFacts facts_;
  Drive402 drive_;
  ParameterTransfer parameters_;
  std::array<Rpdo, DrivePlan::kMostPdos> rpdos_{};
  std::array<uint8_t, DrivePlan::kMostPdos> arrived_{}; ///< TPDOs of this cycle, by place …
  std::array<bool, DrivePlan::kMostPdos> atSync_{};     ///< … and since the last SYNC.
  std::array<PdoBalance, DrivePlan::kMostPdos> balances_{};
  ObjectWish wish_; ///< The drive's, under way.
  std::array<uint8_t, 4> wishBytes_{};
  uint32_t refreshCycles_;
  uint32_t missing_ = 0;     ///< Cycles without a synchronous TPDO.
  uint32_t wrongLength_ = 0; ///< TPDOs of another length, in a row.
  uint32_t failedSends_ = 0; ///< Cycles in a row in which an RPDO did not go out.
  uint32_t bootUps_ = 0;     ///< When it had started.
  uint8_t seen_ = 0;         ///< Bit n: TPDO n has come since its start-up began.
  uint8_t needed_ = 0;       ///< … those that it must have sent to be started.
  NmtCommand nmt_ = NmtCommand::None;
  Phase phase_ = Phase::Idle;
  SdoUser user_ = SdoUser::None;
  NodeLoss loss_ = NodeLoss::None;
  LssOutcome lss_;
  bool wantsNumber_;
  bool lssBusy_ = false;
  bool boots_ = false; ///< By LSS it begins anew, and has not booted since.
  bool silent_ = false;
  bool late_ = false;
  bool saidSilent_ = false;
  bool saidStuck_ = false;
};

} // namespace stride::can

#endif
