#include "compiler/syntax/chart_flags.hpp"

#include "compiler/source/identifier.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

const VarDecl *ChartFlags::declared(std::string_view what) const {
  const auto found = std::find_if(declared_.begin(), declared_.end(), [&](const VarDecl *one) {
    return equalIgnoringCase(one->name.text, what);
  });
  return found == declared_.end() ? nullptr : *found;
}

Expr *ChartFlags::anyFlag(const std::vector<const char *> &flags) {
  std::vector<Expr *> list;
  for (const char *one : flags)
    if (hasFlag(one))
      list.push_back(flag(one));
  return make_.combined(BinaryOp::LogicalOr, list);
}

Expr *ChartFlags::anyStop(bool init) {
  std::vector<const char *> flags;
  if (init)
    flags.push_back("SFCInit");
  flags.push_back("SFCPause");
  if (hasFlag("SFCError"))
    flags.push_back("SFCQuitError");
  return anyFlag(flags);
}

Expr *ChartFlags::limit(const std::string &what, Expr *time, Statements &out) {
  const Name name = make_.name(hidden(what), time->span);
  declareHidden(name, "TIME", Section::Temp);
  out.push_back(make_.assign(make_.variable(name), time));
  return make_.variable(name);
}

/// Whether a transition leaves the step; null: there is none that could.
Expr *ChartFlags::left(const ChartStep &step) {
  std::vector<Expr *> all;
  for (size_t i = 0; i < chart_.transitions.size(); ++i)
    for (const Name &from : chart_.transitions[i].from)
      if (from.id == step.name.id)
        all.push_back(make_.variable(fires(i)));
  return make_.combined(BinaryOp::LogicalOr, all);
}

/// The step has been active for too long, or is left too early: the first error is kept. A
/// greatest time of 0 is none.
void ChartFlags::watch(const ChartStep &step, const std::string &number, Statements &out) {
  Statements inside;
  std::vector<Expr *> wrong;
  if (Expr *time = step.maxTime) {
    Expr *longest = limit("max" + number, time, inside);
    Expr *late = make_.binary(BinaryOp::Greater, make_.member(step.name, "t", time->span), longest);
    Expr *some = make_.binary(BinaryOp::Greater, longest, make_.noTime(time->span));
    wrong.push_back(make_.combined(BinaryOp::LogicalAnd, {late, some}));
  }
  if (Expr *time = step.minTime) {
    Expr *shortest = limit("min" + number, time, inside);
    Expr *early = make_.binary(BinaryOp::Less, make_.member(step.name, "t", time->span), shortest);
    if (Expr *leaves = left(step))
      wrong.push_back(make_.combined(BinaryOp::LogicalAnd, {leaves, early}));
  }
  if (hasFlag("SFCError") && !wrong.empty()) {
    std::vector<Expr *> all = {make_.negated(flag("SFCError")),
                               make_.combined(BinaryOp::LogicalOr, wrong)};
    if (hasFlag("SFCEnableLimit"))
      all.push_back(flag("SFCEnableLimit"));
    Statements note = {make_.assign(flag("SFCError"), make_.boolean(true, step.name.span))};
    if (hasFlag("SFCErrorStep"))
      note.push_back(make_.assign(flag("SFCErrorStep"), make_.text(step.name)));
    if (hasFlag("SFCErrorPOU"))
      note.push_back(make_.assign(flag("SFCErrorPOU"),
                                  make_.text(make_.name(std::string(target_.pou), chart_.span))));
    inside.push_back(make_.when(make_.combined(BinaryOp::LogicalAnd, all), note));
  }
  if (!inside.empty())
    out.push_back(make_.when(make_.member(step.name, "x"), inside));
}

void ChartFlags::forgetError(Statements &out) {
  if (!hasFlag("SFCError"))
    return;
  out.push_back(make_.assign(flag("SFCError"), make_.boolean(false, chart_.span)));
  for (const char *one : {"SFCErrorStep", "SFCErrorPOU"})
    if (hasFlag(one))
      out.push_back(make_.assign(flag(one), make_.text(make_.name("", chart_.span))));
}

void ChartFlags::quitError(Statements &out) {
  if (!hasFlag("SFCQuitError") || !hasFlag("SFCError"))
    return;
  const Name last = make_.name(hidden("quit"), chart_.span);
  declareBool(last, kept());
  Statements forget;
  forgetError(forget);
  out.push_back(make_.when(flag("SFCQuitError"), forget));
  Statements anew;
  for (const ChartStep &step : chart_.steps)
    anew.push_back(make_.when(
        make_.member(step.name, "x"),
        {make_.call(step.name, {make_.argument("leave", make_.boolean(false, step.name.span)),
                                make_.argument("enter", make_.boolean(true, step.name.span))})}));
  Expr *ended = make_.combined(BinaryOp::LogicalAnd,
                               {make_.variable(last), make_.negated(flag("SFCQuitError"))});
  out.push_back(make_.when(ended, anew));
  out.push_back(make_.assign(make_.variable(last), flag("SFCQuitError")));
}

} // namespace stc
