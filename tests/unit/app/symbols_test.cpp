#include "tests/unit/app/fixture.hpp"

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Symbols : public stride::test::HandmadeApp {
protected:
  std::vector<std::string> leavesOf(const std::string &path) const {
    std::vector<std::string> names;
    for (const stride::app::Symbol &leaf : symbols.leaves(symbols.resolve(path)))
      names.push_back(leaf.path());
    return names;
  }
  std::string errorFor(const std::string &path) const {
    return errorOf([&] { (void)symbols.resolve(path); });
  }
};

TEST_F(Symbols, PathsAreCaseInsensitive) {
  EXPECT_EQ(read("PLC_PRG.pt.x"), "1.5");
  EXPECT_EQ(read("plc_prg.PT.X"), "1.5");
  EXPECT_EQ(read("PLC_PRG.fb.step"), "1");
  EXPECT_EQ(read("plc_prg.table[1].x"), "1.5");
}

TEST_F(Symbols, ArraysOfSeveralDimensions) {
  write("PLC_PRG.a[3,0]", "7");
  EXPECT_EQ(read("PLC_PRG.a[3][0]"), "7");
  EXPECT_EQ(read("PLC_PRG.a[ 3 , 0 ]"), "7");
  EXPECT_EQ(read("PLC_PRG.a[3,-1]"), "0");
}

TEST_F(Symbols, Globals) {
  EXPECT_EQ(read("GVL.limit"), "100");
  EXPECT_EQ(read("kMax"), "70000");
  EXPECT_THAT(errorFor("limit"), HasSubstr("did you mean"));
}

TEST_F(Symbols, PointersAndInOutsAreFollowedWhenBound) {
  EXPECT_EQ(read("PLC_PRG.p.x"), "null");
  EXPECT_EQ(read("PLC_PRG.fb.total"), "null");
  cycle();
  EXPECT_EQ(read("PLC_PRG.p.x"), "0.1");
  EXPECT_EQ(read("PLC_PRG.p^.y"), "0.0");
  EXPECT_EQ(read("PLC_PRG.fb.total"), "2");
}

TEST_F(Symbols, LeavesAreInDeclarationOrderWithoutHiddenOnes) {
  EXPECT_THAT(leavesOf("PLC_PRG.fb"), ElementsAre("PLC_PRG.fb.step", "PLC_PRG.fb.count"));
  EXPECT_THAT(leavesOf("plc_prg.A"),
              ElementsAre("plc_prg.A[1,-1]", "plc_prg.A[1,0]", "plc_prg.A[2,-1]", "plc_prg.A[2,0]",
                          "plc_prg.A[3,-1]", "plc_prg.A[3,0]"));
  EXPECT_THAT(leavesOf("PLC_PRG.a[2]"), ElementsAre("PLC_PRG.a[2][-1]", "PLC_PRG.a[2][0]"));
  EXPECT_THAT(leavesOf("PLC_PRG.table"), ElementsAre("PLC_PRG.table[0].x", "PLC_PRG.table[0].y",
                                                     "PLC_PRG.table[1].x", "PLC_PRG.table[1].y"));
  EXPECT_THAT(leavesOf("PLC_PRG.p"), ElementsAre());
  EXPECT_THAT(leavesOf("kMax"), ElementsAre("kMax"));
  EXPECT_EQ(read("PLC_PRG.fb.hidden_"), "0") << "hidden, but reachable by name";
}

TEST_F(Symbols, ErrorsNameTheWayOut) {
  EXPECT_EQ(errorFor("PLC_PRG.cuont"),
            "symbol 'PLC_PRG.cuont': PLC_PRG has no member 'cuont'; did you mean 'count'?");
  EXPECT_THAT(errorFor("PLC_PRC.count"), HasSubstr("did you mean 'PLC_PRG'?"));
  EXPECT_THAT(errorFor("quotient"), HasSubstr("did you mean 'PLC_PRG.quotient'?"));
  EXPECT_THAT(errorFor("zzz"), HasSubstr("there are 'GVL.limit', 'kMax', 'total', 'PLC_PRG'"));
  EXPECT_THAT(errorFor("PLC_PRG.a[4,0]"), HasSubstr("index 4 is outside 1..3"));
  EXPECT_THAT(errorFor("PLC_PRG.a[1,0,0]"), HasSubstr("too many indices"));
  EXPECT_THAT(errorFor("PLC_PRG.a[x]"), HasSubstr("an index must be a number"));
  EXPECT_THAT(errorFor("PLC_PRG.a[1"), HasSubstr("']' is missing"));
  EXPECT_THAT(errorFor("PLC_PRG.count.x"), HasSubstr("is of type INT and has no members"));
  EXPECT_THAT(errorFor("PLC_PRG.count^"), HasSubstr("is not a pointer"));
  EXPECT_THAT(errorFor("PLC_PRG."), HasSubstr("a name is missing after 'PLC_PRG.'"));
  EXPECT_THAT(errorFor(""), HasSubstr("a name is missing"));
  EXPECT_THAT(errorFor("PLC_PRG count"), HasSubstr("was not expected"));
}

} // namespace
