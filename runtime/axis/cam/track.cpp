#include "runtime/axis/cam/track.hpp"

#include "runtime/numeric/modulo_wrap.hpp"

namespace stride::cam {
namespace {

bool isBehind(Place place, Place other) noexcept {
  return place.period > other.period ||
         (place.period == other.period && place.position > other.position);
}

Place placeAt(const TrackAxis &axis, double offset) noexcept {
  const Total total = stretched(axis.position, 1.0, offset);
  if (axis.period > 0.0)
    return placeOf(total, 0.0, axis.period);
  return {0, toDouble(total)};
}

double distance(const TrackAxis &axis, Place from, Place to) noexcept {
  return static_cast<double>(to.period - from.period) * axis.period + (to.position - from.position);
}

/// Follows `place`; a way back counts when it is longer than `hysteresis`. Whether the direction is
/// another one now.
bool filter(int16_t &direction, Place &reached, Place place, double hysteresis,
            const TrackAxis &axis) noexcept {
  const bool ahead = isBehind(place, reached);
  if (!ahead && !isBehind(reached, place))
    return false;
  const int16_t way = ahead ? 1 : -1;
  const bool turns = way != direction;
  if (turns && direction != 0 && exact::fabs(distance(axis, reached, place)) <= hysteresis)
    return false;
  reached = place;
  direction = way;
  return turns;
}

Place onPlace(const TrackState &track) noexcept { return {track.liOnTurn, track.fOnPosition}; }
Place offPlace(const TrackState &track) noexcept { return {track.liOffTurn, track.fOffPosition}; }

/// Whether the axis moves as the switch wants.
bool wantsDirection(const TrackState &track, const CamSwitch &camSwitch) noexcept {
  return camSwitch.AxisDirection == 0 || (camSwitch.AxisDirection == 1 && track.iDirection > 0) ||
         (camSwitch.AxisDirection == 2 && track.iDirection < 0);
}

/// How often `place` has left `x` behind itself, in turns.
int64_t levelOf(Place place, double x, bool inclusive) noexcept {
  return place.period + (inclusive ? place.position > x : place.position >= x);
}

constexpr int64_t kNanoseconds = 1000000; ///< In a millisecond.

int64_t nanoseconds(double seconds) noexcept {
  constexpr double kMost = 9.0e9; // seconds; 285 years
  const double bounded = seconds > kMost ? kMost : seconds < -kMost ? -kMost : seconds;
  return static_cast<int64_t>(exact::floor(bounded * 1.0e9 + 0.5));
}

} // namespace

bool isUsable(const CamSwitch &camSwitch) noexcept {
  return camSwitch.TrackNumber >= 1 && camSwitch.TrackNumber <= 32 &&
         camSwitch.AxisDirection >= 0 && camSwitch.AxisDirection <= 2 &&
         camSwitch.CamSwitchMode >= 0 && camSwitch.CamSwitchMode <= 1 &&
         exact::isfinite(camSwitch.FirstOnPosition) &&
         (camSwitch.CamSwitchMode == 1 || exact::isfinite(camSwitch.LastOnPosition));
}

bool isUsable(const TrackOptions &options) noexcept {
  return exact::isfinite(options.OnCompensation) && exact::isfinite(options.OffCompensation) &&
         exact::isfinite(options.Hysteresis) && options.Hysteresis >= 0.0;
}

void beginTrack(TrackState &track, const TrackOptions &options, const TrackAxis &axis) noexcept {
  const Place here = placeAt(axis, 0.0);
  const Place on = placeAt(axis, -axis.velocity * options.OnCompensation);
  const Place off = placeAt(axis, -axis.velocity * options.OffCompensation);
  track = {};
  track.liTurn = here.period;
  track.fPosition = here.position;
  track.liOnTurn = track.liPassTurn = on.period;
  track.fOnPosition = track.fPassPosition = on.position;
  track.liOffTurn = off.period;
  track.fOffPosition = off.position;
}

TrackPass advanceTrack(TrackState &track, const TrackOptions &options,
                       const TrackAxis &axis) noexcept {
  const double hysteresis = options.Hysteresis;
  const bool first = track.iDirection == 0;
  const Place extreme{track.liTurn, track.fPosition};
  const Place present = placeAt(axis, 0.0);
  Place here = extreme;
  const bool turned = filter(track.iDirection, here, present, hysteresis, axis);
  track.liTurn = here.period;
  track.fPosition = here.position;

  const Place on = placeAt(axis, -axis.velocity * options.OnCompensation);
  const Place off = placeAt(axis, -axis.velocity * options.OffCompensation);
  Place filteredOn = onPlace(track);
  Place filteredOff = offPlace(track);
  filter(track.iOnDirection, filteredOn, on, hysteresis, axis);
  filter(track.iOffDirection, filteredOff, off, hysteresis, axis);
  track.liOnTurn = filteredOn.period;
  track.fOnPosition = filteredOn.position;
  track.liOffTurn = filteredOff.period;
  track.fOffPosition = filteredOff.position;

  // Passes are counted only in the direction of the axis: where it was expected too far, nothing
  // comes back.
  Place from{track.liPassTurn, track.fPassPosition};
  const bool negative = track.iDirection < 0;
  if (turned && !first && (negative ? isBehind(from, extreme) : isBehind(extreme, from)))
    from = extreme;
  Place to = from;
  // Within the hysteresis the axis has not moved.
  const bool moves = track.iDirection != 0 && !isBehind(here, present) && !isBehind(present, here);
  if (moves && (negative ? isBehind(from, on) : isBehind(on, from)))
    to = on;
  track.liPassTurn = to.period;
  track.fPassPosition = to.position;
  return {from, to, first && track.iDirection > 0};
}

bool isOn(const TrackState &track, const TrackOptions &options, const TrackAxis &axis,
          const CamSwitch &camSwitch) noexcept {
  if (!wantsDirection(track, camSwitch))
    return false;
  const Place on = onPlace(track);
  const Place off = offPlace(track);
  const bool swapped = isBehind(on, off);
  const Place low = swapped ? off : on;
  const double from = low.position;
  const double to = from + distance(axis, low, swapped ? on : off);
  const bool longer = options.OffCompensation >= options.OnCompensation;
  double first = camSwitch.FirstOnPosition;
  double last = camSwitch.LastOnPosition;
  if (!(axis.period > 0.0)) {
    if (first > last)
      return longer ? to >= first || from <= last : from >= first || to <= last;
    return longer ? to >= first && from <= last : from >= first && to <= last;
  }
  if (last - first >= axis.period)
    return true;
  first = numeric::wrapPosition(first, axis.period);
  last = numeric::wrapPosition(last, axis.period);
  const bool overZero = first > last;
  if (longer) // `from` is in [0, period)
    return (overZero && from <= last) || (to >= first && (overZero || from <= last)) ||
           to >= first + axis.period;
  return (overZero && to <= last) ||
         (from >= first && (overZero ? to - axis.period <= last : to <= last));
}

bool isPulsed(SwitchPulse &pulse, const TrackState &track, const TrackOptions &options,
              const TrackAxis &axis, const CamSwitch &camSwitch, const TrackPass &pass,
              int64_t last, int64_t now) noexcept {
  const double x = axis.period > 0.0 ? numeric::wrapPosition(camSwitch.FirstOnPosition, axis.period)
                                     : camSwitch.FirstOnPosition;
  const int64_t before = levelOf(pass.from, x, pass.inclusive);
  const int64_t after = levelOf(pass.to, x, false);
  const int64_t length = int64_t{camSwitch.Duration} * kNanoseconds +
                         nanoseconds(options.OffCompensation - options.OnCompensation);
  if (after != before && wantsDirection(track, camSwitch) && length > 0) {
    // The last pass counts: when the axis was there, in proportion to the way.
    const Place there{after > before ? after - 1 : after, x};
    const double way = exact::fabs(distance(axis, pass.from, pass.to));
    const double since = exact::fabs(distance(axis, there, pass.to));
    const double part = since < way ? since / way : 1.0;
    const int64_t end =
        now - static_cast<int64_t>(part * static_cast<double>(now - last) + 0.5) + length;
    if (pulse.bOn == 0 || end > pulse.liEnd)
      pulse.liEnd = end;
    if (pulse.bOn == 0 || pulse.liEnd <= now)
      pulse.bShown = 0;
    pulse.bOn = 1;
  }
  if (pulse.bOn != 0 && pulse.bShown != 0 && now >= pulse.liEnd)
    pulse.bOn = 0;
  pulse.bShown = pulse.bOn;
  return pulse.bOn != 0;
}

} // namespace stride::cam
