// What MC_CAM_REF.pce points at: the numbers of a table with its scaling, the nodes or the
// segments. The same bytes stand in
// *.CAM files. Pure numerics: no AXIS_REF, no application.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_ELEMENT_BLOCK_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_ELEMENT_BLOCK_HPP

#include "runtime/numeric/cam/curve.hpp"

namespace stride::cam {

/// What follows the numbers of an SMC_CAMTable_…: eight REALs, aligned as a REAL is.
struct TableScaling {
  float editorMasterMin, editorMasterMax, editorSlaveMin, editorSlaveMax;
  float tableMasterMin, tableMasterMax, tableSlaveMin, tableSlaveMax;
};

/// Where the scaling of a table stands: bytes of its numbers. `count` slave positions or pairs.
constexpr int64_t scalingOffset(Form form, int32_t elementSize, int64_t count) noexcept {
  const int64_t numbers = form == Form::PairTable ? 2 * count : count;
  return (numbers * elementSize + 3) / 4 * 4;
}

/// Bytes of a block with `count` elements; 0 for unknown forms and types.
int64_t elementBlockSize(Form form, Element element, int64_t count) noexcept;

/// Gives `curve`, whose form, element and count are set, its data and the scaling of a table.
/// Without an effect for unknown forms and types.
void attachElements(Curve &curve, const void *data) noexcept;

} // namespace stride::cam

#endif
