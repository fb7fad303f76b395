// Random programs of modes, systems of coordinates, planes, arcs, loops and variables beside a
// model of what they mean: where each object ends, and where the centre of each arc is.
#include "tests/support/cases.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/cnc/gcode_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;
using stride::test::casesOf;
using stride::test::Random;

using Place = std::array<double, 3>;

/// An object as the model has it.
struct Expected {
  Place end{};
  Place centre{};
  double sweep = 0; ///< Of an arc, counterclockwise positive. [degrees]
};

std::string textOf(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.17f", value);
  return text;
}

std::string wordOf(char letter, double value) { return letter + textOf(value) + " "; }

/// Carries a program out while it is being written.
class Model {
public:
  explicit Model(Random &random) : random_(random) {}

  /// A sentence of any kind; what it says is done at once. `inLoop`: nothing that a second round
  /// would write otherwise: all that the program says is relative.
  std::string sentence(bool inLoop) {
    const int kind = random_.below(inLoop ? 8 : 18);
    if (kind < 5)
      return line();
    if (kind < 8)
      return arc();
    if (kind < 10)
      return mode(std::string(random_.chance(0.5) ? "G90" : "G91"));
    if (kind < 12)
      return mode(random_.chance(0.5) ? "G98" : "G99");
    if (kind < 14)
      return plane(17 + random_.below(3));
    return kind < 17 ? system() : reset();
  }

  std::string mode(const std::string &text) {
    if (text == "G90" || text == "G91")
      relative_ = text == "G91";
    else
      absoluteCentre_ = text == "G98";
    return text + "\n";
  }

  std::vector<Expected> objects;

  /// What the objects from `first` on say once more, from where the path is.
  void repeat(size_t first, size_t end) {
    const Place begin = first > 0 ? objects[first - 1].end : Place{};
    const Place by{here_[0] - begin[0], here_[1] - begin[1], here_[2] - begin[2]};
    for (size_t i = first; i < end; ++i) {
      Expected object = objects[i];
      for (size_t k = 0; k < 3; ++k) {
        object.end[k] += by[k];
        object.centre[k] += by[k];
      }
      add(object);
    }
  }

private:
  double number() { return std::round(random_.uniform(-50, 50) * 1000) / 1000; }

  void add(const Expected &object) {
    objects.push_back(object);
    here_ = object.end;
  }

  /// X, Y and Z for a place, of those that `named` has.
  std::string wordsTo(const Place &to, const std::array<bool, 3> &named) const {
    std::string text;
    for (size_t k = 0; k < 3; ++k)
      if (named[k])
        text += wordOf("XYZ"[k], to[k] - (relative_ ? here_[k] : shift_[k]));
    return text;
  }

  std::string line() {
    Expected object;
    object.end = here_;
    std::array<bool, 3> named{};
    for (size_t k = 0; k < 3; ++k)
      if ((named[k] = random_.chance(0.6)))
        object.end[k] += number();
    named[0] = named[0] || (!named[1] && !named[2]);
    std::string text = "G1 " + wordsTo(object.end, named) + "\n";
    add(object);
    return text;
  }

  std::string arc() {
    // The axes of the plane in the order in which counterclockwise counts.
    const size_t a = plane_ == 17 ? 0 : plane_ == 18 ? 2 : 1;
    const size_t b = plane_ == 17 ? 1 : plane_ == 18 ? 0 : 2;
    const size_t across = 3 - a - b;
    Expected object;
    object.centre = here_;
    const double offA = number() + (random_.chance(0.5) ? 60 : -60);
    const double offB = random_.chance(0.2) ? 0 : number();
    object.centre[a] += offA;
    object.centre[b] += offB;
    const bool clockwise = random_.chance(0.5);
    const bool byAngle = random_.chance(0.3);
    const bool full = random_.chance(0.1);
    const double angle = full ? 360 : random_.uniform(1, 359);
    object.sweep = clockwise ? -angle : angle;
    const double phi = full ? 0 : object.sweep * M_PI / 180;
    object.end = here_;
    object.end[a] = object.centre[a] - offA * std::cos(phi) + offB * std::sin(phi);
    object.end[b] = object.centre[b] - offA * std::sin(phi) - offB * std::cos(phi);
    std::array<bool, 3> named{};
    named[a] = named[b] = !byAngle && !full;
    if (random_.chance(0.3)) {
      object.end[across] += number();
      named[across] = true;
    }
    std::string text = clockwise ? "G2 " : "G3 ";
    for (const size_t k : {a, b})
      text += wordOf("IJK"[k],
                     absoluteCentre_ ? object.centre[k] - shift_[k] : object.centre[k] - here_[k]);
    text += wordsTo(object.end, named);
    if (byAngle)
      text += wordOf('T', angle);
    add(object);
    return text + "\n";
  }

  std::string plane(int function) {
    plane_ = function;
    return "G" + std::to_string(function) + "\n";
  }

  std::string system() {
    const int function = 54 + random_.below(3);
    std::string text = "G" + std::to_string(function) + " ";
    for (size_t k = 0; k < 3; ++k) {
      const bool named = random_.chance(0.6);
      const double value = named ? number() : 0;
      if (named)
        text += wordOf("XYZ"[k], value);
      if (function == 54)
        shift_[k] = value;
      else if (function == 55)
        shift_[k] += value;
      else if (named)
        shift_[k] = here_[k] - value;
    }
    return text + "\n";
  }

  std::string reset() {
    shift_ = {};
    return "G53\n";
  }

  Random &random_;
  Place here_{}, shift_{};
  bool relative_ = false, absoluteCentre_ = false;
  int plane_ = 17;
};

struct Program {
  std::string text;
  std::vector<Expected> objects;
};

/// Straight parts and loops, by the implicit variable or by one of the application, up to two of
/// them within each other.
Program randomProgram(Random &random) {
  Program program;
  Model model(random);
  program.text = "F10\n";
  int label = 100;
  for (int part = 0; part < 6; ++part) {
    for (int i = random.below(6); i > 0; --i)
      program.text += model.sentence(false);
    if (random.chance(0.5))
      continue;
    program.text += model.mode("G91") + model.mode("G99");
    const int rounds = 1 + random.below(4);
    const bool named = random.chance(0.5);
    const std::string variable = named ? "O$n$ " : "";
    program.text += "G36 " + variable + "D" + std::to_string(rounds) + "\n";
    program.text += "N" + std::to_string(++label) + " G37 D-1 " + variable + "\n";
    const size_t first = model.objects.size();
    for (int i = 1 + random.below(4); i > 0; --i)
      program.text += model.sentence(true);
    const size_t end = model.objects.size();
    program.text += "G20 L" + std::to_string(label) + (named ? " K$n$" : "") + "\n";
    for (int round = 1; round < rounds; ++round)
      model.repeat(first, end);
  }
  program.objects = model.objects;
  return program;
}

/// The place of a circle's centre in space; its own frame may be any.
Place centreOf(const PathObject &o) {
  const Vector3 flat = o.planeX * o.shape[0] + o.planeY * o.shape[1];
  const double height = o.normal.x * o.start.coordinate[0] + o.normal.y * o.start.coordinate[1] +
                        o.normal.z * o.start.coordinate[2];
  const Vector3 centre = flat + o.normal * height;
  return {centre.x, centre.y, centre.z};
}

void expectNear(const Place &a, const Place &b) {
  for (size_t k = 0; k < 3; ++k)
    ASSERT_NEAR(a[k], b[k], 1e-8);
}

void expectSame(const PathObject &o, const Expected &expected) {
  expectNear({o.end.coordinate[0], o.end.coordinate[1], o.end.coordinate[2]}, expected.end);
  const bool arc = o.moveType == MoveType::Clockwise || o.moveType == MoveType::Counterclockwise;
  ASSERT_EQ(arc, expected.sweep != 0);
  if (!arc)
    return;
  ASSERT_NEAR(-o.parameterRange[1], expected.sweep, 1e-6);
  expectNear(centreOf(o), expected.centre);
}

} // namespace

TEST(GCodeModel, ProgramsMeanWhatTheModelSays) {
  Random random(77);
  for (int i = 0; i < casesOf(1500) && !HasFailure(); ++i) {
    const Program program = randomProgram(random);
    SCOPED_TRACE("case " + std::to_string(i) + "\n" + program.text);
    int16_t n = 0;
    const DecodedText decoded = decodeText(program.text, {{"n", {&n, VariableType::Int}}});
    ASSERT_EQ(decoded.error, GCodeError::None) << "line " << decoded.line;
    ASSERT_EQ(decoded.objects.size(), program.objects.size());
    for (size_t k = 0; k < program.objects.size() && !HasFailure(); ++k) {
      SCOPED_TRACE("object " + std::to_string(k) + " line " +
                   std::to_string(decoded.objects[k].sourceLine));
      expectSame(decoded.objects[k], program.objects[k]);
    }
  }
}
