// The hand-written scanner against the lexer that ANTLR generates from grammar/StLexer.g4.

#include "compiler/syntax/scanner.hpp"

#include "compiler/source/identifier.hpp"

#include "antlr4-runtime.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace stc {
namespace {

struct Piece {
  size_t type;
  size_t begin;
  size_t end;
};

std::vector<Piece> scan(const SourceFile &file) {
  Diagnostics diagnostics;
  Scanner scanner(file, diagnostics);
  std::vector<Piece> out;
  for (Token token = scanner.next(); token.type != Token::kEnd; token = scanner.next())
    out.push_back({token.type, token.begin, token.end});
  EXPECT_FALSE(diagnostics.hasErrors()) << file.name() << ": " << diagnostics.all().front().message;
  return out;
}

std::vector<Piece> reference(const SourceFile &file) {
  antlr4::ANTLRInputStream input{std::string(file.text())};
  grammar::StLexer lexer(&input);
  // ANTLR counts code points.
  std::vector<size_t> offsets;
  for (size_t i = 0; i < file.text().size(); ++i)
    if ((static_cast<unsigned char>(file.text()[i]) & 0xC0) != 0x80)
      offsets.push_back(i);
  offsets.push_back(file.text().size());
  std::vector<Piece> out;
  for (auto token = lexer.nextToken(); token->getType() != antlr4::Token::EOF;
       token = lexer.nextToken())
    if (token->getChannel() == antlr4::Token::DEFAULT_CHANNEL)
      out.push_back(
          {token->getType(), offsets[token->getStartIndex()], offsets[token->getStopIndex() + 1]});
  return out;
}

bool isAssignment(size_t type) {
  return type == Tok::SET_ASSIGN || type == Tok::RESET_ASSIGN || type == Tok::REF_ASSIGN;
}

/// Equal but for what only the neighbouring tokens decide.
void compare(const SourceFile &file) {
  const std::vector<Piece> ours = scan(file);
  const std::vector<Piece> theirs = reference(file);
  size_t i = 0;
  size_t k = 0;
  size_t before = 0;
  const auto where = [&](const Piece &piece) {
    const LineColumn at = file.position(static_cast<uint32_t>(piece.begin));
    return file.name() + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + " `" +
           std::string(file.text().substr(piece.begin, piece.end - piece.begin)) + "`";
  };
  while (i < ours.size() && k < theirs.size()) {
    const Piece &a = ours[i];
    const Piece &b = theirs[k];
    ASSERT_EQ(a.begin, b.begin) << where(a) << " against " << where(b);
    const std::string_view word = file.text().substr(b.begin, b.end - b.begin);
    if (a.type == Tok::IDENT && isAssignment(b.type)) {
      // S=1 and S=>x: the lexer always sees `S=`.
      ASSERT_LT(i + 1, ours.size());
      ++i;
      ++k;
      if (ours[i].type == Tok::ARROW) {
        ASSERT_LT(k, theirs.size());
        ASSERT_EQ(theirs[k].type, static_cast<size_t>(Tok::GREATER));
        ++k;
      } else {
        ASSERT_EQ(ours[i].type, static_cast<size_t>(Tok::EQUAL)) << where(ours[i]);
      }
    } else {
      ASSERT_EQ(a.end, b.end) << where(a) << " against " << where(b);
      if (a.type != b.type) {
        const Keyword keyword = findKeyword(word, hashIdent(word));
        EXPECT_EQ(a.type, static_cast<size_t>(Tok::IDENT)) << where(a);
        EXPECT_TRUE(before == Tok::DOT ||
                    (keyword.kind != Keyword::Kind::Hard && keyword.kind != Keyword::Kind::None &&
                     keyword.type == b.type))
            << where(a);
      }
      ++k;
    }
    before = ours[i].type;
    ++i;
  }
  EXPECT_EQ(i, ours.size());
  EXPECT_EQ(k, theirs.size());
}

void compareText(std::string text) {
  Sources sources;
  compare(sources.file(sources.add("text", std::move(text))));
}

TEST(Scanner, AgreesWithTheReferenceOnTokens) {
  compareText("a := b+c-d*e/f**g = h <> i < j <= k > l >= m & n AND o OR p XOR q MOD r NOT s;");
  compareText(
      "a S= b; c[1] R= d; e^ REF= f; w.3 S= x; IF S=1 AND R = 2 THEN s(S=>x, r := 1); END_IF");
  compareText("1 1_000 16#FF_ff 2#1010 8#17 1.5 1.5e-3 1E5 1e+5 1_0.2_5 1..5 a.1 a[1..2]");
  compareText("INT#5 INT#-5 BYTE#16#FF REAL#1.5e3 LREAL#-2 BOOL#TRUE bool#false BOOL#1 STRING#'x' "
              "WSTRING#\"y\" my#5 "
              "color#green COLOR#TRUE_");
  compareText("T#1d2h3m4s5ms t#1.5s TIME#5h_30m LT#1us LTIME#1ns T#-5s D#2024-01-02 DATE#2024-1-2 "
              "ld#1970-01-01 "
              "TOD#12:30:15.5 TIME_OF_DAY#1:2 LTOD#1:2:3 DT#2024-02-29-12:30:15 "
              "date_and_time#1970-01-01-0:0 LDT#1970-01-01-1:2");
  compareText("'' 'a' 'a$'b' '$$' 'x // (* *)' \"w$\"w\" 'ü€😀' \"$20AC\"");
  compareText("%IX0.0, %QW2, %md4, %I*, %Q*, %MB12.3");
  compareText("a (* x *) b (* y (* z *) *) c (**) d (***) e (****) f (* * ) *) g /* h */ i /**/ j "
              "/* ** / */ k // l\n m /// n\n o");
  compareText("(*(* x *)*) a (* (*) *) *) b (* ( *) c (* ) *) d (*(*)*)*) e");
  compareText("{attribute 'a' := 'b'} x {external} y {info 'a } b'} z {}");
  compareText("x.type y.if z.var.end_if (* keywords behind a point *) a.method");
  compareText("a:=1;b:=-2;c:=NOT d;e=>f:g..h,i.j^(k)[l]");
  compareText("\xC2\xA0 a\t\r\n\f\v b \x1A");
}

TEST(Scanner, AgreesWithTheReferenceOnEveryKeyword) {
  grammar::StLexer lexer(nullptr);
  const auto &vocabulary = lexer.getVocabulary();
  std::string hard;
  size_t words = 0;
  for (size_t type = Tok::TRUE; type < Tok::TIME_LITERAL; ++type) {
    const std::string name = vocabulary.getSymbolicName(type);
    const std::string word(tokenSpelling(static_cast<uint16_t>(type)));
    const Keyword keyword = findKeyword(word, hashIdent(word));
    EXPECT_EQ(keyword.type, type) << name;
    const bool isOperator = word.starts_with("__");
    EXPECT_TRUE(isOperator || word == name) << word;
    ++words;
    if (!isOperator && keyword.kind == Keyword::Kind::Hard)
      hard += name + ' ' + std::string(1, static_cast<char>(name[0] + 32)) + name.substr(1) + '\n';
  }
  EXPECT_GT(words, 80U);
  compareText(hard);
}

TEST(Scanner, AgreesWithTheReferenceOnTheSourcesOfTheRepository) {
  namespace fs = std::filesystem;
  size_t files = 0;
  for (const char *folder : {"stdlib", "examples", "tests/golden/programs"}) {
    const fs::path root = fs::path(STRIDE_SOURCE_DIR) / folder;
    if (!fs::exists(root))
      continue;
    for (const auto &entry : fs::recursive_directory_iterator(root)) {
      if (entry.path().extension() != ".st")
        continue;
      Sources sources;
      const auto id = sources.load(entry.path(), entry.path().filename());
      ASSERT_TRUE(id.has_value());
      compare(sources.file(*id));
      ++files;
    }
  }
  EXPECT_GT(files, 30U);
}

} // namespace
} // namespace stc
