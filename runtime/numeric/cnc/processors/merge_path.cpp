#include "runtime/numeric/cnc/processors/merge_path.hpp"

namespace stride::cnc {

Step next(MergePath &path, const Source &source, Output &output) noexcept {
  if (!exact::isfinite(path.tolerance) || !(path.tolerance >= 0.0)) {
    output.error = StreamError::InvalidParameter;
    return Step::Failed;
  }
  path.merger.tolerance = path.tolerance;
  const PathObject &object = source.object;
  if ((object.features & path.features) != path.features) {
    (void)finish(path, Ending::Pause, output);
    (void)put(output, object);
    return Step::Took;
  }
  PathObject ready[2];
  const int32_t count = mergeNext(path.merger, object, ready);
  for (int32_t i = 0; i < count; ++i)
    (void)put(output, ready[i]);
  return Step::Took;
}

Step finish(MergePath &path, Ending /*ending*/, Output &output) noexcept {
  PathObject ready;
  if (mergeEnd(path.merger, ready) != 0)
    (void)put(output, ready);
  return Step::Took;
}

} // namespace stride::cnc
