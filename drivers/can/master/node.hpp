// One node of the bus: its start-up, its logical devices, its SDO channel, and whether it is alive.
#ifndef STRIDE_DRIVERS_CAN_MASTER_NODE_HPP
#define STRIDE_DRIVERS_CAN_MASTER_NODE_HPP

#include "drivers/can/master/emcy.hpp"
#include "drivers/can/master/error_field.hpp"
#include "drivers/can/master/logical_device.hpp"
#include "drivers/can/master/lss_assignment.hpp"
#include "drivers/can/master/node_config.hpp"
#include "drivers/can/master/sdo_client.hpp"
#include "drivers/can/master/start_up.hpp"
#include "drivers/can/master/supervision.hpp"
#include "drivers/can/port/port.hpp"
#include "runtime/bus/news.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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
  void sdoAnswer(const Frame &frame) { sdo_.received(frame); }
  void heartbeat(const Frame &frame) { supervision_.received(frame); }
  void emcy(const Frame &frame, bus::News &news);

  /// An I/O device: lets those who use its bytes know whether it works.
  void showIo() noexcept { devices_.front().showIo(communication()); }

  /// Before the frames of a cycle …
  void beginReceive();
  /// … and after them: judges what has come. `syncs`: that there have been since the last time.
  void endReceive(uint32_t syncs, bus::News &news);
  /// There has been a SYNC.
  void syncPassed();
  /// All its synchronous TPDOs have come since the last SYNC.
  [[nodiscard]] bool pdosComplete() const;
  /// Makes the RPDOs of the cycle.
  void makePdos();
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
  /// … and is looked for now.
  LssOrder seek();
  /// … which has ended so. Who does not answer is looked for again, the last time when
  /// LssConfig::wait is over.
  void numbered(const LssOutcome &outcome, bus::News &news);
  /// Devices with its number have been reset, so that one of them begins with another.
  void resetByLss();
  /// By LSS it begins anew, and has not booted since.
  [[nodiscard]] bool boots() const { return boots_; }
  /// Nodes of the bus get their numbers.
  void setLssBusy(bool busy) { lssBusy_ = busy; }

  /// One step of its start-up. `place`: for whom of its logical devices; a cycle has one step,
  /// whoever asks.
  bus::StartUp init(uint16_t &progress, bus::Message &message, bus::News &news, size_t place = 0);
  void reset();
  /// One of its logical devices begins anew, and with it the node: but not if it is the last one
  /// that comes back after the others.
  void reset(size_t place);
  void lose(NodeLoss loss, bus::News &news);
  /// Its start-up, which is not under way, has other steps from now on (StartUp::exchange).
  void exchangeSteps(std::vector<StartStep> &steps) { startUp_.exchange(steps); }
  /// Nothing of its start-up has been done yet.
  [[nodiscard]] bool idle() const { return phase_ == Phase::Idle; }

  [[nodiscard]] bus::DriveStatus status(size_t place = 0) const;
  [[nodiscard]] bool communication() const;
  [[nodiscard]] bool started() const { return phase_ == Phase::Started; }
  /// In operation, or on the way to it: a reset would undo what it has been told.
  [[nodiscard]] bool inUse() const {
    return started() || (phase_ == Phase::Starting && startUp_.isReset());
  }
  [[nodiscard]] NodeLoss loss() const { return loss_; }
  /// In operation more synchronous PDOs have come than it may send.
  [[nodiscard]] bool duplicate() const;
  [[nodiscard]] std::span<LogicalDevice> devices() { return devices_; }
  [[nodiscard]] std::span<const LogicalDevice> devices() const { return devices_; }
  [[nodiscard]] Drive402 &drive(size_t place = 0) { return devices_[place].drive(); }
  [[nodiscard]] const Drive402 &drive(size_t place = 0) const { return devices_[place].drive(); }
  [[nodiscard]] ParameterTransfer &parameters(size_t place = 0) {
    return devices_[place].parameters();
  }
  /// The question of a program is given up.
  void cancelParameter(size_t place);
  /// Its PDOs are others than before: their identifiers have to be looked at anew. TRUE once.
  bool takePlanChange();
  /// What its synchronous PDOs need of a cycle, used or not. [bit]
  [[nodiscard]] uint32_t cyclicBits() const;
  /// Identifiers of the bus that are somebody's; lives as long as this.
  void useCobIds(const CobIdSet &taken) { cobIds_ = &taken; }
  [[nodiscard]] const EmcyRing &emcyRing() const { return emcy_; }
  [[nodiscard]] const NodeConfig &config() const { return config_; }
  [[nodiscard]] uint8_t number() const { return config_.plan.node; }
  /// As its last PDO says.
  [[nodiscard]] uint32_t signal(Signal signal, size_t place = 0) const {
    return devices_[place].signal(signal);
  }

private:
  enum class Phase : uint8_t { Idle, Starting, Started, Failed };
  enum class SdoUser : uint8_t { None, Drive, Errors, Parameter };

  void watch(bus::News &news);
  void watchDrives(bus::News &news);
  [[nodiscard]] bool isDrive() const { return config_.kind == NodeConfig::Kind::Drive; }
  bus::StartUp step(bus::Message &message, bus::News &news);
  void started(bus::News &news);
  void serveSdo(bus::News &news);
  void wishAnswered(bus::News &news);
  [[nodiscard]] ObjectAnswer objectAnswer() const;
  void errorsAnswered(bus::News &news);
  void serveNext();
  void serveParameters();
  [[nodiscard]] uint16_t errorCode() const;
  void beginWish(const ObjectWish &wish, SdoUser user, uint8_t axis);
  void sayLacks(bus::News &news) const;
  void sayPdos(bus::News &news) const;
  void failed(bus::Message &message);

  NodeConfig config_;
  std::vector<LogicalDevice> devices_; ///< As in `config_`.
  SdoClient sdo_;
  Supervision supervision_;
  EmcyRing emcy_;
  StartUp startUp_;
  ErrorField errors_;
  ObjectWish wish_;  ///< Under way, of the first axis …
  size_t asker_ = 0; ///< … and that logical device's; so are parameters.
  size_t nextAsker_ = 0;
  std::array<uint8_t, 4> wishBytes_{};
  const CobIdSet *cobIds_ = nullptr;
  bus::Message failure_; ///< Why it could not start …
  uint8_t told_ = 0;     ///< … and bit n: logical device n has been told.
  uint32_t bootUps_ = 0; ///< When it had started.
  NmtCommand nmt_ = NmtCommand::None;
  Phase phase_ = Phase::Idle;
  SdoUser user_ = SdoUser::None;
  NodeLoss loss_ = NodeLoss::None;
  LssOutcome lss_;
  uint32_t sought_ = 0; ///< Cycles since LSS has looked for it first, and that one; 0: it has not.
  uint32_t seekCycles_; ///< So long it is looked for again, and once after that.
  bool wantsNumber_;
  bool lastSeek_ = false; ///< It is not looked for again.
  bool lssBusy_ = false;
  bool boots_ = false;   ///< By LSS it begins anew, and has not booted since.
  bool stepped_ = false; ///< Its start-up has made its step in this cycle.
  bool planChanged_ = false;
  bool silent_ = false;
  bool late_ = false;
  bool saidSilent_ = false;
};

} // namespace stride::can

#endif
