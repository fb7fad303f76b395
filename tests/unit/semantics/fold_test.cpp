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

ConstValue integer(std::int64_t v) { return {ConstKind::integer, v, 0, {}}; }
ConstValue real(double v) { return {ConstKind::real, 0, v, {}}; }

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
    const auto ca = integer(static_cast<std::int64_t>(a));
    const auto cb = integer(static_cast<std::int64_t>(b));
    const auto expect = [&](BinaryOp op, Wide value) {
      const auto folded = foldBinary(op, ca, cb, type);
      ASSERT_TRUE(folded.has_value());
      EXPECT_EQ(static_cast<T>(folded->integer), static_cast<T>(value))
          << name << " " << +a << " " << +b;
      // Canonical: the 64-bit pattern is extended as the type says.
      EXPECT_EQ(folded->integer, static_cast<std::int64_t>(static_cast<T>(folded->integer)));
    };
    expect(BinaryOp::add, Wide(a) + Wide(b));
    expect(BinaryOp::subtract, Wide(a) - Wide(b));
    expect(BinaryOp::multiply, static_cast<Wide>(static_cast<UnsignedWide>(Wide(a)) *
                                                 static_cast<UnsignedWide>(Wide(b))));
    if (b != 0) {
      expect(BinaryOp::divide, Wide(a) / Wide(b));
      expect(BinaryOp::modulo, Wide(a) % Wide(b));
    } else {
      EXPECT_FALSE(foldBinary(BinaryOp::divide, ca, cb, type).has_value());
    }
    EXPECT_EQ(foldBinary(BinaryOp::less, ca, cb, type)->integer, a < b);
    EXPECT_EQ(foldBinary(BinaryOp::lessEqual, ca, cb, type)->integer, a <= b);
    EXPECT_EQ(foldBinary(BinaryOp::greater, ca, cb, type)->integer, a > b);
    EXPECT_EQ(foldBinary(BinaryOp::greaterEqual, ca, cb, type)->integer, a >= b);
    EXPECT_EQ(foldBinary(BinaryOp::equal, ca, cb, type)->integer, a == b);
  }
}

TEST(Fold, IntegersWrapAsTheGeneratedCodeDoes) {
  checkType<std::int32_t>("dint");
  checkType<std::uint32_t>("udint");
  checkType<std::int64_t>("lint");
  checkType<std::uint64_t>("ulint");
  checkType<std::uint32_t>("dword");
}

TEST(Fold, UntypedConstantsDoNotWrap) {
  const Type *any = elementaryType(TypeKind::anyInteger);
  const auto max = integer(std::numeric_limits<std::int64_t>::max());
  EXPECT_FALSE(foldBinary(BinaryOp::add, max, integer(1), any).has_value());
  EXPECT_FALSE(foldBinary(BinaryOp::multiply, max, integer(2), any).has_value());
  EXPECT_FALSE(
      foldUnary(ast::UnaryOp::negate, integer(std::numeric_limits<std::int64_t>::min()), any)
          .has_value());
  EXPECT_EQ(foldBinary(BinaryOp::subtract, integer(5), integer(7), any)->integer, -2);
}

TEST(Fold, NotIsCutToTheTypesWidth) {
  EXPECT_EQ(foldUnary(ast::UnaryOp::logicalNot, integer(1), findElementaryType("byte"))->integer,
            0xFE);
  EXPECT_EQ(foldUnary(ast::UnaryOp::logicalNot, integer(1), findElementaryType("bool"))->integer,
            0);
  EXPECT_EQ(foldUnary(ast::UnaryOp::logicalNot, integer(0), findElementaryType("sint"))->integer,
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
  EXPECT_EQ(toInt(1e300, "lint"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(toInt(-1e300, "lint"), std::numeric_limits<std::int64_t>::min());
}

TEST(Fold, RealArithmeticIsRoundedTo32Bits) {
  const auto sum = foldBinary(BinaryOp::add, real(0.1F), real(0.2F), findElementaryType("real"));
  EXPECT_EQ(sum->real, static_cast<double>(0.1F + 0.2F));
  EXPECT_EQ(
      convertConstant(real(0.1), elementaryType(TypeKind::anyReal), findElementaryType("real"))
          ->real,
      static_cast<double>(0.1F));
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
