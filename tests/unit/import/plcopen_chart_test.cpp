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

std::string contact(int id, const std::string &variable, const std::vector<int> &from,
                    const std::string &more = {}) {
  std::string lines;
  for (const int each : from)
    lines += fmt::format("<connection refLocalId=\"{}\"/>", each);
  return fmt::format("<contact localId=\"{}\"{}><connectionPointIn>{}</connectionPointIn>"
                     "<variable>{}</variable></contact>",
                     id, more, lines, variable);
}

/// A chart with one step, whose only transition has the condition at the end of these elements.
Model withCondition(const std::string &elements, int last) {
  return read("<leftPowerRail localId=\"90\"/>" + step(1, "Start", {11}, true) + elements +
              transition(11, 1,
                         fmt::format("<connectionPointIn><connection refLocalId=\"{}\"/>"
                                     "</connectionPointIn>",
                                     last)));
}

TEST(PlcOpenChart, BracketsWhatStandsBeforeAContact) {
  const std::string before =
      "<inVariable localId=\"40\"><expression>a OR b</expression></inVariable>";
  EXPECT_NE(withCondition(before + contact(41, "c", {40}, " negated=\"true\""), 41)
                .objects.front()
                .text.find(":= (a OR b) AND NOT c;"),
            std::string::npos);
  EXPECT_NE(withCondition(contact(40, "a", {90}) + contact(41, "c", {40}), 41)
                .objects.front()
                .text.find(":= a AND c;"),
            std::string::npos);
  const Model alone = withCondition(contact(40, "c", {}), 40);
  ASSERT_EQ(alone.leftOut.size(), 1U);
  EXPECT_NE(alone.leftOut[0].text.find("a contact that no line leads to"), std::string::npos);
}

/// Pairs of contacts in a row, each of which both of the next begin at: 2^n paths.
TEST(PlcOpenChart, RefusesConditionsOfManyPaths) {
  const auto pairs = [](int count) {
    std::string text = contact(100, "a", {90}) + contact(101, "b", {90});
    for (int i = 1; i < count; ++i)
      for (int k = 0; k < 2; ++k)
        text += contact(100 + 2 * i + k, "c", {98 + 2 * i, 99 + 2 * i});
    return withCondition(text, 100 + 2 * (count - 1));
  };
  EXPECT_TRUE(pairs(8).leftOut.empty());
  const Model many = pairs(60);
  ASSERT_EQ(many.leftOut.size(), 1U);
  EXPECT_NE(many.leftOut[0].text.find("more than 1000 contacts"), std::string::npos);
}

/// A member of a member: the chart in an action needs actions of its own.
TEST(PlcOpenChart, ReportsActionsThatHaveNoPlace) {
  const std::string inner = "<actionBlock localId=\"30\"><connectionPointIn><connection "
                            "refLocalId=\"1\"/></connectionPointIn><action localId=\"31\"><inline>"
                            "{}</inline></action></actionBlock>";
  const std::string text = "<ST><p>n := 1;</p></ST>";
  const auto chart = [&](const std::string &action) {
    return step(1, "Go", {11}, true) + transition(11, 1, inlineText("TRUE")) +
           fmt::format(fmt::runtime(inner), action);
  };
  EXPECT_TRUE(read(chart(text)).leftOut.empty());
  const Model nested = read(chart("<SFC>" + chart(text) + "</SFC>"));
  ASSERT_EQ(nested.leftOut.size(), 1U);
  EXPECT_EQ(nested.leftOut[0].object, "Chart.Go_action1");
  const std::string method =
      "<addData><data name=\"x\" handleUnknown=\"implementation\"><Method name=\"Do\"><interface/>"
      "<body><SFC>" +
      chart(text) + "</SFC></body></Method></data></addData>";
  const Model block = read(chart(text), method);
  ASSERT_EQ(block.leftOut.size(), 1U);
  EXPECT_EQ(block.leftOut[0].object, "Chart.Do");
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
