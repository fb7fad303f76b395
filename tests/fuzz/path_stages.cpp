#include "tests/fuzz/path_stages.hpp"

#include "runtime/numeric/cnc/processors/abc_slopes.hpp"
#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/axis_limits.hpp"
#include "runtime/numeric/cnc/processors/corner_path.hpp"
#include "runtime/numeric/cnc/processors/limit_circular.hpp"
#include "runtime/numeric/cnc/processors/limit_dynamics.hpp"
#include "runtime/numeric/cnc/processors/merge_path.hpp"
#include "runtime/numeric/cnc/processors/object_splitter.hpp"
#include "runtime/numeric/cnc/processors/smooth_add_axes.hpp"
#include "runtime/numeric/cnc/processors/smooth_bspline.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"
#include "runtime/numeric/cnc/processors/transform.hpp"

#include <cstring>
#include <functional>

namespace stride::fuzz {

using namespace stride::cnc;

namespace {

template <class Processor> class StageOf : public Stage {
public:
  StageOf() { std::memset(static_cast<void *>(&processor), 0, sizeof processor); }
  void begin(Queue *output) override {
    startStream(stream, output, Processor::kGenerator, false);
    start(processor);
  }
  void step(Queue *input, Queue *output) override { stepStream(stream, processor, input, output); }
  Processor processor;
};

/// A whole range comes out at once, which fits into the output.
class AxesStage : public StageOf<SmoothAddAxes> {
public:
  void step(Queue *input, Queue *output) override {
    StageOf::step(input, output);
    settle(processor, output, runs()); // as the block does
  }
  [[nodiscard]] uint32_t most() const override { return UINT32_MAX; }
};

template <class Processor>
std::unique_ptr<Stage> made(const std::function<void(Processor &)> &set = {}) {
  auto stage = std::make_unique<StageOf<Processor>>();
  if (set)
    set(stage->processor);
  return stage;
}

template <class Processor> std::unique_ptr<Stage> corners(Bytes &bytes) {
  return made<Processor>([&bytes](Processor &p) {
    const uint8_t how = bytes.next();
    p.kind = static_cast<PieceKind>(how % 3);
    p.rule = static_cast<DistanceRule>((how >> 2) % 3);
    p.symmetrical = (how & 16) != 0;
    p.passesFunctions = (how & 32) != 0;
    p.distance = (how & 64) != 0 ? bytes.number() : 0.5;
    p.leastTurn = (how & 128) != 0 ? bytes.number() : 0;
  });
}

template <class Processor> std::unique_ptr<Stage> transform(Bytes &bytes, TransformKind kind) {
  return made<Processor>([&](Processor &p) {
    p.wanted = {kind, {bytes.number(), bytes.number(), bytes.number()}};
  });
}

std::unique_ptr<Stage> tool(Bytes &bytes) {
  return made<ToolCorrection>([&bytes](ToolCorrection &p) {
    const uint8_t how = bytes.next();
    p.rules = {(how & 2) != 0 ? bytes.number() : 0.75, 1e-2,
               (how & 1) != 0 ? ToolEntry::Ramp : ToolEntry::Positioning};
  });
}

std::unique_ptr<Stage> splitter(Bytes &bytes) {
  return made<ObjectSplitter>([&bytes](ObjectSplitter &p) {
    p.byLength = (bytes.next() & 1) != 0;
    p.parameter = bytes.number();
  });
}

std::unique_ptr<Stage> limits(Bytes &bytes) {
  return made<LimitCircular>([&bytes](LimitCircular &p) {
    p.acceleration = bytes.number();
    p.jump = bytes.number();
    p.perRadius = bytes.number();
  });
}

std::unique_ptr<Stage> merge(Bytes &bytes) {
  return made<MergePath>([&bytes](MergePath &p) {
    p.tolerance = bytes.number();
    p.features = bytes.below(3);
  });
}

std::unique_ptr<Stage> axes(Bytes &bytes) {
  auto stage = std::make_unique<AxesStage>();
  stage->processor.part = bytes.below(5) * 0.25;
  return stage;
}

std::unique_ptr<Stage> slopes(Bytes &bytes) {
  return made<AbcSlopes>([&bytes](AbcSlopes &p) {
    p.linearAtStops = (bytes.next() & 1) != 0;
    p.angle = bytes.number();
  });
}

std::unique_ptr<Stage> splines(Bytes &bytes) {
  return made<SmoothBSpline>([&bytes](SmoothBSpline &p) {
    p.spacing = static_cast<KnotSpacing>(bytes.below(3));
    p.features = bytes.below(3);
  });
}

std::unique_ptr<Stage> dynamics(Bytes &bytes) {
  return made<LimitDynamics>([&bytes](LimitDynamics &p) {
    p.axes = static_cast<uint16_t>(bytes.next() << 4 | bytes.next());
    p.velocity = bytes.number();
    p.acceleration = bytes.number();
  });
}

} // namespace

std::unique_ptr<Stage> stageOf(Bytes &bytes) {
  // Numbers are added at the end, so that what the seeds say stays the same.
  constexpr uint32_t kFirstOfAxes = 192;
  const uint32_t which = bytes.below(256);
  if (which >= kFirstOfAxes) {
    constexpr std::unique_ptr<Stage> (*kOfAxes[])(Bytes &) = {axes, slopes, splines, dynamics};
    return kOfAxes[which % 4](bytes);
  }
  switch (which % 12) {
  case 0:
    return tool(bytes);
  case 1:
    return made<LoopAvoider>();
  case 2:
    return corners<RoundPath>(bytes);
  case 3:
    return limits(bytes);
  case 4:
    return made<LimitByAxes>();
  case 5:
    return merge(bytes);
  case 6:
    return splitter(bytes);
  case 7:
    return transform<RotatePath>(bytes, TransformKind::Rotate);
  case 8:
    return transform<TranslatePath>(bytes, TransformKind::Translate);
  case 9:
    return transform<ScalePath>(bytes, TransformKind::Scale);
  default:
    return corners<SmoothPath>(bytes);
  }
}

} // namespace stride::fuzz
