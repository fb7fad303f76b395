#include "compiler/source/render.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace stc {
namespace {

class Render : public testing::Test {
protected:
  FileId add(std::string text, std::string name = "Main.st") {
    return sources.add(std::move(name), std::move(text));
  }
  /// The n-th occurrence of `what` in the file.
  Span find(FileId id, std::string_view what, int n = 1) {
    size_t at = std::string_view::npos;
    for (int i = 0; i < n; ++i)
      at = sources.file(id).text().find(what, at + 1);
    return {id, static_cast<uint32_t>(at), static_cast<uint32_t>(at + what.size())};
  }
  static Diagnostic error(Span where, std::string message, std::string label = {}) {
    Diagnostic d{Code::UnexpectedToken, Severity::Error, std::move(message), {}, {}, {}};
    d.label(where, std::move(label));
    return d;
  }
  Sources sources;
};

TEST_F(Render, OneLabel) {
  const FileId id = add("PROGRAM Main\nVAR\nEND_VAR\n  Foo := 1;\nEND_PROGRAM\n");
  Diagnostic d = error(find(id, "Foo"), "cannot find variable `Foo`", "not found in this scope");
  d.help("a variable with a similar name exists: `Fob`");
  EXPECT_EQ(renderText(d, sources), "error[SE0201]: cannot find variable `Foo`\n"
                                    " --> Main.st:4:3\n"
                                    "  |\n"
                                    "4 |   Foo := 1;\n"
                                    "  |   ^^^ not found in this scope\n"
                                    "  |\n"
                                    "  = help: a variable with a similar name exists: `Fob`\n"
                                    "\n");
}

TEST_F(Render, WithoutPlace) {
  Diagnostic d{
      Code::UnreadableFile, Severity::Warning, "cannot read", {}, {"a note\nin two lines"}, {}};
  EXPECT_EQ(renderText(d, sources), "warning[SE0101]: cannot read\n"
                                    "  = note: a note\n"
                                    "          in two lines\n"
                                    "\n");
}

TEST_F(Render, SeveralLabelsOnOneLine) {
  const FileId id = add("IF a > (3 THEN\n");
  Diagnostic d = error(find(id, "THEN"), "expected `)`", "add `)` here");
  d.label(find(id, "("), "to close this one").label(find(id, "IF"), "in this IF");
  EXPECT_EQ(renderText(d, sources), "error[SE0201]: expected `)`\n"
                                    " --> Main.st:1:11\n"
                                    "  |\n"
                                    "1 | IF a > (3 THEN\n"
                                    "  | --     -  ^^^^ add `)` here\n"
                                    "  | |      |\n"
                                    "  | |      to close this one\n"
                                    "  | |\n"
                                    "  | in this IF\n"
                                    "\n");
}

TEST_F(Render, SeveralLinesAndFiles) {
  const FileId id = add("a\nb\nc\nd\ne\nf\ng\nh\ni\nj\nk\n");
  const FileId other = add("TYPE\n  x : INT;\n", "Types.st");
  Diagnostic d = error(find(id, "k"), "m", "last");
  d.label(find(id, "a"), "first")
      .label(find(id, "i"), "near")
      .label(find(other, "x"), "declared here");
  EXPECT_EQ(renderText(d, sources), "error[SE0201]: m\n"
                                    "  --> Main.st:11:1\n"
                                    "   |\n"
                                    "1  | a\n"
                                    "   | - first\n"
                                    "...\n"
                                    "9  | i\n"
                                    "   | - near\n"
                                    "10 | j\n"
                                    "11 | k\n"
                                    "   | ^ last\n"
                                    "  ::: Types.st:2:3\n"
                                    "   |\n"
                                    "2  |   x : INT;\n"
                                    "   |   - declared here\n"
                                    "\n");
}

TEST_F(Render, SpanOfSeveralLines) {
  const FileId id = add("x := f(\n  1,\n  2,\n  3);\n");
  EXPECT_EQ(renderText(error({id, 5, find(id, "3)").end}, "m", "this call"), sources),
            "error[SE0201]: m\n"
            " --> Main.st:1:6\n"
            "  |\n"
            "1 | x := f(\n"
            "  |      ^^\n"
            "...\n"
            "4 |   3);\n"
            "  |   ^^ this call\n"
            "\n");
}

TEST_F(Render, TabsAndUtf8KeepTheColumns) {
  const FileId id = add("\tx := 'grüße' + y;\n");
  EXPECT_EQ(renderText(error(find(id, "y"), "m", "here"), sources),
            "error[SE0201]: m\n"
            " --> Main.st:1:17\n"
            "  |\n"
            "1 |     x := 'grüße' + y;\n"
            "  |                    ^ here\n"
            "\n");
}

TEST_F(Render, EmptySpanAndEndOfFile) {
  const FileId id = add("x := 1");
  EXPECT_EQ(renderText(error({id, 6, 6}, "m", "add `;` here"), sources),
            "error[SE0201]: m\n"
            " --> Main.st:1:7\n"
            "  |\n"
            "1 | x := 1\n"
            "  |       ^ add `;` here\n"
            "\n");
  const FileId empty = add("");
  EXPECT_EQ(renderText(error({empty, 0, 0}, "m", "here"), sources), "error[SE0201]: m\n"
                                                                    " --> Main.st:1:1\n"
                                                                    "  |\n"
                                                                    "1 |\n"
                                                                    "  | ^ here\n"
                                                                    "\n");
}

TEST_F(Render, CutsLongLines) {
  const FileId id = add(std::string(5'000'000, 'a') + "!" + std::string(5'000'000, 'b'));
  const std::string text = renderText(error({id, 5'000'000, 5'000'001}, "m", "here"), sources);
  EXPECT_LT(text.size(), 800U);
  EXPECT_NE(text.find("…" + std::string(40, 'a') + "!"), std::string::npos);
  EXPECT_NE(text.find("\n  |  " + std::string(40, ' ') + "^ here\n"), std::string::npos);
  // A mark over the whole line is cut as well.
  EXPECT_LT(renderText(error({id, 0, 9'000'000}, "m", "here"), sources).size(), 1000U);
}

TEST_F(Render, Colours) {
  const FileId id = add("x\n");
  const std::string text = renderText(error({id, 0, 1}, "m"), sources, {.color = true});
  EXPECT_NE(text.find("\033[1;31merror[SE0201]\033[0m"), std::string::npos);
  EXPECT_EQ(renderText(error({id, 0, 1}, "m"), sources).find('\033'), std::string::npos);
}

TEST_F(Render, Json) {
  const FileId id = add("ab\ncd \"q\"\n");
  Diagnostic d = error({id, 4, 8}, "a \"message\"", "text");
  d.note("n").help("h").label({id, 0, 1}, "second");
  const std::string line = renderJson(d, sources);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto json = nlohmann::json::parse(line);
  EXPECT_EQ(json["code"], "SE0201");
  EXPECT_EQ(json["severity"], "error");
  EXPECT_EQ(json["message"], "a \"message\"");
  EXPECT_EQ(json["labels"][0]["file"], "Main.st");
  EXPECT_EQ(json["labels"][0]["line"], 2);
  EXPECT_EQ(json["labels"][0]["column"], 2);
  EXPECT_EQ(json["labels"][0]["endLine"], 2);
  EXPECT_EQ(json["labels"][0]["endColumn"], 6);
  EXPECT_EQ(json["labels"][1]["text"], "second");
  EXPECT_EQ(json["notes"][0], "n");
  EXPECT_EQ(json["helps"][0], "h");
}

} // namespace
} // namespace stc
