// Charts as PLCopen XML: steps, transitions and action blocks, with the divergences and
// convergences between them. Where several lines lead to a step, all but one are jumps.
#include "compiler/export/chart_text.hpp"
#include "compiler/export/plcopen_parts.hpp"
#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>

namespace stc::exporting {

namespace {

/// The grid of the drawing.
constexpr int kColumn = 200;
constexpr int kRow = 160;

/// The numbers of CODESYS's properties of a step.
constexpr std::string_view kStepName = "38391c6d-6d4a-42f8-8ee7-9f45e5adafa8";
constexpr std::string_view kStepMinTime = "cacf1a68-236e-47c2-b7b1-1cf9199718cb";
constexpr std::string_view kStepMaxTime = "b693554c-1b01-4a8d-afde-9e3a46f7465d";

class ChartWriter {
public:
  ChartWriter(Node pou, const ChartText &chart) : pou_(pou), chart_(chart) {}

  void write() {
    for (size_t i = 0; i < chart_.steps.size(); ++i)
      index_[lowerCase(chart_.steps[i].name)] = i;
    number();
    rank();
    place();
    addNamedTransitions();
    sfc_ = pou_.append_child("body").append_child("SFC");
    for (size_t i = 0; i < chart_.steps.size(); ++i) {
      step(i);
      for (const size_t k : leaving_[i])
        if (sources_[k].front() == i)
          transition(k);
    }
    if (!chart_.comment.empty())
      comment();
  }

private:
  using Indices = std::vector<size_t>;

  [[nodiscard]] Indices indicesOf(const std::vector<std::string> &names) const {
    Indices out;
    for (const std::string &each : names)
      out.push_back(index_.at(lowerCase(each)));
    return out;
  }

  /// localIds: of all elements that others refer to.
  void number() {
    size_t next = 1;
    for (size_t i = 0; i < chart_.steps.size(); ++i) {
      stepIds_.push_back(next++);
      leaving_.emplace_back();
    }
    for (size_t k = 0; k < chart_.transitions.size(); ++k) {
      transitionIds_.push_back(next++);
      sources_.push_back(indicesOf(chart_.transitions[k].from));
      targets_.push_back(indicesOf(chart_.transitions[k].to));
      for (const size_t each : sources_[k])
        leaving_[each].push_back(k);
    }
    for (const Indices &each : leaving_)
      divergenceIds_.push_back(each.size() > 1 ? next++ : 0);
    for (const ChartTransitionText &each : chart_.transitions) {
      convergenceIds_.push_back(each.from.size() > 1 ? next++ : 0);
      branchIds_.push_back(each.to.size() > 1 ? next++ : 0);
    }
    next_ = next;
  }

  /// Columns; and which transition leads to a step by a line: the first from a step above it.
  void place() {
    columns_.assign(chart_.steps.size(), 0);
    entering_.assign(chart_.steps.size(), chart_.transitions.size());
    for (size_t i = 0; i < chart_.steps.size(); ++i)
      for (size_t n = 0; n < leaving_[i].size(); ++n) {
        const size_t k = leaving_[i][n];
        const Indices &targets = targets_[k];
        for (size_t branch = 0; branch < targets.size(); ++branch)
          if (const size_t target = targets[branch];
              target > i && entering_[target] == chart_.transitions.size()) {
            entering_[target] = k;
            columns_[target] = columns_[i] + static_cast<int>(n + branch);
          }
      }
  }

  /// Conditions with a name are transitions of the POU; a name that is taken is left out.
  void addNamedTransitions() {
    Node list;
    std::set<std::string> names;
    for (const ChartTransitionText &each : chart_.transitions) {
      if (each.name.empty() || !names.insert(lowerCase(each.name)).second)
        continue;
      if (!list)
        list = pou_.append_child("transitions");
      Node one = list.append_child("transition");
      one.append_attribute("name") = each.name.c_str();
      condition(one.append_child("body"), each);
      named_.insert(&each);
    }
  }

  static void condition(Node body, const ChartTransitionText &transition) {
    Writer::addXhtml(body.append_child(transition.instructions ? "IL" : "ST"),
                     transition.condition);
  }

  Node element(const char *kind, size_t id, int column, size_t row, int offset) {
    Node node = sfc_.append_child(kind);
    node.append_attribute("localId") = std::to_string(id).c_str();
    Node position = node.append_child("position");
    position.append_attribute("x") = std::to_string(column * kColumn).c_str();
    position.append_attribute("y") = std::to_string(static_cast<int>(row) * kRow + offset).c_str();
    return node;
  }
  static void lineIn(Node node, size_t from) {
    Node connection = node.append_child("connectionPointIn").append_child("connection");
    connection.append_attribute("refLocalId") = std::to_string(from).c_str();
  }
  /// Of steps and divergences, whose outputs have a name in the schema.
  static void lineOut(Node node) {
    node.append_child("connectionPointOut").append_attribute("formalParameter") = "sfc";
  }

  void step(size_t i) {
    const ChartStepText &one = chart_.steps[i];
    Node node = element("step", stepIds_[i], columns_[i], i, 0);
    node.append_attribute("name") = one.name.c_str();
    if (one.initial)
      node.append_attribute("initialStep") = "true";
    if (const size_t k = entering_[i]; k != chart_.transitions.size())
      lineIn(node, branchIds_[k] != 0 ? branchIds_[k] : transitionIds_[k]);
    lineOut(node);
    if (!one.actions.empty())
      node.append_child("connectionPointOutAction").append_attribute("formalParameter") = "action";
    if (!one.minTime.empty() || !one.maxTime.empty())
      times(node, one);
    addPragmas(node, one.pragmas);
    Writer::addDocumentation(node, one.comment);
    if (!one.actions.empty())
      actions(i);
    if (divergenceIds_[i] == 0)
      return;
    Node divergence = element("selectionDivergence", divergenceIds_[i], columns_[i], i, 40);
    lineIn(divergence, stepIds_[i]);
    for (size_t n = 0; n < leaving_[i].size(); ++n)
      lineOut(divergence);
  }

  static void addPragmas(Node node, const std::string &pragmas) {
    if (!pragmas.empty())
      Writer::addXhtml(Writer::addData(node, kStride, "pragmas").append_child("Pragmas"), pragmas);
  }

  /// As CODESYS has the properties of a step: by number.
  static void times(Node node, const ChartStepText &step) {
    Node list = Writer::addData(node, kCodesys, "sfc/element").append_child("attributes");
    list.append_attribute("xmlns") = "";
    const auto add = [&](std::string_view guid, const std::string &value) {
      if (value.empty())
        return;
      Node one = list.append_child("attribute");
      one.append_attribute("guid") = std::string(guid).c_str();
      one.text() = value.c_str();
    };
    add(kStepName, step.name);
    add(kStepMinTime, step.minTime);
    add(kStepMaxTime, step.maxTime);
  }

  void actions(size_t i) {
    Node block = element("actionBlock", next_++, columns_[i] + 1, i, 0);
    lineIn(block, stepIds_[i]);
    for (const ChartActionText &each : chart_.steps[i].actions) {
      Node action = block.append_child("action");
      action.append_attribute("localId") = std::to_string(next_++).c_str();
      action.append_attribute("qualifier") = each.qualifier.c_str();
      if (!each.time.empty())
        action.append_attribute("duration") = each.time.c_str();
      if (!each.indicator.empty())
        action.append_attribute("indicator") = each.indicator.c_str();
      Node place = action.append_child("relPosition");
      place.append_attribute("x") = "0";
      place.append_attribute("y") = "0";
      action.append_child("reference").append_attribute("name") = each.name.c_str();
    }
  }

  /// Where the line of a step to one of its transitions begins.
  [[nodiscard]] size_t outOf(size_t step) const {
    return divergenceIds_[step] != 0 ? divergenceIds_[step] : stepIds_[step];
  }

  void transition(size_t k) {
    const ChartTransitionText &one = chart_.transitions[k];
    const Indices &sources = sources_[k];
    const size_t row = sources.front();
    const auto nth = std::ranges::find(leaving_[row], k) - leaving_[row].begin();
    const int column = columns_[row] + static_cast<int>(nth);
    if (convergenceIds_[k] != 0) {
      Node node = element("simultaneousConvergence", convergenceIds_[k], column, row, 60);
      for (const size_t each : sources)
        lineIn(node, outOf(each));
      node.append_child("connectionPointOut");
    }
    Node node = element("transition", transitionIds_[k], column, row, 80);
    if (const std::string priority = priorityOf(k); !priority.empty())
      node.append_attribute("priority") = priority.c_str();
    lineIn(node, convergenceIds_[k] != 0 ? convergenceIds_[k] : outOf(row));
    node.append_child("connectionPointOut");
    Node condition = node.append_child("condition");
    if (named_.contains(&one))
      condition.append_child("reference").append_attribute("name") = one.name.c_str();
    else
      inlineCondition(condition, one);
    addPragmas(node, one.pragmas);
    Writer::addDocumentation(node, one.comment);
    targets(k, column, row);
  }

  static void inlineCondition(Node parent, const ChartTransitionText &transition) {
    Node body = parent.append_child("inline");
    body.append_attribute("name") = "";
    condition(body, transition);
  }

  /// Jumps to the steps that no line of the transition leads to.
  void targets(size_t k, int column, size_t row) {
    const Indices &targets = targets_[k];
    size_t from = transitionIds_[k];
    if (branchIds_[k] != 0) {
      Node node = element("simultaneousDivergence", branchIds_[k], column, row, 100);
      lineIn(node, from);
      for (size_t n = 0; n < targets.size(); ++n)
        lineOut(node);
      from = branchIds_[k];
    }
    for (size_t n = 0; n < targets.size(); ++n) {
      if (entering_[targets[n]] == k)
        continue;
      Node jump = element("jumpStep", next_++, column + static_cast<int>(n), row, 120);
      jump.append_attribute("targetName") = chart_.steps[targets[n]].name.c_str();
      lineIn(jump, from);
    }
  }

  /// Transitions of a step go from left to right; those that share a step, but begin at different
  /// ones, have an order only by numbers.
  void rank() {
    const bool numbered = std::ranges::any_of(leaving_, [&](const Indices &all) {
      return std::ranges::any_of(all, [&](size_t each) {
        return sources_[each].front() != sources_[all.front()].front();
      });
    });
    if (!numbered)
      return;
    Indices order(chart_.transitions.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, {}, [&](size_t each) {
      const std::string &own = chart_.transitions[each].priority;
      return own.empty() || own.size() > 18 ? UINT64_MAX : std::stoull(own);
    });
    ranks_.resize(order.size());
    for (size_t i = 0; i < order.size(); ++i)
      ranks_[order[i]] = i + 1;
  }
  [[nodiscard]] std::string priorityOf(size_t k) const {
    return ranks_.empty() ? chart_.transitions[k].priority : std::to_string(ranks_[k]);
  }

  void comment() {
    Node node = element("comment", next_++, 0, chart_.steps.size(), 0);
    node.append_attribute("height") = "40";
    node.append_attribute("width") = "160";
    Writer::addXhtml(node.append_child("content"), chart_.comment);
  }

  Node pou_;
  const ChartText &chart_;
  Node sfc_;
  std::map<std::string, size_t> index_; ///< of steps, by their names in lower case
  std::vector<size_t> stepIds_;
  std::vector<size_t> transitionIds_;
  std::vector<Indices> sources_;       ///< of each transition: the steps that it leaves
  std::vector<Indices> targets_;       ///< and those that it enters
  std::vector<Indices> leaving_;       ///< of each step: its transitions
  std::vector<size_t> ranks_;          ///< of transitions; empty: their own priorities count
  std::vector<size_t> divergenceIds_;  ///< of each step: 0: it has at most one transition
  std::vector<size_t> convergenceIds_; ///< of each transition: 0: it leaves one step
  std::vector<size_t> branchIds_;      ///< of each transition: 0: it enters one step
  std::vector<int> columns_;           ///< of steps
  std::vector<size_t> entering_;       ///< of each step: the transition with a line to it
  std::set<const ChartTransitionText *> named_;
  size_t next_ = 1; ///< free localId
};

} // namespace

bool Writer::chart(Node pou, std::string_view body) {
  const std::optional<ChartText> chart = chartText(body);
  if (!chart)
    return false;
  ChartWriter(pou, *chart).write();
  return true;
}

} // namespace stc::exporting
