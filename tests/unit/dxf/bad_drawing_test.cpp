// Drawings that are none, or damaged: an error with its line, never a crash.
#include "tests/unit/dxf/drawing_support.hpp"

namespace stc::test {
namespace {

constexpr auto kHead = "0\nSECTION\n2\nENTITIES\n"; // 4 lines
constexpr auto kTail = "0\nENDSEC\n0\nEOF\n";

std::string errorOf(const std::string &entities) { return import(kHead + entities + kTail).error; }

TEST(DxfBad, FilesThatAreNone) {
  const auto error = [](const std::string &text) { return import(text).error; };
  EXPECT_EQ(error(""), "SE0893 1: the file ends without EOF");
  EXPECT_EQ(error("AutoCAD Binary DXF\r\n\x1a"), "SE0893 1: this is a binary DXF file");
  EXPECT_EQ(error("G1 X5\n"), "SE0893 1: `G1 X5` is no group code");
  EXPECT_EQ(error("1072\nA\n"), "SE0893 1: `1072` is no group code");
  EXPECT_EQ(error("-6\nA\n"), "SE0893 1: `-6` is no group code");
  EXPECT_EQ(error("0\n"), "SE0893 1: the file ends after a group code");
  EXPECT_EQ(error("0\nLINE\n"), "SE0893 2: `LINE` stands outside of all sections");
  EXPECT_EQ(error("0\nSECTION\n"), "SE0893 3: the file ends within a section");
  EXPECT_EQ(error("0\nSECTION\n3\nENTITIES\n"), "SE0893 4: a section without a name");
  EXPECT_EQ(error(kHead), "SE0893 5: the file ends within a section");
  EXPECT_EQ(error(std::string(kHead) + "0\nLINE\n8\n0\n"),
            "SE0893 9: the file ends within an entity");
  EXPECT_EQ(error(std::string(kHead) + "0\nENDSEC\n"), "SE0893 7: the file ends without EOF");
  EXPECT_EQ(error(std::string(kHead) + "0\nEOF\n"),
            "SE0893 6: `EOF` does not stand in a section of entities");
  EXPECT_EQ(error(std::string(kHead) + kTail),
            "SE0893 1: there is nothing in this drawing that a program could follow");
  EXPECT_EQ(error(drawingOf("", "0\nBLOCK\n2\nA\n")).substr(0, 30),
            "SE0893 16: block `A` does not ");
  EXPECT_EQ(error(drawingOf("", "0\nBLOCK\n2\nA\n0\nENDBLK\n0\nBLOCK\n2\na\n0\nENDBLK\n")),
            "SE0893 18: there are two blocks `a`");
}

TEST(DxfBad, NumbersThatAreNone) {
  const auto line = [](const std::string &x) {
    return errorOf("0\nLINE\n8\n0\n10\n" + x + "\n20\n0\n11\n1\n21\n1\n");
  };
  EXPECT_EQ(line("0.5"), "");
  EXPECT_EQ(line("  +1.5e2 "), "");
  for (const std::string bad :
       {"", "x", "nan", "inf", "1e400", "1,5", "1.5mm", "0x10", "1000000001"})
    EXPECT_EQ(line(bad), "SE0893 10: `" + bad + "` is no number that is possible here");
  EXPECT_EQ(errorOf("0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1\n"),
            "SE0893 6: this LINE has no group code 21");
  EXPECT_EQ(errorOf("0\nLWPOLYLINE\n8\n0\n70\n9e9\n10\n0\n20\n0\n10\n1\n20\n1\n"),
            "SE0893 10: `9e9` is no whole number that is possible here");
}

TEST(DxfBad, EntitiesThatDescribeNothing) {
  const std::string centre = "8\n0\n10\n1\n20\n2\n";
  EXPECT_EQ(errorOf("0\nCIRCLE\n" + centre + "40\n0\n"),
            "SE0893 6: the radius 0 of this CIRCLE is not positive");
  EXPECT_EQ(errorOf("0\nARC\n" + centre + "40\n-3\n50\n0\n51\n90\n"),
            "SE0893 6: the radius -3 of this ARC is not positive");
  const std::string axes =
      "an axis of this ellipse has no length, or the second is longer than the "
      "first";
  EXPECT_EQ(errorOf("0\nELLIPSE\n" + centre + "11\n0\n21\n0\n40\n1\n"), "SE0893 6: " + axes);
  EXPECT_EQ(errorOf("0\nELLIPSE\n" + centre + "11\n3\n21\n0\n40\n0\n"), "SE0893 6: " + axes);
  EXPECT_EQ(errorOf("0\nELLIPSE\n" + centre + "11\n3\n21\n0\n40\n1.5\n"), "SE0893 6: " + axes);
  EXPECT_EQ(errorOf("0\nLWPOLYLINE\n8\n0\n90\n2000000000\n70\n0\n10\n1\n20\n2\n"),
            "SE0893 6: this polyline says that it has 2000000000 vertices, and has 1");
  EXPECT_EQ(errorOf("0\nPOLYLINE\n8\n0\n70\n1\n0\nVERTEX\n8\n0\n10\n1\n20\n2\n"),
            "SE0893 6: this POLYLINE does not end with SEQEND");
  // A line without length alone is left out, and then there is nothing.
  EXPECT_EQ(errorOf("0\nLINE\n" + centre + "11\n1\n21\n2\n"),
            "SE0893 1: there is nothing in this drawing that a program could follow");
}

TEST(DxfBad, SplinesThatDescribeNothing) {
  const auto error = [](int degree, const std::vector<double> &knots, int points,
                        const std::string &more = "") {
    std::string text = fmt::format("0\nSPLINE\n8\n0\n71\n{}\n", degree);
    for (const double knot : knots)
      text += group(40, knot);
    for (int i = 0; i < points; ++i)
      text += place(10, {1.0 * i, 1.0 * i * i});
    const std::string found = errorOf(text + more);
    return found.substr(std::min<size_t>(found.size(), 10));
  };
  EXPECT_EQ(error(3, {0, 0, 0, 0, 1, 1, 1, 1}, 4), "");
  EXPECT_EQ(error(0, {0, 1}, 1), "the degree 0 of this spline is none from 1 to 11");
  EXPECT_EQ(error(12, {0, 1}, 1), "the degree 12 of this spline is none from 1 to 11");
  EXPECT_EQ(error(3, {0, 0, 0, 1, 1, 1}, 3),
            "a spline of degree 3 has 4 control points at least, this one 3");
  EXPECT_EQ(error(3, {0, 0, 0, 1, 1, 1, 1}, 4),
            "a spline of degree 3 with 4 control points has 8 knots, this one 7");
  EXPECT_EQ(error(3, {0, 0, 0, 0, 1, 0.5, 1, 1}, 4), "the knots of this spline do not rise");
  EXPECT_EQ(error(3, {1, 1, 1, 1, 1, 1, 1, 1}, 4), "the knots of this spline do not rise");
  EXPECT_EQ(error(3, {0, 0, 0, 0, 1, 1, 1, 1}, 4, "41\n1\n"),
            "this spline has 4 control points and 1 weights");
  EXPECT_EQ(error(1, {0, 0, 1, 1}, 2, "41\n1\n41\n0\n"),
            "the weight 0 of a control point is not positive");
}

TEST(DxfBad, BlocksThatNeverEnd) {
  const auto insert = [](const std::string &name, const std::string &more = "") {
    return "0\nINSERT\n8\n0\n2\n" + name + "\n10\n1\n20\n2\n" + more;
  };
  const auto block = [](const std::string &name, const std::string &entities) {
    return "0\nBLOCK\n8\n0\n2\n" + name + "\n10\n0\n20\n0\n" + entities + "0\nENDBLK\n";
  };
  const auto error = [&](const std::string &blocks, const std::string &entities) {
    const std::string found = import(drawingOf(entities, blocks)).error;
    return found.substr(std::min(found.size(), found.find(": ") + 2));
  };
  EXPECT_EQ(error("", insert("A")), "there is no block `A`");
  EXPECT_EQ(error(block("A", insert("a")), insert("A")), "the block `a` is inserted within itself");
  EXPECT_EQ(error(block("A", insert("B")) + block("B", insert("A")), insert("A")),
            "the block `A` is inserted within itself");
  EXPECT_EQ(error(block("A", ""), insert("A", "41\n0\n")), "a block is inserted with the scale 0");
  EXPECT_EQ(error(block("A", ""), insert("A", "70\n32000\n71\n32000\n")),
            "more than 1000000 blocks are inserted");
  // Ten blocks of ten of the next one, and nothing in the last.
  std::string chain;
  for (int i = 0; i < 12; ++i)
    chain += block(fmt::format("C{}", i), insert(fmt::format("C{}", i + 1), "70\n10\n"));
  EXPECT_EQ(error(chain + block("C12", ""), insert("C0")), "more than 1000000 blocks are inserted");
  std::string deep;
  for (int i = 0; i < 17; ++i)
    deep += block(fmt::format("D{}", i), insert(fmt::format("D{}", i + 1)));
  EXPECT_EQ(error(deep + block("D17", ""), insert("D0")),
            "more than 16 blocks stand within each other");
  EXPECT_EQ(
      error(block("A", "0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n1\n"), insert("A", "41\n1e-8\n42\n1\n")),
      "this entity becomes too large, or an arc of it flat");
  EXPECT_EQ(error(block("A", "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1e9\n21\n1\n"),
                  insert("A", "41\n1e9\n42\n1\n")),
            "this entity becomes too large, or an arc of it flat");
}

TEST(DxfBad, WhatIsLeftOutIsCounted) {
  const std::string line = "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n3\n21\n1\n";
  const Imported result =
      import(kHead + line +
             "0\nTEXT\n8\n0\n1\nhello\n0\nPOINT\n8\n0\n10\n1\n20\n1\n0\nTEXT\n8\n0\n1\nx\n" +
             "0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n1\n210\n1\n220\n0\n230\n0\n" +
             "0\nLINE\n8\n0\n10\n5\n20\n0\n30\n2\n11\n9\n21\n1\n" +
             "0\nLINE\n67\n1\n8\n0\n10\n0\n20\n0\n11\n3\n21\n5\n" +
             "0\nSPLINE\n8\n0\n71\n3\n11\n0\n21\n0\n" + kTail);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.warnings,
            (std::vector<std::string>{
                "SE0894 24: 1 entity is left out: POINT",
                "SE0894 82: 1 entity is left out: SPLINE with fit points only",
                "SE0894 18: 2 entities are left out: TEXT", "SE0894 54: Z of 1 entity is left out",
                "SE0894 38: 1 entity is left out: in a plane that is not that of X and Y",
                "SE0894 68: 1 entity is left out: on paper"}));
  EXPECT_EQ(result.programs.at(0).contours, 2U);
}

/// Files that have been damaged: an error, or a program without one.
TEST(DxfBad, DamagedDrawingsAreRefusedOrBecomePrograms) {
  std::mt19937 random(1);
  const auto pick = [&](size_t count) { return random() % count; };
  size_t good = 0;
  for (unsigned round = 0; round < 60; ++round) {
    std::string text = RandomDrawing(round % 20, 2).text();
    for (size_t changes = 1 + pick(3); changes > 0; --changes) {
      const size_t at = text.find('\n', pick(text.size() - 1));
      const size_t begin = at == std::string::npos ? 0 : at + 1;
      const size_t end = std::min(text.find('\n', begin), text.size());
      static const std::string kLines[] = {"0",  "-1",   "1e9", "LINE",  "INSERT", "10",
                                           "42", "1e-9", "70",  "3",     "1",      "1e-300",
                                           "-0", "360",  "0.5", "ENDBLK"};
      switch (pick(12)) {
      case 0:
        text.replace(begin, end - begin, kLines[pick(std::size(kLines))]);
        break;
      case 1:
        text.erase(begin, std::min(text.size(), end + 1) - begin);
        break;
      case 2:
        text.insert(begin, kLines[pick(std::size(kLines))] + "\n");
        break;
      case 3:
        text[pick(text.size())] = static_cast<char>(pick(256));
        break;
      default: { // another number
        const size_t point = text.find('.', pick(text.size()));
        const size_t before = text.rfind('\n', point);
        if (point != std::string::npos && before != std::string::npos)
          text.replace(before + 1, text.find('\n', point) - before - 1,
                       fmt::format("{}", std::uniform_real_distribution(-200.0, 200.0)(random)));
      }
      }
    }
    DxfImport how;
    how.insideFirst = round % 2 == 0;
    how.tool = round % 3 == 0 ? DxfTool::Left : DxfTool::None;
    how.leadIn = round % 6 == 0 ? 2 : 0;
    const Imported result = import(text, how);
    for (const DxfProgram &program : result.programs) {
      ASSERT_FALSE(pathOf(program.text).empty()) << text;
      ++good;
    }
    if (HasFailure())
      FAIL() << "round " << round << "\n" << text;
  }
  EXPECT_GT(good, 10U);
  EXPECT_LT(good, 55U);
}

} // namespace
} // namespace stc::test
