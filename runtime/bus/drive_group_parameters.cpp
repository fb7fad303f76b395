// What blocks ask the drives for: AXIS_REF.stChannel.
#include "runtime/axis/parameter_channel.hpp"
#include "runtime/bus/drive_group.hpp"
#include "runtime/bus/drive_restart.hpp"

#include <algorithm>

namespace stride::bus {
namespace {

constexpr uint16_t kLongest = 1000; ///< Cycles: without an answer, or with one nobody fetches.

/// What AXIS_REF.stChannel can carry in a list.
constexpr ParameterForms kChannelForms =
    formBit(ParameterForm::Number) | formBit(ParameterForm::Bool);

template <class Text> void copyText(Text &to, std::string_view from) {
  const size_t count = std::min<size_t>(from.size(), Text::kLength);
  std::copy_n(from.data(), count, to.s);
  to.s[count] = 0;
}

void finish(axis::ParameterChannel &channel, axis::ChannelResult result) {
  channel.byResult = static_cast<uint8_t>(result);
  channel.uiCycles = 0;
  axis::setChannelStep(channel, axis::ChannelStep::Answered);
  if (channel.bAbandoned != 0)
    axis::freeChannel(channel, channel.udiClaim);
}

void finish(axis::ParameterChannel &channel, const ParameterAnswer &answer) {
  if (channel.byKind == static_cast<uint8_t>(axis::ChannelKind::Read)) {
    channel.fValue = answer.value;
    channel.dwValue = answer.raw;
  }
  if (channel.byKind == static_cast<uint8_t>(axis::ChannelKind::Describe)) {
    channel.diDescribed = answer.number;
    channel.byType = static_cast<uint8_t>(answer.type);
    channel.bWritable = answer.writable;
    copyText(channel.sName, answer.name);
    copyText(channel.sUnit, answer.unit);
  }
  finish(channel, static_cast<axis::ChannelResult>(answer.result));
}

} // namespace

/// One step of the question under way.
void DriveGroup::serveParameters(size_t index) {
  axis::AxisRef &axis = *axes_[index];
  axis::ParameterChannel &channel = axis.stChannel;
  axis::ChannelStep step = axis::channelStep(channel);
  if (step == axis::ChannelStep::Idle)
    return;
  ++channel.uiCycles;
  const bool late = channel.uiCycles > kLongest;
  if (step == axis::ChannelStep::Answered) {
    if (late || channel.bAbandoned != 0)
      axis::freeChannel(channel, channel.udiClaim);
    return;
  }
  if (step == axis::ChannelStep::Asked) {
    if (channel.bAbandoned != 0 || late) {
      finish(channel, axis::ChannelResult::Late);
      return;
    }
    ParameterRequest request;
    request.kind = static_cast<ParameterRequest::Kind>(channel.byKind);
    request.number = channel.diNumber;
    request.form = static_cast<ParameterForm>(channel.byForm);
    request.value = channel.fValue;
    request.raw = channel.dwValue;
    request.forms = kChannelForms;
    if (!isServed(axis) || !driver_->startParameter(index, request))
      return;
    axis::setChannelStep(channel, axis::ChannelStep::Driver);
    channel.uiCycles = 0;
  }
  ParameterAnswer answer;
  if (driver_->pollParameter(index, answer)) {
    finish(channel, answer);
  } else if (late) {
    driver_->cancelParameter(index);
    finish(channel, axis::ChannelResult::Late);
  }
}

/// The drive starts up anew: what was asked stays without an answer.
void DriveGroup::dropParameters(size_t index) {
  axis::ParameterChannel &channel = axes_[index]->stChannel;
  if (axis::channelStep(channel) != axis::ChannelStep::Driver)
    return;
  driver_->cancelParameter(index);
  finish(channel, axis::ChannelResult::Failed);
}

} // namespace stride::bus
