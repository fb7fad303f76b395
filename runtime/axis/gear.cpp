#include "runtime/axis/gear.hpp"

namespace stride::motion {
namespace {

cam::Total negated(cam::Total total) noexcept { return {-total.hi, -total.lo}; }

} // namespace

void engageGear(GearState &gear, const AxisRef &ref, cam::Total master, cam::Total slave,
                cam::Total last) noexcept {
  gear.bEngaged = 1;
  gear.fMaster = master.hi;
  gear.fMasterRest = master.lo;
  gear.fSlave = slave.hi;
  gear.fSlaveRest = slave.lo;
  gear.fOffset = ref.fOffsetPosition;
  gear.fLast = last.hi;
  gear.fLastRest = last.lo;
}

void turnGear(GearState &gear, FollowState &follow, AxisRef &ref, const MasterMotion &master,
              const numeric::MotionState &added) noexcept {
  const cam::Total driven = detail::add(master.position, negated({gear.fMaster, gear.fMasterRest}));
  cam::Total total = detail::multiply(driven, {gear.fNumerator, 0.0});
  if (gear.fDenominator != 1.0)
    total = detail::divide(total, {gear.fDenominator, 0.0});
  total = detail::add(total, {gear.fSlave, gear.fSlaveRest});
  total = detail::add(total, {added.position, 0.0});
  const double way = cam::toDouble(detail::add(total, negated({gear.fLast, gear.fLastRest})));
  gear.fLast = total.hi;
  gear.fLastRest = total.lo;
  const double shift = ref.fOffsetPosition - gear.fOffset;
  const double position = axis::isRotary(ref)
                              ? cam::placeOf(total, 0.0, ref.fPositionPeriod).position
                              : cam::toDouble(total);
  const double factor = gearFactor(gear);
  followState(follow, ref,
              {position + shift, factor * master.velocity + added.velocity,
               factor * master.acceleration + added.acceleration},
              way);
}

} // namespace stride::motion
