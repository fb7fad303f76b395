// A device on a simulated ring: its phases, its telegrams and its service channel. [IEC 61491]
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_DEVICE_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_DEVICE_HPP

#include "drivers/sercos/protocol/words.hpp"
#include "drivers/sercos/ring/ring.hpp"
#include "drivers/sercos/simulation/faults.hpp"
#include "drivers/sercos/simulation/idn_list.hpp"
#include "drivers/sercos/simulation/service_channel.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stride::sercos::simulation {

/// S-0-0011: why a device has shut down. [IEC 61491; the bits are in public manuals of drives]
namespace class1 {
inline constexpr uint16_t kOverload = 0x0001;
inline constexpr uint16_t kFeedback = 0x0020;
inline constexpr uint16_t kOvercurrent = 0x0080;
inline constexpr uint16_t kUndervoltage = 0x0200;
inline constexpr uint16_t kPositionDeviation = 0x0800;
inline constexpr uint16_t kCommunication = 0x1000;
inline constexpr uint16_t kOvertravel = 0x2000;
inline constexpr uint16_t kManufacturer = 0x8000; ///< S-0-0129 says more.
} // namespace class1

/// S-0-0014, besides the phase in bits 2 … 0.
namespace interface_status {
inline constexpr uint16_t kMstFailure = 0x0008;
inline constexpr uint16_t kMdtFailure = 0x0010;
inline constexpr uint16_t kInvalidPhase = 0x0020;
inline constexpr uint16_t kAdvance = 0x0040;    ///< A phase was left out.
inline constexpr uint16_t kRegression = 0x0080; ///< Back to a phase other than 0.
inline constexpr uint16_t kNotReady = 0x0100;   ///< Without S-0-0127 or S-0-0128.
inline constexpr uint16_t kMode = 0x0200;       ///< A mode that is not defined.
inline constexpr uint16_t kFaults = 0x03F8;
} // namespace interface_status

struct DeviceSetup {
  uint8_t address = 1;        ///< 1 … kLastAddress; kNoAddress: it only passes on.
  uint32_t commandCycles = 3; ///< That S-0-0127, S-0-0128 and S-0-0099 take; at least 1.
};

/// Rows that every device has; those of the device go after them.
std::vector<IdnRow> communicationRows();

/// Goes by the cycles of its ring; nothing in it allocates, after it was made, or throws.
class Device : private ServiceHost {
public:
  Device(const DeviceSetup &setup, std::vector<IdnRow> rows);

  // ---- what the ring calls in each cycle: the MDT of the one that ends, then these in their order
  /// The next cycle begins, so long after the one before. `baudRate` in MBit/s.
  void beginCycle(int64_t periodNs, uint8_t baudRate) noexcept;
  /// The MST is here, with that phase.
  void receiveMst(uint8_t phase) noexcept;
  /// It should have been.
  void missMst() noexcept;
  /// Whether it sends an AT in this cycle, and then which.
  [[nodiscard]] bool transmit(DriveTelegram &telegram) noexcept;
  /// The MDT.
  void receiveMdt(uint8_t address, std::span<const uint8_t> data) noexcept;
  /// It should have been; in phases 1 and 2 nobody misses one.
  void missMdt() noexcept;

  // ---- what others may see of it
  [[nodiscard]] DeviceFaults &faults() { return faults_; }
  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] uint8_t address() const { return address_; }
  /// Of the switch at its front; valid from phase 0 on.
  void setAddress(uint8_t address) { address_ = address; }
  [[nodiscard]] IdnList &list() { return list_; }
  [[nodiscard]] const IdnList &list() const { return list_; }
  [[nodiscard]] uint16_t statusWord() const { return statusWord_; }
  /// The control word that was valid last.
  [[nodiscard]] uint16_t controlWord() const { return controlWord_; }
  [[nodiscard]] bool hasError() const { return class1_ != 0; }
  /// Bits 2 … 0 of the status word.
  [[nodiscard]] uint16_t serviceBits() const { return channel_.statusBits(); }

protected:
  // ---- what a device does of its own
  /// The phase has changed.
  virtual void onPhase(Phase before) noexcept = 0;
  /// Time goes on; the control word and the cyclic data of the last MDT are valid now.
  virtual void onCycle(int64_t periodNs) noexcept = 0;
  /// Bits of the status word that are its own.
  [[nodiscard]] virtual uint16_t deviceStatus() const noexcept = 0;
  /// IDNs that it does not accept in S-0-0128, into the list.
  virtual void checkPhase4(IdnEntry &invalid) noexcept = 0;
  /// Whether such data can be written: a service error.
  virtual uint16_t checkData(const IdnEntry &entry, int64_t value) noexcept = 0;
  /// Data has been written by the service channel.
  virtual void onData(const IdnEntry &entry) noexcept = 0;
  /// A procedure command begins: a data_state (kRunning, or how it has ended at once).
  virtual uint16_t onCommand(Idn idn) noexcept = 0;
  /// It is cancelled or interrupted.
  virtual void onCommandEnd(Idn idn) noexcept = 0;
  /// Errors have appeared in S-0-0011.
  virtual void onError() noexcept = 0;
  /// Whether S-0-0099 can clear them.
  [[nodiscard]] virtual bool canReset() const noexcept { return true; }
  virtual void onReset() noexcept = 0;

  /// The last MDT has come.
  [[nodiscard]] bool hadMdt() const { return hadMdt_; }
  /// How the command that is under way has ended.
  void endCommand(Idn idn, uint16_t state) noexcept;
  /// Bits of S-0-0011 and what S-0-0129 and S-0-0095 say with them.
  void raiseError(uint16_t bits, uint16_t number, std::string_view text) noexcept;
  /// Bits of S-0-0014, of class1::kCommunication; and back to phase 0, unless it is the mode.
  void raiseInterfaceError(uint16_t bits) noexcept;
  void setClass2(uint16_t bits) noexcept; ///< Warnings.
  void setClass3(uint16_t bits) noexcept; ///< Messages.
  /// Faults of the same names that come from elsewhere than faults(), and add to those.
  void setDisturbed(bool leaves, bool mute, bool failPhase3) noexcept;
  /// Whether the IDN comes with the MDT.
  [[nodiscard]] bool isCyclicCommand(Idn idn) const noexcept;

private:
  [[nodiscard]] bool hasLeft() const { return faults_.leaves || leaves_; }
  struct Cyclic {
    std::array<IdnEntry *, kMostCyclicObjects> entries{};
    size_t count = 0;
    size_t bytes = 0;

    void clear() { count = bytes = 0; }
    [[nodiscard]] bool add(IdnEntry &entry);
  };

  [[nodiscard]] Phase servicePhase() const noexcept override { return phase_; }
  uint16_t onOpen(const IdnEntry &entry) noexcept override;
  uint16_t onWrite(IdnEntry &entry, int64_t value,
                   std::span<const uint8_t> bytes) noexcept override;
  void onWritten(IdnEntry &entry) noexcept override;
  void onRead(IdnEntry &entry) noexcept override;

  // device.cpp
  void enter(Phase phase) noexcept;
  [[nodiscard]] bool followPhase(uint8_t phase) noexcept;
  void runCommands() noexcept;
  uint16_t startCommand(IdnEntry &entry) noexcept;
  void writeCommand(IdnEntry &entry) noexcept;
  void updateStatus() noexcept;
  void updateRealTimeBits(uint16_t before) noexcept;
  void receiveRecord(std::span<const uint8_t> record) noexcept;
  // transition_checks.cpp
  [[nodiscard]] bool configure() noexcept;
  void checkPhase3() noexcept;
  [[nodiscard]] bool checkList(Idn list, uint8_t telegram, Idn most) noexcept;
  void checkTimes(IdnEntry &invalid) noexcept;
  void checkPlace(IdnEntry &invalid) noexcept;

  DeviceSetup setup_;
  IdnList list_;
  ServiceChannel channel_;
  DeviceFaults faults_;
  Phase phase_ = Phase::Zero;
  uint8_t address_;
  uint8_t baudRate_ = 2;
  int64_t periodNs_ = 0;
  bool leaves_ = false; ///< setDisturbed.
  bool mute_ = false;
  bool failPhase3_ = false;
  bool waits_ = false; ///< It has fallen: the ring has to be in phase 0 first.
  bool hadMdt_ = false;
  bool asked_ = false;      ///< The last MDT was for it.
  bool readyFor3_ = false;  ///< S-0-0127 has been executed.
  bool readyFor4_ = false;  ///< S-0-0128 has been executed.
  unsigned missedMsts_ = 0; ///< One after the other.
  unsigned missedMdts_ = 0;
  uint16_t statusWord_ = 0;
  uint16_t controlWord_ = 0;
  uint16_t class1_ = 0;
  bool class2Changed_ = false;
  bool class3Changed_ = false;
  bool commandChanged_ = false;
  Cyclic at_;
  Cyclic mdt_;
  IdnEntry *checking_ = nullptr; ///< S-0-0127, S-0-0128 or S-0-0099, while it runs …
  uint32_t checkCycles_ = 0;     ///< … for so many cycles.
};

} // namespace stride::sercos::simulation

#endif
