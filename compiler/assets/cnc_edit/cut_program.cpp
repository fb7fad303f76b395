// A CNC program with other sentences for some of its motions.

#include "compiler/assets/cnc_edit/cut_program.hpp"

#include "compiler/assets/cnc_edit/word_edits.hpp"

#include <algorithm>

namespace stc::gcode {

namespace {

using namespace stride::cnc;

constexpr std::string_view kMoving = "XYZABCPQUVWIJKT";

class Cutter {
public:
  Cutter(const SourceFile &file, const CncTrace &trace, const CutRule &rule,
         Diagnostics &diagnostics)
      : text_(file.text()), trace_(trace), rule_(rule), diagnostics_(diagnostics),
        lines_(trace.sentences.size()), reached_(trace.sentences.size()) {}

  std::optional<std::string> run() {
    const size_t errors = diagnostics_.errorCount();
    for (size_t i = 0; i < trace_.visits.size() && diagnostics_.errorCount() == errors; ++i)
      cut(i);
    checkReached();
    if (diagnostics_.errorCount() != errors)
      return std::nullopt;
    std::string text = write();
    if (!check(text))
      return std::nullopt;
    return text;
  }

private:
  const CncWord &firstWord(int32_t sentence) const {
    return trace_.sentences[static_cast<size_t>(sentence)].words.front();
  }

  void cut(size_t index) {
    const CncVisit &visit = trace_.visits[index];
    const auto sentence = static_cast<size_t>(visit.sentence);
    const bool again = reached_[sentence];
    reached_[sentence] = true;
    if (visit.object < 0)
      return;
    const auto ways = rule_.cuts(trace_, visit);
    std::optional<Pieces> pieces;
    std::vector<std::string> lines;
    if (ways) {
      pieces = cutMotion(trace_, visit, *ways, rule_.lines, diagnostics_);
      if (!pieces)
        return;
      auto written = linesOf(text_, trace_, visit, *pieces, diagnostics_);
      if (!written)
        return;
      lines = std::move(*written);
      pieces_.emplace_back(visit.object, std::move(pieces->objects));
    }
    if (again && lines != lines_[sentence])
      refuseEdit(firstWord(visit.sentence).span, "this motion is another one in each round",
                 "its pieces would be others, too",
                 "write the sentences of the loop one after another", diagnostics_);
    lines_[sentence] = std::move(lines);
  }

  /// Sentences that nothing reaches have a motion that nobody knows.
  void checkReached() {
    for (size_t i = 0; i < reached_.size(); ++i) {
      const EditSentence &sentence = trace_.sentences[i];
      const CncWord *g = wordOf(sentence.words, 'G');
      const bool moves = wordOf(sentence.words, 'M') == nullptr &&
                         std::any_of(kMoving.begin(), kMoving.end(), [&sentence](char letter) {
                           return wordOf(sentence.words, static_cast<uint8_t>(letter)) != nullptr;
                         });
      if (!reached_[i] && moves && rule_.wants(sentence, g != nullptr ? g->word.integer : -1))
        refuseEdit(sentence.words.front().span, "this sentence is never reached",
                   "where it begins is not known", "take it away, or the jump before it",
                   diagnostics_);
    }
  }

  std::string write() const {
    std::string text;
    size_t at = 0;
    const std::vector<TextLine> rows = linesOf(text_);
    const std::string_view ending =
        rows.empty() || rows.front().ending.empty() ? std::string_view("\n") : rows.front().ending;
    for (size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].empty())
        continue;
      const TextLine &row = rows[static_cast<size_t>(trace_.sentences[i].line) - 1];
      text += text_.substr(at, row.begin - at);
      for (const std::string &line : lines_[i])
        (text += &line == &lines_[i].front() ? "" : ending) += line;
      at = row.end;
    }
    text += text_.substr(at);
    return text;
  }

  /// Whether the new text makes the pieces, and else what it made.
  bool check(const std::string &text) {
    Path wanted;
    std::vector<int32_t> origin; // by object: sentence
    size_t next = 0;
    for (size_t i = 0; i < trace_.objects.size(); ++i) {
      const bool cut = next < pieces_.size() && pieces_[next].first == static_cast<int32_t>(i);
      if (cut)
        wanted.insert(wanted.end(), pieces_[next].second.begin(), pieces_[next].second.end());
      else
        wanted.push_back(trace_.objects[i]);
      next += cut ? 1 : 0;
      origin.resize(wanted.size(), trace_.visits[static_cast<size_t>(trace_.visitOf[i])].sentence);
    }
    noteWhatGoesOn(wanted);
    std::optional<Path> made = pathOfText(text);
    if (made) {
      noteWhatGoesOn(*made);
      if (trace_.endless) { // each ends where somebody has seen that it does not
        made->resize(std::min(made->size(), wanted.size()));
        wanted.resize(made->size());
      }
    }
    const std::optional<size_t> at =
        made ? firstDifference(wanted, *made) : std::optional(size_t{0});
    if (!at || origin.empty())
      return true;
    refuseEdit(firstWord(origin[std::min(*at, origin.size() - 1)]).span,
               "this program cannot be changed so that its path stays",
               "here it would be another one", "cut this motion by hand", diagnostics_);
    return false;
  }

  std::string_view text_;
  const CncTrace &trace_;
  const CutRule &rule_;
  Diagnostics &diagnostics_;
  std::vector<std::vector<std::string>> lines_;  ///< By sentence; none: it stays.
  std::vector<bool> reached_;                    ///< By sentence.
  std::vector<std::pair<int32_t, Path>> pieces_; ///< Of the objects that are cut.
};

} // namespace

std::optional<std::string> cutProgram(const SourceFile &file, const CncTrace &trace,
                                      const CutRule &rule, Diagnostics &diagnostics) {
  return Cutter(file, trace, rule, diagnostics).run();
}

} // namespace stc::gcode
