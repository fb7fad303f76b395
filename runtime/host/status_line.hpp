// One line on a terminal that shows how a run is doing.
#ifndef STRIDE_RUNTIME_HOST_STATUS_LINE_HPP
#define STRIDE_RUNTIME_HOST_STATUS_LINE_HPP

#include "runtime/host/messages.hpp"
#include "runtime/host/statistics_text.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stride::host {

/// `running 12.5 s | Fast: 6250 cycles, 14.2 us (at most 83.0), 0 overruns | …`, cut at `width`
/// characters. With several applications tasks have their names before them.
[[nodiscard]] std::string statusText(int64_t elapsedNs, const std::vector<NamedTasks> &applications,
                                     size_t width);

/// Shows it every half second, on standard error when that is a terminal; messages push it down.
class StatusLine {
public:
  /// `wanted`: the run is to show one.
  StatusLine(Messages &messages, bool wanted);

  /// Whether it is time to show it again. `nowNs` is of the monotonic clock.
  bool due(int64_t nowNs) const noexcept { return enabled_ && nowNs >= nextNs_; }
  void show(int64_t nowNs, const std::vector<NamedTasks> &applications);
  void clear() noexcept;

private:
  Messages *messages_;
  bool enabled_;
  int64_t startNs_;
  int64_t nextNs_;
};

} // namespace stride::host

#endif
