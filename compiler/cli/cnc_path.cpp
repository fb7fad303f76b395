// From the sentences of a CNC program to a motion.

#include "compiler/cli/cnc_path.hpp"

#include "runtime/numeric/cnc/chord_merge.hpp"
#include "runtime/numeric/cnc/corner.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>

namespace stc::cli {

namespace {

/// Of a motion, at most: eight hours at 1 ms, which are 2 GB of table.
constexpr double kMostCycles = 3e7;

using namespace stride::cnc;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Objects that the interpolator sees at a time.
constexpr uint32_t kQueuePlaces = 4096;

/// Steps of planning in a cycle of 1 ms, as SMC_Interpolator has them.
constexpr double kBudget = 64;

/// So long nothing may move, but for dwells, before the path counts as stuck. [s]
constexpr double kMostRest = 10;

bool moves(const PathObject &object) {
  return object.moveType != MoveType::Function && object.moveType != MoveType::Jump;
}

/// Objects go through these in turn: lines are merged, corners blended.
class Chain {
public:
  Chain(const CncMotionOptions &options, CncPath &path) : path_(&path), options_(&options) {
    merger_->tolerance = options.merge;
    double acceleration = kInfinite;
    for (int axis = 0; axis <= kAxisZ; ++axis)
      if (options.maxAcceleration[axis] > 0)
        acceleration = std::min(acceleration, options.maxAcceleration[axis]);
    blender_->rules = {kInfinite, options.blend, kInfinite, acceleration,
                       options.angleTolerance.value_or(0) * M_PI / 180};
  }

  /// The program has one more.
  void count() { ++path_->programmed; }

  void take(const PathObject &object) {
    if (options_->merge <= 0) {
      blend(object);
      return;
    }
    PathObject ready[2];
    for (int32_t n = mergeNext(*merger_, object, ready), i = 0; i < n; ++i)
      blend(ready[i]);
  }

  void finish() {
    PathObject ready;
    if (mergeEnd(*merger_, ready) != 0)
      blend(ready);
    if (blendEnd(*blender_, ready) != 0)
      path_->objects.push_back(ready);
  }

private:
  void blend(const PathObject &object) {
    if (options_->blend <= 0) {
      path_->objects.push_back(object);
      return;
    }
    PathObject ready[2];
    const int32_t count = blendNext(*blender_, object, ready);
    path_->objects.insert(path_->objects.end(), ready, ready + count);
    path_->blends += count == 2 ? 1 : 0;
  }

  CncPath *path_;
  const CncMotionOptions *options_;
  std::unique_ptr<Merger> merger_ = std::make_unique<Merger>();
  std::unique_ptr<Blender> blender_ = std::make_unique<Blender>();
};

/// Decodes all sentences. False: they do not end, one of them cannot be decoded, or who takes the
/// objects has had enough.
bool decodeAll(const CncProgram &program, Diagnostics &diagnostics,
               const std::function<bool(const PathObject &)> &take, CncOrigins *origins) {
  const CncDecoded decoded = decodeCnc(program, take, origins);
  switch (decoded.end) {
  case CncEnd::Complete:
    return true;
  case CncEnd::Endless:
    diagnostics.report(Code::CncJump, program.span, "the jumps of this program do not end");
    break;
  case CncEnd::Wrong:
    diagnostics.report(Code::CncSentence, program.span,
                       "a sentence of this program cannot be carried out: its variables are 0 "
                       "here");
    break;
  case CncEnd::Refused:
    diagnostics.report(Code::CncQueue, program.span,
                       fmt::format("the path has more than {} objects: too many for --preprocess",
                                   kMostCncObjects));
    break;
  }
  return false;
}

/// Gives the chain the whole path, as the processors of the settings leave it. False: it is wrong,
/// which is reported.
bool takeAll(const CncProgram &program, Diagnostics &diagnostics, Chain &chain) {
  if (program.settings.preprocess.empty())
    return decodeAll(
        program, diagnostics,
        [&chain](const PathObject &object) {
          chain.count();
          chain.take(object);
          return true;
        },
        nullptr);
  std::vector<PathObject> objects;
  CncOrigins origins;
  const auto keep = [&](const PathObject &object) {
    chain.count();
    objects.push_back(object);
    return objects.size() <= kMostCncObjects;
  };
  if (!decodeAll(program, diagnostics, keep, &origins))
    return false;
  const auto processed = preprocessCnc(program, std::move(objects), origins, diagnostics);
  if (!processed)
    return false;
  for (const PathObject &object : *processed)
    chain.take(object);
  return true;
}

/// The corner rule of SMC_CheckVelocities, for the whole path.
void checkCorners(CncPath &path, const CncMotionOptions &options) {
  const CornerRules rules{options.angleTolerance.value_or(0) * M_PI / 180, -1.0};
  PathObject *before = nullptr;
  for (PathObject &object : path.objects) {
    path.axes = static_cast<uint16_t>(path.axes | object.end.axes);
    if (object.moveType == MoveType::Positioning || !(object.velocityEnd > 0))
      object.velocityEnd = 0;
    if (before != nullptr) {
      const double velocity = cornerVelocity(*before, object, rules);
      before->velocityEnd = std::min(before->velocityEnd, velocity);
      path.stops += moves(*before) && before->velocityEnd == 0 ? 1 : 0;
    }
    path.length += moves(object) ? object.length : 0;
    before = &object;
  }
  if (before != nullptr)
    before->velocityEnd = 0;
}

bool isDrivable(const CncPath &path, const CncProgram &program, Diagnostics &diagnostics) {
  const auto stands = [](const PathObject &object) {
    return moves(object) && object.length > 0 && !(object.velocity > 0);
  };
  const auto found = std::find_if(path.objects.begin(), path.objects.end(), stands);
  if (found == path.objects.end())
    return true;
  diagnostics
      .report(Code::CncSentence, program.span,
              fmt::format("sentence {} moves with velocity 0", found->sourceLine))
      .help("say a velocity with F, or for a program without it with --velocity");
  return false;
}

/// How long the object takes at least, from its velocity or its dwell alone. [s]
double leastTime(const PathObject &object, double feed) {
  if (moves(object))
    return object.length > 0 ? object.length / (object.velocity * feed) : 0;
  const bool dwells = object.moveType == MoveType::Function && object.switchId[0] == kDwell;
  return dwells ? std::max(0.0, object.parameterRange[0]) : 0;
}

/// Whether the path can end within kMostCycles, from its velocities and dwells alone; says if not.
/// A table or a picture of it would take all memory first.
bool isShortEnough(const CncPath &path, const CncProgram &program, const CncMotionOptions &options,
                   Diagnostics &diagnostics) {
  double time = 0;
  for (const PathObject &object : path.objects)
    time += leastTime(object, options.feed);
  const double cycles = time / options.cycle;
  if (cycles <= kMostCycles)
    return true;
  diagnostics
      .report(Code::CncSentence, program.span,
              fmt::format("the path takes {:.7g} cycles at least: more than {:.0f}", cycles,
                          kMostCycles))
      .help("is a coordinate wrong, a velocity, or the T of a G4? --cycle makes cycles longer");
  return false;
}

stride::path::LawKind lawOf(const std::string &mode) {
  using stride::path::LawKind;
  return mode == "quadratic" ? LawKind::Jerk
         : mode == "sigmoid" ? LawKind::Sigmoid
                             : LawKind::Trapezoid;
}

Command commandOf(const CncMotionOptions &options) {
  Command command{};
  command.cycle = options.cycle;
  command.override = options.feed;
  command.jerk = options.jerk;
  command.law = lawOf(options.velocityMode);
  command.share = 1;
  std::copy(std::begin(options.maxVelocity), std::end(options.maxVelocity),
            std::begin(command.limits.velocity));
  std::copy(std::begin(options.maxAcceleration), std::end(options.maxAcceleration),
            std::begin(command.limits.acceleration));
  command.acknowledge = true;
  command.limitKinks = true;
  command.budget = static_cast<int32_t>(kBudget * std::max(1.0, options.cycle * 1000));
  return command;
}

/// The queue before the interpolator, with a part of the path.
class Feeder {
public:
  explicit Feeder(const CncPath &path)
      : path_(&path), memory_((kQueuePlaces + 1) * sizeof(PathObject)) {
    queue_.structId = kQueueStructId;
    queue_.buffer = memory_.data();
    queue_.size = static_cast<uint32_t>(memory_.size());
    queue_.generator = kByCheckVelocities;
    fill();
  }

  void fill() {
    while (next_ < path_->objects.size() && !isFull(&queue_))
      append(&queue_, &path_->objects[next_++]);
    queue_.endOfList = next_ == path_->objects.size() ? 1 : 0;
  }

  Queue *queue() { return &queue_; }

private:
  const CncPath *path_;
  std::vector<uint8_t> memory_;
  Queue queue_{};
  size_t next_ = 0;
};

} // namespace

std::optional<CncPath> cncPathOf(const CncProgram &program, const CncMotionOptions &options,
                                 Diagnostics &diagnostics) {
  CncPath path;
  Chain chain(options, path);
  if (!takeAll(program, diagnostics, chain))
    return std::nullopt;
  chain.finish();
  checkCorners(path, options);
  if (!isDrivable(path, program, diagnostics) ||
      !isShortEnough(path, program, options, diagnostics))
    return std::nullopt;
  return path;
}

int driveCnc(const CncPath &path, const CncMotionOptions &options, const CncCycle &cycle) {
  Feeder feeder(path);
  Command command = commandOf(options);
  command.queue = feeder.queue();
  const auto interpolator = std::make_unique<Interpolator>();
  start(*interpolator, command);
  bool begun = false;
  double rest = 0;
  for (int64_t count = 0; rest < kMostRest;) {
    stride::cnc::cycle(*interpolator, command);
    if (interpolator->phase == Phase::Failed)
      return interpolator->error;
    const Progress &progress = interpolator->progress;
    if (!begun && progress.length > 0) { // the first plan is made before anything moves
      begun = true;
      count = 1;
    }
    if (begun)
      cycle(static_cast<double>(count++) * options.cycle, progress);
    if (count > static_cast<int64_t>(kMostCycles)) // limits of axes make it so slow
      return kCncTooLong;
    if (interpolator->phase == Phase::Finished)
      return 0;
    rest = progress.length > 0 || interpolator->dwell > 0 ? 0 : rest + options.cycle;
    feeder.fill();
  }
  constexpr int kNothingMoves = 1007; // SMC_PATH_EXCEEDED
  return kNothingMoves;
}

} // namespace stc::cli
