// A CANopen node: everything that all devices have, with hooks for what they are. [CiA 301]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_CANOPEN_NODE_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_CANOPEN_NODE_HPP

#include "drivers/can/simulation/dictionary.hpp"
#include "drivers/can/simulation/emergency.hpp"
#include "drivers/can/simulation/error_control.hpp"
#include "drivers/can/simulation/lss_slave.hpp"
#include "drivers/can/simulation/node.hpp"
#include "drivers/can/simulation/process_data.hpp"
#include "drivers/can/simulation/sdo_server.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stride::can::simulation {

struct NodeSetup {
  uint8_t id = 1; ///< 1 … 127, or kUnconfigured: it waits for one by LSS.
  std::string name = "Stride simulated node";
  uint32_t vendor = 0;
  uint32_t product = 0;
  uint32_t revision = 0;
  uint32_t serial = 0;
  int64_t bootNs = 20'000'000; ///< From a reset to the boot-up message. [ns]
  SdoServerSetup sdo{};
  bool remotely = false; ///< PDOs are sent when somebody asks by RTR.
};

/// What a device adds to it.
struct DeviceRows {
  uint32_t deviceType = 0; ///< 1000h.
  std::vector<ObjectRow> objects;
  std::vector<PdoRow> receive;
  std::vector<PdoRow> transmit;
};

class CanopenNode : public Node, private ObjectRules {
public:
  CanopenNode(const NodeSetup &setup, const DeviceRows &device);

  void powerOn(int64_t nowNs) noexcept final;
  bool receive(const Frame &frame, int64_t nowNs) noexcept final;
  [[nodiscard]] bool synchronizedBy(const Frame &frame) const noexcept final;
  void advance(int64_t nowNs) noexcept final;
  [[nodiscard]] int64_t nextNs() const noexcept final;
  bool transmit(Frame &frame) noexcept final;
  void recovered(int64_t nowNs) noexcept final;

  [[nodiscard]] uint8_t id() const { return id_; }
  [[nodiscard]] NmtState state() const { return state_; }
  [[nodiscard]] Dictionary &objects() { return dictionary_; }
  [[nodiscard]] const Dictionary &objects() const { return dictionary_; }
  [[nodiscard]] int64_t nowNs() const { return now_; }

  /// As if by SDO, whatever the state: for tests and tools.
  Abort write(uint16_t index, uint8_t sub, uint64_t value) noexcept;
  /// It hears and says nothing, as if its connector had come off.
  void setSilent(bool silent) { silent_ = silent; }
  /// Requests by SDO stay without an answer.
  void setDeaf(bool deaf) { deaf_ = deaf; }
  /// The node resets itself, as after a short break of its supply.
  void reset() noexcept { resetNode(); }

protected:
  [[nodiscard]] Emergency &emergency() { return emergency_; }

  /// The objects of the device have the values with which it begins.
  virtual void onReset() noexcept {}
  /// Another state.
  virtual void onState(NmtState /*state*/) noexcept {}
  /// Somebody wants to write an object of the device.
  virtual Abort onWrite(const Entry & /*entry*/, uint64_t /*value*/) noexcept {
    return Abort::None;
  }
  /// An object of the device has been written.
  virtual void onWritten(Entry & /*entry*/) noexcept {}
  /// Somebody reads an object of the device: it is made current.
  virtual void onRead(Entry & /*entry*/) noexcept {}
  /// SYNC: before what has been received becomes valid …
  virtual void onSync() noexcept {}
  /// … and after it, before values are sampled.
  virtual void onSynchronized() noexcept {}
  /// The master is not heard any more, or this node was off the bus.
  virtual void onConnectionLost() noexcept {}
  /// Time has come to nextDeviceNs().
  virtual void onTime() noexcept {}
  [[nodiscard]] virtual int64_t nextDeviceNs() const noexcept { return kNever; }

private:
  Abort beforeRead(Entry &entry) noexcept final;
  Abort beforeWrite(const Entry &entry, uint64_t value) noexcept final;
  void written(Entry &entry) noexcept final;
  [[nodiscard]] Abort checkCommunication(const Entry &entry, uint64_t value) const noexcept;
  void communicationWritten(Entry &entry) noexcept;

  [[nodiscard]] bool hears() const { return state_ != NmtState::Initialising && !silent_; }
  void resetNode() noexcept;
  void resetCommunication() noexcept;
  void enter(NmtState state) noexcept;
  bool networkManagement(const Frame &frame) noexcept;
  void synchronize(const Frame &frame) noexcept;
  void produceSync() noexcept;
  void connectionLost(uint16_t code) noexcept;
  void watchMaster() noexcept;
  [[nodiscard]] bool talks() const {
    return state_ == NmtState::PreOperational || state_ == NmtState::Operational;
  }
  [[nodiscard]] int64_t syncPeriodNs() const noexcept;

  NodeSetup setup_;
  uint8_t id_;
  Dictionary dictionary_;
  Emergency emergency_;
  ErrorControl control_;
  SdoServer sdo_;
  ProcessData process_;
  LssSlave lss_;
  Entry &syncId_;
  Entry &syncPeriod_;
  Entry &syncOverflow_;
  NmtState state_ = NmtState::Initialising;
  int64_t now_ = 0;
  int64_t bootNs_ = kNever; ///< It sends its boot-up message then.
  int64_t syncNs_ = kNever; ///< It sends its next SYNC then.
  uint8_t syncCount_ = 0;
  bool syncPending_ = false;
  bool silent_ = false;
  bool deaf_ = false;
  Frame sync_;
};

} // namespace stride::can::simulation

#endif
