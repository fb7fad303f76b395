// What is done with a model after all files are read: names, addresses, libraries.
#include "compiler/import/finish.hpp"
#include "compiler/source/st_scan.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace stc::import {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Model with(std::vector<std::string> texts) {
  Model model;
  for (std::string &text : texts)
    model.objects.push_back({ObjectKind::Pou,
                             "P" + std::to_string(model.objects.size()),
                             {},
                             std::move(text),
                             {"a.EXP", 10}});
  return model;
}

void finished(Model &model, FinishSettings settings = {}) {
  settings.own = {[](std::string_view name) { return name == "ton"; },
                  [](std::string_view name) { return name == "standard"; }};
  EXPECT_EQ(finish(model, settings), "");
}

TEST(StWords, leavesCommentsTextsAndPragmasAlone) {
  const std::string text =
      "LTIME (* a (* LTIME *) LTIME *) 'LTIME $' LTIME' // LTIME\n{LTIME} \"LTIME\" "
      "/* LTIME */ 16#LTIME ltime.x";
  EXPECT_EQ(replaceWords(text,
                         [](const StWord &word, std::string_view name) {
                           return word.kind == StWord::Kind::Name && name != "x" ? "A" : "";
                         }),
            "A (* a (* LTIME *) LTIME *) 'LTIME $' LTIME' // LTIME\n{LTIME} \"LTIME\" /* LTIME */ "
            "16#LTIME A.x");
}

TEST(Finish, renamesWhatIsReservedHere) {
  Model model = with({"PROGRAM A\nVAR\n LTime, ltime_ : INT; (* LTIME *)\nEND_VAR\nLTIME := 1;\n",
                      "PROGRAM B\nx := P0.ltime;\n"});
  finished(model);
  EXPECT_EQ(model.objects[0].text,
            "PROGRAM A\nVAR\n LTime_1, ltime_ : INT; (* LTIME *)\nEND_VAR\nLTime_1 := 1;\n");
  EXPECT_EQ(model.objects[1].text, "PROGRAM B\nx := P0.LTime_1;\n");
  ASSERT_THAT(model.changed, SizeIs(1));
  EXPECT_EQ(model.changed[0].object, "LTime");
}

TEST(Finish, aTypeOfThatNameIsNoName) {
  Model model = with({"PROGRAM A\nVAR\n t : LTIME; u : LTIME := LTIME#5ns;\nEND_VAR\n"});
  finished(model);
  EXPECT_THAT(model.objects[0].text, HasSubstr("t : LTIME; u : LTIME := LTIME#5ns;"));
  EXPECT_THAT(model.changed, IsEmpty());
}

TEST(Finish, takesObjectsOnce) {
  Model model = with({"PROGRAM A\nn := 1;\n", "PROGRAM A (* other *)\n n := 1;\n",
                      "PROGRAM A\nn := 2;\n", "VAR_GLOBAL\nEND_VAR\n"});
  model.objects[0].name = model.objects[3].name = "Same";
  model.objects[1].name = "same";
  model.objects[2].name = "SAME";
  model.objects[3].kind = ObjectKind::GlobalList;
  finished(model);
  ASSERT_THAT(model.objects, SizeIs(2)) << "a list is in no POU's way";
  EXPECT_EQ(model.objects[0].text, "PROGRAM A\nn := 1;\n");
  ASSERT_THAT(model.changed, SizeIs(1));
  EXPECT_THAT(model.changed[0].text, HasSubstr("a.EXP:10"));
  ASSERT_THAT(model.leftOut, SizeIs(1));
  EXPECT_EQ(model.leftOut[0].object, "POU SAME");
}

TEST(Finish, numbersChannelsInTheirOrder) {
  Model model = with({"a AT %IX0.0.3 : BOOL; b AT %IW0.1 : WORD; c AT %ID2.0 : REAL;\n"
                      "d AT %QX1.1 : BOOL; e AT %MW5 : WORD; f AT %I* : BOOL; g AT %IR2.0 : REAL;\n"
                      "h AT %IX0.0.8 : BOOL;"});
  for (const char *address : {"%IB0.0", "%IW0.1", "%QX1.0", "%QX1.1", "%IB1.2", "%IR2.0", "%QX3.0"})
    model.hardware.push_back({address, {"a.EXP", 1}});
  model.addressing = "bytes";
  finished(model);
  EXPECT_EQ(model.objects[0].text,
            "a AT %IX0.3 : BOOL; b AT %IW2 : WORD; c AT %ID8 : REAL;\n"
            "d AT %QX0.1 : BOOL; e AT %MW5 : WORD; f AT %I* : BOOL; g AT %ID8 : REAL;\n"
            "h AT %IX0.0.8 : BOOL;");
  EXPECT_THAT(model.addresses, SizeIs(5));
  ASSERT_THAT(model.leftOut, SizeIs(1)) << "a byte has no bit 8";
  EXPECT_EQ(model.leftOut[0].origin.line, 10U) << "where the object begins";
}

TEST(Finish, wordsAreCountedAsTheUserWants) {
  Model model = with({"a AT %IX0.1.0 : BOOL; b AT %ID0.2 : DWORD; c AT %IW0.3 : WORD;"});
  for (const char *address : {"%IB0.0", "%IB0.1", "%ID0.2", "%IW0.3"})
    model.hardware.push_back({address, {"a.EXP", 1}});
  model.addressing = "bytes";
  finished(model, {.library = false, .addressing = "words", .configuration = {}, .own = {}});
  EXPECT_EQ(model.objects[0].text, "a AT %IX0.8 : BOOL; b AT %ID1 : DWORD; c AT %IW4 : WORD;");
  EXPECT_EQ(model.addressing, "words");
}

TEST(Finish, plainAddressesStay) {
  Model model = with({"a AT %IX3.11 : BOOL; b AT %IW7 : WORD;"});
  model.hardware.push_back({"%IW7", {"a.EXP", 1}});
  model.hardware.push_back({"%IX3.11", {"a.EXP", 1}});
  model.addressing = "words";
  finished(model);
  EXPECT_EQ(model.objects[0].text, "a AT %IX3.11 : BOOL; b AT %IW7 : WORD;");
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("--addressing bytes")));
  Model none = with({"n := 1;"});
  none.addressing = "words";
  finished(none);
  EXPECT_EQ(none.addressing, "") << "nothing to count";
}

TEST(Finish, addressesOfUnknownHardwareAreLosses) {
  Model model = with({"n := 1;\na AT %IW0.7.3 : WORD; b AT %IX0.0 : BOOL; c AT %IW0.7.3 : WORD;"});
  finished(model);
  ASSERT_THAT(model.leftOut, SizeIs(1));
  EXPECT_EQ(model.leftOut[0].object, "%IW0.7.3");
  EXPECT_EQ(model.leftOut[0].origin.line, 10U);
}

TEST(Finish, looksUpWhatIsUsedOfLibraries) {
  Model model = with({"t : TON; v : Valve; own : P0;"});
  model.libraries = {{"STANDARD.LIB", "1", {"a.EXP", 2}, {"TON", "TOF"}},
                     {"VENDOR.LIB", "1", {"a.EXP", 5}, {"Valve", "Pump", "P0"}},
                     {"Unused.lib", "1", {"a.EXP", 7}, {"Other"}},
                     {"vendor.lib", "2", {"a.EXP", 8}, {"Valve"}},
                     {"Standard", "", {"b.xml", 8}},
                     {"Listless", "", {"b.xml", 9}}};
  finished(model);
  ASSERT_THAT(model.leftOut, SizeIs(1));
  EXPECT_THAT(model.leftOut[0].text, HasSubstr("not in Stride: Valve;"));
  EXPECT_THAT(model.changed, SizeIs(2));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("Listless")));
}

TEST(Finish, aLibraryHasNoMachine) {
  Model model = with({"(* first *) PROGRAM A\nEND_PROGRAM\n", "FUNCTION F : INT\nEND_FUNCTION\n"});
  model.tasks = {{"T", "", "", "", {"A"}, {"a.EXP", 3}}, {"Idle", "", "", "", {}, {"a.EXP", 4}}};
  model.channels = {{"x", "%IX0.0", "BOOL", "", {"a.EXP", 5}}};
  finished(model, {.library = true, .addressing = {}, .configuration = {}, .own = {}});
  EXPECT_THAT(model.objects, SizeIs(1));
  EXPECT_THAT(model.leftOut, SizeIs(3));
  EXPECT_THAT(model.tasks, IsEmpty());
  EXPECT_THAT(model.channels, IsEmpty());
  EXPECT_THAT(model.changed, SizeIs(1)) << "a task that calls nothing";
}

TEST(Finish, aPointAtTheEndOfANumber) {
  Model model =
      with({"a := 10./b; c := 1.5; d := w.3; FOR i IN 1..5; e := 2.; f := x[1].y; g := 3.e2;"});
  finished(model);
  EXPECT_EQ(model.objects[0].text,
            "a := 10.0/b; c := 1.5; d := w.3; FOR i IN 1..5; e := 2.0; f := x[1].y; g := 3.e2;");
}

TEST(Finish, parametersOfDrivesAreToml) {
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / "stride_finish_parameters.cfg";
  std::ofstream(path) << "[1]\nName=wDriveId\n[2]\nName=fPositionPeriod\n"
                         "[3]\nName=fSWMaxVelocity\n[4]\nName=iMovementType\n";
  Model model;
  model.tasks = {{"a \"fast\\ one", "", "", "", {"P"}, {"a.EXP", 3}, {}}};
  DriveSetup drive{"Ram", {}, {"a.EXP", 5}, {{1, "007"}, {2, ".5"}, {3, "5."}, {4, "Ro\"tary"}}};
  model.buses = {{"Line", {{"Axes", {}, {drive}, {"a.EXP", 4}, {}, {{9, "1"}}}}, {"a.EXP", 3}}};
  finished(model, {.library = false, .addressing = {}, .configuration = path.string(), .own = {}});
  std::filesystem::remove(path);
  const DriveGroupSetup &group = model.buses[0].groups[0];
  ASSERT_THAT(group.parameters, SizeIs(1));
  EXPECT_EQ(group.parameters[0].value, "\"a \\\"fast\\\\ one\"");
  ASSERT_GE(group.drives[0].parameters.size(), 4U);
  EXPECT_EQ(group.drives[0].parameters[0].value, "7");
  EXPECT_EQ(group.drives[0].parameters[1].value, "0.5");
  EXPECT_EQ(group.drives[0].parameters[2].value, "5.0");
  EXPECT_EQ(group.drives[0].parameters[3].value, "\"ro\\\"tary\"");
}

TEST(Finish, aMissingConfigurationFileIsAProblem) {
  Model model;
  EXPECT_THAT(
      finish(model,
             {.library = false, .addressing = {}, .configuration = "/no/such.cfg", .own = {}}),
      HasSubstr("no/such.cfg"));
}

} // namespace
} // namespace stc::import
