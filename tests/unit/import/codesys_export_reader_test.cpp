// Reading exports of CODESYS V3: objects by type, parts by GUID, texts in both forms.
#include "compiler/import/codesys_export_reader.hpp"

#include <gtest/gtest.h>

namespace {

using namespace stc::import;

constexpr std::string_view kPou = "6f9dac99-8de1-4efc-8465-68ac443b7d08";
constexpr std::string_view kMethod = "f8a58466-d7f6-439f-bbb8-d4600e41d099";
constexpr std::string_view kProperty = "5a3b8626-d3e9-4f37-98b5-66420063d91e";
constexpr std::string_view kAccessor = "792f2eb6-721e-4e64-ba20-bc98351056db";
constexpr std::string_view kAction = "8ac092e5-3128-4e26-9e7e-11016c6684f2";
constexpr std::string_view kFolder = "738bea1e-99bb-4f04-90bb-a7a567e74e3a";
constexpr std::string_view kGlobals = "ffbfa93a-b94d-45fc-a329-229860183b1d";
constexpr std::string_view kTask = "98a2708a-9b18-4f31-82ed-a1465b24fa2d";

std::string single(std::string_view name, std::string_view inside) {
  return "<Single Name=\"" + std::string(name) + "\">" + std::string(inside) + "</Single>";
}

std::string blob(std::string_view section, std::string_view text) {
  return single(section, single("TextDocument", single("TextBlobForSerialisation", text)));
}

std::string lines(std::string_view section, const std::vector<std::string> &text) {
  std::string inside = "<Array Name=\"TextLines\">";
  for (const std::string &each : text)
    inside += "<Single>" + single("Id", "7") + single("Text", each) + "</Single>";
  return single(section, single("TextDocument", inside + "</Array>"));
}

std::string entry(std::string_view guid, std::string_view parent, std::string_view name,
                  std::string_view type, std::string_view object) {
  return "<Single>" +
         single("MetaObject", single("Guid", guid) + single("ParentGuid", parent) +
                                  single("Name", name) + single("TypeGuid", type)) +
         single("Object", object) + "</Single>\n";
}

Model read(std::string_view entries) {
  Model model;
  readCodesysExport("x.export",
                    "<ExportFile>\n<StructuredView Guid=\"{1}\">\n<Single><List2 "
                    "Name=\"EntryList\">\n" +
                        std::string(entries) + "</List2></Single></StructuredView></ExportFile>\n",
                    model);
  return model;
}

TEST(CodesysExportReader, PutsPartsIntoTheirBlock) {
  const Model model = read(
      entry("3", "2", "Get", kAccessor, blob("Interface", "") + blob("Implementation", "P := n;")) +
      entry("F", "0", "Motion / 1", kFolder, "") +
      entry("1", "F", "Axis", kPou,
            blob("Implementation", "n := 1;") +
                lines("Interface", {"FUNCTION_BLOCK Axis", "VAR", "  n : INT;", "END_VAR"})) +
      entry("2", "1", "P", kProperty, blob("Interface", "PROPERTY P : INT\n")) +
      entry("G", "1", "inner", kFolder, "") +
      entry("4", "G", "M", kMethod,
            blob("Interface", "METHOD M\n") + blob("Implementation", "n := 2;")) +
      entry("5", "1", "Act", kAction, lines("Implementation", {"n := 3;", ""})));
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].text, "FUNCTION_BLOCK Axis\nVAR\n  n : INT;\nEND_VAR\nn := 1;\n"
                                   "\nPROPERTY P : INT\nGET \nP := n;\nEND_GET\nEND_PROPERTY\n"
                                   "\nMETHOD M\nn := 2;\nEND_METHOD\n"
                                   "\nACTION Act\nn := 3;\n\nEND_ACTION\nEND_FUNCTION_BLOCK\n");
  EXPECT_EQ(model.objects[0].folder, (std::vector<std::string>{"Motion _ 1"}));
  EXPECT_EQ(model.objects[0].origin.line, 6U);
  EXPECT_TRUE(model.leftOut.empty());
}

TEST(CodesysExportReader, TakesGlobalVariables) {
  const Model model =
      read(entry("1", "0", "Pars", kGlobals, blob("Interface", "VAR_GLOBAL\nEND_VAR")));
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].kind, ObjectKind::GlobalList);
  EXPECT_EQ(model.objects[0].text, "VAR_GLOBAL\nEND_VAR\n");
}

TEST(CodesysExportReader, TakesPathsOutOfPersistentLists) {
  const Model model =
      read(entry("1", "0", "Keep", "261bd6e6-249c-4232-bb6f-84c2fbeef430",
                 blob("Interface", "VAR_GLOBAL PERSISTENT RETAIN\n  n : INT;\n  MAIN.fb.x : BOOL;\n"
                                   "END_VAR")));
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].text,
            "VAR_GLOBAL PERSISTENT RETAIN\n  n : INT;\n//   MAIN.fb.x : BOOL;\nEND_VAR\n");
  ASSERT_EQ(model.leftOut.size(), 1U);
  EXPECT_NE(model.leftOut[0].text.find("`MAIN.fb.x`"), std::string::npos);
}

TEST(CodesysExportReader, RefusesGraphicalBodiesByName) {
  const Model model =
      read(entry("1", "0", "Net", kPou,
                 blob("Interface", "PROGRAM Net\n") + single("Implementation", "<List2/>")));
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].text,
            "PROGRAM Net\n{error 'body not imported: x:5: a graphical body'}\nEND_PROGRAM\n");
  ASSERT_EQ(model.leftOut.size(), 1U);
  EXPECT_EQ(model.leftOut[0].object, "Net");
  EXPECT_EQ(model.leftOut[0].origin.line, 5U);
}

TEST(CodesysExportReader, SaysWhichPartsHaveNoOwner) {
  const Model model = read(entry("1", "9", "M", kMethod, blob("Interface", "METHOD M")) +
                           entry("2", "2", "P", kProperty, "") +
                           entry("3", "0", "Odd", "12345678-0000-0000-0000-000000000000", ""));
  EXPECT_TRUE(model.objects.empty());
  ASSERT_EQ(model.leftOut.size(), 3U);
  EXPECT_EQ(model.leftOut[0].object, "method M");
  EXPECT_EQ(model.leftOut[1].object, "property P");
  EXPECT_EQ(model.leftOut[2].object, "object Odd");
}

TEST(CodesysExportReader, EndsWhereObjectsLieInEachOther) {
  const Model model = read(entry("1", "2", "a", kFolder, "") + entry("2", "1", "b", kFolder, "") +
                           entry("3", "1", "M", kMethod, "") +
                           entry("4", "2", "Pars", kGlobals, blob("Interface", "VAR_GLOBAL")));
  EXPECT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.leftOut.size(), 1U);
}

std::string task(std::string_view name, std::string_view kind, std::string_view time,
                 std::string_view more = {}) {
  return entry(name, "0", name, kTask,
               single("Kindoftask", kind) + single("Priority", "4") +
                   single("Interval", single("Time", time) + single("Unit", "ms")) +
                   "<List Name=\"PouList\"><Single>" + single("Name", "MAIN") + "</Single></List>" +
                   std::string(more));
}

TEST(CodesysExportReader, ReadsTasks) {
  const Model model = read(
      task("A b", "Cyclic", "50") + task("B", "Cyclic", "t#20ms") + task("C", "Freewheeling", "5") +
      task("D", "Event", "5", single("Event", "G.start")) + task("E", "External", "5"));
  ASSERT_EQ(model.tasks.size(), 5U);
  EXPECT_EQ(model.tasks[0].name, "A_b");
  EXPECT_EQ(model.tasks[0].interval, "T#50ms");
  EXPECT_EQ(model.tasks[0].priority, "4");
  EXPECT_EQ(model.tasks[0].programs, (std::vector<std::string>{"MAIN"}));
  EXPECT_EQ(model.tasks[1].interval, "t#20ms");
  EXPECT_EQ(model.tasks[2].interval, "");
  EXPECT_EQ(model.tasks[3].event, "G.start");
  ASSERT_EQ(model.leftOut.size(), 1U);
  EXPECT_EQ(model.leftOut[0].object, "task E");
}

TEST(CodesysExportReader, ReadsLibraries) {
  const Model model = read(entry(
      "1", "0", "Library Manager", "adb5cb65-8e1d-4a00-b70a-375ea27582f3",
      "<List Name=\"Items\"><Single>" + single("DefaultResolution", "SM3_Basic, 4.10.0.0 (3S)") +
          "</Single><Single>" + single("Name", "Util") + "</Single></List>"));
  ASSERT_EQ(model.libraries.size(), 2U);
  EXPECT_EQ(model.libraries[0].name, "SM3_Basic");
  EXPECT_EQ(model.libraries[0].version, "4.10.0.0");
  EXPECT_EQ(model.libraries[1].name, "Util");
  EXPECT_EQ(model.libraries[1].version, "");
}

TEST(CodesysExportReader, RefusesWhatItCannotRead) {
  Model model;
  readCodesysExport("a", "<ExportFile>", model);
  readCodesysExport("b", "<project/>", model);
  EXPECT_EQ(model.unreadable.size(), 2U);
  EXPECT_TRUE(isCodesysExport("<ExportFile>\n<StructuredView Guid='1'>"));
  EXPECT_FALSE(isCodesysExport("<project/>"));
}

} // namespace
