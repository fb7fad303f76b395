// Properties of the formatter, over every source of the repository: it changes neither tokens nor
// comments nor the syntax tree, formats its own result to the same text, and does not depend on the
// blanks it finds.
#include "compiler/syntax/format.hpp"
#include "compiler/syntax/format_items.hpp"
#include "tests/unit/syntax/print_ast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace stc::test {
namespace {

namespace fs = std::filesystem;

constexpr size_t kLongFile = 60'000; // checked without variations
#ifdef __SANITIZE_ADDRESS__          // 25 times as slow
constexpr size_t kEvery = 8;         // of the sources
#else
constexpr size_t kEvery = 1;
#endif

struct Source {
  std::string name;
  std::string text;
};

bool isClean(const Parsed &parsed) {
  const auto &all = parsed.diagnostics.all();
  return std::none_of(all.begin(), all.end(), [](const Diagnostic &diagnostic) {
    return diagnostic.severity == Severity::Error;
  });
}

/// The sources of the repository that have no syntax errors and that `stride fmt` changes; each
/// kEveryth of them.
const std::vector<Source> &sources() {
  static const std::vector<Source> all = [] {
    std::vector<fs::path> files;
    for (const char *folder :
         {"stdlib", "examples", "tests/golden", "tests/system", "tests/bench"}) {
      for (const auto &entry :
           fs::recursive_directory_iterator(fs::path(STRIDE_SOURCE_DIR) / folder)) {
        if (entry.path().extension() == ".st")
          files.push_back(entry.path());
      }
    }
    std::sort(files.begin(), files.end());
    std::vector<Source> out;
    for (size_t i = 0; i < files.size(); i += kEvery) {
      std::ifstream in(files[i], std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      Sources manager;
      const FileId id = manager.addBytes("x", bytes);
      std::string text(manager.file(id).text());
      const Parsed parsed(text);
      if (isClean(parsed) && !parsed.file->hasInstructions &&
          !parsed.file->hasChart) // whose lines stay as they are
        out.push_back({fs::relative(files[i], STRIDE_SOURCE_DIR).string(), std::move(text)});
    }
    return out;
  }();
  return all;
}

std::vector<FormatItem> itemsOf(const Sources &manager, FileId id) {
  return readItems(manager.file(id));
}

std::optional<std::string> formatText(const std::string &text, const FormatStyle &style = {}) {
  Sources manager;
  return format(manager.file(manager.add("T.st", text)), style);
}

/// The formatted text, once it has been shown to be stable.
std::string stable(const std::string &text, const FormatStyle &style = {}) {
  const std::optional<std::string> once = formatText(text, style);
  EXPECT_TRUE(once.has_value()) << "formatting would change:\n" << text;
  if (!once)
    return {};
  const std::optional<std::string> twice = formatText(*once, style);
  EXPECT_EQ(once, twice) << "formatted again it is different; from:\n" << text;
  return *once;
}

size_t longestLine(const std::string &text) {
  size_t longest = 0;
  size_t begin = 0;
  for (size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    longest = std::max(longest, end - begin);
    begin = end + 1;
  }
  return longest;
}

TEST(Format, KeepsTheTree) {
  ASSERT_GT(sources().size(), 400U / kEvery);
  for (const Source &source : sources()) {
    SCOPED_TRACE(source.name);
    const std::string formatted = stable(source.text);
    const Parsed before(source.text);
    const Parsed after(formatted);
    ASSERT_TRUE(isClean(after)) << after.rendered();
    if (source.text.find('{') == std::string::npos) { // else conditions and positions may show
      ASSERT_EQ(lowerCase(print(*before.file)), lowerCase(print(*after.file)));
    }
  }
}

TEST(Format, IsStableInEveryStyle) {
  FormatStyle narrow;
  narrow.width = 40;
  FormatStyle tabs;
  tabs.tabs = true;
  tabs.indent = 4;
  tabs.keywords = KeywordCase::Keep;
  FormatStyle lower;
  lower.indent = 3;
  lower.keywords = KeywordCase::Lower;
  lower.align = false;
  lower.width = 72;
  for (const Source &source : sources()) {
    if (source.text.size() > kLongFile)
      continue;
    SCOPED_TRACE(source.name);
    for (const FormatStyle &style : {narrow, tabs, lower})
      (void)stable(source.text, style);
  }
}

/// The tokens alone, with what `gap` returns between them.
template <class Gap> std::string respaced(const std::string &text, Gap gap) {
  Sources manager;
  std::string out;
  for (const FormatItem &item : itemsOf(manager, manager.add("T.st", text))) {
    out += item.text;
    out += gap(item);
  }
  return out;
}

TEST(Format, DoesNotDependOnBlanks) {
  std::mt19937 random(20261121);
  FormatStyle narrow;
  narrow.width = 40;
  size_t tried = 0;
  for (const Source &source : sources()) {
    if (source.text.find("{IF") != std::string::npos ||
        source.text.find("{if") != std::string::npos || source.text.size() > kLongFile)
      continue;
    SCOPED_TRACE(source.name);
    const std::string plain = respaced(source.text, [](const FormatItem &) { return " "; });
    if (!isClean(Parsed(plain)))
      continue;
    ++tried;
    const std::string expected = stable(plain);
    const std::string other = respaced(source.text, [&](const FormatItem &) {
      static constexpr const char *kGaps[] = {" ", "\n", "\t", "  ", " \n ", "\r\n"};
      return kGaps[random() % std::size(kGaps)];
    });
    EXPECT_EQ(formatText(other), expected);
    EXPECT_EQ(stable(stable(plain, narrow)), expected);
  }
  EXPECT_GT(tried, 400U / kEvery);
}

TEST(Format, KeepsCommentsAnywhere) {
  std::mt19937 random(5);
  for (const Source &source : sources()) {
    if (source.text.size() > 6000)
      continue;
    SCOPED_TRACE(source.name);
    unsigned number = 0;
    const std::string text = respaced(source.text, [&](const FormatItem &) -> std::string {
      const std::string n = std::to_string(++number);
      switch (random() % 50) {
      case 0:
        return " (* " + n + " *) ";
      case 1:
        return " // " + n + "\n";
      case 2:
        return "\n// " + n + "\n";
      case 3:
        return "\n(* " + n + "\n   (* inner *) *)\n";
      case 4:
        return "\n\n/* " + n + " */ ";
      case 5:
        return " (* " + n + " *)\n";
      case 6:
        return " {attribute 'a" + n + "'}\n";
      case 7:
        return "(* a *)(* b *) // c\n   (* d *)\n\n\n";
      case 8: // of several lines, on the line of what is before it, or after it, or both
        return "(* " + n + "\n  two *) ";
      case 9:
        return " (* " + n + "\n\n      three *)\n";
      case 10:
        return "\n    (* " + n + "\n  two *) (* one *) ";
      case 11:
        return "\n\t/* " + n + "\n\t  two\n three */";
      default:
        return random() % 4 == 0 ? "\n" : " ";
      }
    });
    (void)stable(text);
    FormatStyle narrow;
    narrow.width = 50;
    (void)stable(text, narrow);
  }
}

TEST(Format, BreaksWhatIsTooWide) {
  for (const Source &source : sources()) {
    if (source.name.find("stdlib/") != 0)
      continue;
    SCOPED_TRACE(source.name);
    EXPECT_LE(longestLine(stable(source.text)), 130U); // with comments after a statement
  }
}

TEST(Format, OddTexts) {
  EXPECT_EQ(formatText(""), "");
  EXPECT_EQ(formatText("\n\n\n"), "");
  EXPECT_EQ(formatText("// only this"), "// only this\n");
  EXPECT_EQ(formatText("\n\n(* a *) (* b *)\n\n\n// c\r\n\r\n"), "(* a *) (* b *)\n\n// c\n");
  EXPECT_EQ(formatText("PROGRAM p END_PROGRAM"), "PROGRAM p\nEND_PROGRAM\n");
  EXPECT_EQ(formatText("PROGRAM p\nx := 1;"), "PROGRAM p\nx := 1;\n");
  for (const char *text : {"END_IF END_IF",
                           "IF",
                           "CASE x OF 1",
                           "VAR x",
                           "TYPE",
                           "TYPE x : (",
                           "PROGRAM",
                           "{IF",
                           "{ELSE} {END_IF} {END_IF}",
                           "x := ((((",
                           "?? !! \"",
                           "FUNCTION f :",
                           "END_TYPE ; ; END_VAR",
                           "CASE a OF 1: CASE b OF 2: END_CASE",
                           "PROPERTY p GET SET GET",
                           "TYPE a : (b, (c; END_TYPE",
                           "CONFIGURATION c RESOURCE r ON TASK TASK t",
                           "VAR_ACCESS a; READ_ONLY; END_VAR",
                           "UNTIL __CATCH ELSE ELSIF",
                           "a ^ ^ . . ( * ) - - - + + NOT NOT x"}) {
    SCOPED_TRACE(text);
    if (const std::optional<std::string> once = formatText(text)) {
      EXPECT_EQ(formatText(*once), once);
    }
  }
}

} // namespace
} // namespace stc::test
