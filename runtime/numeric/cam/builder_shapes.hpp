// The polynomials of pieces of degree 5 and 7. Internal to runtime/numeric/cam.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_BUILDER_SHAPES_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_BUILDER_SHAPES_HPP

namespace stride::cam {

/// Of a piece: v, a, j of its left end, then of its right end.
inline constexpr int kUnknowns = 6;

/// The polynomial of degree 5 or 7 on 0 to 1 as a linear function of v, a, j at both ends and the
/// way between them: row i is coefficient i + 3.
struct Shape {
  double row[5][kUnknowns + 1];
};

inline constexpr Shape kQuintic = {{{-6.0, -1.5, 0.0, -4.0, 0.5, 0.0, 10.0},
                                    {8.0, 1.5, 0.0, 7.0, -1.0, 0.0, -15.0},
                                    {-3.0, -0.5, 0.0, -3.0, 0.5, 0.0, 6.0},
                                    {},
                                    {}}};

inline constexpr Shape kSeptic = {{{0.0, 0.0, 1.0 / 6.0, 0.0, 0.0, 0.0, 0.0},
                                   {-20.0, -5.0, -2.0 / 3.0, -15.0, 2.5, -1.0 / 6.0, 35.0},
                                   {45.0, 10.0, 1.0, 39.0, -7.0, 0.5, -84.0},
                                   {-36.0, -7.5, -2.0 / 3.0, -34.0, 6.5, -0.5, 70.0},
                                   {10.0, 2.0, 1.0 / 6.0, 10.0, -2.0, 1.0 / 6.0, -20.0}}};

} // namespace stride::cam

#endif // STRIDE_RUNTIME_NUMERIC_CAM_BUILDER_SHAPES_HPP
