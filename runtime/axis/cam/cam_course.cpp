#include "runtime/axis/cam/cam_course.hpp"

#include "runtime/numeric/modulo_wrap.hpp"

namespace stride::motion {
namespace {

namespace number = ::st::SM_Error;

bool isFactor(double scaling) noexcept { return exact::isfinite(scaling) && scaling != 0.0; }

/// The master's position in the cam's units, over any number of periods.
cam::Total scaledMaster(const CamState &state, const MasterMotion &master) noexcept {
  const CamCommand &command = state.stCommand;
  const cam::Total way = state.fMasterStart == 0.0
                             ? master.position
                             : detail::add(master.position, {-state.fMasterStart, 0.0});
  if (command.fMasterScaling == 1.0 && command.fMasterOffset == 0.0)
    return way;
  return cam::stretched(way, command.fMasterScaling, command.fMasterOffset);
}

cam::Place placeOf(const CamState &state, const cam::Curve &curve, cam::Total master) noexcept {
  if (state.stCommand.stCam.Periodic != 0)
    return cam::placeOf(master, curve.start, curve.end - curve.start);
  return {0, cam::toDouble(master)};
}

/// Whether the place is in the cam, but for the rounding of a joint that has been computed.
bool holds(const cam::Curve &curve, double x) noexcept {
  const double haze = 1e-12 * (exact::fabs(curve.start) + exact::fabs(curve.end));
  return x >= curve.start - haze && x <= curve.end + haze;
}

/// Whether the cam is as long as a turn of the master and begins where that does, as most are: then
/// its periods are the turns, and there is nothing to compute.
bool isInStep(const CamState &state, const cam::Curve &curve) noexcept {
  const CamCommand &command = state.stCommand;
  const axis::AxisRef &master = *state.stMaster.pAxis;
  return command.stCam.Periodic != 0 && state.fMasterStart == 0.0 &&
         command.fMasterScaling == 1.0 && command.fMasterOffset == 0.0 && curve.start == 0.0 &&
         curve.end == master.fPositionPeriod && axis::isRotary(master) &&
         state.stMaster.fPosition >= 0.0 && state.stMaster.fPosition < curve.end;
}

/// A master that is less than a rounding before the first start is at the start: a shift of its
/// zero point must not lead it into the period before.
cam::Place notBefore(const CamState &state, const cam::Curve &curve, cam::Place place) noexcept {
  const bool justBefore = state.stCommand.stCam.Periodic != 0 &&
                          place.period == state.liFirstPeriod - 1 &&
                          curve.end - place.position < 1e-12 * (curve.end - curve.start);
  return justBefore ? cam::Place{state.liFirstPeriod, curve.start} : place;
}

} // namespace

int16_t checkCamInputs(const CamCommand &command) noexcept {
  const bool good = exact::isfinite(command.fMasterOffset) &&
                    exact::isfinite(command.fSlaveOffset) && isFactor(command.fMasterScaling) &&
                    isFactor(command.fSlaveScaling);
  return good ? number::SMC_ERROR__SMC_NO_ERROR : number::SMC_ERROR__SMC_CI_SCALING_INCORRECT;
}

int16_t openCam(const CamId &id, cam::Curve &curve) noexcept {
  if (id.pCam == nullptr)
    return number::SMC_ERROR__SMC_CI_NO_CAM_SELECTED;
  curve = cam::curveOf(*id.pCam);
  return cam::errorOf(cam::checkForm(curve));
}

cam::Place placeInCam(const CamState &state, const cam::Curve &curve,
                      const MasterMotion &master) noexcept {
  return placeOf(state, curve, scaledMaster(state, master));
}

int16_t enterCam(CamState &state, const cam::Curve &curve, const CamStart &start,
                 const MasterMotion &master) noexcept {
  state.fMasterStart = state.stCommand.stCam.MasterAbsolute != 0 ? 0.0 : start.masterZero;
  state.fSlaveShift = state.stCommand.fSlaveOffset + (start.relative ? start.slaveBase : 0.0);
  MasterMotion atStart = master;
  atStart.position = {start.masterZero, 0.0};
  if (!holds(curve, cam::toDouble(scaledMaster(state, atStart))))
    return number::SMC_ERROR__SMC_CI_MASTER_OUT_OF_SCALE;
  state.liFirstPeriod = 0;
  state.liPeriod = placeInCam(state, curve, master).period;
  return number::SMC_ERROR__SMC_NO_ERROR;
}

double slavePosition(const CamState &state, const axis::AxisRef &slave, int64_t periods,
                     double rise, double local) noexcept {
  // A shift of the slave's zero point is no motion.
  const double shift = state.fSlaveShift + (slave.fOffsetPosition - state.stFollow.fFirstOffset);
  const double period = slave.fPositionPeriod;
  if (!axis::isRotary(slave))
    return cam::toDouble(detail::add(cam::totalOf(periods, rise, local), {shift, 0.0}));
  if (rise == period || rise == -period) // whole turns
    periods = 0;
  return cam::placeOf(detail::add(cam::totalOf(periods, rise, local), {shift, 0.0}), 0.0, period)
      .position;
}

bool evaluateCam(CamState &state, const cam::Curve &curve, const MasterMotion &master,
                 const axis::AxisRef &slave, CamTarget &target) noexcept {
  const CamCommand &command = state.stCommand;
  const bool inStep = isInStep(state, curve);
  const cam::Total total = inStep ? master.position : scaledMaster(state, master);
  target.place = inStep ? cam::Place{state.stMaster.liTurns, state.stMaster.fPosition}
                        : notBefore(state, curve, placeOf(state, curve, total));
  double x = target.place.position;
  target.outside = x < curve.start || x > curve.end;
  if (target.outside)
    x = x < curve.start ? curve.start : curve.end;
  const cam::Point point =
      cam::evaluateCurve(curve, x, command.stCam.Periodic != 0, state.udiIndex);
  const double scaling = command.fSlaveScaling;
  const int64_t periods = target.place.period - state.liFirstPeriod;
  target.local = point.y * scaling;
  target.rise =
      periods != 0 || target.place.period != state.liPeriod ? cam::riseOf(curve) * scaling : 0.0;
  target.velocity = master.velocity * command.fMasterScaling;
  target.acceleration = master.acceleration * command.fMasterScaling;
  target.state = {slavePosition(state, slave, periods, target.rise, target.local), 0.0, 0.0};
  if (!target.outside) {
    const double v = target.velocity;
    target.state.velocity = point.v * v * scaling;
    target.state.acceleration = (point.a * v * v + point.v * target.acceleration) * scaling;
  }
  return exact::isfinite(total.hi) && exact::isfinite(target.rise) &&
         exact::isfinite(target.local) && exact::isfinite(target.state.position) &&
         exact::isfinite(target.state.velocity) && exact::isfinite(target.state.acceleration);
}

} // namespace stride::motion
