// Sequential function charts of PLCopen XML: along the lines from step to step.
#include "compiler/import/plcopen_reader.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace {

using stc::import::Model;

Model read(const std::string &chart, const std::string &rest = {}) {
  Model model;
  stc::import::readPlcOpen(
      "chart.xml",
      fmt::format("<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><types><dataTypes/>"
                  "<pous><pou name=\"Chart\" pouType=\"program\"><interface/>{}<body><SFC>{}"
                  "</SFC></body></pou></pous></types></project>",
                  rest, chart),
      model);
  return model;
}

std::string step(int id, const std::string &name, const std::vector<int> &from,
                 bool initial = false) {
  std::string lines;
  for (const int each : from)
    lines += fmt::format("<connection refLocalId=\"{}\"/>", each);
  return fmt::format("<step localId=\"{}\" name=\"{}\" initialStep=\"{}\"><position x=\"{}\" "
                     "y=\"0\"/><connectionPointIn>{}</connectionPointIn></step>",
                     id, name, initial, id, lines);
}

std::string element(const std::string &kind, int id, const std::vector<int> &from, int x = 0) {
  std::string lines;
  for (const int each : from)
    lines +=
        fmt::format("<connectionPointIn><connection refLocalId=\"{}\"/></connectionPointIn>", each);
  return fmt::format("<{} localId=\"{}\"><position x=\"{}\" y=\"0\"/>{}</{}>", kind, id, x, lines,
                     kind);
}

std::string transition(int id, int from, const std::string &condition, int x = 0,
                       const std::string &more = {}) {
  return fmt::format("<transition localId=\"{}\"{}><position x=\"{}\" y=\"0\"/><connectionPointIn>"
                     "<connection refLocalId=\"{}\"/></connectionPointIn><condition>{}"
                     "</condition></transition>",
                     id, more, x, from, condition);
}

std::string inlineText(const std::string &text) {
  return "<inline name=\"\"><ST><p>" + text + "</p></ST></inline>";
}

TEST(PlcOpenChart, FollowsAlternativesFromLeftToRight) {
  const Model model =
      read(step(1, "Start", {20, 21}, true) + element("selectionDivergence", 10, {1}) +
           transition(11, 10, inlineText("b"), 50) + transition(12, 10, inlineText(":= a;"), 10) +
           step(2, "B", {11}) + step(3, "A", {12}) + transition(20, 2, inlineText("TRUE")) +
           transition(22, 3, "<reference name=\"back\"/>", 0, " priority=\"7\"") +
           element("selectionConvergence", 21, {22}));
  EXPECT_EQ(model.objects.front().text,
            "PROGRAM Chart\n\nINITIAL_STEP Start:\nEND_STEP\n"
            "TRANSITION FROM Start TO A := a;\nEND_TRANSITION\n"
            "TRANSITION FROM Start TO B := b;\nEND_TRANSITION\n"
            "STEP B:\nEND_STEP\nTRANSITION FROM B TO Start := TRUE;\nEND_TRANSITION\n"
            "STEP A:\nEND_STEP\nTRANSITION (PRIORITY := 7) FROM A TO Start := back;\n"
            "END_TRANSITION\nEND_PROGRAM\n");
  EXPECT_TRUE(model.leftOut.empty());
}

TEST(PlcOpenChart, FollowsParallelBranches) {
  const Model model =
      read(step(1, "Start", {}, true) + transition(11, 1, "<reference name=\"Go\"/>") +
               element("simultaneousDivergence", 12, {11}) + step(2, "L", {12}) +
               step(3, "R", {12}) + element("simultaneousConvergence", 13, {2, 3}) +
               transition(14, 13, inlineText("x &gt; 2"), 0) +
               "<jumpStep localId=\"15\" targetName=\"Start\"><connectionPointIn><connection "
               "refLocalId=\"14\"/></connectionPointIn></jumpStep>",
           "<transitions><transition name=\"Go\"><body><ST><p>a AND b;</p></ST></body>"
           "</transition></transitions>");
  EXPECT_EQ(model.objects.front().text,
            "PROGRAM Chart\n\nINITIAL_STEP Start:\nEND_STEP\n"
            "TRANSITION Go FROM Start TO (L, R) := a AND b;\nEND_TRANSITION\n"
            "STEP L:\nEND_STEP\nTRANSITION FROM (L, R) TO Start := x > 2;\nEND_TRANSITION\n"
            "STEP R:\nEND_STEP\nEND_PROGRAM\n");
}

TEST(PlcOpenChart, ReadsActionsAndContacts) {
  const Model model = read(
      "<leftPowerRail localId=\"90\"/>" + step(1, "Start", {90, 11}, true) +
      "<actionBlock localId=\"30\"><connectionPointIn><connection refLocalId=\"1\"/>"
      "</connectionPointIn><action localId=\"31\" qualifier=\"SD\" duration=\"T#3s\">"
      "<reference name=\"Heat\"/></action><action localId=\"32\"><inline><ST><p>n := n + 1;</p>"
      "</ST></inline></action></actionBlock>"
      "<contact localId=\"40\" negated=\"true\"><connectionPointIn><connection refLocalId=\"90\"/>"
      "</connectionPointIn><variable>a</variable></contact>"
      "<contact localId=\"41\"><connectionPointIn><connection refLocalId=\"40\"/><connection "
      "refLocalId=\"42\"/></connectionPointIn><variable>c</variable></contact>"
      "<inVariable localId=\"42\"><expression>b</expression></inVariable>" +
      transition(11, 1, "<connectionPointIn><connection refLocalId=\"41\"/></connectionPointIn>"));
  EXPECT_EQ(model.objects.front().text,
            "PROGRAM Chart\n\nINITIAL_STEP Start:\n  Heat(SD, T#3s);\n  Start_action1(N);\n"
            "END_STEP\nTRANSITION FROM Start TO Start := (NOT a OR b) AND c;\nEND_TRANSITION\n"
            "\nACTION Start_action1:\nn := n + 1;\nEND_ACTION\nEND_PROGRAM\n");
}

/// Each is left out as a whole, with the compiler stopped in its place.
TEST(PlcOpenChart, RefusesWhatItCannotFollow) {
  const std::string wrong[] = {
      step(1, "A", {7}, true),                                    // from nowhere
      step(1, "A", {}, true) + step(2, "B", {1}),                 // without a transition
      step(1, "A", {}, true) + transition(3, 1, inlineText("a")), // to nowhere
      step(1, "A", {3}, true) + transition(3, 1, ""),             // without a condition
      step(1, "A", {3}, true) + transition(3, 1, inlineText("a; b;")),
      step(1, "A", {3}, true) +
          transition(3, 1,
                     "<connectionPointIn><connection refLocalId=\"4\"/></connectionPointIn>") +
          "<contact localId=\"4\"><connectionPointIn><connection refLocalId=\"4\"/>"
          "</connectionPointIn><variable>a</variable></contact>", // a circle
      step(1, "A", {3}, true) + "<transition localId=\"3\"/>",    // from no step
      "<macroStep localId=\"1\" name=\"M\"/>",
  };
  for (const std::string &chart : wrong) {
    const Model model = read(chart);
    EXPECT_EQ(model.leftOut.size(), 1U) << chart;
    EXPECT_NE(model.objects.front().text.find("{error 'body not imported: SFC: "),
              std::string::npos)
        << model.objects.front().text;
    EXPECT_EQ(model.objects.front().text.find("STEP A"), std::string::npos);
  }
}

TEST(PlcOpenChart, EndsOnCirclesOfDivergences) {
  const Model model = read(step(1, "A", {2}, true) + element("selectionConvergence", 2, {3}) +
                           element("selectionConvergence", 3, {2}));
  EXPECT_EQ(model.objects.front().text,
            "PROGRAM Chart\n\nINITIAL_STEP A:\nEND_STEP\nEND_PROGRAM\n");
}

} // namespace
