// The implicit conversions against the dialect's table, worked out independently from the types'
// value ranges.

#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/symbols.hpp"
#include "compiler/semantics/type_table.hpp"

#include <gtest/gtest.h>

#include <string>

namespace stc {
namespace {

struct Number {
  const char *name;
  long double low, high; ///< integers: the value range
  int width;
  bool bitString;
};

const Number kIntegers[] = {
    {"sint", -128.0L, 127.0L, 8, false},
    {"int", -32768.0L, 32767.0L, 16, false},
    {"dint", -2147483648.0L, 2147483647.0L, 32, false},
    {"lint", -9223372036854775808.0L, 9223372036854775807.0L, 64, false},
    {"usint", 0.0L, 255.0L, 8, false},
    {"uint", 0.0L, 65535.0L, 16, false},
    {"udint", 0.0L, 4294967295.0L, 32, false},
    {"ulint", 0.0L, 18446744073709551615.0L, 64, false},
    {"byte", 0.0L, 255.0L, 8, true},
    {"word", 0.0L, 65535.0L, 16, true},
    {"dword", 0.0L, 4294967295.0L, 32, true},
    {"lword", 0.0L, 18446744073709551615.0L, 64, true},
};

const Type *named(const char *name) { return findElementaryType(name); }

TEST(Conversion, IntegersAreFreeExactlyWhenEveryValueSurvives) {
  for (const Number &from : kIntegers) {
    for (const Number &to : kIntegers) {
      const Conversion c = classify(named(from.name), named(to.name));
      const bool survives = from.low >= to.low && from.high <= to.high;
      const std::string what = std::string(from.name) + " to " + to.name;
      if (std::string(from.name) == to.name)
        EXPECT_EQ(c, Conversion::Identity) << what;
      else if (survives)
        EXPECT_EQ(c, Conversion::Free) << what;
      else if (from.width <= to.width)
        EXPECT_EQ(c, Conversion::Lossy) << what;
      else
        EXPECT_EQ(c, Conversion::Narrowing) << what;
    }
  }
}

TEST(Conversion, IntegersGoToRealsThatHoldAllTheirValues) {
  for (const Number &from : kIntegers) {
    EXPECT_EQ(classify(named(from.name), named("real")) == Conversion::Free, from.width <= 24)
        << from.name;
    EXPECT_EQ(classify(named(from.name), named("lreal")) == Conversion::Free, from.width <= 53)
        << from.name;
    EXPECT_EQ(classify(named("real"), named(from.name)), Conversion::Narrowing) << from.name;
    EXPECT_EQ(classify(named("lreal"), named(from.name)), Conversion::Narrowing) << from.name;
  }
  EXPECT_EQ(classify(named("real"), named("lreal")), Conversion::Free);
  EXPECT_EQ(classify(named("lreal"), named("real")), Conversion::Lossy);
}

TEST(Conversion, BoolIsNoNumber) {
  for (const Number &n : kIntegers) {
    EXPECT_EQ(classify(named("bool"), named(n.name)), Conversion::Narrowing) << n.name;
    EXPECT_EQ(classify(named(n.name), named("bool")), Conversion::Narrowing) << n.name;
  }
}

TEST(Conversion, EnumerationsGiveTheirBaseButNotEachOther) {
  TypeSymbol symbol;
  EnumType color{{TypeKind::Enumeration}, named("int"), &symbol, {}};
  EnumType state{{TypeKind::Enumeration}, named("byte"), &symbol, {}};
  EXPECT_EQ(classify(&color, named("int")), Conversion::Free);
  EXPECT_EQ(classify(&color, named("dint")), Conversion::Free);
  EXPECT_EQ(classify(&color, named("word")), Conversion::Free); // SMC_ERROR to WORD
  EXPECT_EQ(classify(&color, named("sint")), Conversion::Narrowing);
  EXPECT_EQ(classify(&color, &state), Conversion::Forbidden);
  EXPECT_EQ(classify(named("int"), &color), Conversion::Lossy);
  EXPECT_EQ(classify(named("bool"), &color), Conversion::Forbidden);
}

TEST(Conversion, ConstantsConvertWhereTheirValueFits) {
  const Type *any = elementaryType(TypeKind::AnyInteger);
  for (const Number &to : kIntegers) {
    for (const int64_t v :
         {-129LL, -128LL, -1LL, 0LL, 1LL, 127LL, 128LL, 255LL, 256LL, 32767LL, 32768LL, 65535LL,
          65536LL, 2147483647LL, 2147483648LL, 4294967295LL, 4294967296LL}) {
      const bool fits =
          static_cast<long double>(v) >= to.low && static_cast<long double>(v) <= to.high;
      EXPECT_EQ(constantFits({ConstKind::Integer, v, 0, {}}, any, named(to.name)), fits)
          << v << " in " << to.name;
    }
  }
  EXPECT_TRUE(constantFits({ConstKind::Integer, 1, 0, {}}, any, named("bool")));
  EXPECT_FALSE(constantFits({ConstKind::Integer, 2, 0, {}}, any, named("bool")));
  EXPECT_TRUE(constantFits({ConstKind::Real, 0, 1e300, {}}, elementaryType(TypeKind::AnyReal),
                           named("lreal")));
  EXPECT_FALSE(constantFits({ConstKind::Real, 0, 1e300, {}}, elementaryType(TypeKind::AnyReal),
                            named("real")));
}

/// At, below and above both ends of each type, smaller ones first and signed ones before unsigned
/// ones.
TEST(Conversion, TheSmallestIntegerThatHoldsAValue) {
  const char *const order[] = {"sint", "usint", "int", "uint", "dint", "udint", "lint"};
  for (const Number &type : kIntegers)
    for (const long double limit : {type.low, type.high})
      for (const long double value : {limit - 1, limit, limit + 1}) {
        if (value < kIntegers[3].low || value > kIntegers[3].high)
          continue;
        const char *expected = nullptr;
        for (const char *name : order)
          for (const Number &one : kIntegers)
            if (expected == nullptr && std::string(one.name) == name && value >= one.low &&
                value <= one.high)
              expected = name;
        EXPECT_EQ(smallestInteger(static_cast<int64_t>(value)), named(expected))
            << static_cast<int64_t>(value);
      }
}

TEST(Conversion, CommonTypeHoldsBothAndIsTheSmallest) {
  for (const Number &a : kIntegers) {
    for (const Number &b : kIntegers) {
      const Type *common = commonNumber(named(a.name), named(b.name));
      const long double low = std::min(a.low, b.low);
      const long double high = std::max(a.high, b.high);
      const bool possible = low >= 0 || high <= 9223372036854775807.0L;
      ASSERT_EQ(common != nullptr, possible) << a.name << " with " << b.name;
      if (common == nullptr)
        continue;
      EXPECT_EQ(common, commonNumber(named(b.name), named(a.name))) << a.name << " with " << b.name;
      const Number *found = nullptr;
      for (const Number &n : kIntegers) {
        if (named(n.name) == common)
          found = &n;
      }
      ASSERT_NE(found, nullptr);
      EXPECT_TRUE(found->low <= low && found->high >= high) << a.name << " with " << b.name;
      for (const Number &n : kIntegers) // no narrower one would do
        EXPECT_FALSE(n.width < found->width && n.low <= low && n.high >= high)
            << a.name << " with " << b.name;
    }
  }
}

TEST(Conversion, ArithmeticWidensTo32Bits) {
  EXPECT_EQ(widened(named("sint")), named("dint"));
  EXPECT_EQ(widened(named("uint")), named("dint"));
  EXPECT_EQ(widened(named("byte")), named("dword"));
  EXPECT_EQ(widened(named("udint")), named("udint"));
  EXPECT_EQ(widened(named("lword")), named("lword"));
  EXPECT_EQ(widened(named("real")), named("real"));
  EXPECT_EQ(commonNumber(named("dint"), named("udint")), named("lint"));
}

} // namespace
} // namespace stc
