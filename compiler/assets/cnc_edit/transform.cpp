// Moves the path of a CNC program: rotation, shift, scale, reflection.

#include "compiler/assets/cnc_edit/transform.hpp"

#include "compiler/assets/cnc/internal.hpp"
#include "compiler/assets/cnc_edit/repeated_edits.hpp"

#include "runtime/numeric/cnc/decoder.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace stc {

namespace {

using namespace stride::cnc;

/// Letters of axes by AxisBit, and of centres.
constexpr std::string_view kLetters = "XYZABCPQUVW";
constexpr std::string_view kCentre = "IJK";

/// Places that are closer are the same. [u]
constexpr double kSame = 1e-6;

/// Jumps are followed so far.
constexpr size_t kMostJumps = 1'000'000;

using Place = std::array<double, kAxes>;

Place moved(const CncTransform &transform, const Place &place) {
  Place result = place;
  for (size_t row = 0; row < 3; ++row)
    result[row] = transform.linear[row][0] * place[0] + transform.linear[row][1] * place[1] +
                  transform.linear[row][2] * place[2];
  for (size_t axis = 0; axis < kAxes; ++axis)
    result[axis] += transform.shift[axis];
  return result;
}

bool isArc(int32_t function) { return function == 2 || function == 3; }
bool isEllipticArc(int32_t function) { return function == 8 || function == 9; }
bool isMotionFunction(int32_t function) {
  return (function >= 0 && function <= 10 && function != 4 && function != 7) || function == 31;
}

/// Keeps what `about` is where it is.
void keepInPlace(CncTransform &transform, const double (&about)[kAxes]) {
  Place place{};
  std::copy(std::begin(about), std::begin(about) + 3, place.begin());
  const Place there = moved(transform, place);
  for (size_t axis = 0; axis < 3; ++axis)
    transform.shift[axis] = place[axis] - there[axis];
}

class Transformer {
public:
  Transformer(const SourceFile &file, const CncProgram &program, const CncTransform &transform,
              Diagnostics &diagnostics)
      : transform_(transform), diagnostics_(diagnostics), edits_(file.text()), sentences_(program) {
  }

  std::optional<std::string> run() {
    startDecoder(*decoder_, Position{});
    size_t left = kMostJumps;
    for (int64_t at = 0; at < sentences_.size();) {
      const int64_t begin = at;
      at = sentences_.at(begin, sentence_);
      watch_.pass(sentence_);
      decodeSentence(*decoder_, sentence_.words, sentence_.count, sentence_.line, *decoded_);
      if (sentence_.count > 0)
        visit(begin);
      if (decoded_->next != Next::Jump)
        continue;
      // After an error what a loop does once more says nothing new.
      if (failed() || watch_.jumpsForEver(begin, decoder_->counter))
        break;
      at = sentences_.find(decoded_->target);
      if (at < 0 || !checkLength(left))
        break;
    }
    return failed() ? std::nullopt : std::optional(edits_.apply());
  }

private:
  /// The left word with a letter, which is the one that counts; null: there is none.
  [[nodiscard]] const CncWord *find(char letter) const {
    for (int32_t i = 0; i < sentence_.count; ++i)
      if (sentence_.words[i].letter == letter)
        return sentences_.source(sentence_, i);
    return nullptr;
  }
  [[nodiscard]] bool has(char letter) const { return find(letter) != nullptr; }

  void refuse(const CncWord &word, const std::string &message, const std::string &label,
              const std::string &help) {
    gcode::refuseEdit(word.span, message, label, help, diagnostics_);
  }
  void refuseRepeated(const CncWord &word, const std::string &label) {
    refuse(word, "jumps lead here in several ways, and each needs another text", label,
           "write the sentences of the loop one after another, or move the coordinates with G54");
  }
  [[nodiscard]] bool failed() const { return diagnostics_.errorCount() != errors_; }

  /// A sentence is carried out.
  void visit(int64_t begin) {
    edits_.begin(begin);
    const size_t errors = diagnostics_.errorCount();
    step();
    if (diagnostics_.errorCount() == errors && !edits_.end())
      refuseRepeated(*anchorOf(), "another time its words would have to change");
  }

  /// How many more sentences may come, at a jump.
  bool checkLength(size_t &left) {
    if (left-- > 0)
      return true;
    refuse(*anchorOf(), "this program jumps too often to be followed", "reached up to here",
           fmt::format("programs of up to {} jumps can be moved", kMostJumps));
    return false;
  }

  /// Whether a transform changes coordinates of an axis; `ways`: differences of them.
  [[nodiscard]] bool changes(size_t axis, bool ways) const {
    if (!ways && transform_.shift[axis] != 0)
      return true;
    if (axis >= 3)
      return false;
    for (size_t column = 0; column < 3; ++column)
      if (transform_.linear[axis][column] != (axis == column ? 1 : 0))
        return true;
    return false;
  }

  /// Gives a word another value. The value that it has then.
  double set(const CncWord &word, double value) {
    if (!word.variable.empty())
      refuse(word, "a variable says this value, which would have to change",
             fmt::format("`${}$`", word.variable),
             "write a number, or change the coordinates in the program: G54 shifts, and turns and "
             "scales with `softmotion = \"3\"`");
    else if (!gcode::isWritable(value))
      refuse(word, "the new value of this word is too large", fmt::format("{:g}", value),
             "values are less than 1e12");
    else if (const std::optional<double> read = edits_.setNumber(word, value))
      return *read;
    else
      refuseRepeated(word, fmt::format("would have to be {:g} now", value));
    return value;
  }

  /// Sets the word with the letter, which is put behind `anchor` if the sentence has none. The
  /// value that it has then.
  double write(char letter, double value, const CncWord &anchor) {
    if (const CncWord *word = find(letter))
      return set(*word, value);
    if (!gcode::isWritable(value))
      refuse(anchor, "a new word of this sentence is too large", fmt::format("{:g}", value),
             "values are less than 1e12");
    else if (const std::optional<double> read = edits_.insertAfter(anchor, letter, value))
      return *read;
    else
      refuseRepeated(anchor, fmt::format("would need {}{:g} now", letter, value));
    return value;
  }
  /// Whether the sentence's word with the letter was new or was changed when it was carried out
  /// before.
  [[nodiscard]] bool wasWritten(char letter) const {
    const CncWord *word = find(letter);
    return word != nullptr ? edits_.changed(*word) : edits_.inserted(letter);
  }

  /// Behind which word new ones may stand: an axis, a centre, the function, the number.
  [[nodiscard]] const CncWord *anchorOf() const {
    for (const char letter : std::string_view("ZYXKJIGN"))
      if (const CncWord *word = find(letter))
        return word;
    const int32_t first = sentence_.count > 1 && sentence_.words[0].letter == kSkip ? 1 : 0;
    return sentences_.source(sentence_, first);
  }

  void step() {
    const CncWord *g = find('G');
    int32_t function = g != nullptr ? g->word.integer : -1;
    if (has('M'))
      return;
    if (g != nullptr && !checkFunction(*g, function))
      return;
    if (function == 41 || function == 42) {
      if (swapsDirections() || edits_.changed(*g))
        set(*g, swapsDirections() ? 83 - function : function);
      return;
    }
    if (g == nullptr)
      function = decoder_->motion;
    const bool motion = isMotionFunction(function);
    if (motion)
      writeFunction(g, function);
    if (motion || function == 92)
      move(function);
  }

  /// What cannot be moved. False: it is reported.
  bool checkFunction(const CncWord &g, int32_t function) {
    if (function == 20 && !checkJump(g))
      return false;
    if (function >= 54 && function <= 56) {
      refuse(g, "the program moves its coordinates itself", "its words are not places of the path",
             "change the words of this sentence, or take it away");
      return false;
    }
    if (function == 16 && (transform_.turns || transform_.mirrored >= 0)) {
      refuse(g, "a plane that is given by its normal cannot be turned", "this plane",
             "choose a plane with G17, G18 or G19");
      return false;
    }
    return true;
  }

  /// Whether it is known now where a jump leads.
  bool checkJump(const CncWord &g) {
    const CncWord *decides = watch_.isDecided() ? nullptr : &g;
    for (const char letter : {'K', 'L'})
      if (const CncWord *word = find(letter); word != nullptr && !word->variable.empty())
        decides = word;
    if (decides != nullptr)
      refuse(*decides, "a variable decides about this jump", "where the path goes on is not known",
             "the counter (G36, G37 without O) with numbers can decide");
    else if (sentence_.skip && (isAstray() || transform_.turns))
      refuse(g, "this jump may be suppressed, and others depend on it",
             "where the path goes on is not known", "take the / or the sentence away");
    else
      return true;
    return false;
  }

  /// Whether clockwise becomes counterclockwise, seen along the normal of the plane.
  [[nodiscard]] bool swapsDirections() const {
    const double normal[3] = {decoder_->normal.x, decoder_->normal.y, decoder_->normal.z};
    return transform_.mirrored >= 0 && std::abs(normal[transform_.mirrored]) < 0.5;
  }

  /// The G function of a motion: the other direction of arcs, if it is mirrored. Where the function
  /// stays from a sentence before in another plane, it may have to be written.
  void writeFunction(const CncWord *g, int32_t function) {
    int32_t wanted = function;
    if ((isArc(function) || isEllipticArc(function)) && swapsDirections())
      wanted = isArc(function) ? 5 - function : 17 - function;
    if (g != nullptr && (wanted != function || edits_.changed(*g)))
      set(*g, wanted);
    else if (g == nullptr && isTarget(function) &&
             !edits_.keepFunction(*anchorOf(), wanted, wanted != motion_))
      refuseRepeated(*anchorOf(), fmt::format("would have to be G{} now", wanted));
    if (function != 31 && (g != nullptr || isTarget(function)))
      motion_ = wanted;
  }

  /// Whether the sentence moves something, or jumps (G92).
  [[nodiscard]] bool isTarget(int32_t function) const {
    if (std::any_of(kLetters.begin(), kLetters.end(), [this](char c) { return has(c); }))
      return true;
    return (isArc(function) || isEllipticArc(function)) && (has('I') || has('J') || has('K'));
  }

  [[nodiscard]] Place targetOf(bool opening) const {
    Place target = old_;
    for (size_t axis = 0; axis < kLetters.size(); ++axis)
      if (const CncWord *word = find(kLetters[axis]); word != nullptr && word->variable.empty())
        target[axis] = word->word.value + (decoder_->relative ? old_[axis] : 0);
    if (opening)
      std::copy(std::begin(decoder_->here.coordinate), std::begin(decoder_->here.coordinate) + 3,
                target.begin());
    return target;
  }

  void move(int32_t function) {
    const CncWord *turn = isArc(function) || isEllipticArc(function) ? find('T') : nullptr;
    if (!isTarget(function) || !checkMotion(function, turn))
      return;
    const Place target = targetOf(turn != nullptr);
    writeCentre(function);
    writeTarget(target, turn != nullptr);
    writeWays();
    old_ = target;
  }

  /// What is not where it should be, since the path has begun elsewhere.
  [[nodiscard]] bool isAstray() const {
    const Place place = moved(transform_, old_);
    for (size_t axis = 0; axis < kAxes; ++axis)
      if (std::abs(place[axis] - new_[axis]) > kSame * std::max(1.0, std::abs(place[axis])))
        return true;
    return false;
  }

  bool checkMotion(int32_t function, const CncWord *turn) {
    const bool spline = function == 5 || function == 10;
    const bool straight = function == 0 || function == 1 || function == 31 || function == 92;
    const bool astray = isAstray();
    if ((astray && !straight) || (spline && fromElsewhere_)) {
      refuse(*anchorOf(), "the path begins with a curve, and its start does not move along",
             "would become another curve",
             "go to where the curve begins with G0 or G1 before; before a spline with two of them");
      return false;
    }
    fromElsewhere_ = astray && function != 92;
    if (sentence_.skip && (astray || transform_.turns)) {
      refuse(*anchorOf(), "this sentence may be suppressed, and others depend on it",
             "where the path goes on is not known", "take the / or the sentence away");
      return false;
    }
    if (turn != nullptr && !turn->variable.empty()) {
      refuse(*turn, "a variable says where this arc ends", "what follows depends on it",
             "write a number, or the target instead of the angle");
      return false;
    }
    if (transform_.turns && isArc(function) && std::abs(decoder_->normal.z) < 0.5) {
      refuse(*anchorOf(), "an arc in this plane cannot be turned about Z",
             "would lie in none of the planes of X, Y and Z",
             "write it as lines, or turn the coordinates with G54 (`softmotion = \"3\"`)");
      return false;
    }
    return true;
  }

  void writeTarget(const Place &target, bool opening) {
    const CncWord &anchor = *anchorOf();
    const Place wanted = moved(transform_, target);
    const bool both = transform_.turns && (has('X') || has('Y'));
    for (size_t axis = 0; axis < kLetters.size(); ++axis) {
      const bool named = has(kLetters[axis]);
      const bool astray = std::abs(wanted[axis] - new_[axis]) > kSame;
      const bool relative = decoder_->relative;
      const bool written = wasWritten(kLetters[axis]);
      if (relative && named && !written && !astrayAxis(axis) && !changes(axis, true)) {
        new_[axis] += target[axis] - old_[axis]; // it stays, be it a variable
        continue;
      }
      if (!changes(axis, false)) {
        new_[axis] = wanted[axis];
        continue;
      }
      if (opening && !named) {
        new_[axis] = wanted[axis];
        continue;
      }
      if (!named && !written && !astray && !(both && axis < 2))
        continue;
      const double value = relative ? wanted[axis] - new_[axis] : wanted[axis];
      const double read = write(kLetters[axis], value, anchor);
      new_[axis] = opening ? wanted[axis] : read + (relative ? new_[axis] : 0);
    }
  }

  [[nodiscard]] bool astrayAxis(size_t axis) const {
    return std::abs(moved(transform_, old_)[axis] - new_[axis]) > kSame;
  }

  /// Centres, radii, directions of axes.
  void writeCentre(int32_t function) {
    if (!isArc(function) && !isEllipticArc(function) && function != 6)
      return;
    const size_t places = isArc(function) ? 3 : 2;
    const bool absolute = decoder_->centreAbsolute;
    Place centre{};
    for (size_t i = 0; i < places; ++i) {
      const CncWord *word = find(kCentre[i]);
      centre[i] = word != nullptr ? word->word.value : absolute ? old_[i] : 0;
    }
    CncTransform transform = transform_;
    if (!absolute)
      std::fill(std::begin(transform.shift), std::end(transform.shift), 0.0);
    const Place wanted = moved(transform, centre);
    const bool both = transform_.turns && (has('I') || has('J'));
    for (size_t i = 0; i < places; ++i)
      if ((changes(i, !absolute) && (has(kCentre[i]) || (both && i < 2))) || wasWritten(kCentre[i]))
        write(kCentre[i], wanted[i], *anchorOf());
    const CncWord *radius = find('R');
    if (radius != nullptr && isArc(function) && transform_.factor != 1)
      set(*radius, radius->word.value * transform_.factor);
    if (isEllipticArc(function))
      writeDirection();
  }

  /// K of an ellipse: the direction of its main axis.
  void writeDirection() {
    const CncWord *word = find('K');
    const double direction = word != nullptr ? word->word.value : 0;
    if (transform_.turns)
      write('K', direction + transform_.angle, *anchorOf());
    else if (word != nullptr && (swapsDirections() || edits_.changed(*word)))
      set(*word, swapsDirections() ? -direction : direction);
  }

  /// L of switch points are ways.
  void writeWays() {
    if (transform_.factor == 1 || !has('H'))
      return;
    for (int32_t i = 0; i < sentence_.count; ++i)
      if (sentence_.words[i].letter == 'L')
        if (const CncWord *word = sentences_.source(sentence_, i))
          set(*word, word->word.value * transform_.factor);
  }

  const CncTransform &transform_;
  Diagnostics &diagnostics_;
  size_t errors_ = diagnostics_.errorCount();
  gcode::RepeatedEdits edits_;
  gcode::Sentences sentences_;
  gcode::JumpWatch watch_;
  std::unique_ptr<Decoder> decoder_ = std::make_unique<Decoder>();
  std::unique_ptr<Decoded> decoded_ = std::make_unique<Decoded>();
  SentenceWords sentence_{};
  Place old_{};                ///< Where the path is.
  Place new_{};                ///< Where the new one is.
  int32_t motion_ = -1;        ///< The function that the new program repeats.
  bool fromElsewhere_ = false; ///< The last motion has begun where the path begins.
};

} // namespace

CncTransform cncRotation(double angle, const double (&about)[kAxes]) {
  // Right angles are exact.
  const double quarter = std::remainder(angle, 360) / 90;
  const bool right = quarter == std::floor(quarter);
  const double radians = quarter * M_PI / 2;
  const double cosine = right ? std::round(std::cos(radians)) : std::cos(radians);
  const double sine = right ? std::round(std::sin(radians)) : std::sin(radians);
  CncTransform transform;
  transform.linear[0][0] = transform.linear[1][1] = cosine;
  transform.linear[0][1] = -sine;
  transform.linear[1][0] = sine;
  transform.angle = angle;
  transform.turns = true;
  keepInPlace(transform, about);
  return transform;
}

CncTransform cncScale(double factor, const double (&about)[kAxes]) {
  CncTransform transform;
  for (size_t axis = 0; axis < 3; ++axis)
    transform.linear[axis][axis] = factor;
  transform.factor = factor;
  keepInPlace(transform, about);
  return transform;
}

CncTransform cncReflection(int axis, double at) {
  CncTransform transform;
  transform.linear[axis][axis] = -1;
  transform.shift[axis] = 2 * at;
  transform.mirrored = axis;
  return transform;
}

CncTransform cncShift(const double (&by)[kAxes]) {
  CncTransform transform;
  std::copy(std::begin(by), std::end(by), std::begin(transform.shift));
  return transform;
}

std::optional<std::string> transformCnc(const SourceFile &file, const CncTransform &transform,
                                        Diagnostics &diagnostics) {
  const std::optional<CncProgram> program = gcode::readForEdit(file, diagnostics);
  if (!program)
    return std::nullopt;
  return Transformer(file, *program, transform, diagnostics).run();
}

} // namespace stc
