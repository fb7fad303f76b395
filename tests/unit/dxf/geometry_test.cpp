// Programs of drawings go where the drawing does, and nowhere else.
#include "tests/unit/dxf/drawing_support.hpp"

namespace stc::test {
namespace {

TEST(DxfGeometry, RandomDrawingsAreWhereTheirParametersSay) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const RandomDrawing drawing(seed);
    DxfImport how;
    how.tolerance = seed % 2 == 0 ? 0.001 : 0.02;
    const Imported result = import(drawing.text(), how);
    ASSERT_EQ(result.error, "") << drawing.text();
    ASSERT_EQ(result.programs.size(), 1U);
    // The lines between the places that are looked at are off, too.
    const double chords = 2e-3;
    expectSame(drawing.curves, curvesOf(pathOf(result.programs[0].text)),
               how.epsilon + how.tolerance + chords, drawing.text() + result.programs[0].text);
    if (HasFatalFailure())
      return;
  }
}

TEST(DxfGeometry, LinesArcsEllipsesAreExact) {
  const std::string text = drawingOf(
      "0\nLINE\n8\n0\n10\n1.5\n20\n2\n11\n7\n21\n-3\n"
      "0\nCIRCLE\n8\n0\n10\n20\n20\n0\n40\n4.25\n"
      "0\nARC\n8\n0\n10\n40\n20\n0\n40\n5\n50\n90\n51\n0\n"
      "0\nELLIPSE\n8\n0\n10\n60\n20\n0\n11\n0\n21\n8\n40\n0.25\n41\n0\n42\n3.141592653589793\n");
  EXPECT_EQ(import(text).programs.at(0).text, "% a.dxf\nN10 G17\n"
                                              "N20 G0 X1.5 Y2\nN30 G1 X7 Y-3\n"
                                              "N40 G0 X15.75 Y0\nN50 G3 I4.25 J0\n"
                                              "N60 G0 X40 Y5\nN70 G3 X45 Y0 I0 J-5\n"
                                              "N80 G0 X60 Y8\n"
                                              "N90 G9 X60 Y-8 I0 J-8 K90 R0.25\n");
}

TEST(DxfGeometry, SplinesOfDegree1And2AreExact) {
  const auto spline = [](int degree, const std::string &rest) {
    return drawingOf(fmt::format("0\nSPLINE\n8\n0\n71\n{}\n", degree) + rest);
  };
  EXPECT_EQ(import(spline(1, "40\n0\n40\n0\n40\n1\n40\n2\n40\n2\n10\n1\n20\n1\n10\n2\n20\n5\n"
                             "10\n3\n20\n3\n"))
                .programs.at(0)
                .text,
            "% a.dxf\nN10 G17\nN20 G0 X1 Y1\nN30 G1 X2 Y5\nN40 G1 X3 Y3\n");
  EXPECT_EQ(
      import(spline(2, "40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n10\n1\n20\n1\n10\n4\n20\n5\n"
                       "10\n9\n20\n3\n"))
          .programs.at(0)
          .text,
      "% a.dxf\nN10 G17\nN20 G0 X1 Y1\nN30 G6 X9 Y3 I3 J4\n");
}

/// Arcs that stand for a spline follow each other without a bend.
TEST(DxfGeometry, ArcsOfASplineHaveOneTangent) {
  const Imported result =
      import(drawingOf("0\nSPLINE\n8\n0\n71\n3\n40\n0\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n"
                       "40\n1\n10\n0\n20\n0\n10\n30\n20\n40\n10\n60\n20\n-40\n10\n90\n20\n10\n"));
  const std::vector<PathObject> path = pathOf(result.programs.at(0).text);
  size_t arcs = 0;
  for (size_t i = 2; i < path.size(); ++i) {
    const auto in = stride::cnc::test::tangentAt(path[i - 1], 1);
    const auto out = stride::cnc::test::tangentAt(path[i], 0);
    EXPECT_LT(stride::cnc::test::sizeOf(stride::cnc::test::operator-(out, in)), 1e-5);
    arcs += isCircle(path[i].moveType) ? 1 : 0;
  }
  EXPECT_GT(arcs, 10U);
  EXPECT_LT(arcs, 120U); // short lines within 0.001 would be 300
}

TEST(DxfGeometry, UnitsAndScale) {
  const std::string line = "0\nLINE\n8\n0\n10\n1\n20\n0\n11\n3\n21\n0\n";
  const auto of = [&](int unit, std::optional<double> scale) {
    DxfImport how;
    how.scale = scale;
    return import(drawingOf(line, "", fmt::format("9\n$INSUNITS\n70\n{}\n", unit)), how);
  };
  EXPECT_NE(of(1, {}).programs.at(0).text.find("G1 X76.2 Y0"), std::string::npos);
  EXPECT_EQ(of(1, {}).warnings.at(0), "SE0895 1: the drawing is in inches: the program is in mm");
  EXPECT_NE(of(1, 1).programs.at(0).text.find("G1 X3 Y0"), std::string::npos);
  EXPECT_TRUE(of(1, 1).warnings.empty());
  EXPECT_NE(of(4, {}).programs.at(0).text.find("G1 X3 Y0"), std::string::npos);
  EXPECT_NE(of(0, {}).programs.at(0).text.find("G1 X3 Y0"), std::string::npos);
  EXPECT_NE(of(99, {}).programs.at(0).text.find("G1 X3 Y0"), std::string::npos);
  EXPECT_NE(of(5, 2.5).programs.at(0).text.find("G1 X7.5 Y0"), std::string::npos);
  EXPECT_NE(of(6, {}).programs.at(0).text.find("G1 X3000 Y0"), std::string::npos);
}

TEST(DxfGeometry, LayersAreChosen) {
  const std::string layers = "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n"
                             "0\nLAYER\n2\nCut\n70\n0\n62\n7\n0\nLAYER\n2\nFrozen\n70\n1\n62\n7\n"
                             "0\nLAYER\n2\nOff\n70\n0\n62\n-7\n0\nENDTAB\n0\nENDSEC\n";
  std::string entities;
  for (const auto &[layer, x] : {std::pair{"Cut", 1}, {"Frozen", 2}, {"Off", 3}, {"cut", 4}})
    entities += fmt::format("0\nLINE\n8\n{}\n10\n{}\n20\n0\n11\n{}\n21\n9\n", layer, x, x);
  const std::string text = layers + drawingOf(entities);
  const auto columns = [&](std::vector<std::string> wanted) {
    DxfImport how;
    how.layers = std::move(wanted);
    std::string all;
    for (const PathObject &object : pathOf(import(text, how).programs.at(0).text))
      if (isCut(object))
        all += fmt::format("{:g} ", object.end.coordinate[0]);
    return all;
  };
  EXPECT_EQ(columns({}), "1 4 ");
  EXPECT_EQ(columns({"CUT"}), "1 4 ");
  EXPECT_EQ(columns({"frozen"}), "2 ");
  EXPECT_EQ(columns({"Off", "Cut"}), "1 3 4 ");
  EXPECT_EQ(import(text).warnings,
            (std::vector<std::string>{
                "SE0894 66: 1 entity is left out: in layer Frozen, which is off or frozen",
                "SE0894 78: 1 entity is left out: in layer Off, which is off or frozen"}));
  DxfImport how;
  how.layers = {"Holes"};
  EXPECT_EQ(import(text, how).error, "SE0893 1: this drawing has no layer `Holes`");
  how.layers = {};
  how.part = DxfPart::Layer;
  how.layers = {"Cut", "Off"};
  const Imported parts = import(text, how);
  ASSERT_EQ(parts.programs.size(), 2U);
  EXPECT_EQ(parts.programs[0].layer, "Cut");
  EXPECT_EQ(parts.programs[0].contours, 2U);
  EXPECT_EQ(parts.programs[1].layer, "Off");
}

} // namespace
} // namespace stc::test
