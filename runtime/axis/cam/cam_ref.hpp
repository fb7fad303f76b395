// MC_CAM_REF as the numerics see it. Free of the C++ standard library: linked into every
// application.
#ifndef STRIDE_RUNTIME_AXIS_CAM_CAM_REF_HPP
#define STRIDE_RUNTIME_AXIS_CAM_CAM_REF_HPP

#include "runtime/numeric/cam/element_block.hpp"

#include "st/SM_DriveBasic/MC_CAM_REF.h"
#include "st/SM_DriveBasic/SMC_CAMTappet.h"
#include "st/SM_DriveBasic/SMC_CAMXYVA.h"
#include "st/SM_DriveBasic/SMC_CAM_SEGMENT.h"

namespace stride::cam {

using CamRef = ::st::SM_DriveBasic::MC_CAM_REF;
using Tappet = ::st::SM_DriveBasic::SMC_CAMTappet;

static_assert(sizeof(Node) == sizeof(::st::SM_DriveBasic::SMC_CAMXYVA));
static_assert(sizeof(Segment) == sizeof(::st::SM_DriveBasic::SMC_CAM_SEGMENT));
static_assert(__builtin_offsetof(Segment, stroke) ==
              __builtin_offsetof(::st::SM_DriveBasic::SMC_CAM_SEGMENT, dStroke));
static_assert(__builtin_offsetof(Segment, inflexion) ==
              __builtin_offsetof(::st::SM_DriveBasic::SMC_CAM_SEGMENT, dInflexion));
static_assert(__builtin_offsetof(Segment, law) ==
              __builtin_offsetof(::st::SM_DriveBasic::SMC_CAM_SEGMENT, eLaw));

/// MC_CAM_REF.wCamStructID of every cam.
inline constexpr uint16_t kCamStructId = 0xDC34;

/// The curve of a cam, good for one call of a block: the program may change it between two. Without
/// data if the cam has none, or is none.
Curve curveOf(const CamRef &cam) noexcept;

/// The SMC_ERROR of what is wrong with a cam's curve: 750 (no cam), 628 (scaling), or kNone.
int16_t errorOf(CurveError error) noexcept;

/// What is wrong with the cam: kNone, or SMC_ERROR 750 (no cam) or 628 (scaling). Takes a time that
/// grows with its size.
int16_t checkCam(const CamRef &cam) noexcept;

} // namespace stride::cam

#endif
