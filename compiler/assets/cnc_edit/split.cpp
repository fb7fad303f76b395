// Motions of CNC programs in pieces.

#include "compiler/assets/cnc_edit/split.hpp"

#include "compiler/assets/cnc_edit/cut_program.hpp"
#include "compiler/assets/cnc_edit/word_edits.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc {

namespace {

using namespace stride::cnc;
using gcode::CncTrace;
using gcode::CncVisit;
using gcode::EditSentence;

/// Pieces of one motion at most.
constexpr double kMostPieces = 100'000;

/// The sentence with a number; else the one without a number in that line.
int32_t findSentence(const CncTrace &trace, int32_t number) {
  int32_t inLine = -1;
  for (size_t i = 0; i < trace.sentences.size(); ++i) {
    const CncWord *n = gcode::wordOf(trace.sentences[i].words, 'N');
    if (n != nullptr && n->word.integer == number)
      return static_cast<int32_t>(i);
    if (n == nullptr && trace.sentences[i].line == number)
      inLine = static_cast<int32_t>(i);
  }
  return inLine;
}

class Splitter {
public:
  Splitter(const SourceFile &file, const CncSplit &split, Diagnostics &diagnostics)
      : file_(file), split_(split), diagnostics_(diagnostics) {}

  std::optional<std::string> run() {
    const std::optional<CncProgram> program = gcode::readForTrace(file_, diagnostics_);
    if (!program)
      return std::nullopt;
    const std::optional<CncTrace> trace = gcode::traceCnc(*program, diagnostics_);
    if (!trace)
      return std::nullopt;
    gcode::CutRule rule;
    if (split_.length > 0) {
      rule.cuts = [this](const CncTrace &all, const CncVisit &visit) { return evenly(all, visit); };
      rule.wants = [](const EditSentence &, int32_t function) {
        return function != 0 && function < 36;
      };
    } else {
      if (!choose(*trace))
        return std::nullopt;
      rule.cuts = [this](const CncTrace &all, const CncVisit &visit) { return once(all, visit); };
      rule.wants = [](const EditSentence &, int32_t) { return false; };
    }
    const size_t errors = diagnostics_.errorCount();
    std::optional<std::string> text = gcode::cutProgram(file_, *trace, rule, diagnostics_);
    return diagnostics_.errorCount() == errors ? text : std::nullopt;
  }

private:
  using Ways = std::optional<std::vector<double>>;

  bool choose(const CncTrace &trace) {
    chosen_ = findSentence(trace, split_.sentence);
    if (chosen_ < 0) {
      gcode::refuseEdit({file_.id(), 0, 0}, fmt::format("there is no sentence {}", split_.sentence),
                        "not in this program", "say its number (N), or its line if it has none",
                        diagnostics_);
      return false;
    }
    const bool moves =
        std::any_of(trace.visits.begin(), trace.visits.end(), [this](const CncVisit &visit) {
          return visit.sentence == chosen_ && visit.object >= 0;
        });
    if (!moves)
      gcode::refuseEdit(trace.sentences[static_cast<size_t>(chosen_)].words.front().span,
                        "this sentence moves nothing", "cannot be cut",
                        "choose a sentence with a motion that is reached", diagnostics_);
    return moves;
  }

  /// Whether a motion may be cut at all; else it is reported.
  bool isPossible(const CncTrace &trace, const CncVisit &visit) {
    const PathObject &object = trace.objects[static_cast<size_t>(visit.object)];
    const CncWord &place = trace.sentences[static_cast<size_t>(visit.sentence)].words.front();
    const auto refuse = [&](const char *message, const char *label, const char *help) {
      gcode::refuseEdit(place.span, message, label, help, diagnostics_);
      return false;
    };
    if (visit.function == 5 || visit.function == 10)
      return refuse("a spline cannot be cut", "its shape depends on the points beside it",
                    "make lines of it: stride cnc expand");
    if (object.probe != 0)
      return refuse("a motion that a probe ends cannot be cut", "where it ends is not known",
                    "cut another one");
    if (visit.function > 1 && !isCurve(object.moveType))
      return refuse("a line is made of this curve", "cannot be cut as a curve",
                    "write G1, or correct its centre");
    return true;
  }

  Ways once(const CncTrace &trace, const CncVisit &visit) {
    if (visit.sentence != chosen_ || !isPossible(trace, visit))
      return std::nullopt;
    return std::vector{split_.at * trace.objects[static_cast<size_t>(visit.object)].length};
  }

  Ways evenly(const CncTrace &trace, const CncVisit &visit) {
    const double length = trace.objects[static_cast<size_t>(visit.object)].length;
    // What is longer by rounding only is not longer.
    const double count = std::ceil(length / split_.length * (1 - 1e-12));
    if (visit.function == 0 || !(count > 1) || !isPossible(trace, visit))
      return std::nullopt;
    if (count > kMostPieces) {
      gcode::refuseEdit(trace.sentences[static_cast<size_t>(visit.sentence)].words.front().span,
                        "this motion would have too many pieces", fmt::format("{:.0f}", count),
                        "choose a greater length", diagnostics_);
      return std::nullopt;
    }
    std::vector<double> ways;
    for (double i = 1; i < count; ++i)
      ways.push_back(length * i / count);
    return ways;
  }

  const SourceFile &file_;
  CncSplit split_;
  Diagnostics &diagnostics_;
  int32_t chosen_ = -1;
};

} // namespace

std::optional<std::string> splitCnc(const SourceFile &file, const CncSplit &split,
                                    Diagnostics &diagnostics) {
  return Splitter(file, split, diagnostics).run();
}

} // namespace stc
