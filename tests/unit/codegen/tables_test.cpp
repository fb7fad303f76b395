// The application's description of itself.

#include "program.hpp"

#include <cstring>
#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stc::test {

using ::testing::HasSubstr;
using ::testing::Not;

namespace {

constexpr const char *kProgram = R"(
TYPE Color : (red, green := 5, blue); END_TYPE
TYPE Point : STRUCT x : LREAL := 1.5; y : LREAL; END_STRUCT END_TYPE
FUNCTION_BLOCK Counter
VAR_INPUT step : INT := 1; END_VAR
VAR_IN_OUT total : DINT; END_VAR
VAR_OUTPUT count : INT; END_VAR
VAR {attribute 'hide'} secret : UDINT; END_VAR
END_FUNCTION_BLOCK
VAR_GLOBAL RETAIN kept : DINT; END_VAR
VAR_GLOBAL CONSTANT kMax : DINT := 7; END_VAR
PROGRAM Main
VAR
  a : ARRAY[1..3, -1..0] OF INT; pt : Point; fb : Counter; color : Color; p : POINTER TO Point; name : STRING(10); r : INT(0..5);
END_VAR
END_PROGRAM
)";

const stride::MemberDesc *member(const stride::StrideAppV1 &app, const stride::TypeDesc &type,
                                 const char *name) {
  for (uint32_t i = 0; i < type.memberCount; ++i) {
    if (std::strcmp(app.members[type.firstMember + i].name, name) == 0)
      return &app.members[type.firstMember + i];
  }
  return nullptr;
}

} // namespace

TEST(CodegenTables, DescribeTypes) {
  App app(kProgram);
  const stride::StrideAppV1 &d = app.description();
  EXPECT_EQ(d.abiVersion, stride::kAbiVersion);
  EXPECT_EQ(d.magic, stride::kAbiMagic);
  EXPECT_EQ(d.size, sizeof(stride::StrideAppV1));
  EXPECT_NE(d.buildHash, 0U);
  ASSERT_EQ(d.fileCount, 1U);
  EXPECT_STREQ(d.files[0].path, "Main.st");
  ASSERT_EQ(d.taskCount, 1U);
  EXPECT_EQ(d.tasks[0].intervalNs, 10'000'000);

  const stride::TypeDesc *counter = nullptr;
  ASSERT_NE(app.at("Main.fb", &counter), nullptr);
  EXPECT_EQ(counter->kind, stride::Kind::FunctionBlock);
  EXPECT_STREQ(counter->name, "Counter");
  EXPECT_EQ(counter->flags, stride::kTypeHasAddress);
  ASSERT_EQ(counter->memberCount, 4U);
  EXPECT_EQ(member(d, *counter, "step")->flags, stride::kSymInput);
  EXPECT_EQ(member(d, *counter, "total")->flags, stride::kSymInOut);
  EXPECT_EQ(member(d, *counter, "count")->flags, stride::kSymOutput);
  EXPECT_EQ(member(d, *counter, "secret")->flags, stride::kSymHidden);
  EXPECT_EQ(d.types[member(d, *counter, "total")->type].kind, stride::Kind::InOut);

  const stride::TypeDesc *matrix = nullptr;
  ASSERT_NE(app.at("Main.a", &matrix), nullptr);
  EXPECT_EQ(matrix->elementCount, 3U);
  EXPECT_EQ(d.types[matrix->element].lowerBound, -1);
  EXPECT_EQ(matrix->size, 12U);

  const stride::TypeDesc *color = nullptr;
  ASSERT_NE(app.at("Main.color", &color), nullptr);
  ASSERT_EQ(color->memberCount, 3U);
  EXPECT_STREQ(d.enumerators[color->firstMember + 1].name, "green");
  EXPECT_EQ(d.enumerators[color->firstMember + 2].value, 6);

  const stride::TypeDesc *pointer = nullptr;
  ASSERT_NE(app.at("Main.p", &pointer), nullptr);
  EXPECT_EQ(pointer->kind, stride::Kind::Pointer);
  EXPECT_STREQ(d.types[pointer->element].name, "Point");

  const stride::TypeDesc *name = nullptr;
  ASSERT_NE(app.at("Main.name", &name), nullptr);
  EXPECT_EQ(name->stringLength, 10U);
  EXPECT_EQ(name->size, 11U);

  const stride::TypeDesc *range = nullptr;
  ASSERT_NE(app.at("Main.r", &range), nullptr);
  EXPECT_EQ(range->kind, stride::Kind::INT);

  bool kept = false;
  bool constant = false;
  for (uint32_t i = 0; i < d.rootCount; ++i) {
    kept = kept ||
           (std::strcmp(d.roots[i].name, "kept") == 0 && d.roots[i].flags == stride::kSymRetain);
    constant = constant || (std::strcmp(d.roots[i].name, "kMax") == 0 &&
                            d.roots[i].flags == stride::kSymConstant);
  }
  EXPECT_TRUE(kept);
  EXPECT_TRUE(constant);
}

TEST(CodegenTables, CarryEarlierNames) {
  App app({{"Main.st", R"(
{attribute 'renamed_from' := 'OldColor'}
TYPE Color : (red, green); END_TYPE
{attribute 'renamed_from' := 'OldPoint'}
TYPE Point : STRUCT
  {attribute 'renamed_from' := 'abscissa'}
  x : LREAL;
  y : LREAL;
END_STRUCT END_TYPE
{attribute 'renamed_from' := 'OldMain'}
PROGRAM Main
VAR
  {attribute 'renamed_from' := 'colour'} color : Color;
  {attribute 'init_on_onlchange'} fresh : INT := 3;
  pt : Point;
END_VAR
VAR_STAT calls : DINT; END_VAR
END_PROGRAM
)"},
           {"GVL.st", R"(
{attribute 'renamed_from' := 'Globals'}
VAR_GLOBAL
  a : INT;
  {attribute 'renamed_from' := 'Other.bb'} b : INT;
END_VAR
)"}});
  const stride::StrideAppV1 &d = app.description();
  const auto root = [&](const char *name) -> const stride::RootDesc & {
    uint32_t i = 0;
    while (i + 1 < d.rootCount && std::strcmp(d.roots[i].name, name) != 0)
      ++i;
    return d.roots[i];
  };
  EXPECT_STREQ(root("Main").renamedFrom, "OldMain");
  EXPECT_STREQ(root("calls").renamedFrom, "OldMain.calls");
  EXPECT_STREQ(root("a").renamedFrom, "Globals.a");
  EXPECT_STREQ(root("b").renamedFrom, "Other.bb");
  const stride::TypeDesc &main = d.types[root("Main").type];
  EXPECT_STREQ(member(d, main, "color")->renamedFrom, "colour");
  EXPECT_EQ(member(d, main, "fresh")->flags, stride::kSymInitOnChange);
  EXPECT_EQ(member(d, main, "fresh")->renamedFrom, nullptr);
  EXPECT_STREQ(d.types[member(d, main, "color")->type].renamedFrom, "OldColor");
  const stride::TypeDesc &point = d.types[member(d, main, "pt")->type];
  EXPECT_STREQ(point.renamedFrom, "OldPoint");
  EXPECT_STREQ(member(d, point, "x")->renamedFrom, "abscissa");
  EXPECT_EQ(member(d, point, "y")->renamedFrom, nullptr);
}

TEST(CodegenTables, LayoutHashesAreStable) {
  const auto hashOf = [](const std::string &fields) {
    const auto files = generate(
        {{"Main.st", "TYPE S : STRUCT " + fields +
                         " END_STRUCT END_TYPE\nPROGRAM Main VAR s : S; END_VAR END_PROGRAM\n"}});
    const std::string header = fileText(files, "st/user/S.h");
    const auto at = header.find("S__layout__ = ");
    return header.substr(at, header.find(';', at) - at);
  };
  const std::string plain = hashOf("a : INT; b : LREAL;");
  EXPECT_EQ(plain, hashOf("A : INT := 5; b : LREAL;")); // defaults and case do not count
  EXPECT_NE(plain, hashOf("b : LREAL; a : INT;"));
  EXPECT_NE(plain, hashOf("a : UINT; b : LREAL;"));
  EXPECT_NE(plain, hashOf("a : INT; c : LREAL;"));
  EXPECT_EQ(hashOf("p : POINTER TO S;"), hashOf("p : POINTER TO S;"));
}

TEST(CodegenTables, LayoutHashesOfBlocksFollowTheirVariables) {
  const auto hashOf = [](const std::string &block, const std::string &base = "k : INT;") {
    const auto files = generate(
        {{"Main.st", "FUNCTION_BLOCK T VAR " + base + " END_VAR END_FUNCTION_BLOCK\n" + block +
                         " END_FUNCTION_BLOCK\nPROGRAM Main\nVAR_TEMP n : "
                         "INT; END_VAR END_PROGRAM\n"}});
    const std::string header = fileText(files, "st/user/S.h");
    const auto at = header.find("S__layout__ = ");
    return at == std::string::npos ? header : header.substr(at, header.find(';', at) - at);
  };
  const std::string plain = hashOf("FUNCTION_BLOCK S VAR a : INT; b : LREAL; END_VAR");
  // What no instance holds does not count.
  EXPECT_EQ(plain, hashOf("FUNCTION_BLOCK S VAR A : INT := 5; b : LREAL; END_VAR VAR_TEMP c : INT; "
                          "END_VAR"));
  EXPECT_NE(plain, hashOf("FUNCTION_BLOCK S VAR b : LREAL; a : INT; END_VAR"));
  EXPECT_NE(plain, hashOf("FUNCTION_BLOCK S VAR a : UINT; b : LREAL; END_VAR"));
  EXPECT_NE(plain, hashOf("FUNCTION_BLOCK S VAR a : INT; c : LREAL; END_VAR"));
  EXPECT_NE(plain, hashOf("FUNCTION_BLOCK S VAR a : INT; b : LREAL; c : INT; END_VAR"));
  EXPECT_NE(plain, hashOf("FUNCTION_BLOCK S VAR a : INT; END_VAR VAR_IN_OUT b : LREAL; END_VAR"));
  EXPECT_NE(plain, hashOf("FUNCTION_BLOCK S EXTENDS T VAR a : INT; b : LREAL; END_VAR"));
  EXPECT_NE(hashOf("FUNCTION_BLOCK S EXTENDS T VAR a : INT; END_VAR"),
            hashOf("FUNCTION_BLOCK S EXTENDS T VAR a : INT; END_VAR", "k : DINT;"));
  EXPECT_NE(hashOf("FUNCTION_BLOCK S VAR a : T; END_VAR"),
            hashOf("FUNCTION_BLOCK S VAR a : T; END_VAR", "k : INT; l : INT;"));
}

TEST(CodegenTables, AnEditTouchesOnlyWhatItMust) {
  const auto build = [](const std::string &body) {
    return generate(
        {{"A.st", "PROGRAM A VAR x : INT; END_VAR\n  x := B.y;\nEND_PROGRAM\n"},
         {"B.st", "PROGRAM B VAR_OUTPUT y : INT; END_VAR\n  " + body + "\nEND_PROGRAM\n"}});
  };
  const auto before = build("y := 1;");
  const auto after = build("y := 2; y := 3;");
  ASSERT_EQ(before.size(), after.size());
  std::string changed;
  for (size_t i = 0; i < before.size(); ++i) {
    if (before[i].text != after[i].text)
      changed += before[i].path + " ";
  }
  EXPECT_EQ(changed, "user/B.cpp build.cpp ");
}

namespace {

/// A block with so many variables, each set to its number.
std::string blockOf(const std::string &head, int variables, const std::string &more = {}) {
  std::string text = head + "\nVAR\n";
  for (int i = 0; i < variables; ++i)
    text += "  v" + std::to_string(i) + (i % 3 == 0 ? " : BOOL := TRUE" : " : LINT := ") +
            (i % 3 == 0 ? "" : std::to_string(i)) + ";\n";
  return text + more + "END_VAR\nEND_FUNCTION_BLOCK\n";
}

} // namespace

// Sizes and offsets of blocks with many variables are in the sources of the blocks. Limits at and
// below; what is no member of the structure, or has no address, keeps a block out.
TEST(CodegenTables, NumbersOfLargeBlocksAreInTheirSources) {
  const auto files = generate(
      {{"Main.st", blockOf("FUNCTION_BLOCK Large", 16) + blockOf("FUNCTION_BLOCK Small", 15) +
                       blockOf("FUNCTION_BLOCK Bits", 16, "bit AT %MX3.1 : BOOL;\n") +
                       blockOf("FUNCTION_BLOCK Unused", 16) + R"(
PROGRAM Main
VAR large : Large; small : Small; bits : Bits; END_VAR
END_PROGRAM
)"}});
  const std::string app = fileText(files, "app.cpp");
  EXPECT_THAT(fileText(files, "user/Large.cpp"), HasSubstr("offsetof(Large, v15)"));
  EXPECT_THAT(app, Not(HasSubstr("user::Large, v")));
  EXPECT_THAT(app, HasSubstr("{::st::user::Large__numbers, 19}"));
  for (const char *name : {"Small", "Bits"}) {
    EXPECT_THAT(fileText(files, std::string("user/") + name + ".cpp"), Not(HasSubstr("offsetof")));
    EXPECT_THAT(app, HasSubstr("offsetof(::st::user::" + std::string(name) + ", v14)"));
  }
  for (const GeneratedFile &file : files)
    EXPECT_EQ(file.tables != 0, file.path == "user/Large.cpp") << file.path;
}

// With a base and a type id: what a path leads to has the value that the
// variable was declared with.
TEST(CodegenTables, NumbersInOtherSourcesAreThoseOfTheMembers) {
  App app({{"Main.st", blockOf("FUNCTION_BLOCK Base", 20) +
                           blockOf("FUNCTION_BLOCK Derived EXTENDS Base IMPLEMENTS IThing", 0,
                                   "a : LINT := 100; b : BOOL := TRUE; "
                                   "c, d, e, f, g, h, i, j, k, l, m, n, "
                                   "o, p : INT := 7; q : LINT := 101;\n") +
                           R"(
INTERFACE IThing END_INTERFACE
PROGRAM Main
VAR base : Base; derived : Derived; one : Base; END_VAR
END_PROGRAM
)"}});
  for (const char *path : {"Main.base", "Main.derived", "Main.one"})
    for (int i = 0; i < 20; ++i)
      EXPECT_EQ(app[std::string(path) + ".v" + std::to_string(i)],
                i % 3 == 0 ? "TRUE" : std::to_string(i))
          << path << i;
  EXPECT_EQ(app["Main.derived.a"], "100");
  EXPECT_EQ(app["Main.derived.b"], "TRUE");
  EXPECT_EQ(app["Main.derived.p"], "7");
  EXPECT_EQ(app["Main.derived.q"], "101");
}

} // namespace stc::test
