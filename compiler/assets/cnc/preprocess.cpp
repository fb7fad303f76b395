// The path processors of a CNC program, at compile time.

#include "compiler/assets/cnc/cnc_source.hpp"

#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/corner_path.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace stc {

namespace {

using namespace stride::cnc;

constexpr std::array<std::string_view, 4> kNames = {"tool", "loops", "smooth", "round"};
constexpr double kDegree = M_PI / 180;

std::string_view nameOf(CncProcessor processor) {
  return kNames.at(static_cast<size_t>(processor));
}

bool changesCorners(CncProcessor processor) {
  return processor == CncProcessor::Smooth || processor == CncProcessor::Round;
}

/// Why `two` does not fit behind `one`.
std::optional<CncOrderFault> faultOf(CncProcessor one, CncProcessor two, size_t at) {
  if (one == two)
    return CncOrderFault{at, fmt::format("\"{}\" stands twice in `preprocess`", nameOf(one)),
                         "again here", ""};
  if (changesCorners(one) && changesCorners(two))
    return CncOrderFault{at, "a path is smoothed or rounded, not both",
                         fmt::format("\"{}\" stands before it", nameOf(one)),
                         "G51 and G52 choose one of them for a part of the path: decode such a "
                         "program while the application runs"};
  if ((one == CncProcessor::Tool && changesCorners(two)) ||
      (two == CncProcessor::Tool && changesCorners(one)))
    return CncOrderFault{
        at, "tool correction and corners cannot be compiled together",
        fmt::format("\"{}\" stands before it", nameOf(one)),
        "the CNC editor of V2.3 has no such path, either: decode it while the application runs"};
  if (two < one)
    return CncOrderFault{at, fmt::format("\"{}\" comes before \"{}\"", nameOf(two), nameOf(one)),
                         "too late", "the order is tool, loops, then smooth or round"};
  return std::nullopt;
}

struct ErrorWords {
  std::string message;
  std::string label;
};

ErrorWords describe(StreamError error) {
  switch (error) {
  case StreamError::InvalidParameter:
    return {"the radius of the tool is negative, or no number", "D and `tool_radius` together"};
  case StreamError::PlaneChanged:
    return {"an arc lies in another plane than those before", "while the tool is corrected"};
  default: // those of other processors
    break;
  }
  return {"a path processor cannot change this object",
          "no shape, or no straight line to begin and end the correction with"};
}

/// Takes a path through the processors.
class Preprocessor {
public:
  Preprocessor(const CncProgram &program, std::vector<PathObject> objects,
               const CncOrigins &origins, Diagnostics &diagnostics)
      : program_(program), objects_(std::move(objects)), origins_(origins),
        diagnostics_(diagnostics) {}

  std::optional<std::vector<PathObject>> run() {
    for (const CncProcessor processor : program_.settings.preprocess)
      if (!apply(processor))
        return std::nullopt;
    return std::move(objects_);
  }

private:
  bool apply(CncProcessor which) {
    switch (which) {
    case CncProcessor::Tool: {
      const auto tool = std::make_unique<ToolCorrection>();
      tool->rules = {program_.settings.toolRadius, 0.0, ToolEntry::Positioning};
      return process(*tool, which);
    }
    case CncProcessor::Loops:
      return process(*std::make_unique<LoopAvoider>(), which);
    case CncProcessor::Smooth: {
      const auto smooth = std::make_unique<SmoothPath>();
      smooth->kind = PieceKind::Cubic;
      setCorners(*smooth, DistanceRule::ToolRadiusAdded);
      return process(*smooth, which);
    }
    case CncProcessor::Round:
      break;
    }
    const auto round = std::make_unique<RoundPath>();
    round->kind = PieceKind::Arc;
    setCorners(*round, DistanceRule::ToolRadiusElse);
    return process(*round, which);
  }

  /// As the blocks do it whose pins have their default values, but for the angle.
  void setCorners(CornerPath &corners, DistanceRule rule) const {
    const bool softMotion3 = program_.settings.softMotion3;
    corners.leastTurn = program_.settings.angleTolerance.value_or(0) * kDegree;
    corners.rule = softMotion3 ? DistanceRule::CornerDistanceAdded : rule;
    corners.passesFunctions = softMotion3;
  }

  /// Makes of the objects what the processor does. False: it cannot, or they are too many.
  template <class Processor> bool process(Processor &processor, CncProcessor which) {
    const size_t count = objects_.size();
    objects_.resize(count + 2); // a place stays free
    Queue input = queueOf(objects_);
    input.writePosition = static_cast<uint32_t>(count * sizeof(PathObject));
    input.endOfList = 1;
    constexpr size_t kPlaces = 16; // it is emptied after each step
    std::vector<PathObject> memory(kPlaces);
    Queue output = queueOf(memory);
    std::vector<PathObject> result;
    StreamState stream{};
    startStream(stream, &output, Processor::kGenerator, false);
    start(processor);
    while (stream.phase == StreamPhase::Running || stream.phase == StreamPhase::Draining) {
      stepStream(stream, processor, &input, &output);
      for (; countOf(&output) != 0; (void)removeAt(&output, 0))
        result.push_back(*objectAt(&output, 0));
      if (result.size() > kMostCncObjects)
        return reportMany(result.back(), which);
    }
    if (stream.phase == StreamPhase::Failed)
      return reportFailure(objectAt(&input, 0), stream.error, which);
    objects_ = std::move(result);
    return true;
  }

  static Queue queueOf(std::vector<PathObject> &objects) {
    Queue queue{};
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(objects.data());
    queue.size = static_cast<uint32_t>(objects.size() * sizeof(PathObject));
    return queue;
  }

  [[nodiscard]] Span spanOf(const PathObject *object) const {
    return object == nullptr ? program_.span : cncSpanOf(program_, origins_, *object);
  }

  bool reportFailure(const PathObject *object, StreamError error, CncProcessor which) {
    ErrorWords words = describe(error);
    diagnostics_
        .report(Code::CncProcessing, spanOf(object), std::move(words.message),
                std::move(words.label))
        .note(fmt::format("found by \"{}\" of `preprocess`", nameOf(which)));
    return false;
  }

  bool reportMany(const PathObject &object, CncProcessor which) {
    diagnostics_
        .report(Code::CncQueue, spanOf(&object),
                fmt::format("the path has more than {} objects", kMostCncObjects),
                "it goes on here")
        .note(fmt::format("behind \"{}\" of `preprocess`", nameOf(which)));
    return false;
  }

  const CncProgram &program_;
  std::vector<PathObject> objects_;
  const CncOrigins &origins_;
  Diagnostics &diagnostics_;
};

} // namespace

std::optional<CncProcessor> cncProcessor(std::string_view name) {
  const auto *const found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end())
    return std::nullopt;
  return static_cast<CncProcessor>(found - kNames.begin());
}

std::optional<CncOrderFault> findOrderFault(std::span<const CncProcessor> processors) {
  for (size_t i = 1; i < processors.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      if (auto fault = faultOf(processors[k], processors[i], i))
        return fault;
  return std::nullopt;
}

Span cncSpanOf(const CncProgram &program, const CncOrigins &origins, const PathObject &object) {
  if (object.number < 1 || static_cast<size_t>(object.number) > origins.size())
    return program.span;
  const CncWord *word = origins[static_cast<size_t>(object.number - 1)];
  return word != nullptr ? word->span : program.span;
}

std::optional<std::vector<PathObject>> preprocessCnc(const CncProgram &program,
                                                     std::vector<PathObject> objects,
                                                     const CncOrigins &origins,
                                                     Diagnostics &diagnostics) {
  return Preprocessor(program, std::move(objects), origins, diagnostics).run();
}

} // namespace stc
