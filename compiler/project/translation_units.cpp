#include "compiler/project/translation_units.hpp"

#include "compiler/source/content_hash.hpp"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace stc {

namespace {

/// Bytes of the sources of a unit. An edit compiles all of them, a build from nothing pays for each
/// unit: g++ takes 30 ms for any, and for a byte of a body 8 to 12 µs, of one that runs once 5.
constexpr size_t kMostBytes = 24U << 10U;
constexpr size_t kMostBytesOnce = 40U << 10U;

/// Tables of numbers cost g++ a small part of what statements do.
constexpr size_t kTablesPerStatement = 16;

// Not the name of a library: `__` is Stride's.
constexpr std::string_view kFolder = "units__/";

bool isApplication(const GeneratedFile &file) {
  return file.path == "app.cpp" || file.path == "build.cpp";
}

size_t weightOf(const GeneratedFile &file) {
  const size_t tables = isApplication(file) ? file.text.size() : file.tables;
  return file.text.size() - tables + tables / kTablesPerStatement;
}

// The application object has tables, and calls each program once.
bool runsOnce(const GeneratedFile &file) { return file.runsOnce || isApplication(file); }

constexpr size_t mostBytes(bool runsOnce) { return runsOnce ? kMostBytesOnce : kMostBytes; }

struct Source {
  std::string hash; ///< of the path, as bits
  const GeneratedFile *file;
};

std::string bitsOf(std::string_view path) {
  std::string bits;
  for (const char digit : blake2b256(path).substr(0, 16)) {
    const auto value = static_cast<unsigned>(digit <= '9' ? digit - '0' : digit - 'a' + 10);
    for (unsigned bit = 8; bit != 0; bit /= 2)
      bits += (value & bit) != 0 ? '1' : '0';
  }
  return bits;
}

class Divider {
public:
  explicit Divider(std::vector<GeneratedFile> &files) : files_(files) {}

  std::vector<TranslationUnit> run() {
    std::vector<const GeneratedFile *> all;
    for (const GeneratedFile &file : files_)
      if (file.path.ends_with(".cpp"))
        all.push_back(&file);
    // The application object last: it opens namespaces for itself.
    std::sort(all.begin(), all.end(), [](const GeneratedFile *a, const GeneratedFile *b) {
      return std::pair(isApplication(*a), a->path) < std::pair(isApplication(*b), b->path);
    });
    size_t weight = 0;
    for (const GeneratedFile *file : all)
      weight += weightOf(*file);
    if (weight <= kMostBytes) {
      add("all", all);
    } else {
      std::vector<Source> sources[2]; // by runsOnce
      for (const GeneratedFile *file : all) {
        if (isApplication(*file) || weightOf(*file) > mostBytes(file->runsOnce))
          units_.push_back({file->path, titleOf(file->path), runsOnce(*file), file->isNumeric});
        else
          sources[file->runsOnce ? 1 : 0].push_back({bitsOf(file->path), file});
      }
      divide(sources[0], 0, "");
      divide(sources[1], 0, "once");
    }
    for (GeneratedFile &file : added_)
      files_.push_back(std::move(file));
    return std::move(units_);
  }

private:
  static std::string titleOf(std::string_view path) {
    const size_t begin = path.rfind('/') + 1; // 0 without one
    return std::string(path.substr(begin, path.rfind('.') - begin));
  }

  /// Sources whose hashes have the first `depth` bits in common.
  void divide(const std::vector<Source> &sources, size_t depth, const std::string &prefix) {
    if (sources.empty())
      return;
    size_t weight = 0;
    for (const Source &source : sources)
      weight += weightOf(*source.file);
    if (weight <= mostBytes(sources.front().file->runsOnce) || sources.size() == 1 ||
        depth == sources.front().hash.size()) {
      std::vector<const GeneratedFile *> unit;
      for (const Source &source : sources)
        unit.push_back(source.file);
      add(prefix + sources.front().hash.substr(0, depth), unit);
      return;
    }
    std::vector<Source> halves[2];
    for (const Source &source : sources)
      halves[source.hash[depth] == '1' ? 1 : 0].push_back(source);
    divide(halves[0], depth + 1, prefix);
    divide(halves[1], depth + 1, prefix);
  }

  void add(std::string_view name, const std::vector<const GeneratedFile *> &sources) {
    if (sources.size() == 1) {
      units_.push_back({sources.front()->path, titleOf(sources.front()->path),
                        runsOnce(*sources.front()), sources.front()->isNumeric});
      return;
    }
    // Their small bodies are here anyway, and need not be given to callers once more.
    std::string text = "// Compiled together by Stride.\n";
    for (const GeneratedFile *file : sources)
      if (!isApplication(*file))
        text += fmt::format("#define {}\n", besideMacro(file->path));
    for (const GeneratedFile *file : sources)
      text += fmt::format("#include \"{}\"\n", file->path);
    GeneratedFile unit{fmt::format("{}{}.cpp", kFolder, name), std::move(text)};
    units_.push_back(
        {unit.path,
         fmt::format("{} and {} more", titleOf(sources.front()->path), sources.size() - 1),
         std::all_of(sources.begin(), sources.end(),
                     [](const GeneratedFile *file) { return runsOnce(*file); }),
         std::any_of(sources.begin(), sources.end(),
                     [](const GeneratedFile *file) { return file->isNumeric; })});
    added_.push_back(std::move(unit));
  }

  std::vector<GeneratedFile> &files_;
  std::vector<GeneratedFile> added_;
  std::vector<TranslationUnit> units_;
};

} // namespace

std::vector<TranslationUnit> divideIntoUnits(std::vector<GeneratedFile> &files) {
  return Divider(files).run();
}

} // namespace stc
