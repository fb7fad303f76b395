// PLCopen XML: what becomes of types, POUs, tasks, and of what is not known.
#include "compiler/import/drawn_bodies.hpp"
#include "compiler/import/names.hpp"
#include "compiler/import/plcopen_reader.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace {

using stc::import::Model;
using stc::import::Object;
using stc::import::ObjectKind;
using stc::import::readPlcOpen;
using stc::import::Remark;

Model read(const std::string &text) {
  Model model;
  readPlcOpen("line.xml", text, model);
  return model;
}

std::string project(const std::string &types, const std::string &pous,
                    const std::string &instances = {}, const std::string &rest = {}) {
  return fmt::format("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
                     "<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\">\n"
                     "<fileHeader companyName=\"\" productName=\"\" productVersion=\"\"/>\n"
                     "<contentHeader name=\"Line\"><coordinateInfo/></contentHeader>\n"
                     "<types><dataTypes>{}</dataTypes><pous>{}</pous></types>\n"
                     "<instances><configurations>{}</configurations></instances>\n{}\n</project>\n",
                     types, pous, instances, rest);
}

std::string textOf(const Model &model, const std::string &name) {
  for (const Object &each : model.objects)
    if (each.name == name)
      return each.text;
  return "there is no " + name;
}

std::string remarks(const std::vector<Remark> &all) {
  std::string text;
  for (const Remark &each : all)
    text += fmt::format("{}: {}: {}\n", each.origin.line, each.object, each.text);
  return text;
}

std::string body(const std::string &text) {
  return "<body><ST><xhtml xmlns=\"http://www.w3.org/1999/xhtml\">" + text + "</xhtml></ST></body>";
}

std::string data(const std::string &content) {
  return "<addData><data name=\"http://www.3s-software.com/plcopenxml/x\" "
         "handleUnknown=\"implementation\">" +
         content + "</data></addData>";
}

TEST(PlcOpen, ReadsTypesOfAllKinds) {
  const Model model = read(project(
      "<dataType name=\"Mode\"><baseType><enum><values><value name=\"idle\"/>"
      "<value name=\"run\" value=\"5\"/></values><baseType><USINT/></baseType></enum></baseType>"
      "<initialValue><simpleValue value=\"run\"/></initialValue></dataType>"
      "<dataType name=\"Part\"><baseType><struct><variable name=\"id\"><type><DINT/></type>"
      "<initialValue><simpleValue value=\"-7\"/></initialValue></variable>"
      "<variable name=\"text\"><type><wstring "
      "length=\"9\"/></type></variable></struct></baseType>" +
          data("<Inheritance><Extends>Base</Extends></Inheritance>") +
          "</dataType>"
          "<dataType name=\"Percent\"><baseType><subrangeUnsigned><range lower=\"0\" "
          "upper=\"100\"/><baseType><UINT/></baseType></subrangeUnsigned></baseType></dataType>"
          "<dataType name=\"Grid\"><baseType><array><dimension lower=\"-1\" upper=\"2\"/>"
          "<dimension lower=\"1\" upper=\"3\"/><baseType><pointer><baseType><derived "
          "name=\"Part\"/></baseType></pointer></baseType></array></baseType></dataType>"
          "<dataType name=\"Name\"><baseType><string/></baseType><initialValue><simpleValue "
          "value=\"it's\"/></initialValue></dataType>",
      ""));
  EXPECT_EQ(textOf(model, "Mode"),
            "TYPE Mode :\n(\n  idle,\n  run := 5\n) USINT := run;\nEND_TYPE\n");
  EXPECT_EQ(textOf(model, "Part"), "TYPE Part EXTENDS Base :\nSTRUCT\n  id : DINT := -7;\n"
                                   "  text : WSTRING(9);\nEND_STRUCT\nEND_TYPE\n");
  EXPECT_EQ(textOf(model, "Percent"), "TYPE Percent :\nUINT (0..100);\nEND_TYPE\n");
  EXPECT_EQ(textOf(model, "Grid"),
            "TYPE Grid :\nARRAY[-1..2, 1..3] OF POINTER TO Part;\nEND_TYPE\n");
  EXPECT_EQ(textOf(model, "Name"), "TYPE Name :\nSTRING := 'it$'s';\nEND_TYPE\n");
  EXPECT_EQ(remarks(model.leftOut), "");
  EXPECT_EQ(model.objects.front().kind, ObjectKind::Type);
  EXPECT_EQ(model.objects.front().origin.line, 5U);
}

TEST(PlcOpen, ReadsVariablesInTheirOrder) {
  const Model model = read(project(
      "", "<pou name=\"Mixer\" pouType=\"functionBlock\"><interface>"
          "<inputVars><variable name=\"go\"><type><BOOL/></type><documentation><xhtml>Start\n of "
          "all</xhtml></documentation></variable></inputVars>"
          "<localVars constant=\"true\"><variable name=\"n\"><type><INT/></type><initialValue>"
          "<simpleValue value=\"3\"/></initialValue></variable></localVars>"
          "<outputVars retain=\"true\"><variable name=\"q\" address=\"%QX0.3\"><type><BOOL/></type>"
          "</variable></outputVars><inOutVars/>"
          "<localVars persistent=\"true\" retain=\"true\"><variable name=\"a\"><type><array>"
          "<dimension lower=\"1\" upper=\"4\"/><baseType><INT/></baseType></array></type>"
          "<initialValue><arrayValue><value><simpleValue value=\"2\"/></value>"
          "<value repetitionValue=\"3\"><simpleValue value=\"5\"/></value></arrayValue>"
          "</initialValue></variable><variable name=\"p\"><type><derived name=\"Part\"/></type>"
          "<initialValue><structValue><value member=\"id\"><simpleValue value=\"1\"/></value>"
          "</structValue></initialValue>" +
              data("<Attributes><Attribute Name=\"hide\" Value=\"\"/></Attributes>") +
              "</variable></localVars></interface>" + body("q := go;") + "</pou>"));
  EXPECT_EQ(textOf(model, "Mixer"),
            "FUNCTION_BLOCK Mixer\n"
            "VAR_INPUT\n  /// Start\n  /// of all\n  go : BOOL;\nEND_VAR\n"
            "VAR CONSTANT\n  n : INT := 3;\nEND_VAR\n"
            "VAR_OUTPUT RETAIN\n  q AT %QX0.3 : BOOL;\nEND_VAR\n"
            "VAR RETAIN PERSISTENT\n  a : ARRAY[1..4] OF INT := [2, 3(5)];\n"
            "  {attribute 'hide'}\n  p : Part := (id := 1);\nEND_VAR\n"
            "\nq := go;\nEND_FUNCTION_BLOCK\n");
  EXPECT_EQ(remarks(model.leftOut), "");
}

TEST(PlcOpen, ReadsWhatCodesysAddsToABlock) {
  const std::string method =
      "<Method name=\"Add\"><interface><returnType><INT/></returnType><inputVars>"
      "<variable name=\"by\"><type><INT/></type></variable></inputVars>" +
      data("<AccessModifiers Protected=\"true\" Final=\"true\"/>") + "</interface>" +
      body("Add := by;") + "</Method>";
  const std::string property =
      "<Property name=\"Sum\"><interface><returnType><DINT/></returnType></interface>"
      "<GetAccessor><interface/>" +
      body("Sum := total;") + "</GetAccessor></Property>";
  const Model model = read(project(
      "", "<pou name=\"Counter\" pouType=\"functionBlock\"><interface>" +
              data("<Inheritance><Extends>Base</Extends><Implements>ICount</Implements>"
                   "<Implements>IShow</Implements></Inheritance>") +
              "</interface><actions><action name=\"Clear\">" + body("total := 0;") +
              "</action></actions>" + body("Add(1);") + data(method) + data(property) + "</pou>"));
  EXPECT_EQ(textOf(model, "Counter"),
            "FUNCTION_BLOCK Counter EXTENDS Base IMPLEMENTS ICount, IShow\n\nAdd(1);\n"
            "\nACTION Clear:\ntotal := 0;\nEND_ACTION\n"
            "\nMETHOD PROTECTED FINAL Add : INT\nVAR_INPUT\n  by : INT;\nEND_VAR\nAdd := by;\n"
            "END_METHOD\n"
            "\nPROPERTY Sum : DINT\nGET\nSum := total;\nEND_GET\nEND_PROPERTY\n"
            "END_FUNCTION_BLOCK\n");
  EXPECT_EQ(remarks(model.leftOut), "");
}

TEST(PlcOpen, PrefersTheDeclarationAsItWasWritten) {
  const Model model = read(project(
      "", "<pou name=\"F\" pouType=\"function\"><interface><returnType><INT/></returnType>"
          "</interface>" +
              body("F := a; // done") +
              data("<InterfaceAsPlainText><xhtml>FUNCTION F : INT // kept\nVAR_INPUT a : INT; "
                   "END_VAR\n</xhtml></InterfaceAsPlainText>") +
              "</pou>"));
  EXPECT_EQ(textOf(model, "F"), "FUNCTION F : INT // kept\nVAR_INPUT a : INT; END_VAR\n\n"
                                "F := a; // done\nEND_FUNCTION\n");
}

TEST(PlcOpen, ReadsTasksOfCodesys) {
  const Model model = read(project(
      "", "",
      "<configuration name=\"Plc\"><resource name=\"App\">"
      "<task name=\"Fast\" interval=\"PT0.0025S\" priority=\"3\"><pouInstance name=\"PRG_A\" "
      "typeName=\"\"/>" +
          data("<TaskSettings KindOfTask=\"Cyclic\" Interval=\"2500\" IntervalUnit=\"us\">"
               "<Watchdog Enabled=\"true\" Time=\"t#7ms\" TimeUnit=\"ms\"/></TaskSettings>") +
          "</task><task name=\"Idle\" priority=\"99\"><pouInstance name=\"PRG_B\" typeName=\"\"/>" +
          data("<TaskSettings KindOfTask=\"Freewheeling\" Interval=\"20\" IntervalUnit=\"ms\"/>") +
          "</task></resource></configuration>"));
  ASSERT_EQ(model.tasks.size(), 2U);
  EXPECT_EQ(model.tasks[0].interval, "LT#2500us");
  EXPECT_EQ(model.tasks[0].priority, "3");
  EXPECT_EQ(model.tasks[0].watchdog, "t#7ms");
  EXPECT_EQ(model.tasks[0].programs, std::vector<std::string>{"PRG_A"});
  EXPECT_EQ(model.tasks[1].interval, "");
  EXPECT_EQ(model.tasks[1].priority, "31");
  EXPECT_EQ(remarks(model.changed), "6: task Idle: its priority 99 became 31, the lowest\n");
}

std::string task(const std::string &attributes, const std::string &settings,
                 const std::string &watchdog = {}) {
  return fmt::format("<task {} priority=\"2\"><pouInstance name=\"P\" typeName=\"\"/>{}</task>",
                     attributes,
                     data(fmt::format("<TaskSettings {}>{}</TaskSettings>", settings, watchdog)));
}

std::string plant(const std::string &tasks) {
  return "<configuration name=\"Plc\"><resource name=\"App\">" + tasks +
         "</resource></configuration>";
}

TEST(PlcOpen, ReadsWhatStartsATask) {
  const auto watchdog = [](const std::string &sensitivity) {
    return fmt::format(
        "<Watchdog Enabled=\"true\" Time=\"8000\" TimeUnit=\"us\" Sensitivity=\"{}\"/>",
        sensitivity);
  };
  const Model model = read(project(
      "", "",
      plant(task("name=\"Single\" single=\"GVL.go\"", "KindOfTask=\"Event\"", watchdog("0")) +
            task("name=\"Both\" single=\"GVL.go\"", "KindOfTask=\"Event\" Event=\"GVL.other\"",
                 watchdog("1000")) +
            task("name=\"While\"", "KindOfTask=\"Status\" Event=\"GVL.on\"", watchdog("1001")) +
            task("name=\"None\"", "KindOfTask=\"Status\"", watchdog("often")))));
  ASSERT_EQ(model.tasks.size(), 4U);
  EXPECT_EQ(model.tasks[0].event, "GVL.go");
  EXPECT_FALSE(model.tasks[0].status);
  EXPECT_EQ(model.tasks[0].watchdogSensitivity, 1U);
  EXPECT_EQ(model.tasks[1].event, "GVL.other");
  EXPECT_EQ(model.tasks[1].watchdogSensitivity, 1000U);
  EXPECT_EQ(model.tasks[2].event, "GVL.on");
  EXPECT_TRUE(model.tasks[2].status);
  EXPECT_EQ(model.tasks[2].watchdogSensitivity, 1000U);
  EXPECT_EQ(remarks(model.changed),
            "6: task While: the sensitivity 1001 of its watchdog became 1000, the highest\n");
  EXPECT_EQ(remarks(model.leftOut),
            "6: task None: it is of the kind Status; give it an `interval` or an `event` in "
            "stride.toml\n"
            "6: task None: the sensitivity `often` of its watchdog is no number\n");
}

TEST(PlcOpen, SaysWhatAConfigurationCannotSayOfATask) {
  std::string tasks = task("name=\"While\"", "KindOfTask=\"Status\" Event=\"on\"",
                           "<Watchdog Enabled=\"true\" Time=\"7\" TimeUnit=\"ms\" "
                           "Sensitivity=\"3\"/>");
  tasks.replace(tasks.find("typeName=\"\""), 11, "typeName=\"Q\"");
  EXPECT_EQ(remarks(read(project("", "", plant(tasks))).leftOut),
            "6: task While: its watchdog of T#7ms: add [[task]] with `name` and `watchdog` and "
            "`watchdog_sensitivity = 3` to stride.toml\n"
            "6: task While: it runs while `on` is TRUE (Status); SINGLE of a CONFIGURATION starts "
            "it at a rising edge\n");
}

TEST(PlcOpen, QuotesTextsOfAttributes) {
  const Model model = read(
      project("", "<pou name=\"P\" pouType=\"program\"><interface>" +
                      data("<Attributes><Attribute Name=\"a\" Value=\"5$ 'x'\"/></Attributes>") +
                      "</interface>" + body("x;") + "</pou>"));
  EXPECT_EQ(textOf(model, "P"), "{attribute 'a' := '5$$ $'x$''}\nPROGRAM P\n\nx;\nEND_PROGRAM\n");
}

/// Files of one name in two folders declare different things.
TEST(PlcOpen, KeepsWholeFilesOfOneName) {
  Model model = read(
      project("", "<pou name=\"Line\" pouType=\"program\"><interface/>" + body("x;") + "</pou>", "",
              data("<Source name=\"Line\">PROGRAM A\nEND_PROGRAM</Source>") +
                  data("<Source name=\"Line\">PROGRAM B\nEND_PROGRAM</Source>") +
                  data("<Source name=\"Line\">PROGRAM A\nEND_PROGRAM</Source>")));
  stc::import::takeOnce(model);
  ASSERT_EQ(model.objects.size(), 3U);
  EXPECT_EQ(model.objects[1].text, "PROGRAM A\nEND_PROGRAM\n");
  EXPECT_EQ(model.objects[2].text, "PROGRAM B\nEND_PROGRAM\n");
  EXPECT_EQ(remarks(model.leftOut), "");
  ASSERT_EQ(model.changed.size(), 1U);
  EXPECT_EQ(model.changed[0].object, "source file Line");
}

TEST(PlcOpen, MakesAConfigurationOfInstances) {
  const Model model = read(
      project("", "",
              "<configuration name=\"Plant\"><resource name=\"Res\">"
              "<task name=\"T1\" interval=\"T#20ms\" priority=\"0\"><pouInstance name=\"left\" "
              "typeName=\"Drive\"/><pouInstance name=\"right\" typeName=\"Drive\"/></task>"
              "<task name=\"T2\" single=\"start\" priority=\"4\"/>"
              "<globalVars><variable name=\"start\"><type><BOOL/></type></variable></globalVars>"
              "<pouInstance name=\"rest\" typeName=\"Other\"/></resource>"
              "<accessVars><accessVariable alias=\"seen\" instancePathAndName=\"Res.left.x\" "
              "direction=\"readOnly\"><type><INT/></type></accessVariable></accessVars>"
              "</configuration>"));
  EXPECT_EQ(textOf(model, "Plant"),
            "CONFIGURATION Plant\n  RESOURCE Res ON PLC\n"
            "    TASK T1(INTERVAL := T#20ms, PRIORITY := 0);\n"
            "    TASK T2(SINGLE := start, PRIORITY := 4);\n"
            "    PROGRAM left WITH T1 : Drive;\n    PROGRAM right WITH T1 : Drive;\n"
            "    PROGRAM rest : Other;\n  END_RESOURCE\n"
            "  VAR_ACCESS\n    seen : Res.left.x : INT READ_ONLY;\n  END_VAR\n"
            "END_CONFIGURATION\n");
  EXPECT_EQ(textOf(model, "Global_Variables"), "VAR_GLOBAL\n  start : BOOL;\nEND_VAR\n");
  EXPECT_TRUE(model.tasks.empty());
}

TEST(PlcOpen, MakesDrivesOfTheDeviceTree) {
  const auto device = [](const std::string &name, const std::string &parameters) {
    return fmt::format("<configuration name=\"{}\"><addData><data name=\"Device\" "
                       "handleUnknown=\"discard\"><Device><DeviceType><Connector>"
                       "<HostParameterSet>{}</HostParameterSet></Connector></DeviceType></Device>"
                       "</data></addData></configuration>",
                       name, parameters);
  };
  const auto parameter = [](const std::string &name, const std::string &value) {
    return fmt::format("<Parameter><Value>{}</Value><Name>{}</Name></Parameter>", value, name);
  };
  const Model model = read(project(
      "", "",
      device("Lift", parameter("dwRatioTechUnitsDenom", "160") + parameter("fSWMaxJerk", "8.5e3") +
                         parameter("fSWMaxVelocity", "fast") + parameter("Colour", "3")) +
          device("Coupler", parameter("Modulecode", "16#8401")) + device("Empty", "") +
          device("Belt", parameter("IRATIOTECHUNITSNUM", "007") +
                             parameter("fSWMaxVelocity", ".25") + parameter("fSWMaxJerk", "inf") +
                             parameter("fSWMaxAcceleration", "1e300")) +
          plant(task("name=\"Fa&quot;st\"", "KindOfTask=\"Cyclic\" Interval=\"4\"") +
                task("name=\"Slow\"", "KindOfTask=\"Cyclic\" Interval=\"40\""))));
  ASSERT_EQ(model.buses.size(), 1U);
  ASSERT_EQ(model.buses[0].groups.size(), 1U);
  const auto &drives = model.buses[0].groups[0].drives;
  ASSERT_EQ(drives.size(), 2U);
  EXPECT_EQ(drives[0].name, "Lift");
  ASSERT_EQ(drives[0].parameters.size(), 3U);
  EXPECT_EQ(drives[0].parameters[1].key, "dwRatioTechUnitsDenom");
  EXPECT_EQ(drives[0].parameters[1].value, "160");
  EXPECT_EQ(drives[0].parameters[2].value, "8500");
  EXPECT_EQ(drives[1].parameters[0].value, "2"); // wDriveId
  ASSERT_EQ(drives[1].parameters.size(), 4U);
  EXPECT_EQ(drives[1].parameters[1].key, "iRatioTechUnitsNum");
  EXPECT_EQ(drives[1].parameters[1].value, "7");
  EXPECT_EQ(drives[1].parameters[2].value, "0.25");
  EXPECT_EQ(drives[1].parameters[3].value, "1e+300");
  ASSERT_EQ(model.buses[0].groups[0].parameters.size(), 1U);
  EXPECT_EQ(model.buses[0].groups[0].parameters[0].value, "\"Fa\\\"st\"");
  EXPECT_EQ(remarks(model.leftOut),
            "6: drive Lift: its other parameters (2)\n"
            "6: device Coupler: its parameters (1): hardware is configured in stride.toml\n"
            "6: drive Belt: its other parameters (1)\n");
}

TEST(PlcOpen, KeepsBlocksOfAListApart) {
  const Model model = read(project(
      "", "",
      "<configuration name=\"Plc\"><resource name=\"App\"><globalVars name=\"GVL\" "
      "constant=\"true\"><variable name=\"kMax\"><type><INT/></type></variable>"
      "<addData><data name=\"a\" handleUnknown=\"implementation\"><Attributes><Attribute "
      "Name=\"qualified_only\" Value=\"\"/></Attributes></data>"
      "<data name=\"b\" handleUnknown=\"implementation\"><MixedAttrsVarList>"
      "<globalVars name=\"GVL\"><variable name=\"x\"><type><REAL/></type></variable></globalVars>"
      "<globalVars name=\"GVL\" constant=\"true\"><variable name=\"KMAX\"><type><INT/></type>"
      "</variable></globalVars></MixedAttrsVarList></data></addData></globalVars></resource>"
      "</configuration>"));
  EXPECT_EQ(textOf(model, "GVL"),
            "{attribute 'qualified_only'}\nVAR_GLOBAL\n  x : REAL;\nEND_VAR\n\n"
            "{attribute 'qualified_only'}\nVAR_GLOBAL CONSTANT\n  KMAX : INT;\nEND_VAR\n");
}

TEST(PlcOpen, SaysWhatItDoesNotKnow) {
  const Model model = read(project(
      "<dataType name=\"no name\"><baseType><INT/></baseType></dataType>",
      "<pou name=\"P\" pouType=\"program\"><interface/>\n<colour/><colour/>" + body("x;") +
          "\n<addData><data name=\"http://vendor/page\" handleUnknown=\"discard\"><Page/></data>"
          "</addData></pou>\n<pou name=\"Q\" pouType=\"program\"><interface/><body><FBD/></body>"
          "</pou>"));
  EXPECT_EQ(remarks(model.leftOut),
            "5: type `no name`: its name is no identifier\n"
            "6: element colour in pou: its meaning is not known here (2 in this file)\n"
            "7: addData http://vendor/page of pou: its meaning is not known here\n");
}

TEST(PlcOpen, GivesDrawnBodiesToTheTranslation) {
  Model model = read(project(
      "", "<pou name=\"Q\" pouType=\"program\"><interface><localVars>"
          "<variable name=\"a\"><type><INT/></type></variable>"
          "<variable name=\"b\"><type><INT/></type></variable></localVars></interface>"
          "<body><FBD><inVariable localId=\"1\"><expression>a</expression></inVariable>"
          "<outVariable localId=\"2\"><connectionPointIn><connection refLocalId=\"1\"/>"
          "</connectionPointIn><expression>b</expression></outVariable></FBD></body></pou>"));
  ASSERT_EQ(model.drawn.size(), 1U);
  stc::import::translateDrawnBodies(model, {});
  EXPECT_EQ(textOf(model, "Q"), "PROGRAM Q\nVAR\n  a : INT;\n  b : INT;\nEND_VAR\n\nb := a;\n"
                                "END_PROGRAM\n");
  EXPECT_EQ(remarks(model.leftOut), "");
}

TEST(PlcOpen, RefusesWhatIsNoProject) {
  const Model broken = read("<project>\n<types>\n</project>\n");
  ASSERT_EQ(broken.unreadable.size(), 1U);
  EXPECT_EQ(broken.unreadable.front().origin.line, 3U);
  const Model other = read("<?xml version='1.0'?>\n<html/>\n");
  ASSERT_EQ(other.unreadable.size(), 1U);
  EXPECT_EQ(other.unreadable.front().origin.line, 2U);
  EXPECT_TRUE(other.objects.empty());
}

TEST(PlcOpen, KnowsItsNamespaces) {
  for (const char *name : {"tc6.xsd", "tc6_0200", "tc6_0201"})
    EXPECT_TRUE(stc::import::isPlcOpen(
        fmt::format("<project xmlns=\"http://www.plcopen.org/xml/{}\">", name)));
  EXPECT_FALSE(stc::import::isPlcOpen("<project xmlns=\"http://maven.apache.org/POM/4.0.0\"/>"));
}

} // namespace
