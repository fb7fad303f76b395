// A chart as Structured Text. Each call: the steps' times, the transitions, the steps that they
// leave and enter (all at once), the action controls, the final scans, the actions.
#include "compiler/syntax/chart_flags.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace stc {

using namespace ast;

namespace {

class ChartLowering : private ChartFlags {
public:
  ChartLowering(const Chart &chart, const ChartTarget &target) : ChartFlags(chart, target) {}

  void lower(std::vector<Stmt *> &out);

private:
  /// An action, with all places that name it.
  struct Use {
    Name name;
    Name control;
    std::vector<std::pair<const ChartStep *, const ChartAction *>> places;
  };

  /// A variable of a step or an action, which the program may read.
  VarDecl *declareOpen(const Name &what, const char *type) {
    VarDecl *node = make_.declaration(what, {"__SYSTEM", type}, kept());
    node->access = Access::Public;
    target_.variables.push_back(node);
    return node;
  }
  Expr *anyStep();

  /// Whether nothing of the POU or the chart has this name.
  [[nodiscard]] bool isFree(const std::string &what);
  void collect();
  std::vector<size_t> order() const;
  void tip(Statements &out);
  Statements condition(size_t i);
  void transitions(Statements &out);
  void steps(Statements &out);
  void start(Statements &out);
  void resetFlags(Statements &out);
  void indicators(Statements &out);
  void run(const Use &use, bool final, Statements &out);
  void actions(Statements &out);
  Stmt *control(const Use &use);
  void currentStep(Statements &out);

  std::vector<Use> uses_;         ///< in the order of the text
  std::map<Ident, size_t> useOf_; ///< of an action
  std::set<std::string> taken_;   ///< names of the POU and the chart, in lower case
};

Expr *ChartLowering::anyStep() {
  std::vector<Expr *> list;
  for (const ChartStep &step : chart_.steps)
    list.push_back(make_.member(step.name, "x", chart_.span));
  return make_.combined(BinaryOp::LogicalOr, list);
}

bool ChartLowering::isFree(const std::string &what) {
  if (taken_.empty()) {
    for (const VarDecl *one : declared_)
      taken_.insert(lowerCase(one->name.text));
    for (const std::string_view one : target_.members)
      taken_.insert(lowerCase(one));
    for (const ChartStep &step : chart_.steps) {
      taken_.insert(lowerCase(step.name.text));
      for (const ChartAction &action : step.actions)
        taken_.insert(lowerCase(action.name.text));
    }
  }
  return !taken_.contains(lowerCase(what));
}

/// The control of an action is `_Action`, as in CODESYS, unless the POU has something of this name
/// or extends a block that may have it.
void ChartLowering::collect() {
  for (const ChartStep &step : chart_.steps) {
    for (const ChartAction &action : step.actions) {
      const auto [at, isNew] = useOf_.emplace(action.name.id, uses_.size());
      if (isNew) {
        const std::string text(action.name.text);
        const bool free = !target_.extends && !target_.ofMember && isFree("_" + text);
        const Name control =
            make_.name(free ? "_" + text : hidden("action_" + text), action.name.span);
        uses_.push_back({action.name, control, {}});
        make_.hide(declareOpen(control, "SFCActionType"));
      }
      uses_[at->second].places.emplace_back(&step, &action);
    }
  }
}

/// By priority, then from top to bottom.
std::vector<size_t> ChartLowering::order() const {
  const auto &all = chart_.transitions;
  std::vector<size_t> out(all.size());
  for (size_t i = 0; i < out.size(); ++i)
    out[i] = i;
  std::stable_sort(out.begin(), out.end(), [&](size_t a, size_t b) {
    return all[a].priority.value_or(UINT64_MAX) < all[b].priority.value_or(UINT64_MAX);
  });
  return out;
}

/// SFCTip has become TRUE.
void ChartLowering::tip(Statements &out) {
  if (!hasFlag("SFCTipMode") || !hasFlag("SFCTip"))
    return;
  const Name last = make_.name(hidden("tip"), chart_.span);
  const Name edge = make_.name(hidden("tipped"), chart_.span);
  declareBool(last, kept());
  declareBool(edge, Section::Temp);
  out.push_back(make_.assign(
      make_.variable(edge),
      make_.combined(BinaryOp::LogicalAnd, {flag("SFCTip"), make_.negated(make_.variable(last))})));
  out.push_back(make_.assign(make_.variable(last), flag("SFCTip")));
}

/// Puts into the transition's variable whether it fires, when nothing else hinders it.
ChartNodes::Statements ChartLowering::condition(size_t i) {
  const ChartTransition &one = chart_.transitions[i];
  const Name fire = fires(i);
  Statements out;
  if (one.condition != nullptr) {
    Stmt *stmt =
        make_.assign(make_.variable({fire.id, fire.text, one.condition->span}), one.condition);
    out.push_back(stmt);
  } else {
    std::vector<Instruction> list = one.instructions;
    Instruction store;
    store.op = findInstruction("st");
    store.span = store.opSpan = list.empty() ? one.span : list.back().span;
    store.operands.push_back(make_.variable({fire.id, fire.text, store.span}));
    list.push_back(store);
    InstructionLowering(list, target_.interner, target_.arena, target_.diagnostics,
                        target_.variables, hidden("cr" + std::to_string(i) + "_"))
        .run(out);
  }
  if (!hasFlag("SFCTipMode"))
    return out;
  Expr *tipped = hasFlag("SFCTip") ? make_.variable(make_.name(hidden("tipped"), one.span))
                                   : make_.boolean(false, one.span);
  return {make_.when(flag("SFCTipMode"), {make_.assign(make_.variable(fire), tipped)}, out)};
}

/// A transition fires when all its steps are active, no alternative before it fires, and its
/// condition is TRUE.
void ChartLowering::transitions(Statements &out) {
  const auto &all = chart_.transitions;
  const std::vector<size_t> order = this->order();
  std::map<Ident, std::vector<size_t>> before; // of the same step, in their order
  for (size_t k = 0; k < order.size(); ++k) {
    const ChartTransition &one = all[order[k]];
    std::vector<Expr *> ready;
    for (const Name &step : one.from)
      ready.push_back(make_.member(step, "x"));
    std::set<size_t> alternatives;
    for (const Name &step : one.from) {
      std::vector<size_t> &own = before[step.id];
      alternatives.insert(own.begin(), own.end());
      own.push_back(k);
    }
    for (const size_t j : alternatives) {
      const Name other = fires(order[j]);
      ready.push_back(make_.negated(make_.variable({other.id, other.text, one.span})));
    }
    const Name fire = fires(order[k]);
    declareBool(fire, Section::Temp);
    out.push_back(make_.assign(make_.variable(fire), make_.combined(BinaryOp::LogicalAnd, ready)));
    out.push_back(make_.when(make_.variable(fire), condition(order[k])));
    if (hasFlag("SFCTrans"))
      out.push_back(make_.when(make_.variable(fire),
                               {make_.assign(flag("SFCTrans"), make_.boolean(true, one.span))}));
  }
}

/// Leaves and enters steps after all transitions are known.
void ChartLowering::steps(Statements &out) {
  const auto &all = chart_.transitions;
  std::map<Ident, std::pair<std::vector<size_t>, std::vector<size_t>>> byStep;
  for (size_t i = 0; i < all.size(); ++i) {
    for (const Name &step : all[i].from)
      byStep[step.id].first.push_back(i);
    for (const Name &step : all[i].to)
      byStep[step.id].second.push_back(i);
  }
  const auto firing = [&](const std::vector<size_t> &list) {
    std::vector<Expr *> out;
    for (const size_t i : list)
      out.push_back(make_.variable(fires(i)));
    return out;
  };
  for (const ChartStep &step : chart_.steps) {
    const std::vector<Expr *> leave = firing(byStep[step.name.id].first);
    const std::vector<Expr *> enter = firing(byStep[step.name.id].second);
    std::vector<Argument> arguments;
    if (!leave.empty())
      arguments.push_back(make_.argument("leave", make_.combined(BinaryOp::LogicalOr, leave)));
    if (!enter.empty())
      arguments.push_back(make_.argument("enter", make_.combined(BinaryOp::LogicalOr, enter)));
    if (!arguments.empty())
      out.push_back(make_.call(step.name, arguments));
  }
}

void ChartLowering::resetFlags(Statements &out) {
  const auto reset = [&](const char *what) {
    if (hasFlag(what))
      out.push_back(make_.assign(flag(what), make_.boolean(false, declared(what)->name.span)));
  };
  reset("SFCPause");
  reset("SFCTip");
  reset("SFCTipMode");
  reset("SFCQuitError");
  forgetError(out);
}

/// Only the initial step is active; the actions forget what they have stored.
void ChartLowering::start(Statements &out) {
  for (const ChartStep &step : chart_.steps)
    out.push_back(make_.call(
        step.name, {make_.argument("leave", make_.boolean(true, step.name.span)),
                    make_.argument("enter", make_.boolean(step.initial, step.name.span))}));
  for (const Use &use : uses_) {
    out.push_back(make_.call({use.control.id, use.control.text, use.name.span},
                             {make_.argument("RESET", make_.boolean(true, use.name.span))}));
    run(use, true, out); // which makes a variable FALSE
  }
  if (Expr *again = anyFlag({"SFCInit", "SFCReset"})) {
    Statements flags;
    resetFlags(flags);
    if (!flags.empty())
      out.push_back(make_.when(again, flags));
  }
}

Stmt *ChartLowering::control(const Use &use) {
  static constexpr const char *kInputs[] = {"N",  "R",  "S",  "L",  "D", "P",
                                            "SD", "DS", "SL", "P1", "P0"};
  std::vector<Argument> arguments;
  for (const std::string_view input : kInputs) {
    std::vector<Expr *> active;
    for (const auto &[step, action] : use.places)
      if (action->qualifier->input == input)
        active.push_back(make_.member(step->name, "x", action->name.span));
    if (!active.empty())
      arguments.push_back(
          make_.argument(input.data(), make_.combined(BinaryOp::LogicalOr, active)));
  }
  arguments.push_back(make_.argument("RESET", make_.boolean(false, use.name.span)));
  return make_.call(use.control, arguments);
}

/// The call of an action, in its final scan or while it is active. Only the check of the program
/// knows whether the name means a variable instead, which is then set once.
void ChartLowering::run(const Use &use, bool final, Statements &out) {
  Expr *condition = make_.member(use.control, "_x");
  if (final)
    condition = make_.combined(BinaryOp::LogicalAnd,
                               {make_.member(use.control, "x"), make_.negated(condition)});
  auto *stmt = as<IfStmt>(make_.when(condition, {make_.call(use.name, {})}));
  stmt->ofVariable = final ? make_.assign(make_.variable(use.name), make_.member(use.control, "_x"))
                           : make_.empty(use.name.span);
  out.push_back(stmt);
}

/// Nothing becomes of indicator variables here (their actions set them), but they must be BOOL.
void ChartLowering::indicators(Statements &out) {
  std::vector<Expr *> all;
  for (const Use &use : uses_)
    for (const auto &[step, action] : use.places)
      for (const Name &one : action->indicators)
        all.push_back(make_.variable(one));
  if (all.empty())
    return;
  const Name checked = make_.name(hidden("indicators"), chart_.span);
  declareBool(checked, Section::Temp);
  for (Expr *one : all)
    out.push_back(make_.assign(make_.variable({checked.id, checked.text, one->span}), one));
}

/// The final scans come before what is active now, so that a new step has the last word.
void ChartLowering::actions(Statements &out) {
  for (const Use &use : uses_) {
    for (const auto &[step, action] : use.places)
      if (action->time != nullptr)
        out.push_back(make_.when(
            make_.member(step->name, "x", action->time->span),
            {make_.assign(make_.member(use.control, "T", action->time->span), action->time)}));
    out.push_back(control(use));
  }
  for (const Use &use : uses_)
    run(use, true, out);
  for (const Use &use : uses_)
    run(use, false, out);
}

/// Of parallel branches the last one in the text has the last word.
void ChartLowering::currentStep(Statements &out) {
  if (!hasFlag("SFCCurrentStep"))
    return;
  for (const ChartStep &step : chart_.steps)
    out.push_back(make_.when(make_.member(step.name, "x"),
                             {make_.assign(flag("SFCCurrentStep"), make_.text(step.name))}));
}

void ChartLowering::lower(Statements &out) {
  for (const ChartStep &step : chart_.steps)
    declareOpen(step.name, "SFCStepType");
  collect();
  if (hasFlag("SFCTrans"))
    out.push_back(make_.assign(flag("SFCTrans"), make_.boolean(false, chart_.span)));
  tip(out);
  quitError(out);
  Statements evolve;
  for (const ChartStep &step : chart_.steps)
    evolve.push_back(make_.when(
        make_.member(step.name, "x"),
        {make_.call(step.name, {make_.argument("leave", make_.boolean(false, step.name.span)),
                                make_.argument("enter", make_.boolean(false, step.name.span))})}));
  transitions(evolve);
  for (size_t i = 0; i < chart_.steps.size(); ++i)
    watch(chart_.steps[i], std::to_string(i), evolve);
  steps(evolve);
  Statements begin;
  start(begin);
  // No step is active before the first call, and after an online change that removes the active
  // ones.
  std::vector<Expr *> anew = {make_.negated(anyStep())};
  if (Expr *flags = anyFlag({"SFCInit", "SFCReset"}))
    anew.push_back(flags);
  if (Expr *paused = anyStop(false))
    evolve = {make_.when(make_.negated(paused), evolve)};
  Stmt *evolution = make_.when(make_.combined(BinaryOp::LogicalOr, anew), begin, evolve);
  out.push_back(evolution);
  Statements act;
  actions(act);
  Expr *still = anyStop(true);
  if (still != nullptr && !act.empty())
    act = {make_.when(make_.negated(still), act)};
  out.insert(out.end(), act.begin(), act.end());
  indicators(out);
  currentStep(out);
}

} // namespace

void lowerChart(const Chart &chart, const ChartTarget &target, std::vector<Stmt *> &out) {
  ChartLowering(chart, target).lower(out);
}

} // namespace stc
