#include "runtime/numeric/cam/element_block.hpp"

namespace stride::cam {
namespace {

Scale scaleOf(float tableMin, float tableMax, float editorMin, float editorMax) noexcept {
  return {tableMin, editorMin,
          (double{editorMax} - double{editorMin}) / (double{tableMax} - double{tableMin})};
}

bool isTable(Form form) noexcept { return form == Form::EvenTable || form == Form::PairTable; }

} // namespace

int64_t elementBlockSize(Form form, Element element, int64_t count) noexcept {
  if (form == Form::Nodes)
    return count * int64_t{sizeof(Node)};
  if (form == Form::Segments)
    return count * int64_t{sizeof(Segment)};
  const int32_t size = sizeOf(element);
  if (!isTable(form) || size == 0)
    return 0;
  return scalingOffset(form, size, count) + int64_t{sizeof(TableScaling)};
}

void attachElements(Curve &curve, const void *data) noexcept {
  if (elementBlockSize(curve.form, curve.element, curve.count) == 0)
    return;
  curve.data = data;
  if (!isTable(curve.form))
    return;
  TableScaling scaling;
  __builtin_memcpy(&scaling,
                   static_cast<const uint8_t *>(data) +
                       scalingOffset(curve.form, sizeOf(curve.element), curve.count),
                   sizeof scaling);
  curve.master = scaleOf(scaling.tableMasterMin, scaling.tableMasterMax, scaling.editorMasterMin,
                         scaling.editorMasterMax);
  curve.slave = scaleOf(scaling.tableSlaveMin, scaling.tableSlaveMax, scaling.editorSlaveMin,
                        scaling.editorSlaveMax);
}

} // namespace stride::cam
