// What G-code costs, from its text to the objects of the path. DESIGN asks for 300,000 lines/s.
#include "tests/unit/cnc/gcode_text.hpp"

#include <benchmark/benchmark.h>

#include <cstdio>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

/// Short lines, arcs or splines, as programs of three axes have them.
std::string programOf(int kind, int lines) {
  std::string text = "% program\nF100 E500 E-500\n";
  char line[120];
  for (int i = 0; i < lines; ++i) {
    const double x = i * 0.713;
    const double y = (i * 37 % 101) * 0.219;
    if (kind == 0)
      std::snprintf(line, sizeof line, "N%d G1 X%.4f Y%.4f Z%.4f\n", i, x, y, -y);
    else if (kind == 1)
      std::snprintf(line, sizeof line, "N%d G%d X%.4f Y%.4f R%.4f\n", i, 2 + i % 2, x, y, 50.0);
    else
      std::snprintf(line, sizeof line, "N%d G5 X%.4f Y%.4f\n", i, x, y);
    text += line;
  }
  return text;
}

void decodeLines(benchmark::State &state) {
  constexpr int kLines = 10000;
  const std::string text = programOf(static_cast<int>(state.range(0)), kLines);
  static Decoder decoder;
  static Decoded decoded;
  GCodeWord words[kMostWords];
  for (auto _ : state) {
    startDecoder(decoder, {});
    Scanner scanner{};
    int32_t count = 0;
    const auto *bytes = reinterpret_cast<const uint8_t *>(text.data());
    auto left = static_cast<int64_t>(text.size());
    while (left > 0) {
      int64_t used = 0;
      const ScanEvent event = scan(scanner, bytes, left, used);
      bytes += used;
      left -= used;
      if (event == ScanEvent::Word)
        words[count++] = scanner.word;
      else if (event == ScanEvent::EndOfSentence) {
        decodeSentence(decoder, words, count, scanner.line, decoded);
        benchmark::DoNotOptimize(decoded);
        count = 0;
      }
    }
  }
  state.SetItemsProcessed(state.iterations() * kLines);
}

BENCHMARK(decodeLines)->ArgName("kind")->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

} // namespace
