// What each stage of a whole chain takes of a program of 100,000 lines: decoder, tool correction,
// loops, corners, limits on arcs, velocities of corners, interpolator with cycles of 1 ms. Queues
// are between them; the interpolator drives what is there, then the others work again.
#include "tests/unit/cnc/gcode_text.hpp"

#include "runtime/numeric/cnc/interpolator.hpp"
#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/corner_path.hpp"
#include "runtime/numeric/cnc/processors/limit_circular.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace stride;
using namespace stride::cnc;

constexpr int kLines = 100000;

/// A winding contour of lines, each tenth of it an arc, with corners of up to 30 degrees.
std::string programOf() {
  std::string text = "F1000 E30000 E-30000\nG41 D0.3\nG51 D0.2\nG61\n";
  char line[120];
  double x = 0;
  double y = 0;
  double heading = 0;
  for (int i = 0; i < kLines; ++i) {
    const double way = 1.0 + 0.5 * (i * 37 % 11) / 11.0;
    heading = 1.2 * std::sin(0.013 * i) + 0.25 * (i % 2 == 0 ? 1 : -1);
    x += way * std::cos(heading);
    y += way * std::sin(heading);
    if (i % 10 == 7)
      std::snprintf(line, sizeof line, "N%d G3 X%.4f Y%.4f R4\n", i, x, y);
    else
      std::snprintf(line, sizeof line, "N%d G1 X%.4f Y%.4f\n", i, x, y);
    text += line;
  }
  return text;
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

/// The time that has been spent in each stage, and how many objects it has put out. [s]
enum Stage : uint8_t { kDecode, kTool, kLoops, kCorners, kLimit, kCheck, kDrive, kStages };
constexpr const char *kNames[kStages] = {"decoder", "tool",  "loops",       "corners",
                                         "limits",  "check", "interpolator"};

class Chain {
public:
  explicit Chain(const test::Scanned &scanned) : words_(scanned.words) {
    startDecoder(*decoder_, {});
    startStream(toolStream_, &queues_[1]->queue, ToolCorrection::kGenerator, false);
    startStream(loopStream_, &queues_[2]->queue, LoopAvoider::kGenerator, false);
    startStream(cornerStream_, &queues_[3]->queue, SmoothPath::kGenerator, false);
    startStream(limitStream_, &queues_[4]->queue, LimitCircular::kGenerator, false);
    start(*tool_);
    start(*loops_);
    corners_->kind = PieceKind::Quintic;
    corners_->rule = DistanceRule::CornerDistanceAdded;
    start(*corners_);
    limit_->acceleration = 30000;
    start(*limit_);
    decoder_->softMotion3 = true;
    command_.queue = &queues_[4]->queue;
    command_.cycle = 0.001;
    command_.override = command_.share = 1;
    command_.jerk = 3e6;
    command_.law = path::LawKind::Jerk;
    command_.budget = 64;
  }

  /// Until the path has been driven. False: something went wrong.
  bool run() {
    constexpr uint32_t kLow = 120; // objects that are left when the others work again
    constexpr int kMost = 10000;
    constexpr int64_t kMostCycles = 10000000; // the path takes a million
    Queue &last = queues_[4]->queue;
    const auto runs = [this] {
      return interpolator_->phase != Phase::Finished && interpolator_->phase != Phase::Failed &&
             cycles_ < kMostCycles;
    };
    for (bool begun = false; runs(); begun = true) {
      for (int i = 0; i < kMost && !isFull(&last) && limitStream_.phase == StreamPhase::Running;
           ++i)
        fill();
      measured(kCheck, [&] { (void)checkVelocities(&last, checked_, {0.01, -1.0}); });
      last.generator = kByCheckVelocities;
      if (!begun)
        start(*interpolator_, command_);
      measured(kDrive, [&] {
        do {
          cycle(*interpolator_, command_);
          ++cycles_;
        } while (runs() && (countOf(&last) > kLow || last.endOfList != 0));
      });
    }
    return interpolator_->phase == Phase::Finished && limitStream_.phase == StreamPhase::Done;
  }

  double seconds[kStages] = {};
  int64_t cycles_ = 0;

private:
  template <class Work> void measured(Stage stage, const Work &work) {
    const double begin = processorTime();
    work();
    seconds[stage] += processorTime() - begin;
  }
  /// Others may be busy on the machine. [s]
  static double processorTime() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  /// Each stage works until its output is full or its input empty.
  void fill() {
    measured(kDecode, [&] { decode(); });
    measured(kTool, [&] { work(toolStream_, *tool_, 0); });
    measured(kLoops, [&] { work(loopStream_, *loops_, 1); });
    measured(kCorners, [&] { work(cornerStream_, *corners_, 2); });
    measured(kLimit, [&] { work(limitStream_, *limit_, 3); });
  }

  void decode() {
    Queue &queue = queues_[0]->queue;
    const auto count = static_cast<int64_t>(words_.size());
    while (!isFull(&queue) && at_ < count) {
      SentenceWords sentence;
      at_ = sentenceAt(words_.data(), count, at_, sentence);
      decodeSentence(*decoder_, sentence.words, sentence.count, sentence.line, *decoded_);
      take(queue);
    }
    if (at_ >= count && queue.endOfList == 0 && !isFull(&queue)) {
      decodeEnd(*decoder_, *decoded_);
      take(queue);
      queue.endOfList = 1;
    }
  }

  void take(Queue &queue) {
    for (int32_t i = 0; i < decoded_->count; ++i)
      (void)append(&queue, &decoded_->objects[i]);
  }

  template <class Processor> void work(StreamState &stream, Processor &processor, size_t input) {
    constexpr int kMost = 64;
    Queue *from = &queues_[input]->queue;
    Queue *to = &queues_[input + 1]->queue;
    for (int i = 0; i < kMost && !isFull(to) && stream.phase == StreamPhase::Running; ++i) {
      const uint32_t waiting = countOf(from);
      stepStream(stream, processor, from, to);
      if (waiting == 0)
        break;
    }
  }

  const std::vector<GCodeWord> &words_;
  int64_t at_ = 0;
  uint32_t checked_ = UINT32_MAX;
  std::vector<std::unique_ptr<Memory>> queues_ = [] {
    std::vector<std::unique_ptr<Memory>> queues;
    for (const uint32_t places : {50U, 500U, 50U, 50U, 300U})
      queues.push_back(std::make_unique<Memory>(places));
    return queues;
  }();
  std::unique_ptr<Decoder> decoder_ = std::make_unique<Decoder>();
  std::unique_ptr<Decoded> decoded_ = std::make_unique<Decoded>();
  std::unique_ptr<ToolCorrection> tool_ = std::make_unique<ToolCorrection>();
  std::unique_ptr<LoopAvoider> loops_ = std::make_unique<LoopAvoider>();
  std::unique_ptr<SmoothPath> corners_ = std::make_unique<SmoothPath>();
  std::unique_ptr<LimitCircular> limit_ = std::make_unique<LimitCircular>();
  std::unique_ptr<Interpolator> interpolator_ = std::make_unique<Interpolator>();
  StreamState toolStream_{}, loopStream_{}, cornerStream_{}, limitStream_{};
  Command command_{};
};

/// Counters: nanoseconds for each line of the program, and what part of the whole that is.
void sharesOfAChain(benchmark::State &state) {
  const test::Scanned scanned = test::scanText(programOf());
  double least[kStages];
  double shortest = 1e300;
  int64_t cycles = 0;
  for (auto _ : state) {
    const auto chain = std::make_unique<Chain>(scanned);
    if (!chain->run()) {
      state.SkipWithError("the path has not been driven");
      return;
    }
    double sum = 0;
    for (const double seconds : chain->seconds)
      sum += seconds;
    state.SetIterationTime(sum);
    cycles = chain->cycles_;
    if (sum >= shortest)
      continue;
    shortest = sum;
    std::copy(std::begin(chain->seconds), std::end(chain->seconds), least);
  }
  for (size_t i = 0; i < kStages; ++i) {
    state.counters[std::string(kNames[i]) + "_ns"] = least[i] / kLines * 1e9;
    state.counters[std::string(kNames[i]) + "_%"] = least[i] / shortest * 100;
  }
  state.counters["cycles"] = static_cast<double>(cycles);
  state.SetItemsProcessed(state.iterations() * kLines);
}

BENCHMARK(sharesOfAChain)->Iterations(2)->UseManualTime()->Unit(benchmark::kMillisecond);

} // namespace
