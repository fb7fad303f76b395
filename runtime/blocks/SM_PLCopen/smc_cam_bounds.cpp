// SMC_CAMBounds, SMC_CAMBounds_Pos: the extreme set values of a slave that follows a cam.
#include "runtime/axis/axis_ref.hpp"
#include "runtime/axis/cam/cam_ref.hpp"
#include "runtime/numeric/cam/bounds.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_PLCopen/SMC_CAMBounds.h"
#include "st/SM_PLCopen/SMC_CAMBounds_Pos.h"

namespace {

namespace cam = ::stride::cam;
namespace exact = ::stride::exact;
namespace number = ::st::SM_Error;
using BoundsState = ::st::SM_PLCopen::SMC_CAM_BOUNDS_STATE;

constexpr int16_t kNoError = number::SMC_ERROR__SMC_NO_ERROR;

/// Pieces that one call looks at: about 0.1 ms.
uint32_t portionOf(const cam::Curve &curve) noexcept {
  return curve.form == cam::Form::EvenTable || curve.form == cam::Form::PairTable ? 128 : 16;
}

/// An SMC_ERROR: what can be seen without looking at the places.
int16_t open(const cam::CamRef *ref, cam::Curve &curve) noexcept {
  if (ref == nullptr || ref->wCamStructID != cam::kCamStructId)
    return number::SMC_ERROR__SMC_NO_CAM_REF_TYPE;
  const auto form = static_cast<cam::Form>(ref->byType);
  const bool table = form == cam::Form::EvenTable || form == cam::Form::PairTable;
  if ((!table && form != cam::Form::Nodes && form != cam::Form::Segments) ||
      (table && cam::sizeOf(static_cast<cam::Element>(ref->byVarType)) == 0))
    return number::SMC_ERROR__SMC_CB_NOT_IMPLEMENTED;
  curve = cam::curveOf(*ref);
  return cam::errorOf(cam::checkForm(curve));
}

void store(BoundsState &state, const cam::Bounds &bounds) noexcept {
  state.fLowPosition = bounds.position.low;
  state.fHighPosition = bounds.position.high;
  state.fLowVelocity = bounds.velocity.low;
  state.fHighVelocity = bounds.velocity.high;
  state.fLowAcceleration = bounds.acceleration.low;
  state.fHighAcceleration = bounds.acceleration.high;
}

cam::Bounds load(const BoundsState &state) noexcept {
  return {{state.fLowPosition, state.fHighPosition},
          {state.fLowVelocity, state.fHighVelocity},
          {state.fLowAcceleration, state.fHighAcceleration}};
}

/// The next portion; an SMC_ERROR.
int16_t goOn(BoundsState &state, const cam::CamRef *ref) noexcept {
  cam::Curve curve;
  if (const int16_t error = open(ref, curve); error != kNoError)
    return error;
  const uint32_t pieces = cam::pieceCount(curve);
  if (state.udiNext >= pieces) { // the program has shortened the cam
    state.bRunning = 0;
    return kNoError;
  }
  const uint32_t left = pieces - state.udiNext;
  const uint32_t portion = left < portionOf(curve) ? left : portionOf(curve);
  // A cubic table's slopes come from the places around a piece, at its ends round the corner.
  const uint32_t first = state.udiNext > 0 ? state.udiNext - 1 : 0;
  const uint32_t end = state.udiNext + portion < pieces ? state.udiNext + portion + 1 : pieces;
  if (!cam::areGoodPieces(curve, first, end) || !cam::areGoodPieces(curve, 0, 1) ||
      !cam::areGoodPieces(curve, pieces - 1, pieces))
    return number::SMC_ERROR__SMC_NO_CAM_REF_TYPE;
  cam::Bounds bounds = load(state);
  cam::includePieces(curve, state.udiNext, portion, {state.fVelocity, state.fAcceleration}, bounds);
  store(state, bounds);
  state.udiNext += portion;
  state.bRunning = state.udiNext < pieces;
  return kNoError;
}

/// One call. `begin` sets the factors and returns an SMC_ERROR; `show` is given the bounds.
template <class Block, class Begin, class Show>
void run(Block &block, const Begin &begin, const Show &show) noexcept {
  BoundsState &state = block.stBounds;
  const bool execute = block.bExecute != 0;
  const bool rising = execute && state.bExecuteOld == 0;
  state.bExecuteOld = execute;
  if (!execute || rising) {
    block.bDone = 0;
    block.bError = 0;
    block.nErrorID = kNoError;
    state.bRunning = 0;
  }
  int16_t error = kNoError;
  if (rising) {
    store(state, {});
    state.udiNext = 0;
    state.bRunning = 1;
    error = begin(state);
    show(cam::Bounds{{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}});
  }
  if (state.bRunning != 0) {
    if (error == kNoError)
      error = goOn(state, block.CAM);
    if (error != kNoError) {
      state.bRunning = 0;
      block.bError = 1;
      block.nErrorID = error;
    } else if (state.bRunning == 0) {
      show(cam::scaledBounds(load(state), state.fFactor));
      block.bDone = 1;
    }
  }
  block.bBusy = state.bRunning;
}

bool isScaling(double factor) noexcept { return exact::isfinite(factor) && factor != 0.0; }

} // namespace

void st::SM_PLCopen::SMC_CAMBounds::body__(::stride::Ctx & /*ctx__*/) {
  run(
      *this,
      [this](BoundsState &state) -> int16_t {
        if (!isScaling(dMasterScaling) || !isScaling(dSlaveScaling))
          return number::SMC_ERROR__SMC_CI_SCALING_INCORRECT;
        state.fVelocity = exact::fabs(dMasterVelMax * dMasterScaling);
        state.fAcceleration = exact::fabs(dMasterAccMax * dMasterScaling);
        state.fFactor = dSlaveScaling;
        return exact::isfinite(state.fVelocity) && exact::isfinite(state.fAcceleration)
                   ? kNoError
                   : int16_t{number::SMC_ERROR__SMC_INVALID_PARAMETER};
      },
      [this](const cam::Bounds &bounds) {
        dMinPos = bounds.position.low;
        dMaxPos = bounds.position.high;
        dMinVel = bounds.velocity.low;
        dMaxVel = bounds.velocity.high;
        dMinAccDec = bounds.acceleration.low;
        dMaxAccDec = bounds.acceleration.high;
      });
}

void st::SM_PLCopen::SMC_CAMBounds_Pos::body__(::stride::Ctx & /*ctx__*/) {
  run(
      *this,
      [](BoundsState &state) -> int16_t {
        state.fVelocity = 1.0;
        state.fAcceleration = 0.0;
        state.fFactor = 1.0;
        return kNoError;
      },
      [this](const cam::Bounds &bounds) {
        dMinPos = bounds.position.low;
        dMaxPos = bounds.position.high;
      });
}
