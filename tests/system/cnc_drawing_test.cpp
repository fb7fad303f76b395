// `stride cnc import-dxf` and `export-dxf`: files, options, bad input.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto kDrawing = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n5\n0\nENDSEC\n"
                          "0\nSECTION\n2\nENTITIES\n"
                          "0\nLINE\n8\nCut\n10\n1\n20\n0\n11\n3\n21\n0\n"
                          "0\nCIRCLE\n8\nHoles of 5\n10\n5\n20\n0\n40\n0.5\n"
                          "0\nTEXT\n8\nCut\n1\nA\n0\nENDSEC\n0\nEOF\n";

class CncDrawing : public ::testing::Test {
protected:
  ProcessResult cnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "cnc"});
    return runProcess(arguments, scratch_.path());
  }
  void write(const std::string &name, const std::string &text) {
    writeFile(scratch_.path() / name, text);
  }
  std::string read(const std::string &name) { return readFile(scratch_.path() / name); }
  bool exists(const std::string &name) { return std::filesystem::exists(scratch_.path() / name); }

  ScratchDirectory scratch_;
};

TEST_F(CncDrawing, MakesAProgramBesideTheDrawing) {
  write("plate 2.dxf", kDrawing);
  const ProcessResult result = cnc({"import-dxf", "plate 2.dxf", "--feed", "20"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.out, "plate_2.cnc: 2 contours, 1 closed; 25 between them, 35 as drawn\n");
  EXPECT_THAT(result.err, HasSubstr("note[SE0895]: the drawing is in cm: the program is in mm"));
  EXPECT_THAT(result.err, HasSubstr("warning[SE0894]: 1 entity is left out: TEXT"));
  EXPECT_THAT(result.err, HasSubstr("plate 2.dxf:38:1"));
  EXPECT_EQ(read("plate_2.cnc"), "% plate 2.dxf\nN10 G17\nN20 G0 X10 Y0 F20 (Cut)\nN30 G1 X30 Y0\n"
                                 "N40 G0 X45 Y0 (Holes of 5)\nN50 G3 I5 J0\n");
  EXPECT_EQ(cnc({"check", "plate_2.cnc"}).exitCode, 0);
}

TEST_F(CncDrawing, OneProgramForEachLayerOrContour) {
  write("a.dxf", kDrawing);
  EXPECT_EQ(
      cnc({"import-dxf", "a.dxf", "-o", "new/folder", "--one-per", "layer", "--scale", "1"}).out,
      "new/folder/a_Cut.cnc: 1 contour, 0 closed; 1 between them, 1 as drawn\n"
      "new/folder/a_Holes_of_5.cnc: 1 contour, 1 closed; 4.5 between them, 5.5 as drawn\n");
  EXPECT_EQ(
      cnc({"import-dxf", "a.dxf", "--one-per", "contour", "--base", "Part", "--start", "9,0"}).out,
      "Part_1.cnc: 1 contour, 0 closed\nPart_2.cnc: 1 contour, 1 closed\n");
  EXPECT_EQ(read("Part_1.cnc"), "% a.dxf\nN10 G17\nN20 G0 X10 Y0 (Cut)\nN30 G1 X30 Y0\n");
  EXPECT_EQ(cnc({"import-dxf", "a.dxf", "--layer", "HOLES OF 5", "--base", "Holes"}).exitCode, 0);
  EXPECT_THAT(read("Holes.cnc"), Not(HasSubstr("Cut")));
}

TEST_F(CncDrawing, LeavesProgramsThatAreThere) {
  write("a.dxf", kDrawing);
  write("a.cnc", "G1 X1 F1\n");
  const ProcessResult result = cnc({"import-dxf", "a.dxf"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("`a.cnc` is there: it is not overwritten"));
  EXPECT_THAT(result.err, HasSubstr("--replace"));
  EXPECT_EQ(read("a.cnc"), "G1 X1 F1\n");
  EXPECT_EQ(cnc({"import-dxf", "a.dxf", "--replace"}).exitCode, 0);
  EXPECT_THAT(read("a.cnc"), HasSubstr("G3 I5 J0"));
}

TEST_F(CncDrawing, RefusesBadDrawings) {
  write("a.dxf",
        "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\n1\n20\n1e400\n40\n1\n0\nENDSEC\n0\nEOF\n");
  const ProcessResult result = cnc({"import-dxf", "a.dxf"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("error[SE0893]: `1e400` is no number that is possible here"));
  EXPECT_THAT(result.err, HasSubstr("a.dxf:10:1"));
  EXPECT_THAT(result.err, HasSubstr("help"));
  EXPECT_FALSE(exists("a.cnc"));
  write("b.dxf", std::string("AutoCAD Binary DXF\r\n\x1a\0\0\0", 24));
  EXPECT_THAT(cnc({"import-dxf", "b.dxf"}).err, HasSubstr("this is a binary DXF file"));
  EXPECT_NE(cnc({"import-dxf", "none.dxf"}).exitCode, 0);
}

TEST_F(CncDrawing, RefusesBadArguments) {
  write("a.dxf", kDrawing);
  for (const std::vector<std::string> &bad :
       std::vector<std::vector<std::string>>{{"--epsilon", "0"},
                                             {"--epsilon", "nan"},
                                             {"--tolerance", "-1"},
                                             {"--scale", "0"},
                                             {"--one-per", "page"},
                                             {"--start", "1"},
                                             {"--depth", "-1"},
                                             {"--safe-z", "1"},
                                             {"--lead-in", "2"},
                                             {"--tool", "up"},
                                             {"--on", "G1"},
                                             {"--on", "M3\nG0 X5"},
                                             {"--off", "H"},
                                             {"--base", "../a"},
                                             {"--words", "X1\nX2"},
                                             {"--on", "M70000"},
                                             {"--words", "W"},
                                             {"--layer", "none"}}) {
    std::vector<std::string> arguments{"import-dxf", "a.dxf"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    EXPECT_NE(cnc(arguments).exitCode, 0) << bad[0] << " " << bad[1];
  }
  EXPECT_FALSE(exists("a.cnc"));
}

/// The program of the example LaserCut is what its README says.
TEST_F(CncDrawing, TheExampleIsMadeOfItsDrawing) {
  const std::filesystem::path example =
      std::filesystem::path(STRIDE_SOURCE_DIR) / "examples/LaserCut";
  write("Part.dxf", readFile(example / "Part.dxf"));
  const ProcessResult result = cnc({"import-dxf",
                                    "Part.dxf",
                                    "--inside-first",
                                    "--tool",
                                    "left",
                                    "--tool-radius",
                                    "0.15",
                                    "--lead-in",
                                    "4",
                                    "--loops",
                                    "--on",
                                    "M3",
                                    "--on",
                                    "H1",
                                    "--off",
                                    "H-1",
                                    "--feed",
                                    "60",
                                    "--words",
                                    "E2000 E-2000 FF300 EF4000 EF-4000",
                                    "--return"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(read("Part.cnc"), readFile(example / "Part.cnc"));
  EXPECT_THAT(
      readFile(example / "README.md"),
      HasSubstr("stride cnc import-dxf examples/LaserCut/Part.dxf --inside-first --tool left "
                "--tool-radius 0.15 --lead-in 4 --loops --on M3 --on H1 --off H-1 --feed 60 "
                "--words \"E2000 E-2000 FF300 EF4000 EF-4000\" --return --replace"));
}

TEST_F(CncDrawing, DrawsAProgram) {
  write("a.cnc", "N10 G0 X$x$ Y0 F10\nN20 G1 X30\nN30 G2 X40 Y10 I10 J0\n");
  const ProcessResult shown = cnc({"export-dxf", "a.cnc"});
  EXPECT_EQ(shown.exitCode, 0);
  EXPECT_THAT(shown.out, HasSubstr("AC1015"));
  EXPECT_EQ(cnc({"export-dxf", "a.cnc", "-o", "b.dxf", "--set", "x=12", "--rapid"}).out, "");
  EXPECT_EQ(cnc({"import-dxf", "b.dxf", "--layer", "PATH"}).exitCode, 0);
  EXPECT_EQ(read("b.cnc"), "% b.dxf\nN10 G17\nN20 G0 X12 Y0 (PATH)\nN30 G1 X30 Y0\n"
                           "N40 G2 X40 Y10 I10 J0\n");
  EXPECT_NE(cnc({"export-dxf", "a.cnc", "-o", "a.cnc"}).exitCode, 0);
  write("a.cnc", "N10 G20 L5\n");
  EXPECT_THAT(cnc({"export-dxf", "a.cnc"}).err, HasSubstr("error[SE0884]"));
}

} // namespace
} // namespace stride::test
