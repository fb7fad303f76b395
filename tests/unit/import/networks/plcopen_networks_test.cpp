// Drawn bodies of PLCopen XML.
#include "compiler/import/networks/plcopen_networks.hpp"
#include "compiler/import/networks/print.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

namespace stc::import::networks {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Translation translate(const std::string &body, const std::string &pou = "PROGRAM") {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(("<body>" + body + "</body>").c_str(),
                                   pugi::parse_default | pugi::parse_ws_pcdata_single));
  Scope scope;
  scope.declare("FUNCTION_BLOCK TON VAR_INPUT IN : BOOL; PT : TIME; END_VAR\n"
                "VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR END_FUNCTION_BLOCK\n"
                "FUNCTION_BLOCK Own VAR_INPUT EN : BOOL; END_VAR VAR_OUTPUT r : INT; END_VAR\n"
                "END_FUNCTION_BLOCK\n"
                "FUNCTION_BLOCK Count VAR_IN_OUT v : INT; END_VAR END_FUNCTION_BLOCK\n"
                "FUNCTION Split : INT VAR_INPUT v : INT; w : INT := 2; END_VAR\n"
                "VAR_OUTPUT rest : INT; END_VAR END_FUNCTION\n");
  scope.enter(pou + " P VAR a, b, c, d, x, y, z : BOOL; n, m, k : INT; tm : TON; own : Own;\n"
                    "t : TIME; c1, c2 : Count; END_VAR");
  Translation result;
  const LineOf offset = [](const pugi::xml_node &node) {
    return static_cast<size_t>(node.offset_debug());
  };
  Body read = readPlcOpenBody(document.child("body"), offset, result.problems);
  return result.ok() ? translated(std::move(read), scope) : result;
}

std::string wire(const std::string &id, const std::string &pin = "") {
  return "<connectionPointIn><connection refLocalId=\"" + id + "\"" +
         (pin.empty() ? "" : " formalParameter=\"" + pin + "\"") + "/></connectionPointIn>";
}

std::string in(int id, const std::string &text, const std::string &attributes = "") {
  return "<inVariable localId=\"" + std::to_string(id) + "\" " + attributes +
         "><position x=\"0\" y=\"0\"/><connectionPointOut/><expression>" + text +
         "</expression></inVariable>";
}

std::string out(int id, const std::string &text, const std::string &from,
                const std::string &attributes = "") {
  return "<outVariable localId=\"" + std::to_string(id) + "\" " + attributes + ">" + from +
         "<expression>" + text + "</expression></outVariable>";
}

std::string contact(int id, const std::string &text, const std::string &from,
                    const std::string &attributes = "") {
  return "<contact localId=\"" + std::to_string(id) + "\" " + attributes + ">" + from +
         "<connectionPointOut/><variable>" + text + "</variable></contact>";
}

std::string coil(int id, const std::string &text, const std::string &from,
                 const std::string &attributes = "") {
  return "<coil localId=\"" + std::to_string(id) + "\" " + attributes + ">" + from +
         "<connectionPointOut/><variable>" + text + "</variable></coil>";
}

std::string pin(const std::string &name, const std::string &from,
                const std::string &attributes = "") {
  return "<variable formalParameter=\"" + name + "\" " + attributes + ">" + from + "</variable>";
}

std::string result(const std::string &name, const std::string &target = "",
                   const std::string &attributes = "") {
  return "<variable formalParameter=\"" + name + "\" " + attributes + "><connectionPointOut>" +
         (target.empty() ? "" : "<expression>" + target + "</expression>") +
         "</connectionPointOut></variable>";
}

std::string block(int id, const std::string &attributes, const std::string &inputs,
                  const std::string &outputs, const std::string &rest = "") {
  return "<block localId=\"" + std::to_string(id) + "\" " + attributes + "><inputVariables>" +
         inputs + "</inputVariables><inOutVariables/><outputVariables>" + outputs +
         "</outputVariables>" + rest + "</block>";
}

const std::string kRail = "<leftPowerRail localId=\"0\"><connectionPointOut/></leftPowerRail>";

std::string title(int id, const std::string &comment, const std::string &text,
                  const std::string &label = "") {
  return "<comment localId=\"" + std::to_string(id) + "\"><content><xhtml xmlns=\"h\">" + comment +
         "</xhtml></content></comment>" +
         (label.empty()
              ? ""
              : "<label localId=\"9" + std::to_string(id) + "\" label=\"" + label + "\"/>") +
         "<vendorElement localId=\"8" + std::to_string(id) + "\"><alternativeText><xhtml>" + text +
         "</xhtml></alternativeText><addData><data name=\"fbdelementtype\"><ElementType xmlns=\"\">"
         "networktitle</ElementType></data></addData></vendorElement>";
}

TEST(PlcOpenLadder, networksWithTitlesCommentsLabelsJumpsAndReturns) {
  const Translation result = translate(
      "<LD>" + kRail + title(1, "//Seal-in", "Motor") + contact(3, "a", wire("0")) +
      contact(4, "x", wire("0")) +
      contact(5, "b",
              "<connectionPointIn><connection refLocalId=\"3\"/><connection refLocalId=\"4\"/>"
              "</connectionPointIn>",
              "negated=\"true\"") +
      coil(6, "x", wire("5")) + title(7, "", "") + contact(8, "c", wire("0")) +
      "<jump localId=\"9\" label=\"Done\">" + wire("8") + "</jump>" + title(10, "", "") +
      contact(11, "d", wire("0"), "negated=\"true\"") + "<return localId=\"12\">" + wire("11") +
      "</return>" + title(13, "", "", "Done") + coil(14, "y", wire("0"), "storage=\"set\"") +
      "<rightPowerRail localId=\"99\"><connectionPointIn/></rightPowerRail></LD>");
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.statements,
            "// Motor\n// Seal-in\nx := (a OR x) AND NOT b;\n\n"
            "IF c THEN\n  JMP Done;\nEND_IF\n\nIF NOT d THEN\n  RETURN;\nEND_IF\n\n"
            "Done:\ny S= TRUE;\n");
}

TEST(PlcOpenLadder, branchesInTheMiddleAndBehind) {
  const Translation result = translate(
      "<LD>" + kRail + contact(1, "a", wire("0")) + contact(2, "b", wire("1")) +
      contact(3, "c", wire("1")) +
      contact(4, "d",
              "<connectionPointIn><connection refLocalId=\"2\"/><connection refLocalId=\"3\"/>"
              "</connectionPointIn>") +
      coil(5, "x", wire("4"), "negated=\"true\"") + coil(6, "y", wire("4"), "storage=\"reset\"") +
      "</LD>");
  EXPECT_EQ(result.statements, "rung := a AND (b OR c) AND d;\nx := NOT rung;\ny R= rung;\n");
}

TEST(PlcOpenLadder, edgesGetInstances) {
  const Translation result =
      translate("<LD>" + kRail + contact(1, "a", wire("0"), "edge=\"rising\"") +
                contact(2, "b", wire("1")) + coil(3, "x", wire("2"), "edge=\"falling\"") + "</LD>");
  EXPECT_EQ(result.declarations, "VAR\n  a_rising : R_TRIG;\n  a_falling : F_TRIG;\nEND_VAR\n");
  EXPECT_EQ(result.statements, "a_rising(CLK := a);\na_falling(CLK := a_rising.Q AND b);\n"
                               "x := a_falling.Q;\n");
  EXPECT_THAT(translate("<LD>" + kRail + contact(1, "a", wire("0"), "edge=\"rising\"") +
                            coil(3, "x", wire("1")) + "</LD>",
                        "FUNCTION")
                  .problems,
              SizeIs(1));
}

TEST(PlcOpenLadder, coilsInARowPassTheRungOn) {
  const Translation result = translate("<LD>" + kRail + contact(1, "a", wire("0")) +
                                       coil(2, "x", wire("1")) + coil(3, "y", wire("2")) + "</LD>");
  EXPECT_EQ(result.statements, "x := a;\ny := a;\n");
}

TEST(PlcOpenLadder, aBlockInTheRungWithAPinsVariable) {
  const Translation result = translate(
      "<LD>" + kRail + contact(1, "a", wire("0")) + in(2, "T#5s") +
      block(3, "typeName=\"TON\" instanceName=\"tm\"", pin("IN", wire("1")) + pin("PT", wire("2")),
            ::stc::import::networks::result("Q") + ::stc::import::networks::result("ET", "t")) +
      coil(4, "x", wire("3", "Q")) + "</LD>");
  EXPECT_EQ(result.statements, "tm(IN := a, PT := T#5s, ET => t);\nx := tm.Q;\n");
}

TEST(PlcOpenDiagram, enAndEno) {
  using ::stc::import::networks::result;
  const std::string add = block(
      3, "typeName=\"ADD\"", pin("EN", wire("1")) + pin("In2", wire("2")) + pin("In3", wire("2")),
      result("ENO") + result("Out2"));
  const Translation assigned =
      translate("<FBD>" + in(1, "a") + in(2, "n") + add + out(4, "m", wire("3", "Out2")) +
                out(5, "x", wire("3", "ENO")) + "</FBD>");
  EXPECT_EQ(assigned.statements, "IF a THEN\n  m := n + n;\nEND_IF\nx := a;\n");
  // What goes on into other boxes keeps its last value.
  const Translation read =
      translate("<FBD>" + in(1, "a AND b") + in(2, "n") + add +
                block(6, "typeName=\"MUL\"", pin("In1", wire("3", "Out2")) + pin("In2", wire("2")),
                      result("Out1")) +
                out(4, "m", wire("6")) + out(5, "x", wire("3", "ENO")) + "</FBD>");
  EXPECT_EQ(read.statements, "rung := a AND b;\nIF rung THEN\n  add_out := n + n;\nEND_IF\n"
                             "m := add_out * n;\nx := rung;\n");
  // A comparison in a rung.
  const Translation rung = translate(
      "<LD>" + kRail + contact(1, "a", wire("0")) + in(2, "n") + in(7, "5") +
      block(3, "typeName=\"GE\"",
            pin("EN", wire("1")) + pin("In2", wire("2")) + pin("In3", wire("7")), result("Out1")) +
      contact(5, "b", wire("3")) + coil(4, "x", wire("5")) + "</LD>");
  EXPECT_EQ(rung.statements, "x := a AND n >= 5 AND b;\n");
  // EN of a block's own is an input like others.
  EXPECT_EQ(translate("<FBD>" + in(1, "a") +
                      block(3, "typeName=\"Own\" instanceName=\"own\"", pin("EN", wire("1")),
                            result("r")) +
                      out(4, "m", wire("3", "r")) + "</FBD>")
                .statements,
            "own(EN := a);\nm := own.r;\n");
  EXPECT_EQ(
      translate(
          "<FBD>" + in(1, "a") +
          block(3, "typeName=\"TON\" instanceName=\"tm\"",
                pin("EN", wire("1")) + pin("IN", wire("1"), "edge=\"rising\" negated=\"true\""),
                result("ENO") + result("Q", "x", "negated=\"true\"") + result("ET", "t")) +
          "</FBD>")
          .statements,
      "a_rising(CLK := NOT a);\nIF a THEN\n  tm(IN := a_rising.Q, ET => t);\n  x := NOT "
      "tm.Q;\nEND_IF\n");
}

TEST(PlcOpenDiagram, executeBoxesKeepTheirStatements) {
  const Translation result = translate(
      "<FBD>" + in(1, "a") +
      block(3, "typeName=\"EXECUTE\"", pin("EN", wire("1")), ::stc::import::networks::result("ENO"),
            "<addData><data name=\"fbdcalltype\"><CallType>execute</CallType></data>"
            "<data name=\"stcode\"><STCode>n := 42;\nIF b THEN\n  m := "
            "1;\nEND_IF</STCode></data></addData>") +
      "</FBD>");
  EXPECT_EQ(result.statements,
            "IF a THEN\n  n := 42;\n  IF b THEN\n    m := 1;\n  END_IF\nEND_IF\n");
}

TEST(PlcOpenDiagram, connectorsContinuationsAndOrderByPosition) {
  const Translation result = translate(
      "<FBD>" + in(1, "a") + "<outVariable localId=\"2\"><position x=\"9\" y=\"80\"/>" + wire("1") +
      "<expression>x</expression></outVariable>"
      "<continuation localId=\"3\" name=\"Now\"><connectionPointOut/></continuation>"
      "<outVariable localId=\"4\"><position x=\"9\" y=\"20\"/>" +
      wire("3") +
      "<expression>y</expression></outVariable>"
      "<connector localId=\"5\" name=\"now\">" +
      wire("6") + "</connector>" + in(6, "b", "negated=\"true\"") + "</FBD>");
  EXPECT_EQ(result.statements, "y := NOT b;\nx := a;\n");
  EXPECT_THAT(
      translate("<FBD><continuation localId=\"3\" name=\"Q\"><connectionPointOut/></continuation>" +
                out(4, "y", wire("3")) + "</FBD>")
          .problems,
      SizeIs(1));
}

TEST(PlcOpenChart, executionOrderAndUnnamedConnectors) {
  using ::stc::import::networks::result;
  const Translation chart =
      translate("<ST><xhtml xmlns=\"h\"/></ST><addData><data name=\"cfc\"><CFC>" + in(3, "n") +
                "<connector localId=\"2\" name=\"\">" + wire("3") + "</connector>" + in(5, "m") +
                block(1, "executionOrderId=\"3\" typeName=\"ADD\"",
                      pin("In1", wire("2")) + pin("In3", wire("5")), result("Out1"),
                      "<addData><data><CallType>operator</CallType></data></addData>") +
                "<connector localId=\"0\" name=\"\">" + wire("1", "Out1") + "</connector>" +
                out(6, "k", wire("0"), "executionOrderId=\"1\"") +
                out(7, "n", wire("0"), "executionOrderId=\"4\"") + "</CFC></data></addData>");
  EXPECT_THAT(chart.problems, IsEmpty());
  EXPECT_EQ(chart.declarations, "VAR\n  add_out : INT;\nEND_VAR\n");
  EXPECT_EQ(chart.statements, "k := add_out;\nadd_out := n + m;\nn := add_out;\n");
}

TEST(PlcOpenDiagram, functionsWithFurtherOutputsAndMissingInputsAreCalledByName) {
  using ::stc::import::networks::result;
  EXPECT_EQ(translate("<FBD>" + in(1, "n") +
                      block(3, "typeName=\"Split\"", pin("v", wire("1")) + pin("w", ""),
                            result("Split") + result("rest", "k")) +
                      out(4, "m", wire("3", "Split")) + "</FBD>")
                .statements,
            "split_out := Split(v := n, rest => k);\nm := split_out;\n");
  EXPECT_THAT(translate("<FBD>" + in(1, "n") +
                        block(3, "typeName=\"ADD\"", pin("In1", wire("1")) + pin("In2", ""),
                              result("Out")) +
                        out(4, "m", wire("3")) + "</FBD>")
                  .problems,
              SizeIs(1));
}

TEST(PlcOpenDiagram, feedbackThroughAnOperator) {
  using ::stc::import::networks::result;
  const Translation loop = translate(
      "<FBD>" + in(1, "a") + in(2, "b") +
      block(3, "typeName=\"OR\"", pin("In1", wire("1")) + pin("In2", wire("4")), result("Out")) +
      block(4, "typeName=\"AND\"",
            pin("In1", wire("3")) + pin("In2", wire("2"), "negated=\"true\""), result("Out")) +
      out(5, "x", wire("4")) + "</FBD>");
  EXPECT_EQ(loop.declarations, "VAR\n  and_out : BOOL;\nEND_VAR\n");
  EXPECT_EQ(loop.statements, "and_out := (a OR and_out) AND NOT b;\nx := and_out;\n");
}

TEST(PlcOpenDiagram, theRightSideOfAnInOutIsFoundBeforeItsBlock) {
  const auto count = [](int id, const std::string &instance, const std::string &from) {
    return "<block localId=\"" + std::to_string(id) + "\" typeName=\"Count\" instanceName=\"" +
           instance + "\"><inputVariables/><inOutVariables>" + pin("v", from) +
           "</inOutVariables><outputVariables/></block>";
  };
  const Translation chain =
      translate("<FBD>" + out(7, "k", wire("5", "v")) + count(5, "c2", wire("6", "v")) +
                count(6, "c1", wire("1")) + in(1, "n") + "</FBD>");
  EXPECT_THAT(chain.problems, IsEmpty());
  EXPECT_THAT(chain.statements, HasSubstr("c1(v := n);"));
  EXPECT_THAT(chain.statements, HasSubstr("c2(v := n);"));
  EXPECT_THAT(chain.statements, HasSubstr("k := n;"));
  const Translation circle = translate("<FBD>" + count(5, "c2", wire("6", "v")) +
                                       count(6, "c1", wire("5", "v")) + "</FBD>");
  ASSERT_FALSE(circle.problems.empty());
  EXPECT_THAT(circle.problems[0].text, HasSubstr("has no output `v`"));
}

TEST(PlcOpenDiagram, expressionsOfUnknownTypesEnd) {
  using ::stc::import::networks::result;
  for (const bool twice : {false, true}) {
    std::string body = "<FBD>" + in(0, "strange") + in(9999, "odd");
    for (int i = 1; i <= 2000; ++i) {
      const std::string before = std::to_string(i - 1);
      body += block(i, std::string("typeName=\"") + (i % 2 == 0 ? "ADD" : "MUL") + "\"",
                    pin("In1", wire(before)) + pin("In2", wire(twice ? before : "9999")),
                    result("Out"));
    }
    const Translation translation = translate(body + out(5000, "w", wire("2000")) + "</FBD>");
    ASSERT_FALSE(translation.problems.empty());
    EXPECT_THAT(translation.problems[0].text, HasSubstr("type of what"));
    EXPECT_LT(translation.statements.size(), 20000U);
  }
}

TEST(PlcOpenDiagram, whatCannotBeTakenIsNamed) {
  EXPECT_THAT(translate("<SFC/>").problems, SizeIs(1));
  const Translation action = translate("<FBD><actionBlock localId=\"1\"/></FBD>");
  ASSERT_THAT(action.problems, SizeIs(1));
  EXPECT_THAT(action.problems[0].text, HasSubstr("actionBlock"));
  EXPECT_THAT(translate("<FBD>" + out(4, "m", wire("77")) + "</FBD>").problems, SizeIs(1));
  const Translation open = translate("<FBD>" + out(4, "m", "<connectionPointIn/>") + "</FBD>");
  EXPECT_THAT(open.problems, IsEmpty());
  EXPECT_THAT(open.notes, SizeIs(1));
}

} // namespace
} // namespace stc::import::networks
