// MC_DigitalCamSwitch: outputs switched by the position of an axis.
#include "runtime/axis/cam/track.hpp"
#include "runtime/axis/master.hpp"
#include "runtime/iec/ctx.h"

#include "st/SM_PLCopen/MC_CAMSWITCH_REF.h"
#include "st/SM_PLCopen/MC_DigitalCamSwitch.h"

namespace {

namespace axis = ::stride::axis;
namespace cam = ::stride::cam;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_DigitalCamSwitch;

constexpr int16_t kTracks = sizeof(Block::aTracks) / sizeof(cam::TrackState);

/// Why the block cannot work, or kNone. `used` has a bit for each track that has a switch.
int16_t cannotSwitch(const Block &block, uint32_t &used) noexcept {
  if (block.Axis == nullptr)
    return axis::error::kNoAxis;
  constexpr int16_t kInvalid = ::st::SM_Error::SMC_ERROR__SMC_INVALID_PARAMETER;
  if (block.Switches == nullptr || block.Outputs == nullptr || block.TrackOptions == nullptr ||
      (block.Switches->NoOfSwitches > 0 && block.Switches->CamSwitchPtr == nullptr) ||
      block.TappetMode < 0 || block.TappetMode > 2)
    return kInvalid;
  for (int16_t i = 0; i < block.Switches->NoOfSwitches; ++i) {
    const cam::CamSwitch &camSwitch = block.Switches->CamSwitchPtr[i];
    if (!cam::isUsable(camSwitch) ||
        !cam::isUsable(block.TrackOptions->v[camSwitch.TrackNumber - 1]))
      return kInvalid;
    used |= uint32_t{1} << (camSwitch.TrackNumber - 1);
  }
  return axis::error::kNone;
}

/// Looks at the axis; `fresh`: for the first time, or because its zero point has been shifted.
cam::TrackAxis look(Block &block, bool fresh) noexcept {
  axis::AxisRef &ref = *block.Axis;
  const auto view = static_cast<motion::MasterView>(block.TappetMode);
  const motion::MasterMotion seen = fresh ? motion::beginMaster(block.stMaster, ref, view)
                                          : motion::readMaster(block.stMaster, ref, view);
  return {seen.position, seen.velocity, axis::isRotary(ref) ? ref.fPositionPeriod : 0.0};
}

void clearOutputs(Block &block) noexcept {
  if (block.Outputs != nullptr)
    for (int16_t i = 0; i < kTracks; ++i)
      block.Outputs->v[i] = 0;
}

void runSwitches(Block &block, uint32_t used, int64_t now) noexcept {
  const bool shifted = block.stMaster.fOffset != block.Axis->fOffsetPosition;
  const bool fresh = block.InOperation == 0;
  const cam::TrackAxis seen = look(block, fresh || shifted);
  cam::TrackPass passes[kTracks];
  for (int16_t i = 0; i < kTracks; ++i) {
    const uint32_t bit = uint32_t{1} << i;
    if ((used & bit) == 0)
      continue;
    const cam::TrackOptions &options = block.TrackOptions->v[i];
    cam::TrackState &track = block.aTracks.v[i];
    const bool isNew = fresh || (block.dwTracks & bit) == 0;
    if (isNew || shifted) {
      const int16_t direction = isNew ? int16_t{0} : track.iDirection;
      cam::beginTrack(track, options, seen);
      track.iDirection = direction;
    }
    passes[i] = cam::advanceTrack(track, options, seen);
  }
  block.dwTracks = used;
  if (fresh) {
    block.liTime = now;
    for (cam::SwitchPulse &pulse : block.aPulses.v)
      pulse = {};
  }
  uint32_t on = 0;
  for (int16_t i = 0; i < block.Switches->NoOfSwitches; ++i) {
    const cam::CamSwitch &camSwitch = block.Switches->CamSwitchPtr[i];
    const auto index = static_cast<int16_t>(camSwitch.TrackNumber - 1);
    const cam::TrackOptions &options = block.TrackOptions->v[index];
    const cam::TrackState &track = block.aTracks.v[index];
    const bool isOn = camSwitch.CamSwitchMode == 1
                          ? cam::isPulsed(block.aPulses.v[i], track, options, seen, camSwitch,
                                          passes[index], block.liTime, now)
                          : cam::isOn(track, options, seen, camSwitch);
    if (isOn)
      on |= uint32_t{1} << index;
  }
  block.liTime = now;
  on &= block.EnableMasks;
  for (int16_t i = 0; i < kTracks; ++i)
    block.Outputs->v[i] = (on >> i & 1U) != 0;
}

} // namespace

void st::SM_PLCopen::MC_DigitalCamSwitch::body__(::stride::Ctx &ctx__) {
  if (Enable == 0) {
    if (InOperation != 0)
      clearOutputs(*this);
    InOperation = 0;
    Busy = 0;
    Error = 0;
    ErrorID = axis::error::kNone;
    return;
  }
  if (Error != 0)
    return;
  uint32_t used = 0;
  if (const int16_t problem = cannotSwitch(*this, used); problem != axis::error::kNone) {
    clearOutputs(*this);
    InOperation = 0;
    Busy = 0;
    Error = 1;
    ErrorID = problem;
    if (Axis != nullptr)
      axis::noteError(*Axis, problem);
    return;
  }
  runSwitches(*this, used, ctx__.cycleStartNs);
  InOperation = 1;
  Busy = 1;
}
