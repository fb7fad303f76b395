// Where smooth functions change their sign, and which piece of a curve a place belongs to: against
// roots that are known and a search one after the other.
#include "runtime/numeric/cam/extremes.hpp"
#include "runtime/numeric/cam/piece_search.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

namespace cam = stride::cam;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kNear = 0x1p-33;

std::vector<double> rootsOf(const std::vector<double> &coefficients, double sine = 0,
                            double cosine = 0, double omega = 0) {
  cam::Smooth f;
  f.degree = static_cast<int>(coefficients.size()) - 1;
  for (size_t i = 0; i < coefficients.size(); ++i)
    f.c[i] = coefficients[i];
  f.sine = sine;
  f.cosine = cosine;
  f.omega = omega;
  double roots[cam::kMostRoots];
  const int count = cam::rootsOf(f, roots);
  return {roots, roots + count};
}

MATCHER_P(Close, value, "") { return std::fabs(arg - value) <= kNear; }

/// Also polynomials in which powers in the middle are missing: their derivatives begin with 0.
TEST(CamExtremes, RootsOfPolynomialsWithAndWithoutPowersInTheMiddle) {
  EXPECT_THAT(rootsOf({-0.09, 0, 1}), ElementsAre(Close(0.3)));
  EXPECT_THAT(rootsOf({0.25, 0, -1}), ElementsAre(Close(0.5)));
  EXPECT_THAT(rootsOf({3, 0, -12}), ElementsAre(Close(0.5)));
  EXPECT_THAT(rootsOf({-0.008, 0, 0, 1}), ElementsAre(Close(0.2)));
  EXPECT_THAT(rootsOf({-0.0256, 0, 0, 0, 1}), ElementsAre(Close(0.4)));
  EXPECT_THAT(rootsOf({-std::pow(0.7, 7), 0, 0, 0, 0, 0, 0, 1}), ElementsAre(Close(0.7)));
  // (u² - 0.04)(u² - 0.49)
  EXPECT_THAT(rootsOf({0.0196, 0, -0.53, 0, 1}), ElementsAre(Close(0.2), Close(0.7)));
  // (u - 0.1)(u - 0.35)(u - 0.8)
  EXPECT_THAT(rootsOf({-0.028, 0.395, -1.25, 1}), ElementsAre(Close(0.1), Close(0.35), Close(0.8)));
  EXPECT_THAT(rootsOf({-0.3, 1}), ElementsAre(Close(0.3)));
  EXPECT_THAT(rootsOf({-0.3, 1, 0, 0, 0}), ElementsAre(Close(0.3)));
  EXPECT_THAT(rootsOf({0.09, 0, 1}), IsEmpty());
  EXPECT_THAT(rootsOf({2}), IsEmpty());
  EXPECT_THAT(rootsOf({0}), IsEmpty());
  EXPECT_THAT(rootsOf({0, 0, 0}), IsEmpty());
}

TEST(CamExtremes, RootsOfSinesWithAndWithoutPolynomials) {
  EXPECT_THAT(rootsOf({0}, 1, -1, 2), ElementsAre(Close(M_PI / 8)));
  EXPECT_THAT(rootsOf({0}, 1, -1, -2.9), ElementsAre(Close(3 * M_PI / 4 / 2.9)));
  EXPECT_THAT(rootsOf({0}, 1, 1, -2.9), ElementsAre(Close(M_PI / 4 / 2.9)));
  EXPECT_THAT(rootsOf({-0.5}, 1, 0, 3), ElementsAre(Close(M_PI / 18), Close(5 * M_PI / 18)));
  EXPECT_THAT(rootsOf({-std::sin(1.2) - 0.4, 1}, 1, 0, 3),
              ElementsAre(Close(0.4), Close(0.8972704284)));
  EXPECT_THAT(rootsOf({-std::cos(0.3) - 0.09, 0, 1}, 0, 1, 1), ElementsAre(Close(0.3)));
  EXPECT_THAT(rootsOf({1.5}, 1, 0, 3), IsEmpty());
}

TEST(CamExtremes, ASumHasTheHigherDegree) {
  cam::Smooth line;
  line.degree = 1;
  line.c[0] = 1;
  line.c[1] = 2;
  cam::Smooth cubic;
  cubic.degree = 3;
  cubic.c[3] = 4;
  for (const bool turned : {false, true}) {
    const cam::Smooth sum =
        turned ? cam::combined(cubic, -1, line, 3) : cam::combined(line, 3, cubic, -1);
    EXPECT_EQ(sum.degree, 3);
    EXPECT_EQ(cam::valueOf(sum, 0.5), 3 * 2 - 0.5);
  }
}

/// Asks for no piece that is not there, and for few.
TEST(CamPieces, AreFoundFromAnyHint) {
  for (const uint32_t pieces : {1U, 2U, 3U, 4U, 5U, 17U, 100U}) {
    std::vector<double> begins;
    for (uint32_t i = 0; i < pieces; ++i)
      begins.push_back(i * i * 0.25 - 3);
    const double end = pieces * pieces * 0.25 - 3;
    std::vector<double> places = {-100, end + 100};
    for (const double begin : begins)
      places.insert(places.end(),
                    {std::nextafter(begin, -HUGE_VAL), begin, std::nextafter(begin, HUGE_VAL)});
    for (const double x : places) {
      uint32_t expected = 0;
      while (expected + 1 < pieces && begins[expected + 1] <= x)
        ++expected;
      for (uint32_t hint = 0; hint < pieces + 3; ++hint) {
        int asked = 0;
        const auto begin = [&](uint32_t i) {
          ++asked;
          EXPECT_LT(i, pieces) << "x " << x << " hint " << hint;
          return begins.at(i);
        };
        ASSERT_EQ(cam::pieceAt(x, pieces, hint, (end + 3) / pieces, begin), expected)
            << x << " hint " << hint;
        const uint32_t from = std::min(hint, pieces - 1);
        const bool near = expected + 1 == from || expected == from || expected == from + 1;
        EXPECT_LE(asked, near ? 3 : 20) << pieces << " pieces, x " << x << " hint " << hint;
      }
    }
  }
}

} // namespace
