// Which PDOs a drive has, made of wControlType and the cyclic data of the PLC configuration. Pure
// arithmetic, for the compiler and for the master.
#ifndef STRIDE_DRIVERS_CAN_PLAN_PDO_PLAN_HPP
#define STRIDE_DRIVERS_CAN_PLAN_PDO_PLAN_HPP

#include "drivers/can/plan/objects.hpp"
#include "drivers/can/port/frame.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace stride::can {

/// Cyclic values, as bits; those of bus::CyclicData.
namespace cyclic {
inline constexpr uint8_t kPosition = 1;
inline constexpr uint8_t kVelocity = 2;
inline constexpr uint8_t kTorque = 4;
inline constexpr uint8_t kCurrent = 8;
} // namespace cyclic

/// Controller modes, numbered as in AXIS_REF.byControllerMode.
inline constexpr uint8_t kTorqueControl = 1;
inline constexpr uint8_t kVelocityControl = 2;
inline constexpr uint8_t kPositionControl = 3;

/// An object in a PDO.
struct PdoEntry {
  Object object;
  uint8_t bits = 0;
};

/// One PDO as it is configured in the drive.
struct Pdo {
  static constexpr size_t kMostEntries = 8;
  static constexpr uint32_t kMostBits = 8 * Frame::kMostBytes;
  static constexpr uint8_t kLastSynchronous = 240;
  static constexpr uint8_t kByEvent = 255;

  uint16_t number = 1;      ///< From 1; those of further axes from 64 times their number on.
  uint16_t cobId = 0;       ///< 0 … Frame::kLastId.
  uint8_t transmission = 1; ///< At every SYNC; kByEvent: when something changes.
  uint16_t inhibit = 0;     ///< Shortest time between two, for events. [100 µs]
  uint16_t eventTimer = 0;  ///< At least so often; 0: only when something changes. [ms]
  uint8_t count = 0;        ///< Of the entries.
  std::array<PdoEntry, kMostEntries> entries{};

  [[nodiscard]] std::span<const PdoEntry> mapped() const { return {entries.data(), count}; }
  [[nodiscard]] uint32_t bits() const;
  /// Of the frame. [bytes]
  [[nodiscard]] uint8_t length() const { return static_cast<uint8_t>((bits() + 7) / 8); }
  [[nodiscard]] bool synchronous() const { return transmission <= kLastSynchronous; }
};

/// The PDOs of one drive, from its side: it receives RPDOs and transmits TPDOs. Objects of the
/// profile are written as those of the first axis.
struct DrivePlan {
  static constexpr size_t kMostPdos = 4;

  uint8_t node = 0; ///< 1 … kLastNode.
  uint8_t axis = 0; ///< Of the device, less than kMostAxes.
  uint8_t rpdoCount = 0;
  uint8_t tpdoCount = 0;
  std::array<Pdo, kMostPdos> rpdos{};
  std::array<Pdo, kMostPdos> tpdos{};
  uint8_t sent = 0;            ///< cyclic:: set values on the bus.
  uint8_t received = 0;        ///< cyclic:: actual values on the bus.
  uint8_t controllerModes = 0; ///< That these set values allow: bit n stands for mode n.

  [[nodiscard]] std::span<const Pdo> receivedByDrive() const { return {rpdos.data(), rpdoCount}; }
  [[nodiscard]] std::span<const Pdo> sentByDrive() const { return {tpdos.data(), tpdoCount}; }
  /// Whether a PDO carries it.
  [[nodiscard]] bool carries(Signal signal) const;
};

/// What a drive shall exchange in every cycle.
struct DriveWish {
  uint8_t node = 1;
  uint8_t controlType = 5; ///< wControlType; 0: CONFIGURABLE.
  /// Of CONFIGURABLE: numbers of AXIS_REF's parameters as in wCyclicDataS1 …, 0: none.
  std::array<uint16_t, 3> send{};
  std::array<uint16_t, 3> receive{};
  bool modeInPdo = false;     ///< 6060h and 6061h are mapped even if they take room in every cycle.
  bool eventPdos = true;      ///< The drive has PDOs that are sent when something changes.
  bool inputs = false;        ///< 60FDh is mapped.
  bool secondEncoder = false; ///< 60E4h:1 is mapped.
  uint8_t probeInputs = 0;    ///< Bit n: input n of DriveStatus latches positions (60B8h, 60B9h).
  /// PDOs of its own in place of those of the plan, by their numbers; empty: the plan's.
  std::vector<Pdo> rpdos = {};
  std::vector<Pdo> tpdos = {};
  uint8_t axis = 0; ///< Of the device.
};

/// The COB-ID of a PDO that is the n-th of its drive, from 0, in the predefined connection set; 0:
/// it has none there.
constexpr uint16_t predefinedId(uint16_t base, size_t place, uint8_t node, uint8_t axis) {
  return axis == 0 ? static_cast<uint16_t>(base + place * kNextPdo + node) : uint16_t{0};
}

/// What is to be said about a plan.
enum class PlanNote : uint8_t {
  CurrentNotSent,         ///< Set currents have no standard object.
  UserDataNotMapped,      ///< SetUserDef and ActUserDef need a PDO of one's own.
  UnknownData,            ///< A number that is no cyclic value.
  SetValueNotMapped,      ///< Own PDOs lack a set value that the control type has.
  ActualValueNotMapped,   ///< The same with an actual value.
  SecondEncoderNotMapped, ///< Own PDOs lack 60E4h:1.
  InputsNotMapped,        ///< Own PDOs lack 60FDh.
  ProbesNotMapped,        ///< Own PDOs lack 60B8h or 60B9h.
  NobodySets,             ///< Own RPDOs have objects that are no set values.
  UnknownControlType,     ///< An error: there is no plan.
  NothingSent,            ///< An error: no set value.
  TooMany,                ///< An error: more than four PDOs in a direction.
  NoControlword,          ///< An error: of own PDOs.
  NoStatusword,           ///< The same.
};
bool isError(PlanNote note);
/// For people.
std::string_view describe(PlanNote note);

struct PlanResult {
  DrivePlan plan;
  std::vector<PlanNote> notes;

  [[nodiscard]] bool usable() const;
};

/// The default plan, or the drive's own PDOs, with the COB-IDs of the predefined connection set;
/// PDOs of further axes have none yet (0), since the set has none for them.
PlanResult planDrive(const DriveWish &wish);

/// The plan of an encoder: its own TPDOs, or its second one, which has the position at SYNC.
/// [CiA 406]
DrivePlan planEncoder(uint8_t node, std::span<const Pdo> own = {});

/// A value that is written into the drive.
struct SdoWrite {
  Object object;
  uint8_t size = 0; ///< 1, 2 or 4; 0: the node is asked for it. [bytes]
  uint32_t value = 0;
  bool optional = false;     ///< A drive without this object goes without it.
  bool keepNoRemote = false; ///< Bit 30 stays what the drive has there.
  /// What is longer than four bytes, or a text: all of it; `size` and `value` mean nothing then.
  std::vector<uint8_t> bytes = {};

  /// Of `bytes`, or as `size` says.
  [[nodiscard]] size_t length() const { return bytes.empty() ? size : bytes.size(); }
};

/// Configures the PDOs of a drive: first off, then mapping and timing, then on. PDOs that are not
/// in the plan are switched off where the drive has them.
std::vector<SdoWrite> pdoWrites(const DrivePlan &plan);

/// The writes in the layout of object 1F22h (concise DCF), least byte first: a DWORD with their
/// number, then for each a WORD with the index, a BYTE with the subindex, a DWORD with the size,
/// and the bytes. Optional writes are left out; TPDOs cannot be asked for (bit 30). [CiA 302-3]
std::vector<uint8_t> conciseDcf(std::span<const SdoWrite> writes);

/// What 1020h:1 and 1020h:2 of a drive are, that has been configured by these writes.
struct ConfigurationStamp {
  uint32_t date = 0; ///< Days. Not 0.
  uint32_t time = 0; ///< [ms]
  friend bool operator==(const ConfigurationStamp &, const ConfigurationStamp &) = default;
};
ConfigurationStamp stampOf(std::span<const SdoWrite> writes);

} // namespace stride::can

#endif
