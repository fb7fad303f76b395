// What the native bodies of SM3_CamBuilder share.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_CAMBUILDER_SMCB_CAM_BUILDER_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_CAMBUILDER_SMCB_CAM_BUILDER_HPP

#include "runtime/numeric/cam/shared_cam.hpp"

#include "st/SM3_CamBuilder/CAM_REF_MULTICORE_SAFE.h"
#include "st/SM_DriveBasic/MC_CAM_REF.h"

namespace stride::motion {

/// How many segments a block has room for, by its nMost: a project may have more or fewer of them
/// than the headers that this is compiled with.
inline int32_t mostSegments(int32_t most) noexcept {
  constexpr int32_t kMost = 32767; // nElements of MC_CAM_REF is an INT
  return most < kMost ? most : kMost;
}

/// Where the block keeps its cam.
inline cam::SharedCam sharedCam(::st::SM3_CamBuilder::CAM_REF_MULTICORE_SAFE &block) noexcept {
  auto *segments = reinterpret_cast<cam::Segment *>(&block.aSegments);
  return {{segments, segments + block.nMost},
          reinterpret_cast<cam::SharedHead *>(&block.aHeads),
          &block.nWritten,
          &block.nBegun,
          &block.nWriting};
}

/// The cam consists of `count` segments at `segments` from now on.
inline void refer(::st::SM_DriveBasic::MC_CAM_REF &camRef, const cam::SharedHead &head) noexcept {
  camRef.wCamStructID = 0xDC34;
  camRef.byType = static_cast<uint8_t>(cam::Form::Segments);
  camRef.nElements = static_cast<int16_t>(head.count);
  camRef.xStart = head.start;
  camRef.xEnd = head.end;
}

} // namespace stride::motion

#endif
