// The numerics of a path of a TSX CSY 85, for CSY_PATH.
// Source: TSX CSY 85 configuration manual 35010452, chapter 4.
#include "runtime/numeric/csy/modulated_move.hpp"
#include "runtime/numeric/csy/trajectory_speeds.hpp"

#include "st/CSY/CSY_PATH_STATE.h"
#include "st/CSY/CSY_PathConstantSpeed.h"
#include "st/CSY/CSY_PathGoOn.h"
#include "st/CSY/CSY_PathMove.h"
#include "st/CSY/CSY_PathRead.h"
#include "st/CSY/CSY_PathResults.h"
#include "st/CSY/CSY_PathWork.h"

namespace csy = ::stride::csy;
using ::st::CSY::CSY_PATH_STATE;

namespace {

/// What CSY_PATH_STATE keeps between the calls.
struct Path {
  csy::TrajectoryTable table;
  csy::Trajectory trajectory;
  csy::Speeds speeds;
  csy::CamCursor cursor;
  csy::ModulatedMove move;
};

static_assert(sizeof(Path) == sizeof(CSY_PATH_STATE::aState));
static_assert(alignof(Path) <= alignof(uint64_t));

/// In one call: some pieces take as long as many points.
constexpr int32_t kPiecesPerCall = 8;
constexpr int32_t kPointsPerCall = 128;

Path &pathOf(CSY_PATH_STATE &state) noexcept { return *reinterpret_cast<Path *>(&state.aState); }

csy::SlaveLimits limitsOf(const CSY_PATH_STATE &state) noexcept {
  return {{state.afVelocity.v[0], state.afVelocity.v[1], state.afVelocity.v[2]},
          {state.afAcceleration.v[0], state.afAcceleration.v[1], state.afAcceleration.v[2]}};
}

/// The lower word first.
void writeReal(double value, ::stride::WORD *words) noexcept {
  const auto bits = __builtin_bit_cast(uint32_t, static_cast<float>(value));
  words[0] = static_cast<::stride::WORD>(bits);
  words[1] = static_cast<::stride::WORD>(bits >> 16);
}

void fillPoint(CSY_PATH_STATE &state, const csy::CamPoint &point) noexcept {
  const double slave[3] = {point.slave.x, point.slave.y, point.slave.z};
  for (int32_t axis = 0; axis < state.iAxes; ++axis) {
    state.apMaster.v[axis][state.diFilled] = point.master * state.afMasterUnit.v[axis];
    state.apSlave.v[axis][state.diFilled] = slave[axis] * state.afSlaveUnit.v[axis];
  }
  ++state.diFilled;
}

} // namespace

int16_t st::CSY::CSY_PathRead(::stride::Ctx & /*ctx__*/, CSY_PATH_STATE &state,
                              ::stride::WORD *pTable, int32_t diLength, int16_t iMostPoints) {
  Path &path = pathOf(state);
  state.diSpeeds = 0;
  state.diFilled = 0;
  state.diCamPoints = 0;
  state.fLength = 0.0;
  path.cursor = {};
  csy::Problem problem =
      csy::readTable(reinterpret_cast<const int16_t *>(pTable), static_cast<uint32_t>(diLength),
                     static_cast<uint32_t>(iMostPoints), path.table);
  if (problem.error == csy::PathError::None) {
    state.diPoints = static_cast<int32_t>(path.table.points);
    state.iAxes = static_cast<int16_t>(path.table.axes);
    for (int32_t i = 0; i < 3; ++i)
      state.aiAxis.v[i] = path.table.axisIds[i];
    problem = csy::computeTrajectory(path.table, path.trajectory);
  }
  state.diErrorPoint = static_cast<int32_t>(problem.point);
  if (problem.error == csy::PathError::None) {
    state.diCamPoints = static_cast<int32_t>(path.trajectory.camPoints);
    state.diLoopPoints = static_cast<int32_t>(csy::loopPoints(path.trajectory));
    state.fLength = path.trajectory.length;
  }
  return static_cast<int16_t>(problem.error);
}

::stride::BOOL st::CSY::CSY_PathWork(::stride::Ctx & /*ctx__*/, CSY_PATH_STATE &state) {
  Path &path = pathOf(state);
  const auto pieces = static_cast<int32_t>(path.trajectory.pieces);
  if (state.diSpeeds < pieces) {
    const csy::SlaveLimits limits = limitsOf(state);
    for (int32_t i = 0; i < kPiecesPerCall && state.diSpeeds < pieces; ++i)
      csy::computeSpeed(path.table, path.trajectory, limits,
                        static_cast<uint32_t>(state.diSpeeds++), path.speeds);
    return 0;
  }
  for (int32_t i = 0; i < kPointsPerCall && state.diFilled < state.diLoopPoints; ++i)
    fillPoint(state, csy::nextCamPoint(path.trajectory, path.cursor));
  return state.diFilled >= state.diLoopPoints ? 1 : 0;
}

::stride::BOOL st::CSY::CSY_PathResults(::stride::Ctx & /*ctx__*/, CSY_PATH_STATE &state,
                                        int16_t iWhich, ::stride::WORD *pTable) {
  const Path &path = pathOf(state);
  double values[2 * csy::kMostPoints];
  csy::fillResults(path.trajectory, path.speeds, static_cast<csy::ResultTable>(iWhich), values);
  for (uint32_t i = 0; i < 2 * path.trajectory.points; ++i)
    writeReal(values[i], pTable + 2 * i);
  return 1;
}

double st::CSY::CSY_PathConstantSpeed(::stride::Ctx & /*ctx__*/, CSY_PATH_STATE &state) {
  const Path &path = pathOf(state);
  return csy::constantSpeed(path.trajectory, path.speeds);
}

::stride::BOOL st::CSY::CSY_PathMove(::stride::Ctx & /*ctx__*/, CSY_PATH_STATE &state, double fFrom,
                                     double fTo, double fSpeed, double fRatio, double fVelocity,
                                     double fAcceleration, double fDeceleration, double fShape) {
  Path &path = pathOf(state);
  double speed[csy::kMostPieces];
  for (uint32_t i = 0; i < path.trajectory.pieces; ++i)
    speed[i] = fSpeed > 0.0 ? fSpeed : fRatio * path.speeds.computed[i];
  if (!csy::beginMove(path.trajectory, speed, {fVelocity, fAcceleration, fDeceleration, fShape},
                      fFrom, fTo, path.move))
    return 0;
  state.fPosition = fFrom;
  state.fVelocity = 0.0;
  return 1;
}

::stride::BOOL st::CSY::CSY_PathGoOn(::stride::Ctx & /*ctx__*/, CSY_PATH_STATE &state, double fTime,
                                     double fBrake) {
  Path &path = pathOf(state);
  const csy::MasterState master =
      fBrake > 0.0 ? csy::brake(path.move, fBrake, fTime) : csy::advance(path.move, fTime);
  state.fPosition = master.position;
  state.fVelocity = master.velocity;
  return master.done ? 1 : 0;
}
