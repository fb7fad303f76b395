// Programs become drawings, and these the same programs.
#include "tests/unit/dxf/drawing_support.hpp"

namespace stc::test {
namespace {

std::string exported(const std::string &text, const DxfExport &how = {}) {
  Sources sources;
  Diagnostics diagnostics;
  const auto program = readCnc(sources.file(sources.add("a.cnc", text)), diagnostics);
  EXPECT_TRUE(program);
  const auto drawing = exportDxf(*program, how, diagnostics);
  EXPECT_TRUE(drawing);
  return drawing.value_or("");
}

size_t count(const std::string &text, const std::string &what) {
  size_t found = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++found;
  return found;
}

TEST(DxfExport, RandomProgramsComeBack) {
  for (unsigned seed = 100; seed < 110; ++seed) {
    const RandomDrawing drawing(seed);
    DxfImport how;
    const std::string program = import(drawing.text(), how).programs.at(0).text;
    const Imported again = import(exported(program));
    ASSERT_EQ(again.error, "");
    EXPECT_TRUE(again.warnings.empty());
    expectSame(curvesOf(pathOf(program)), curvesOf(pathOf(again.programs.at(0).text)), 3e-3,
               program + again.programs[0].text);
    if (HasFatalFailure())
      return;
  }
}

TEST(DxfExport, SplinesAndParabolasComeBack) {
  const std::string text = "N10 G0 X5 Y5 F10\nN20 G5 X10 Y8\nN30 X15 Y2\nN40 X22 Y9\n"
                           "N50 G6 X30 Y4 I4 J7\nN60 G8 X40 Y4 I5 J0 K10 R0.5\nN70 G10 X50 Y6\n"
                           "N80 X55 Y12\nN90 G2 X60 Y5 R9\nN100 G3 I4 J3\n";
  const std::string drawing = exported(text);
  EXPECT_EQ(count(drawing, "\nSPLINE\n"), 6U);
  EXPECT_EQ(count(drawing, "\nELLIPSE\n"), 1U);
  EXPECT_EQ(count(drawing, "\nARC\n"), 1U);
  EXPECT_EQ(count(drawing, "\nCIRCLE\n"), 1U);
  DxfImport how;
  how.tolerance = 1e-4;
  const Imported again = import(drawing, how);
  EXPECT_EQ(again.programs.at(0).contours, 2U); // the circle is one of its own
  expectSame(curvesOf(pathOf(text)), curvesOf(pathOf(again.programs[0].text)), 1.5e-3, drawing);
}

TEST(DxfExport, InSpace) {
  // An arc in the plane of Z and X, and a helix.
  const std::string drawing =
      exported("N10 G18\nN20 G3 X10 Z10 R10 F10\nN30 G17\nN40 G3 I5 J0 Z4\n", {0.01, false});
  EXPECT_EQ(count(drawing, "\nELLIPSE\n"), 1U);
  EXPECT_EQ(count(drawing, "\n210\n0\n220\n1\n230\n0\n"), 1U);
  // 2 pi 5 / n has to be within 0.01 of the arc: 35 lines at least, 64 by halves.
  EXPECT_EQ(count(drawing, "\nLINE\n"), 64U);
}

TEST(DxfExport, PositioningOnlyIfWanted) {
  const std::string text = "N10 G0 X5 F10\nN20 G1 X10\nN30 G0 Y5\n";
  EXPECT_EQ(count(exported(text), "\nLINE\n"), 1U);
  const std::string all = exported(text, {0.001, true});
  EXPECT_EQ(count(all, "\nLINE\n"), 3U);
  EXPECT_EQ(count(all, "\nRAPID\n"), 3U); // two entities and the layer
  DxfImport how;
  how.layers = {"RAPID"};
  EXPECT_EQ(import(all, how).programs.at(0).contours, 2U);
}

} // namespace
} // namespace stc::test
