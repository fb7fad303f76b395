// Sequential function charts of PLCopen XML: along the lines from step to step.
#include "compiler/import/drawn_bodies.hpp"
#include "compiler/import/plcopen_reader.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace {

using stc::import::Model;

/// `rest`: elements of the POU; variables (`<localVars>`) go to its interface.
Model read(const std::string &chart, const std::string &rest = {}) {
  const bool variables = rest.starts_with("<localVars>");
  Model model;
  stc::import::readPlcOpen(
      "chart.xml",
      fmt::format("<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><types><dataTypes/>"
                  "<pous><pou name=\"Chart\" pouType=\"program\"><interface>{}</interface>{}"
                  "<body><SFC>{}</SFC></body></pou></pous></types></project>",
                  variables ? rest : "", variables ? "" : rest, chart),
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

std::string block(int id, const std::string &type, const std::string &instance,
                  const std::vector<std::pair<std::string, int>> &inputs,
                  const std::string &output = "OUT") {
  std::string pins;
  for (const auto &[name, from] : inputs)
    pins += fmt::format("<variable formalParameter=\"{}\"><connectionPointIn><connection "
                        "refLocalId=\"{}\"/></connectionPointIn></variable>",
                        name, from);
  return fmt::format("<block localId=\"{}\" typeName=\"{}\"{}><position x=\"0\" y=\"{}\"/>"
                     "<inputVariables>{}</inputVariables><outputVariables><variable "
                     "formalParameter=\"{}\"><connectionPointOut/></variable></outputVariables>"
                     "</block>",
                     id, type, instance.empty() ? "" : " instanceName=\"" + instance + "\"", id,
                     pins, output);
}

std::string variable(int id, const std::string &text) {
  return fmt::format("<inVariable localId=\"{}\"><position x=\"0\" y=\"{}\"/><expression>{}"
                     "</expression></inVariable>",
                     id, id, text);
}

std::string lineFrom(int id, const std::string &pin = {}) {
  return fmt::format("<connectionPointIn><connection refLocalId=\"{}\"{}/></connectionPointIn>", id,
                     pin.empty() ? "" : " formalParameter=\"" + pin + "\"");
}

/// The text of the only object, after drawn bodies have become statements.
std::string translated(Model &model) {
  stc::import::translateDrawnBodies(model, {});
  return model.objects.front().text;
}

TEST(PlcOpenChart, MakesExpressionsOfDrawnOperators) {
  const std::string drawn = variable(40, "a") + variable(41, "n + 1") + variable(42, "7") +
                            block(43, "LT", {}, {{"IN1", 41}, {"IN2", 42}}) +
                            block(44, "AND", {}, {{"IN1", 40}, {"IN2", 43}});
  const std::string chart = step(1, "Start", {11}, true) + drawn;
  EXPECT_NE(read(chart + transition(11, 1, lineFrom(44, "OUT")))
                .objects.front()
                .text.find(" := a AND n + 1 < 7;\n"),
            std::string::npos);
  const std::string negated =
      fmt::format("<transition localId=\"11\"><connectionPointIn><connection refLocalId=\"1\"/>"
                  "</connectionPointIn><condition negated=\"true\">{}</condition></transition>",
                  lineFrom(44, "OUT"));
  EXPECT_NE(read(chart + negated).objects.front().text.find(" := NOT (a AND n + 1 < 7);\n"),
            std::string::npos);
}

/// Two transitions read one timer: it is called once. `Conditions` and `Condition1` are taken.
TEST(PlcOpenChart, ComputesDrawnBlocksInAnAction) {
  Model model =
      read(step(1, "Start", {12}, true) + step(2, "Next", {11}) + variable(40, "Conditions") +
               variable(41, "T#5ms") + block(42, "TON", "Wait", {{"IN", 40}, {"PT", 41}}, "Q") +
               block(43, "NOT", {}, {{"IN", 42}}) + transition(11, 1, lineFrom(42, "Q")) +
               transition(12, 2, lineFrom(43, "OUT")),
           "<localVars><variable name=\"condition1\"><type><BOOL/></type></variable></localVars>");
  EXPECT_EQ(translated(model),
            "PROGRAM Chart\nVAR\n  condition1 : BOOL;\nEND_VAR\n"
            "VAR\n  Condition1_1 : BOOL;\n  Condition2 : BOOL;\nEND_VAR\n\n"
            "INITIAL_STEP Start:\n  Conditions_1(S);\nEND_STEP\n"
            "TRANSITION FROM Start TO Next := Condition1_1;\nEND_TRANSITION\n"
            "STEP Next:\nEND_STEP\nTRANSITION FROM Next TO Start := Condition2;\n"
            "END_TRANSITION\n\nACTION Conditions_1:\nWait(IN := Conditions, PT := T#5ms);\n"
            "Condition1_1 := Wait.Q;\nCondition2 := NOT Wait.Q;\nEND_ACTION\nEND_PROGRAM\n");
  EXPECT_TRUE(model.leftOut.empty());
}

TEST(PlcOpenChart, ReadsDrawnBodiesOfTransitions) {
  const auto drawn = [](const std::string &target) {
    return "<transitions><transition name=\"Stop\"><body><FBD>" + variable(1, "go") +
           block(2, "NOT", {}, {{"IN", 1}}) + "<outVariable localId=\"3\">" + lineFrom(2, "OUT") +
           "<expression>" + target + "</expression></outVariable></FBD></body></transition>" +
           "</transitions>";
  };
  const std::string chart = step(1, "Start", {11}, true) + transition(11, 1,
                                                                      "<reference "
                                                                      "name=\"Stop\"/>");
  EXPECT_NE(read(chart, drawn("STOP"))
                .objects.front()
                .text.find("TRANSITION Stop FROM Start TO Start := NOT go;\n"),
            std::string::npos);
  const Model other = read(chart, drawn("Halt"));
  ASSERT_EQ(other.leftOut.size(), 1U);
  EXPECT_NE(other.leftOut[0].text.find("nothing in it is assigned to `Stop`"), std::string::npos);
}

/// A ladder as the body of a transition: its coil has the transition's name.
TEST(PlcOpenChart, ReadsLaddersOfTransitions) {
  const Model model =
      read(step(1, "Start", {11}, true) + transition(11, 1, "<reference name=\"Stop\"/>"),
           "<transitions><transition name=\"Stop\"><body><LD><leftPowerRail localId=\"90\"/>" +
               contact(40, "a", {90}) + contact(41, "b", {90}, " negated=\"true\"") +
               contact(42, "c", {40, 41}) +
               "<coil localId=\"43\"><connectionPointIn><connection refLocalId=\"42\"/>"
               "</connectionPointIn><variable>Stop</variable></coil></LD></body></transition>"
               "</transitions>");
  EXPECT_NE(model.objects.front().text.find(
                "TRANSITION Stop FROM Start TO Start := (a OR NOT b) AND c;\n"),
            std::string::npos)
      << model.objects.front().text;
  EXPECT_TRUE(model.leftOut.empty());
}

/// What an action tells stays with it, after its time.
TEST(PlcOpenChart, KeepsIndicatorVariables) {
  const Model model =
      read(step(1, "Start", {11}, true) +
           "<actionBlock localId=\"30\"><connectionPointIn><connection refLocalId=\"1\"/>"
           "</connectionPointIn><action localId=\"31\" qualifier=\"L\" duration=\"T#3s\" "
           "indicator=\"hot\"><reference name=\"Heat\"/></action><action localId=\"32\" "
           "indicator=\"full\"><reference name=\"Fill\"/></action></actionBlock>" +
           transition(11, 1, inlineText("TRUE")));
  EXPECT_NE(model.objects.front().text.find("  Heat(L, T#3s, hot);\n  Fill(N, full);\n"),
            std::string::npos)
      << model.objects.front().text;
  EXPECT_TRUE(model.leftOut.empty());
}

TEST(PlcOpenChart, DetectsEdgesOfContacts) {
  Model model = withCondition(contact(40, "a", {90}, " edge=\"falling\""), 40);
  const std::string text = translated(model);
  EXPECT_NE(text.find("  a_falling : F_TRIG;\n"), std::string::npos) << text;
  EXPECT_NE(text.find("a_falling(CLK := a);\nCondition1 := a_falling.Q;\n"), std::string::npos)
      << text;
}

/// CODESYS draws a line from a jump to where the branch would end.
TEST(PlcOpenChart, JumpsEndBranches) {
  const Model model =
      read(step(1, "Start", {}, true) + transition(11, 1, inlineText("a")) +
           "<jumpStep localId=\"12\" targetName=\"Start\">" + lineFrom(11) + "</jumpStep>" +
           transition(13, 1, inlineText("b"), 9) + element("selectionConvergence", 14, {12, 13}) +
           step(2, "Last", {14}) + transition(15, 2, inlineText("c")) +
           "<jumpStep localId=\"16\" targetName=\"Start\">" + lineFrom(15) + "</jumpStep>");
  EXPECT_TRUE(model.leftOut.empty());
  EXPECT_NE(model.objects.front().text.find("TRANSITION FROM Start TO Start := a;"),
            std::string::npos);
  EXPECT_NE(model.objects.front().text.find("TRANSITION FROM Start TO Last := b;"),
            std::string::npos);
}

TEST(PlcOpenChart, EndsOnCirclesOfDivergences) {
  const Model model = read(step(1, "A", {2}, true) + element("selectionConvergence", 2, {3}) +
                           element("selectionConvergence", 3, {2}));
  EXPECT_EQ(model.objects.front().text,
            "PROGRAM Chart\n\nINITIAL_STEP A:\nEND_STEP\nEND_PROGRAM\n");
}

} // namespace
