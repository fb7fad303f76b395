// From text to syntax tree, on the generated project of 100,000 lines in one file.
#include "compiler/syntax/parser.hpp"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

/// Empty when Python is missing.
const std::string &projectText() {
  static const std::string text = [] {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(STRIDE_BINARY_DIR) / "bench" / "generated";
    const std::string command = "python3 '" STRIDE_SOURCE_DIR
                                "/tests/bench/frontend/generate_project.py' 100000 '" +
                                folder.string() + "' --one-file";
    if (std::system(command.c_str()) != 0)
      return std::string{};
    std::ifstream in(folder / "Main.st", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }();
  return text;
}

void parseProject(benchmark::State &state) {
  stc::SourceManager sources;
  const stc::SourceFile &file = sources.file(sources.add("Main.st", projectText()));
  if (file.text().empty()) {
    state.SkipWithError("the project cannot be generated");
    return;
  }
  std::size_t bytes = 0;
  for (auto _ : state) {
    stc::Interner interner;
    stc::Arena arena;
    stc::Diagnostics diagnostics;
    benchmark::DoNotOptimize(stc::parse(file, interner, arena, diagnostics));
    if (diagnostics.hasErrors()) {
      state.SkipWithError("the project has errors");
      return;
    }
    bytes = arena.bytes();
  }
  const auto lines = static_cast<double>(file.lineCount());
  state.SetItemsProcessed(static_cast<std::int64_t>(lines) * state.iterations());
  state.SetBytesProcessed(static_cast<std::int64_t>(file.text().size()) * state.iterations());
  state.counters["tree_bytes_per_line"] = static_cast<double>(bytes) / lines;
}
BENCHMARK(parseProject)->Unit(benchmark::kMillisecond);

} // namespace
