// Conditions on variables.
#include "runtime/app/condition.hpp"
#include "tests/unit/app/fixture.hpp"

namespace {

using namespace stride::app;
using ::testing::HasSubstr;

class Conditions : public stride::test::HandmadeApp {
protected:
  bool holds(const std::string &path, Relation relation, const std::string &literal) const {
    const Symbol symbol = resolveElementary(symbols, path);
    return Comparison(symbols, symbol, relation, literalBytes(symbols, symbol, literal))
        .holds(application.state());
  }
};

TEST_F(Conditions, EveryRelation) {
  write("PLC_PRG.count", "5");
  const auto all = [&](const char *literal) {
    std::string text;
    for (const Relation relation : {Relation::Equal, Relation::NotEqual, Relation::Less,
                                    Relation::LessEqual, Relation::Greater, Relation::GreaterEqual})
      text += holds("PLC_PRG.count", relation, literal) ? '1' : '0';
    return text;
  };
  EXPECT_EQ(all("5"), "100101");
  EXPECT_EQ(all("6"), "011100");
  EXPECT_EQ(all("-6"), "010011");
}

TEST_F(Conditions, EveryKindOfValue) {
  EXPECT_TRUE(holds("PLC_PRG.name", Relation::Equal, "'it$'s'"));
  EXPECT_TRUE(holds("PLC_PRG.name", Relation::Greater, "'it'"));
  EXPECT_TRUE(holds("PLC_PRG.name", Relation::Less, "'j'"));
  EXPECT_TRUE(holds("PLC_PRG.color", Relation::Equal, "green"));
  EXPECT_TRUE(holds("PLC_PRG.color", Relation::Less, "Color#blue"));
  EXPECT_TRUE(holds("PLC_PRG.t", Relation::GreaterEqual, "T#1s500ms"));
  EXPECT_TRUE(holds("PLC_PRG.flag", Relation::Equal, "FALSE"));
  EXPECT_TRUE(holds("PLC_PRG.pt.x", Relation::Less, "1.6"));
  write("PLC_PRG.flag", "TRUE");
  EXPECT_TRUE(holds("PLC_PRG.flag", Relation::Greater, "FALSE"));
}

TEST_F(Conditions, WhatCannotBeReachedHoldsNever) {
  EXPECT_FALSE(holds("PLC_PRG.p.x", Relation::Equal, "0"));
  EXPECT_FALSE(holds("PLC_PRG.p.x", Relation::NotEqual, "0"));
}

TEST_F(Conditions, Joined) {
  for (int bits = 0; bits < 8; ++bits) {
    write("PLC_PRG.flag", (bits & 1) != 0 ? "TRUE" : "FALSE");
    write("PLC_PRG.count", (bits & 2) != 0 ? "1" : "0");
    write("total", (bits & 4) != 0 ? "1" : "0");
    const auto comparison = [&](const char *path, const char *literal) {
      const Symbol symbol = resolveElementary(symbols, path);
      return Comparison(symbols, symbol, Relation::Equal, literalBytes(symbols, symbol, literal));
    };
    Condition condition; // flag OR NOT (count = 1 AND total = 1)
    condition.add(comparison("PLC_PRG.flag", "TRUE"));
    condition.add(comparison("PLC_PRG.count", "1"));
    condition.add(comparison("total", "1"));
    condition.addAnd();
    condition.addNot();
    condition.addOr();
    EXPECT_EQ(condition.holds(application.state()), (bits & 1) != 0 || (bits & 6) != 6) << bits;
  }
}

TEST_F(Conditions, NamesAreChecked) {
  EXPECT_THAT(errorOf([&] { (void)resolveElementary(symbols, "PLC_PRG.pt"); }),
              HasSubstr("name one of its parts, for example 'PLC_PRG.pt.x'"));
  EXPECT_THAT(errorOf([&] { (void)resolveElementary(symbols, "PLC_PRG.p"); }),
              HasSubstr("has no value"));
  EXPECT_THAT(errorOf([&] { (void)resolveWritable(symbols, "kMax"); }),
              HasSubstr("it is a constant"));
}

} // namespace
