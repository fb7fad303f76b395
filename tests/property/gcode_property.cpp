// G-code: random programs are read as they were written, whatever pieces they come in, and their
// objects hang together.
#include "runtime/numeric/cnc/object_shape.hpp"
#include "tests/unit/cnc/gcode_text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

std::string textOf(double value) {
  char digits[400];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed);
  return {digits, end.ptr};
}

/// Blanks, comments, nothing.
std::string gap(bool needed) {
  const std::vector<std::string> gaps = {" ", "\t", "  ", " (a comment) ", needed ? " " : ""};
  return *rc::gen::elementOf(gaps);
}

/// A number that has no more than kMostDigits characters.
double number() {
  const auto whole = *rc::gen::inRange<int64_t>(-1000000000, 1000000000);
  const auto digits = *rc::gen::inRange(0, 9);
  return static_cast<double>(whole) / std::pow(10.0, digits);
}

std::vector<uint8_t> allWords() {
  std::vector<uint8_t> codes;
  for (int code = 0; code < 256; ++code)
    if (isWord(static_cast<uint8_t>(code)))
      codes.push_back(static_cast<uint8_t>(code));
  return codes;
}

struct Expected {
  std::vector<GCodeWord> words;
  std::vector<std::string> variables;
};

/// Writes a random program and what it consists of.
std::string randomText(Expected &expected) {
  std::string text;
  const auto lines = *rc::gen::inRange(0, 12);
  for (int line = 0; line < lines; ++line) {
    const auto words = *rc::gen::inRange(0, 6);
    for (int i = 0; i < words; ++i) {
      GCodeWord word{};
      word.letter = *rc::gen::elementOf(allWords());
      char letters[kMostLetters];
      std::string name(letters, static_cast<size_t>(lettersOf(word.letter, letters)));
      if (*rc::gen::arbitrary<bool>())
        std::transform(name.begin(), name.end(), name.begin(), ::tolower);
      text += gap(false) + name + gap(false).substr(0, 1);
      if (text.back() == '(')
        text.back() = ' ';
      std::string variable;
      if (*rc::gen::inRange(0, 8) == 0) {
        variable = "g_" + std::to_string(*rc::gen::inRange(0, 1000));
        text += "$" + variable + "$";
      } else {
        word.value = wantsWhole(word.letter) ? *rc::gen::inRange(-40000, 40000) : number();
        word.integer = wholePart(word.value);
        text += (word.value >= 0 && *rc::gen::arbitrary<bool>() ? "+" : "") + textOf(word.value);
      }
      expected.words.push_back(word);
      expected.variables.push_back(variable);
    }
    text += gap(false);
    text += *rc::gen::elementOf(std::vector<std::string>{"\n", "\r\n", "\r"});
    // CR before LF would be one end of a line.
    if (text.back() == '\r')
      text += ' ';
    if (words == 0)
      continue;
    GCodeWord end{};
    end.letter = kEndOfSentence;
    end.integer = line + 1;
    expected.words.push_back(end);
    expected.variables.emplace_back();
  }
  return text;
}

void expectSame(const Scanned &scanned, const Expected &expected) {
  RC_ASSERT(scanned.errors.empty());
  RC_ASSERT(scanned.variables == expected.variables);
  RC_ASSERT(scanned.words.size() == expected.words.size());
  for (size_t i = 0; i < scanned.words.size(); ++i) {
    RC_ASSERT(scanned.words[i].letter == expected.words[i].letter);
    RC_ASSERT(scanned.words[i].value == expected.words[i].value);
    RC_ASSERT(scanned.words[i].integer == expected.words[i].integer);
  }
}

/// A sentence with a motion that may be anything.
std::string randomSentence() {
  const auto coordinate = [](const char *letter) {
    return *rc::gen::inRange(0, 4) == 0
               ? std::string()
               : letter + textOf(*rc::gen::inRange(-5000, 5000) / 100.0) + " ";
  };
  const std::vector<std::string> functions = {
      "G0",  "G1",  "G2",  "G3",  "G5",  "G6",  "G8",  "G9",  "G10", "G92",   "M7",
      "G15", "G17", "G18", "G91", "G90", "G98", "G99", "G40", "G51", "G4 T1", "G75"};
  const std::string function = *rc::gen::elementOf(functions);
  std::string text = function + " ";
  const char first = function[0];
  if (first == 'M' || function.size() > 3 ||
      (function.size() == 3 && function != "G10" && function != "G92"))
    return text + "\n";
  text += coordinate("X") + coordinate("Y") + coordinate("Z") + coordinate("P");
  if (function == "G8" || function == "G9")
    text += "R" + textOf(*rc::gen::inRange(1, 200) / 100.0) + " I3 " + coordinate("J") +
            coordinate("K");
  else if (function == "G2" || function == "G3")
    text += *rc::gen::arbitrary<bool>() ? "R" + textOf(*rc::gen::inRange(-1, 90)) + " "
                                        : "I" + textOf(*rc::gen::inRange(-40, 40)) + " ";
  else if (function == "G6")
    text += "I" + textOf(*rc::gen::inRange(-40, 40)) + " " + coordinate("J");
  if (*rc::gen::inRange(0, 5) == 0)
    text += "H3 L" + textOf(*rc::gen::inRange(-20, 20));
  return text + "\n";
}

double distanceOf(const Position &a, const Position &b) {
  double most = 0;
  for (int axis = 0; axis < kAxes; ++axis)
    most = std::max(most, std::fabs(a.coordinate[axis] - b.coordinate[axis]));
  return most;
}

/// The place of a plane object's curve at its start or end.
Vector3 curveEnd(const PathObject &o, bool atEnd) {
  const double t = o.parameterRange[0] - (atEnd ? o.parameterRange[1] : 0.0);
  const double phi = t * M_PI / 180;
  double x = 0;
  double y = 0;
  if (o.moveType == MoveType::Clockwise || o.moveType == MoveType::Counterclockwise) {
    x = o.shape[0] + o.shape[2] * std::cos(phi);
    y = o.shape[1] + o.shape[2] * std::sin(phi);
  } else {
    const double a = o.shape[4] * std::cos(phi);
    const double b = o.shape[5] * std::sin(phi);
    x = o.shape[0] + o.shape[2] * a - o.shape[3] * b;
    y = o.shape[1] + o.shape[3] * a + o.shape[2] * b;
  }
  return o.planeX * x + o.planeY * y;
}

void checkObject(const PathObject &o) {
  RC_ASSERT(std::isfinite(o.length));
  RC_ASSERT(o.length >= 0);
  for (int i = 0; i < kMostSwitches; ++i)
    RC_ASSERT(o.switchPosition[i] >= 0 && o.switchPosition[i] <= 1);
  // What others make of the object is what the decoder has meant.
  ObjectShape shape{};
  const ShapeError error = shapeOf(o, shape);
  RC_ASSERT(error == ShapeError::None || error == ShapeError::Ends);
  RC_ASSERT(std::fabs(shape.length - o.length) <= 1e-7 * (1 + o.length));
  const bool arc = o.moveType == MoveType::Clockwise || o.moveType == MoveType::Counterclockwise ||
                   o.moveType == MoveType::EllipseClockwise ||
                   o.moveType == MoveType::EllipseCounterclockwise;
  if (!arc)
    return;
  RC_ASSERT(std::fabs(o.parameterRange[1]) <= 360.0);
  RC_ASSERT(std::fabs(o.parameterRange[1]) > 0.0);
  for (const bool atEnd : {false, true}) {
    const Position &position = atEnd ? o.end : o.start;
    const Vector3 place{position.coordinate[0], position.coordinate[1], position.coordinate[2]};
    const Vector3 off = place - curveEnd(o, atEnd);
    const double inPlane = std::hypot(dot(off, o.planeX), dot(off, o.planeY));
    const double size = 1 + std::fabs(o.shape[2]) + std::fabs(o.shape[4]) + norm(place);
    RC_ASSERT(inPlane <= 1e-7 * size);
  }
}

} // namespace

RC_GTEST_PROP(GCodeProperty, TextsAreReadAsTheyWereWritten, ()) {
  Expected expected;
  const std::string text = randomText(expected);
  expectSame(scanText(text), expected);
  expectSame(scanPieces(text, [] { return size_t{1}; }), expected);
  uint32_t state = 1;
  expectSame(scanPieces(text,
                        [&] {
                          state = state * 1664525 + 1013904223;
                          return size_t{state >> 28};
                        }),
             expected);
}

RC_GTEST_PROP(GCodeProperty, PiecesOfAnyTextAreReadAlike, (const std::string &text)) {
  const Scanned whole = scanText(text);
  const Scanned bytes = scanPieces(text, [] { return size_t{1}; });
  RC_ASSERT(whole.errors == bytes.errors);
  RC_ASSERT(whole.variables == bytes.variables);
  RC_ASSERT(whole.name == bytes.name);
}

RC_GTEST_PROP(GCodeProperty, ObjectsHangTogether, ()) {
  std::string text = "F7 ";
  const auto count = *rc::gen::inRange(1, 30);
  for (int i = 0; i < count; ++i)
    text += randomSentence();
  const DecodedText decoded = decodeText(text);
  RC_LOG() << text;
  const std::vector<PathObject> &objects = decoded.objects;
  for (size_t i = 0; i < objects.size(); ++i) {
    checkObject(objects[i]);
    RC_ASSERT(objects[i].number > 0);
    if (i > 0 && objects[i].moveType != MoveType::Jump)
      RC_ASSERT(distanceOf(objects[i - 1].end, objects[i].start) == 0);
  }
}
