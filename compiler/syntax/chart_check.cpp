// What is wrong with a chart: its initial step, names of steps, and how branches meet.
#include "compiler/syntax/chart.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace stc {

namespace {

constexpr ChartQualifier kQualifiers[] = {
    {"n", "N", false}, {"r", "R", false},   {"s", "S", false},   {"l", "L", true},
    {"d", "D", true},  {"p", "P", false},   {"sd", "SD", true},  {"ds", "DS", true},
    {"sl", "SL", true}, {"p1", "P1", false}, {"p0", "P0", false},
};

/// Which steps are active.
using Marking = std::vector<bool>;

/// So many situations of a chart are looked at; one with more is not judged.
constexpr size_t kMaxMarkings = 4096;

/// Follows all ways through a chart, whatever the conditions are.
class ChartWalk {
public:
  explicit ChartWalk(const Chart &chart) : chart_(chart) {
    for (size_t i = 0; i < chart.steps.size(); ++i)
      index_.emplace(chart.steps[i].name.id, i);
    reached.resize(chart.steps.size());
    enabled.resize(chart.transitions.size());
    twice.resize(chart.transitions.size());
  }
  /// False: too many situations.
  bool run();

  std::vector<bool> reached; ///< the step can become active
  std::vector<bool> enabled; ///< all steps before the transition can be active together
  std::vector<bool> twice;   ///< the transition can enter a step that is active

private:
  void follow(const Marking &marking);
  void visit(const Marking &marking) {
    if (seen_.insert(marking).second)
      open_.push_back(marking);
  }

  const Chart &chart_;
  std::map<Ident, size_t> index_;
  std::set<Marking> seen_;
  std::vector<Marking> open_;
};

void ChartWalk::follow(const Marking &marking) {
  for (size_t i = 0; i < chart_.transitions.size(); ++i) {
    const ChartTransition &one = chart_.transitions[i];
    Marking next = marking;
    const auto active = [&](const ast::Name &step) { return marking[index_.at(step.id)]; };
    if (!std::all_of(one.from.begin(), one.from.end(), active))
      continue;
    enabled[i] = true;
    for (const ast::Name &step : one.from)
      next[index_.at(step.id)] = false;
    for (const ast::Name &step : one.to) {
      if (next[index_.at(step.id)])
        twice[i] = true;
      next[index_.at(step.id)] = true;
    }
    visit(next);
  }
}

bool ChartWalk::run() {
  Marking first(chart_.steps.size());
  for (size_t i = 0; i < chart_.steps.size(); ++i)
    first[i] = chart_.steps[i].initial;
  visit(first);
  while (!open_.empty()) {
    if (seen_.size() > kMaxMarkings)
      return false;
    const Marking marking = open_.back();
    open_.pop_back();
    for (size_t i = 0; i < marking.size(); ++i)
      reached[i] = reached[i] || marking[i];
    follow(marking);
  }
  return true;
}

void reportBranches(const Chart &chart, Diagnostics &diagnostics) {
  ChartWalk walk(chart);
  if (!walk.run())
    return;
  for (size_t i = 0; i < chart.steps.size(); ++i)
    if (!walk.reached[i])
      diagnostics
          .report(Code::SfcUnreachedStep, chart.steps[i].name.span,
                  "the step `" + std::string(chart.steps[i].name.text) + "` is never reached",
                  "no transition leads here from the initial step")
          .help("add a TRANSITION … TO it, or remove it");
  std::map<Ident, bool> reached;
  for (size_t i = 0; i < chart.steps.size(); ++i)
    reached[chart.steps[i].name.id] = walk.reached[i];
  for (size_t i = 0; i < chart.transitions.size(); ++i) {
    const ChartTransition &one = chart.transitions[i];
    const bool all = std::all_of(one.from.begin(), one.from.end(),
                                 [&](const ast::Name &step) { return reached[step.id]; });
    const Span from = one.from.front().span.to(one.from.back().span);
    if (!walk.enabled[i] && all)
      diagnostics
          .report(Code::SfcBranches, from, "these steps are never active at the same time",
                  "the transition never fires")
          .help("join with `FROM (a, b)` only what one `TO (a, b)` has parted");
    if (walk.twice[i])
      diagnostics
          .report(Code::SfcBranches, one.to.front().span.to(one.to.back().span),
                  "this step may already be active when the transition enters it",
                  "parallel branches are not joined before this")
          .help("join parallel branches with one transition: `FROM (a, b) TO c`");
  }
}

} // namespace

const ChartQualifier *findQualifier(std::string_view spelling) {
  const auto *const found =
      std::find_if(std::begin(kQualifiers), std::end(kQualifiers), [&](const ChartQualifier &one) {
        return equalIgnoringCase(one.lower, spelling);
      });
  return found == std::end(kQualifiers) ? nullptr : found;
}

bool checkChart(const Chart &chart, Diagnostics &diagnostics) {
  bool good = true;
  const ChartStep *initial = nullptr;
  std::set<Ident> known;
  for (const ChartStep &step : chart.steps) {
    known.insert(step.name.id);
    if (step.initial && initial != nullptr) {
      good = false;
      diagnostics
          .report(Code::SfcInitialStep, step.name.span, "the chart has a second initial step",
                  "write STEP here")
          .label(initial->name.span, "the first one");
    } else if (step.initial) {
      initial = &step;
    }
  }
  if (initial == nullptr) {
    good = false;
    diagnostics
        .report(Code::SfcInitialStep, chart.span, "the chart has no initial step",
                "it would never begin")
        .help("write INITIAL_STEP instead of STEP where it begins");
  }
  for (const ChartTransition &one : chart.transitions) {
    for (const auto *list : {&one.from, &one.to}) {
      for (const ast::Name &step : *list) {
        if (known.contains(step.id))
          continue;
        good = false;
        diagnostics.report(Code::SfcUnknownStep, step.span,
                           "there is no step `" + std::string(step.text) + "` in this chart",
                           "not a step");
      }
    }
  }
  if (good)
    reportBranches(chart, diagnostics);
  return good;
}

} // namespace stc
