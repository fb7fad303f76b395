// What a node is for programs: a drive, an encoder or an I/O device, with its PDOs. A node has
// several of them if it is several drives. [CiA 301, logical devices; CiA 402]
#ifndef STRIDE_DRIVERS_CAN_MASTER_LOGICAL_DEVICE_HPP
#define STRIDE_DRIVERS_CAN_MASTER_LOGICAL_DEVICE_HPP

#include "drivers/can/master/drive402.hpp"
#include "drivers/can/master/node_config.hpp"
#include "drivers/can/master/parameter_transfer.hpp"
#include "drivers/can/master/pdo_balance.hpp"
#include "drivers/can/master/signals.hpp"
#include "drivers/can/port/frame.hpp"
#include "runtime/bus/news.hpp"

#include <array>
#include <cstdint>

namespace stride::can {

class LogicalDevice {
public:
  /// `place`: of config.device().
  LogicalDevice(const NodeConfig &config, size_t place);

  // What it tells.
  void tpdo(size_t place, const Frame &frame);
  /// Before the frames of a cycle …
  void beginReceive() { arrived_ = {}; }
  /// … and after them: `syncs` that there have been since the last time, at least one.
  void countPdos(uint32_t syncs);
  /// There has been a SYNC.
  void syncPassed() { atSync_ = {}; }
  /// All its synchronous TPDOs have come since the last SYNC.
  [[nodiscard]] bool pdosComplete() const;
  /// Those without which nothing is known of it have come since its start-up began.
  [[nodiscard]] bool pdosArrived() const { return (needed_ & ~seen_) == 0; }
  /// Cycles without a synchronous TPDO, up to NodeConfig::pdoTimeout.
  [[nodiscard]] uint32_t missing() const { return missing_; }
  [[nodiscard]] bool silent() const { return missing_ >= pdoTimeout_; }
  /// Its TPDOs have another length, again and again.
  [[nodiscard]] bool wrongLength() const;
  /// More synchronous PDOs have come than it may send.
  [[nodiscard]] bool duplicate() const;

  // What it is told.
  /// Makes the RPDOs of the cycle; `works`: else there are none.
  void makePdos(bool works);
  [[nodiscard]] size_t rpdoCount() const { return plan_.rpdoCount; }
  [[nodiscard]] bool rpdoDue(size_t place) const { return rpdos_[place].due; }
  [[nodiscard]] const Frame &rpdo(size_t place) const { return rpdos_[place].frame; }
  void rpdoSent(size_t place, bool taken);
  /// Nobody knows what of it has come to the device.
  void forgetSent();
  /// All RPDOs of the cycle have been tried. TRUE: now they fail again and again.
  bool endOfPdos();
  [[nodiscard]] bool sendsFail() const;

  /// Its start-up begins: its PDOs are those of the configuration again …
  void beginStartUp();
  /// … until it turns out that the node has others.
  void setPlan(const DrivePlan &plan);
  [[nodiscard]] const DrivePlan &plan() const { return plan_; }
  [[nodiscard]] DriveFacts &facts() { return facts_; }
  /// Its node is in operation.
  void started();
  /// Its node starts anew.
  void reset();

  // A drive.
  /// First in a cycle; `told`: the error that the node has told or has in its list.
  void readDrive(uint16_t told, bool reachable, uint8_t node, bus::News &news);
  /// Its fault has come in this cycle, or has gone.
  [[nodiscard]] bool faultCame() const { return fault_ && !before_; }
  [[nodiscard]] bool faultWent() const { return !fault_ && before_; }
  [[nodiscard]] Drive402 &drive() { return drive_; }
  [[nodiscard]] const Drive402 &drive() const { return drive_; }
  [[nodiscard]] ParameterTransfer &parameters() { return parameters_; }
  /// Whoever serves the drive knows that it has started.
  [[nodiscard]] bool joined() const { return joined_; }
  void join() { joined_ = true; }

  /// An I/O device: lets those who use its bytes know whether it works.
  void showIo(bool works) noexcept;

  /// As its last PDO says.
  [[nodiscard]] uint32_t signal(Signal signal) const { return signals_.get(signal); }

private:
  struct Rpdo {
    Frame frame;
    Frame last;           ///< That has gone out …
    uint32_t refresh = 0; ///< … and cycles until it goes out again, by event.
    bool due = false;
    bool known = false; ///< The device has what it was told last.
  };

  [[nodiscard]] bool isIo() const { return kind_ == NodeConfig::Kind::Io; }
  bool takeOver(size_t place, const Frame &frame);
  [[nodiscard]] Frame rpdoFrame(size_t place) const;
  [[nodiscard]] uint8_t neededPdos() const;

  NodeConfig::Kind kind_;
  IoConfig io_;
  DrivePlan configured_;
  DrivePlan plan_;
  Signals signals_;
  DriveFacts facts_;
  Drive402 drive_;
  ParameterTransfer parameters_;
  std::array<Rpdo, DrivePlan::kMostPdos> rpdos_{};
  std::array<uint8_t, DrivePlan::kMostPdos> arrived_{}; ///< TPDOs of this cycle, by place …
  std::array<bool, DrivePlan::kMostPdos> atSync_{};     ///< … and since the last SYNC.
  std::array<PdoBalance, DrivePlan::kMostPdos> balances_{};
  uint32_t refreshCycles_;
  uint32_t pdoTimeout_;
  uint32_t missing_ = 0;
  std::array<uint8_t, DrivePlan::kMostPdos> wrongLength_{}; ///< Of each TPDO, in a row.
  uint32_t failedSends_ = 0; ///< Cycles in a row in which an RPDO did not go out.
  uint8_t seen_ = 0;         ///< Bit n: TPDO n has come since its start-up began.
  uint8_t needed_ = 0;       ///< … those that it must have sent to be started.
  bool fault_ = false;       ///< Its drive shows one …
  bool before_ = false;      ///< … and has in the cycle before.
  bool saidStuck_ = false;
  bool joined_ = false;
};

} // namespace stride::can

#endif
