// What blocks ask the drives for: AXIS_REF.stChannel.
#include "runtime/axis/axis_group.hpp"
#include "runtime/axis/parameter_channel.hpp"

#include <algorithm>

namespace stride::axis {
namespace {

constexpr uint16_t kLongest = 1000; ///< Cycles: without an answer, or with one nobody fetches.

template <class Text> void copyText(Text &to, std::string_view from) {
  const std::size_t count = std::min<std::size_t>(from.size(), Text::kLength);
  std::copy_n(from.data(), count, to.s);
  to.s[count] = 0;
}

void finish(ParameterChannel &channel, ChannelResult result) {
  channel.byResult = static_cast<uint8_t>(result);
  channel.uiCycles = 0;
  setChannelStep(channel, ChannelStep::Answered);
  if (channel.bAbandoned != 0)
    freeChannel(channel, channel.udiClaim);
}

void finish(ParameterChannel &channel, const ParameterAnswer &answer) {
  if (channel.byKind == static_cast<uint8_t>(ChannelKind::Read))
    channel.fValue = answer.value;
  if (channel.byKind == static_cast<uint8_t>(ChannelKind::Describe)) {
    channel.diDescribed = answer.number;
    channel.byType = static_cast<uint8_t>(answer.type);
    channel.bWritable = answer.writable;
    copyText(channel.sName, answer.name);
    copyText(channel.sUnit, answer.unit);
  }
  finish(channel, static_cast<ChannelResult>(answer.result));
}

} // namespace

/// One step of the question under way.
void AxisGroup::serveParameters(std::size_t index) {
  AxisRef &axis = *axes_[index];
  ParameterChannel &channel = axis.stChannel;
  ChannelStep step = channelStep(channel);
  if (step == ChannelStep::Idle)
    return;
  ++channel.uiCycles;
  const bool late = channel.uiCycles > kLongest;
  if (step == ChannelStep::Answered) {
    if (late || channel.bAbandoned != 0)
      freeChannel(channel, channel.udiClaim);
    return;
  }
  if (step == ChannelStep::Asked) {
    if (channel.bAbandoned != 0 || late) {
      finish(channel, ChannelResult::Late);
      return;
    }
    const ParameterRequest request{static_cast<ParameterRequest::Kind>(channel.byKind),
                                   channel.diNumber, channel.bBool != 0, channel.fValue};
    if (axis.wCommunicationState != kNormalOperation || !driver_->startParameter(index, request))
      return;
    setChannelStep(channel, ChannelStep::Driver);
    channel.uiCycles = 0;
  }
  ParameterAnswer answer;
  if (driver_->pollParameter(index, answer)) {
    finish(channel, answer);
  } else if (late) {
    driver_->cancelParameter(index);
    finish(channel, ChannelResult::Late);
  }
}

/// The drive starts up anew: what was asked stays without an answer.
void AxisGroup::dropParameters(std::size_t index) {
  ParameterChannel &channel = axes_[index]->stChannel;
  if (channelStep(channel) != ChannelStep::Driver)
    return;
  driver_->cancelParameter(index);
  finish(channel, ChannelResult::Failed);
}

} // namespace stride::axis
