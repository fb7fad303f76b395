// RUN and STOP.
#ifndef STRIDE_RUNTIME_TASK_OPERATING_MODE_HPP
#define STRIDE_RUNTIME_TASK_OPERATING_MODE_HPP

#include <cstdint>

namespace stride::task {

/// What the PLC does with an application that has been started: in STOP its POUs do not run, while
/// its tasks go on serving inputs, drives, buses and whoever watches. Variables keep their values.
/// IEC 61131-3 leaves the states of a PLC to its maker; these are the usual ones.
enum class OperatingMode : uint8_t { Run, Stop };

/// "RUN", "STOP".
constexpr const char *nameOf(OperatingMode mode) noexcept {
  return mode == OperatingMode::Run ? "RUN" : "STOP";
}

} // namespace stride::task

#endif
