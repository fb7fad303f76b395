// The bytes of cam files for SMC_ReadCAM and SMC_WriteCAM, which are written in ST.
#include "runtime/axis/cam/cam_ref.hpp"
#include "runtime/numeric/cam/cam_file.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_Error/SMC_ERROR.h"
#include "st/SM_FileFBs/SMC_CamFileCheck.h"
#include "st/SM_FileFBs/SMC_CamFileOpen.h"
#include "st/SM_FileFBs/SMC_CamFilePart.h"
#include "st/SM_FileFBs/SMC_CamFileSize.h"
#include "st/SM_FileFBs/SMC_CamFileSum.h"

namespace {

namespace cam = ::stride::cam;

static_assert(sizeof(cam::Tappet) == sizeof(cam::FileTappet));
static_assert(__builtin_offsetof(cam::Tappet, iGroupID) ==
              __builtin_offsetof(cam::FileTappet, group));
static_assert(__builtin_offsetof(cam::Tappet, ctt) == __builtin_offsetof(cam::FileTappet, pass));
static_assert(__builtin_offsetof(cam::Tappet, cta) == __builtin_offsetof(cam::FileTappet, action));
static_assert(__builtin_offsetof(cam::Tappet, dwDelay) ==
              __builtin_offsetof(cam::FileTappet, delay));
static_assert(__builtin_offsetof(cam::Tappet, dwDuration) ==
              __builtin_offsetof(cam::FileTappet, duration));

/// What a cam's file says about it.
cam::CamFileHeader fileHeaderOf(const cam::CamRef &ref) noexcept {
  cam::CamFileHeader header;
  header.form = static_cast<cam::Form>(ref.byType);
  header.element = static_cast<cam::Element>(ref.byVarType);
  header.elements =
      ref.pce != nullptr && ref.nElements > 0 ? static_cast<uint32_t>(ref.nElements) : 0;
  header.tappets = ref.pt != nullptr && ref.nTappets > 0 ? static_cast<uint32_t>(ref.nTappets) : 0;
  if (header.elements == 0)
    header.form = cam::Form::Nodes;
  header.cubic = ref.byInterpolationQuality == 3;
  header.open = header.form == cam::Form::EvenTable && (ref.byCompatibilityMode & 1U) != 0;
  header.start = ref.xStart;
  header.end = ref.xEnd;
  header.rise = ref.fRise;
  for (int32_t i = 0; i < 80 && ref.strCAMName.s[i] != 0; ++i)
    header.name[i] = ref.strCAMName.s[i];
  return header;
}

int16_t errorOf(cam::CamFileError error) noexcept {
  switch (error) {
  case cam::CamFileError::None:
    return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
  case cam::CamFileError::Version:
    return ::st::SM_Error::SMC_ERROR__SMC_RCAM_WRONG_VERSION;
  case cam::CamFileError::Form:
    return ::st::SM_Error::SMC_ERROR__SMC_RCAM_WRONG_COMPILE_TYPE;
  case cam::CamFileError::Truncated:
    return ::st::SM_Error::SMC_ERROR__SMC_RCAM_UNEXPECTED_EOF;
  case cam::CamFileError::Damaged:
    break;
  }
  return ::st::SM_Error::SMC_ERROR__SMC_RCAM_DAMAGED;
}

} // namespace

namespace st::SM_FileFBs {

::stride::INT SMC_CamFileOpen(::stride::Ctx & /*ctx__*/, ::st::SM_DriveBasic::MC_CAM_REF &Cam,
                              ::stride::BYTE *pHeader, ::stride::INT iMaxElements,
                              ::stride::INT iMaxTappets) {
  cam::CamFileHeader header;
  if (const cam::CamFileError error = cam::readCamFileHeader(pHeader, header);
      error != cam::CamFileError::None)
    return errorOf(error);
  if (header.elements > static_cast<uint32_t>(iMaxElements) ||
      header.tappets > static_cast<uint32_t>(iMaxTappets))
    return ::st::SM_Error::SMC_ERROR__SMC_RCAM_TOO_MUCH_DATA;
  Cam.wCamStructID = cam::kCamStructId;
  Cam.xStart = header.start;
  Cam.xEnd = header.end;
  Cam.byType = static_cast<uint8_t>(header.form);
  Cam.byVarType = static_cast<uint8_t>(header.element);
  Cam.nElements = static_cast<int16_t>(header.elements);
  Cam.byInterpolationQuality = header.cubic ? 3 : 1;
  Cam.nTappets = static_cast<int16_t>(header.tappets);
  Cam.byCompatibilityMode = header.open ? 1 : 0;
  Cam.fRise = header.rise;
  Cam.nMaxElements = iMaxElements;
  __builtin_memcpy(Cam.strCAMName.s, header.name, sizeof Cam.strCAMName.s);
  return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
}

::stride::UDINT SMC_CamFileSize(::stride::Ctx & /*ctx__*/, ::st::SM_DriveBasic::MC_CAM_REF &Cam,
                                ::stride::BOOL bTappets) {
  if (bTappets != 0)
    return static_cast<uint32_t>(Cam.nTappets) * static_cast<uint32_t>(sizeof(cam::FileTappet));
  if (Cam.nElements <= 0)
    return 0;
  const int64_t size = cam::elementBlockSize(
      static_cast<cam::Form>(Cam.byType), static_cast<cam::Element>(Cam.byVarType), Cam.nElements);
  return static_cast<uint32_t>((size + 7) / 8 * 8);
}

::stride::DWORD SMC_CamFileSum(::stride::Ctx & /*ctx__*/, ::stride::DWORD dwBefore,
                               ::stride::BYTE *pBytes, ::stride::UDINT udiCount) {
  return cam::camFileChecksum(dwBefore, pBytes, udiCount);
}

::stride::INT SMC_CamFileCheck(::stride::Ctx & /*ctx__*/, ::st::SM_DriveBasic::MC_CAM_REF &Cam) {
  namespace exact = ::stride::exact;
  if (Cam.wCamStructID == cam::kCamStructId && (Cam.nElements <= 0 || Cam.pce == nullptr) &&
      Cam.nTappets > 0 && Cam.pt != nullptr)
    return Cam.xStart < Cam.xEnd && exact::isfinite(Cam.xStart) && exact::isfinite(Cam.xEnd)
               ? ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR
               : ::st::SM_Error::SMC_ERROR__SMC_NO_CAM_REF_TYPE;
  return cam::checkCam(Cam);
}

::stride::UDINT SMC_CamFilePart(::stride::Ctx & /*ctx__*/, ::st::SM_DriveBasic::MC_CAM_REF &Cam,
                                ::stride::BYTE *pBuffer, ::stride::UDINT udiOffset,
                                ::stride::UDINT udiCount) {
  const cam::CamFileHeader header = fileHeaderOf(Cam);
  const int64_t ends[3] = {cam::kCamFileHeaderSize,
                           cam::kCamFileHeaderSize + cam::fileElementsSize(header),
                           cam::camFileSize(header) - cam::kCamFileChecksumSize};
  int64_t offset = udiOffset;
  int64_t done = 0;
  for (int32_t part = 0; part < 3; ++part) {
    const int64_t start = part == 0 ? 0 : ends[part - 1];
    int64_t count = ends[part] - offset;
    if (offset < start || count <= 0 || done >= udiCount)
      continue;
    count = count < udiCount - done ? count : udiCount - done;
    if (part == 0) {
      uint8_t bytes[cam::kCamFileHeaderSize];
      cam::writeCamFileHeader(header, bytes);
      __builtin_memcpy(pBuffer + done, bytes + offset, static_cast<size_t>(count));
    } else if (part == 1) {
      cam::writeFileElements(header, Cam.pce, offset - start, pBuffer + done, count);
    } else {
      // NOLINTNEXTLINE: the same bytes.
      cam::writeFileTappets(reinterpret_cast<const cam::FileTappet *>(Cam.pt), offset - start,
                            pBuffer + done, count);
    }
    offset += count;
    done += count;
  }
  return static_cast<uint32_t>(done);
}

} // namespace st::SM_FileFBs
