#include "tests/oracle/path/random_program.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace stride::oracle {

namespace {

/// A word: a letter and a number without an exponent, and without zeros that say nothing.
std::string word(const char *letter, double value, int decimals) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  std::string number = text.data();
  if (number.find('.') != std::string::npos) {
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.')
      number.pop_back();
  }
  return std::string(" ") + letter + (number == "-0" ? "0" : number);
}

/// G17, G18 or G19 by the axis that the plane's normal is.
int planeOf(const Point &normal) {
  if (normal[2] != 0.0)
    return 17;
  return normal[1] != 0.0 ? 18 : 19;
}

} // namespace

std::string gcodeOf(const std::vector<ProgramMove> &moves, int decimals) {
  constexpr std::array<const char *, 3> kAxisNames = {"X", "Y", "Z"};
  constexpr std::array<const char *, 3> kCentreNames = {"I", "J", "K"};
  std::string text = "% random\n";
  int number = 0;
  const auto sentence = [&](int g) {
    number += 10;
    text += "N" + std::to_string(number) + " G" + std::to_string(g);
  };
  if (!moves.empty()) { // from wherever it stands
    sentence(92);
    for (size_t axis = 0; axis < 3; ++axis)
      text += word(kAxisNames[axis], moves.front().start[axis], decimals);
    text += "\n";
  }
  int plane = 17;
  for (const ProgramMove &move : moves) {
    const bool arc = move.kind != MoveKind::Line;
    if (arc && planeOf(move.normal) != plane) {
      plane = planeOf(move.normal);
      sentence(plane);
      text += "\n";
    }
    // Seen from the other side an arc turns the other way.
    const double sign = move.normal[0] + move.normal[1] + move.normal[2];
    const bool clockwise = (move.kind == MoveKind::Clockwise) == (sign > 0);
    sentence(!arc ? 1 : clockwise ? 2 : 3);
    for (size_t axis = 0; axis < 3; ++axis)
      text += word(kAxisNames[axis], move.end[axis], decimals);
    for (size_t axis = 0; arc && axis < 3; ++axis)
      if (move.normal[axis] == 0.0)
        text += word(kCentreNames[axis], move.centre[axis] - move.start[axis], decimals);
    text += word("F", move.velocity, decimals) + word("E", move.acceleration, decimals) +
            word("E", -move.deceleration, decimals) + "\n";
  }
  return text;
}

} // namespace stride::oracle
