// Reading files of TwinCAT 3: one object each, projects, axes.
#include "compiler/import/twincat_reader.hpp"

#include <gtest/gtest.h>

namespace {

using namespace stc::import;

constexpr std::string_view kHead = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
                                   "<TcPlcObject Version=\"1.1.0.1\">\n";

Model read(const std::string &file, std::string_view text) {
  Model model;
  readTwinCat(file, text, model);
  return model;
}

Model readObject(std::string_view inside) {
  return read("POUs/X.TcPOU", std::string(kHead) + std::string(inside) + "</TcPlcObject>\n");
}

TEST(TwinCatReader, PutsABlockTogether) {
  const Model model = readObject(
      "  <POU Name=\"Pump\" Id=\"{1}\" SpecialFunc=\"None\">\n"
      "    <Declaration><![CDATA[// A pump\r\nFUNCTION_BLOCK Pump\nVAR\n  n : INT;\nEND_VAR]]>"
      "</Declaration>\n"
      "    <Implementation><ST><![CDATA[n := n + 1; // last]]></ST></Implementation>\n"
      "    <Folder Name=\"Inner\" Id=\"{2}\" />\n"
      "    <Method Name=\"Reset\" Id=\"{3}\" FolderPath=\"Inner\\\">\n"
      "      <Declaration><![CDATA[METHOD PUBLIC Reset : BOOL\nVAR_INPUT\n  to : INT;\nEND_VAR\n]]>"
      "</Declaration>\n"
      "      <Implementation><ST><![CDATA[n := to;\nReset := TRUE;]]></ST></Implementation>\n"
      "    </Method>\n"
      "    <Property Name=\"Count\" Id=\"{4}\">\n"
      "      <Declaration><![CDATA[PROPERTY Count : INT]]></Declaration>\n"
      "      <Get Name=\"Get\" Id=\"{5}\"><Declaration><![CDATA[VAR\nEND_VAR\n]]></Declaration>\n"
      "        <Implementation><ST><![CDATA[Count := n;]]></ST></Implementation></Get>\n"
      "      <Set Name=\"Set\" Id=\"{6}\"><Declaration><![CDATA[PRIVATE\n]]></Declaration>\n"
      "        <Implementation><ST><![CDATA[n := Count;]]></ST></Implementation></Set>\n"
      "    </Property>\n"
      "    <Action Name=\"Twice\" Id=\"{7}\">\n"
      "      <Implementation><ST><![CDATA[n := n * 2;]]></ST></Implementation>\n"
      "    </Action>\n"
      "    <LineIds Name=\"Pump\"><LineId Id=\"3\" Count=\"0\" /></LineIds>\n"
      "  </POU>\n");
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].name, "Pump");
  EXPECT_EQ(model.objects[0].kind, ObjectKind::Pou);
  EXPECT_EQ(model.objects[0].origin.file, "POUs/X.TcPOU");
  EXPECT_EQ(model.objects[0].origin.line, 3U);
  EXPECT_EQ(model.objects[0].text,
            "// A pump\nFUNCTION_BLOCK Pump\nVAR\n  n : INT;\nEND_VAR\nn := n + 1; // last\n"
            "\nMETHOD PUBLIC Reset : BOOL\nVAR_INPUT\n  to : INT;\nEND_VAR\nn := to;\n"
            "Reset := TRUE;\nEND_METHOD\n"
            "\nPROPERTY Count : INT\nGET VAR\nEND_VAR\nCount := n;\nEND_GET\n"
            "SET PRIVATE\nn := Count;\nEND_SET\nEND_PROPERTY\n"
            "\nACTION Twice\nn := n * 2;\nEND_ACTION\nEND_FUNCTION_BLOCK\n");
  EXPECT_TRUE(model.leftOut.empty()) << model.leftOut[0].text;
}

TEST(TwinCatReader, TakesTypesGlobalsAndInterfaces) {
  const Model model = readObject(
      "<DUT Name=\"E\"><Declaration><![CDATA[TYPE E : (a, b); END_TYPE]]></Declaration></DUT>\n"
      "<GVL Name=\"G\"><Declaration><![CDATA[{attribute 'qualified_only'}\nVAR_GLOBAL\n"
      "  x AT %I* : BOOL;\nEND_VAR\n]]></Declaration></GVL>\n"
      "<Itf Name=\"I\"><Declaration><![CDATA[INTERFACE I EXTENDS J\n]]></Declaration>\n"
      "<Method Name=\"M\"><Declaration><![CDATA[METHOD M : INT]]></Declaration></Method>\n"
      "<Property Name=\"P\"><Declaration><![CDATA[PROPERTY P : INT]]></Declaration>\n"
      "<Get Name=\"Get\"><Declaration><![CDATA[]]></Declaration></Get></Property></Itf>\n");
  ASSERT_EQ(model.objects.size(), 3U);
  EXPECT_EQ(model.objects[0].kind, ObjectKind::Type);
  EXPECT_EQ(model.objects[0].text, "TYPE E : (a, b); END_TYPE\n");
  EXPECT_EQ(model.objects[1].kind, ObjectKind::GlobalList);
  EXPECT_EQ(model.objects[1].name, "G");
  EXPECT_EQ(model.objects[2].text, "INTERFACE I EXTENDS J\n\nMETHOD M : INT\nEND_METHOD\n"
                                   "\nPROPERTY P : INT\nGET \nEND_GET\nEND_PROPERTY\n"
                                   "END_INTERFACE\n");
}

TEST(TwinCatReader, KeepsTheDeclarationOfADrawnBody) {
  const Model model =
      readObject("<POU Name=\"Net\">\n"
                 "<Declaration><![CDATA[PROGRAM Net\nVAR\nEND_VAR]]></Declaration>\n"
                 "<Implementation>\n"
                 "<NWL><XmlArchive /></NWL></Implementation>\n"
                 "<Transition Name=\"T1\" />\n"
                 "</POU>\n");
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].text,
            "PROGRAM Net\nVAR\nEND_VAR\n{error 'body not imported: X:8: a network list (LD, FBD or "
            "IL)'}\nEND_PROGRAM\n");
  ASSERT_EQ(model.leftOut.size(), 2U);
  EXPECT_EQ(model.leftOut[0].object, "Net");
  EXPECT_EQ(model.leftOut[0].origin.line, 8U);
  EXPECT_EQ(model.leftOut[1].object, "Transition Net.T1");
}

TEST(TwinCatReader, NamesWhatItDoesNotTake) {
  const Model model = readObject("<Visualization Name=\"Screen\" />\n"
                                 "<POU Name=\"Odd\"><Declaration>x : INT;</Declaration></POU>\n"
                                 "<GVL Name=\"None\" />\n");
  EXPECT_TRUE(model.objects.empty());
  ASSERT_EQ(model.leftOut.size(), 3U);
  EXPECT_EQ(model.leftOut[0].object, "Visualization Screen");
  EXPECT_EQ(model.leftOut[1].object, "Odd");
  EXPECT_EQ(model.leftOut[2].object, "global variables None");
}

TEST(TwinCatReader, ReportsLinksToHardware) {
  const Model model = readObject("<GVL Name=\"G\">\n"
                                 "<Declaration><![CDATA[VAR_GLOBAL\n"
                                 "  {attribute 'TcLinkTo' := 'TIIB[Term 4]^Value'}\n"
                                 "  x AT %I* : INT;\nEND_VAR]]></Declaration></GVL>");
  ASSERT_EQ(model.leftOut.size(), 1U);
  EXPECT_EQ(model.leftOut[0].origin.line, 5U);
  EXPECT_NE(model.leftOut[0].text.find("Term 4"), std::string::npos);
}

TEST(TwinCatReader, ReadsATask) {
  const Model model = readObject(
      "<Task Name=\"Plc Task\"><!--CycleTime in micro seconds.--><CycleTime>2500</CycleTime>"
      "<Priority>20</Priority><PouCall><Name>MAIN</Name></PouCall>"
      "<PouCall><Name>Watch</Name></PouCall></Task>");
  ASSERT_EQ(model.tasks.size(), 1U);
  EXPECT_EQ(model.tasks[0].name, "Plc_Task");
  EXPECT_EQ(model.tasks[0].interval, "T#2500us");
  EXPECT_EQ(model.tasks[0].priority, "20");
  EXPECT_EQ(model.tasks[0].programs, (std::vector<std::string>{"MAIN", "Watch"}));
  EXPECT_EQ(readObject("<Task Name=\"T\"><CycleTime>0</CycleTime></Task>").leftOut.size(), 1U);
}

TEST(TwinCatReader, FollowsAProject) {
  const Model model =
      read("Plc/Plc.plcproj",
           "<Project xmlns=\"http://schemas.microsoft.com/developer/msbuild/2003\">\n<ItemGroup>\n"
           "<Compile Include=\"POUs\\MAIN.TcPOU\"><SubType>Code</SubType></Compile>\n"
           "<Compile Include=\"Old.TcPOU\"><ExcludeFromBuild>true</ExcludeFromBuild></Compile>\n"
           "<PlaceholderReference Include=\"Tc2_MC2\"><DefaultResolution>Tc2_MC2, * (Beckhoff)"
           "</DefaultResolution></PlaceholderReference>\n"
           "<LibraryReference Include=\"TcUnit,1.3.0.1,www.tcunit.org\" />\n"
           "</ItemGroup></Project>\n");
  ASSERT_EQ(model.references.size(), 1U);
  EXPECT_EQ(model.references[0].path, "POUs/MAIN.TcPOU");
  EXPECT_EQ(model.references[0].origin.line, 3U);
  ASSERT_EQ(model.libraries.size(), 2U);
  EXPECT_EQ(model.libraries[0].name, "Tc2_MC2");
  EXPECT_EQ(model.libraries[0].version, "*");
  EXPECT_EQ(model.libraries[1].name, "TcUnit");
  EXPECT_EQ(model.libraries[1].version, "1.3.0.1");
  ASSERT_EQ(model.leftOut.size(), 1U);
  EXPECT_EQ(model.leftOut[0].object, "Old.TcPOU");
}

constexpr std::string_view kAxis =
    "<TcSmItem ClassName=\"CNcAxisDef\">\n"
    "<Axis Id=\"7\" AxisType=\"1\"><Name>Feed 1</Name>\n"
    "<AxisPara><Dynamic AccelerationMaximum=\"1500\" DecelerationMaximum=\"3e3\"/>"
    "<Velo Maximum=\"250.5\"/></AxisPara>\n"
    "<Encoder Name=\"Enc\" EncType=\"7\"><EncPara ScaleFactorNumerator=\"0.00025\">"
    "<SoftEndMinControl Enable=\"true\" Range=\"-4\"/>"
    "<SoftEndMaxControl Enable=\"true\" Range=\"510.25\"/></EncPara></Encoder>\n"
    "</Axis></TcSmItem>\n";

std::string valueOf(const DriveSetup &drive, std::string_view key) {
  for (const Parameter &each : drive.parameters)
    if (each.key == key)
      return (each.certainty == Certainty::Sure      ? "sure "
              : each.certainty == Certainty::Guessed ? "guessed "
                                                     : "missing ") +
             each.value;
  return "none";
}

TEST(TwinCatReader, MakesADriveOfAnAxis) {
  const Model model = read("NC/Feed 1.xti", kAxis);
  ASSERT_EQ(model.buses.size(), 1U);
  ASSERT_EQ(model.buses[0].groups.size(), 1U);
  ASSERT_EQ(model.buses[0].groups[0].drives.size(), 1U);
  const DriveSetup &drive = model.buses[0].groups[0].drives[0];
  EXPECT_EQ(drive.name, "Feed_1");
  EXPECT_EQ(drive.origin.line, 2U);
  EXPECT_EQ(valueOf(drive, "wDriveId"), "guessed 1");
  EXPECT_EQ(valueOf(drive, "dwRatioTechUnitsDenom"), "sure 4000");
  EXPECT_EQ(valueOf(drive, "iRatioTechUnitsNum"), "sure 1");
  EXPECT_EQ(valueOf(drive, "bSWLimitEnable"), "sure true");
  EXPECT_EQ(valueOf(drive, "fSWLimitNegative"), "sure -4.0");
  EXPECT_EQ(valueOf(drive, "fSWLimitPositive"), "sure 510.25");
  EXPECT_EQ(valueOf(drive, "fSWMaxVelocity"), "sure 250.5");
  EXPECT_EQ(valueOf(drive, "fSWMaxAcceleration"), "sure 1500.0");
  EXPECT_EQ(valueOf(drive, "fSWMaxDeceleration"), "sure 3000.0");
  ASSERT_EQ(model.changed.size(), 1U);
}

TEST(TwinCatReader, NeverTakesAnAxisTwice) {
  Model model;
  readTwinCat("a.xti", kAxis, model);
  readTwinCat("b.xti", kAxis, model);
  EXPECT_EQ(model.buses[0].groups[0].drives.size(), 1U);
  EXPECT_EQ(model.leftOut.size(), 1U);
}

TEST(TwinCatReader, MarksAScalingThatTheFileDoesNotGive) {
  for (const char *factor :
       {"", "ScaleFactorNumerator='0.0001234567891'", //
        "ScaleFactorNumerator='x'", "ScaleFactorNumerator='-1'", "ScaleFactorNumerator='40000'"}) {
    const Model model =
        read("Y.xti", "<TcSmItem><Axis><Name>__FILENAME__</Name><Encoder><EncPara " +
                          std::string(factor) + "/></Encoder></Axis></TcSmItem>");
    const DriveSetup &drive = model.buses.at(0).groups.at(0).drives.at(0);
    EXPECT_EQ(drive.name, "Y");
    EXPECT_EQ(valueOf(drive, "dwRatioTechUnitsDenom"), "missing 10000") << factor;
  }
}

TEST(TwinCatReader, ReportsOneSoftwareLimitAlone) {
  const Model model =
      read("Y.xti",
           "<TcSmItem><Axis><Name>Y</Name><Encoder><EncPara ScaleFactorNumerator='1'>"
           "<SoftEndMinControl Enable='true' Range='4'/></EncPara></Encoder></Axis></TcSmItem>");
  const DriveSetup &drive = model.buses.at(0).groups.at(0).drives.at(0);
  EXPECT_EQ(valueOf(drive, "bSWLimitEnable"), "none");
  EXPECT_EQ(valueOf(drive, "dwRatioTechUnitsDenom"), "sure 1");
  EXPECT_EQ(model.leftOut.size(), 1U);
}

TEST(TwinCatReader, FindsAxesAndTheirVariablesInASystemProject) {
  const Model model = read(
      "S.tsproj",
      "<TcSmProject><Project><Motion><NC File=\"NC.xti\"><Axis File=\"A.xti\" Id=\"1\"/>"
      "<Axis Id=\"2\"><Name>B</Name></Axis></NC></Motion>\n"
      "<Plc><Project PrjFilePath=\"Plc\\Plc.plcproj\"/><Project "
      "File=\"Lib.xti\"/></Plc></Project>\n"
      "<Mappings><OwnerA Name=\"TIPC^Plc^Plc Instance\"><OwnerB Name=\"TINC^NC-Task 1 SAF^Axes^B\">"
      "<Link VarA=\"PlcTask Inputs^MAIN.axis.NcToPlc\" VarB=\"Outputs^ToPlc\"/>"
      "<Link VarA=\"PlcTask Outputs^MAIN.axis.PlcToNc\" VarB=\"Inputs^FromPlc\"/></OwnerB>"
      "<OwnerB Name=\"TIID^Device\"><Link VarA=\"PlcTask Inputs^MAIN.x.NcToPlc\" "
      "VarB=\"Outputs^ToPlc\"/></OwnerB></OwnerA></Mappings></TcSmProject>\n");
  std::vector<std::string> paths;
  for (const FileReference &each : model.references)
    paths.push_back(each.path);
  EXPECT_EQ(paths, (std::vector<std::string>{"_Config/NC/NC.xti", "_Config/NC/Axes/A.xti",
                                             "Plc/Plc.plcproj", "_Config/PLC/Lib.xti"}));
  ASSERT_EQ(model.buses.size(), 1U);
  EXPECT_EQ(model.buses[0].groups[0].drives[0].name, "B");
  ASSERT_EQ(model.axisLinks.size(), 1U);
  EXPECT_EQ(model.axisLinks[0].variable, "MAIN.axis");
  EXPECT_EQ(model.axisLinks[0].drive, "B");
}

TEST(TwinCatReader, RefusesWhatItCannotRead) {
  EXPECT_EQ(read("a", "<TcPlcObject><POU>").unreadable.size(), 1U);
  EXPECT_EQ(read("a", "<html/>").unreadable.size(), 1U);
  EXPECT_EQ(read("a", "").unreadable.size(), 1U);
}

TEST(TwinCatReader, KnowsItsFiles) {
  EXPECT_TRUE(isTwinCat("<TcPlcObject Version='1'>"));
  EXPECT_TRUE(isTwinCat("<?xml?>\n<TcSmItem/>"));
  EXPECT_TRUE(isTwinCat("<Project xmlns='http://schemas.microsoft.com/developer/msbuild/2003'>"
                        "<Compile Include='A.TcPOU'/>"));
  EXPECT_FALSE(isTwinCat("<Project xmlns='http://schemas.microsoft.com/developer/msbuild/2003'>"));
  EXPECT_FALSE(isTwinCat("PROGRAM x"));
}

} // namespace
