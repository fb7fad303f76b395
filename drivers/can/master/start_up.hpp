// How a node is brought into operation: a list of steps, one at a time, without ever waiting.
#ifndef STRIDE_DRIVERS_CAN_MASTER_START_UP_HPP
#define STRIDE_DRIVERS_CAN_MASTER_START_UP_HPP

#include "drivers/can/master/logical_device.hpp"
#include "drivers/can/master/lss_assignment.hpp"
#include "drivers/can/master/node_config.hpp"
#include "drivers/can/master/pdo_inspection.hpp"
#include "drivers/can/master/sdo_client.hpp"
#include "drivers/can/master/supervision.hpp"
#include "runtime/bus/axis_driver.hpp"

#include <array>
#include <bitset>
#include <cstdint>
#include <span>
#include <vector>

namespace stride::can {

/// Bit n: the identifier n is somebody's.
using CobIdSet = std::bitset<Frame::kLastId + 1>;

/// What a step does.
enum class StartOp : uint8_t {
  Lss,            ///< Until the nodes of the bus have their numbers.
  Reset,          ///< By NMT, after the node has booted with its number.
  BootUp,         ///< Until its message comes, or so long that it must be there.
  DeviceType,     ///< It must be of the profile that the kind of the node has …
  AxisType,       ///< … and so must each of its axes, if it is several devices.
  Identity,       ///< It must be what the configuration says.
  SupportedModes, ///< …
  RatedTorque,
  RatedCurrent,
  HomeOffset,
  RangeLow, ///< Positions must go round at 2^32.
  RangeHigh,
  EncoderRange, ///< It must count as far as the configuration says.
  StampDate,    ///< If the node has this configuration already, it is left out.
  StampTime,
  NoRemote, ///< Bit 30 of a TPDO stays as it is.
  Write,
  CheckPdos,     ///< PDOs that cannot be changed: whether they will do.
  WriteConsumer, ///< The node watches the master's heartbeat.
  WriteMode,
  ReadMode, ///< Until it is there.
  Supervise,
  Start, ///< By NMT.
  Operational,
  FirstPdo,
};

struct StartStep {
  StartOp op = StartOp::Lss;
  uint8_t progress = 0; ///< 0 … 99, AXIS_REF.wCommunicationState.
  SdoWrite object;      ///< What is read or written; Identity: `value` is expected.
  uint8_t device = 0;   ///< Whose it is, of the logical devices of the node.
};

/// The steps of a node.
std::vector<StartStep> startSteps(const NodeConfig &config);

/// Whether 60C2h can say that time: as up to 255 times a power of ten. Else it says the nearest.
bool isExactPeriod(double seconds);

/// What the steps work on.
struct StartParts {
  const NodeConfig &config;
  SdoClient &sdo;
  Supervision &supervision;
  std::span<LogicalDevice> devices;
  NmtCommand &nmt;  ///< To be sent; None again when it has been.
  bool pdosArrived; ///< Since the node is operational.
  bool lssBusy;     ///< Nodes of the bus get their numbers: nobody is reset meanwhile.
  const LssOutcome &lss;
  bool &boots;            ///< By LSS it begins anew, and has not booted since.
  const CobIdSet *cobIds; ///< Of the whole bus; null: not known.
  bool &planChanged;      ///< Set when PDOs have become others than planned.
};

class StartUp {
public:
  explicit StartUp(const NodeConfig &config);

  /// Other steps, from the next beginning on; what it had before is in `steps` then.
  void exchange(std::vector<StartStep> &steps) { steps_.swap(steps); }
  /// From the beginning.
  void begin();
  /// One cycle. Failed: `message` says why.
  bus::StartUp step(const StartParts &parts, bus::Message &message);

  [[nodiscard]] uint8_t progress() const;
  /// It has been reset: what it is told from now on it must keep.
  [[nodiscard]] bool isReset() const {
    return place_ >= steps_.size() || now().op > StartOp::Reset;
  }
  /// It has no 1016h, no 1017h.
  [[nodiscard]] bool lacksConsumer() const { return lacksConsumer_; }
  [[nodiscard]] bool lacksHeartbeat() const { return lacksHeartbeat_; }
  /// An I/O device without 6206h, 6207h, 6443h or 6444h.
  [[nodiscard]] bool lacksErrorValues() const { return lacksErrorValues_; }
  [[nodiscard]] const std::vector<StartStep> &steps() const { return steps_; }
  /// Its PDOs could not be made what was planned, and are used as they are.
  [[nodiscard]] bool adapted() const { return adapted_; }
  /// PDOs that it has besides, and that cannot be switched off …
  [[nodiscard]] std::span<const FixedPdo> unused() const { return unused_; }
  /// … and what they need of a cycle. [bit]
  [[nodiscard]] uint32_t unusedBits() const;

private:
  enum class Outcome : uint8_t { Busy, Next, Failed };

  Outcome act(const StartParts &parts, bus::Message &message);
  Outcome ask(const StartParts &parts, bus::Message &message);
  Outcome answered(const StartParts &parts, bus::Message &message);
  Outcome measured(const StartParts &parts, bus::Message &message);
  Outcome refused(const StartParts &parts, bus::Message &message);
  [[nodiscard]] bool isFixedPdo(const SdoClient &sdo) const;
  Outcome fixedPdo(const SdoWrite &write);
  Outcome inspected(const StartParts &parts, bus::Message &message);
  Outcome cannotBeOff(const StartParts &parts, bus::Message &message);
  void adapt(const StartParts &parts);
  Outcome checkPdos(const StartParts &parts, bus::Message &message);
  bool cover(const StartParts &parts, const PdoEntry &wanted, bool transmits);
  [[nodiscard]] bool isIdle() const;
  Outcome compared(uint32_t value, const StartParts &parts, bus::Message &message) const;
  Outcome taken(const StartParts &parts, uint32_t value, bus::Message &message);
  Outcome reset(const StartParts &parts);
  Outcome awaitNumber(const StartParts &parts, bus::Message &message) const;
  [[nodiscard]] Outcome awaitBootUp(const StartParts &parts) const;
  Outcome awaitMode(const StartParts &parts, uint32_t value, bus::Message &message);
  Outcome checkType(const NodeConfig &config, uint32_t value, bus::Message &message);
  Outcome checkAxisType(uint32_t value, bus::Message &message) const;
  Outcome checkEncoder(const NodeConfig &config, uint32_t value, bus::Message &message) const;
  Outcome checkIdentity(uint32_t value, bus::Message &message) const;
  Outcome checkRange(uint32_t value, bus::Message &message) const;
  Outcome await(bool there, std::string_view text, bus::Message &message);
  bool chooseMode(const StartParts &parts, bus::Message &message);
  void supervise(const StartParts &parts) const;
  bool disturbed(const StartParts &parts, bus::Message &message);
  void go(size_t place);
  void skipConfiguration();
  [[nodiscard]] uint32_t valueOf(const SdoWrite &write, const StartParts &parts) const;
  [[nodiscard]] bool awaitsBootUp() const {
    return now().op == StartOp::Lss || now().op == StartOp::Reset || now().op == StartOp::BootUp;
  }
  [[nodiscard]] const StartStep &now() const { return steps_[place_]; }

  std::vector<StartStep> steps_;
  std::array<uint8_t, 4> bytes_{};
  size_t place_ = 0;
  uint32_t waited_ = 0;   ///< In this step. [cycles]
  uint32_t patience_;     ///< For boot-up, modes and states. [cycles]
  uint32_t bootUps_ = 0;  ///< That have been taken notice of.
  uint32_t noRemote_ = 0; ///< Bit 30 of the TPDO that is being configured.
  uint32_t rangeLow_ = 0;
  uint8_t node_;
  bool asked_ = false; ///< The question of this step is under way.
  /// Bytes of the object of this step, that its node has told; 0: it has not.
  uint8_t measured_ = 0;
  bool compares_ = false; ///< What this step would write is fixed: it must be what is wanted …
  bool inspects_ = false; ///< … or its PDO is read as a whole.
  PdoInspection inspection_;
  std::vector<FixedPdo> unused_; ///< With room for all that there can be.
  SdoWrite mismatch_;            ///< The first that is not as planned: what it should be …
  uint32_t mismatchValue_ = 0;   ///< … and is.
  bool adapted_ = false;
  bool several_ = false; ///< 1000h says that the node is several logical devices.
  bool stampFits_ = false;
  bool lacksConsumer_ = false;
  bool lacksHeartbeat_ = false;
  bool lacksErrorValues_ = false;
};

} // namespace stride::can

#endif
