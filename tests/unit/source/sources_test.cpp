#include "compiler/source/sources.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

namespace stc {
namespace {

TEST(Sources, FindsLinesAndColumns) {
  Sources sources;
  const FileId id = sources.add("a.st", "one\r\ntwo\n\n\tfünf");
  const SourceFile &file = sources.file(id);
  EXPECT_EQ(file.lineCount(), 4U);
  EXPECT_EQ(file.line(1), "one");
  EXPECT_EQ(file.line(2), "two");
  EXPECT_EQ(file.line(3), "");
  EXPECT_EQ(file.line(4), "\tfünf");
  EXPECT_EQ(file.line(5), "");
  EXPECT_EQ(file.position(0).line, 1U);
  EXPECT_EQ(file.position(5).line, 2U);
  EXPECT_EQ(file.position(5).column, 1U);
  EXPECT_EQ(file.position(7).column, 3U);
  const auto end = file.position(static_cast<uint32_t>(file.text().size()));
  EXPECT_EQ(end.line, 4U);
  EXPECT_EQ(end.column, 6U); // a tab, four letters, of which one has two bytes
  EXPECT_EQ(sources.text({id, 5, 8}), "two");
  EXPECT_EQ(sources.position({id, 6, 8}).column, 2U);
}

TEST(Sources, EmptyTextHasOneLine) {
  Sources sources;
  const SourceFile &file = sources.file(sources.add("a.st", ""));
  EXPECT_EQ(file.lineCount(), 1U);
  EXPECT_EQ(file.position(0).line, 1U);
  EXPECT_EQ(file.position(99).column, 1U);
}

TEST(Sources, ReadsUtf8AndLatin1) {
  Sources sources;
  EXPECT_EQ(sources.file(sources.addBytes("bom", "\xEF\xBB\xBFx")).text(), "x");
  EXPECT_EQ(
      sources.file(sources.addBytes("utf8", "gr\xC3\xBC\xC3\x9F \xE2\x82\xAC \xF0\x9F\x98\x80"))
          .text(),
      "grüß € 😀");
  EXPECT_EQ(sources.file(sources.addBytes("latin1", "gr\xFC\xDF")).text(), "grüß");
  // Overlong forms, surrogates and cut sequences are not UTF-8.
  EXPECT_EQ(sources.file(sources.addBytes("overlong", "\xC0\xAF")).text(), "À¯");
  EXPECT_EQ(sources.file(sources.addBytes("surrogate", "\xED\xA0\x80")).text().size(), 6U);
  EXPECT_EQ(sources.file(sources.addBytes("cut", "a\xE2\x82")).text().size(), 5U);
}

/// Files whose lines end with CR only have lines, too; in others a CR is a character like any
/// other.
TEST(Sources, LinesMayEndWithCarriageReturnsOnly) {
  Sources sources;
  const SourceFile &old = sources.file(sources.addBytes("old", "one\rtwo\r\rfour"));
  EXPECT_EQ(old.lineCount(), 4U);
  EXPECT_EQ(old.line(2), "two");
  EXPECT_EQ(old.position(9).line, 4U);
  EXPECT_EQ(old.position(9).column, 1U);
  const SourceFile &mixed = sources.file(sources.addBytes("mixed", "a\rb\r\nc"));
  EXPECT_EQ(mixed.lineCount(), 2U);
  EXPECT_EQ(mixed.line(1), "a\rb");
}

TEST(Sources, LoadsFilesAndSaysWhyNot) {
  const auto path = std::filesystem::temp_directory_path() / "stride_source_manager_test.st";
  std::ofstream(path, std::ios::binary) << std::string(100'000, 'x') << "\nend";
  Sources sources;
  const auto id = sources.load(path, "shown.st");
  ASSERT_TRUE(id.has_value());
  EXPECT_EQ(sources.file(*id).name(), "shown.st");
  EXPECT_EQ(sources.file(*id).text().size(), 100'004U);
  std::filesystem::remove(path);
  EXPECT_FALSE(sources.load(path, "x").has_value());
  EXPECT_EQ(errno, ENOENT);
  EXPECT_FALSE(sources.load(std::filesystem::temp_directory_path(), "x").has_value());
  EXPECT_EQ(errno, EISDIR);
}

} // namespace
} // namespace stc
