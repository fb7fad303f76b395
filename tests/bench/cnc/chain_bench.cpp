// What a chain costs that makes a path ready to be driven: sentences, their objects, and the
// velocities of their corners. DESIGN asks for 300,000 lines/s.
#include "runtime/numeric/cnc/velocity_check.hpp"
#include "runtime/numeric/nc/interpreter.hpp"
#include "runtime/numeric/nc/reader.hpp"
#include "tests/unit/cnc/gcode_text.hpp"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>

namespace {

using namespace stride;
using namespace stride::cnc;

constexpr int kLines = 10000;
constexpr uint32_t kPlaces = 100;

/// Short lines of three axes, or with expressions.
std::string programOf(bool expressions) {
  std::string text =
      expressions ? "LET #h : LREAL := 2.5\nG17\nF100 E500 E-500\n" : "F100 E500 E-500\n";
  char line[120];
  for (int i = 0; i < kLines; ++i) {
    const double x = i * 0.713;
    const double y = (i * 37 % 101) * 0.219;
    std::snprintf(line, sizeof line,
                  expressions ? "N%d G1 X%.4f Y%.4f+1 Z{#h*sin{%.4f}}\n"
                              : "N%d G1 X%.4f Y%.4f Z%.4f\n",
                  i, x, y, -y);
    text += line;
  }
  return text;
}

/// The queue behind the decoder; somebody takes the objects when it is full.
class Sink {
public:
  Sink() : memory_((kPlaces + 1) * sizeof(PathObject)) {
    queue_.structId = kQueueStructId;
    queue_.buffer = memory_.data();
    queue_.size = static_cast<uint32_t>(memory_.size());
    (void)clear(&queue_);
  }

  void take(const Decoded &decoded) {
    for (int32_t i = 0; i < decoded.count; ++i) {
      while (countOf(&queue_) + 2 >= kPlaces)
        (void)removeAt(&queue_, 0);
      (void)append(&queue_, &decoded.objects[i]);
    }
    benchmark::DoNotOptimize(checkVelocities(&queue_, checked_, {0.01, -1.0}));
  }

private:
  std::vector<uint8_t> memory_;
  Queue queue_{};
  uint32_t checked_ = 0;
};

/// SMC_NCDecoder and SMC_CheckVelocities: words are there, as those of a project are.
void decodeAndCheck(benchmark::State &state) {
  const test::Scanned scanned = test::scanText(programOf(false));
  const auto count = static_cast<int64_t>(scanned.words.size());
  const auto decoder = std::make_unique<Decoder>();
  const auto decoded = std::make_unique<Decoded>();
  for (auto _ : state) {
    Sink sink;
    startDecoder(*decoder, {});
    SentenceWords sentence;
    for (int64_t at = 0; at < count;) {
      at = sentenceAt(scanned.words.data(), count, at, sentence);
      decodeSentence(*decoder, sentence.words, sentence.count, sentence.line, *decoded);
      sink.take(*decoded);
    }
  }
  state.SetItemsProcessed(state.iterations() * kLines);
}

/// SMC_ReadNCFile2, SMC_NCInterpreter and SMC_CheckVelocities, from the text on.
void readAndInterpret(benchmark::State &state) {
  const std::string text = programOf(state.range(0) != 0);
  const auto reader = std::make_unique<nc::Reader>();
  const auto queue = std::make_unique<nc::SentenceQueue>();
  const auto interpreter = std::make_unique<nc::Interpreter>();
  const auto carried = std::make_unique<nc::Carried>();
  const auto decoder = std::make_unique<Decoder>();
  VariableList none{};
  for (auto _ : state) {
    Sink sink;
    nc::beginReading(*reader, *queue, false);
    nc::startInterpreter(*interpreter);
    startDecoder(*decoder, {});
    size_t at = 0;
    for (nc::Outcome outcome = nc::Outcome::Idle; outcome != nc::Outcome::Finished;) {
      int64_t used = 0;
      (void)nc::readProgram(*reader, *queue, {&none, true},
                            reinterpret_cast<const uint8_t *>(text.data()) + at,
                            static_cast<int64_t>(text.size() - at), true, used);
      at += static_cast<size_t>(used);
      do {
        outcome = nc::interpret(*interpreter, *decoder, *queue, false, *carried);
        sink.take(carried->decoded);
      } while (outcome == nc::Outcome::Carried);
      if (outcome == nc::Outcome::Wrong) {
        state.SkipWithError("the program is wrong");
        return;
      }
    }
  }
  state.SetItemsProcessed(state.iterations() * kLines);
}

BENCHMARK(decodeAndCheck)->Unit(benchmark::kMillisecond);
BENCHMARK(readAndInterpret)->ArgName("expressions")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

} // namespace
