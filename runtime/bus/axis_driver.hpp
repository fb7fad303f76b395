// The interface between drive groups and the drivers of their buses.
#ifndef STRIDE_RUNTIME_BUS_AXIS_DRIVER_HPP
#define STRIDE_RUNTIME_BUS_AXIS_DRIVER_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stride::bus {

/// What travels between drive and controller in every cycle; combined with |.
enum CyclicData : uint8_t { kPosition = 1, kVelocity = 2, kTorque = 4, kCurrent = 8 };

/// How far a drive's own reference run is.
enum class Homing : uint8_t {
  None,    ///< The drive does what the set values say.
  Running, ///< It moves by itself.
  Found,   ///< It has passed its reference, and still moves by itself.
  Failed,  ///< It has given up.
};

/// What a drive reports in every cycle. Lengths in increments.
struct DriveStatus {
  uint32_t position = 0;      ///< Position counter; wraps at 2^32. [inc]
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
  uint32_t homePosition = 0; ///< Found: the position counter at the reference. [inc]

  /// Capture inputs that a drive can have at most.
  static constexpr std::size_t kCaptureInputs = 4;

  /// Bit n: since bit n of `capture` was set there has been an edge at input n …
  uint8_t captured = 0;
  /// … with the position counter here. [inc]
  std::array<uint32_t, kCaptureInputs> capturedPosition{};
};

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
  /// Look for the reference, whatever the set values say; FALSE: follow them, from where it is.
  bool homing = false;
  uint8_t capture = 0; ///< Bit n: latch at the first edge of input n; 0 in between arms it anew.
  uint8_t controllerMode = 3; ///< As in DriveStatus.
};

/// A question for one of the drive's own parameters.
struct ParameterRequest {
  enum class Kind : uint8_t { Read, Write, Describe };
  Kind kind = Kind::Read;
  int32_t number = 0;   ///< The drive's number; Describe: the place in its list, from 0.
  bool boolean = false; ///< Read, Write: it is meant as a BOOL.
  double value = 0;     ///< Write: a BOOL as 0 or 1.
};

/// The answer.
struct ParameterAnswer {
  enum class Result : uint8_t {
    Done,
    Unknown,  ///< There is no such parameter, or not of that type; Describe: the list is shorter.
    ReadOnly, ///< Write: it is not to be written.
    Refused,  ///< Write: not with this value, or not now.
    Failed,   ///< The transfer has failed.
  };
  enum class Type : uint8_t { Bool = 1, Whole = 2, Real = 3 };
  Result result = Result::Done;
  double value = 0; ///< Read.
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
  std::size_t length_ = 0;
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
  virtual StartUp init(std::size_t drive, uint16_t &progress, Message &message) = 0;

  /// The drive is switched off and left alone; the next init begins its start-up anew.
  virtual void reset(std::size_t drive) = 0;

  /// The state taken over by the last executeStart.
  [[nodiscard]] virtual DriveStatus status(std::size_t drive) const = 0;

  /// Stores what the next executeEnd sends.
  virtual void command(std::size_t drive, const DriveCommand &command) = 0;

  /// Controller modes that the drive can be switched to: bit n stands for mode n. Known once the
  /// drive has started.
  [[nodiscard]] virtual uint8_t controllerModes(std::size_t drive) const = 0;

  /// How many inputs the drive has at which it latches its position, at most
  /// DriveStatus::kCaptureInputs. Known once the drive has started.
  [[nodiscard]] virtual uint8_t captureInputs(std::size_t /*drive*/) const { return 0; }

  /// Asks the drive for one of its own parameters, without waiting; one question at a time for each
  /// drive. False: not now, it is asked again in the next cycle.
  virtual bool startParameter(std::size_t /*drive*/, const ParameterRequest & /*request*/) {
    return true;
  }

  /// Whether the answer has come. Without an answer for 1000 cycles the question is given up.
  virtual bool pollParameter(std::size_t /*drive*/, ParameterAnswer &answer) {
    answer.result = ParameterAnswer::Result::Unknown;
    return true;
  }

  /// The question is given up.
  virtual void cancelParameter(std::size_t /*drive*/) {}

  /// The count of an encoder, taken over by the last executeStart.
  [[nodiscard]] virtual uint32_t encoder(std::size_t /*encoder*/) const { return 0; }

  /// Where the structure that driver and program share about a drive (AXIS_REF.pMS) is now; null:
  /// there is none. Called before the first cycle and whenever the application has moved.
  virtual void bindData(std::size_t /*drive*/, void * /*data*/) {}
};

} // namespace stride::bus

#endif
