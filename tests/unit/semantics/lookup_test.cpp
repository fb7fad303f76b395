// Questions about names that an editor asks: what is visible, what has which members, where is it
// declared, who uses it.
#include "compiler/semantics/lookup/lookup.hpp"
#include "compiler/semantics/lookup/references.hpp"
#include "compiler/syntax/parser.hpp"
#include "tests/support/no_library.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace stc {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// A library with one file, of which `Limit` is seen without the library's name.
class OneLibrary final : public LibraryIndex {
public:
  std::vector<Entry> find(std::string_view lowerName) const override {
    if (lowerName == "limiter" || lowerName == "tlimits")
      return {{"Extra", "<stdlib>/Extra/Limiter.st",
               "FUNCTION_BLOCK Limiter\nVAR_INPUT Limits : TLimits; END_VAR\nEND_FUNCTION_BLOCK\n"
               "TYPE TLimits : STRUCT Low, High : INT; END_STRUCT END_TYPE\n"}};
    return {};
  }
  bool isLibrary(std::string_view lowerName) const override { return lowerName == "extra"; }
  bool answersTo(std::string_view library, std::string_view lowerName) const override {
    return library == "Extra" && lowerName == "extra";
  }
  std::vector<Name> names() const override { return {{"Limiter"}, {"TLimits"}}; }
  std::vector<Entry> files(std::string_view) const override { return find("limiter"); }
};

/// A program of one file, checked, with the table of its names.
class LookupTest : public ::testing::Test {
protected:
  void checkText(std::string text) {
    text_ = std::move(text);
    file_ = program_.sources.add("Main.st", text_);
    ast::File *tree = parse(program_.sources.file(file_), program_.interner, program_.arena,
                            program_.diagnostics);
    check(program_, names_, {tree});
    ASSERT_FALSE(program_.diagnostics.hasErrors());
  }
  /// The offset of the n-th occurrence of the text, counted from 1.
  uint32_t offset(std::string_view what, int n = 1) const {
    size_t at = text_.find(what);
    for (int i = 1; i < n; ++i)
      at = text_.find(what, at + 1);
    EXPECT_NE(at, std::string::npos) << what;
    return static_cast<uint32_t>(at);
  }
  Scope scopeAt(std::string_view what) const {
    const auto scope = names_.scopeAt(file_, offset(what));
    EXPECT_TRUE(scope.has_value());
    return scope.value_or(Scope{});
  }
  Symbol *find(const Scope &scope, std::string_view name) {
    const Ident id = program_.interner.intern(name);
    return names_.find(scope, {id, name, {}}).symbol;
  }
  static std::vector<std::string> namesOf(const std::vector<const Symbol *> &symbols) {
    std::vector<std::string> list;
    for (const Symbol *symbol : symbols)
      list.emplace_back(symbol->name.text);
    return list;
  }
  std::vector<std::string> visibleAt(std::string_view what) const {
    return namesOf(names_.visible(scopeAt(what)));
  }
  /// The offsets at which the symbol is named.
  static std::vector<uint32_t> offsetsOf(const References &references, const Symbol *symbol) {
    std::vector<uint32_t> list;
    for (const References::Use &use : references.of(symbol))
      list.push_back(use.span.begin);
    return list;
  }

  Program program_;
  OneLibrary index_;
  Lookup names_{program_, index_};
  std::string text_;
  FileId file_ = 0;
};

constexpr const char *kBlocks = R"st(
TYPE Colour : (Red, Green); END_TYPE
TYPE Point : STRUCT X, Y : INT; END_STRUCT END_TYPE
TYPE Dot EXTENDS Point : STRUCT C : Colour; END_STRUCT END_TYPE

FUNCTION_BLOCK Base
VAR_OUTPUT Count : INT; END_VAR
METHOD Step : INT
VAR_INPUT Amount : INT; END_VAR
Count := Count + Amount; // in Step
Step := Count;
END_METHOD
PROPERTY Twice : INT
GET
Twice := 2 * Count;
END_GET
END_PROPERTY
END_FUNCTION_BLOCK

FUNCTION_BLOCK Derived EXTENDS Base
VAR_TEMP Scratch : INT; END_VAR
VAR_INPUT Dots : ARRAY [0 .. 3] OF Dot; END_VAR
Scratch := THIS^.Step(Amount := 2); // in Derived
Dots[0].C := Green;
Count := Scratch;
END_FUNCTION_BLOCK

PROGRAM Main
VAR
  Block : Derived;
  Sum : INT;
  Library : Limiter;
END_VAR
Block(); // in Main
Sum := Sum + Block.Count + Block.Twice;
IF Block.Dots[1].C = Colour#Red THEN
  Block.Dots[2].X := Sum;
END_IF
Library.Limits.High := 5;
END_PROGRAM
)st";

TEST_F(LookupTest, KnowsWhatIsVisibleInABody) {
  checkText(kBlocks);
  EXPECT_THAT(visibleAt("// in Main"),
              AllOf(Contains("Block"), Contains("Sum"), Contains("Main"), Contains("Derived"),
                    Contains("Point"), Contains("Green"), Contains("LIMIT"), Not(Contains("Count")),
                    Not(Contains("Amount")), Not(Contains("Scratch"))));
  EXPECT_THAT(visibleAt("// in Derived"),
              AllOf(Contains("Scratch"), Contains("Dots"), Contains("Count"), Contains("Step"),
                    Contains("Twice"), Not(Contains("Amount")), Not(Contains("Sum"))));
  EXPECT_THAT(visibleAt("// in Step"), AllOf(Contains("Amount"), Contains("Step"),
                                             Contains("Count"), Not(Contains("Dots"))));
}

TEST_F(LookupTest, PutsWhatIsNearerFirst) {
  checkText("FUNCTION f : INT\nf := 1;\nEND_FUNCTION\n"
            "PROGRAM Main\nVAR Main2, f : INT; END_VAR\nf := Main2; // here\nEND_PROGRAM\n");
  const Scope scope = scopeAt("// here");
  const auto visible = names_.visible(scope);
  const auto first = std::find_if(visible.begin(), visible.end(),
                                  [](const Symbol *s) { return s->name.text == "f"; });
  ASSERT_NE(first, visible.end());
  EXPECT_EQ((*first)->kind, SymbolKind::Variable);
  EXPECT_EQ(find(scope, "F"), *first);
  EXPECT_EQ(Lookup::declaration(*first)->begin, offset("f : INT; END_VAR"));
}

TEST_F(LookupTest, KnowsMembersWithThoseOfBases) {
  checkText(kBlocks);
  const Scope scope = scopeAt("// in Main");
  const Symbol *block = find(scope, "block");
  ASSERT_NE(block, nullptr);
  EXPECT_THAT(namesOf(names_.members(block)), ElementsAre("Dots", "Count", "Step", "Twice"));
  EXPECT_THAT(namesOf(names_.members(find(scope, "Dot"))), ElementsAre("C", "X", "Y"));
  EXPECT_THAT(namesOf(names_.members(find(scope, "Colour"))), ElementsAre("Red", "Green"));
  EXPECT_THAT(names_.members(find(scope, "sin")), IsEmpty());
}

TEST_F(LookupTest, ReadsLibrariesWhereANameLeadsIntoThem) {
  EXPECT_EQ(names_.findModule("Extra"), nullptr);
  checkText(kBlocks);
  ASSERT_NE(names_.findModule("Extra"), nullptr);
  const Scope scope = scopeAt("// in Main");
  const Symbol *library = find(scope, "Extra");
  ASSERT_NE(library, nullptr);
  EXPECT_EQ(library->kind, SymbolKind::Library);
  EXPECT_THAT(namesOf(names_.members(library)), ElementsAre("Limiter", "TLimits"));
  EXPECT_EQ(Lookup::declaration(library), std::nullopt);
  EXPECT_THAT(names_.libraryNames(),
              Contains(::testing::Field(&LibraryIndex::Name::text, "Limiter")));
  EXPECT_EQ(names_.inLibrary(library->name.id, program_.interner.intern("limiter")),
            find(scope, "Limiter"));
}

TEST_F(LookupTest, KnowsScopesByPlace) {
  EXPECT_EQ(names_.scopeAt(1, 0), std::nullopt);
  checkText(kBlocks);
  EXPECT_EQ(scopeAt("// in Step").pou->name.text, "Step");
  EXPECT_EQ(scopeAt("// in Derived").pou->name.text, "Derived");
  EXPECT_EQ(scopeAt("END_FUNCTION_BLOCK\n\nPROGRAM").pou->name.text, "Derived");
  const Scope type = scopeAt("X, Y");
  EXPECT_EQ(type.pou, nullptr);
  ASSERT_NE(type.home, nullptr);
  EXPECT_EQ(type.home->name.text, "Point");
}

TEST_F(LookupTest, SeesNamespacesAroundAndByUsing) {
  checkText("NAMESPACE Outer\nNAMESPACE Inner\n"
            "FUNCTION f : INT\nf := g(); // in f\nEND_FUNCTION\nEND_NAMESPACE\n"
            "FUNCTION g : INT\ng := 2;\nEND_FUNCTION\nEND_NAMESPACE\n"
            "USING Outer;\n"
            "PROGRAM Main\nVAR n : INT; END_VAR\nn := g() + Outer.Inner.f(); // in Main\n"
            "END_PROGRAM\n");
  EXPECT_THAT(visibleAt("// in f"), AllOf(Contains("f"), Contains("g"), Contains("Outer")));
  EXPECT_THAT(visibleAt("// in Main"), AllOf(Contains("Outer"), Not(Contains("g"))));
  const Scope main = scopeAt("// in Main");
  const Symbol *outer = find(main, "outer");
  ASSERT_NE(outer, nullptr);
  EXPECT_THAT(namesOf(names_.members(outer)), ElementsAre("g", "Inner"));
  EXPECT_EQ(find(main, "g"), find(scopeAt("// in f"), "g"));
  EXPECT_THAT(names_.spaces(scopeAt("// in f")), SizeIs(2));
  EXPECT_THAT(names_.spaces(main), IsEmpty());
}

TEST_F(LookupTest, KnowsWhoUsesWhat) {
  checkText(kBlocks);
  const References references(program_);
  const Scope main = scopeAt("// in Main");
  EXPECT_THAT(offsetsOf(references, find(main, "Sum")),
              ElementsAre(offset("Sum := Sum"), offset("Sum + Block"), offset("Sum;")));
  EXPECT_THAT(offsetsOf(references, find(main, "Block")), SizeIs(5));
  // Types in declarations, enumerators with and without their type.
  EXPECT_THAT(offsetsOf(references, find(main, "Colour")),
              ElementsAre(offset("Colour; END"), offset("Colour#")));
  EXPECT_THAT(offsetsOf(references, find(main, "Base")), ElementsAre(offset("Base\nVAR_TEMP")));
  EXPECT_THAT(offsetsOf(references, find(main, "Point")), ElementsAre(offset("Point : STRUCT C")));
  EXPECT_THAT(offsetsOf(references, find(main, "Limiter")), ElementsAre(offset("Limiter;")));
  const auto *colour = static_cast<const TypeSymbol *>(find(main, "Colour"));
  const EnumeratorSymbol *green =
      findEnumerator(typeAs<EnumType>(colour->type), program_.interner.intern("green"));
  EXPECT_THAT(offsetsOf(references, green), ElementsAre(offset("Green;")));
  // A parameter by its name in a call and in the body.
  const auto *amount = find(scopeAt("// in Step"), "amount");
  EXPECT_THAT(offsetsOf(references, amount),
              ElementsAre(offset("Amount; // in"), offset("Amount := 2")));
  EXPECT_THAT(references.of(nullptr), IsEmpty());
}

TEST_F(LookupTest, KnowsTheNamesInPathsOfTheConfiguration) {
  checkText(R"st(
TYPE Range : STRUCT Low, High : INT; END_STRUCT END_TYPE
VAR_GLOBAL CONSTANT Second : INT := 1; END_VAR
VAR_GLOBAL Limits : Range; END_VAR
FUNCTION_BLOCK Sensor
VAR Raw AT %I* : INT; Scale : INT; END_VAR
Scale := Raw; // in Sensor
END_FUNCTION_BLOCK
PROGRAM Plant
VAR Sensors : ARRAY [0 .. 1] OF Sensor; Own : Range; END_VAR
Sensors[0](); // in Plant
END_PROGRAM
VAR_CONFIG
  Plant.Sensors[0].Raw AT %IW0 : INT;
  Plant.Sensors[Second].Raw AT %IW1 : INT;
  Plant.Sensors[1].Scale : INT := Second + 4;
END_VAR
VAR_ACCESS
  outer : Plant.Own.High : INT READ_ONLY;
  whole : Plant.Own : Range READ_WRITE;
  list : Main.Limits.Low : INT READ_WRITE;
END_VAR
)st");
  const References references(program_);
  const Scope plant = scopeAt("// in Plant");
  const Scope sensor = scopeAt("// in Sensor");
  EXPECT_THAT(offsetsOf(references, find(plant, "Plant")),
              ElementsAre(offset("Plant.Sensors[0]"), offset("Plant.Sensors[Second]"),
                          offset("Plant.Sensors[1]"), offset("Plant.Own.High"),
                          offset("Plant.Own : Range")));
  EXPECT_THAT(offsetsOf(references, find(plant, "Sensors")),
              ElementsAre(offset("Sensors[0](); //"), offset("Sensors[0].Raw"),
                          offset("Sensors[Second]"), offset("Sensors[1].Scale")));
  EXPECT_THAT(offsetsOf(references, find(sensor, "Raw")),
              ElementsAre(offset("Raw; // in"), offset("Raw AT %IW0"), offset("Raw AT %IW1")));
  EXPECT_THAT(offsetsOf(references, find(sensor, "Scale")),
              ElementsAre(offset("Scale := Raw"), offset("Scale : INT := Second")));
  // In an index and in an initial value, too; types of entries are uses as others are.
  EXPECT_THAT(offsetsOf(references, find(plant, "Second")),
              ElementsAre(offset("Second].Raw"), offset("Second + 4")));
  EXPECT_THAT(offsetsOf(references, find(plant, "Own")),
              ElementsAre(offset("Own.High"), offset("Own : Range READ")));
  EXPECT_THAT(offsetsOf(references, find(plant, "Range")),
              ElementsAre(offset("Range; END_VAR\nFUNCTION"), offset("Range; END_VAR\nSensors"),
                          offset("Range READ_WRITE")));
  // The list has the name of its file.
  EXPECT_THAT(offsetsOf(references, find(plant, "Limits")), ElementsAre(offset("Limits.Low")));
  EXPECT_THAT(offsetsOf(references, find(plant, "Main")), ElementsAre(offset("Main.Limits")));
  const Symbol *high = references.at(file_, offset("High : INT READ_ONLY"));
  ASSERT_NE(high, nullptr);
  EXPECT_EQ(high->kind, SymbolKind::Variable);
  EXPECT_THAT(offsetsOf(references, high), ElementsAre(offset("High : INT READ_ONLY")));
  const Symbol *low = references.at(file_, offset("Low : INT READ_WRITE"));
  ASSERT_NE(low, nullptr);
  EXPECT_NE(low, high);
}

TEST_F(LookupTest, KnowsAProgramsOwnVariablesInItsVarAccess) {
  checkText(R"st(
PROGRAM Plant
VAR Count : INT; END_VAR
VAR_ACCESS shown : Count : INT READ_ONLY; END_VAR
Count := Count + 1; // in Plant
END_PROGRAM
)st");
  const References references(program_);
  EXPECT_THAT(
      offsetsOf(references, find(scopeAt("// in Plant"), "Count")),
      ElementsAre(offset("Count : INT READ"), offset("Count := Count"), offset("Count + 1")));
}

TEST_F(LookupTest, KnowsTheNameAtAPlace) {
  checkText(kBlocks);
  const References references(program_);
  const Symbol *sum = find(scopeAt("// in Main"), "Sum");
  EXPECT_EQ(references.at(file_, offset("Sum := Sum")), sum);
  EXPECT_EQ(references.at(file_, offset("Sum := Sum") + 3), sum);
  EXPECT_NE(references.at(file_, offset("Sum := Sum") + 4), sum);
  const Symbol *twice = references.at(file_, offset("Twice;"));
  ASSERT_NE(twice, nullptr);
  EXPECT_EQ(twice->kind, SymbolKind::Property);
  EXPECT_EQ(references.at(file_, 0), nullptr);
  EXPECT_EQ(references.at(file_ + 100, 0), nullptr);
}

TEST_F(LookupTest, FollowsLongSumsWithoutAStack) {
  std::string sum = "n";
  constexpr size_t kTerms = 5000;
  for (size_t i = 1; i < kTerms; ++i)
    sum += " + n";
  checkText("PROGRAM Main\nVAR n : DINT; END_VAR\nn := " + sum + "; // here\nEND_PROGRAM\n");
  const References references(program_);
  EXPECT_THAT(references.of(find(scopeAt("// here"), "n")), SizeIs(kTerms + 1));
}

} // namespace
} // namespace stc
