// A chart as Structured Text. Each call: the steps' times, the transitions, the steps that they
// leave and enter (all at once), the action controls, the actions.
#include "compiler/syntax/chart.hpp"

#include <algorithm>
#include <string>

namespace stc {

using namespace ast;

namespace {

class ChartLowering {
public:
  ChartLowering(const Chart &chart, Interner &interner, Arena &arena,
                std::vector<VarDecl *> &variables)
      : chart_(chart), interner_(interner), arena_(arena), variables_(variables),
        declared_(variables.begin(), variables.end()), run_(name("sfc__run", chart.span)) {}

  void lower(std::vector<Stmt *> &out);

private:
  using Statements = std::vector<Stmt *>;
  /// An action, with all places that name it.
  struct Use {
    Name name;
    Name control;
    std::vector<std::pair<const ChartStep *, const ChartAction *>> places;
  };

  Name name(const std::string &text, Span span) {
    const std::string_view kept = arena_.copy(std::string_view(text));
    return {interner_.intern(kept), kept, span};
  }
  Expr *variable(const Name &of) {
    auto *node = arena_.make<NameExpr>();
    node->name = of;
    node->span = of.span;
    return node;
  }
  Expr *member(const Name &of, const char *field) {
    auto *node = arena_.make<MemberExpr>();
    node->base = variable(of);
    node->name = name(field, of.span);
    node->span = of.span;
    return node;
  }
  Expr *boolean(bool value, Span span) {
    auto *node = arena_.make<Literal>();
    node->literal = LiteralKind::Boolean;
    node->integer = value ? 1 : 0;
    node->text = value ? "TRUE" : "FALSE";
    node->span = span;
    return node;
  }
  Expr *negated(Expr *operand) {
    auto *node = arena_.make<UnaryExpr>();
    node->op = UnaryOp::LogicalNot;
    node->operand = operand;
    node->span = operand->span;
    return node;
  }
  /// Null for `left`: `right` alone.
  Expr *both(BinaryOp op, Expr *left, Expr *right) {
    if (left == nullptr)
      return right;
    auto *node = arena_.make<BinaryExpr>();
    node->op = op;
    node->left = left;
    node->right = right;
    node->span = left->span;
    node->opSpan = left->span;
    return node;
  }
  Stmt *assign(Expr *target, Expr *value) {
    auto *node = arena_.make<AssignStmt>();
    node->targets = arena_.copy(std::vector<Expr *>{target});
    node->value = value;
    node->span = target->span;
    node->opSpan = target->span;
    return node;
  }
  Argument argument(const char *parameter, Expr *value) {
    Argument out;
    out.name = name(parameter, value->span);
    out.value = value;
    out.span = value->span;
    return out;
  }
  Stmt *call(const Name &callee, const std::vector<Argument> &arguments) {
    auto *expr = arena_.make<CallExpr>();
    expr->callee = variable(callee);
    expr->arguments = arena_.copy(arguments);
    expr->span = callee.span;
    auto *node = arena_.make<CallStmt>();
    node->expr = expr;
    node->span = callee.span;
    return node;
  }
  Stmt *when(Expr *condition, const Statements &then, const Statements &otherwise = {}) {
    auto *node = arena_.make<IfStmt>();
    IfBranch branch;
    branch.condition = condition;
    branch.body = arena_.copy(then);
    node->branches = arena_.copy(std::vector<IfBranch>{branch});
    node->hasElse = !otherwise.empty();
    node->elseBody = arena_.copy(otherwise);
    node->span = condition->span;
    return node;
  }
  void declare(const Name &what, const std::vector<const char *> &type, Section section);
  /// The flag when the POU declares it.
  [[nodiscard]] const VarDecl *flag(const char *what) const;
  Expr *flagValue(const char *what) { return variable(name(what, chart_.span)); }
  bool isVariable(const Name &what) const {
    return std::any_of(declared_.begin(), declared_.end(),
                       [&](const VarDecl *one) { return one->name.id == what.id; });
  }

  void collect();
  Name fires(size_t i) {
    return name("sfc__fire" + std::to_string(i), chart_.transitions[i].span);
  }
  void transitions(Statements &out);
  void start(Statements &out);
  void actions(Statements &out);
  Stmt *control(const Use &use);

  const Chart &chart_;
  Interner &interner_;
  Arena &arena_;
  std::vector<VarDecl *> &variables_;
  std::vector<const VarDecl *> declared_; ///< by the POU itself
  std::vector<Use> uses_;                 ///< in the order of the text
  Name run_;                              ///< the chart has begun
};

void ChartLowering::declare(const Name &what, const std::vector<const char *> &type,
                            Section section) {
  auto *written = arena_.make<NamedTypeExpr>();
  std::vector<Name> path;
  path.reserve(type.size());
  for (const char *part : type)
    path.push_back(name(part, what.span));
  written->path = arena_.copy(path);
  written->span = what.span;
  auto *node = arena_.make<VarDecl>();
  node->name = what;
  node->section = section;
  node->type = written;
  variables_.push_back(node);
}

const VarDecl *ChartLowering::flag(const char *what) const {
  const auto found = std::find_if(declared_.begin(), declared_.end(), [&](const VarDecl *one) {
    return equalIgnoringCase(one->name.text, what);
  });
  return found == declared_.end() ? nullptr : *found;
}

void ChartLowering::collect() {
  for (const ChartStep &step : chart_.steps) {
    for (const ChartAction &action : step.actions) {
      auto at = std::find_if(uses_.begin(), uses_.end(),
                             [&](const Use &use) { return use.name.id == action.name.id; });
      if (at == uses_.end())
        at = uses_.insert(
            at, {action.name, name("sfc__" + std::string(action.name.text), action.name.span), {}});
      at->places.emplace_back(&step, &action);
    }
  }
}

/// A transition fires when all its steps are active, no alternative before it fires, and its
/// condition is TRUE.
void ChartLowering::transitions(Statements &out) {
  const auto &all = chart_.transitions;
  std::vector<size_t> order(all.size());
  for (size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return all[a].priority.value_or(UINT64_MAX) < all[b].priority.value_or(UINT64_MAX);
  });
  const auto holds = [](const std::vector<Name> &list, const Name &step) {
    return std::any_of(list.begin(), list.end(), [&](const Name &n) { return n.id == step.id; });
  };
  for (size_t k = 0; k < order.size(); ++k) {
    const ChartTransition &one = all[order[k]];
    Expr *ready = nullptr;
    for (const Name &step : one.from)
      ready = both(BinaryOp::LogicalAnd, ready, member(step, "x"));
    for (size_t j = 0; j < k; ++j)
      if (std::any_of(one.from.begin(), one.from.end(),
                      [&](const Name &step) { return holds(all[order[j]].from, step); }))
        ready = both(BinaryOp::LogicalAnd, ready, negated(variable(fires(order[j]))));
    const Name fire = fires(order[k]);
    declare(fire, {"BOOL"}, Section::Temp);
    out.push_back(assign(variable(fire), ready));
    out.push_back(when(variable(fire), {assign(variable(fire), one.condition)}));
    if (flag("SFCTrans") != nullptr)
      out.push_back(
          when(variable(fire), {assign(flagValue("SFCTrans"), boolean(true, one.span))}));
  }
  for (const ChartStep &step : chart_.steps) {
    Expr *leave = nullptr;
    Expr *enter = nullptr;
    for (size_t i = 0; i < all.size(); ++i) {
      if (holds(all[i].from, step.name))
        leave = both(BinaryOp::LogicalOr, leave, variable(fires(i)));
      if (holds(all[i].to, step.name))
        enter = both(BinaryOp::LogicalOr, enter, variable(fires(i)));
    }
    std::vector<Argument> arguments;
    if (leave != nullptr)
      arguments.push_back(argument("leave", leave));
    if (enter != nullptr)
      arguments.push_back(argument("enter", enter));
    if (!arguments.empty())
      out.push_back(call(step.name, arguments));
  }
}

/// Only the initial step is active; the actions forget what they have stored.
void ChartLowering::start(Statements &out) {
  out.push_back(assign(variable(run_), boolean(true, chart_.span)));
  for (const ChartStep &step : chart_.steps)
    out.push_back(call(step.name, {argument("leave", boolean(true, step.name.span)),
                                   argument("enter", boolean(step.initial, step.name.span))}));
  for (const Use &use : uses_) {
    out.push_back(call(use.control, {argument("RESET", boolean(true, use.name.span))}));
    if (isVariable(use.name))
      out.push_back(assign(variable(use.name), boolean(false, use.name.span)));
  }
}

Stmt *ChartLowering::control(const Use &use) {
  static constexpr const char *kInputs[] = {"N",  "R",  "S",  "L",  "D", "P",
                                            "SD", "DS", "SL", "P1", "P0"};
  std::vector<Argument> arguments;
  for (const char *input : kInputs) {
    Expr *value = nullptr;
    for (const auto &[step, action] : use.places)
      if (equalIgnoringCase(action->qualifier ? action->qualifier.text : "N", input)) {
        Expr *active = member(step->name, "x");
        active->span = action->name.span;
        value = both(BinaryOp::LogicalOr, value, active);
      }
    if (value != nullptr)
      arguments.push_back(argument(input, value));
  }
  arguments.push_back(argument("RESET", boolean(false, use.name.span)));
  return call(use.control, arguments);
}

void ChartLowering::actions(Statements &out) {
  for (const Use &use : uses_) {
    declare(use.control, {"__SYSTEM", "SFCActionControl"}, Section::Local);
    for (const auto &[step, action] : use.places)
      if (action->time != nullptr)
        out.push_back(
            when(member(step->name, "x"), {assign(member(use.control, "T"), action->time)}));
    out.push_back(control(use));
  }
  for (const Use &use : uses_)
    out.push_back(isVariable(use.name)
                      ? assign(variable(use.name), member(use.control, "Q"))
                      : when(member(use.control, "A"), {call(use.name, {})}));
}

void ChartLowering::lower(Statements &out) {
  collect();
  declare(run_, {"BOOL"}, Section::Local);
  for (const ChartStep &step : chart_.steps)
    declare(step.name, {"__SYSTEM", "SFCStep"}, Section::Local);
  if (flag("SFCTrans") != nullptr)
    out.push_back(assign(flagValue("SFCTrans"), boolean(false, chart_.span)));
  Statements begin;
  start(begin);
  Statements evolve;
  for (const ChartStep &step : chart_.steps)
    evolve.push_back(call(step.name, {argument("leave", boolean(false, step.name.span)),
                                      argument("enter", boolean(false, step.name.span))}));
  transitions(evolve);
  Statements act;
  actions(act);
  Expr *anew = negated(variable(run_));
  Expr *still = nullptr;
  for (const char *what : {"SFCInit", "SFCReset"})
    if (flag(what) != nullptr)
      anew = both(BinaryOp::LogicalOr, anew, flagValue(what));
  for (const char *what : {"SFCInit", "SFCPause"})
    if (flag(what) != nullptr)
      still = both(BinaryOp::LogicalOr, still, flagValue(what));
  Stmt *evolution = nullptr;
  if (flag("SFCPause") != nullptr && !evolve.empty())
    evolve = {when(negated(flagValue("SFCPause")), evolve)};
  evolution = when(anew, begin, evolve);
  out.push_back(evolution);
  if (still != nullptr && !act.empty())
    act = {when(negated(still), act)};
  out.insert(out.end(), act.begin(), act.end());
  if (flag("SFCCurrentStep") == nullptr)
    return;
  for (const ChartStep &step : chart_.steps) {
    auto *text = arena_.make<Literal>();
    text->literal = LiteralKind::String;
    text->text = step.name.text;
    text->span = step.name.span;
    out.push_back(when(member(step.name, "x"), {assign(flagValue("SFCCurrentStep"), text)}));
  }
}

} // namespace

void lowerChart(const Chart &chart, Interner &interner, Arena &arena,
                std::vector<VarDecl *> &variables, std::vector<Stmt *> &out) {
  ChartLowering(chart, interner, arena, variables).lower(out);
}

} // namespace stc
