// SMC_POSINFO, SMC_GEOINFO and SMC_OUTQUEUE as the numerics see them: the same bytes. Free of the
// C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_BLOCKS_SM_CNC_CNC_LAYOUT_HPP
#define STRIDE_RUNTIME_BLOCKS_SM_CNC_CNC_LAYOUT_HPP

#include "runtime/blocks/same_place.hpp"
#include "runtime/numeric/cnc/path_object.hpp"
#include "runtime/numeric/cnc/queue.hpp"

#include "st/SM_CNC/MOVTYP.h"
#include "st/SM_CNC/SMC_GEOINFO.h"
#include "st/SM_CNC/SMC_OUTQUEUE.h"
#include "st/SM_CNC/SMC_POSINFO.h"
#include "st/SM_CNC/SMC_VECTOR3D.h"

namespace stride::cnc {

namespace layout {

namespace st = ::st::SM_CNC;

static_assert(sizeof(Vector3) == sizeof(st::SMC_VECTOR3D));

static_assert(sizeof(Position) == sizeof(st::SMC_POSINFO));
STRIDE_SAME_PLACE(Position, frame, st::SMC_POSINFO, iFrame_Nr);
STRIDE_SAME_PLACE(Position, axes, st::SMC_POSINFO, wAuxData);
STRIDE_SAME_PLACE(Position, sProfile, st::SMC_POSINFO, wSProfile);
static_assert(__builtin_offsetof(Position, coordinate[kAxisX]) ==
              __builtin_offsetof(st::SMC_POSINFO, dX));
static_assert(__builtin_offsetof(Position, coordinate[kAxisP]) ==
              __builtin_offsetof(st::SMC_POSINFO, dA1));
static_assert(__builtin_offsetof(Position, coordinate[kAxisSixth]) ==
              __builtin_offsetof(st::SMC_POSINFO, dA6));

static_assert(sizeof(PathObject) == sizeof(st::SMC_GEOINFO));
STRIDE_SAME_PLACE(PathObject, number, st::SMC_GEOINFO, iObjNo);
STRIDE_SAME_PLACE(PathObject, sourceLine, st::SMC_GEOINFO, iSourceLineNo);
STRIDE_SAME_PLACE(PathObject, moveType, st::SMC_GEOINFO, iMoveType);
STRIDE_SAME_PLACE(PathObject, start, st::SMC_GEOINFO, piStartPos);
STRIDE_SAME_PLACE(PathObject, end, st::SMC_GEOINFO, piDestPos);
static_assert(__builtin_offsetof(PathObject, shape[0]) == __builtin_offsetof(st::SMC_GEOINFO, dP1));
static_assert(__builtin_offsetof(PathObject, shape[7]) == __builtin_offsetof(st::SMC_GEOINFO, dP8));
static_assert(__builtin_offsetof(PathObject, parameterRange[0]) ==
              __builtin_offsetof(st::SMC_GEOINFO, dT1));
static_assert(__builtin_offsetof(PathObject, parameterRange[1]) ==
              __builtin_offsetof(st::SMC_GEOINFO, dT2));
STRIDE_SAME_PLACE(PathObject, toolRadius, st::SMC_GEOINFO, dToolRadius);
STRIDE_SAME_PLACE(PathObject, velocity, st::SMC_GEOINFO, dVel);
STRIDE_SAME_PLACE(PathObject, velocityEnd, st::SMC_GEOINFO, dVelEnd);
STRIDE_SAME_PLACE(PathObject, acceleration, st::SMC_GEOINFO, dAccel);
STRIDE_SAME_PLACE(PathObject, deceleration, st::SMC_GEOINFO, dDecel);
STRIDE_SAME_PLACE(PathObject, length, st::SMC_GEOINFO, dLength);
STRIDE_SAME_PLACE(PathObject, marks, st::SMC_GEOINFO, byInternMark);
STRIDE_SAME_PLACE(PathObject, switchPosition, st::SMC_GEOINFO, dHelpPos);
STRIDE_SAME_PLACE(PathObject, switchId, st::SMC_GEOINFO, iHelpID);
STRIDE_SAME_PLACE(PathObject, sentence, st::SMC_GEOINFO, diSentenceNo);
STRIDE_SAME_PLACE(PathObject, smoothAxes, st::SMC_GEOINFO, wSmoothAxes);
static_assert(__builtin_offsetof(PathObject, moreShape[0]) ==
              __builtin_offsetof(st::SMC_GEOINFO, dP9));
static_assert(__builtin_offsetof(PathObject, moreShape[9]) ==
              __builtin_offsetof(st::SMC_GEOINFO, dP18));
STRIDE_SAME_PLACE(PathObject, planeX, st::SMC_GEOINFO, vX);
STRIDE_SAME_PLACE(PathObject, planeY, st::SMC_GEOINFO, vY);
STRIDE_SAME_PLACE(PathObject, normal, st::SMC_GEOINFO, vN);
STRIDE_SAME_PLACE(PathObject, features, st::SMC_GEOINFO, dwFeatureFlags);
STRIDE_SAME_PLACE(PathObject, additional, st::SMC_GEOINFO, aAdditionalParams);
STRIDE_SAME_PLACE(PathObject, cornerDistance, st::SMC_GEOINFO, dCornerDistance);
STRIDE_SAME_PLACE(PathObject, startSlope, st::SMC_GEOINFO, adStartSlope);
STRIDE_SAME_PLACE(PathObject, endSlope, st::SMC_GEOINFO, adEndSlope);
STRIDE_SAME_PLACE(PathObject, limits, st::SMC_GEOINFO, aLimits);
STRIDE_SAME_PLACE(PathObject, probe, st::SMC_GEOINFO, wProbe);
STRIDE_SAME_PLACE(PathObject, slopes, st::SMC_GEOINFO, bySlopes);
STRIDE_SAME_PLACE(PathObject, planar, st::SMC_GEOINFO, bPlanar);
STRIDE_SAME_PLACE(PathObject, program, st::SMC_GEOINFO, wProgram);
STRIDE_SAME_PLACE(PathObject, orientation, st::SMC_GEOINFO, eOriConv);
STRIDE_SAME_PLACE(PathObject, modes, st::SMC_GEOINFO, byModes);
STRIDE_SAME_PLACE(PathObject, system, st::SMC_GEOINFO, adSystem);
STRIDE_SAME_PLACE(PathObject, tool, st::SMC_GEOINFO, vTool);

static_assert(sizeof(Queue) == sizeof(st::SMC_OUTQUEUE));
STRIDE_SAME_PLACE(Queue, structId, st::SMC_OUTQUEUE, wOUTQUEUEStructID);
STRIDE_SAME_PLACE(Queue, buffer, st::SMC_OUTQUEUE, pbyBuffer);
STRIDE_SAME_PLACE(Queue, size, st::SMC_OUTQUEUE, nSize);
STRIDE_SAME_PLACE(Queue, readPosition, st::SMC_OUTQUEUE, nReadPos);
STRIDE_SAME_PLACE(Queue, writePosition, st::SMC_OUTQUEUE, nWritePos);
STRIDE_SAME_PLACE(Queue, full, st::SMC_OUTQUEUE, bFull);
STRIDE_SAME_PLACE(Queue, endOfList, st::SMC_OUTQUEUE, bEndOfList);
STRIDE_SAME_PLACE(Queue, generator, st::SMC_OUTQUEUE, byGenerator);
STRIDE_SAME_PLACE(Queue, capacity, st::SMC_OUTQUEUE, nCapacity);
STRIDE_SAME_PLACE(Queue, recheckVelocities, st::SMC_OUTQUEUE, bReCheckVelocities);
STRIDE_SAME_PLACE(Queue, programName, st::SMC_OUTQUEUE, strProgramName);
STRIDE_SAME_PLACE(Queue, reserved, st::SMC_OUTQUEUE, nNumReservedEntries);
STRIDE_SAME_PLACE(Queue, path, st::SMC_OUTQUEUE, nPath);
STRIDE_SAME_PLACE(Queue, pathPosition, st::SMC_OUTQUEUE, nPathPos);
STRIDE_SAME_PLACE(Queue, moved, st::SMC_OUTQUEUE, nMoved);
STRIDE_SAME_PLACE(Queue, pathSeen, st::SMC_OUTQUEUE, nPathSeen);
STRIDE_SAME_PLACE(Queue, removed, st::SMC_OUTQUEUE, nRemoved);
STRIDE_SAME_PLACE(Queue, removedEnd, st::SMC_OUTQUEUE, nRemovedEnd);
STRIDE_SAME_PLACE(Queue, pathRead, st::SMC_OUTQUEUE, nPathRead);
STRIDE_SAME_PLACE(Queue, dryRunVelocity, st::SMC_OUTQUEUE, dDryRunVelocity);
STRIDE_SAME_PLACE(Queue, checkedEnd, st::SMC_OUTQUEUE, nCheckedEnd);

static_assert(static_cast<int16_t>(MoveType::EllipseCounterclockwise) == st::MOVTYP__ELLCCLW);
static_assert(static_cast<int16_t>(MoveType::Spline3d) == st::MOVTYP__SPLINE3D_5);
static_assert(static_cast<int16_t>(MoveType::Function) == st::MOVTYP__MCOMMAND);

} // namespace layout

/// How many objects the memory that is given to a block must have room for: with less nothing
/// happens. Source: SoftMotion V2.3 manual, section 6.2.2.
inline constexpr uint32_t kLeastObjects = 5;

inline Queue *queueOf(::st::SM_CNC::SMC_OUTQUEUE *queue) noexcept {
  return reinterpret_cast<Queue *>(queue);
}
inline PathObject *objectOf(::st::SM_CNC::SMC_GEOINFO *object) noexcept {
  return reinterpret_cast<PathObject *>(object);
}
inline ::st::SM_CNC::SMC_GEOINFO *declared(PathObject *object) noexcept {
  return reinterpret_cast<::st::SM_CNC::SMC_GEOINFO *>(object);
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_BLOCKS_SM_CNC_CNC_LAYOUT_HPP
