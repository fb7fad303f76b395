// The start-up of a drive by its service channel: a list of steps for each phase, one at a time.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_START_UP_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_START_UP_HPP

#include "drivers/sercos/master/scaling.hpp"
#include "drivers/sercos/master/service_channel.hpp"
#include "drivers/sercos/master/start_steps.hpp"
#include "drivers/sercos/protocol/timing.hpp"
#include "runtime/bus/axis_driver.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace stride::sercos {

/// What the ring's times are for a drive.
struct DriveTimes {
  uint32_t cycle = 0; ///< [µs]
  RingTiming ring;
  DriveSlot slot;
};

class StartUp {
public:
  enum class State : uint8_t { Busy, AwaitsPlan, Done, Failed };

  explicit StartUp(const DriveConfig &config);

  /// The ring has come into that phase.
  void begin(Phase phase);
  /// The times are known: what waits for them goes on.
  void plan(const DriveTimes &times);
  /// One telegram of the drive has been taken by `channel`. Failed: `message` says why.
  void step(ServiceChannel &channel, bus::Message &message);

  [[nodiscard]] State state() const { return state_; }
  /// Share of the steps of this phase that are over, in percent.
  [[nodiscard]] uint8_t percent() const;
  [[nodiscard]] const DriveTiming &timing() const { return timing_; }
  [[nodiscard]] const ScalingFacts &facts() const { return facts_; }
  /// Of S-0-0032 (bit 0), S-0-0033, S-0-0034: operation modes that the drive does not have.
  [[nodiscard]] uint8_t missingModes() const { return missingModes_; }
  [[nodiscard]] const std::vector<StartStep> &steps(Phase phase) const;

private:
  enum class Part : uint8_t {
    Begin,
    Asked, ///< Its first question is under way.
    Writing,
    Polling, ///< The state of a command.
    Ending,  ///< A command is being cleared.
    Refusal, ///< What S-0-0127 or S-0-0128 has found is being read.
  };

  void next();
  void ask(ServiceChannel &channel);
  void answered(ServiceChannel &channel, bus::Message &message);
  void checkLength(const ServiceChannel &channel, bus::Message &message);
  void checkBits(const ServiceChannel &channel, bus::Message &message);
  void asked(ServiceChannel &channel, bus::Message &message);
  void write(ServiceChannel &channel, const IdnValue &value, bus::Message &message);
  void written(ServiceChannel &channel, bus::Message &message);
  void polled(ServiceChannel &channel, bus::Message &message);
  void fileStep(ServiceChannel &channel, bus::Message &message);
  void tellRefusal(const ServiceChannel &channel, bus::Message &message);
  void refused(const ServiceChannel &channel, bus::Message &message);
  void fail() { state_ = State::Failed; }
  void tell(bus::Message &message, Idn idn) const;
  [[nodiscard]] int64_t timeOf(Idn idn) const;
  [[nodiscard]] const StartStep &now() const { return (*steps_)[place_]; }
  [[nodiscard]] const IdnValue &value() const;

  std::array<std::vector<StartStep>, kLists> phases_;
  const std::vector<IdnValue> file_;
  std::vector<bool> fileWritten_;
  std::vector<uint8_t> bytes_; ///< With room for the longest value that is written.
  IdnValue scratch_;           ///< With one number.
  DriveTiming timing_;
  DriveTiming usual_;
  DriveTimes times_;
  ScalingFacts facts_;
  std::vector<StartStep> *steps_;
  size_t place_ = 0;
  size_t filePlace_ = 0;
  uint32_t commandTimeout_;
  uint32_t waited_ = 0; ///< For a command. [telegrams]
  Phase phase_ = Phase::Zero;
  Part part_ = Part::Begin;
  State state_ = State::Busy;
  uint8_t missingModes_ = 0;
  bool planned_ = false;
};

} // namespace stride::sercos

#endif
