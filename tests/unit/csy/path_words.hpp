// Tables of words as an application of the module writes them, from the manual's layout. Uses
// nothing of the code under test.
#ifndef STRIDE_TESTS_UNIT_CSY_PATH_WORDS_HPP
#define STRIDE_TESTS_UNIT_CSY_PATH_WORDS_HPP

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace stride::test {

/// A point of a path, with the names of the manual.
struct PathPoint {
  float x = 0, y = 0, z = 0;
  int16_t type = 0;
  int16_t parW1 = 1, parW2 = 15, parW3 = 100, parW4 = 0;
  float parF1 = 0, parF2 = 0, parF3 = 0;
  float speed = 0;
};

inline void addReal(std::vector<int16_t> &words, float value) {
  uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  words.push_back(static_cast<int16_t>(bits & 0xFFFF));
  words.push_back(static_cast<int16_t>(bits >> 16));
}

inline std::vector<int16_t> pathWords(const std::vector<PathPoint> &points, int axes = 2) {
  std::vector<int16_t> words{static_cast<int16_t>(points.size()),
                             static_cast<int16_t>(axes),
                             static_cast<int16_t>(axes == 2 ? 17 : 19),
                             0,
                             0,
                             0};
  for (int i = 0; i < axes; ++i)
    words.push_back(static_cast<int16_t>(1 + i));
  for (const PathPoint &point : points) {
    addReal(words, point.x);
    addReal(words, point.y);
    if (axes == 3)
      addReal(words, point.z);
    for (const float value : {point.speed, point.parF1, point.parF2, point.parF3})
      addReal(words, value);
    for (const int16_t value : {point.type, point.parW1, point.parW2, point.parW3, point.parW4})
      words.push_back(value);
  }
  return words;
}

} // namespace stride::test

#endif // STRIDE_TESTS_UNIT_CSY_PATH_WORDS_HPP
