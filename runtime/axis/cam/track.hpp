// Digital cam switches: where a track is on. Free of the C++ standard library; no AXIS_REF.
//
// A track looks at two places: where the axis was, or will be, by the compensation for switching on
// and by that for switching off, at its present velocity. A range of positions that is switched off
// later than on (relative to its ends) is on while any place between the two is within; one that is
// switched off earlier while all of them are.
#ifndef STRIDE_RUNTIME_AXIS_CAM_TRACK_HPP
#define STRIDE_RUNTIME_AXIS_CAM_TRACK_HPP

#include "runtime/numeric/cam/period.hpp"

#include "st/SM_PLCopen/MC_CAMSWITCH_TR.h"
#include "st/SM_PLCopen/MC_TRACK_TR.h"
#include "st/SM_PLCopen/SMC_SWITCH_PULSE.h"
#include "st/SM_PLCopen/SMC_TRACK_STATE.h"

namespace stride::cam {

using CamSwitch = ::st::SM_PLCopen::MC_CAMSWITCH_TR;
using SwitchPulse = ::st::SM_PLCopen::SMC_SWITCH_PULSE;
using TrackOptions = ::st::SM_PLCopen::MC_TRACK_TR;
using TrackState = ::st::SM_PLCopen::SMC_TRACK_STATE;

/// Whether a switch, or the options of a track, can be used: known numbers, finite, hysteresis not
/// negative.
bool isUsable(const CamSwitch &camSwitch) noexcept;
bool isUsable(const TrackOptions &options) noexcept;

/// The axis in this cycle.
struct TrackAxis {
  Total position;  ///< As shown, and any number of turns. [u]
  double velocity; ///< [u/s]
  double period;   ///< Of a rotary axis; 0 for a linear one. [u]
};

/// What has been passed since the last cycle: the places from `from` to `to`, as seen for switching
/// on. A place is passed as a tappet is (tappets.hpp).
struct TrackPass {
  Place from;
  Place to;
  bool inclusive; ///< `from` itself counts, too: it was under the axis at the start.
};

/// Starts where the axis is.
void beginTrack(TrackState &track, const TrackOptions &options, const TrackAxis &axis) noexcept;

/// Moves on to where the axis is now.
TrackPass advanceTrack(TrackState &track, const TrackOptions &options,
                       const TrackAxis &axis) noexcept;

/// Whether a switch by position is on.
bool isOn(const TrackState &track, const TrackOptions &options, const TrackAxis &axis,
          const CamSwitch &camSwitch) noexcept;

/// Whether a switch by time is on at `now`, after `pass` between `last` and `now`. [ns] A pulse
/// that is too short for any cycle lasts through the first that sees it; a pass during a pulse
/// prolongs it.
bool isPulsed(SwitchPulse &pulse, const TrackState &track, const TrackOptions &options,
              const TrackAxis &axis, const CamSwitch &camSwitch, const TrackPass &pass,
              int64_t last, int64_t now) noexcept;

} // namespace stride::cam

#endif
