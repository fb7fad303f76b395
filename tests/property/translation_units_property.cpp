// Which sources are compiled together: small projects as one, others by the hashes of their paths.
#include "compiler/project/translation_units.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

using stc::divideIntoUnits;
using stc::GeneratedFile;
using stc::TranslationUnit;

constexpr size_t kMost = 24576;
constexpr size_t kMostOnce = 40960;

GeneratedFile source(const std::string &name, size_t bytes, bool runsOnce = false) {
  return {"user/" + name + ".cpp", std::string(bytes, 'x'), runsOnce};
}

/// What a unit includes, in its order; itself where it is a source.
std::vector<std::string> sourcesOf(const TranslationUnit &unit,
                                   const std::vector<GeneratedFile> &files) {
  if (!unit.path.starts_with("units__/"))
    return {unit.path};
  const auto file =
      std::find_if(files.begin(), files.end(), [&](const auto &f) { return f.path == unit.path; });
  std::vector<std::string> sources;
  if (file == files.end())
    return sources;
  for (size_t at = file->text.find("#include \""); at != std::string::npos;
       at = file->text.find("#include \"", at + 1)) {
    const size_t begin = at + 10;
    sources.push_back(file->text.substr(begin, file->text.find('"', begin) - begin));
  }
  return sources;
}

std::set<std::set<std::string>> division(std::vector<GeneratedFile> files) {
  std::set<std::set<std::string>> result;
  for (const TranslationUnit &unit : divideIntoUnits(files)) {
    const std::vector<std::string> sources = sourcesOf(unit, files);
    result.emplace(sources.begin(), sources.end());
  }
  return result;
}

/// As many sources with some bytes each as a project of a machine has, and its application object.
std::vector<GeneratedFile> anyProject(size_t count) {
  std::vector<GeneratedFile> files = {{"app.cpp", std::string(30000, 't')},
                                      {"build.cpp", std::string(700, 't')},
                                      {"st/user/Header.h", "struct Header;"}};
  for (size_t i = 0; i < count; ++i)
    files.push_back(source("Pou" + std::to_string(i * i + 7),
                           *rc::gen::resize(30000, rc::gen::inRange<size_t>(200, 30000)),
                           *rc::gen::arbitrary<bool>()));
  return files;
}

TEST(TranslationUnits, SmallProjectIsOneWithTheApplicationLast) {
  std::vector<GeneratedFile> files = {{"app.cpp", std::string(16000, 't')},
                                      {"build.cpp", std::string(1600, 't')},
                                      source("Zebra", 300),
                                      {"st/user/Zebra.h", "struct Zebra;"},
                                      source("Ant", kMost - 300 - 1100)};
  const std::vector<TranslationUnit> units = divideIntoUnits(files);
  ASSERT_EQ(units.size(), 1U);
  EXPECT_EQ(sourcesOf(units[0], files),
            (std::vector<std::string>{"user/Ant.cpp", "user/Zebra.cpp", "app.cpp", "build.cpp"}));
  EXPECT_EQ(units[0].title, "Ant and 3 more");
  EXPECT_EQ(files.size(), 6U);
}

TEST(TranslationUnits, WhatRunsOnceIsApartInLargeProjects) {
  for (const bool large : {false, true}) {
    std::vector<GeneratedFile> files = {{"app.cpp", "t", false},
                                        source("Hot", large ? 20000 : 200),
                                        source("Loop", 3000),
                                        source("Cold", 3000),
                                        source("Ice", 4000)};
    files[3].runsOnce = files[4].runsOnce = true;
    const std::vector<TranslationUnit> units = divideIntoUnits(files);
    std::map<std::string, bool> once; // by source
    for (const TranslationUnit &unit : units)
      for (const std::string &path : sourcesOf(unit, files))
        once[path] = unit.runsOnce;
    EXPECT_EQ(once, (std::map<std::string, bool>{{"app.cpp", large},
                                                 {"user/Cold.cpp", large},
                                                 {"user/Hot.cpp", false},
                                                 {"user/Ice.cpp", large},
                                                 {"user/Loop.cpp", false}}));
    EXPECT_EQ(units.size(), large ? 3U : 1U); // of them, two of each kind together
  }
  std::vector<GeneratedFile> files = {{"app.cpp", "t", false}, source("Cold", 3000)};
  files[1].runsOnce = true;
  EXPECT_TRUE(divideIntoUnits(files).at(0).runsOnce);
}

TEST(TranslationUnits, OneNumericSourceMakesItsUnitNumeric) {
  std::vector<GeneratedFile> files = {{"app.cpp", "t"}, source("Sums", 3000), source("Rest", 3000)};
  EXPECT_FALSE(divideIntoUnits(files).at(0).isNumeric);
  files = {
      {"app.cpp", "t"}, source("Sums", 3000), source("Large", kMost + 1), source("Rest", 3000)};
  files[1].isNumeric = true;
  size_t numeric = 0;
  for (const TranslationUnit &unit : divideIntoUnits(files))
    numeric += unit.isNumeric ? 1 : 0;
  EXPECT_EQ(numeric, 1U);
}

TEST(TranslationUnits, OneByteMoreAndTheApplicationIsApart) {
  std::vector<GeneratedFile> files = {{"app.cpp", std::string(16000, 't')},
                                      {"build.cpp", std::string(1600, 't')},
                                      source("Zebra", 301),
                                      source("Ant", kMost - 300 - 1100)};
  EXPECT_EQ(division(files), (std::set<std::set<std::string>>{
                                 {"app.cpp"}, {"build.cpp"}, {"user/Ant.cpp", "user/Zebra.cpp"}}));
}

TEST(TranslationUnits, LargeSourceIsAlone) {
  EXPECT_EQ(
      division({{"app.cpp", "t"}, source("Large", kMost + 1), source("A", 1), source("B", 1)}),
      (std::set<std::set<std::string>>{
          {"app.cpp"}, {"user/Large.cpp"}, {"user/A.cpp", "user/B.cpp"}}));
}

TEST(TranslationUnits, NumbersInTablesWeighASixteenth) {
  for (const size_t over : {size_t{0}, size_t{1}}) {
    std::vector<GeneratedFile> files = {{"build.cpp", "t"},
                                        source("Large", kMost - 100 + 1600 + over)};
    files[1].tables = 1600;
    EXPECT_EQ(divideIntoUnits(files).size(), over == 0 ? 1U : 2U);
  }
}

TEST(TranslationUnits, WhatRunsOnceIsInLargerUnits) {
  for (const size_t over : {size_t{0}, size_t{1}}) {
    const auto files = [&] {
      return std::vector<GeneratedFile>{
          {"app.cpp", "t"}, source("Cold", kMostOnce - 10, true), source("Ice", 10 + over, true)};
    };
    std::set<std::set<std::string>> expected = {{"app.cpp"}, {"user/Cold.cpp", "user/Ice.cpp"}};
    if (over != 0)
      expected = {{"app.cpp"}, {"user/Cold.cpp"}, {"user/Ice.cpp"}};
    EXPECT_EQ(division(files()), expected);
  }
}

TEST(TranslationUnits, ShutsOutTheInlineBodiesOfItsOwn) {
  std::vector<GeneratedFile> files = {source("Ant", 5), source("Bee", 5), {"app.cpp", "t"}};
  ASSERT_EQ(divideIntoUnits(files).size(), 1U);
  const std::string text = files.back().text;
  EXPECT_LT(text.find("#define " + stc::besideMacro("user/Bee.cpp")), text.find("#include"));
  EXPECT_LT(text.find("#define " + stc::besideMacro("user/Ant.cpp")), text.find("#include"));
  EXPECT_EQ(stc::besideMacro("user/Bee.cpp"), "STRIDE_BESIDE_user_Bee");
}

RC_GTEST_PROP(TranslationUnitsProperty, EverySourceIsInOneUnitThatIsNotTooLarge, ()) {
  std::vector<GeneratedFile> files = anyProject(*rc::gen::inRange<size_t>(0, 40));
  std::map<std::string, size_t> sizes;
  for (const GeneratedFile &file : files)
    if (file.path.ends_with(".cpp"))
      sizes[file.path] = file.text.size();
  std::multiset<std::string> seen;
  for (const TranslationUnit &unit : divideIntoUnits(files)) {
    const std::vector<std::string> sources = sourcesOf(unit, files);
    size_t bytes = 0;
    for (const std::string &path : sources) {
      seen.insert(path);
      bytes += path.starts_with("user/") ? sizes.at(path) : 0;
    }
    RC_ASSERT(sources.size() == 1 || bytes <= (unit.runsOnce ? kMostOnce : kMost));
  }
  RC_ASSERT(seen.size() == sizes.size());
  for (const auto &[path, size] : sizes)
    RC_ASSERT(seen.count(path) == 1U);
}

RC_GTEST_PROP(TranslationUnitsProperty, OrderOfTheFilesIsNoMatter, ()) {
  std::vector<GeneratedFile> files = anyProject(*rc::gen::inRange<size_t>(0, 40));
  std::vector<GeneratedFile> turned(files.rbegin(), files.rend());
  const size_t count = files.size();
  static_cast<void>(divideIntoUnits(files));
  static_cast<void>(divideIntoUnits(turned));
  const auto added = [count](const std::vector<GeneratedFile> &all) {
    std::map<std::string, std::string> result;
    for (size_t i = count; i < all.size(); ++i)
      result[all[i].path] = all[i].text;
    return result;
  };
  RC_ASSERT(added(files) == added(turned));
}

RC_GTEST_PROP(TranslationUnitsProperty, NewSourceChangesOneUnit, ()) {
  // More than one unit before and after.
  std::vector<GeneratedFile> files = anyProject(*rc::gen::inRange<size_t>(0, 40));
  files.push_back(source("First", 20000));
  files.push_back(source("Second", 20000));
  const std::set<std::set<std::string>> before = division(files);
  files.push_back(source("New" + std::to_string(*rc::gen::inRange(0, 1000)),
                         *rc::gen::inRange<size_t>(200, 30000), *rc::gen::arbitrary<bool>()));
  const std::set<std::set<std::string>> after = division(files);
  std::set<std::set<std::string>> gone;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(),
                      std::inserter(gone, gone.end()));
  RC_ASSERT(gone.size() <= 1U);
}

} // namespace
