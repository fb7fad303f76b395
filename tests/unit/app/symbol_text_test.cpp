// The tables that are made of lines of symbols.

#include "runtime/app/error.hpp"
#include "runtime/app/symbol_text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using namespace stride;
using app::DescribedApplication;
using ::testing::HasSubstr;

struct Given {
  std::string text;
  std::vector<std::vector<uint64_t>> numbers;
};

/// Every kind of line, and every column with and without something in it.
Given everything() {
  return {"T0\tINT\tff\n"
          "T0\tColour\ta\t0\n"
          "E\tred\n"
          "E\tgreen\t-5\n"
          "T3\tBlock\tffffffffffffffff\t\t\t\t\t77\tOldBlock\n"
          "M\tplain\t0\n"
          "Mrc\tboth\t1\told one\n"
          "T0\tARRAY [-2..3] OF INT\t1\t0\t-2\t6\n"
          "T0\tSTRING(9)\t2\t\t\t\t9\n"
          "Rh\tGlobal\t3\tList\t4\tOther.Global\n"
          "R\tProgram\t2\n",
          {{3, 2, 2, 32, 2, 2, 35, 48, 8}, {0, 40}, {37, 12, 2, 24, 10, 1, 96}, {128}}};
}

struct Lists {
  explicit Lists(const Given &given) {
    for (const std::vector<uint64_t> &list : given.numbers)
      numbers.push_back({list.data(), list.size()});
    lines = {given.text.data(), given.text.size(), numbers.data(),
             static_cast<uint32_t>(numbers.size()), 0};
    app.symbols = &lines;
    app.name = "given";
  }
  std::vector<SymbolNumbers> numbers;
  SymbolLines lines{};
  StrideAppV1 app{};
};

std::string errorOf(const Given &given) {
  const Lists lists(given);
  try {
    const DescribedApplication described(lists.app);
  } catch (const app::Error &error) {
    return error.what();
  }
  return "no error";
}

/// Of a single type with one member, whose line is given.
std::string errorOfMember(const std::string &line) {
  return errorOf({"T0\tS\t1\n" + line + "\n", {{33, 8, 8, 0}}});
}

uint32_t flagsOf(const std::string &flags) {
  const Given given{"R" + flags + "\tx\t0\n", {{0}}};
  const Lists lists(given);
  return DescribedApplication(lists.app).description().roots[0].flags;
}

} // namespace

TEST(SymbolText, GivesTypes) {
  const Given given = everything();
  const Lists lists(given);
  const DescribedApplication described(lists.app);
  const StrideAppV1 &d = described.description();
  EXPECT_STREQ(d.name, "given");
  EXPECT_EQ(d.symbols, nullptr);
  ASSERT_EQ(d.typeCount, 5U);
  EXPECT_EQ(d.types[0].kind, Kind::INT);
  EXPECT_STREQ(d.types[0].name, "INT");
  EXPECT_EQ(d.types[0].layoutHash, 0xFFU);
  EXPECT_EQ(d.types[0].element, kNoIndex);
  EXPECT_EQ(d.types[0].renamedFrom, nullptr);
  const TypeDesc &block = d.types[2];
  EXPECT_EQ(block.kind, Kind::FunctionBlock);
  EXPECT_EQ(block.flags, kTypeHasAddress | kTypeExternal);
  EXPECT_EQ(block.size, 48U);
  EXPECT_EQ(block.align, 8U);
  EXPECT_EQ(block.layoutHash, UINT64_MAX);
  EXPECT_EQ(block.typeId, 77U);
  EXPECT_STREQ(block.renamedFrom, "OldBlock");
  EXPECT_EQ(d.types[3].element, 0U);
  EXPECT_EQ(d.types[3].lowerBound, -2);
  EXPECT_EQ(d.types[3].elementCount, 6U);
  EXPECT_EQ(d.types[4].stringLength, 9U);
}

TEST(SymbolText, GivesMembersAndRoots) {
  const Given given = everything();
  const Lists lists(given);
  const DescribedApplication described(lists.app);
  const StrideAppV1 &d = described.description();
  ASSERT_EQ(d.enumeratorCount, 2U);
  EXPECT_EQ(d.types[1].firstMember, 0U);
  EXPECT_EQ(d.types[1].memberCount, 2U);
  EXPECT_STREQ(d.enumerators[1].name, "green");
  EXPECT_EQ(d.enumerators[0].value, 0);
  EXPECT_EQ(d.enumerators[1].value, -5);
  ASSERT_EQ(d.memberCount, 2U);
  EXPECT_EQ(d.types[2].firstMember, 0U);
  EXPECT_EQ(d.types[2].memberCount, 2U);
  EXPECT_EQ(d.members[0].flags, 0U);
  EXPECT_EQ(d.members[0].renamedFrom, nullptr);
  EXPECT_STREQ(d.members[1].name, "both");
  EXPECT_EQ(d.members[1].offset, 40U);
  EXPECT_EQ(d.members[1].type, 1U);
  EXPECT_EQ(d.members[1].flags, kSymRetain | kSymConstant);
  EXPECT_STREQ(d.members[1].renamedFrom, "old one");
  ASSERT_EQ(d.rootCount, 2U);
  EXPECT_STREQ(d.roots[0].list, "List");
  EXPECT_EQ(d.roots[0].flags, kSymHidden);
  EXPECT_EQ(d.roots[0].offset, 96U);
  EXPECT_EQ(d.roots[0].task, 4U);
  EXPECT_STREQ(d.roots[0].renamedFrom, "Other.Global");
  EXPECT_EQ(d.roots[1].list, nullptr);
  EXPECT_EQ(d.roots[1].task, kNoIndex);
  EXPECT_EQ(d.roots[1].offset, 128U);
}

TEST(SymbolText, TablesThatAreThereStay) {
  static constexpr TypeDesc kType[] = {{Kind::INT, 0, "INT", 2, 1, 2, 0, 0, kNoIndex, 0, 0, 0, 0}};
  StrideAppV1 app{};
  app.types = kType;
  app.typeCount = 1;
  const DescribedApplication described(app);
  EXPECT_EQ(described.description().types, kType);
  EXPECT_EQ(described.description().typeCount, 1U);
}

TEST(SymbolText, LettersAreFlags) {
  EXPECT_EQ(flagsOf(""), 0U);
  EXPECT_EQ(flagsOf("i"), kSymInput);
  EXPECT_EQ(flagsOf("o"), kSymOutput);
  EXPECT_EQ(flagsOf("x"), kSymInOut);
  EXPECT_EQ(flagsOf("r"), kSymRetain);
  EXPECT_EQ(flagsOf("p"), kSymPersistent);
  EXPECT_EQ(flagsOf("c"), kSymConstant);
  EXPECT_EQ(flagsOf("h"), kSymHidden);
  EXPECT_EQ(flagsOf("B"), kSymBase);
  EXPECT_EQ(flagsOf("q"), kSymQualifiedOnly);
  EXPECT_EQ(flagsOf("t"), kSymTypeId);
  EXPECT_EQ(flagsOf("n"), kSymInitOnChange);
  EXPECT_EQ(flagsOf("l"), kSymLocated);
  EXPECT_EQ(flagsOf("N"), kSymNonRetain);
  EXPECT_EQ(flagsOf("b"), kSymBit);
  EXPECT_EQ(flagsOf("lb7"), kSymLocated | kSymBit | 7U << kSymBitShift);
  EXPECT_EQ(flagsOf("s0"), kSymSlot);
  EXPECT_EQ(flagsOf("cs2b"), kSymConstant | kSymSlot | 2U << kSymAreaShift | kSymBit);
}

TEST(SymbolText, DamagedLines) {
  ASSERT_EQ(errorOf(everything()), "no error");
  ASSERT_EQ(errorOfMember("Mi\tx\t0"), "no error");
  for (const char *line : {"", "x\ty\t0", "M", "M\t\t0", "M\tx\tone", "M\tx\t4294967296",
                           "M\tx\t-1", "M\tx\t0\told\t1", "M?\tx\t0", "M.\tx\t0", "M1\tx\t0",
                           "Mb8\tx\t0", "Ms3\tx\t0", "Mi0\tx\t0", "E\tx\t1"})
    EXPECT_THAT(errorOfMember(line), HasSubstr("damaged (line 2 of its symbols)")) << line;
  EXPECT_THAT(errorOf({"M\tx\t0\n", {{0}}}), HasSubstr("line 1")) << "no type before";
  EXPECT_THAT(errorOf({"T0\tEnum\t1\t0\nM\tx\t0\n", {{32, 2, 2, 0}}}), HasSubstr("line 2"));
  EXPECT_THAT(errorOf({"T0\tINT\tg\n", {{3, 2, 2}}}), HasSubstr("line 1"));
  EXPECT_THAT(errorOf({"T0\tINT\t1", {{3, 2, 2}}}), HasSubstr("line 1")) << "no line feed";
}

TEST(SymbolText, NumbersThatDoNotFitTheLines) {
  const std::string line = "T0\tINT\t1\n";
  EXPECT_EQ(errorOf({line, {{3, 2, 2}}}), "no error");
  EXPECT_EQ(errorOf({line, {{3}, {2}, {2}}}), "no error");
  EXPECT_EQ(errorOf({"", {}}), "no error");
  EXPECT_THAT(errorOf({line, {}}), HasSubstr("line 1"));
  EXPECT_THAT(errorOf({line, {{3, 2}}}), HasSubstr("line 1"));
  EXPECT_THAT(errorOf({line, {{3, 2, 2, 0}}}), HasSubstr("line 2")) << "one more";
  EXPECT_THAT(errorOf({line, {{3, 2, 2}, {0}}}), HasSubstr("line 2"));
  EXPECT_THAT(errorOf({line, {{3, 2}, {}, {2}}}), HasSubstr("line 1")) << "an empty list";
  EXPECT_EQ(errorOf({line, {{3, 2, 0xFFFFFFFF}}}), "no error");
  EXPECT_THAT(errorOf({line, {{3, 2, 0x100000000}}}), HasSubstr("line 1"));
  EXPECT_THAT(errorOf({line, {{0x100000003, 2, 2}}}), HasSubstr("line 1"));
}

// Whatever the bytes are: an error or tables, and nothing is read or written that is not there
// (AddressSanitizer looks on).
TEST(SymbolText, AnyByteMayBeAnother) {
  const Given good = everything();
  for (size_t i = 0; i < good.text.size(); ++i) {
    errorOf({good.text.substr(0, i), good.numbers});
    for (const char other : {'\n', '\t', '0', 'M', 'T'}) {
      Given bad = good;
      bad.text[i] = other;
      errorOf(bad);
    }
  }
}
