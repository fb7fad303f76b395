// Tool correction and loops with any objects whatever: an error or a path, never anything else.
#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

namespace {

using namespace stride::cnc;

/// Takes bytes as they are needed; zeros after the end.
struct Bytes {
  const uint8_t *data;
  size_t size;

  uint8_t next() {
    if (size == 0)
      return 0;
    --size;
    return *data++;
  }
  double number() {
    constexpr double kStrange[] = {0.0, 1e-300, 1e300, -1e18, __builtin_nan(""), __builtin_inf()};
    const uint8_t kind = next();
    if (kind < 6)
      return kStrange[kind];
    const int value = static_cast<int8_t>(next());
    return kind < 200 ? value : value + kind / 256.0;
  }
};

PathObject objectOf(Bytes &bytes, PathObject before) {
  constexpr int16_t kTypes[] = {1, 1, 2, 3, 5, 8, 9, 11, 100, 110, 120, 7};
  PathObject o = before;
  o.start = before.end;
  o.moveType = static_cast<MoveType>(kTypes[bytes.next() % 12]);
  const uint8_t flags = bytes.next();
  o.end.coordinate[kAxisX] = bytes.number();
  o.end.coordinate[kAxisY] = bytes.number();
  if ((flags & 1) != 0)
    o.end.coordinate[kAxisZ] = bytes.number();
  o.marks = (flags & 2) != 0 ? bytes.next() : 0;
  if ((flags & 4) != 0)
    o.toolRadius = bytes.number();
  for (int i = 0; i < 8 && (flags & 8) != 0; ++i)
    o.shape[i] = bytes.number();
  for (double &t : o.parameterRange)
    t = (flags & 16) != 0 ? bytes.number() : 0.0;
  if ((flags & 32) != 0)
    o.planeX.x = bytes.number();
  o.switchId[bytes.next() % 4] = static_cast<int16_t>(static_cast<int8_t>(bytes.next()));
  if ((flags & 64) != 0)
    o.switchPosition[1] = bytes.number();
  if ((flags & 128) != 0) { // an arc that fits
    const double x = bytes.number();
    const double y = bytes.number();
    o.shape[0] = x;
    o.shape[1] = y;
    const double dx = o.start.coordinate[kAxisX] - x;
    const double dy = o.start.coordinate[kAxisY] - y;
    o.shape[2] = __builtin_sqrt(dx * dx + dy * dy);
    o.parameterRange[0] = __builtin_atan2(dy, dx) * 57.29577951308232;
    o.parameterRange[1] = bytes.number();
    const double phi = (o.parameterRange[0] - o.parameterRange[1]) / 57.29577951308232;
    o.end.coordinate[kAxisX] = x + o.shape[2] * __builtin_cos(phi);
    o.end.coordinate[kAxisY] = y + o.shape[2] * __builtin_sin(phi);
    o.moveType = o.parameterRange[1] > 0 ? MoveType::Clockwise : MoveType::Counterclockwise;
  }
  return o;
}

struct Memory {
  explicit Memory(uint32_t places) : objects(places) {
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(objects.data());
    queue.size = static_cast<uint32_t>(places * sizeof(PathObject));
  }
  std::vector<PathObject> objects;
  Queue queue{};
};

/// Each processor into the next queue; the last one is emptied.
void run(Bytes bytes, ToolEntry entry) {
  Memory queues[] = {Memory(5 + bytes.next() % 20), Memory(5 + bytes.next() % 8), Memory(7)};
  const auto tool = std::make_unique<ToolCorrection>();
  const auto loops = std::make_unique<LoopAvoider>();
  std::memset(static_cast<void *>(tool.get()), 0, sizeof *tool);
  tool->rules = {static_cast<double>(bytes.next() % 8), 1e-2, entry};
  StreamState streams[2]{};
  startStream(streams[0], &queues[1].queue, kByToolCorr, false);
  startStream(streams[1], &queues[2].queue, kByAvoidLoop, false);
  start(*tool);
  start(*loops);
  PathObject object{};
  object.velocity = object.acceleration = object.deceleration = 10;
  object.start.axes = object.end.axes = 7;
  const size_t objects = bytes.size / 6 + 1;
  constexpr size_t kMostSteps = 400; // for an object: pieces of a curve, places that are looked at
  size_t steps = 0;
  while (streams[1].phase == StreamPhase::Running || streams[1].phase == StreamPhase::Draining) {
    if (bytes.size == 0)
      queues[0].queue.endOfList = 1;
    else if (!isFull(&queues[0].queue)) {
      object = objectOf(bytes, object);
      append(&queues[0].queue, &object);
    }
    stepStream(streams[0], *tool, &queues[0].queue, &queues[1].queue);
    if (streams[0].phase == StreamPhase::Failed)
      queues[1].queue.endOfList = 1;
    stepStream(streams[1], *loops, &queues[1].queue, &queues[2].queue);
    removeAt(&queues[2].queue, 0);
    if (++steps > kMostSteps * (objects + 10))
      std::abort(); // it does not end
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size > 4096)
    return 0;
  run({data, size}, ToolEntry::Positioning);
  run({data, size}, ToolEntry::Ramp);
  return 0;
}
