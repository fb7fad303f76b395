#include "runtime/numeric/csy/trajectory_table.hpp"

namespace stride::csy {

namespace {

constexpr uint32_t kHeaderWords = 6;

uint32_t wordsPerPoint(uint32_t axes) noexcept { return 13 + 2 * axes; }

double realAt(const int16_t *words) noexcept {
  const uint32_t low = static_cast<uint16_t>(words[0]);
  const uint32_t high = static_cast<uint16_t>(words[1]);
  return static_cast<double>(__builtin_bit_cast(float, high << 16 | low));
}

TablePoint pointAt(const int16_t *words, uint32_t axes) noexcept {
  TablePoint point{};
  point.position = {realAt(words), realAt(words + 2), axes == 3 ? realAt(words + 4) : 0.0};
  const int16_t *parameters = words + 2 * axes;
  point.speed = realAt(parameters);
  for (uint32_t i = 0; i < 3; ++i)
    point.parF[i] = realAt(parameters + 2 + 2 * i);
  point.type = parameters[8];
  for (uint32_t i = 0; i < 4; ++i)
    point.parW[i] = parameters[9 + i];
  return point;
}

} // namespace

uint32_t lengthOfTable(uint32_t axes, uint32_t points) noexcept {
  return kHeaderWords + axes + wordsPerPoint(axes) * points;
}

Problem readTable(const int16_t *words, uint32_t length, uint32_t mostPoints,
                  TrajectoryTable &table) noexcept {
  if (length < kHeaderWords)
    return {PathError::WordsPerPoint, 0};
  const uint32_t points = static_cast<uint16_t>(words[0]);
  const uint32_t axes = static_cast<uint16_t>(words[1]);
  if (points == 0)
    return {PathError::NoPoints, 0};
  if (points > mostPoints || points > kMostPoints)
    return {PathError::TooManyPoints, mostPoints};
  if (axes != 2 && axes != 3)
    return {PathError::TooManyAxes, 0};
  if (static_cast<uint16_t>(words[2]) != wordsPerPoint(axes) ||
      length < lengthOfTable(axes, points))
    return {PathError::WordsPerPoint, 0};
  table.points = points;
  table.axes = axes;
  for (uint32_t i = 0; i < 3; ++i)
    table.axisIds[i] = i < axes ? words[kHeaderWords + i] : int16_t{0};
  for (uint32_t i = 0; i < points; ++i)
    table.point[i] = pointAt(words + kHeaderWords + axes + wordsPerPoint(axes) * i, axes);
  return {};
}

} // namespace stride::csy
