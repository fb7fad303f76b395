// Which tappets of a cam a master passes from cycle to cycle. Free of the C++ standard library.
//
// A pass is a change of side: a master at a tappet counts as beyond it. So a tappet is passed
// towards greater positions when it is reached, towards smaller ones when it is left; nothing is
// passed twice or left out, however the master moves. One exception: a tappet under the master at
// the start is passed when the master leaves it, in either direction.
#ifndef STRIDE_RUNTIME_AXIS_CAM_TAPPETS_HPP
#define STRIDE_RUNTIME_AXIS_CAM_TAPPETS_HPP

#include "runtime/axis/cam/cam_ref.hpp"
#include "runtime/numeric/cam/period.hpp"

#include "st/SM_PLCopen/SMC_TAPPET_EVENT.h"
#include "st/SM_PLCopen/SMC_TAPPET_STATE.h"
#include "st/SM_PLCopen/SMC_TappetData.h"

namespace stride::cam {

using TappetData = ::st::SM_PLCopen::SMC_TappetData;
using TappetEvent = ::st::SM_PLCopen::SMC_TAPPET_EVENT;
using TappetState = ::st::SM_PLCopen::SMC_TAPPET_STATE;

/// The tappets of a cam, good for one call of a block. Owns nothing.
struct TappetList {
  const Tappet *tappets = nullptr;
  int32_t count = 0;
  double start = 0.0; ///< Of the cam. Tappets outside of [start, end] do not exist. [master u]
  double end = 0.0;   ///< [master u]
  bool periodic = false;
};

/// The tappets of `cam`; none if it has none, or is no cam.
TappetList tappetsOf(const CamRef &cam, bool periodic) noexcept;

/// Starts with the master at `place`: Place{0, x} with any x if the cam is not periodic, not
/// confined to the cam. `now` is the task's clock (Ctx::cycleStartNs). [ns]
void beginTappets(TappetState &state, Place place, int64_t now) noexcept;

/// The master has moved on to `place`. It turns round when it has come back by more than
/// `hysteresis`; before, it has not moved. [master u] Passes accumulate until nextTappet takes
/// them. A seventeenth turn before all is taken is seen when there is room for it.
void followTappets(TappetState &state, const TappetList &list, Place place, double hysteresis,
                   int64_t now) noexcept;

/// Takes the next pass, in the order in which they happened; tappets at one place in the order of
/// the list. False if there is none.
bool nextTappet(TappetState &state, const TappetList &list, TappetEvent &event) noexcept;

/// Leaves out whole periods of a long leg whose passes would not change a bit that was switched by
/// the others: what remains is at most four periods. For who takes all passes of a cycle.
void skipPeriods(TappetState &state) noexcept;

/// A cycle of MC_CamIn has nothing to report yet.
void beginReport(TappetData &data) noexcept;

/// As many passes into `data` as there is room for, three in a cycle; the rest comes in the next
/// cycles.
void reportTappets(TappetData &data, TappetState &state, const TappetList &list) noexcept;

} // namespace stride::cam

#endif
