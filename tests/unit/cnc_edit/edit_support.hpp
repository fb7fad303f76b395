// What tests of edited CNC programs share: paths of texts, and random programs.
#ifndef STRIDE_TESTS_UNIT_CNC_EDIT_EDIT_SUPPORT_HPP
#define STRIDE_TESTS_UNIT_CNC_EDIT_EDIT_SUPPORT_HPP

#include "compiler/assets/cnc/cnc_source.hpp"
#include "tests/unit/cnc_processors/sampled_path.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace stc::test {

using stride::cnc::MoveType;
using stride::cnc::PathObject;

using stride::cnc::test::Point;

/// From place to place.
inline double between(const Point &a, const Point &b) {
  return stride::cnc::test::sizeOf(stride::cnc::test::operator-(a, b));
}

/// The path of a text.
inline std::vector<PathObject> pathOf(const std::string &text) {
  Sources sources;
  Diagnostics diagnostics;
  std::vector<PathObject> path;
  const auto program = readCnc(sources.file(sources.add("a.cnc", text)), diagnostics);
  EXPECT_TRUE(program) << text;
  if (program) {
    const CncDecoded decoded = decodeCnc(*program, [&](const PathObject &object) {
      path.push_back(object);
      return path.size() < 100000;
    });
    EXPECT_NE(decoded.end, CncEnd::Wrong) << text;
  }
  return path;
}

using Edit = std::function<std::optional<std::string>(const SourceFile &, Diagnostics &)>;

/// The changed text, or the first error: its code, its place, its message.
inline std::string edited(const std::string &text, const Edit &edit) {
  Sources sources;
  Diagnostics diagnostics;
  const auto result = edit(sources.file(sources.add("a.cnc", text)), diagnostics);
  EXPECT_EQ(result.has_value(), !diagnostics.hasErrors());
  if (result)
    return *result;
  const Diagnostic &first = diagnostics.all().front();
  EXPECT_FALSE(first.code == Code::CncEdit && first.helps.empty());
  const LineColumn place = sources.position(first.labels.at(0).span);
  return fmt::format("{} {}:{}: {}", codeName(first.code), place.line, place.column, first.message);
}

/// Programs with all motions, and with modes that come and go.
class RandomProgram {
public:
  explicit RandomProgram(unsigned seed, bool closed) : random_(seed), closed_(closed) {}

  std::string text(int blocks = 16) {
    std::string text = "% random\n(top)\nN0 G0 X7 Y8.5 Z2 F100 E900 E-800\n";
    for (int i = 0; i < blocks; ++i)
      text += block();
    if (relative_)
      text += "G90\n";
    return text + "N9999 G1 X1 Y-1 (last)\n\n(bottom)\n";
  }

private:
  int pick(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }
  std::string number() { return fmt::format("{:.3f}", 0.001 * (pick(40000) - 20000) + 0.0005); }
  std::string n() { return pick(3) == 0 ? "" : fmt::format("N{} ", 10 * ++count_); }

  /// Words of a motion that may be there.
  std::string more() {
    switch (pick(9)) {
    case 0:
      return fmt::format(" H{} O0.{}5", 1 + pick(5), pick(9));
    case 1:
      return fmt::format(" H3 L{} H-3 L-{}", 0.25 * pick(3), 0.125 * (1 + pick(3)));
    case 2:
      return fmt::format(" F{}", 10 + pick(90));
    case 3:
      return fmt::format(" E{} E-{}", 100 + pick(90), 200 + pick(90));
    case 4:
      return fmt::format(" P{} (turn)", number());
    default:
      return "";
    }
  }

  std::string block() {
    switch (pick(closed_ ? 13 : 15)) {
    case 0:
      return n() + "G1 X" + number() + " Y" + number() + more() + "\n" + n() + "X" + number() +
             more() + "\n";
    case 1:
      return "(comment " + number() + ")\n" + n() + "G1 Z" + number() + more() + "\n\n";
    case 2:
      relative_ = !relative_;
      return n() + (relative_ ? "G91\n" : "G90 (absolute)\n");
    case 3:
      return arcs();
    case 4:
      return within("G91", fmt::format("{}G{} X-20 Y6 I-10 J3 K{} R0.{}{}\n", n(), 8 + pick(2),
                                       pick(90), 3 + pick(6), more()));
    case 5:
      return within("G91",
                    fmt::format("{}G6 X{} Y{} I5 J7{}\n", n(), 9 + pick(3), pick(3), more()));
    case 6:
      return n() + "G1 X" + number() + "\nM" + std::to_string(3 + pick(3)) + " K" + number() +
             "\nG4 T0.5\n" + n() + "G1 Y" + number() + more() + "\n";
    case 7:
      return n() + "G0 X" + number() + " Z" + number() + "\n";
    case 8:
      return "G41 D1.5\n" + n() + "G1 X" + number() + "\n" + n() + "Y" + number() + " F33\nG40\n" +
             "G1 Z" + number() + "\n";
    case 9:
      return "G51 D0.75\n" + n() + "G1 X" + number() + "\n" + n() + "Y" + number() + "\nG50\n";
    case 10:
      return "G38 O4\n" + n() + "G1 X" + number() + more() + "\nG39 O4\nF" +
             std::to_string(20 + pick(9)) + "\n";
    case 11:
      return n() + "G92 X" + number() + "\n" + n() + "G1 Y" + number() + "\n";
    case 12:
      return fmt::format("G{}\n{}G1 X{} Z{}{}\nG17\n", 18 + pick(2), n(), number(), number(),
                         more());
    default:
      return n() + "G1 X" + number() + "\n" + n() + (pick(2) == 0 ? "G5 X" : "G10 X") + number() +
             " Y" + number() + more() + "\n" + n() + "X" + number() + " Y" + number() + "\n" + n() +
             "G1 X" + number() + "\n";
    }
  }

  /// In a mode, whatever it was before.
  std::string within(const std::string &mode, const std::string &sentence) {
    return relative_ ? sentence : mode + "\n" + sentence + "G90\n";
  }

  std::string arcs() {
    switch (pick(5)) {
    case 0:
      return within("G91",
                    fmt::format("{}G{} X4 Y4 R{}{}\n", n(), 2 + pick(2), 3 + pick(9), more()));
    case 1: // a full circle
      return fmt::format("{}G{} I2 J-{}{}\n", n(), 2 + pick(2), 1 + pick(5), more());
    case 2:
      return fmt::format("{}G{} T{} I{} J{} Z{}{}\n", n(), 2 + pick(2), 20 + pick(300), 1 + pick(5),
                         pick(5), number(), more());
    case 3:
      return fmt::format("G98\n{}G{} T{} I1.5 J2{}\nG99\n", n(), 2 + pick(2), 20 + pick(300),
                         more());
    default:
      return "G18\n" + within("G91", n() + "G2 X8 Z0 I4 K0\n") + "G17\n";
    }
  }

  std::mt19937 random_;
  bool closed_; ///< No splines.
  bool relative_ = false;
  int count_ = 100; ///< Numbers are no lines.
};

} // namespace stc::test

#endif // STRIDE_TESTS_UNIT_CNC_EDIT_EDIT_SUPPORT_HPP
