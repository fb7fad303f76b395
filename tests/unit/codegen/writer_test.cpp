// The writer of generated text by itself: where directives stand, what is written aside, lines that
// are gathered.
#include "compiler/codegen/cpp/scoped.hpp"
#include "compiler/codegen/cpp/writer.hpp"

#include <gtest/gtest.h>

namespace stc::codegen::test {
namespace {

class WriterTest : public ::testing::Test {
protected:
  /// The text from `begin` on, one character of it.
  [[nodiscard]] Span at(uint32_t begin) const { return {file_, begin, begin + 1}; }

  Sources sources_;
  FileId file_ = sources_.add("Main.st", "a := 1;\nb := 2;\n\nc := 3;\n");
  Writer out_{sources_};
};

TEST_F(WriterTest, DirectivesStandWhereTheCountOfLinesWouldBeWrong) {
  out_.from(at(0));
  out_.line() << "a = 1;";
  out_.endLine();
  out_.from(at(8)); // the next line of both texts
  out_.line() << "b = 2;";
  out_.endLine();
  out_.from(at(17));
  out_.line() << "c = 3;";
  out_.endLine();
  EXPECT_EQ(out_.take(), "#line 1 \"Main.st\"\na = 1;\nb = 2;\n#line 4\nc = 3;\n");
}

TEST_F(WriterTest, WhatIsWrittenAsideIsGivenAndNotWritten) {
  out_ << "x = ";
  std::string inner;
  const std::string outer = out_.aside([&] {
    out_ << "f(";
    inner = out_.aside([&] { out_ << "longer than what a string holds in itself"; });
    out_ << ')';
  });
  out_ << 5 << ';';
  EXPECT_EQ(inner, "longer than what a string holds in itself");
  EXPECT_EQ(outer, "f()");
  EXPECT_EQ(out_.aside([] {}), "");
  EXPECT_EQ(out_.take(), "x = 5;");
}

TEST_F(WriterTest, GatheredLinesFollowEachOtherOnOne) {
  out_.from(at(0));
  out_.indent();
  out_.line() << "[&] { ";
  {
    const Writer::Gathered oneLine(out_);
    out_.from(at(17));
    out_.line() << "c = 3;";
    out_.endLine();
    out_.sameLine();
    out_.line() << "d = 4;";
    out_.endLine();
  }
  out_ << "}();";
  out_.endLine();
  out_.from(at(8)); // the gathered lines count as none
  out_.line() << "b = 2;";
  out_.endLine();
  EXPECT_EQ(out_.take(), "#line 1 \"Main.st\"\n  [&] { c = 3; d = 4; }();\n  b = 2;\n");
}

TEST_F(WriterTest, WithoutDirectivesLinesAreTheirOwn) {
  out_.withoutDirectives();
  out_.from(at(17));
  out_.line() << "c = 3;";
  out_.endLine();
  EXPECT_EQ(out_.take(), "c = 3;\n");
}

TEST_F(WriterTest, AppendedLinesBringTheirDirectives) {
  Writer body(sources_);
  body.from(at(8));
  body.line() << "b = 2;";
  body.endLine();
  out_ << "void f() {";
  out_.endLine();
  out_.append(body);
  out_.from(at(17)); // the compiler counts on from line 2
  out_.line() << "c = 3;";
  out_.endLine();
  out_.fromGenerated("user/Main.cpp");
  out_ << '}';
  EXPECT_EQ(out_.take(), "void f() {\n#line 2 \"Main.st\"\nb = 2;\n#line 4\nc = 3;\n"
                         "#line 7 \"user/Main.cpp\"\n}");
}

TEST(Scoped, EndsWithItsScope) {
  std::string mode = "a mode that is longer than a short string";
  {
    const Scoped<std::string> inner(mode, "inner");
    EXPECT_EQ(mode, "inner");
    const Scoped<std::string> derived(mode, mode + "most");
    EXPECT_EQ(mode, "innermost");
  }
  EXPECT_EQ(mode, "a mode that is longer than a short string");
}

} // namespace
} // namespace stc::codegen::test
