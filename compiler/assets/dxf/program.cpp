#include "compiler/assets/dxf/program.hpp"

#include "compiler/assets/cnc_edit/word_edits.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc::dxf {

namespace {

using gcode::numberText;
using gcode::roundedNumber;

/// What a line of a program may show: no brackets, no control characters.
std::string plainText(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += c == '(' || c == ')' || static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return result;
}

class Writer {
public:
  explicit Writer(const DxfImport &import) : import_(import) {}

  std::string write(const std::string &title, const std::vector<Cut> &cuts) {
    text_ = "% " + plainText(title) + "\n";
    sentence("G17");
    if (import_.safeZ)
      rapid("G0 Z" + numberText(*import_.safeZ), "");
    for (const Cut &cut : cuts)
      drive(cut);
    if (import_.back)
      sentence("G0" + target({import_.start[0], import_.start[1]}));
    return std::move(text_);
  }

private:
  void sentence(const std::string &words) {
    text_ += fmt::format("N{} {}\n", number_ += 10, words);
  }

  /// The first motion says what holds for all of them.
  void rapid(const std::string &words, const std::string &comment) {
    std::string more;
    if (first_ && import_.feed > 0)
      more += " F" + numberText(import_.feed);
    if (first_ && !import_.words.empty())
      more += " " + import_.words;
    first_ = false;
    sentence(words + more + comment);
  }

  void drive(const Cut &cut) {
    const std::string &layer = cut.contour.layer;
    here_ = rounded(cut.from);
    rapid("G0" + target(here_), layer == "0" ? "" : " (" + plainText(layer) + ")");
    functions(import_.on);
    if (import_.depth)
      sentence("G1 Z" + numberText(*import_.depth) +
               (import_.plungeFeed > 0 ? " F" + numberText(import_.plungeFeed) : ""));
    more_ = import_.depth && import_.plungeFeed > 0 ? " F" + numberText(import_.feed) : "";
    for (const std::string &one : import_.on)
      if (one.starts_with('H'))
        more_ += " " + one + " L0";
    if (cut.corrected)
      sentence((import_.tool == DxfTool::Left ? "G41 D" : "G42 D") +
               numberText(import_.toolRadius));
    contour(cut);
    if (cut.corrected && import_.avoidLoops)
      sentence("G60");
    if (cut.corrected)
      sentence("G40");
    if (import_.safeZ)
      sentence("G0 Z" + numberText(*import_.safeZ));
    functions(import_.off);
  }

  void functions(const std::vector<std::string> &all) {
    for (const std::string &one : all)
      if (!one.starts_with('H'))
        sentence(one);
  }

  void contour(const Cut &cut) {
    const Contour &contour = cut.contour;
    if (const Point start = rounded(contour.start()); start.x != here_.x || start.y != here_.y)
      motion("G1" + target(start), start);
    // Not before the lead-in: with it the contour would be a loop, as it ends where that does.
    if (cut.corrected && import_.avoidLoops)
      sentence("G61");
    for (const Piece &piece : contour.pieces) {
      if (&piece == &contour.pieces.back())
        for (const std::string &one : import_.off)
          if (one.starts_with('H'))
            more_ += " " + one + " O1";
      drive(piece);
    }
  }

  void drive(const Piece &piece) {
    const Point end = rounded(piece.end);
    const std::string middle = centre(piece.centre);
    if (piece.kind == Piece::Kind::Parabola)
      motion("G6" + target(end) + middle, end);
    else if (piece.kind == Piece::Kind::Arc && isArc(piece, end))
      motion(arcWords(piece, end, middle), end);
    else
      motion("G1" + target(end), end);
  }

  std::string arcWords(const Piece &piece, Point end, const std::string &middle) const {
    // Ends that the decoder takes for one place are no target.
    const std::string to = isOnePlace(piece, end) ? "" : target(end);
    if (isCircular(piece))
      return (piece.sweep > 0 ? "G3" : "G2") + to + middle;
    const double direction = std::atan2(piece.first.y, piece.first.x) * 180 / M_PI;
    const double ratio = std::min(1.0, norm(piece.second) / norm(piece.first));
    return (piece.sweep > 0 ? "G9" : "G8") + to + middle + " K" + numberText(direction) + " R" +
           numberText(ratio);
  }

  /// What the decoder takes for the same place, and a little more.
  [[nodiscard]] bool isOnePlace(const Piece &piece, Point end) const {
    constexpr double kSame = 4e-9;
    const double ratio = norm(piece.second) / norm(piece.first);
    return norm(end - here_) <=
           kSame * std::max({norm(piece.first), norm(here_), norm(end)}) / ratio;
  }

  /// Whether an arc is written as one: not if it is no more than a line.
  [[nodiscard]] bool isArc(const Piece &piece, Point end) const {
    if (std::abs(piece.sweep) > M_PI)
      return true;
    const double height = norm(piece.first) * (1 - std::cos(piece.sweep / 2));
    return !isOnePlace(piece, end) && height > std::min(1e-7, import_.epsilon / 10);
  }

  void motion(const std::string &words, Point end) {
    sentence(words + more_);
    more_.clear();
    here_ = end;
  }

  [[nodiscard]] static Point rounded(Point place) {
    return {roundedNumber(place.x), roundedNumber(place.y)};
  }
  [[nodiscard]] static std::string target(Point place) {
    return " X" + numberText(place.x) + " Y" + numberText(place.y);
  }
  [[nodiscard]] std::string centre(Point place) const {
    return " I" + numberText(place.x - here_.x) + " J" + numberText(place.y - here_.y);
  }

  const DxfImport &import_;
  std::string text_;
  std::string more_; ///< Words of the next motion.
  Point here_;
  int64_t number_ = 0;
  bool first_ = true;
};

} // namespace

std::string programText(const std::string &title, const std::vector<Cut> &cuts,
                        const DxfImport &import) {
  return Writer(import).write(title, cuts);
}

} // namespace stc::dxf
