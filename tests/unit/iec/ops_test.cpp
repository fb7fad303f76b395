// Integer semantics at the limits, conversions, checks.
#include "runtime/iec/ops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace {

using namespace stride;

/// What a check raised; thrown by the test's host.
struct Raised {
  ExceptionCode code;
  std::string file;
  uint32_t line;
  uint32_t col;
  std::string detail;
};

const HostApi kHost = {
    sizeof(HostApi),
    0,
    nullptr,
    [](Ctx *, ExceptionCode code, const char *file, uint32_t line, uint32_t col,
       const char *detail) {
      throw Raised{code, file, line, col, detail != nullptr ? detail : ""};
    },
    [](Ctx *) -> int64_t { return 0; },
    [](Ctx *, uint32_t, const char *) {},
};

Ctx makeContext() {
  Ctx ctx{};
  ctx.host = &kHost;
  return ctx;
}

template <class F> Raised raisedBy(F f) {
  try {
    f();
  } catch (const Raised &raised) {
    return raised;
  }
  return {ExceptionCode::None, "", 0, 0, ""};
}

constexpr DINT kMin = std::numeric_limits<DINT>::min();
constexpr DINT kMax = std::numeric_limits<DINT>::max();
constexpr LINT kLongMin = std::numeric_limits<LINT>::min();

TEST(Integers, WrapAround) {
  EXPECT_EQ(wrapAdd<DINT>(kMax, 1), kMin);
  EXPECT_EQ(wrapSub<DINT>(kMin, 1), kMax);
  EXPECT_EQ(wrapMul<DINT>(kMin, -1), kMin);
  EXPECT_EQ(wrapNeg<SINT>(-128), -128);
  EXPECT_EQ(wrapAdd<USINT>(255, 1), 0);
  EXPECT_EQ(wrapMul<UINT>(65535, 65535), 1);
}

TEST(Integers, DivisionAndModulo) {
  Ctx ctx = makeContext();
  EXPECT_EQ(divide<DINT>(ctx, kMin, -1, "a.st", 1, 1), kMin);
  EXPECT_EQ(modulo<DINT>(ctx, kMin, -1, "a.st", 1, 1), 0);
  EXPECT_EQ(divide<LINT>(ctx, kLongMin, -1, "a.st", 1, 1), kLongMin);
  EXPECT_EQ(modulo<SINT>(ctx, -128, -1, "a.st", 1, 1), 0);
  EXPECT_EQ(divide<DINT>(ctx, -7, 2, "a.st", 1, 1), -3);
  EXPECT_EQ(modulo<DINT>(ctx, -7, 2, "a.st", 1, 1), -1);
  EXPECT_EQ(modulo<UDINT>(ctx, 7, 4, "a.st", 1, 1), 3U);
  const Raised raised = raisedBy([&] { divide<DINT>(ctx, 1, 0, "a.st", 12, 5); });
  EXPECT_EQ(raised.code, ExceptionCode::DivisionByZero);
  EXPECT_EQ(raised.file, "a.st");
  EXPECT_EQ(raised.line, 12U);
  EXPECT_EQ(raised.col, 5U);
  EXPECT_EQ(raisedBy([&] { modulo<USINT>(ctx, 1, 0, "a.st", 1, 1); }).code,
            ExceptionCode::DivisionByZero);
}

TEST(Integers, Power) {
  EXPECT_EQ(power<DINT>(2, 30), 1 << 30);
  EXPECT_EQ(power<DINT>(2, 32), 0);
  EXPECT_EQ(power<DINT>(0, 0), 1);
  EXPECT_EQ(power<DINT>(-1, -3), -1);
  EXPECT_EQ(power<DINT>(-1, -4), 1);
  EXPECT_EQ(power<DINT>(1, -3), 1);
  EXPECT_EQ(power<UDINT>(1, -4), 1U);
  EXPECT_EQ(power<UDINT>(UINT32_MAX, -1), 0U) << "which has no sign";
  EXPECT_EQ(power<DINT>(5, -1), 0);
  EXPECT_EQ(power<LINT>(3, 39), 4052555153018976267);
}

TEST(Shifts, AnyCount) {
  EXPECT_EQ(shl<BYTE>(0xFF, 4), 0xF0);
  EXPECT_EQ(shl<BYTE>(0xFF, 8), 0);
  EXPECT_EQ(shl<LWORD>(1, 63), 0x8000000000000000U);
  EXPECT_EQ(shl<LWORD>(1, 64), 0U);
  EXPECT_EQ(shl<DWORD>(1, 1000), 0U);
  EXPECT_EQ(shl<DWORD>(1, -1), 0U);
  EXPECT_EQ(shr<INT>(-8, 1), -4);
  EXPECT_EQ(shr<INT>(-8, 16), -1);
  EXPECT_EQ(shr<WORD>(0x8000, 15), 1);
  EXPECT_EQ(shr<WORD>(0x8000, 16), 0);
  EXPECT_EQ(rol<BYTE>(0x81, 1), 0x03);
  EXPECT_EQ(rol<BYTE>(0x81, 9), 0x03);
  EXPECT_EQ(rol<BYTE>(0x81, 8), 0x81);
  EXPECT_EQ(ror<WORD>(0x0001, 1), 0x8000);
  EXPECT_EQ(ror<LWORD>(1, 0), 1U);
  EXPECT_EQ(ror<LWORD>(1, 65), 0x8000000000000000U);
  EXPECT_EQ(rol<DINT>(kMin, 1), 1);
}

TEST(Bits, GetAndSet) {
  WORD w = 0x8001;
  EXPECT_EQ(getBit(w, 15), 1);
  EXPECT_EQ(getBit(w, 14), 0);
  setBit(w, 15, 0);
  setBit(w, 3, 1);
  EXPECT_EQ(w, 0x0009);
  INT i = 0;
  setBit(i, 15, 1);
  EXPECT_EQ(i, -32768);
}

TEST(Selection, Functions) {
  EXPECT_EQ(abs<DINT>(kMin), kMin);
  EXPECT_EQ(abs<SINT>(-5), 5);
  EXPECT_FALSE(std::signbit(abs<LREAL>(-0.0)));
  EXPECT_EQ(limit<INT>(-10, 50, 10), 10);
  EXPECT_EQ(limit<INT>(-10, -50, 10), -10);
  EXPECT_EQ(sel<INT>(0, 1, 2), 1);
  EXPECT_EQ(sel<INT>(1, 1, 2), 2);
}

TEST(Conversions, RealToInteger) {
  EXPECT_EQ(convert<INT>(2.5), 3);
  EXPECT_EQ(convert<INT>(-2.5), -3);
  EXPECT_EQ(convert<INT>(2.4999), 2);
  EXPECT_EQ(convert<INT>(0.49999999999999994), 0); // x + 0.5 would round to 1
  EXPECT_EQ(convert<LINT>(4503599627370497.5), 4503599627370498);
  EXPECT_EQ(convert<INT>(1e10), 32767);
  EXPECT_EQ(convert<INT>(-1e10), -32768);
  EXPECT_EQ(convert<UINT>(-0.6), 0);
  EXPECT_EQ(convert<USINT>(255.5), 255);
  EXPECT_EQ(convert<LINT>(1e30), std::numeric_limits<LINT>::max());
  EXPECT_EQ(convert<LINT>(-1e30), kLongMin);
  EXPECT_EQ(convert<ULINT>(1.5e19), 15000000000000000000U);
  EXPECT_EQ(convert<ULINT>(1e30), std::numeric_limits<ULINT>::max());
  EXPECT_EQ(convert<DINT>(std::nan("")), 0);
  EXPECT_EQ(convert<DINT>(std::numeric_limits<double>::infinity()), kMax);
  EXPECT_EQ(convert<INT>(2.5F), 3);
  EXPECT_EQ(truncate<DINT>(2.9), 2);
  EXPECT_EQ(truncate<DINT>(-2.9), -2);
  EXPECT_EQ(truncate<DINT>(1e12), kMax);
}

/// At, below and above the limits of 64 bits: the numbers next to them are 1024 or 2048 away.
TEST(Conversions, RealToIntegerAtTheLimits) {
  constexpr LREAL k2To63 = 9223372036854775808.0;
  constexpr LREAL k2To64 = 2 * k2To63;
  const LREAL below63 = std::nextafter(k2To63, 0.0);
  EXPECT_EQ(convert<LINT>(below63), INT64_MAX - 1023);
  EXPECT_EQ(convert<LINT>(k2To63), INT64_MAX);
  EXPECT_EQ(convert<LINT>(std::nextafter(k2To63, HUGE_VAL)), INT64_MAX);
  EXPECT_EQ(convert<LINT>(-below63), INT64_MIN + 1024);
  EXPECT_EQ(convert<LINT>(-k2To63), INT64_MIN);
  EXPECT_EQ(convert<LINT>(std::nextafter(-k2To63, -HUGE_VAL)), INT64_MIN);
  EXPECT_EQ(convert<ULINT>(below63), (uint64_t{1} << 63) - 1024);
  EXPECT_EQ(convert<ULINT>(k2To63), uint64_t{1} << 63);
  EXPECT_EQ(convert<ULINT>(std::nextafter(k2To64, 0.0)), UINT64_MAX - 2047);
  EXPECT_EQ(convert<ULINT>(k2To64), UINT64_MAX);
  EXPECT_EQ(convert<DINT>(k2To63), INT32_MAX);
  EXPECT_EQ(convert<DINT>(2147483647.4), INT32_MAX);
  EXPECT_EQ(convert<DINT>(2147483646.5), INT32_MAX);
  EXPECT_EQ(convert<DINT>(2147483646.4), INT32_MAX - 1);
  EXPECT_EQ(truncate<DINT>(-2147483648.9), INT32_MIN);
}

TEST(Conversions, IntegersWrap) {
  EXPECT_EQ(convert<SINT>(DINT{200}), -56);
  EXPECT_EQ(convert<UINT>(DINT{-1}), 65535);
  EXPECT_EQ(convert<DINT>(ULINT{0x100000005U}), 5);
  EXPECT_EQ(convert<LREAL>(ULINT{18446744073709551615U}), 18446744073709551616.0);
}

TEST(Conversions, Kinds) {
  EXPECT_EQ((convert<Kind::BOOL, Kind::INT>(256)), 1);
  EXPECT_EQ((convert<Kind::BOOL, Kind::LREAL>(0.25)), 1);
  EXPECT_EQ((convert<Kind::INT, Kind::BOOL>(1)), 1);
  EXPECT_EQ((convert<Kind::LREAL, Kind::TIME>(1500)), 1500.0);
  EXPECT_EQ((convert<Kind::TIME, Kind::LREAL>(1499.5)), 1500U);
  EXPECT_EQ((convert<Kind::LTIME, Kind::TIME>(1500)), 1500000000);
  EXPECT_EQ((convert<Kind::TIME, Kind::LTIME>(1999999)), 1U);
  EXPECT_EQ((convert<Kind::DATE, Kind::DT>(86400U * 10 + 5)), 86400U * 10);
  EXPECT_EQ((convert<Kind::TOD, Kind::DT>(86400U * 10 + 5)), 5000U);
  EXPECT_EQ((convert<Kind::LDT, Kind::DT>(1)), 1000000000);
  EXPECT_EQ((convert<Kind::DT, Kind::LDT>(1999999999)), 1U);
  EXPECT_EQ((convert<Kind::LDATE, Kind::LDT>(-1)), -86400000000000);
  EXPECT_EQ((convert<Kind::DWORD, Kind::DATE>(86400)), 86400U);
}

TEST(Checks, Index) {
  Ctx ctx = makeContext();
  EXPECT_EQ((index<-3, 4>(ctx, INT{-3}, "a.st", 1, 1)), 0U);
  EXPECT_EQ((index<-3, 4>(ctx, INT{4}, "a.st", 1, 1)), 7U);
  const Raised low = raisedBy([&] { index<-3, 4>(ctx, INT{-4}, "a.st", 2, 3); });
  EXPECT_EQ(low.code, ExceptionCode::IndexOutOfRange);
  EXPECT_EQ(low.detail, "index -4 is outside -3..4");
  EXPECT_EQ(raisedBy([&] { index<0, 9>(ctx, ULINT{1} << 63, "a.st", 1, 1); }).code,
            ExceptionCode::IndexOutOfRange);
  EXPECT_EQ(raisedBy([&] { index<-1, 9>(ctx, ~ULINT{0}, "a.st", 1, 1); }).code,
            ExceptionCode::IndexOutOfRange);
  EXPECT_EQ(index(ctx, INT{5}, 5, 9, "a.st", 1, 1), 0U);
  EXPECT_EQ(raisedBy([&] { index(ctx, INT{10}, 5, 9, "a.st", 1, 1); }).code,
            ExceptionCode::IndexOutOfRange);
  EXPECT_EQ(place<5>(INT{7}), 2U);
}

TEST(Checks, PointersRangesLoops) {
  Ctx ctx = makeContext();
  INT value = 5;
  EXPECT_EQ(&deref(ctx, &value, "a.st", 1, 1), &value);
  EXPECT_EQ(raisedBy([&] { deref(ctx, static_cast<INT *>(nullptr), "a.st", 1, 1); }).code,
            ExceptionCode::NullPointer);
  EXPECT_EQ(raisedBy([&] { bound(ctx, static_cast<INT *>(nullptr), "a.st", 1, 1); }).code,
            ExceptionCode::UnboundInOut);
  EXPECT_EQ((subrange<1, 9>(ctx, INT{9}, "a.st", 1, 1)), 9);
  EXPECT_EQ(raisedBy([&] { subrange<1, 9>(ctx, INT{0}, "a.st", 1, 1); }).detail,
            "value 0 is outside 1..9");
  ctx.loopBudget = 3;
  int rounds = 0;
  const Raised raised = raisedBy([&] {
    for (;;) {
      ++rounds;
      loopTick(ctx, "a.st", 7, 1);
    }
  });
  EXPECT_EQ(raised.code, ExceptionCode::EndlessLoop);
  EXPECT_EQ(rounds, 4);
}

TEST(Strings, AssignmentTruncates) {
  STRING<3> a{};
  assign(a, "abcdef");
  EXPECT_STREQ(a.s, "abc");
  STRING<10> b{};
  assign(b, a);
  EXPECT_STREQ(b.s, "abc");
  assign(a, lit("x"));
  EXPECT_STREQ(a.s, "x");
  WSTRING<2> w{};
  assign(w, u"abc");
  EXPECT_EQ(std::u16string(w.s), u"ab");
  EXPECT_STREQ(resize<2>(b).s, "ab");
}

TEST(Strings, ComparisonIsByUnsignedCode) {
  EXPECT_EQ(compare(lit("abc"), lit("abc")), 0);
  EXPECT_LT(compare(lit("ab"), lit("abc")), 0);
  EXPECT_GT(compare(lit("b"), lit("abc")), 0);
  EXPECT_GT(compare(lit("\xE4"), lit("z")), 0);
  STRING<3> full{{'a', 'b', 'c', 'd'}}; // no NUL within the declared length
  EXPECT_EQ(compare(full, lit("abc")), 0);
  EXPECT_EQ(len(full), 3);
}

TEST(Strings, Functions) {
  const auto s = lit("Stride");
  EXPECT_EQ(len(s), 6);
  EXPECT_STREQ(left(s, 3).s, "Str");
  EXPECT_STREQ(left(s, -1).s, "");
  EXPECT_STREQ(left(s, 99).s, "Stride");
  EXPECT_STREQ(right(s, 2).s, "de");
  EXPECT_STREQ(right(s, 99).s, "Stride");
  EXPECT_STREQ(mid(s, 2, 3).s, "ri");
  EXPECT_STREQ(mid(s, 2, 7).s, "");
  EXPECT_STREQ(mid(s, 2, 0).s, "St");
  EXPECT_STREQ(concat(s, lit("!")).s, "Stride!");
  EXPECT_STREQ(concat<7>(s, lit("?!")).s, "Stride?");
  EXPECT_STREQ(insert(s, lit("--"), 2).s, "St--ride");
  EXPECT_STREQ(insert(s, lit("--"), 0).s, "--Stride");
  EXPECT_STREQ(remove(s, 2, 3).s, "Stde");
  EXPECT_STREQ(remove(s, 99, 1).s, "");
  EXPECT_STREQ(replace(s, lit("X"), 2, 2).s, "SXide");
  EXPECT_EQ(find(s, lit("ri")), 3);
  EXPECT_EQ(find(s, lit("x")), 0);
  EXPECT_EQ(find(s, lit("")), 0);
  EXPECT_EQ(find(lit("aab"), lit("ab")), 2);
}

} // namespace
