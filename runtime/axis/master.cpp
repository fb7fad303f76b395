#include "runtime/axis/master.hpp"

#include "runtime/numeric/modulo_wrap.hpp"

namespace stride::motion {
namespace {

struct Seen {
  double position; ///< As shown.
  double velocity;
  double acceleration;
};

Seen see(const axis::AxisRef &ref, bool actual) noexcept {
  if (!actual)
    return {ref.fSetPosition, ref.fSetVelocity, ref.fSetAcceleration};
  return {ref.fActPosition, ref.fActVelocity, ref.fActAcceleration};
}

bool isActual(const axis::AxisRef &ref, MasterView view) noexcept {
  return view == MasterView::Actual || (view == MasterView::Auto && ref.bRegulatorOn == 0);
}

/// The shown position without what the zero point has been shifted by since the first look.
double withoutShift(const MasterState &master, const axis::AxisRef &ref, double shown) noexcept {
  const double shift = ref.fOffsetPosition - master.fOffset;
  if (shift == 0.0)
    return shown;
  return axis::isRotary(ref) ? numeric::wrapPosition(shown - shift, ref.fPositionPeriod)
                             : shown - shift;
}

/// Periods, rounded to the nearest whole number.
int64_t nearest(double periods) noexcept {
  if (!(exact::fabs(periods) < 4503599627370496.0))
    return 0;
  return static_cast<int64_t>(periods + (periods < 0.0 ? -0.5 : 0.5));
}

/// The next look, `cycle` [s] after the last one. `period` is 0 for none. [u]
MasterMotion lookAgain(MasterState &master, const Seen &seen, double period,
                       double cycle) noexcept {
  double travel = seen.position - master.fPosition;
  const bool rotary = period > 0.0;
  if (rotary) {
    const double expected = 0.5 * (master.fVelocity + seen.velocity) * cycle;
    const double missing = expected - travel;
    if (!(exact::fabs(missing) < 0.5 * period)) {
      const int64_t turns = nearest(missing / period);
      master.liTurns += turns;
      travel += static_cast<double>(turns) * period;
    }
  }
  master.fPosition = seen.position;
  master.fVelocity = seen.velocity;
  return {rotary ? cam::totalOf(master.liTurns, period, seen.position)
                 : cam::Total{seen.position, 0.0},
          seen.velocity, seen.acceleration, travel};
}

double shownOf(const Signal &signal) noexcept {
  return signal.period > 0.0 ? numeric::wrapPosition(signal.position, signal.period)
                             : signal.position;
}

} // namespace

MasterMotion beginMaster(MasterState &master, axis::AxisRef &ref, MasterView view) noexcept {
  master.bActual = isActual(ref, view);
  const Seen seen = see(ref, master.bActual != 0);
  master.pAxis = &ref;
  master.fOffset = ref.fOffsetPosition;
  master.liTurns = 0;
  master.fPosition = seen.position;
  master.fVelocity = seen.velocity;
  return {{seen.position, 0.0}, seen.velocity, seen.acceleration, 0.0};
}

MasterMotion readMaster(MasterState &master, axis::AxisRef &ref, MasterView view) noexcept {
  master.bActual = isActual(ref, view);
  master.pAxis = &ref;
  const Seen seen = see(ref, master.bActual != 0);
  const double position = withoutShift(master, ref, seen.position);
  return lookAgain(master, {position, seen.velocity, seen.acceleration},
                   axis::isRotary(ref) ? ref.fPositionPeriod : 0.0, ref.fTaskCycle);
}

MasterMotion beginSignal(MasterState &state, const Signal &signal) noexcept {
  state.bActual = 0;
  state.pAxis = nullptr;
  state.fOffset = 0.0;
  state.liTurns = 0;
  state.fPosition = shownOf(signal);
  state.fVelocity = signal.velocity;
  return {{state.fPosition, 0.0}, signal.velocity, signal.acceleration, 0.0};
}

MasterMotion readSignal(MasterState &state, const Signal &signal, double cycle) noexcept {
  return lookAgain(state, {shownOf(signal), signal.velocity, signal.acceleration}, signal.period,
                   cycle);
}

} // namespace stride::motion
