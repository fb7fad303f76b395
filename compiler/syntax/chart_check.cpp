// What is wrong with a chart: its initial step, names of steps, and how branches meet.
#include "compiler/syntax/chart.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace stc {

namespace {

/// R0 and S0 are what CODESYS V3 calls R and S.
constexpr ChartQualifier kQualifiers[] = {
    {"n", "N", false},  {"r", "R", false},   {"s", "S", false},   {"l", "L", true},
    {"d", "D", true},   {"p", "P", false},   {"sd", "SD", true},  {"ds", "DS", true},
    {"sl", "SL", true}, {"p1", "P1", false}, {"p0", "P0", false}, {"r0", "R", false},
    {"s0", "S", false},
};

/// Flags of CODESYS that belong to SFCError, which watches the times of steps.
constexpr std::string_view kErrorFlags[] = {"SFCEnableLimit", "SFCErrorStep", "SFCErrorPOU",
                                            "SFCQuitError"};

/// Which steps are active: their numbers, in ascending order.
using Marking = std::vector<size_t>;

/// So many situations of a chart are looked at; one with more is not judged.
constexpr size_t kMaxMarkings = 4096;

/// Follows all ways through a chart, whatever the conditions are.
class ChartWalk {
public:
  explicit ChartWalk(const Chart &chart) : chart_(chart) {
    for (size_t i = 0; i < chart.steps.size(); ++i)
      index_.emplace(chart.steps[i].name.id, i);
    for (size_t i = 0; i < chart.transitions.size(); ++i)
      leaving_[chart.transitions[i].from.front().id].push_back(i);
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
  std::map<Ident, std::vector<size_t>> leaving_; ///< transitions by the first step they leave
  std::set<Marking> seen_;
  std::vector<Marking> open_;
};

void ChartWalk::follow(const Marking &marking) {
  const auto isActive = [](const Marking &in, size_t step) {
    return std::ranges::binary_search(in, step);
  };
  for (const size_t first : marking)
    for (const size_t i : leaving_[chart_.steps[first].name.id]) {
      const ChartTransition &one = chart_.transitions[i];
      if (!std::ranges::all_of(one.from, [&](const ast::Name &step) {
            return isActive(marking, index_.at(step.id));
          }))
        continue;
      enabled[i] = true;
      Marking next = marking;
      for (const ast::Name &step : one.from)
        std::erase(next, index_.at(step.id));
      for (const ast::Name &step : one.to) {
        const size_t entered = index_.at(step.id);
        if (isActive(next, entered))
          twice[i] = true;
        else
          next.insert(std::ranges::upper_bound(next, entered), entered);
      }
      visit(next);
    }
}

bool ChartWalk::run() {
  Marking first;
  for (size_t i = 0; i < chart_.steps.size(); ++i)
    if (chart_.steps[i].initial)
      first.push_back(i);
  visit(first);
  while (!open_.empty()) {
    if (seen_.size() > kMaxMarkings)
      return false;
    const Marking marking = open_.back();
    open_.pop_back();
    for (const size_t step : marking)
      reached[step] = true;
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

/// The flags of watched times, the times, and SFCError need each other.
static void checkFlags(const Chart &chart, const std::vector<ast::VarDecl *> &variables,
                       Diagnostics &diagnostics) {
  const auto timed = std::ranges::find_if(chart.steps, [](const ChartStep &step) {
    return step.minTime != nullptr || step.maxTime != nullptr;
  });
  const bool watched = std::ranges::any_of(variables, [](const ast::VarDecl *one) {
    return equalIgnoringCase("SFCError", one->name.text);
  });
  for (const ast::VarDecl *one : variables) {
    const bool error = equalIgnoringCase("SFCError", one->name.text);
    const bool own = std::ranges::any_of(kErrorFlags, [&](std::string_view name) {
      return equalIgnoringCase(name, one->name.text);
    });
    // SFCQuitError stops the chart, whether it has times or not.
    const bool used = watched && (timed != chart.steps.end() ||
                                  equalIgnoringCase("SFCQuitError", one->name.text));
    if ((!error && !own) || used)
      continue;
    auto &&report =
        diagnostics.report(Code::SfcFlag, one->name.span,
                           "the chart does not use `" + std::string(one->name.text) + "`",
                           watched ? "no step has a time that could be watched"
                                   : "it belongs to `SFCError`, which is not declared");
    if (watched)
      report.help("give a step a time: `STEP " + std::string(chart.steps.front().name.text) +
                  " (MAX_TIME := T#5s):`");
    else
      report.help("declare `SFCError : BOOL`");
  }
  if (watched || timed == chart.steps.end())
    return;
  const ast::Expr *time = timed->maxTime != nullptr ? timed->maxTime : timed->minTime;
  diagnostics
      .report(Code::SfcFlag, time->span, "the times of the steps are not watched",
              "nothing tells that the step took another time")
      .help("declare `SFCError : BOOL` in the POU or METHOD of the chart");
}

/// Each step is a variable of the POU.
static bool checkNames(const Chart &chart, const std::vector<ast::VarDecl *> &variables,
                       Diagnostics &diagnostics) {
  bool good = true;
  std::map<Ident, Span> known;
  for (const ast::VarDecl *one : variables)
    known.emplace(one->name.id, one->name.span);
  for (const ChartStep &step : chart.steps) {
    const auto [first, isNew] = known.emplace(step.name.id, step.name.span);
    if (isNew)
      continue;
    good = false;
    diagnostics
        .report(Code::DuplicateName, step.name.span,
                "the name `" + std::string(step.name.text) + "` is declared twice",
                "a step is declared again here")
        .label(first->second, "first declared here")
        .help("give the step a name of its own: it is a variable with the members `x` and `t`");
  }
  return good;
}

/// As an action, its name would mean the variable: a call without effect.
static bool checkActionNames(const Chart &chart, Diagnostics &diagnostics) {
  bool good = true;
  std::map<Ident, Span> steps;
  for (const ChartStep &step : chart.steps)
    steps.emplace(step.name.id, step.name.span);
  for (const ChartStep &step : chart.steps) {
    for (const ChartAction &action : step.actions) {
      const auto found = steps.find(action.name.id);
      if (found == steps.end())
        continue;
      good = false;
      diagnostics
          .report(Code::DuplicateName, action.name.span,
                  "the name `" + std::string(action.name.text) + "` is that of a step",
                  "named as an action here")
          .label(found->second, "the step")
          .help("give the action another name: each step is a variable of the POU");
    }
  }
  return good;
}

static bool checkInitialStep(const Chart &chart, Diagnostics &diagnostics) {
  bool good = true;
  const ChartStep *initial = nullptr;
  for (const ChartStep &step : chart.steps) {
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
  if (initial != nullptr)
    return good;
  diagnostics
      .report(Code::SfcInitialStep, chart.span, "the chart has no initial step",
              "it would never begin")
      .help("write INITIAL_STEP instead of STEP where it begins");
  return false;
}

bool checkChart(const Chart &chart, const std::vector<ast::VarDecl *> &variables,
                Diagnostics &diagnostics) {
  checkFlags(chart, variables, diagnostics);
  bool good = checkNames(chart, variables, diagnostics);
  good = checkActionNames(chart, diagnostics) && good;
  good = checkInitialStep(chart, diagnostics) && good;
  std::set<Ident> known;
  for (const ChartStep &step : chart.steps)
    known.insert(step.name.id);
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
