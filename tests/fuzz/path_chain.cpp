#include "tests/fuzz/path_chain.hpp"

#include "runtime/numeric/cnc/interpolator.hpp"
#include "runtime/numeric/cnc/limit_check.hpp"
#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/cnc/processors/transform.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"
#include "runtime/numeric/cnc/x_interpolator.hpp"
#include "tests/fuzz/path_stages.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory>
#include <vector>

namespace stride::fuzz {

namespace {

using namespace stride::cnc;

constexpr double kDegree = M_PI / 180;

/// What an object says beside its type and its ends.
void describe(Bytes &bytes, PathObject &o) {
  const uint8_t flags = bytes.next();
  o.marks = (flags & 1) != 0 ? bytes.next() : 0;
  if ((flags & 2) != 0)
    o.toolRadius = o.cornerDistance = bytes.number();
  for (int i = 0; i < 8 && (flags & 4) != 0; ++i)
    o.shape[i] = bytes.number();
  for (int i = 0; i < 10 && (flags & 8) != 0; ++i)
    o.moreShape[i] = bytes.number();
  if ((flags & 16) != 0) {
    const uint8_t which = bytes.next();
    o.planar = which & 1;
    o.slopes = which >> 1 & 7;
    o.start.sProfile = (which & 16) != 0 ? 0xfff : 0;
    o.start.axes = o.end.axes = (which & 32) != 0 ? 0xfff : 7;
    o.features = which >> 6;
    o.end.coordinate[3 + which % 9] = bytes.number();
    o.startSlope[which % 3] = bytes.number();
    o.smoothAxes = which;
    o.limits[which % 9] = {static_cast<float>(bytes.number()), static_cast<float>(bytes.number()),
                           static_cast<float>(bytes.number())};
  }
  if ((flags & 32) != 0) {
    const uint8_t at = bytes.next();
    o.switchId[at % 4] = static_cast<int16_t>(static_cast<int8_t>(bytes.next()));
    o.switchPosition[at % 4] = bytes.number();
    o.probe = at >> 7;
  }
  if ((flags & 64) != 0) {
    o.velocity = bytes.number();
    o.velocityEnd = bytes.number();
    o.acceleration = bytes.number();
    o.deceleration = bytes.number();
    o.length = bytes.number();
  }
  if ((flags & 128) != 0) {
    Vector3 *const vectors[] = {&o.planeX, &o.planeY, &o.normal};
    *vectors[bytes.below(3)] = {bytes.number(), bytes.number(), bytes.number()};
  }
}

/// An arc that fits its ends, so that more than the first check is reached.
void makeArc(Bytes &bytes, PathObject &o) {
  o.shape[0] = bytes.number();
  o.shape[1] = bytes.number();
  const double dx = o.start.coordinate[kAxisX] - o.shape[0];
  const double dy = o.start.coordinate[kAxisY] - o.shape[1];
  o.shape[2] = std::hypot(dx, dy);
  o.shape[3] = o.start.coordinate[kAxisZ];
  o.parameterRange[0] = std::atan2(dy, dx) / kDegree;
  o.parameterRange[1] = bytes.number();
  const double phi = (o.parameterRange[0] - o.parameterRange[1]) * kDegree;
  o.end.coordinate[kAxisX] = o.shape[0] + o.shape[2] * std::cos(phi);
  o.end.coordinate[kAxisY] = o.shape[1] + o.shape[2] * std::sin(phi);
  o.moveType = o.parameterRange[1] > 0 ? MoveType::Clockwise : MoveType::Counterclockwise;
}

PathObject objectOf(Bytes &bytes, const PathObject &before) {
  constexpr int16_t kTypes[] = {1, 1, 1, 1, 2, 3, 5, 8, 9, 11, 11, 100, 110, 120, 7, -1};
  PathObject o = before;
  o.start = before.end;
  o.velocity = o.acceleration = o.deceleration = 10;
  const uint8_t what = bytes.next();
  o.moveType = static_cast<MoveType>(kTypes[what % 16]);
  o.marks = 0;
  o.probe = 0;
  std::fill(std::begin(o.switchId), std::end(o.switchId), int16_t{0});
  o.end.coordinate[kAxisX] = bytes.number();
  o.end.coordinate[kAxisY] = bytes.number();
  if ((what & 16) != 0)
    o.end.coordinate[kAxisZ] = bytes.number();
  if ((what & 32) != 0)
    describe(bytes, o);
  if ((what & 64) != 0)
    makeArc(bytes, o);
  else if ((what & 128) != 0)
    (void)calculateEnd(o);
  if ((what & 48) != 48)
    (void)calculateLength(o);
  return o;
}

/// A queue whose memory ends where it says, for the sanitizers.
struct Memory {
  explicit Memory(uint32_t places) : objects(places) {
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(objects.data());
    queue.size = static_cast<uint32_t>(places * sizeof(PathObject));
  }
  std::vector<PathObject> objects;
  Queue queue{};
};

/// Says something wrong of a queue: it may be smaller than it says, never larger.
void damage(Bytes &bytes, Queue &queue) {
  const uint8_t what = bytes.next();
  const uint32_t value = bytes.next() * 97U;
  if ((what & 1) != 0)
    queue.size = std::min(queue.size, value);
  if ((what & 2) != 0)
    queue.readPosition = value;
  if ((what & 4) != 0)
    queue.writePosition = value;
  if ((what & 8) != 0)
    queue.structId = static_cast<uint16_t>(value);
  if ((what & 16) != 0)
    queue.reserved = value * value * value;
  if ((what & 32) != 0)
    queue.removed = queue.removedEnd = value;
  if ((what & 64) != 0)
    queue.buffer = nullptr;
  if ((what & 128) != 0)
    queue.recheckVelocities = queue.endOfList = 1;
}

/// What takes the path from the last queue.
class Sink {
public:
  Sink(Bytes &bytes, Queue *queue) : kind_(bytes.below(4)), queue_(queue) {
    command_.queue = queue;
    if (kind_ == 1)
      setInterpolator(bytes);
    x_ = -100;
    transform_ = {static_cast<TransformKind>(bytes.below(3)),
                  {bytes.number(), bytes.number(), bytes.number()}};
    rules_ = {(bytes.next() & 1) != 0 ? bytes.number() : 0.01, bytes.number()};
    const uint8_t how = bytes.next();
    keepsGenerator_ = (how & 3) == 0;
    looks_ = (how & 4) != 0;
    most_.coordinate[how % kAxes] = 5;
    box_ = {&least_, &most_, static_cast<uint16_t>(how << 4U | how), how / 64.0, how / 16, how / 2};
    startFollowing(*follower_);
  }

  void step() {
    BoxFinding finding{0, -1};
    if (looks_)
      (void)checkBox(queue_, looked_, box_, finding);
    if (kind_ == 3 && isUsable(transform_)) // the block looks
      transformInPlace(queue_, transform_, transformed_);
    if (kind_ != 0)
      (void)checkVelocities(queue_, checked_, rules_);
    if (kind_ == 1) {
      if (!keepsGenerator_)
        queue_->generator = kByCheckVelocities;
      if (!begun_)
        start(*interpolator_, command_);
      begun_ = true;
      cycle(*interpolator_, command_);
    } else if (kind_ == 2) {
      follow(*follower_, queue_, x_ += 0.5, forward_);
    }
    // A machine may stand for ever; the path has to go on.
    if (kind_ == 0 || kind_ == 3 || ++calls_ % 16 == 0)
      (void)removeAt(queue_, 0);
  }

private:
  void setInterpolator(Bytes &bytes) {
    const uint8_t how = bytes.next();
    command_.cycle = (how & 1) != 0 ? bytes.number() : 0.5;
    if (!(command_.cycle > 0) || std::isinf(command_.cycle))
      command_.cycle = 0.001; // dwIpoTime is no such number
    command_.override = (how & 2) != 0 ? bytes.number() : 1;
    command_.jerk = (how & 4) != 0 ? std::abs(bytes.number()) : 1000;
    if (!(command_.jerk > 0)) // the block refuses it
      command_.jerk = 1;
    constexpr path::LawKind kLaws[] = {path::LawKind::Trapezoid, path::LawKind::Sigmoid,
                                       path::LawKind::Jerk};
    command_.law = kLaws[bytes.below(3)];
    command_.share = 1;
    command_.limits.velocity[bytes.below(12)] = bytes.number();
    command_.limits.acceleration[bytes.below(12)] = bytes.number();
    command_.slowStop = (how & 8) != 0;
    command_.acknowledge = (how & 16) == 0;
    command_.limitKinks = (how & 32) != 0;
    command_.singleStep = (how & 64) != 0;
    command_.twoWays = (how & 128) != 0;
    command_.budget = 64;
  }

  uint32_t kind_;
  Queue *queue_;
  Command command_{};
  Transform transform_{};
  CornerRules rules_{};
  Position least_{};
  Position most_{};
  PlaceLimits box_{};
  std::unique_ptr<Interpolator> interpolator_ = std::make_unique<Interpolator>();
  std::unique_ptr<XFollower> follower_ = std::make_unique<XFollower>();
  double x_ = 0;
  uint32_t checked_ = UINT32_MAX;
  uint32_t transformed_ = UINT32_MAX;
  uint32_t looked_ = UINT32_MAX;
  uint32_t calls_ = 0;
  bool forward_ = true;
  bool begun_ = false;
  bool keepsGenerator_ = false;
  bool looks_ = false;
};

class PathChain {
public:
  PathChain(const uint8_t *data, size_t size) : bytes_{data, size} {
    const uint32_t stages = 1 + bytes_.below(3);
    for (uint32_t i = 0; i <= stages; ++i)
      queues_.push_back(std::make_unique<Memory>(5 + bytes_.below(12)));
    for (uint32_t i = 0; i < stages; ++i) {
      stages_.push_back(stageOf(bytes_));
      stages_.back()->begin(&queues_[i + 1]->queue);
    }
    sink_ = std::make_unique<Sink>(bytes_, &queues_.back()->queue);
    const uint8_t which = bytes_.next();
    isDamaged_ = which < 24;
    if (isDamaged_)
      damage(bytes_, queues_[which % queues_.size()]->queue);
    object_.start.axes = object_.end.axes = 7;
    completePlane(object_);
  }

  std::string run() {
    // As many as one object may become in the smallest queues; a splitter's parts take longer, and
    // are not waited for.
    constexpr size_t kMostSteps = 6000;
    size_t idle = 0;
    for (size_t steps = 0; stages_.back()->runs() && steps < kMostSteps; ++steps) {
      feed();
      moved_ = fed_;
      for (size_t i = 0; i < stages_.size(); ++i)
        if (std::string fault = step(i); !fault.empty())
          return fault;
      sink_->step();
      idle = moved_ ? 0 : idle + 1;
      // Loops look at 64 objects a call; the sink takes an object in 16 calls at least.
      constexpr size_t kMostIdle = 500;
      if (idle > kMostIdle && bytes_.size == 0 && isSound())
        return "a processor goes on without doing anything";
    }
    return {};
  }

private:
  void feed() {
    Queue &queue = queues_.front()->queue;
    fed_ = false;
    if (bytes_.size == 0)
      queue.endOfList = 1;
    else if (!isFull(&queue)) {
      object_ = objectOf(bytes_, object_);
      fed_ = append(&queue, &object_) != nullptr;
      if (!fed_)
        bytes_.size = 0;
    }
  }

  std::string step(size_t i) {
    Queue *input = &queues_[i]->queue;
    Queue *output = &queues_[i + 1]->queue;
    const uint32_t before = countOf(output);
    const uint32_t waiting = countOf(input);
    const StreamPhase phase = stages_[i]->stream.phase;
    stages_[i]->step(input, output);
    if (!stages_[i]->runs())
      output->endOfList = 1; // else those behind would wait for ever
    const uint32_t after = countOf(output);
    moved_ =
        moved_ || after != before || countOf(input) != waiting || stages_[i]->stream.phase != phase;
    if (after > before && after - before > stages_[i]->most())
      return "a step puts out too much";
    return {};
  }

  /// Nothing is expected of damaged queues.
  [[nodiscard]] bool isSound() const {
    for (const auto &memory : queues_)
      if (checkQueue(&memory->queue) != QueueError::None)
        return false;
    return !isDamaged_;
  }

  Bytes bytes_;
  std::vector<std::unique_ptr<Memory>> queues_;
  std::vector<std::unique_ptr<Stage>> stages_;
  std::unique_ptr<Sink> sink_;
  PathObject object_{};
  bool fed_ = false;
  bool moved_ = false;
  bool isDamaged_ = false;
};

} // namespace

std::string runPathChain(const uint8_t *data, size_t size) { return PathChain(data, size).run(); }

} // namespace stride::fuzz
