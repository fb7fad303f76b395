// The rooms of the house, by what the sources say (docs/developers/contributing.md): who may
// include whom, what a folder's library consists of, where native bodies are.
#include "tests/support/text.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace stride::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = STRIDE_SOURCE_DIR;

/// Whom a room may include besides itself. Rooms below a name ending with a slash are meant, too;
/// "st" are the headers that the compiler makes of stdlib.
const std::map<std::string, std::vector<std::string>> kArrows = {
    {"compiler/source", {}},
    {"compiler/syntax", {"compiler/source"}},
    {"compiler/semantics", {"compiler/syntax", "compiler/source", "runtime/iec"}},
    {"compiler/semantics/lookup", {"compiler/semantics", "compiler/syntax", "compiler/source"}},
    {"compiler/semantics/context",
     {"compiler/semantics/lookup", "compiler/semantics", "compiler/source"}},
    {"compiler/semantics/checking",
     {"compiler/semantics/context", "compiler/semantics", "compiler/syntax", "compiler/source",
      "runtime/numeric/csy"}},
    {"compiler/semantics/statements",
     {"compiler/semantics/checking", "compiler/semantics/context", "compiler/semantics",
      "compiler/syntax", "compiler/source"}},
    {"compiler/semantics/lint",
     {"compiler/semantics/context", "compiler/semantics", "compiler/syntax", "compiler/source"}},
    {"compiler/semantics/sharing", {"compiler/semantics", "compiler/syntax", "compiler/source"}},
    {"compiler/semantics/program",
     {"compiler/semantics/lint", "compiler/semantics/statements", "compiler/semantics/checking",
      "compiler/semantics/context", "compiler/semantics/lookup", "compiler/semantics"}},
    {"compiler/codegen/cpp", {"compiler/semantics", "compiler/syntax", "compiler/source"}},
    {"compiler/codegen/analysis",
     {"compiler/codegen/cpp", "compiler/semantics", "compiler/syntax"}},
    {"compiler/codegen/context",
     {"compiler/codegen/analysis", "compiler/codegen/cpp", "compiler/semantics",
      "compiler/syntax"}},
    {"compiler/codegen/emission",
     {"compiler/codegen/context", "compiler/codegen/cpp", "compiler/semantics", "compiler/syntax"}},
    {"compiler/codegen",
     {"compiler/codegen/emission", "compiler/codegen/context", "compiler/codegen/analysis",
      "compiler/codegen/cpp", "compiler/semantics", "compiler/syntax", "compiler/source"}},
    {"compiler/toml", {"compiler/semantics", "compiler/syntax", "compiler/source"}},
    {"compiler/assets/cam",
     {"compiler/toml", "compiler/syntax", "compiler/source", "runtime/numeric/"}},
    {"compiler/assets/cnc",
     {"compiler/syntax", "compiler/source", "runtime/numeric/", "runtime/iec"}},
    {"compiler/assets/cnc_edit", {"compiler/assets/cnc", "compiler/source", "runtime/numeric/"}},
    {"compiler/assets/csy",
     {"compiler/toml", "compiler/source", "runtime/numeric/", "runtime/common"}},
    {"compiler/assets/eds", {}},
    {"compiler/assets/dxf",
     {"compiler/assets/cnc_edit", "compiler/assets/cnc", "compiler/source", "runtime/numeric/"}},
    {"compiler/project",
     {"compiler/assets/", "compiler/toml", "compiler/codegen", "compiler/semantics",
      "compiler/syntax", "compiler/source", "runtime/bus", "runtime/io", "drivers", "drivers/io"}},
    {"compiler/import/networks", {"compiler/source"}},
    {"compiler/import", {"compiler/import/networks", "compiler/syntax", "compiler/source"}},
    {"compiler/plot", {"compiler/source"}},
    {"compiler/export",
     {"compiler/project", "compiler/semantics", "compiler/syntax", "compiler/source"}},
    {"compiler/doc",
     {"compiler/project", "compiler/semantics", "compiler/syntax", "compiler/source"}},
    {"compiler/cli",
     {"compiler/doc", "compiler/export", "compiler/import", "compiler/plot", "compiler/project",
      "compiler/assets/", "compiler/toml", "compiler/codegen", "compiler/semantics/lookup",
      "compiler/semantics", "compiler/syntax", "compiler/source", "runtime/numeric/"}},
    {"runtime/common", {}},
    {"runtime/iec", {}},
    {"runtime/numeric", {"runtime/iec"}},
    {"runtime/numeric/profile", {"runtime/numeric", "runtime/iec"}},
    {"runtime/numeric/cam", {"runtime/numeric", "runtime/iec"}},
    {"runtime/numeric/path", {"runtime/numeric", "runtime/iec"}},
    {"runtime/numeric/cnc", {"runtime/numeric/path", "runtime/numeric", "runtime/iec"}},
    {"runtime/numeric/cnc/processors",
     {"runtime/numeric/cnc", "runtime/numeric/path", "runtime/numeric", "runtime/iec"}},
    {"runtime/numeric/kinematics", {"runtime/numeric", "runtime/iec"}},
    {"runtime/numeric/group",
     {"runtime/numeric/kinematics", "runtime/numeric/path", "runtime/numeric/profile",
      "runtime/numeric", "runtime/iec"}},
    {"runtime/numeric/csy",
     {"runtime/numeric/path", "runtime/numeric/profile", "runtime/numeric", "runtime/iec"}},
    {"runtime/numeric/nc", {"runtime/numeric/cnc", "runtime/numeric", "runtime/iec"}},
    {"runtime/axis", {"runtime/numeric/", "runtime/iec", "st"}},
    {"runtime/axis/cam", {"runtime/axis", "runtime/numeric/", "runtime/iec", "st"}},
    // app: the context of a call (ctx.h); system: the interface to the host (system_api.h).
    {"runtime/blocks",
     {"runtime/axis/", "runtime/numeric/", "runtime/iec", "runtime/app", "runtime/system", "st"}},
    {"runtime/bus", {"runtime/axis", "runtime/iec", "st"}},
    {"runtime/app", {"runtime/iec"}},
    {"runtime/system", {"runtime/iec"}},
    {"runtime/task", {"runtime/app", "runtime/iec"}},
    {"runtime/io", {"runtime/task", "runtime/app", "runtime/iec"}},
    {"runtime/script", {"runtime/task", "runtime/app", "runtime/iec"}},
    {"runtime/monitor", {"runtime/script", "runtime/task", "runtime/app", "runtime/iec"}},
    {"runtime/host",
     {"runtime/monitor", "runtime/script", "runtime/task", "runtime/bus", "runtime/io",
      "runtime/system", "runtime/app", "runtime/iec", "drivers", "drivers/io", "st"}},
    {"runtime/embed",
     {"runtime/host", "runtime/monitor", "runtime/script", "runtime/task", "runtime/app"}},
    {"drivers", {"drivers/dummy", "drivers/can", "drivers/sercos", "runtime/bus"}},
    {"drivers/dummy", {"runtime/bus", "runtime/iec", "st"}},
    {"drivers/can/port", {}},
    {"drivers/can/log", {"drivers/can/port"}},
    {"drivers/can/simulation",
     {"drivers/can/port", "drivers/dummy", "runtime/bus", "runtime/iec", "st"}},
    {"drivers/sercos/protocol", {}},
    {"drivers/sercos/ring", {"drivers/sercos/protocol"}},
    {"drivers/sercos/plan", {"drivers/sercos/protocol", "runtime/bus"}},
    {"drivers/sercos/master",
     {"drivers/sercos/plan", "drivers/sercos/ring", "drivers/sercos/protocol", "runtime/bus",
      "runtime/iec"}},
    {"drivers/sercos",
     {"drivers/sercos/master", "drivers/sercos/simulation", "drivers/sercos/plan",
      "drivers/sercos/ring", "drivers/sercos/protocol", "drivers/dummy", "runtime/bus",
      "runtime/iec", "st"}},
    {"drivers/sercos/simulation",
     {"drivers/sercos/ring", "drivers/sercos/protocol", "drivers/dummy", "runtime/bus",
      "runtime/iec", "st"}},
    {"drivers/io", {"runtime/io", "runtime/app", "drivers/can"}},
    {"drivers/can/plan", {"drivers/can/port", "runtime/bus"}},
    {"drivers/can/master", {"drivers/can/plan", "drivers/can/port", "runtime/bus", "runtime/iec"}},
    {"drivers/can",
     {"drivers/can/master", "drivers/can/simulation", "drivers/can/socket", "drivers/can/plan",
      "drivers/can/port", "drivers/can/log", "drivers/dummy", "runtime/bus", "runtime/io", "st"}},
    {"drivers/can/socket", {"drivers/can/port"}},
    {"drivers/can/tool",
     {"drivers/can", "drivers/can/master", "drivers/can/simulation", "drivers/can/socket",
      "drivers/can/plan", "drivers/can/port", "runtime/host", "runtime/app", "runtime/bus"}},
};

bool isSource(const fs::path &path) {
  const std::string ending = path.extension().string();
  return ending == ".cpp" || ending == ".hpp" || ending == ".h";
}

std::vector<fs::path> sourcesBelow(const std::string &folder) {
  std::vector<fs::path> found;
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(kRoot / folder))
    if (entry.is_regular_file() && isSource(entry.path()))
      found.push_back(entry.path().lexically_relative(kRoot));
  std::sort(found.begin(), found.end());
  return found;
}

/// Folders that need each other in circles (declarations need the values of constants, expressions
/// need declarations) are one library and one room: its name, and where they lie.
struct Circle {
  const char *room;
  const char *top;
  std::vector<const char *> folders;
};

const std::vector<Circle> &circles() {
  static const std::vector<Circle> kCircles = {
      {"compiler/semantics/checking",
       "compiler/semantics/",
       {"builtins", "calls", "classes", "config", "declarations", "expressions", "names", "types"}},
      {"compiler/codegen/emission",
       "compiler/codegen/",
       {"calls", "expressions", "initial", "places", "statements"}},
  };
  return kCircles;
}

/// The longest name of a room that the path lies in; empty: none.
std::string roomOf(const std::string &path) {
  for (const Circle &circle : circles())
    for (const char *folder : circle.folders)
      if (path.starts_with(std::string(circle.top) + folder + "/"))
        return circle.room;
  if (path.starts_with("st/"))
    return "st";
  std::string best;
  for (const auto &[room, allowed] : kArrows)
    if (path.starts_with(room + "/") && room.size() > best.size())
      best = room;
  return best;
}

bool mayInclude(const std::string &room, const std::string &other) {
  // What all have in common depends on nothing; code of applications does without.
  if (other == "runtime/common")
    return !room.starts_with("runtime/iec") && !room.starts_with("runtime/numeric") &&
           !room.starts_with("runtime/axis") && !room.starts_with("runtime/blocks");
  const std::vector<std::string> &allowed = kArrows.at(room);
  return room == other || std::any_of(allowed.begin(), allowed.end(), [&](const std::string &one) {
           return one == other || (one.ends_with('/') && (other + "/").starts_with(one));
         });
}

std::vector<std::string> matches(const std::string &text, const std::regex &pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

std::vector<std::string> includesOf(const fs::path &source) {
  static const std::regex kInclude(R"re(#include "([^"]+)")re");
  return matches(readFile(kRoot / source), kInclude);
}

TEST(House, ArrowsPointDown) {
  size_t looked = 0;
  for (const char *top : {"compiler", "runtime", "drivers"})
    for (const fs::path &source : sourcesBelow(top)) {
      const std::string room = roomOf(source.string());
      if (source.string().find("/tools/") != std::string::npos ||
          source.string().find("/gdb/") != std::string::npos)
        continue;
      ASSERT_FALSE(room.empty()) << source << " lies in no room: name it in kArrows";
      for (const std::string &name : includesOf(source)) {
        const std::string other = roomOf(name);
        ++looked;
        EXPECT_TRUE(other.empty() || mayInclude(room, other)) << source << " includes " << name;
      }
    }
  EXPECT_GT(looked, 1000U);
}

/// Of drivers and their interfaces the compiler sees data only.
TEST(House, TheCompilerKnowsDriversBySchemasOnly) {
  static const std::regex kSchema(
      ".*schema\\.hpp|runtime/bus/group_(setup|check)\\.hpp|drivers/(io/)?registry\\.hpp");
  size_t looked = 0;
  for (const fs::path &source : sourcesBelow("compiler"))
    for (const std::string &name : includesOf(source)) {
      if (!name.starts_with("drivers/") && !name.starts_with("runtime/bus/") &&
          !name.starts_with("runtime/io/"))
        continue;
      ++looked;
      EXPECT_TRUE(std::regex_match(name, kSchema)) << source << " includes " << name;
    }
  EXPECT_GT(looked, 4U);
}

TEST(House, ThereAreNoCircles) {
  // By the arrows that are really used.
  std::map<std::string, std::set<std::string>> used;
  for (const char *top : {"compiler", "runtime", "drivers"})
    for (const fs::path &source : sourcesBelow(top))
      for (const std::string &name : includesOf(source))
        if (const std::string from = roomOf(source.string()), to = roomOf(name);
            !from.empty() && !to.empty() && from != to)
          used[from].insert(to);
  std::set<std::string> done;
  for (size_t before = 1; before != 0;) { // what only leads to what is done is done
    before = 0;
    for (const auto &[room, others] : used)
      if (!done.contains(room) &&
          std::all_of(others.begin(), others.end(), [&](const std::string &other) {
            return done.contains(other) || !used.contains(other);
          }))
        before += done.insert(room).second ? 1 : 0;
  }
  for (const auto &[room, others] : used)
    EXPECT_TRUE(done.contains(room)) << room << " is part of a circle";
}

TEST(House, NumericsThatApplicationsLinkUseNoHeapAndNoSystem) {
  static const std::regex kSystem("#include <([^>]+)>");
  const std::set<std::string> allowed = {"algorithm", "array",    "bit",      "cmath",
                                         "cstddef",   "cstdint",  "cstring",  "limits",
                                         "math.h",    "stddef.h", "stdint.h", "span"};
  for (const char *folder : {"runtime/numeric", "runtime/axis", "runtime/blocks"})
    for (const fs::path &source : sourcesBelow(folder)) {
      if (source.stem() == "reduce") // for the tools
        continue;
      for (const std::string &name : matches(readFile(kRoot / source), kSystem))
        EXPECT_TRUE(allowed.contains(name) || name.starts_with("Eigen/"))
            << source << " includes <" << name << ">";
    }
}

TEST(House, AFolderIsALibrary) {
  static const std::regex kOther(
      R"((\$\{PROJECT_SOURCE_DIR\}/(?:compiler|runtime|drivers)/\S+\.cpp|\.\./\S+\.cpp))");
  size_t lists = 0;
  for (const char *top : {"compiler", "runtime", "drivers", "stdlib", "tests", "examples"})
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(kRoot / top)) {
      if (entry.path().filename() != "CMakeLists.txt")
        continue;
      ++lists;
      const std::string text =
          std::regex_replace(readFile(entry.path()), std::regex("#[^\n]*"), "");
      const std::string name = entry.path().lexically_relative(kRoot).string();
      EXPECT_THAT(matches(text, kOther), ::testing::IsEmpty()) << name;
      if (std::string(top) == "tests")
        continue;
      // Each source of the folder is named once.
      for (const fs::directory_entry &source : fs::directory_iterator(entry.path().parent_path())) {
        if (source.path().extension() != ".cpp")
          continue;
        const std::regex word("(?:^|[\\s(])(" + source.path().stem().string() +
                              "\\.cpp)(?=[\\s)])");
        std::string named = std::regex_replace(
            text,
            std::regex("SHARED_BY_THREADS[^)]*?(?=DEPS|\\))|set_source_files_properties[^)]*\\)"),
            "");
        EXPECT_EQ(matches(named, word).size(), 1U) << name << ' ' << source.path().filename();
      }
    }
  EXPECT_GT(lists, 30U);
}

/// What `{external}` blocks and functions of a library are implemented is next to each other.
TEST(House, NativeBodiesLieInTheFolderOfTheirLibrary) {
  size_t bodies = 0;
  for (const fs::directory_entry &library : fs::directory_iterator(kRoot / "stdlib")) {
    if (!library.is_directory())
      continue;
    const std::string name = library.path().filename().string();
    std::set<std::string> included; // by the sources of runtime/blocks/NAME
    if (fs::exists(kRoot / "runtime/blocks" / name))
      for (const fs::path &source : sourcesBelow("runtime/blocks/" + name))
        for (const std::string &header : includesOf(source))
          included.insert(header);
    for (const fs::directory_entry &file : fs::directory_iterator(library.path())) {
      if (file.path().extension() != ".st" ||
          readFile(file.path()).find("\n{external}") == std::string::npos)
        continue;
      ++bodies;
      const std::string header = "st/" + name + "/" + file.path().stem().string() + ".h";
      EXPECT_TRUE(included.contains(header))
          << "nothing in runtime/blocks/" << name << " includes " << header;
    }
  }
  EXPECT_GT(bodies, 90U);
}

/// The text of a source of a test and of the tests' headers that it includes.
std::string withHeaders(const fs::path &source) {
  std::string text = readFile(kRoot / source);
  for (const std::string &include : includesOf(source))
    if (include.starts_with("tests/"))
      text += withHeaders(include);
  return text;
}

/// A test that is built alone finds the programs that it starts, and not those of last week.
TEST(House, TestsThatStartProgramsSayThatTheyDo) {
  const std::regex test(R"re((?:stride_(?:thread_|property_)?test)\(([^)]*)\))re");
  const std::regex file(R"re(([\w/]+\.cpp))re");
  size_t starting = 0;
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(kRoot / "tests")) {
    if (entry.path().filename() != "CMakeLists.txt")
      continue;
    const fs::path folder = entry.path().parent_path().lexically_relative(kRoot);
    for (const std::string &words : matches(readFile(entry.path()), test)) {
      bool starts = false;
      for (const std::string &source : matches(words, file))
        starts = starts || (fs::exists(kRoot / folder / source) &&
                            withHeaders(folder / source).find("STRIDE_BINARY_DIR \"/stride") !=
                                std::string::npos);
      if (!starts)
        continue;
      ++starting;
      EXPECT_NE(words.find("STARTS_PROGRAMS"), std::string::npos) << folder << ": " << words;
    }
  }
  EXPECT_GT(starting, 15U);
}

/// One dialect: the guard of a header is its path, and integers are written without `std::`.
TEST(House, HeadersHaveTheGuardOfTheirPath) {
  static const std::regex kSpelling("(std"
                                    "::(?:u?int[0-9]+_t|size_t|ptrdiff_t))");
  size_t headers = 0;
  for (const char *top : {"compiler", "runtime", "drivers", "tests", "cmake"})
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(kRoot / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".hpp" && extension != ".h" && extension != ".cpp")
        continue;
      const std::string path = entry.path().lexically_relative(kRoot).string();
      const std::string text = readFile(entry.path());
      EXPECT_THAT(matches(text, kSpelling), ::testing::IsEmpty()) << path;
      if (extension == ".cpp" ||
          path.starts_with("cmake/pch/")) // the compiler's own list of headers
        continue;
      ++headers;
      std::string guard = "STRIDE_" + path;
      for (char &c : guard)
        c = std::isalnum(static_cast<unsigned char>(c)) != 0
                ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
                : '_';
      EXPECT_NE(text.find("#ifndef " + guard + "\n#define " + guard + "\n"), std::string::npos)
          << path;
      EXPECT_TRUE(text.ends_with("#endif // " + guard + "\n") || text.ends_with("#endif\n"))
          << path;
    }
  EXPECT_GT(headers, 350U);
}

/// Who reads a source sees what it is about. Tables of texts (`.def`) are as long as they must be;
/// functions have 60 lines at most, which `.clang-tidy` sees to.
TEST(House, FilesHaveFiveHundredLinesAtMost) {
  size_t looked = 0;
  for (const char *top : {"compiler", "runtime", "drivers", "tests"})
    for (const fs::path &source : sourcesBelow(top)) {
      const std::string text = readFile(kRoot / source);
      ++looked;
      EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 500)
          << source << " is too long: part it by topic";
    }
  EXPECT_GT(looked, 900U);
}

/// A test that no CMakeLists.txt names is compiled by nobody.
TEST(House, EveryTestIsBuilt) {
  std::string lists;
  std::vector<fs::path> tests;
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(kRoot / "tests")) {
    const std::string name = entry.path().filename().string();
    if (name == "CMakeLists.txt")
      lists += readFile(entry.path());
    else if (name.ends_with("_test.cpp") || name.ends_with("_property.cpp") ||
             name.ends_with("_stress.cpp"))
      tests.push_back(entry.path());
  }
  EXPECT_GT(tests.size(), 100U);
  for (const fs::path &test : tests)
    EXPECT_TRUE(
        std::regex_search(lists, std::regex("(^|[\\s/])" + test.stem().string() + "\\.cpp")))
        << test;
}

} // namespace
} // namespace stride::test
