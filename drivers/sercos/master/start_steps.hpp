// What is done with a drive in each phase of its start-up.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_START_STEPS_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_START_STEPS_HPP

#include "drivers/sercos/master/drive_config.hpp"
#include "drivers/sercos/protocol/words.hpp"

#include <cstdint>
#include <vector>

namespace stride::sercos {

enum class StartOp : uint8_t {
  ReadTime,    ///< A capability of the drive: S-0-0003 …
  CheckLength, ///< A cyclic datum has as many bytes as are planned for it.
  AwaitPlan,   ///< Until the times of the ring are known.
  WriteTime,   ///< What those times say.
  Write,
  WriteMode,   ///< An operation mode; of positions without lag if the drive has that.
  WriteFile,   ///< What the file has and this phase allows.
  ReadScaling, ///< A fact.
  Command,     ///< A procedure command, until it has been executed.
  ProfileIdn,  ///< The Pack Profile: it must be there …
  ProfileBits, ///< … and have these bits.
};

struct StartStep {
  StartOp op = StartOp::Write;
  IdnValue value;             ///< Its IDN, and what is written.
  bool optional = false;      ///< The drive may lack the IDN.
  bool listed = false;        ///< It is from a list of stride.toml.
  uint8_t bytes = 0;          ///< CheckLength.
  uint16_t mask = 0;          ///< ProfileBits.
  std::string_view text = {}; ///< ProfileBits: what they mean.
};

/// The steps in phase 2, 3 or 4.
std::vector<StartStep> startSteps(const DriveConfig &config, Phase phase);

} // namespace stride::sercos

#endif
