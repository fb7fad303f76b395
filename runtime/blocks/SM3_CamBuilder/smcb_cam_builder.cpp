// SMCB.CamBuilder: cams from segments.
#include "runtime/blocks/SM3_CamBuilder/smcb_cam_builder.hpp"

#include "runtime/numeric/cam/builder.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM3_CamBuilder/CamBuilder.h"
#include "st/SM_Error/SMC_ERROR.h"

namespace {

namespace cam = ::stride::cam;
namespace exact = ::stride::exact;
using Block = ::st::SM3_CamBuilder::CamBuilder;

static_assert(sizeof(cam::Piece) == sizeof(::st::SM3_CamBuilder::CAM_SEGMENT));
static_assert(__builtin_offsetof(cam::Piece, right) ==
              __builtin_offsetof(::st::SM3_CamBuilder::CAM_SEGMENT, right));
static_assert(__builtin_offsetof(cam::Piece, law) ==
              __builtin_offsetof(::st::SM3_CamBuilder::CAM_SEGMENT, eLaw));
static_assert(sizeof(cam::JointWork) == sizeof(::st::SM3_CamBuilder::CAM_JOINT));

int16_t errorOf(cam::BuildError error) noexcept {
  switch (error) {
  case cam::BuildError::None:
    break;
  case cam::BuildError::NoPieces:
    return ::st::SM_Error::SMC_ERROR__SMC_CB_NO_SEGMENTS;
  case cam::BuildError::BoundaryUnknown:
    return ::st::SM_Error::SMC_ERROR__SMC_CB_BOUNDARY_UNKNOWN;
  case cam::BuildError::NotAdjacent:
    return ::st::SM_Error::SMC_ERROR__SMC_CB_NOT_ADJACENT;
  case cam::BuildError::NoExtent:
    return ::st::SM_Error::SMC_ERROR__SMC_CB_NO_EXTENT;
  case cam::BuildError::InvalidValue:
    return ::st::SM_Error::SMC_ERROR__SMC_CB_INVALID_VALUE;
  case cam::BuildError::InvalidParameter:
    return ::st::SM_Error::SMC_ERROR__SMC_CB_INVALID_PARAMETER;
  }
  return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
}

const cam::Piece *piecesOf(const Block &block) noexcept {
  return reinterpret_cast<const cam::Piece *>(&block.aSegments);
}

/// aWork of the block, which follows its segments.
cam::JointWork *workOf(Block &block) noexcept {
  char *segments = reinterpret_cast<char *>(&block.aSegments);
  return reinterpret_cast<cam::JointWork *>(segments +
                                            int64_t{block.nMost} * int64_t{sizeof(cam::Piece)});
}

cam::Builder builderOf(Block &block, bool closed) noexcept {
  return {piecesOf(block), block.nSegments, closed, workOf(block)};
}

/// Calls `take(number, segment)` for each segment of the cam.
template <class Take>
cam::BuildError forEach(const cam::Builder &builder, int32_t pieces, Take take) noexcept {
  int32_t number = 0;
  for (int32_t i = 0; i < pieces; ++i) {
    cam::Segment segments[2];
    int32_t count = 0;
    const cam::BuildError error = builder.segments(i, segments, count);
    if (error != cam::BuildError::None)
      return error;
    for (int32_t k = 0; k < count; ++k)
      take(number++, segments[k]);
  }
  return cam::BuildError::None;
}

/// Computes the cam; `head` says how large it is.
int16_t solve(const Block &block, cam::Builder &builder, cam::SharedHead &head) noexcept {
  if (block.eError != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR)
    return block.eError;
  cam::BuildError error = builder.solve();
  head = {0.0, 0.0, 0};
  if (error == cam::BuildError::None)
    error = forEach(builder, block.nSegments, [&](int32_t number, const cam::Segment &segment) {
      if (number == 0)
        head.start = segment.start;
      head.end = segment.end;
      head.count = number + 1;
    });
  return errorOf(error);
}

/// What rounding may do to a derivative of a segment; see CheckContinuity.
double tolerance(const cam::Segment &segment, int derivative) noexcept {
  double size = 8.0 * exact::fabs(segment.stroke);
  for (int i = derivative == 0 ? 0 : 1; i < 8; ++i)
    size += exact::fabs(segment.coefficients[i]);
  const double h = segment.end - segment.start;
  return 1e-9 * size / (derivative == 0 ? 1.0 : derivative == 1 ? h : h * h);
}

struct Jump {
  uint32_t segment = 0; ///< 0: none.
  double size[3] = {0.0, 0.0, 0.0};
};

/// From the end of one to the start of the other; `first`: the first derivative that counts.
Jump jumpBetween(const cam::Segment &left, const cam::Segment &right, int first,
                 uint32_t number) noexcept {
  const cam::Point before = cam::evaluateSegment(left, left.end);
  const cam::Point behind = cam::evaluateSegment(right, right.start);
  Jump jump = {0, {behind.y - before.y, behind.v - before.v, behind.a - before.a}};
  for (int i = 0; i < 3; ++i) {
    const double allowed = exact::larger(tolerance(left, i), tolerance(right, i));
    if (i < first || exact::fabs(jump.size[i]) <= allowed)
      jump.size[i] = 0.0;
    else
      jump.segment = number;
  }
  return jump;
}

} // namespace

::stride::BOOL Block::Append(::stride::Ctx & /*ctx__*/, ::st::SM3_CamBuilder::CAM_SEGMENT segment) {
  if (eError != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR)
    return 0;
  if (nSegments < 0 || nSegments >= ::stride::motion::mostSegments(nMost)) {
    eError = ::st::SM_Error::SMC_ERROR__SMC_CB_TOO_MANY_SEGMENTS;
    return 0;
  }
  __builtin_memcpy(reinterpret_cast<cam::Piece *>(&aSegments) + nSegments, &segment,
                   sizeof segment);
  eError = errorOf(cam::checkLast(piecesOf(*this), nSegments + 1));
  if (eError != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR)
    return 0;
  ++nSegments;
  return 1;
}

::st::SM_Error::SMC_ERROR Block::Write(::stride::Ctx & /*ctx__*/,
                                       ::st::SM_DriveBasic::MC_CAM_REF &camRef,
                                       ::stride::BOOL createSmoothPeriodicTransition) {
  cam::Builder builder = builderOf(*this, createSmoothPeriodicTransition != 0);
  cam::SharedHead head;
  const int16_t problem = solve(*this, builder, head);
  if (problem != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR)
    return problem;
  if (camRef.pce == nullptr || camRef.nMaxElements < head.count)
    return ::st::SM_Error::SMC_ERROR__SMC_CB_CAM_REF_TOO_SMALL;
  char *target = reinterpret_cast<char *>(camRef.pce);
  forEach(builder, nSegments, [&](int32_t number, const cam::Segment &segment) {
    __builtin_memcpy(target + int64_t{number} * int64_t{sizeof segment}, &segment, sizeof segment);
  });
  ::stride::motion::refer(camRef, head);
  return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
}

::st::SM_Error::SMC_ERROR
Block::WriteMulticoreSafe(::stride::Ctx & /*ctx__*/,
                          ::st::SM3_CamBuilder::CAM_REF_MULTICORE_SAFE &safeCamRef,
                          ::stride::BOOL createSmoothPeriodicTransition) {
  cam::Builder builder = builderOf(*this, createSmoothPeriodicTransition != 0);
  cam::SharedHead head;
  const int16_t problem = solve(*this, builder, head);
  if (problem != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR)
    return problem;
  if (head.count > ::stride::motion::mostSegments(safeCamRef.nMost))
    return ::st::SM_Error::SMC_ERROR__SMC_CB_TOO_MANY_SEGMENTS;
  cam::SharedWriter writer(::stride::motion::sharedCam(safeCamRef));
  if (!writer.isOpen())
    return ::st::SM_Error::SMC_ERROR__SMC_CB_BUSY;
  forEach(builder, nSegments,
          [&](int32_t number, const cam::Segment &segment) { writer.put(number, segment); });
  writer.finish(head);
  return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
}

::stride::BOOL Block::CheckContinuity(::stride::Ctx & /*ctx__*/,
                                      ::stride::BOOL createSmoothPeriodicTransition,
                                      ::st::SM_Error::SMC_ERROR &errorID,
                                      ::stride::UDINT &segmentNumber, ::stride::LREAL &positionJump,
                                      ::stride::LREAL &velocityJump,
                                      ::stride::LREAL &accelerationJump) {
  cam::Builder builder = builderOf(*this, createSmoothPeriodicTransition != 0);
  cam::SharedHead head;
  errorID = solve(*this, builder, head);
  Jump jump;
  if (errorID == ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR) {
    cam::Segment first = {};
    cam::Segment last = {};
    for (int32_t i = 0; i < nSegments && jump.segment == 0; ++i) {
      cam::Segment segments[2];
      int32_t count = 0;
      builder.segments(i, segments, count);
      if (i == 0)
        first = segments[0];
      else
        jump = jumpBetween(last, segments[0], 0, static_cast<uint32_t>(i));
      last = segments[count - 1];
    }
    if (jump.segment == 0 && createSmoothPeriodicTransition != 0)
      jump = jumpBetween(last, first, 1, static_cast<uint32_t>(nSegments));
    if (jump.segment != 0)
      errorID = jump.size[0] != 0.0   ? ::st::SM_Error::SMC_ERROR__SMC_CB_POSITION_JUMP
                : jump.size[1] != 0.0 ? ::st::SM_Error::SMC_ERROR__SMC_CB_VELOCITY_JUMP
                                      : ::st::SM_Error::SMC_ERROR__SMC_CB_ACCELERATION_JUMP;
  }
  segmentNumber = jump.segment;
  positionJump = jump.size[0];
  velocityJump = jump.size[1];
  accelerationJump = jump.size[2];
  return errorID == ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR ? 1 : 0;
}
