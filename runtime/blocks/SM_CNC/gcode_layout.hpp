// SMC_GCODE_WORD, SMC_CNC_REF and SMC_DECODER_STATE as the numerics see them, and their errors.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_BLOCKS_SM_CNC_GCODE_LAYOUT_HPP
#define STRIDE_RUNTIME_BLOCKS_SM_CNC_GCODE_LAYOUT_HPP

#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "runtime/blocks/same_place.hpp"
#include "runtime/numeric/cnc/decoder.hpp"
#include "runtime/numeric/cnc/gcode_program.hpp"

#include "st/SM_CNC/SMC_CNC_REF.h"
#include "st/SM_CNC/SMC_DECODER_STATE.h"
#include "st/SM_CNC/SMC_GCODE_WORD.h"
#include "st/SM_Error/SMC_ERROR.h"

namespace stride::cnc {

namespace layout {

static_assert(sizeof(GCodeWord) == sizeof(st::SMC_GCODE_WORD));
STRIDE_SAME_PLACE(GCodeWord, letter, st::SMC_GCODE_WORD, byLetter);
STRIDE_SAME_PLACE(GCodeWord, value, st::SMC_GCODE_WORD, fValue);
STRIDE_SAME_PLACE(GCodeWord, integer, st::SMC_GCODE_WORD, diValue);
STRIDE_SAME_PLACE(GCodeWord, address, st::SMC_GCODE_WORD, pAdr);
STRIDE_SAME_PLACE(GCodeWord, variables, st::SMC_GCODE_WORD, byVarType);

static_assert(sizeof(Decoder) == sizeof(st::SMC_DECODER_STATE));
STRIDE_SAME_PLACE(Decoder, here, st::SMC_DECODER_STATE, piHere);
STRIDE_SAME_PLACE(Decoder, held, st::SMC_DECODER_STATE, giHeld);
STRIDE_SAME_PLACE(Decoder, shift, st::SMC_DECODER_STATE, adShift);
STRIDE_SAME_PLACE(Decoder, period, st::SMC_DECODER_STATE, adPeriod);
STRIDE_SAME_PLACE(Decoder, velocity, st::SMC_DECODER_STATE, dVel);
STRIDE_SAME_PLACE(Decoder, acceleration, st::SMC_DECODER_STATE, dAccel);
STRIDE_SAME_PLACE(Decoder, deceleration, st::SMC_DECODER_STATE, dDecel);
STRIDE_SAME_PLACE(Decoder, rapidVelocity, st::SMC_DECODER_STATE, dRapidVel);
STRIDE_SAME_PLACE(Decoder, rapidAcceleration, st::SMC_DECODER_STATE, dRapidAccel);
STRIDE_SAME_PLACE(Decoder, rapidDeceleration, st::SMC_DECODER_STATE, dRapidDecel);
STRIDE_SAME_PLACE(Decoder, radius, st::SMC_DECODER_STATE, dRadius);
STRIDE_SAME_PLACE(Decoder, cornerDistance, st::SMC_DECODER_STATE, dCornerDistance);
STRIDE_SAME_PLACE(Decoder, additional, st::SMC_DECODER_STATE, adAdditional);
STRIDE_SAME_PLACE(Decoder, switches, st::SMC_DECODER_STATE, adSwitches);
STRIDE_SAME_PLACE(Decoder, parameters, st::SMC_DECODER_STATE, mpParameters);
STRIDE_SAME_PLACE(Decoder, planeX, st::SMC_DECODER_STATE, vX);
STRIDE_SAME_PLACE(Decoder, planeY, st::SMC_DECODER_STATE, vY);
STRIDE_SAME_PLACE(Decoder, normal, st::SMC_DECODER_STATE, vN);
STRIDE_SAME_PLACE(Decoder, direction, st::SMC_DECODER_STATE, vDirection);
STRIDE_SAME_PLACE(Decoder, systemX, st::SMC_DECODER_STATE, vSystemX);
STRIDE_SAME_PLACE(Decoder, systemY, st::SMC_DECODER_STATE, vSystemY);
STRIDE_SAME_PLACE(Decoder, systemZ, st::SMC_DECODER_STATE, vSystemZ);
STRIDE_SAME_PLACE(Decoder, turn, st::SMC_DECODER_STATE, adTurn);
STRIDE_SAME_PLACE(Decoder, tool, st::SMC_DECODER_STATE, vTool);
STRIDE_SAME_PLACE(Decoder, program, st::SMC_DECODER_STATE, wProgram);
STRIDE_SAME_PLACE(Decoder, modes, st::SMC_DECODER_STATE, byModes);
STRIDE_SAME_PLACE(Decoder, scale, st::SMC_DECODER_STATE, adScale);
STRIDE_SAME_PLACE(Decoder, limits, st::SMC_DECODER_STATE, aLimits);
STRIDE_SAME_PLACE(Decoder, objects, st::SMC_DECODER_STATE, diObjects);
STRIDE_SAME_PLACE(Decoder, features, st::SMC_DECODER_STATE, dwFeatures);
STRIDE_SAME_PLACE(Decoder, counter, st::SMC_DECODER_STATE, iCounter);
STRIDE_SAME_PLACE(Decoder, axes, st::SMC_DECODER_STATE, wAxes);
STRIDE_SAME_PLACE(Decoder, profile, st::SMC_DECODER_STATE, wProfile);
STRIDE_SAME_PLACE(Decoder, smoothAxes, st::SMC_DECODER_STATE, wSmoothAxes);
STRIDE_SAME_PLACE(Decoder, motion, st::SMC_DECODER_STATE, iMotion);
STRIDE_SAME_PLACE(Decoder, state, st::SMC_DECODER_STATE, byHeld);
STRIDE_SAME_PLACE(Decoder, ways, st::SMC_DECODER_STATE, byWays);
STRIDE_SAME_PLACE(Decoder, marks, st::SMC_DECODER_STATE, byMarks);
STRIDE_SAME_PLACE(Decoder, relative, st::SMC_DECODER_STATE, bRelative);
STRIDE_SAME_PLACE(Decoder, centreAbsolute, st::SMC_DECODER_STATE, bCentreAbsolute);
STRIDE_SAME_PLACE(Decoder, planar, st::SMC_DECODER_STATE, bPlanar);
STRIDE_SAME_PLACE(Decoder, directed, st::SMC_DECODER_STATE, bDirected);
STRIDE_SAME_PLACE(Decoder, jumping, st::SMC_DECODER_STATE, bJumping);
STRIDE_SAME_PLACE(Decoder, turned, st::SMC_DECODER_STATE, bTurned);
STRIDE_SAME_PLACE(Decoder, scaled, st::SMC_DECODER_STATE, bScaled);
STRIDE_SAME_PLACE(Decoder, softMotion3, st::SMC_DECODER_STATE, bSoftMotion3);

STRIDE_SAME_PLACE(Decoder, orientation, st::SMC_DECODER_STATE, byOrientation);

} // namespace layout

/// SMC_CNC_REF.wCNCREFStructID
inline constexpr uint16_t kProgramStructId = 0xBA56;
/// SMC_CNC_REF.udiBuffer of a program that is there as a whole.
inline constexpr uint32_t kWholeProgram = 0xFFFFFFFF;

inline const GCodeWord *wordsOf(const ::st::SM_CNC::SMC_CNC_REF &program) noexcept {
  return reinterpret_cast<const GCodeWord *>(program.pgc);
}

/// Whether it is a program.
inline bool isProgram(const ::st::SM_CNC::SMC_CNC_REF &program) noexcept {
  return program.wCNCREFStructID == kProgramStructId &&
         (program.pgc != nullptr || program.nElements == 0);
}

/// The number of what is wrong with a sentence.
inline int16_t errorOf(GCodeError error) noexcept {
  namespace e = ::st::SM_Error;
  switch (error) {
  case GCodeError::None:
    return e::SMC_ERROR__SMC_NO_ERROR;
  case GCodeError::Acceleration:
    return e::SMC_ERROR__SMC_DEC_ACC_TOO_LITTLE;
  case GCodeError::Deceleration:
    return e::SMC_ERROR__SMC_DEC_RET_TOO_LITTLE;
  case GCodeError::UnknownJump:
    return e::SMC_ERROR__SMC_DEC_UNKNOWN_JUMP;
  case GCodeError::NotInThisPlane:
    return e::SMC_ERROR__SMC_DEC_NOT_IN_3D;
  case GCodeError::NegativePeriod:
    return e::SMC_ERROR__SMC_DEC_NEGATIVE_PERIOD;
  case GCodeError::PartOfTurn:
    return e::SMC_ERROR__SMC_DEC_ORIENTATION_INCOMPLETE;
  case GCodeError::Tilted:
    return e::SMC_ERROR__SMC_DEC_TILTED_DCS;
  case GCodeError::Distorted:
    return e::SMC_ERROR__SMC_DEC_SCALING_DISTORTS;
  case GCodeError::TurnOfScale:
    return e::SMC_ERROR__SMC_DEC_ROTATION_AFFECTS_SCALING;
  case GCodeError::PartOfScale:
    return e::SMC_ERROR__SMC_DEC_SCALING_INCOMPLETE;
  case GCodeError::BadScale:
    return e::SMC_ERROR__SMC_IPR_INVALID_SCALING;
  case GCodeError::NotANumber:
    return e::SMC_ERROR__SMC_DEC_NOT_A_NUMBER;
  case GCodeError::TooManySwitches:
    return e::SMC_ERROR__SMC_DEC_TOO_MANY_SWITCHES;
  default:
    return e::SMC_ERROR__SMC_DEC_SYNTAX_ERROR;
  }
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_BLOCKS_SM_CNC_GCODE_LAYOUT_HPP
