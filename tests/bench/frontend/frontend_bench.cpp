// From text to syntax tree, and from text to C++, on the generated project of 100,000 lines in one
// file; as many files with one thread and with two.
#include "compiler/codegen/codegen.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/syntax/parser.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

namespace fs = std::filesystem;

/// The folder that the project is in; empty when Python is missing.
fs::path generated(const std::string &name, const std::string &option) {
  fs::path folder = fs::path(STRIDE_BINARY_DIR) / "bench" / name;
  const std::string command = "python3 '" STRIDE_SOURCE_DIR
                              "/tests/bench/frontend/generate_project.py' 100000 '" +
                              folder.string() + "' " + option;
  return std::system(command.c_str()) == 0 ? folder : fs::path();
}

/// Empty when Python is missing.
const std::string &projectText() {
  static const std::string text = [] {
    std::ifstream in(generated("generated", "--one-file") / "Main.st", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }();
  return text;
}

void parseProject(benchmark::State &state) {
  stc::Sources sources;
  const stc::SourceFile &file = sources.file(sources.add("Main.st", projectText()));
  if (file.text().empty()) {
    state.SkipWithError("the project cannot be generated");
    return;
  }
  size_t bytes = 0;
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
  state.SetItemsProcessed(static_cast<int64_t>(lines) * state.iterations());
  state.SetBytesProcessed(static_cast<int64_t>(file.text().size()) * state.iterations());
  state.counters["tree_bytes_per_line"] = static_cast<double>(bytes) / lines;
}
BENCHMARK(parseProject)->Unit(benchmark::kMillisecond);

/// Peak resident memory of this process in bytes, 0 where /proc does not tell.
double peakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:"))
      return std::strtod(line.c_str() + 6, nullptr) * 1024;
  }
  return 0;
}

/// Parses, checks and generates on one core; the counters are the share of each phase (the
/// profile), and the process's peak memory per line, which the text itself and the generated C++
/// are part of.
void compileProject(benchmark::State &state) {
  using Clock = std::chrono::steady_clock;
  const std::string &text = projectText();
  if (text.empty()) {
    state.SkipWithError("the project cannot be generated");
    return;
  }
  const stc::EmbeddedLibraryIndex library(stc::standardLibrary());
  double lines = 0;
  std::chrono::duration<double> parsing{0}, checking{0}, generating{0};
  for (auto _ : state) {
    stc::Program program;
    const auto start = Clock::now();
    const stc::SourceFile &file = program.sources.file(program.sources.add("Main.st", text));
    stc::ast::File *tree = stc::parse(file, program.interner, program.arena, program.diagnostics);
    const auto parsed = Clock::now();
    stc::check(program, {tree}, library);
    const auto checked = Clock::now();
    if (program.diagnostics.hasErrors()) {
      state.SkipWithError("the project has errors");
      return;
    }
    stc::AppConfig config;
    config.name = "bench";
    benchmark::DoNotOptimize(stc::generateApplication(program, config));
    generating += Clock::now() - checked;
    checking += checked - parsed;
    parsing += parsed - start;
    lines = static_cast<double>(file.lineCount());
  }
  state.SetItemsProcessed(static_cast<int64_t>(lines) * state.iterations());
  const auto total = (parsing + checking + generating).count();
  state.counters["parse_percent"] = 100 * parsing.count() / total;
  state.counters["check_percent"] = 100 * checking.count() / total;
  state.counters["generate_percent"] = 100 * generating.count() / total;
  state.counters["peak_bytes_per_line"] = peakMemory() / lines;
}
BENCHMARK(compileProject)->Unit(benchmark::kMillisecond);

/// What `stride check` does with 755 files; the argument is the number of threads.
void checkFolder(benchmark::State &state) {
  static const fs::path folder = generated("generated_files", "");
  if (folder.empty()) {
    state.SkipWithError("the project cannot be generated");
    return;
  }
  const stc::EmbeddedLibraryIndex library(stc::standardLibrary());
  stc::Settings settings;
  settings.jobs = static_cast<unsigned>(state.range(0));
  for (auto _ : state) {
    const stc::Project project(folder, stc::Purpose::Check, settings, library);
    if (project.hasErrors()) {
      state.SkipWithError("the project has errors");
      return;
    }
  }
}
BENCHMARK(checkFolder)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

} // namespace
