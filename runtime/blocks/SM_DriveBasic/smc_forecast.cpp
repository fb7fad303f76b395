// SMC_ReadSetValues and SMC_GetTravelTime: what an axis is going to do.
#include "runtime/axis/forecast.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_DriveBasic/SMC_GetTravelTime.h"
#include "st/SM_DriveBasic/SMC_ReadSetValues.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
using axis::AxisRef;
using stride::motion::Forecast;
using stride::motion::State;

constexpr int16_t kInvalid = ::st::SM_Error::SMC_ERROR__SMC_INVALID_PARAMETER;

/// How far ahead the axis is looked at: at least to the end of this cycle. [s]
double horizonOf(const AxisRef &ref) noexcept {
  return ref.fForecast > ref.fTaskCycle ? ref.fForecast : ref.fTaskCycle;
}

template <class Block> void fail(Block &block, int16_t errorId) noexcept {
  block.Error = 1;
  block.ErrorID = errorId;
  // These blocks say the same in every call.
  if (block.Axis != nullptr && !axis::isNewestError(*block.Axis, errorId))
    axis::noteError(*block.Axis, errorId);
}

/// First in both blocks. False: nothing to do.
template <class Block> bool begin(Block &block) noexcept {
  block.Busy = block.Enable;
  block.Valid = 0;
  block.Error = 0;
  block.ErrorID = axis::error::kNone;
  if (block.Enable == 0)
    return false;
  if (block.Axis == nullptr)
    fail(block, axis::error::kNoAxis);
  else if (!(block.Axis->fTaskCycle > 0.0))
    fail(block, axis::error::kTaskCycleEmpty);
  return block.Error == 0;
}

/// A place on an axis, and when it is passed.
class Place {
public:
  Place(const AxisRef &ref, double position) noexcept
      : period_(axis::isRotary(ref) ? ref.fPositionPeriod : 0.0), position_(position) {}

  /// Whether the way from `from` to `to` leads there; `goal` is the place on that way then.
  bool isOnWay(double from, double to, double &goal) const noexcept {
    const double side = to < from ? -1.0 : 1.0;
    double ahead = side * (position_ - from);
    double slack = 0.0;
    if (period_ > 0.0) {
      slack = 1e-15 * (exact::fabs(from) + exact::fabs(to) + period_);
      ahead = stride::numeric::wrapPosition(ahead, period_);
      if (period_ - ahead <= slack) // just there
        ahead = 0.0;
    }
    goal = from + side * ahead;
    if (ahead > side * (to - from)) // rounding must not keep it from its target
      goal = to;
    return ahead >= 0.0 && ahead <= side * (to - from) + slack;
  }

private:
  double period_; ///< 0: linear.
  double position_;
};

/// The first instant between `early` and `late` at which `passed` holds; at `late` it does.
/// `before` has not gone beyond `early`.
template <class Passed>
double firstTime(const Forecast &before, double early, double late, double precision,
                 Passed passed) noexcept {
  while (late - early > precision) {
    const double middle = 0.5 * (early + late);
    Forecast probe = before;
    State state{};
    double jerk = 0.0;
    if (!probe.at(middle, state, jerk) || passed(state))
      late = middle;
    else
      early = middle;
  }
  return late;
}

/// When the axis is at the place for the first time, at most `horizon` ahead. False: not known or
/// not at all.
bool findTravelTime(const AxisRef &ref, const Place &place, double horizon, double &time) noexcept {
  Forecast forecast(ref);
  State from{};
  State to{};
  double jerk = 0.0;
  double goal = 0.0;
  (void)forecast.at(0.0, from, jerk);
  time = 0.0;
  if (place.isOnWay(from.position, from.position, goal))
    return true;
  const double cycle = ref.fTaskCycle;
  const double precision = 1e-9 * cycle;
  const auto precede = [&ref](double t) {
    Forecast ahead(ref);
    State state{};
    double unused = 0.0;
    (void)ahead.at(t, state, unused);
    return ahead;
  };
  double early = 0.0;
  while (early < horizon) {
    const double next = early + cycle;
    double late = next + precision < horizon ? next : horizon;
    if (!forecast.at(late, to, jerk))
      return false;
    // Where it turns back within the cycle, it may be there before it turns.
    if (from.velocity * to.velocity < 0.0) {
      const Forecast before = precede(early);
      const bool forward = from.velocity > 0.0;
      const double turn = firstTime(before, early, late, precision, [forward](const State &state) {
        return (state.velocity > 0.0) != forward;
      });
      Forecast probe = before;
      State highest{};
      if (probe.at(turn, highest, jerk) && place.isOnWay(from.position, highest.position, goal)) {
        to = highest;
        late = turn;
      }
    }
    if (place.isOnWay(from.position, to.position, goal)) {
      const bool up = to.position >= from.position;
      time = firstTime(precede(early), early, late, precision, [up, goal](const State &state) {
        return up ? state.position >= goal : state.position <= goal;
      });
      return true;
    }
    from = to;
    early = late;
  }
  return false;
}

} // namespace

void st::SM_DriveBasic::SMC_ReadSetValues::body__(::stride::Ctx & /*ctx__*/) {
  if (!begin(*this))
    return;
  const AxisRef &ref = *Axis;
  const double horizon = horizonOf(ref) + 1e-9 * ref.fTaskCycle;
  if (!(TimeOffset >= 0.0 && TimeOffset <= horizon)) {
    fail(*this, kInvalid);
    return;
  }
  Forecast forecast(ref);
  State state{};
  double jerk = 0.0;
  if (!forecast.at(TimeOffset, state, jerk))
    return;
  Position = axis::shownPosition(ref, state.position);
  Velocity = state.velocity;
  Acceleration = state.acceleration;
  Jerk = jerk;
  Valid = 1;
}

void st::SM_DriveBasic::SMC_GetTravelTime::body__(::stride::Ctx & /*ctx__*/) {
  if (!begin(*this))
    return;
  if (!exact::isfinite(Position)) {
    fail(*this, kInvalid);
    return;
  }
  double time = 0.0;
  if (!findTravelTime(*Axis, Place(*Axis, Position), horizonOf(*Axis), time))
    return;
  Duration = time;
  Valid = 1;
}
