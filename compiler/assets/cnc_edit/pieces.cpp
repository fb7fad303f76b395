// Sentences for the pieces of a motion.

#include "compiler/assets/cnc_edit/pieces.hpp"

#include "compiler/assets/cnc_edit/arc_words.hpp"
#include "compiler/assets/cnc_edit/word_edits.hpp"

#include "runtime/numeric/cnc/object_cut.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc::gcode {

namespace {

using namespace stride::cnc;

/// What decides about the curve between the ends.
constexpr std::string_view kShapeLetters = "IJKRT";
/// Writes the pieces of one motion.
class PieceWriter {
public:
  PieceWriter(std::string_view text, const CncTrace &trace, const CncVisit &visit,
              const Pieces &pieces, Diagnostics &diagnostics)
      : trace_(trace), visit_(visit), pieces_(pieces), diagnostics_(diagnostics),
        sentence_(trace.sentences[static_cast<size_t>(visit.sentence)]), first_(text, sentence_),
        switched_(pieces.objects.size() > 1 && wordOf(sentence_.words, 'H') != nullptr) {
    const CncTrace::Origin &origin = trace.origins[static_cast<size_t>(visit.origin)];
    for (size_t axis = 0; axis < kAxes; ++axis)
      here_[axis] = whole().start.coordinate[axis] - origin[axis];
  }

  std::optional<std::vector<std::string>> write() {
    const size_t errors = diagnostics_.errorCount();
    std::vector<std::string> lines(1);
    for (size_t i = 0; i < pieces_.objects.size(); ++i) {
      const std::string words = targetOf(i) + (pieces_.lines ? "" : shapeOfPiece(i)) + switches(i);
      if (i > 0)
        lines.push_back(fmt::format("{}{}G{}{}", first_.indent(), sentence_.skip ? "/" : "",
                                    pieces_.lines ? 1 : visit_.function, words));
    }
    if (diagnostics_.errorCount() != errors)
      return std::nullopt;
    removeOld();
    lines[0] = first_.apply();
    return lines;
  }

private:
  [[nodiscard]] const PathObject &whole() const {
    return trace_.objects[static_cast<size_t>(visit_.object)];
  }
  [[nodiscard]] const CncWord *word(char letter) const {
    return wordOf(sentence_.words, static_cast<uint8_t>(letter));
  }

  void refuse(const CncWord &word, const std::string &message, const std::string &label,
              const std::string &help) {
    refuseEdit(word.span, message, label, help, diagnostics_);
  }

  /// The axes of a piece. Those of the first are set where they stand.
  std::string targetOf(size_t piece) {
    std::string words;
    const CncTrace::Origin &origin = trace_.origins[static_cast<size_t>(visit_.origin)];
    const bool last = piece + 1 == pieces_.objects.size();
    for (size_t axis = 0; axis < kAxisWords.size(); ++axis) {
      const CncWord *old = word(kAxisWords[axis]);
      const double target = pieces_.objects[piece].end.coordinate[axis] - origin[axis];
      const double way = target - here_[axis];
      if (old == nullptr && isNothing(way, target))
        continue;
      const bool asBefore = last && old != nullptr && !visit_.relative;
      const double value = visit_.relative ? way : target;
      const std::string text = asBefore ? digitsOf(*old) : numberOf(value);
      here_[axis] = asBefore ? target : std::stod(text) + (visit_.relative ? here_[axis] : 0);
      if (piece > 0)
        words += fmt::format(" {}{}", kAxisWords[axis], text);
      else if (old == nullptr)
        first_.insertPlace(kAxisWords[axis] + text);
      else if (!(last || isNothing(old->word.value - value, value)))
        first_.setNumber(*old, text);
    }
    return words;
  }

  /// The number of a word as the text has it.
  [[nodiscard]] static std::string digitsOf(const CncWord &word) {
    return exactNumberText(word.word.value);
  }

  std::string numberOf(double value) {
    if (!isWritable(value)) {
      refuse(sentence_.words.front(), "a new value of this sentence is too large",
             fmt::format("{:g}", value), "values are less than 1e12");
      return "0";
    }
    // Lines instead of a curve are never where it was.
    return pieces_.lines ? numberText(value) : exactNumberText(value);
  }

  /// Centre, radius and the like of a piece.
  std::string shapeOfPiece(size_t piece) {
    const PathObject &object = pieces_.objects[piece];
    std::string words;
    const bool byRadius = word('R') != nullptr && isCircle(object.moveType);
    if (isCurve(object.moveType) && !byRadius)
      words += centre(piece);
    if (piece > 0 && isEllipse(object.moveType))
      for (const char letter : {'K', 'R'})
        if (const CncWord *one = word(letter))
          words += fmt::format(" {}{}", letter, digitsOf(*one));
    if (piece > 0 && byRadius)
      words += fmt::format(" R{}", digitsOf(*word('R')));
    return words;
  }

  std::string centre(size_t piece) {
    std::string words;
    const PathObject &object = pieces_.objects[piece];
    const CncTrace::Origin &origin = trace_.origins[static_cast<size_t>(visit_.origin)];
    const std::array<double, 3> way = centreWay(object);
    const size_t letters = isCircle(object.moveType) ? 3 : 2;
    for (size_t i = 0; i < letters; ++i) {
      const char letter = "IJK"[i];
      const CncWord *old = word(letter);
      const double start = object.start.coordinate[i] - origin[i];
      if (old == nullptr && isNothing(way[i], start))
        continue;
      const double value = way[i] + (visit_.centreAbsolute ? start : 0);
      const bool stays = old != nullptr && std::abs(old->word.value - value) <=
                                               1e-11 * std::max(1.0, std::abs(value));
      const std::string text = stays ? digitsOf(*old) : numberOf(value);
      if (piece > 0)
        words += fmt::format(" {}{}", letter, text);
      else if (old == nullptr)
        first_.insertPlace(letter + text);
      else if (!stays)
        first_.setNumber(*old, text);
    }
    return words;
  }

  /// The switch points of a piece, each with its place.
  std::string switches(size_t piece) {
    if (!switched_)
      return {};
    std::string words;
    const PathObject &object = pieces_.objects[piece];
    for (int i = 0; i <= kMostSwitches; ++i) {
      if (object.switchId[i] == 0)
        continue;
      const double part = object.switchPosition[i];
      const double way = part * object.length;
      const bool byWay = isByWay(i) && !pieces_.lines && way > 1e-9 && part < 1 - 1e-12;
      words += fmt::format(" H{} {}{}", object.switchId[i], byWay ? 'L' : 'O',
                           numberOf(byWay ? way : part));
    }
    if (piece == 0 && !words.empty())
      switches_ = words.substr(1);
    return words;
  }

  /// Whether the switch point of the sentence with this index has an L.
  [[nodiscard]] bool isByWay(int index) const {
    for (size_t i = 0; i + 1 < sentence_.words.size(); ++i)
      if (sentence_.words[i].word.letter == 'H' && index-- == 0)
        for (size_t k = i + 1; k < sentence_.words.size(); ++k)
          if (const uint8_t letter = sentence_.words[k].word.letter; letter == 'L' || letter == 'O')
            return letter == 'L';
    return false;
  }

  /// Words of the sentence that are said otherwise now.
  void removeOld() {
    for (const CncWord &one : sentence_.words) {
      const auto letter = static_cast<char>(one.word.letter);
      const bool switches = switched_ && (letter == 'H' || letter == 'L' || letter == 'O');
      const bool shape = pieces_.lines && kShapeLetters.find(letter) != kShapeLetters.npos;
      const bool turn = letter == 'T' && visit_.function > 1;
      if (switches || shape || turn)
        first_.remove(one);
    }
    if (pieces_.lines) {
      if (const CncWord *g = word('G'))
        first_.setNumber(*g, "1");
      else
        first_.insertBehind('N', "G1");
    }
    if (!switches_.empty())
      first_.append(switches_);
  }

  const CncTrace &trace_;
  const CncVisit &visit_;
  const Pieces &pieces_;
  Diagnostics &diagnostics_;
  const EditSentence &sentence_;
  SentenceText first_;
  bool switched_;                    ///< Its switch points are written anew.
  std::array<double, kAxes> here_{}; ///< Where the new sentences have come to.
  std::string switches_;             ///< Of the first piece.
};

/// Whether all is known that decides about a motion; else it is reported.
bool checkKnown(const EditSentence &sentence, const CncVisit &visit, Diagnostics &diagnostics) {
  for (const std::string_view letters : {kAxisWords, kShapeLetters, std::string_view("HLO")})
    for (const char letter : letters)
      if (const CncWord *one = wordOf(sentence.words, static_cast<uint8_t>(letter));
          one != nullptr && !one->variable.empty()) {
        refuseEdit(one->span, "a variable says this value, which would have to change",
                   fmt::format("`${}$`", one->variable), "write a number", diagnostics);
        return false;
      }
  unsigned needed = visit.function > 1 ? 7U : 0U;
  for (size_t axis = 0; axis < kAxisWords.size(); ++axis)
    if (wordOf(sentence.words, static_cast<uint8_t>(kAxisWords[axis])) != nullptr)
      needed |= 1U << axis;
  if (visit.relative || (visit.unknown & needed) == 0)
    return true;
  refuseEdit(sentence.words.front().span, "where this motion begins depends on a variable",
             "cannot be cut", "write numbers in the sentences before", diagnostics);
  return false;
}

/// What there is to say of a motion that cannot be cut.
void reportCut(CutError error, const CncWord &word, Diagnostics &diagnostics) {
  if (error == CutError::Profile)
    refuseEdit(word.span, "an axis goes in an S over all of this motion", "cannot be cut",
               "let it go evenly: S-3 to S-11", diagnostics);
  else
    refuseEdit(word.span, "this motion cannot be cut", "there is no room for a cut",
               "cut it elsewhere, or in fewer pieces", diagnostics);
}

} // namespace

std::optional<Pieces> cutMotion(const CncTrace &trace, const CncVisit &visit,
                                const std::vector<double> &ways, bool lines,
                                Diagnostics &diagnostics) {
  const EditSentence &sentence = trace.sentences[static_cast<size_t>(visit.sentence)];
  if (!checkKnown(sentence, visit, diagnostics))
    return std::nullopt;
  Pieces pieces;
  pieces.lines = lines;
  PathObject rest = trace.objects[static_cast<size_t>(visit.object)];
  double before = 0;
  for (const double way : ways) {
    PathObject part;
    const CutError error = splitObject(rest, way - before, part, rest);
    if (error != CutError::None) {
      reportCut(error, sentence.words.front(), diagnostics);
      return std::nullopt;
    }
    pieces.objects.push_back(part);
    before = way;
  }
  pieces.objects.push_back(rest);
  if (lines)
    for (PathObject &object : pieces.objects)
      object.moveType = MoveType::Line;
  return pieces;
}

std::optional<std::vector<std::string>> linesOf(std::string_view text, const CncTrace &trace,
                                                const CncVisit &visit, const Pieces &pieces,
                                                Diagnostics &diagnostics) {
  return PieceWriter(text, trace, visit, pieces, diagnostics).write();
}

} // namespace stc::gcode
