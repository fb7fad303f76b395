// Constant arithmetic against the hardware's.

#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/type_table.hpp"
#include "compiler/source/suggest.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace stc {
namespace {

using ast::BinaryOp;

ConstValue integer(int64_t v) { return {ConstKind::Integer, v, 0, {}}; }
ConstValue real(double v) { return {ConstKind::Real, 0, v, {}}; }

/// Checks +, -, *, /, MOD and the comparisons on random and extreme operands of one C++ type.
template <class T> void checkType(const char *name) {
  const Type *type = findElementaryType(name);
  std::mt19937_64 random(7);
  const auto pick = [&]() -> T {
    switch (random() % 6) {
    case 0:
      return std::numeric_limits<T>::min();
    case 1:
      return std::numeric_limits<T>::max();
    case 2:
      return static_cast<T>(random() % 5);
    case 3:
      return static_cast<T>(-1);
    default:
      return static_cast<T>(random());
    }
  };
  __extension__ using Wide = __int128;
  __extension__ using UnsignedWide = unsigned __int128;
  for (int i = 0; i < 20000; ++i) {
    const T a = pick();
    const T b = pick();
    const auto ca = integer(static_cast<int64_t>(a));
    const auto cb = integer(static_cast<int64_t>(b));
    const auto expect = [&](BinaryOp op, Wide value) {
      const auto folded = foldBinary(op, ca, cb, type);
      ASSERT_TRUE(folded.has_value());
      EXPECT_EQ(static_cast<T>(folded->integer), static_cast<T>(value))
          << name << " " << +a << " " << +b;
      // Canonical: the 64-bit pattern is extended as the type says.
      EXPECT_EQ(folded->integer, static_cast<int64_t>(static_cast<T>(folded->integer)));
    };
    expect(BinaryOp::Add, Wide(a) + Wide(b));
    expect(BinaryOp::Subtract, Wide(a) - Wide(b));
    expect(BinaryOp::Multiply, static_cast<Wide>(static_cast<UnsignedWide>(Wide(a)) *
                                                 static_cast<UnsignedWide>(Wide(b))));
    if (b != 0) {
      expect(BinaryOp::Divide, Wide(a) / Wide(b));
      expect(BinaryOp::Modulo, Wide(a) % Wide(b));
    } else {
      EXPECT_FALSE(foldBinary(BinaryOp::Divide, ca, cb, type).has_value());
    }
    EXPECT_EQ(foldBinary(BinaryOp::Less, ca, cb, type)->integer, a < b);
    EXPECT_EQ(foldBinary(BinaryOp::LessEqual, ca, cb, type)->integer, a <= b);
    EXPECT_EQ(foldBinary(BinaryOp::Greater, ca, cb, type)->integer, a > b);
    EXPECT_EQ(foldBinary(BinaryOp::GreaterEqual, ca, cb, type)->integer, a >= b);
    EXPECT_EQ(foldBinary(BinaryOp::Equal, ca, cb, type)->integer, a == b);
  }
}

TEST(Fold, IntegersWrapAsTheGeneratedCodeDoes) {
  checkType<int32_t>("dint");
  checkType<uint32_t>("udint");
  checkType<int64_t>("lint");
  checkType<uint64_t>("ulint");
  checkType<uint32_t>("dword");
}

TEST(Fold, UntypedConstantsDoNotWrap) {
  const Type *any = elementaryType(TypeKind::AnyInteger);
  const auto max = integer(std::numeric_limits<int64_t>::max());
  EXPECT_FALSE(foldBinary(BinaryOp::Add, max, integer(1), any).has_value());
  EXPECT_FALSE(foldBinary(BinaryOp::Multiply, max, integer(2), any).has_value());
  EXPECT_FALSE(foldUnary(ast::UnaryOp::Negate, integer(std::numeric_limits<int64_t>::min()), any)
                   .has_value());
  EXPECT_EQ(foldBinary(BinaryOp::Subtract, integer(5), integer(7), any)->integer, -2);
}

TEST(Fold, NotIsCutToTheTypesWidth) {
  EXPECT_EQ(foldUnary(ast::UnaryOp::LogicalNot, integer(1), findElementaryType("byte"))->integer,
            0xFE);
  EXPECT_EQ(foldUnary(ast::UnaryOp::LogicalNot, integer(1), findElementaryType("bool"))->integer,
            0);
  EXPECT_EQ(foldUnary(ast::UnaryOp::LogicalNot, integer(0), findElementaryType("sint"))->integer,
            -1);
}

TEST(Fold, RealsRoundHalfAwayFromZeroAndSaturate) {
  const auto toInt = [](double v, const char *to) {
    return convertConstant(real(v), findElementaryType("lreal"), findElementaryType(to))->integer;
  };
  EXPECT_EQ(toInt(2.5, "int"), 3);
  EXPECT_EQ(toInt(-2.5, "int"), -3);
  EXPECT_EQ(toInt(2.4999999999999996, "int"), 2);
  EXPECT_EQ(toInt(1e9, "int"), 32767);
  EXPECT_EQ(toInt(-1e9, "int"), -32768);
  EXPECT_EQ(toInt(65536.0, "uint"), 65535);
  EXPECT_EQ(toInt(-1.0, "uint"), 0);
  EXPECT_EQ(toInt(std::numeric_limits<double>::quiet_NaN(), "dint"), 0);
  EXPECT_EQ(toInt(1e300, "lint"), std::numeric_limits<int64_t>::max());
  EXPECT_EQ(toInt(-1e300, "lint"), std::numeric_limits<int64_t>::min());
}

TEST(Fold, RealArithmeticIsRoundedTo32Bits) {
  const auto sum = foldBinary(BinaryOp::Add, real(0.1F), real(0.2F), findElementaryType("real"));
  EXPECT_EQ(sum->real, static_cast<double>(0.1F + 0.2F));
  EXPECT_EQ(
      convertConstant(real(0.1), elementaryType(TypeKind::AnyReal), findElementaryType("real"))
          ->real,
      static_cast<double>(0.1F));
}

TEST(Fold, TextsCompareByTheirUnits) {
  const std::vector<std::string_view> rising = {"", "A", "AB", "B", "a", "\u00E4"};
  for (const char *name : {"string", "wstring"}) {
    const Type *type = findElementaryType(name);
    for (size_t i = 0; i < rising.size(); ++i) {
      for (size_t k = 0; k < rising.size(); ++k) {
        const ConstValue a{ConstKind::String, 0, 0, rising[i]};
        const ConstValue b{ConstKind::String, 0, 0, rising[k]};
        const auto folded = [&](BinaryOp op) { return foldBinary(op, a, b, type)->integer; };
        EXPECT_EQ(folded(BinaryOp::Equal), i == k) << i << ' ' << k;
        EXPECT_EQ(folded(BinaryOp::NotEqual), i != k) << i << ' ' << k;
        EXPECT_EQ(folded(BinaryOp::Less), i < k) << i << ' ' << k;
        EXPECT_EQ(folded(BinaryOp::LessEqual), i <= k) << i << ' ' << k;
        EXPECT_EQ(folded(BinaryOp::Greater), i > k) << i << ' ' << k;
        EXPECT_EQ(folded(BinaryOp::GreaterEqual), i >= k) << i << ' ' << k;
      }
    }
  }
}

TEST(Suggest, FindsTheNearestNameWithinAThird) {
  const std::vector<std::string_view> names = {"velocity", "position", "Accel", "x"};
  EXPECT_EQ(nearest("velocty", names), "velocity");
  EXPECT_EQ(nearest("POSITION", names), "position");
  EXPECT_EQ(nearest("postiion", names), "position");
  EXPECT_EQ(nearest("torque", names), "");
}

} // namespace
} // namespace stc
