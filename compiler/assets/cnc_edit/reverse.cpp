// The path of a CNC program the other way round.

#include "compiler/assets/cnc_edit/reverse.hpp"

#include "compiler/assets/cnc_edit/arc_words.hpp"
#include "compiler/assets/cnc_edit/path_match.hpp"
#include "compiler/assets/cnc_edit/reverse_words.hpp"
#include "compiler/assets/cnc_edit/word_edits.hpp"

#include "runtime/numeric/cnc/object_reverse.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc {

namespace {

using namespace stride::cnc;
using namespace gcode;

/// The other direction of an arc.
int32_t turnedFunction(int32_t function) {
  return function == 2 || function == 3   ? 5 - function
         : function == 8 || function == 9 ? 17 - function
                                          : function;
}

class Reverser {
public:
  Reverser(const SourceFile &file, const CncProgram &program, const CncTrace &trace,
           const ReversePlan &plan, Diagnostics &diagnostics)
      : text_(file.text()), program_(program), trace_(trace), plan_(plan),
        diagnostics_(diagnostics), rows_(linesOf(file.text())), old_(trace.objects),
        words_(trace, plan, program.settings.softMotion3, diagnostics) {
    noteWhatGoesOn(old_);
    std::copy(std::begin(program.settings.start.coordinate),
              std::end(program.settings.start.coordinate), here_.begin());
  }

  std::optional<std::string> run() {
    const size_t errors = diagnostics_.errorCount();
    sort();
    measure();
    const bool empty = trace_.sentences.empty();
    emitRows(0, empty ? rows_.size() : rowOf(0));
    for (size_t i = 0; i < plan_.prologue; ++i)
      stay(i);
    const size_t first = plan_.positions ? 1 : 0;
    if (plan_.positions) {
      emitFunctions(0);
      position(plan_.motions.front());
    } else {
      insertPosition();
    }
    for (size_t k = plan_.motions.size(); k > first; --k) {
      emitGap(k);
      motion(k - 1);
    }
    emitModes(first);
    if (first > 0)
      emitModes(0);
    emitFunctions(first);
    if (!empty)
      emitRows(rowOf(trace_.sentences.size() - 1) + 1, rows_.size());
    if (diagnostics_.errorCount() != errors)
      return std::nullopt;
    std::string text = assemble();
    return check(text) ? std::optional(std::move(text)) : std::nullopt;
  }

private:
  using Axes = std::array<double, kAxes>;

  [[nodiscard]] const EditSentence &sentenceAt(size_t index) const {
    return trace_.sentences[index];
  }
  [[nodiscard]] const CncWord *find(size_t sentence, char letter) const {
    return wordOf(sentenceAt(sentence).words, static_cast<uint8_t>(letter));
  }
  [[nodiscard]] const PathObject *objectOf(size_t sentence) const {
    const int32_t object = trace_.visits[sentence].object;
    return object >= 0 ? &old_[static_cast<size_t>(object)] : nullptr;
  }
  [[nodiscard]] size_t rowOf(size_t sentence) const {
    return static_cast<size_t>(sentenceAt(sentence).line) - 1;
  }

  void refuse(size_t sentence, const std::string &message, const std::string &label,
              const std::string &help) {
    refuseEdit(sentenceAt(sentence).words.front().span, message, label, help, diagnostics_);
  }

  // ---- the order

  /// What stands between motions. Functions before and after a contour change places with it.
  void sort() {
    functions_.resize(plan_.motions.size() + 1);
    modes_.resize(functions_.size());
    size_t gap = 0;
    for (size_t i = plan_.prologue; i < plan_.sentences.size(); ++i) {
      if (plan_.sentences[i].kind == SentenceKind::Motion)
        ++gap;
      else
        (plan_.sentences[i].kind == SentenceKind::Function ? functions_ : modes_)[gap].push_back(i);
    }
    const size_t count = plan_.motions.size();
    for (size_t begin = 0; begin < count;) {
      if (isRapid(begin)) {
        ++begin;
        continue;
      }
      size_t end = begin;
      while (end + 1 < count && !isRapid(end + 1))
        ++end;
      std::swap(functions_[begin], functions_[end + 1]);
      begin = end + 1;
    }
  }

  [[nodiscard]] bool isRapid(size_t motion) const {
    const int32_t function = plan_.sentences[plan_.motions[motion]].function;
    return function == 0 || function == 92;
  }

  /// What stands before a motion, and on the way back behind it.
  void emitGap(size_t gap) {
    const bool begins =
        !isRapid(gap - 1) && (gap == plan_.motions.size() || isRapid(gap)); // a contour
    if (begins)
      emitFunctions(gap);
    emitModes(gap);
    emitFunctions(gap);
  }

  void emitModes(size_t gap) {
    for (auto i = modes_[gap].rbegin(); i != modes_[gap].rend(); ++i)
      mode(*i);
  }

  void emitFunctions(size_t gap) {
    for (const size_t i : functions_[gap])
      function(i);
    functions_[gap].clear();
  }

  /// Where each motion begins, and where the last one ends.
  void measure() {
    Axes place = here_;
    for (const size_t i : plan_.motions) {
      before_.push_back(place);
      if (const PathObject *object = objectOf(i)) {
        std::copy(std::begin(object->end.coordinate), std::end(object->end.coordinate),
                  place.begin());
        continue;
      }
      for (size_t axis = 0; axis < kAxisWords.size(); ++axis) // a jump
        if (const CncWord *word = find(i, kAxisWords[axis]))
          place[axis] = word->word.value + (trace_.visits[i].relative ? place[axis] : 0);
    }
    end_ = place;
  }

  // ---- lines

  void emitRows(size_t from, size_t to) {
    for (size_t row = from; row < to; ++row)
      out_.emplace_back(text_.substr(rows_[row].begin, rows_[row].end - rows_[row].begin));
  }

  /// The line of a sentence, with the comments above it.
  void emit(size_t sentence, const std::string &line) {
    if (sentence > 0)
      emitRows(rowOf(sentence - 1) + 1, rowOf(sentence));
    out_.push_back(line);
  }

  std::string assemble() const {
    std::string text;
    const std::string_view ending =
        rows_.empty() || rows_.front().ending.empty() ? "\n" : rows_.front().ending;
    const bool open = !rows_.empty() && rows_.back().ending.empty();
    for (const std::string &line : out_) {
      text += line;
      if (!(open && &line == &out_.back()))
        text += ending;
    }
    return text;
  }

  // ---- sentences

  void stay(size_t i) {
    const PlannedSentence &planned = plan_.sentences[i];
    words_.keep(i);
    if (planned.kind == SentenceKind::Function)
      expectFunction(i);
    emitAsItIs(i);
  }

  void emitAsItIs(size_t i) {
    noteMotion(i);
    const TextLine &row = rows_[rowOf(i)];
    emit(i, std::string(text_.substr(row.begin, row.end - row.begin)));
  }

  /// A function of motions that moves nothing is repeated by what follows.
  void noteMotion(size_t i) {
    const int32_t function = plan_.sentences[i].function;
    if (plan_.sentences[i].kind == SentenceKind::Words && find(i, 'G') != nullptr && function <= 10)
      motion_ = function;
  }

  void function(size_t i) {
    SentenceText line(text_, sentenceAt(i));
    words_.writeWords(line, i, false);
    expectFunction(i);
    emit(i, line.apply());
  }

  /// A sentence without a place on the path.
  void mode(size_t i) {
    if (sentenceAt(i).words.empty())
      return emitAsItIs(i);
    SentenceText line(text_, sentenceAt(i));
    if (plan_.sentences[i].kind == SentenceKind::Mode)
      words_.writeMode(line, i);
    else
      words_.writeWords(line, i, true);
    noteMotion(i);
    emit(i, line.apply());
  }

  void expectFunction(size_t i) {
    const auto [first, last] =
        std::equal_range(trace_.visitOf.begin(), trace_.visitOf.end(), static_cast<int32_t>(i));
    for (auto at = first; at != last; ++at)
      if (const PathObject &object = old_[static_cast<size_t>(at - trace_.visitOf.begin())];
          object.moveType == MoveType::Function)
        expect(object, i);
  }

  /// An object of the new path, where the path is.
  void expect(PathObject object, size_t sentence) {
    std::copy(here_.begin(), here_.end(), std::begin(object.start.coordinate));
    if (object.moveType == MoveType::Function)
      std::copy(here_.begin(), here_.end(), std::begin(object.end.coordinate));
    expected_.push_back(object);
    origin_.push_back(sentence);
  }

  // ---- motions

  [[nodiscard]] bool isRelative() const { return words_.mode(kRelativeMode) == 91; }

  /// The first motion goes to where the path has ended.
  void position(size_t i) {
    const EditSentence &sentence = sentenceAt(i);
    if (find(i, 'H') != nullptr)
      return refuse(i, "the motion to the path has switch points", "will be another motion",
                    "put them into a motion of the path");
    SentenceText line(text_, sentence);
    words_.keepWords(i);
    for (size_t axis = 0; axis < kAxisWords.size(); ++axis) {
      const std::string number = exactNumberText(end_[axis] - (isRelative() ? here_[axis] : 0));
      if (const CncWord *word = find(i, kAxisWords[axis]))
        line.setNumber(*word, number);
      else if (!isNothing(end_[axis] - here_[axis], end_[axis]))
        line.insertPlace(kAxisWords[axis] + number);
    }
    if (plan_.sentences[i].function == 0) {
      if (find(i, 'G') == nullptr && motion_ != 0)
        line.insertBehind('N', "G0");
      motion_ = 0;
      expectPosition(i);
    }
    here_ = end_;
    emit(i, line.apply());
  }

  /// A path that begins with a contour needs a way to its end first.
  void insertPosition() {
    if (plan_.motions.empty())
      return;
    std::string words;
    for (size_t axis = 0; axis < kAxisWords.size(); ++axis)
      if (!isNothing(end_[axis] - here_[axis], end_[axis]))
        words += fmt::format(" {}{}", kAxisWords[axis],
                             exactNumberText(end_[axis] - (isRelative() ? here_[axis] : 0)));
    if (words.empty())
      return;
    for (const std::string &word : words_.missingWords(plan_.motions.back()))
      words += " " + word;
    out_.push_back("G0" + words);
    motion_ = 0;
    expectPosition(plan_.motions.back());
    here_ = end_;
  }

  void expectPosition(size_t i) {
    positioned_ = expected_.size();
    expected_.emplace_back();
    origin_.push_back(i);
  }

  void motion(size_t index) {
    const size_t i = plan_.motions[index];
    for (const std::string &line : words_.missingModes(i))
      out_.push_back(line);
    const int32_t function = plan_.sentences[i].function;
    const int32_t turned = turnedFunction(function);
    SentenceText line(text_, sentenceAt(i));
    const CncWord *g = find(i, 'G');
    if (g != nullptr && turned != function)
      line.setNumber(*g, std::to_string(turned));
    else if (g == nullptr && motion_ != turned)
      line.insertBehind('N', fmt::format("G{}", turned));
    if (function != 92)
      motion_ = turned;
    writeTarget(line, i, before_[index]);
    if (const PathObject *object = objectOf(i)) {
      writeCurve(line, i, *object);
      writeSwitches(line, i);
      PathObject back = reversed(*object, object->velocity);
      constexpr unsigned kSides = kToolLeft | kToolRight;
      if ((back.marks & kSides) != 0)
        back.marks = static_cast<uint8_t>(back.marks ^ kSides);
      expect(back, i);
    }
    here_ = before_[index];
    words_.writeMotion(line, i);
    emit(i, line.apply());
  }

  /// The place where the motion has begun.
  void writeTarget(SentenceText &line, size_t i, const Axes &before) {
    const bool relative = isRelative();
    for (size_t axis = 0; axis < kAxisWords.size(); ++axis) {
      const CncWord *word = find(i, kAxisWords[axis]);
      const double way = before[axis] - here_[axis];
      if (word == nullptr && isNothing(way, before[axis]))
        continue;
      const double value = !relative ? before[axis] : word != nullptr ? -word->word.value : way;
      if (!isWritable(value))
        return refuse(i, "a new value of this sentence is too large", fmt::format("{:g}", value),
                      "values are less than 1e12");
      if (word == nullptr)
        line.insertPlace(kAxisWords[axis] + exactNumberText(value));
      else if (value != word->word.value)
        line.setNumber(*word, exactNumberText(value));
    }
  }

  void writeCurve(SentenceText &line, size_t i, const PathObject &object) {
    const int32_t function = plan_.sentences[i].function;
    if (function < 2 || function == 5 || function == 10)
      return;
    if (!isCurve(object.moveType))
      return refuse(i, "a line is made of this curve", "its centre does not fit",
                    "write G1, or correct its centre");
    if (const CncWord *turn = find(i, 'T'))
      line.remove(*turn);
    if (isCircle(object.moveType) && find(i, 'R') != nullptr)
      return;
    const std::array<double, 3> way = centreWay(reversed(object, 0));
    const size_t letters = isCircle(object.moveType) ? 3 : 2;
    const bool absolute = words_.mode(kCentreMode) == 98;
    for (size_t k = 0; k < letters; ++k) {
      const CncWord *word = find(i, "IJK"[k]);
      const double value = way[k] + (absolute ? here_[k] : 0);
      if (word == nullptr && !isNothing(way[k], here_[k]))
        line.insertPlace("IJK"[k] + exactNumberText(value));
      else if (word != nullptr &&
               !(std::abs(word->word.value - value) <= 1e-11 * std::max(1.0, std::abs(value))))
        line.setNumber(*word, exactNumberText(value));
    }
  }

  /// Ways from the start are ways from the end now; parts count from the other end.
  void writeSwitches(SentenceText &line, size_t i) {
    if (find(i, 'H') == nullptr)
      return;
    for (const CncWord &word : sentenceAt(i).words) {
      if (word.word.letter == 'O')
        line.setNumber(word, exactNumberText(1 - word.word.value));
      else if (word.word.letter == 'L' && word.word.value == 0)
        line.replace(word, "O1");
      else if (word.word.letter == 'L')
        line.setNumber(word, exactNumberText(-word.word.value));
    }
  }

  /// Whether the new text makes the path that it should.
  bool check(const std::string &text) {
    std::optional<Path> made = pathOfText(text, program_.settings);
    if (made) {
      noteWhatGoesOn(*made);
      std::erase_if(*made,
                    [](const PathObject &object) { return object.moveType == MoveType::Jump; });
      if (positioned_ < made->size() && positioned_ < expected_.size())
        expected_[positioned_] = (*made)[positioned_];
    }
    const std::optional<size_t> at =
        made ? firstDifference(expected_, *made) : std::optional(size_t{0});
    if (!at || plan_.motions.empty())
      return true;
    const size_t i = *at < origin_.size() ? origin_[*at] : plan_.motions.front();
    refuse(i, "this program cannot be reversed so that its path stays",
           "here it would be another one",
           "a spline beside an M function is such a case: make lines of it with stride cnc expand");
    return false;
  }

  std::string_view text_;
  const CncProgram &program_;
  const CncTrace &trace_;
  const ReversePlan &plan_;
  Diagnostics &diagnostics_;
  std::vector<TextLine> rows_;
  Path old_;                                   ///< The path as it was.
  std::vector<std::vector<size_t>> functions_; ///< Sentences before the motion with this index.
  std::vector<std::vector<size_t>> modes_;     ///< Likewise.
  std::vector<std::string> out_;               ///< Lines.
  ReverseWords words_;
  int32_t motion_ = -1;          ///< The function that new sentences repeat.
  Axes here_{};                  ///< Where the new path is.
  std::vector<Axes> before_;     ///< Where motions began.
  Axes end_{};                   ///< Where the old path ended.
  Path expected_;                ///< The new path.
  std::vector<size_t> origin_;   ///< Of its objects: sentence.
  size_t positioned_ = SIZE_MAX; ///< Which of them leads to the path.
};

} // namespace

std::optional<std::string> reverseCnc(const SourceFile &file, const CncStart &start,
                                      Diagnostics &diagnostics) {
  std::optional<CncProgram> program = readForTrace(file, diagnostics);
  if (!program)
    return std::nullopt;
  program->settings.start = start.position;
  program->settings.softMotion3 = start.softMotion3;
  const std::optional<CncTrace> trace = traceCnc(*program, diagnostics);
  if (!trace)
    return std::nullopt;
  const std::optional<ReversePlan> plan = planReverse(*trace, start.softMotion3, diagnostics);
  if (!plan)
    return std::nullopt;
  return Reverser(file, *program, *trace, *plan, diagnostics).run();
}

} // namespace stc
