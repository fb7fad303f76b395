#include "runtime/motion/blocks/cam_course.hpp"

#include "runtime/axis/modulo_wrap.hpp"

namespace stride::motion {
namespace {

namespace number = ::st::SM_Error;

/// The master's position in the cam's units, over any number of periods.
cam::Total scaledMaster(const CamState &state, const MasterMotion &master) noexcept {
  const cam::Total way = state.fMasterStart == 0.0
                             ? master.position
                             : detail::add(master.position, {-state.fMasterStart, 0.0});
  if (state.fMasterScaling == 1.0 && state.fMasterShift == 0.0)
    return way;
  return cam::stretched(way, state.fMasterScaling, state.fMasterShift);
}

cam::Place placeIn(const CamState &state, const cam::Curve &curve, cam::Total master) noexcept {
  if (state.stCam.Periodic != 0)
    return cam::placeOf(master, curve.start, curve.end - curve.start);
  return {0, cam::toDouble(master)};
}

bool isFactor(double scaling) noexcept { return exact::isfinite(scaling) && scaling != 0.0; }

} // namespace

cam::Place placeInCam(const CamState &state, const cam::Curve &curve,
                      const MasterMotion &master) noexcept {
  return placeIn(state, curve, scaledMaster(state, master));
}

int16_t openCam(const CamId &id, cam::Curve &curve) noexcept {
  if (id.pCam == nullptr)
    return number::SMC_ERROR__SMC_CI_NO_CAM_SELECTED;
  curve = cam::curveOf(*id.pCam);
  if (curve.data == nullptr ||
      curve.count < (curve.form == cam::Form::Segments || curve.open ? 1 : 2) ||
      curve.form < cam::Form::EvenTable || curve.form > cam::Form::Segments ||
      !exact::isfinite(curve.start) || !exact::isfinite(curve.end) || !(curve.end > curve.start))
    return number::SMC_ERROR__SMC_NO_CAM_REF_TYPE;
  return number::SMC_ERROR__SMC_NO_ERROR;
}

int16_t enterCam(CamState &state, const cam::Curve &curve, const CamInputs &inputs,
                 const CamStart &start, const MasterMotion &master) noexcept {
  if (!exact::isfinite(inputs.masterOffset) || !exact::isfinite(inputs.slaveOffset) ||
      !isFactor(inputs.masterScaling) || !isFactor(inputs.slaveScaling))
    return number::SMC_ERROR__SMC_CI_SCALING_INCORRECT;
  state.fMasterScaling = inputs.masterScaling;
  state.fSlaveScaling = inputs.slaveScaling;
  state.fMasterShift = inputs.masterOffset;
  state.fMasterStart = state.stCam.MasterAbsolute != 0 ? 0.0 : start.masterZero;
  state.fSlaveShift = inputs.slaveOffset + (start.relative ? start.slaveBase : 0.0);
  const cam::Place place = placeInCam(state, curve, master);
  if (!(place.position >= curve.start && place.position <= curve.end))
    return number::SMC_ERROR__SMC_CI_MASTER_OUT_OF_SCALE;
  state.liFirstPeriod = place.period;
  state.liPeriod = place.period;
  return number::SMC_ERROR__SMC_NO_ERROR;
}

bool evaluateCam(CamState &state, const cam::Curve &curve, const MasterMotion &master,
                 const axis::AxisRef &slave, CamTarget &target) noexcept {
  const cam::Total total = scaledMaster(state, master);
  if (!exact::isfinite(total.hi) || !exact::isfinite(master.velocity) ||
      !exact::isfinite(master.acceleration))
    return false;
  const bool periodic = state.stCam.Periodic != 0;
  target.place = placeIn(state, curve, total);
  double x = target.place.position;
  target.outside = x < curve.start || x > curve.end;
  if (target.outside)
    x = x < curve.start ? curve.start : curve.end;
  const cam::Point point = cam::evaluateCurve(curve, x, periodic, state.udiIndex);
  const double scaling = state.fSlaveScaling;
  target.local = point.y * scaling;
  const int64_t periods = target.place.period - state.liFirstPeriod;
  target.rise =
      periods != 0 || target.place.period != state.liPeriod ? cam::riseOf(curve) * scaling : 0.0;
  // A shift of the slave's zero point is no motion.
  const double shift = state.fSlaveShift + (slave.fOffsetPosition - state.stFollow.fFirstOffset);
  const cam::Total position =
      detail::add(cam::totalOf(periods, target.rise, target.local), {shift, 0.0});
  const double velocity = target.outside ? 0.0 : master.velocity * state.fMasterScaling;
  const double acceleration = target.outside ? 0.0 : master.acceleration * state.fMasterScaling;
  target.state.velocity = point.v * velocity * scaling;
  target.state.acceleration = (point.a * velocity * velocity + point.v * acceleration) * scaling;
  target.state.position = axis::isRotary(slave)
                              ? cam::placeOf(position, 0.0, slave.fPositionPeriod).position
                              : cam::toDouble(position);
  return exact::isfinite(position.hi) && exact::isfinite(target.state.velocity) &&
         exact::isfinite(target.state.acceleration);
}

} // namespace stride::motion
