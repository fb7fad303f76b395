// From files and folders to a model.
#include "compiler/import/input_files.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace stc::import {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class InputFiles : public testing::Test {
protected:
  InputFiles() { fs::create_directories(folder_); }
  ~InputFiles() override { fs::remove_all(folder_); }

  void write(const std::string &name, const std::string &text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  void writePou(const std::string &file, const std::string &name) {
    write(file, "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<TcPlcObject Version=\"1.1.0.1\">\n"
                "<POU Name=\"" +
                    name + "\"><Declaration><![CDATA[FUNCTION_BLOCK " + name +
                    "\n]]></Declaration><Implementation><ST><![CDATA[n := 1;]]></ST>"
                    "</Implementation></POU></TcPlcObject>\n");
  }
  [[nodiscard]] Model readAll() const { return readFiles({folder_.string()}, {}); }
  [[nodiscard]] static std::vector<std::string> namesOf(const Model &model) {
    std::vector<std::string> names;
    for (const Object &object : model.objects)
      names.push_back(object.name);
    return names;
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("stride_input_files_" + std::to_string(::getpid()));
};

std::string project(const std::string &items) {
  return "<Project xmlns=\"http://schemas.microsoft.com/developer/msbuild/2003\"><ItemGroup>" +
         items + "</ItemGroup></Project>";
}

/// Tools put other XML beside their projects; what the user names is read all the same.
TEST_F(InputFiles, OtherXmlInAFolderIsPassedOver) {
  write("a/beremiz.xml", "<BeremizRoot/>");
  EXPECT_THAT(readAll().unreadable, SizeIs(1)); // there is nothing else
  write("b/plc.xml", "<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><types><dataTypes/>"
                     "<pous><pou name=\"Main\" pouType=\"program\"><interface/></pou></pous>"
                     "</types></project>");
  write("c/conf.xml", "<Conf/>");
  const Model model = readAll();
  EXPECT_EQ(model.files, 1U);
  EXPECT_THAT(namesOf(model), ElementsAre("Main"));
  EXPECT_THAT(model.unreadable, IsEmpty());
  ASSERT_THAT(model.notes, SizeIs(1));
  EXPECT_THAT(model.notes[0], HasSubstr("2 files below"));
  EXPECT_THAT(model.notes[0], HasSubstr("a/beremiz.xml"));
  EXPECT_THAT(readFiles({(folder_ / "c/conf.xml").string()}, {}).unreadable, SizeIs(1));
}

TEST_F(InputFiles, FilesThatAProjectExcludesAreLeftOutOfItsFolderToo) {
  writePou("Plc/Old.TcPOU", "Old");
  writePou("Plc/POUs/Shared.TcPOU", "Shared");
  writePou("Plc/POUs/Used.TcPOU", "Used");
  write("Plc/A.plcproj",
        project("<Compile Include=\"Old.TcPOU\"><ExcludeFromBuild>true</ExcludeFromBuild></Compile>"
                "<Compile Include=\"POUs\\Shared.TcPOU\"><ExcludeFromBuild>true</ExcludeFromBuild>"
                "</Compile><Compile Include=\"POUs\\Used.TcPOU\"/>"));
  EXPECT_THAT(namesOf(readAll()), ElementsAre("Used"));
  write("Plc/B.plcproj", project("<Compile Include=\"POUs\\Shared.TcPOU\"/>"));
  const Model model = readAll();
  EXPECT_THAT(namesOf(model), ElementsAre("Shared", "Used"));
  ASSERT_THAT(model.leftOut, SizeIs(2));
  EXPECT_EQ(model.leftOut[0].object, "Old.TcPOU");
}

TEST_F(InputFiles, ReferencesToFilesWithOtherEndingsAreLosses) {
  write("Plc/A.plcproj", project("<Compile Include=\"POUs\\Odd.TcXyz\"/>"));
  const Model model = readAll();
  ASSERT_THAT(model.leftOut, SizeIs(1));
  EXPECT_EQ(model.leftOut[0].object, "POUs/Odd.TcXyz");
  EXPECT_THAT(model.leftOut[0].text, HasSubstr("ending"));
}

TEST_F(InputFiles, WhatCannotBeReadDoesNotCount) {
  write("broken.xml", "<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\"><types>");
  Model model = readAll();
  EXPECT_THAT(model.unreadable, SizeIs(1));
  EXPECT_EQ(model.files, 0U);
  write("good.EXP", "PROGRAM P\nEND_PROGRAM\n");
  model = readAll();
  EXPECT_THAT(model.unreadable, SizeIs(1));
  EXPECT_EQ(model.files, 1U);
}

TEST_F(InputFiles, LinesEndWithALineFeedAlone) {
  write("a.scl", "FUNCTION_BLOCK F\r\nBEGIN\r\n// one\r\n  n := 1;\r\r\nEND_FUNCTION_BLOCK\r\n");
  const Model model = readAll();
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_EQ(model.objects[0].text, "FUNCTION_BLOCK F\n\n// one\n  n := 1;\r\nEND_FUNCTION_BLOCK\n");
  EXPECT_THAT(model.leftOut, IsEmpty());
}

} // namespace
} // namespace stc::import
