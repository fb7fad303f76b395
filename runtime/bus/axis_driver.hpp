// The interface between drive groups and the drivers of their buses.
#ifndef STRIDE_RUNTIME_BUS_AXIS_DRIVER_HPP
#define STRIDE_RUNTIME_BUS_AXIS_DRIVER_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace stride::bus {

/// What travels between drive and controller in every cycle; combined with |.
enum CyclicData : uint8_t { kPosition = 1, kVelocity = 2, kTorque = 4, kCurrent = 8 };

/// How far a drive's own reference run is.
enum class Homing : uint8_t {
  None,    ///< The drive does what the set values say.
  Running, ///< It moves by itself; also while it comes to rest when nobody wants that any more.
  Found,   ///< It has passed its reference, and still moves by itself.
  Failed,  ///< It has given up.
};

/// What a drive reports in every cycle. Lengths in increments.
/// In 64 bytes, which a driver of many drives may align to: one cache line for each.
struct DriveStatus {
  double velocity = 0;        ///< [inc/s]
  double torque = 0;          ///< In the bus's unit.
  double current = 0;         ///< [A]
  bool communication = false; ///< The drive answers.
  bool regulatorOn = false;   ///< The power stage is really on.
  bool driveStarted = false;  ///< The brake is really released.
  bool error = false;         ///< The drive reports an error.
  uint16_t errorId = 0;       ///< The drive's own number.
  uint8_t controllerMode = 3; ///< 1 torque, 2 velocity, 3 position, 4 current.
  uint8_t received = 0x0F;    ///< CyclicData: which of the values above the bus brings.
  bool limitPositive = false; ///< The positive limit switch is actuated.
  bool limitNegative = false; ///< The negative limit switch is actuated.
  bool homeSwitch = false;    ///< The home switch is actuated.
  Homing homing = Homing::None;
  uint32_t position = 0;     ///< Position counter; wraps at 2^32. [inc]
  uint32_t homePosition = 0; ///< homing is Found: the position counter at the reference. [inc]

  /// Capture inputs that a drive can have at most.
  static constexpr size_t kCaptureInputs = 4;

  /// Bit n: since bit n of `capture` was set there has been an edge at input n …
  uint8_t captured = 0;
  /// … with the position counter here. [inc]
  std::array<uint32_t, kCaptureInputs> capturedPosition{};
};
static_assert(sizeof(DriveStatus) == 64);

/// What a drive is told in every cycle. Lengths in increments.
struct DriveCommand {
  uint32_t position = 0;    ///< Set position; wraps at 2^32. [inc]
  double velocity = 0;      ///< [inc/s]
  double acceleration = 0;  ///< [inc/s^2]
  double torque = 0;        ///< In the bus's unit.
  double current = 0;       ///< [A]
  bool regulatorOn = false; ///< Switch the power stage on.
  bool driveStart = false;  ///< Release the brake.
  bool errorAckn = false;   ///< Acknowledge the error.
  /// Look for the reference, whatever the set values say; FALSE: follow them, from where it is or
  /// has come to rest.
  bool homing = false;
  uint8_t capture = 0; ///< Bit n: latch at the first edge of input n; 0 in between arms it anew.
  uint8_t controllerMode = 3; ///< As in DriveStatus.
};

/// Bytes of a parameter that is no number, such as a drive's name; without memory of its own
/// elsewhere.
class ByteString {
public:
  static constexpr size_t kMost = 128;

  ByteString() = default;
  /// Takes as many as there is room for.
  explicit ByteString(std::span<const uint8_t> bytes) { assign(bytes); }
  explicit ByteString(std::string_view text);

  void assign(std::span<const uint8_t> bytes);
  [[nodiscard]] std::span<const uint8_t> bytes() const { return {bytes_.data(), size_}; }
  [[nodiscard]] size_t size() const { return size_; }
  /// The bytes as they are, as text.
  [[nodiscard]] std::string_view text() const;
  friend bool operator==(const ByteString &a, const ByteString &b) { return a.text() == b.text(); }

private:
  std::array<uint8_t, kMost> bytes_{};
  uint8_t size_ = 0;
};

/// How the value of a parameter travels. A parameter has one form.
enum class ParameterForm : uint8_t {
  Number, ///< As a double, in the parameter's unit.
  Bool,   ///< As a double, 0 or 1.
  Raw,    ///< As the 32 bits that they are: neither BOOL nor number to anybody but the drive.
  Bytes,  ///< As up to ByteString::kMost bytes.
};

/// Several forms: bit n stands for form n.
using ParameterForms = uint8_t;
constexpr ParameterForms formBit(ParameterForm form) {
  return static_cast<ParameterForms>(1U << static_cast<unsigned>(form));
}
inline constexpr ParameterForms kAllForms = 0x0F;

/// A question for one of the drive's own parameters.
struct ParameterRequest {
  enum class Kind : uint8_t { Read, Write, Describe };
  Kind kind = Kind::Read;
  /// The drive's number; Describe: the place in its list, from 0, among those of `forms`.
  int32_t number = 0;
  ParameterForm form = ParameterForm::Number; ///< Read, Write: as what it is meant.
  double value = 0;                           ///< Write: a number, or a BOOL.
  uint32_t raw = 0;                           ///< Write: the raw bits.
  ByteString bytes;                           ///< Write: the bytes.
  ParameterForms forms = kAllForms;           ///< Describe: what the asker can deal with.
};

/// The answer.
struct ParameterAnswer {
  enum class Result : uint8_t {
    Done,
    Unknown,  ///< There is no such parameter, or not of that form; Describe: the list is shorter.
    ReadOnly, ///< Write: it is not to be written.
    Refused,  ///< Write: not with this value, or not now.
    Failed,   ///< The transfer has failed.
  };
  enum class Type : uint8_t { Bool = 1, Whole = 2, Real = 3, Raw = 4, Bytes = 5 };
  Result result = Result::Done;
  double value = 0; ///< Read: a number, or a BOOL.
  uint32_t raw = 0; ///< Read: the raw bits.
  ByteString bytes; ///< Read: the bytes.
  // Describe:
  int32_t number = 0;
  Type type = Type::Real;
  bool writable = false;
  std::string_view name; ///< At most 40 characters are used …
  std::string_view unit; ///< … and 15; both must stay where they are.
};

/// How far a drive's start-up is.
enum class StartUp : uint8_t { Busy, Started, Failed };

/// A text for people, without memory of its own elsewhere: start-up runs in the cyclic path.
class Message {
public:
  /// Takes as much of the parts as there is room for.
  template <class... Parts> void set(const Parts &...parts) {
    length_ = 0;
    (append(parts), ...);
  }
  void append(std::string_view text);
  void append(uint32_t number);
  [[nodiscard]] std::string_view text() const { return {text_.data(), length_}; }

private:
  std::array<char, 255> text_{};
  size_t length_ = 0;
};

/// What happens on a bus and starts tasks of the program.
enum class BusEvent : uint8_t {
  Sync, ///< The SYNC of this cycle: SMC_AXISGROUP_REF.bSync.
};

/// Whoever runs a driver, as it sees him. From the driver's calls, in the cyclic path.
class DriverHost {
public:
  DriverHost() = default;
  DriverHost(const DriverHost &) = delete;
  DriverHost &operator=(const DriverHost &) = delete;
  virtual ~DriverHost() = default;

  /// Event tasks of the program that wait for it run.
  virtual void raise(BusEvent event) noexcept = 0;
  /// News for people, shown later and with the name of the drive group before it. When more comes
  /// than is shown meanwhile, it is counted only.
  virtual void say(const Message &news) noexcept = 0;
};

/// The program's time. In virtual time whoever sleeps is there at once.
class BusClock {
public:
  BusClock() = default;
  BusClock(const BusClock &) = delete;
  BusClock &operator=(const BusClock &) = delete;
  virtual ~BusClock() = default;

  [[nodiscard]] virtual int64_t nowNs() const noexcept = 0;
  virtual void sleepUntil(int64_t timeNs) noexcept = 0;
  /// That time by the system's monotonic clock, to wait at a socket until then; virtual time:
  /// INT64_MAX.
  [[nodiscard]] virtual int64_t monotonicNs(int64_t timeNs) const noexcept = 0;
};

/// How a wait for SYNC has ended.
struct SyncWake {
  int64_t timeNs = 0;   ///< When SYNC came; else when the wait ended.
  bool arrived = false; ///< FALSE: the deadline came first.
  uint64_t missed = 0;  ///< SYNCs that came before it, while the task was in its cycle.
};

/// One bus with the drives and encoders of a drive group, numbered from 0 as configured: the
/// manual's <Bus>DriveExecute_Start, <Bus>DriveInit and <Bus>DriveExecute_End. All calls come from
/// the task of the drive group, in the cyclic path: no allocation, no lock, no exception.
class AxisDriver {
public:
  AxisDriver() = default;
  AxisDriver(const AxisDriver &) = delete;
  AxisDriver &operator=(const AxisDriver &) = delete;
  virtual ~AxisDriver() = default;

  /// First in the task's cycle: takes over what the bus has received.
  virtual void executeStart() = 0;

  /// Last in the task's cycle: sends the commands.
  virtual void executeEnd() = 0;

  /// One step of a drive's start-up, called in every cycle until it is Started or Failed.
  /// `progress` (0..99) becomes AXIS_REF.wCommunicationState. Failed: `message` says why.
  virtual StartUp init(size_t drive, uint16_t &progress, Message &message) = 0;

  /// The drive is switched off and left alone; the next init begins its start-up anew.
  virtual void reset(size_t drive) = 0;

  /// The group begins anew: so does what is at the bus besides its drives.
  virtual void resetOthers() {}

  /// The state taken over by the last executeStart.
  [[nodiscard]] virtual DriveStatus status(size_t drive) const = 0;

  /// Stores what the next executeEnd sends.
  virtual void command(size_t drive, const DriveCommand &command) = 0;

  /// Controller modes that the drive can be switched to: bit n stands for mode n. Known once the
  /// drive has started.
  [[nodiscard]] virtual uint8_t controllerModes(size_t drive) const = 0;

  /// The inputs at which the drive latches its position: bit n stands for input n, which is less
  /// than DriveStatus::kCaptureInputs. Known once the drive has started.
  [[nodiscard]] virtual uint8_t captureInputs(size_t /*drive*/) const { return 0; }

  /// Asks the drive for one of its own parameters, without waiting; one question at a time for each
  /// drive. False: not now, it is asked again in the next cycle.
  virtual bool startParameter(size_t /*drive*/, const ParameterRequest & /*request*/) {
    return true;
  }

  /// Whether the answer has come. Without an answer for 1000 cycles the question is given up.
  virtual bool pollParameter(size_t /*drive*/, ParameterAnswer &answer) {
    answer.result = ParameterAnswer::Result::Unknown;
    return true;
  }

  /// The question is given up.
  virtual void cancelParameter(size_t /*drive*/) {}

  /// The count of an encoder, taken over by the last executeStart.
  [[nodiscard]] virtual uint32_t encoder(size_t /*encoder*/) const { return 0; }

  /// Whether that count is one: FALSE while the encoder has not started, or is not heard.
  [[nodiscard]] virtual bool encoderWorks(size_t /*encoder*/) const { return true; }

  /// Where the structure that driver and program share about a drive (AXIS_REF.pMS) is now; null:
  /// there is none. Called before the first cycle and whenever the application has moved.
  virtual void bindData(size_t /*drive*/, void * /*data*/) {}

  /// The same about the group (DriverSchema::groupData), with the layout that the application was
  /// built with. FALSE: this driver knows another one, and leaves it alone.
  virtual bool bindGroupData(void * /*data*/, uint64_t /*layout*/) { return true; }

  /// Whom it may talk to, before the first cycle; he lives as long as the driver is called.
  virtual void attach(DriverHost & /*host*/) {}

  /// For drivers that give SYNC (DriverSchema::givesSync) and a task on bSync: waits for the first
  /// SYNC after `afterNs`, the time of the task's last cycle (-1: there was none yet), but not
  /// beyond `deadlineNs`. If one came while the task could not wait, the last of them counts. From
  /// the task's thread, between its cycles. In virtual time it is called as soon as the cycle is
  /// over, and the time that it returns is when the next one will be: it must depend on nothing but
  /// the calls. All times in the program's time. [ns]
  virtual SyncWake waitSync(int64_t /*afterNs*/, int64_t deadlineNs, BusClock &clock) {
    clock.sleepUntil(deadlineNs);
    return {deadlineNs};
  }

  /// The application has stopped, with an exception or because the run ends: no program moves the
  /// axes any more. The cycles go on, with set values that brake what moves, until all axes and the
  /// driver are at rest; the driver may bring its drives to a stop in a better way (a quick stop),
  /// and must keep the bus alive. Called once.
  virtual void applicationStopped() {}

  /// After applicationStopped: nothing moves any more that the driver stops by itself.
  [[nodiscard]] virtual bool atRest() const { return true; }

  /// What keeps the whole bus from working just now, for people; nothing set: it works. Not in the
  /// cyclic path: when no cycle runs any more.
  virtual void problem(Message & /*text*/) const {}
};

} // namespace stride::bus

#endif
