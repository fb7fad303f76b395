#include "runtime/numeric/cnc/processors/object_splitter.hpp"

#include "runtime/numeric/cnc/object_cut.hpp"
#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {
namespace {

/// How many parts an object becomes.
int32_t partsOf(const ObjectSplitter &splitter, const PathObject &object) noexcept {
  ObjectShape shape{};
  if (!isCurve(object.moveType) || shapeOf(object, shape) != ShapeError::None)
    return 1;
  const double parts =
      exact::ceil(splitter.byLength ? shape.length / splitter.parameter : splitter.parameter);
  return !(parts > 1.0) ? 1 : parts < kMostParts ? static_cast<int32_t>(parts) : kMostParts;
}

} // namespace

Step next(ObjectSplitter &splitter, const Source &source, Output &output) noexcept {
  if (!exact::isPositive(splitter.parameter)) {
    output.error = StreamError::InvalidParameter;
    return Step::Failed;
  }
  if (splitter.left == 0) {
    splitter.rest = source.object;
    splitter.left = partsOf(splitter, source.object);
  }
  while (splitter.left > 0) {
    if (output.count >= kMostPerStep)
      return Step::Again;
    ObjectShape shape{};
    PathObject first;
    const bool last = splitter.left == 1 || shapeOf(splitter.rest, shape) != ShapeError::None ||
                      splitObject(splitter.rest, shape.length / splitter.left, first,
                                  splitter.rest) != CutError::None;
    (void)put(output, last ? splitter.rest : first);
    splitter.left = last ? 0 : splitter.left - 1;
  }
  return Step::Took;
}

} // namespace stride::cnc
