// Accuracy and special cases of the deterministic mathematics. The reference is the C library's
// long double, which has at least 11 more bits.
#include "runtime/iec/math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamples = 200000;

/// |got - wanted| in units of the last place of `wanted` as a double.
double ulps(double got, long double wanted) {
  if (std::isnan(got) || std::isnan(static_cast<double>(wanted)))
    return std::isnan(got) == std::isnan(static_cast<double>(wanted)) ? 0.0 : kInf;
  const double rounded = static_cast<double>(wanted);
  if (std::isinf(rounded) || std::isinf(got))
    return rounded == got ? 0.0 : kInf;
  int exponent = 0;
  std::frexp(rounded, &exponent);
  const long double ulp = std::ldexp(1.0L, std::max(exponent - 53, -1074));
  return static_cast<double>(std::fabs(static_cast<long double>(got) - wanted) / ulp);
}

/// Random doubles: uniform in a range, or uniform over all bit patterns.
class Samples {
public:
  double in(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(engine_);
  }
  double any() { return std::bit_cast<double>(engine_()); }

private:
  std::mt19937_64 engine_{20240229};
};

template <class F, class R>
void expectAccurate(const char *name, F f, R reference, double lo, double hi) {
  Samples samples;
  double worst = 0;
  double at = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double x = samples.in(lo, hi);
    const double error = ulps(f(x), reference(static_cast<long double>(x)));
    if (error > worst) {
      worst = error;
      at = x;
    }
  }
  EXPECT_LT(worst, 0.9) << name << " at " << at << " in " << lo << ".." << hi;
}

template <class F, class R> void expectAccurateEverywhere(const char *name, F f, R reference) {
  Samples samples;
  double worst = 0;
  double at = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double x = samples.any();
    if (std::isnan(x))
      continue;
    const double error = ulps(f(x), reference(static_cast<long double>(x)));
    if (error > worst) {
      worst = error;
      at = x;
    }
  }
  EXPECT_LT(worst, 0.9) << name << " at " << at;
}

#define STRIDE_FUNCTION(f) [](double x) { return stride::f(x); }
#define STRIDE_REFERENCE(f) [](long double x) { return std::f(x); }

TEST(Math, SineCosineTangent) {
  for (const double span : {0.8, 7.0, 1000.0, 1e6, 1e9, 1e15, 1e300}) {
    expectAccurate("sin", STRIDE_FUNCTION(sin), STRIDE_REFERENCE(sin), -span, span);
    expectAccurate("cos", STRIDE_FUNCTION(cos), STRIDE_REFERENCE(cos), -span, span);
    expectAccurate("tan", STRIDE_FUNCTION(tan), STRIDE_REFERENCE(tan), -span, span);
  }
  expectAccurateEverywhere("sin", STRIDE_FUNCTION(sin), STRIDE_REFERENCE(sin));
  expectAccurateEverywhere("cos", STRIDE_FUNCTION(cos), STRIDE_REFERENCE(cos));
  expectAccurateEverywhere("tan", STRIDE_FUNCTION(tan), STRIDE_REFERENCE(tan));
}

TEST(Math, SineAndCosineAtOnceHaveTheSameBits) {
  Samples samples;
  for (int i = 0; i < kSamples; ++i) {
    const double x = i % 3 == 0   ? samples.any()
                     : i % 3 == 1 ? samples.in(-1e-8, 1e-8)
                                  : samples.in(-50, 50);
    const stride::SineCosine both = stride::sineCosine(x);
    if (std::isfinite(x)) {
      ASSERT_EQ(std::bit_cast<uint64_t>(both.s), std::bit_cast<uint64_t>(stride::sin(x))) << x;
      ASSERT_EQ(std::bit_cast<uint64_t>(both.c), std::bit_cast<uint64_t>(stride::cos(x))) << x;
    } else {
      ASSERT_TRUE(std::isnan(both.s) && std::isnan(both.c));
    }
  }
  EXPECT_TRUE(std::signbit(stride::sineCosine(-0.0).s));
}

TEST(Math, ReductionNearMultiplesOfHalfPi) {
  // Doubles next to k pi/2, where cancellation is worst; 6381956970095103 * 2^797 is the closest
  // of all doubles to a multiple of pi/2.
  double worst = 0;
  for (int k = 1; k < 300000; k += 7) {
    const double x = static_cast<double>(k * (3.14159265358979323846264338327950288L / 2));
    worst = std::max(worst, ulps(stride::sin(x), std::sin(static_cast<long double>(x))));
    worst = std::max(worst, ulps(stride::cos(x), std::cos(static_cast<long double>(x))));
    worst = std::max(worst, ulps(stride::tan(x), std::tan(static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 0.9);
  const double hard = std::ldexp(6381956970095103.0, 797);
  EXPECT_LT(ulps(stride::cos(hard), -4.68716592425462761112e-19L), 1.0);
  EXPECT_LT(ulps(stride::sin(hard), 1.0L), 1.0);
}

TEST(Math, InverseTrigonometric) {
  for (const double span : {1.0, 0.5, 1e-3, 1e-9}) {
    expectAccurate("asin", STRIDE_FUNCTION(asin), STRIDE_REFERENCE(asin), -span, span);
    expectAccurate("acos", STRIDE_FUNCTION(acos), STRIDE_REFERENCE(acos), -span, span);
    expectAccurate("atan", STRIDE_FUNCTION(atan), STRIDE_REFERENCE(atan), -span, span);
  }
  expectAccurate("asin", STRIDE_FUNCTION(asin), STRIDE_REFERENCE(asin), 1 - 1e-9, 1);
  expectAccurate("acos", STRIDE_FUNCTION(acos), STRIDE_REFERENCE(acos), 1 - 1e-9, 1);
  expectAccurate("acos", STRIDE_FUNCTION(acos), STRIDE_REFERENCE(acos), -1, -1 + 1e-9);
  for (const double span : {10.0, 1e5, 1e20})
    expectAccurate("atan", STRIDE_FUNCTION(atan), STRIDE_REFERENCE(atan), -span, span);
  expectAccurateEverywhere("atan", STRIDE_FUNCTION(atan), STRIDE_REFERENCE(atan));
}

TEST(Math, Atan2) {
  Samples samples;
  double worst = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double y = i % 2 == 0 ? samples.in(-10, 10) : samples.any();
    const double x = i % 2 == 0 ? samples.in(-10, 10) : samples.any();
    if (std::isnan(x) || std::isnan(y))
      continue;
    worst = std::max(worst, ulps(stride::atan2(y, x), std::atan2(static_cast<long double>(y),
                                                                 static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 0.9);
  for (const double y : {0.0, -0.0, 1.0, -1.0, kInf, -kInf, 5e-324, 1e308}) {
    for (const double x : {0.0, -0.0, 1.0, -1.0, kInf, -kInf, 5e-324, -1e308}) {
      const double wanted = std::atan2(y, x);
      EXPECT_LE(std::fabs(stride::atan2(y, x) - wanted), 1e-15) << y << ", " << x;
      EXPECT_EQ(std::signbit(stride::atan2(y, x)), std::signbit(wanted)) << y << ", " << x;
    }
  }
}

TEST(Math, ExponentialAndLogarithms) {
  for (const double span : {1e-3, 1.0, 10.0, 700.0, 708.0})
    expectAccurate("exp", STRIDE_FUNCTION(exp), STRIDE_REFERENCE(exp), -span, span);
  expectAccurate("exp", STRIDE_FUNCTION(exp), STRIDE_REFERENCE(exp), -746, -700);
  expectAccurateEverywhere("exp", STRIDE_FUNCTION(exp), STRIDE_REFERENCE(exp));
  expectAccurate("ln", STRIDE_FUNCTION(ln), STRIDE_REFERENCE(log), 0.9, 1.1);
  expectAccurate("ln", STRIDE_FUNCTION(ln), STRIDE_REFERENCE(log), 1 - 1e-10, 1 + 1e-10);
  expectAccurate("ln", STRIDE_FUNCTION(ln), STRIDE_REFERENCE(log), 0.0, 100.0);
  expectAccurate("log10", STRIDE_FUNCTION(log10), STRIDE_REFERENCE(log10), 0.0, 100.0);
  expectAccurateEverywhere(
      "ln", [](double x) { return stride::ln(std::fabs(x)); },
      [](long double x) { return std::log(std::fabs(x)); });
  expectAccurateEverywhere(
      "log10", [](double x) { return stride::log10(std::fabs(x)); },
      [](long double x) { return std::log10(std::fabs(x)); });
  for (int n = -300; n <= 300; ++n) {
    const double power = std::stod("1e" + std::to_string(n));
    EXPECT_EQ(stride::log10(power), n);
  }
}

TEST(Math, Power) {
  Samples samples;
  double worst = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double x = i % 2 == 0 ? samples.in(0, 10) : std::fabs(samples.any());
    const double y = i % 4 < 2 ? samples.in(-20, 20) : samples.in(-700, 700);
    if (std::isnan(x))
      continue;
    // The reference's own error grows with the exponent; its 64 bits still leave room.
    worst = std::max(worst, ulps(stride::pow(x, y), std::pow(static_cast<long double>(x),
                                                             static_cast<long double>(y))));
  }
  EXPECT_LT(worst, 0.9);
  EXPECT_EQ(stride::pow(10.0, 2.0), 100.0);
  EXPECT_EQ(stride::pow(2.0, 0.5), std::sqrt(2.0));
  EXPECT_EQ(stride::pow(3.0, 4.0), 81.0);
  EXPECT_EQ(stride::pow(-2.0, 3.0), -8.0);
  EXPECT_EQ(stride::pow(-2.0, -1.0), -0.5);
  EXPECT_EQ(stride::pow(2.0, -1074.0), 5e-324);
  EXPECT_EQ(stride::pow(2.0, 1023.0), std::ldexp(1.0, 1023));
  for (const double x : {0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 2.0, -2.0, kInf, -kInf, kNan}) {
    for (const double y : {0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.5, 3.0, -3.0, kInf, -kInf, kNan}) {
      const double wanted = std::pow(x, y);
      const double got = stride::pow(x, y);
      EXPECT_LT(ulps(got, wanted), 1.0) << x << ", " << y << ": " << got << " for " << wanted;
      EXPECT_TRUE(std::isnan(wanted) || std::signbit(got) == std::signbit(wanted))
          << x << ", " << y;
    }
  }
}

TEST(Math, SpecialValues) {
  EXPECT_EQ(stride::exp(kInf), kInf);
  EXPECT_EQ(stride::exp(-kInf), 0.0);
  EXPECT_EQ(stride::exp(0.0), 1.0);
  EXPECT_EQ(stride::ln(1.0), 0.0);
  EXPECT_EQ(stride::ln(0.0), -kInf);
  EXPECT_TRUE(std::isnan(stride::ln(-1.0)));
  EXPECT_TRUE(std::isnan(stride::sqrt(-1.0)));
  EXPECT_TRUE(std::isnan(stride::sin(kInf)));
  EXPECT_TRUE(std::isnan(stride::asin(1.5)));
  EXPECT_EQ(stride::asin(1.0), std::asin(1.0));
  EXPECT_EQ(stride::acos(-1.0), std::acos(-1.0));
  EXPECT_EQ(stride::acos(0.0), std::acos(0.0));
  EXPECT_TRUE(std::isnan(stride::atan(kNan)));
  EXPECT_EQ(stride::atan(-kInf), std::atan(-kInf));
  EXPECT_TRUE(std::signbit(stride::sin(-0.0)));
}

TEST(Math, WholeNumbers) {
  for (const double x : {0.0, -0.0, 0.5, -0.5, 1.5, -1.5, 2.5, 0.49999999999999994, -0.2,
                         4503599627370495.5, 9007199254740993.0, -1e300, kInf}) {
    EXPECT_EQ(stride::floor(x), std::floor(x)) << x;
    EXPECT_EQ(stride::ceil(x), std::ceil(x)) << x;
    EXPECT_EQ(stride::trunc(x), std::trunc(x)) << x;
    EXPECT_EQ(stride::round(x), std::round(x)) << x;
  }
  EXPECT_EQ(stride::fmod(-7.5, 2.0), -1.5);
  EXPECT_EQ(stride::fmod(1e300, 3.0), std::fmod(1e300, 3.0));
}

TEST(Math, SameBitsOnEveryMachine) {
  // A checksum over many results. It may change only together with the algorithms.
  std::mt19937_64 engine(1);
  uint64_t hash = 14695981039346656037U;
  const auto take = [&hash](double x) {
    hash = (hash ^ (std::isnan(x) ? 1U : std::bit_cast<uint64_t>(x))) * 1099511628211U;
  };
  for (int i = 0; i < 20000; ++i) {
    const double wide = std::bit_cast<double>(engine());
    const double unit = static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0;
    for (const double x : {wide, unit, 1000 * unit}) {
      take(stride::sin(x));
      take(stride::cos(x));
      take(stride::tan(x));
      take(stride::atan(x));
      take(stride::exp(x));
      take(stride::ln(std::fabs(x)));
      take(stride::log10(std::fabs(x)));
      take(stride::pow(std::fabs(x), 3.7 * unit));
      take(stride::atan2(x, unit));
    }
    take(stride::asin(unit));
    take(stride::acos(unit));
  }
  EXPECT_EQ(hash, 3318759687558283885U);
}

TEST(Math, SinglePrecisionIsTheRoundedDouble) {
  Samples samples;
  for (int i = 0; i < 20000; ++i) {
    const float x = static_cast<float>(samples.in(-100, 100));
    EXPECT_EQ(stride::sin(x), static_cast<float>(std::sin(static_cast<long double>(x))));
    EXPECT_EQ(stride::exp(x * 0.5F),
              static_cast<float>(std::exp(static_cast<long double>(x * 0.5F))));
  }
}

} // namespace
