// The bytes of *.CAM files (docs/synchronized-motion.md): what SMC_ReadCAM, SMC_WriteCAM and
// `stride cam` read and write. Pure numerics: no AXIS_REF, no application.
//
// A file is header, elements, tappets, checksum, little endian and without gaps; what the elements
// and the tappets consist of is in memory as it is in the file, apart from what is between members.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_CAM_FILE_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_CAM_FILE_HPP

#include "runtime/numeric/cam/element_block.hpp"

namespace stride::cam {

inline constexpr uint16_t kCamFileVersion = 1;
inline constexpr int32_t kCamFileHeaderSize = 136;
inline constexpr int32_t kCamFileChecksumSize = 4;
/// Elements, and tappets, of a file at most: MC_CAM_REF counts them by INT.
inline constexpr uint32_t kCamFileMaxCount = 32767;

/// What is wrong with a file.
enum class CamFileError : uint8_t {
  None,
  Version,   ///< No cam file, or of another version.
  Form,      ///< Unknown form or type of numbers.
  Truncated, ///< It ends too early.
  Damaged,   ///< Wrong checksum, bytes after the end, or no usable cam.
};

/// The header of a file: the members of MC_CAM_REF.
struct CamFileHeader {
  Form form = Form::Nodes;
  Element element = Element::Lreal; ///< Of tables.
  bool cubic = false;               ///< Of tables.
  bool open = false;                ///< Even table without its last place; `rise` counts.
  uint32_t elements = 0;            ///< 0: a cam without a curve, for its tappets.
  uint32_t tappets = 0;
  double start = 0.0; ///< [master u]
  double end = 0.0;   ///< [master u]
  double rise = 0.0;  ///< [slave u]
  char name[81] = {}; ///< Ends with 0.
};

/// A tappet in a file: SMC_CAMTappet, which says what the members mean.
struct FileTappet {
  double x;
  int16_t group;
  int16_t pass;   ///< SMC_CAMTAPPETTYPE.
  int16_t action; ///< SMC_CAMTAPPETACTION.
  int16_t unused; ///< 0 in files.
  uint32_t delay;
  uint32_t duration;
};
static_assert(sizeof(FileTappet) == 24);

/// Bytes of the elements in a file: elementBlockSize, filled up to a multiple of 8.
int64_t fileElementsSize(const CamFileHeader &header) noexcept;

/// Bytes of the whole file.
int64_t camFileSize(const CamFileHeader &header) noexcept;

/// Writes kCamFileHeaderSize bytes.
void writeCamFileHeader(const CamFileHeader &header, uint8_t *bytes) noexcept;

/// Reads kCamFileHeaderSize bytes and looks at every value.
CamFileError readCamFileHeader(const uint8_t *bytes, CamFileHeader &header) noexcept;

/// Writes the bytes `offset` to `offset + count` of the elements as they stand in a file; `data` is
/// what pce points at.
void writeFileElements(const CamFileHeader &header, const void *data, int64_t offset,
                       uint8_t *bytes, int64_t count) noexcept;

/// The same of the tappets.
void writeFileTappets(const FileTappet *tappets, int64_t offset, uint8_t *bytes,
                      int64_t count) noexcept;

/// CRC-32 (IEEE 802.3) of several pieces: what it returns is `before` of the next; 0 of the first.
uint32_t camFileChecksum(uint32_t before, const void *bytes, int64_t count) noexcept;

/// The curve of a file; `data` are its elements. Not looked at yet: checkCurve.
Curve curveOfFile(const CamFileHeader &header, const void *data) noexcept;

/// A whole file in memory, and pointers into it.
struct CamFile {
  CamFileHeader header;
  const void *elements = nullptr;
  const FileTappet *tappets = nullptr;
};

/// Looks at all of the file, its curve included. `bytes` must be aligned as a double is, and stay.
CamFileError openCamFile(const uint8_t *bytes, int64_t size, CamFile &file) noexcept;

/// Writes a whole file, camFileSize bytes.
void writeCamFile(const CamFileHeader &header, const void *elements, const FileTappet *tappets,
                  uint8_t *bytes) noexcept;

} // namespace stride::cam

#endif
