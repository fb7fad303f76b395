// SMC_CAMRegister: the tappets of a cam without its curve.
#include "runtime/axis/cam/tappet_bits.hpp"
#include "runtime/axis/master.hpp"
#include "runtime/iec/ctx.h"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_PLCopen/SMC_CAMRegister.h"

namespace {

namespace axis = ::stride::axis;
namespace cam = ::stride::cam;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Register = ::st::SM_PLCopen::SMC_CAMRegister;

constexpr int16_t kGroups = sizeof(Register::abTimed) / sizeof(::stride::BOOL);

/// Why the tappets cannot be switched, or kNone.
int16_t registerProblem(const Register &block) noexcept {
  if (block.Master == nullptr)
    return axis::error::kNoAxis;
  const cam::CamRef *table = block.CamTable;
  if (table == nullptr || block.bTappet == nullptr || table->wCamStructID != cam::kCamStructId ||
      !(table->xStart < table->xEnd) || !exact::isfinite(table->xEnd - table->xStart))
    return ::st::SM_Error::SMC_ERROR__SMC_NO_CAM_REF_TYPE;
  if (table->nTappets <= 0 || table->pt == nullptr)
    return ::st::SM_Error::SMC_ERROR__SMC_CR_NO_TAPPETS_IN_CAM;
  for (int16_t i = 0; i < table->nTappets; ++i)
    if (table->pt[i].iGroupID < 1 || table->pt[i].iGroupID > kGroups)
      return ::st::SM_Error::SMC_ERROR__SMC_CR_TOO_MANY_TAPPETS;
  if (!exact::isfinite(block.MasterOffset) || !exact::isfinite(block.MasterScaling) ||
      !exact::isfinite(block.TappetHysteresis) || !exact::isfinite(block.DeadTimeCompensation))
    return axis::error::kOutOfRange;
  return axis::error::kNone;
}

/// Takes back what only times have made TRUE.
void releaseTimed(Register &block) noexcept {
  for (int16_t i = 0; i < kGroups; ++i)
    if (block.abTimed.v[i] != 0) {
      block.abTimed.v[i] = 0;
      block.bTappet->v[i] = 0;
    }
}

void stopRegister(Register &block) noexcept {
  if (block.bRunning != 0 && block.bTappet != nullptr)
    releaseTimed(block);
  block.bRunning = 0;
  block.iTimers = 0;
}

void switchPassed(Register &block, const cam::TappetList &list,
                  const cam::TappetTimers &times) noexcept {
  cam::skipPeriods(block.stTappets);
  cam::TappetEvent event;
  while (cam::nextTappet(block.stTappets, list, event)) {
    auto &shown = block.bTappet->v[event.iGroupID - 1];
    bool bit = shown != 0;
    cam::switchTappet(bit, times, event);
    shown = bit;
  }
}

void runRegister(Register &block, int64_t now) noexcept {
  const bool fresh = block.bRunning == 0;
  const motion::MasterMotion master = fresh ? motion::beginMaster(block.stMaster, *block.Master)
                                            : motion::readMaster(block.stMaster, *block.Master);
  const cam::CamRef &table = *block.CamTable;
  const double ahead = master.velocity * block.DeadTimeCompensation;
  const cam::Place place =
      cam::placeOf(cam::stretched(master.position, block.MasterScaling,
                                  block.MasterOffset + block.MasterScaling * ahead),
                   table.xStart, table.xEnd - table.xStart);
  const cam::TappetTimers times{block.aTimers.v, kGroups, block.iTimers};
  if (fresh || block.fScaling != block.MasterScaling) {
    cam::beginTappets(block.stTappets, place, now);
    block.fScaling = block.MasterScaling;
    block.bRunning = 1;
  }
  block.EndOfProfile = place.period != block.stTappets.liPeriod;
  releaseTimed(block);
  const cam::TappetList list = cam::tappetsOf(table, true);
  cam::followTappets(block.stTappets, list, place, block.TappetHysteresis, now);
  switchPassed(block, list, times);
  for (int16_t i = 0; i < block.iTimers; ++i) {
    const auto group = block.aTimers.v[i].iGroupID;
    if (block.bTappet->v[group - 1] == 0 && cam::isTimed(times, group, now)) {
      block.bTappet->v[group - 1] = 1;
      block.abTimed.v[group - 1] = 1;
    }
  }
  cam::forgetTimes(times, now);
}

} // namespace

void st::SM_PLCopen::SMC_CAMRegister::body__(::stride::Ctx &ctx__) {
  EndOfProfile = 0;
  if (Enable == 0) {
    stopRegister(*this);
    Error = 0;
    ErrorID = axis::error::kNone;
    return;
  }
  if (Error != 0)
    return;
  if (const int16_t problem = registerProblem(*this); problem != axis::error::kNone) {
    stopRegister(*this);
    Error = 1;
    ErrorID = problem;
    if (Master != nullptr)
      axis::noteError(*Master, problem);
    return;
  }
  runRegister(*this, ctx__.cycleStartNs);
}
