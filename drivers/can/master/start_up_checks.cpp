// What a node must be, at its start-up.
#include "drivers/can/master/start_up.hpp"
#include "drivers/can/master/texts.hpp"

#include <algorithm>
#include <array>

namespace stride::can {
namespace {

/// What a node must be.
struct ProfileRow {
  NodeConfig::Kind kind;
  uint32_t profile;
  std::string_view number; ///< … as 1000h shows it.
  std::string_view text;
};
constexpr std::array<ProfileRow, 3> kProfiles = {
    {{NodeConfig::Kind::Drive, 402, "0192", " is no drive of CiA 402"},
     {NodeConfig::Kind::Encoder, 406, "0196", " is no encoder of CiA 406"},
     {NodeConfig::Kind::Io, 401, "0191", " is no I/O device of CiA 401"}}};
const ProfileRow &profileOf(NodeConfig::Kind kind) {
  return *std::find_if(kProfiles.begin(), kProfiles.end() - 1,
                       [kind](const ProfileRow &row) { return row.kind == kind; });
}

} // namespace

StartUp::Outcome StartUp::checkType(const NodeConfig &config, uint32_t value,
                                    bus::Message &message) {
  constexpr uint32_t kProfile = 0xFFFF;
  const ProfileRow &row = profileOf(config.kind);
  several_ = config.kind == NodeConfig::Kind::Drive && value >> 16U == kProfile;
  if (several_) // each of them says what it is
    return Outcome::Next;
  if ((value & kProfile) == row.profile)
    return Outcome::Next;
  message.set("node ", uint32_t{node_}, row.text, ": its device type (",
              ObjectText(object::kDeviceType), ") is ", HexText(value, 8), " and not 16#....",
              row.number);
  return Outcome::Failed;
}

/// 67FFh of an axis.
StartUp::Outcome StartUp::checkAxisType(uint32_t value, bus::Message &message) const {
  constexpr uint32_t kProfile = 0xFFFF;
  const ProfileRow &row = profileOf(NodeConfig::Kind::Drive);
  if ((value & kProfile) == row.profile)
    return Outcome::Next;
  message.set("node ", uint32_t{node_}, row.text, " there: the type of that axis (",
              ObjectText(now().object.object), ") is ", HexText(value, 8), " and not 16#....",
              row.number);
  return Outcome::Failed;
}

StartUp::Outcome StartUp::checkIdentity(uint32_t value, bus::Message &message) const {
  const SdoWrite &expected = steps_[place_].object;
  if (value == expected.value)
    return Outcome::Next;
  message.set("node ", uint32_t{node_}, " is another device: ", ObjectText(expected.object), " is ",
              HexText(value, 8), ", expected ", HexText(expected.value, 8));
  return Outcome::Failed;
}

/// Positions are counted beyond 32 bits by what goes round at 2^32.
StartUp::Outcome StartUp::checkRange(uint32_t value, bus::Message &message) const {
  constexpr uint32_t kLowest = 0x80000000;
  constexpr uint32_t kHighest = 0x7FFFFFFF;
  const bool whole = rangeLow_ == kLowest && value == kHighest;
  if (whole || (rangeLow_ == 0 && value == 0))
    return Outcome::Next;
  message.set("node ", uint32_t{node_},
              " limits the range of positions (16#607B: ", HexText(rangeLow_, 8), " to ",
              HexText(value, 8), "): it must be off (both 0) or all 32 bits");
  return Outcome::Failed;
}

/// Where an encoder wraps, or its position would jump there.
StartUp::Outcome StartUp::checkEncoder(const NodeConfig &config, uint32_t value,
                                       bus::Message &message) const {
  const bool whole = value == 0 || value == UINT32_MAX;
  if (value == config.encoderModulo || (whole && config.encoderModulo == 0))
    return Outcome::Next;
  message.set("node ", uint32_t{node_}, " counts to ", value, " (",
              ObjectText(object::kEncoderRange), "): dwEncoderModulo must be that, and is ",
              config.encoderModulo);
  return Outcome::Failed;
}

} // namespace stride::can
