#include "runtime/axis/cam/tappets.hpp"

#include "st/SM_DriveBasic/SMC_CAMTAPPETTYPE.h"

namespace stride::cam {
namespace {

constexpr int16_t kMaxLegs = sizeof(TappetState::aliLegPeriod) / sizeof(int64_t);
constexpr int32_t kBeforeAll = -1; // No tappet of this place is done.
constexpr int32_t kAfterAll = 0x7fffffff;
constexpr int16_t kMaxEvents = sizeof(TappetData::aEvents) / sizeof(TappetEvent);

Place legEnd(const TappetState &state, int16_t leg) noexcept {
  return {state.aliLegPeriod.v[leg], state.afLegPosition.v[leg]};
}

void setLegEnd(TappetState &state, int16_t leg, Place place) noexcept {
  state.aliLegPeriod.v[leg] = place.period;
  state.afLegPosition.v[leg] = place.position;
}

void setDone(TappetState &state, Place place, int32_t tappet) noexcept {
  state.liDonePeriod = place.period;
  state.fDonePosition = place.position;
  state.diDoneTappet = tappet;
}

/// The master is at `place` after or before a leg: a leg towards smaller positions passes the
/// tappets there.
void setDoneAt(TappetState &state, Place place, bool negative) noexcept {
  setDone(state, place, negative ? kBeforeAll : kAfterAll);
}

/// From `from` to `to`. [master u]
double distance(const TappetList &list, Place from, Place to) noexcept {
  return static_cast<double>(to.period - from.period) * (list.end - list.start) +
         (to.position - from.position);
}

bool isBehind(Place place, Place other) noexcept {
  return place.period > other.period ||
         (place.period == other.period && place.position > other.position);
}

/// The first leg leads towards smaller positions.
bool isFirstNegative(const TappetState &state) noexcept {
  return (state.bNegative != 0) != ((state.iLegs - 1) % 2 != 0);
}

bool counts(const Tappet &tappet, bool negative) noexcept {
  return tappet.ctt == ::st::SM_DriveBasic::SMC_CAMTAPPETTYPE__TAPPET_all ||
         tappet.ctt == (negative ? ::st::SM_DriveBasic::SMC_CAMTAPPETTYPE__TAPPET_neg
                                 : ::st::SM_DriveBasic::SMC_CAMTAPPETTYPE__TAPPET_pos);
}

/// The next tappet of the first leg, or -1; `place` is where it is passed.
int32_t findNext(const TappetState &state, const TappetList &list, Place &place) noexcept {
  const bool negative = isFirstNegative(state);
  const Place end = legEnd(state, 0);
  const int64_t step = negative ? -1 : 1;
  int32_t best = -1;
  for (int32_t i = 0; i < list.count; ++i) {
    const Tappet &tappet = list.tappets[i];
    if (!counts(tappet, negative) || !(tappet.x >= list.start && tappet.x <= list.end))
      continue;
    const bool ahead =
        (negative ? tappet.x < state.fDonePosition : tappet.x > state.fDonePosition) ||
        (tappet.x == state.fDonePosition && i > state.diDoneTappet);
    if (!ahead && !list.periodic)
      continue;
    const Place here{ahead ? state.liDonePeriod : state.liDonePeriod + step, tappet.x};
    if (best >= 0 && !(negative ? isBehind(here, place) : isBehind(place, here)))
      continue;
    // Passed when reached, or when left.
    if (negative ? !isBehind(here, end) : isBehind(here, end))
      continue;
    best = i;
    place = here;
  }
  return best;
}

/// When the master was at `place`, on its way from the last call to this one.
int64_t timeOf(const TappetState &state, const TappetList &list, Place place) noexcept {
  const Place now{state.liPeriod, state.fPosition};
  const double way = exact::fabs(distance(list, {state.liLastPeriod, state.fLastPosition}, now));
  const double since = exact::fabs(distance(list, place, now));
  const int64_t cycle = state.liTime - state.liLastTime;
  if (!(since < way))
    return state.liLastTime;
  return state.liTime - static_cast<int64_t>(since / way * static_cast<double>(cycle) + 0.5);
}

} // namespace

TappetList tappetsOf(const CamRef &cam, bool periodic) noexcept {
  if (cam.wCamStructID != kCamStructId || cam.pt == nullptr || cam.nTappets <= 0)
    return {};
  return {cam.pt, cam.nTappets, cam.xStart, cam.xEnd, periodic};
}

void beginTappets(TappetState &state, Place place, int64_t now) noexcept {
  state.iLegs = 1;
  setLegEnd(state, 0, place);
  state.bNegative = 0;
  state.bMoved = 0;
  state.bPending = 0;
  state.liLastPeriod = state.liPeriod = place.period;
  state.fLastPosition = state.fPosition = place.position;
  state.liLastTime = state.liTime = now;
}

void followTappets(TappetState &state, const TappetList &list, Place place, double hysteresis,
                   int64_t now) noexcept {
  if (!exact::isfinite(place.position))
    return;
  state.liLastPeriod = state.liPeriod;
  state.fLastPosition = state.fPosition;
  state.liLastTime = state.liTime;
  state.liPeriod = place.period;
  state.fPosition = place.position;
  state.liTime = now;
  const auto last = static_cast<int16_t>(state.iLegs - 1);
  const Place reached = legEnd(state, last);
  const bool negative = isBehind(reached, place);
  if (!negative && !isBehind(place, reached))
    return;
  if (state.bMoved == 0) {
    state.bMoved = 1;
    state.bPending = 1;
    state.bNegative = negative;
    // What is under the master counts, at the seam of a periodic cam on both sides of it.
    const bool seam = !negative && list.periodic && reached.position == list.start;
    setDone(state, seam ? Place{reached.period - 1, list.end} : reached, kBeforeAll);
    setLegEnd(state, 0, place);
    return;
  }
  if (negative == (state.bNegative != 0)) {
    state.bPending = 1;
    setLegEnd(state, last, place);
    return;
  }
  if (exact::fabs(distance(list, reached, place)) <= hysteresis)
    return;
  if (state.bPending == 0)
    setDoneAt(state, reached, negative);
  else if (state.iLegs < kMaxLegs)
    ++state.iLegs;
  else
    return;
  state.bPending = 1;
  state.bNegative = negative;
  setLegEnd(state, static_cast<int16_t>(state.iLegs - 1), place);
}

bool nextTappet(TappetState &state, const TappetList &list, TappetEvent &event) noexcept {
  while (state.bPending != 0) {
    Place place;
    if (const int32_t index = findNext(state, list, place); index >= 0) {
      setDone(state, place, index);
      const Tappet &tappet = list.tappets[index];
      event.iGroupID = tappet.iGroupID;
      event.cta = tappet.cta;
      event.bNegative = isFirstNegative(state);
      event.dwDelay = tappet.dwDelay;
      event.dwDuration = tappet.dwDuration;
      event.liTime = timeOf(state, list, place);
      return true;
    }
    const Place turn = legEnd(state, 0);
    if (state.iLegs > 1) {
      for (int16_t i = 1; i < state.iLegs; ++i)
        setLegEnd(state, static_cast<int16_t>(i - 1), legEnd(state, i));
      --state.iLegs;
    } else {
      state.bPending = 0;
    }
    setDoneAt(state, turn, isFirstNegative(state));
  }
  return false;
}

void skipPeriods(TappetState &state) noexcept {
  if (state.bPending == 0)
    return;
  const int64_t periods = state.aliLegPeriod.v[0] - state.liDonePeriod;
  const int64_t whole = periods < 0 ? -periods : periods;
  if (whole <= 4)
    return;
  // Twice an inversion is none; on and off do nothing the second time.
  const int64_t skipped = (whole - 3) / 2 * 2;
  state.liDonePeriod += periods < 0 ? -skipped : skipped;
}

void beginReport(TappetData &data) noexcept {
  ++data.ulReports;
  data.iCount = 0;
}

void reportTappets(TappetData &data, TappetState &state, const TappetList &list) noexcept {
  while (data.iCount < kMaxEvents && nextTappet(state, list, data.aEvents.v[data.iCount]))
    ++data.iCount;
}

} // namespace stride::cam
