// Subranges of integers: what is written, and what an online change makes of their values.
#include "carry_fixture.hpp"

#include "runtime/app/condition.hpp"
#include "runtime/app/error.hpp"
#include "runtime/app/retain_image.hpp"
#include "runtime/app/symbols.hpp"
#include "runtime/app/value_text.hpp"

using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace stride::test {

class Subranges : public CarryOverTest {
protected:
  /// The value that a literal writes to the root, or what is said instead.
  static std::string written(Build &build, const char *root, const char *literal) {
    const app::SymbolTable symbols(build.app());
    const app::Symbol symbol = app::resolveWritable(symbols, root);
    try {
      const std::vector<std::byte> value = app::literalBytes(symbols, symbol, literal);
      symbol.write(build.state(), value.data(), value.size());
    } catch (const app::Error &error) {
      return error.what();
    }
    return app::formatLiteral(build.app(), symbols.type(symbol), symbol.address(build.state()));
  }
};

TEST_F(Subranges, LiteralsAtBelowAndAboveTheLimits) {
  a.root("", "n", a.subrange(Kind::INT, -3, 4));
  a.root("", "u", a.subrange(Kind::ULINT, 2, INT64_MAX));
  a.root("", "l", a.subrange(Kind::LINT, INT64_MIN, -1));
  a.root("", "s", a.array(a.subrange(Kind::SINT, -128, 126), 1, 2));
  a.ready();
  EXPECT_EQ(written(a, "n", "-3"), "-3");
  EXPECT_EQ(written(a, "n", "4"), "4");
  EXPECT_EQ(written(a, "n", "INT#16#2"), "2");
  EXPECT_EQ(written(a, "n", "-4"), "-4 is out of range for INT (-3..4)");
  EXPECT_EQ(written(a, "n", "5"), "5 is out of range for INT (-3..4)");
  EXPECT_EQ(written(a, "n", "99999"), "99999 is out of range for INT (-3..4)");
  EXPECT_EQ(a.get<int16_t>(a.at(0)), 2); // the last one that was taken
  EXPECT_EQ(written(a, "u", "2"), "2");
  EXPECT_EQ(written(a, "u", "9223372036854775807"), "9223372036854775807");
  EXPECT_EQ(written(a, "u", "1"), "1 is out of range for ULINT (2..9223372036854775807)");
  EXPECT_THAT(written(a, "u", "9223372036854775808"), HasSubstr("out of range"));
  EXPECT_THAT(written(a, "u", "-1"), HasSubstr("out of range"));
  EXPECT_EQ(written(a, "l", "-9223372036854775808"), "-9223372036854775808");
  EXPECT_EQ(written(a, "l", "-1"), "-1");
  EXPECT_THAT(written(a, "l", "0"), HasSubstr("out of range"));
  EXPECT_THAT(written(a, "l", "9223372036854775808"), HasSubstr("out of range"));
  EXPECT_EQ(written(a, "s[2]", "126"), "126");
  EXPECT_EQ(written(a, "s[2]", "127"), "127 is out of range for SINT (-128..126)");
}

TEST_F(Subranges, PointersAndReferencesToThem) {
  const ModelType *gear = a.subrange(Kind::INT, 1, 4);
  a.root("", "n", gear);
  a.root("", "r", a.pointer(gear, Kind::Reference));
  a.ready();
  a.set(a.at(1), a.address(a.at(0)));
  EXPECT_EQ(written(a, "r", "4"), "4");
  EXPECT_EQ(written(a, "r", "5"), "5 is out of range for INT (1..4)");
  EXPECT_EQ(a.get<int16_t>(a.at(0)), 4);
}

TEST_F(Subranges, ComparisonsTakeAnyValueOfTheBaseType) {
  a.root("", "n", a.subrange(Kind::INT, 1, 4));
  a.ready();
  const app::SymbolTable symbols(a.app());
  const app::Symbol n = app::resolveElementary(symbols, "n");
  EXPECT_EQ(app::comparedBytes(symbols, n, "5").size(), 2U); // n < 5
  EXPECT_THROW(static_cast<void>(app::comparedBytes(symbols, n, "99999")), app::Error);
}

TEST_F(Subranges, OnlineChangeKeepsWhatTheNewRangeHolds) {
  a.root("", "same", a.subrange(Kind::INT, 1, 4));
  b.root("", "same", b.subrange(Kind::INT, 1, 4));
  a.root("", "wider", a.subrange(Kind::INT, 1, 4));
  b.root("", "wider", b.subrange(Kind::INT, 0, 4));
  a.root("", "free", a.subrange(Kind::INT, 1, 4));
  b.root("", "free", b.elementary(Kind::INT));
  a.root("", "other", a.subrange(Kind::INT, 1, 4));
  b.root("", "other", b.subrange(Kind::DINT, 1, 4));
  a.ready();
  b.ready();
  for (size_t i = 0; i < 4; ++i)
    a.set<int16_t>(a.at(i), static_cast<int16_t>(i + 1));
  const std::string text = apply();
  EXPECT_EQ(b.get<int16_t>(b.at(0)), 1);
  EXPECT_EQ(b.get<int16_t>(b.at(1)), 2);
  EXPECT_EQ(b.get<int16_t>(b.at(2)), 3);
  EXPECT_EQ(b.get<int32_t>(b.at(3)), 4);
  EXPECT_THAT(words, ElementsAre());
  EXPECT_THAT(text, HasSubstr("4 values are carried over, none is lost"));
}

TEST_F(Subranges, OnlineChangeStartsAnewWhatIsOutside) {
  a.root("", "n", a.array(a.elementary(Kind::INT), 0, 5));
  b.root("", "n", b.array(b.subrange(Kind::INT, -1, 3), 0, 5));
  a.root("", "low", a.subrange(Kind::INT, 0, 9));
  b.root("", "low", b.subrange(Kind::INT, 1, 9));
  a.root("", "high", a.subrange(Kind::INT, 0, 9));
  b.root("", "high", b.subrange(Kind::DINT, 0, 8));
  a.ready();
  b.ready();
  const int16_t values[] = {-2, -1, 0, 3, 4, 2};
  for (uint64_t k = 0; k < 6; ++k) {
    a.set<int16_t>(2 * k, values[k]);
    b.set<int16_t>(2 * k, 1);
  }
  a.set<int16_t>(a.at(1), 0);
  b.set<int16_t>(b.at(1), 5);
  a.set<int16_t>(a.at(2), 9);
  b.set<int32_t>(b.at(2), 6);
  const std::string text = apply();
  const int16_t expected[] = {1, -1, 0, 3, 1, 2};
  for (uint64_t k = 0; k < 6; ++k)
    EXPECT_EQ(b.get<int16_t>(2 * k), expected[k]) << k;
  EXPECT_EQ(b.get<int16_t>(b.at(1)), 5);
  EXPECT_EQ(b.get<int32_t>(b.at(2)), 6);
  EXPECT_THAT(words, ElementsAre("n[0]: -2 is out of range for INT (-1..3); it starts anew",
                                 "n[4]: 4 is out of range for INT (-1..3); it starts anew",
                                 "low: 0 is out of range for INT (1..9); it starts anew",
                                 "high: 9 is out of range for DINT (0..8); it starts anew"));
  EXPECT_THAT(text, HasSubstr("values lost: n[0] : INT -> INT (-1..3) (those outside of -1..3) in "
                              "6 places"));
  EXPECT_EQ(result.outOfRange(), 4U);
}

TEST_F(Subranges, PointersOfTheBaseTypeFollow) {
  a.root("", "before", a.elementary(Kind::DINT)); // the variable moves
  const auto build = [](Build &to, int64_t high) {
    to.root("", "n", to.array(to.subrange(Kind::INT, 0, high), 0, 3));
    to.root("", "p", to.pointer(to.elementary(Kind::INT)));
    to.root("", "end", to.pointer(to.elementary(Kind::INT)));
  };
  build(a, 9);
  build(b, 5);
  a.ready();
  b.ready();
  a.set(a.at(2), a.address(a.at(1) + 4));
  a.set(a.at(3), a.address(a.at(1) + 8));
  apply();
  EXPECT_EQ(b.get<uint64_t>(b.at(1)), b.address(b.at(0) + 4));
  EXPECT_EQ(b.get<uint64_t>(b.at(2)), b.address(b.at(0) + 8));
  EXPECT_THAT(words, ElementsAre());
}

TEST_F(Subranges, RetainedValuesOutsideAreNotRestored) {
  const auto build = [](Build &to) {
    to.root("", "n", to.array(to.subrange(Kind::INT, 1, 4), 0, 3), kSymPersistent);
    to.ready();
  };
  build(a);
  build(b);
  const int16_t stored[] = {0, 1, 4, 5};
  for (uint64_t k = 0; k < 4; ++k) {
    a.set<int16_t>(2 * k, stored[k]);
    b.set<int16_t>(2 * k, 2);
  }
  const app::RetainLayout layout(a.app(), app::kRetained);
  std::vector<std::byte> values(layout.bytes());
  app::copyRetained(a.state(), layout.ranges(), values.data());
  const app::RetainImage image =
      app::decodeImage(app::encodeImage({"model", 0, 1}, layout.encode(), values));
  const app::RetainLayout own(b.app(), app::kRetained);
  EXPECT_TRUE(image.layout.sameAs(own));
  const app::RetainReport report = app::RetainRestore(b.app(), own, image).apply(b.state());
  const int16_t expected[] = {2, 1, 4, 2};
  for (uint64_t k = 0; k < 4; ++k)
    EXPECT_EQ(b.get<int16_t>(2 * k), expected[k]) << k;
  EXPECT_EQ(report.kept, 2U);
  EXPECT_THAT(report.lost, ElementsAre("n[0]: 0 is out of range for INT (1..4); it starts anew",
                                       "n[3]: 5 is out of range for INT (1..4); it starts anew"));
}

TEST_F(Subranges, DamagedDescriptionsAreRefused) {
  a.root("", "n", a.subrange(Kind::INT, 4, 3));
  EXPECT_THROW(a.ready(), app::Error);
  b.root("", "n", b.subrange(Kind::REAL, 0, 1));
  EXPECT_THROW(b.ready(), app::Error);
}

} // namespace stride::test
