#ifndef STRIDE_COMPILER_PROJECT_CSY_CONFIG_HPP
#define STRIDE_COMPILER_PROJECT_CSY_CONFIG_HPP
// [[csy]] of stride.toml: modules TSX CSY 85 with their channels.

#include "compiler/toml/schema.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace stc {

/// Members of a structure of stdlib/CSY: name and value as ST text.
using CsyFields = std::vector<std::pair<std::string, std::string>>;

/// `on_stop`: what the outputs of a channel become while the PLC is in STOP.
enum class CsyOnStop : uint8_t {
  Fallback, ///< 0
  Hold      ///< what they were
};

/// [[csy.axis]]: channels 1 to 16.
struct CsyAxisConfig {
  uint32_t channel = 0;
  Span channelSpan;
  ConfigName axis;      ///< the AXIS_REF; empty: a remote axis
  ConfigName encoder;   ///< of a remote axis; empty: its position is simulated
  CsyFields parameters; ///< of CSY_AXIS_PARAMETERS
  CsyFields inputs;     ///< of CSY_AXIS
  CsyOnStop onStop = CsyOnStop::Fallback;
};

/// [[csy.cam]]: channels 25 to 31.
struct CsyCamConfig {
  uint32_t channel = 0;
  Span channelSpan;
  uint32_t points = 0;
  ConfigName masterTable; ///< a constant array of REAL; empty: equal steps
  ConfigName slaveTable;
  CsyFields inputs; ///< of CSY_CAM
};

/// [[csy.follower]]: channels 21 to 24.
struct CsyFollowerConfig {
  uint32_t channel = 0;
  Span channelSpan;
  uint32_t master = 0;           ///< its channel; 0: none yet
  std::vector<CsyFields> slaves; ///< members of CSY_SLAVE
  CsyOnStop onStop = CsyOnStop::Fallback;
};

/// [[csy.coordinated]]: channels 17 to 20.
struct CsyCoordinatedConfig {
  uint32_t channel = 0;
  Span channelSpan;
  std::vector<ConfigName> axes; ///< of [[csy.axis]]; the first one is the coordination master
  CsyOnStop onStop = CsyOnStop::Fallback;
};

/// [[csy]]: a module.
struct CsyConfig {
  Span span;
  uint32_t rack = 0;
  uint32_t slot = 0;
  CsyFields inputs;                       ///< of CSY_RING
  CsyOnStop onStop = CsyOnStop::Fallback; ///< of channel 0, and of those that say nothing
  std::vector<CsyAxisConfig> axes;
  std::vector<CsyCamConfig> cams;
  std::vector<CsyFollowerConfig> followers;
  std::vector<CsyCoordinatedConfig> coordinated;
};

[[nodiscard]] const SectionSchema &csySchema();

/// Reads a section that has been compared with the schema; what is wrong is reported.
[[nodiscard]] CsyConfig readCsy(const CheckedSection &section, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_CSY_CONFIG_HPP
