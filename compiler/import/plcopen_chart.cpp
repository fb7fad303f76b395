// Sequential function charts of PLCopen XML as textual SFC. The file has steps, transitions and
// lines between them: which steps a transition leaves and enters is followed along the lines.
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/plcopen_conditions.hpp"
#include "compiler/import/plcopen_context.hpp"
#include "compiler/source/st_scan.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace stc::import::plcopen {

namespace {

/// What a property of CODESYS's steps says. The file has only its number.
enum class Property { Usual, Comment, MinTime, MaxTime, Entry, Main, Exit };
constexpr std::pair<std::string_view, Property> kProperties[] = {
    {"38391c6d-6d4a-42f8-8ee7-9f45e5adafa8", Property::Usual}, // the name
    {"01580b27-6378-448b-8ecb-0e4b795b58d6", Property::Usual}, // excluded from the build
    {"bc882c11-1e91-4dd8-a6b8-2075724ed18b", Property::Usual}, // a number
    {"6844a48e-46c2-4cc8-a185-a478f3b99cc0", Property::Usual}, // initial step
    {"62e1754b-7629-4e63-9cec-10ae0c536f1f", Property::Usual}, // copying makes new actions
    {"7d894980-aeea-405c-a0f6-e2b26429c58f", Property::Comment},
    {"cacf1a68-236e-47c2-b7b1-1cf9199718cb", Property::MinTime},
    {"b693554c-1b01-4a8d-afde-9e3a46f7465d", Property::MaxTime},
    {"a6b08bd8-b696-47e3-9cbf-7408b61c9ff8", Property::Entry},
    {"700a583f-b4d4-43e4-8c14-629c7cd3bec8", Property::Main},
    {"a2621e18-7de3-4ea6-ae6d-89e9e0b7befd", Property::Exit},
};

/// Elements of a chart that is read; following the lines of more takes too long.
constexpr size_t kMostElements = 20'000;

/// Where the lines that end at an element begin.
std::vector<std::string> inputsOf(const Node &node) {
  std::vector<std::string> inputs;
  for (const Node &point : children(node, "connectionPointIn"))
    for (const Node &each : children(point, "connection"))
      inputs.push_back(attribute(each, "refLocalId"));
  return inputs;
}

double horizontal(const Node &node) {
  return std::strtod(child(node, "position").attribute("x").value(), nullptr);
}

/// An expression that stands as a body: without `:=` before and `;` after it.
std::string bare(const std::string &text) {
  std::string_view rest = trimmed(text);
  while (!rest.empty() && (rest.back() == ';' || rest.back() == '\n'))
    rest = trimmed(rest.substr(0, rest.size() - 1));
  if (rest.starts_with(":="))
    rest = trimmed(rest.substr(2));
  return std::string(rest);
}

/// Whether a `;` stands in it outside of texts and comments: it is more than an expression.
bool hasStatements(std::string_view text) {
  const std::vector<StWord> words = wordsOf(text);
  return std::any_of(words.begin(), words.end(),
                     [&](const StWord &each) { return text[each.begin] == ';'; });
}

/// What cannot be read; the chart is left out as a whole.
struct Problem {
  Node node;
  std::string text;
};

class Chart {
public:
  Chart(Context &context, const Node &sfc, const Node &pou, std::string object,
        std::string &members)
      : context_(context), sfc_(sfc), pou_(pou), object_(std::move(object)), members_(members),
        drawn_(context, pou ? pou : sfc, object_) {}

  std::string text() {
    std::string result = read();
    if (!problem_)
      return result;
    context_.leftOut(problem_->node, object_, fmt::format("its chart (SFC): {}", problem_->text));
    return errorPragma("SFC: " + problem_->text);
  }

private:
  void fail(const Node &node, std::string text) {
    if (!problem_)
      problem_ = {node, std::move(text)};
  }

  std::string read() {
    const std::vector<Node> all = children(sfc_);
    if (all.size() > kMostElements)
      fail(sfc_, fmt::format("it has more than {} elements", kMostElements));
    for (const Node &each : all)
      elements_.emplace(attribute(each, "localId"), each);
    context_.leaveOutUnknown(sfc_, {"step", "transition", "jumpStep", "selectionDivergence",
                                    "selectionConvergence", "simultaneousDivergence",
                                    "simultaneousConvergence", "actionBlock", "inVariable",
                                    "leftPowerRail", "contact", "comment", "macroStep", "block",
                                    "rightPowerRail", "connector", "continuation"});
    if (problem_)
      return {};
    for (const Node &each : all)
      if (localName(each) == "macroStep")
        fail(each, "macro steps are not imported");
    for (const Node &each : all)
      if (localName(each) == "actionBlock")
        for (const std::string &id : inputsOf(each))
          blocks_[id].push_back(each);
    readTargets(all);
    readTransitions(all);
    std::string result;
    size_t initial = std::string::npos; // where the actions of the first initial step end
    for (const Node &each : all) {
      const std::string_view kind = localName(each);
      if (kind == "step") {
        const std::string head = step(each);
        if (isTrue(each, "initialStep") && initial == std::string::npos)
          initial = result.size() + head.size();
        result += head + "END_STEP\n" + transitionsOf(attribute(each, "name"));
      } else if (kind == "comment") {
        result += commentLines(linesOf(child(each, "content")), {}, "//");
      }
    }
    if (const std::string action = drawn_.finish(members_); !action.empty()) {
      if (initial == std::string::npos)
        fail(sfc_, "its conditions are drawn with blocks, and it has no initial step");
      else
        result.insert(initial, fmt::format("  {}(S);\n", action));
    }
    return result;
  }

  /// Which steps each transition leads to.
  void readTargets(const std::vector<Node> &all) {
    for (const Node &each : all) {
      const std::string_view kind = localName(each);
      if (kind != "step" && kind != "jumpStep")
        continue;
      const std::string name = attribute(each, kind == "step" ? "name" : "targetName");
      if (!isName(name))
        fail(each, fmt::format("`{}` is no name of a step", name));
      std::set<std::string> seen;
      std::vector<std::string> open = inputsOf(each);
      while (!open.empty()) {
        const std::string id = open.back();
        open.pop_back();
        if (seen.insert(id).second)
          enter(id, each, name, open);
      }
    }
  }

  void enter(const std::string &id, const Node &from, const std::string &name,
             std::vector<std::string> &open) {
    const auto found = elements_.find(id);
    if (found == elements_.end())
      return fail(from, fmt::format("a line begins at `{}`, which is not there", id));
    const std::string_view kind = localName(found->second);
    if (kind == "transition") {
      targets_[id].push_back(name);
    } else if (kind == "selectionConvergence" || kind == "simultaneousDivergence") {
      for (std::string &each : inputsOf(found->second))
        open.push_back(std::move(each));
    } else if (kind != "leftPowerRail" && kind != "jumpStep") {
      // CODESYS draws a line also from a branch that ends in a jump.
      fail(from, fmt::format("a line leads to `{}` from a {} instead of a transition", name, kind));
    }
  }

  /// The steps that must be active for a transition.
  std::vector<std::string> sourcesOf(const Node &transition) {
    std::vector<std::string> sources;
    std::set<std::string> seen;
    std::vector<std::string> open = inputsOf(transition);
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
      const std::string id = open.back();
      open.pop_back();
      if (!seen.insert(id).second)
        continue;
      const auto found = elements_.find(id);
      const std::string_view kind =
          found == elements_.end() ? std::string_view("nothing") : localName(found->second);
      if (kind == "step") {
        sources.push_back(attribute(found->second, "name"));
      } else if (kind == "selectionDivergence" || kind == "simultaneousConvergence") {
        std::vector<std::string> inputs = inputsOf(found->second);
        open.insert(open.end(), inputs.rbegin(), inputs.rend());
      } else {
        fail(transition, fmt::format("a line leads to a transition from {}", kind));
      }
    }
    return sources;
  }

  /// Without END_STEP.
  std::string step(const Node &node) {
    const std::string id = attribute(node, "localId");
    const std::string name = attribute(node, "name");
    std::string text = documentationLines(node) + linesOf(extra(node, "Pragmas"));
    std::map<Property, std::string> found = propertiesOf(node, name);
    text += commentLines(found[Property::Comment], {}, "//");
    std::string times;
    for (const auto &[property, word] :
         {std::pair{Property::MinTime, "MIN_TIME"}, std::pair{Property::MaxTime, "MAX_TIME"}})
      if (!found[property].empty())
        times += fmt::format("{}{} := {}", times.empty() ? " (" : ", ", word, found[property]);
    text += fmt::format("{} {}{}{}:\n", isTrue(node, "initialStep") ? "INITIAL_STEP" : "STEP", name,
                        times, times.empty() ? "" : ")");
    text += stepAction(node, name, found[Property::Entry], "entry", "P1");
    text += stepAction(node, name, found[Property::Main], "main", "N");
    for (const Node &each : blocks_[id])
      for (const Node &action : children(each, "action"))
        text += "  " + actionText(action, name) + "\n";
    return text + stepAction(node, name, found[Property::Exit], "exit", "P0");
  }

  /// Actions and times of CODESYS's steps, and their comment.
  std::map<Property, std::string> propertiesOf(const Node &node, const std::string &name) {
    std::map<Property, std::string> found;
    for (const Node &each : children(extra(node, "attributes"), "attribute")) {
      const std::string value(trimmed(textOf(each)));
      const bool usual = value.empty() || value == "FALSE" || value == "TRUE" || value == "0";
      const auto *const row = std::ranges::find(kProperties, attribute(each, "guid"),
                                                &std::pair<std::string_view, Property>::first);
      const bool known = row != std::end(kProperties);
      const bool action = known && row->second >= Property::Entry;
      if (usual || (known && row->second == Property::Usual))
        continue;
      if (!known || (action && !isName(value)) || (!action && hasStatements(value)))
        context_.leftOut(each, fmt::format("{}: step {}", object_, name),
                         fmt::format("its property {} = `{}`, which is not known",
                                     attribute(each, "guid"), value));
      else
        found[row->second] = value;
    }
    return found;
  }

  /// An action that CODESYS binds to the step itself: without a final scan, and each step for
  /// itself, so it is called by an action of the step's own.
  std::string stepAction(const Node &node, const std::string &step, const std::string &called,
                         const std::string &kind, const char *qualifier) {
    if (called.empty())
      return {};
    const std::string name = drawn_.freshName(fmt::format("{}_{}", step, kind));
    const bool main = kind == "main";
    members_ += fmt::format("\nACTION {}:\n{}{}();{}\nEND_ACTION\n", name,
                            main ? fmt::format("IF {}.x THEN\n  ", step) : "", called,
                            main ? "\nEND_IF" : "");
    context_.changed(node, fmt::format("{}: step {}", object_, step),
                     fmt::format("its {} action `{}` is called by the action `{}`",
                                 main ? "step" : kind, called, name));
    return fmt::format("  {}({});\n", name, qualifier);
  }

  std::string actionText(const Node &action, const std::string &stepName) {
    std::string name = attribute(child(action, "reference"), "name");
    const std::string qualifier = attribute(action, "qualifier");
    const std::string time = attribute(action, "duration");
    const std::string indicator = attribute(action, "indicator");
    if (const Node body = child(action, "inline")) {
      name = drawn_.freshName(fmt::format("{}_action{}", stepName, ++ownActions_));
      std::string inner;
      members_ += fmt::format("\nACTION {}:\n{}END_ACTION\n", name,
                              bodyText(context_, body, {}, object_ + "." + name, inner));
      leaveOutMembers(context_, body, object_ + "." + name, inner);
    }
    if (name.empty())
      fail(action, fmt::format("an action of the step `{}` has no name", stepName));
    return fmt::format("{}({}{}{}{}{});", name, qualifier.empty() ? "N" : qualifier,
                       time.empty() ? "" : ", ", time, indicator.empty() ? "" : ", ", indicator);
  }

  void readTransitions(const std::vector<Node> &all) {
    for (const Node &each : all) {
      if (localName(each) != "transition")
        continue;
      std::vector<std::string> sources = sourcesOf(each);
      if (sources.empty())
        fail(each, "a transition comes from no step");
      else
        transitions_[sources.front()].push_back({each, sources, horizontal(each)});
    }
    for (auto &[name, own] : transitions_)
      std::ranges::stable_sort(own, {}, &Transition::horizontal);
  }

  /// The transitions whose first step it is: by priority, then from left to right.
  std::string transitionsOf(const std::string &name) {
    std::string text;
    for (const Transition &each : transitions_[name])
      text += transitionText(each);
    return text;
  }

  struct Transition {
    Node node;
    std::vector<std::string> sources;
    double horizontal;
  };

  static std::string list(const std::vector<std::string> &names) {
    std::string text;
    for (const std::string &each : names)
      text += (text.empty() ? "" : ", ") + each;
    return names.size() == 1 ? text : "(" + text + ")";
  }

  std::string transitionText(const Transition &transition) {
    const std::vector<std::string> &targets = targets_[attribute(transition.node, "localId")];
    if (targets.empty()) {
      fail(transition.node, "a transition leads to no step");
      return {};
    }
    const std::string priority = attribute(transition.node, "priority");
    std::string name;
    const std::string condition = conditionOf(transition.node, name);
    return fmt::format("{}{}TRANSITION{}{} FROM {} TO {}{}\nEND_TRANSITION\n",
                       documentationLines(transition.node),
                       linesOf(extra(transition.node, "Pragmas")), name.empty() ? "" : " " + name,
                       priority.empty() ? "" : fmt::format(" (PRIORITY := {})", priority),
                       list(transition.sources), list(targets), condition);
  }

  /// ` := x;`, or `:` and an instruction list.
  std::string conditionOf(const Node &transition, std::string &name) {
    const Node condition = child(transition, "condition");
    const bool negated = isTrue(condition, "negated");
    if (const Node reference = child(condition, "reference")) {
      const std::string wanted = attribute(reference, "name");
      for (const Node &each : children(child(pou_, "transitions"), "transition"))
        if (sameName(attribute(each, "name"), wanted)) {
          name = wanted;
          return ofBody(child(each, "body"), each, wanted, negated);
        }
      return ofText(wanted, reference, negated);
    }
    if (const Node body = child(condition, "inline"))
      return ofBody(body, transition, attribute(body, "name"), negated);
    const std::vector<std::string> inputs = inputsOf(condition);
    if (inputs.empty()) {
      fail(transition, "a transition has no condition");
      return {};
    }
    if (isDrawnWithBlocks(inputs)) // `negated` is part of the drawing
      return ofText(drawn_.ofLines(transition, condition, elements_), transition, false);
    visited_ = 0;
    return ofText(valueOf(inputs, transition, 0), transition, negated);
  }

  /// Whether something leads to the condition that is neither a variable nor a plain contact.
  bool isDrawnWithBlocks(std::vector<std::string> open) {
    std::set<std::string> seen;
    while (!open.empty()) {
      const std::string id = open.back();
      open.pop_back();
      const auto found = elements_.find(id);
      if (found == elements_.end() || !seen.insert(id).second)
        continue;
      const Node &node = found->second;
      const std::string_view kind = localName(node);
      const bool edge = kind == "contact" && attribute(node, "edge").size() >= 5;
      if (edge || kind == "block" || kind == "continuation")
        return true;
      for (std::string &each : inputsOf(node))
        if (kind == "contact")
          open.push_back(std::move(each));
    }
    return false;
  }

  std::string ofBody(const Node &body, const Node &place, const std::string &name, bool negated) {
    const Node text = firstElement(body);
    const std::string_view kind = localName(text);
    if (kind == "ST")
      return ofText(bare(textOf(text)), place, negated);
    if (kind == "IL" && !negated)
      return ":\n" + linesOf(text);
    if (const std::string value = drawn_.ofBody(body, place, name); !value.empty())
      return ofText(value, place, negated);
    fail(place, fmt::format("the condition of a transition is drawn ({}), and nothing in it is "
                            "assigned to `{}`",
                            kind, name));
    return {};
  }

  std::string ofText(const std::string &text, const Node &place, bool negated) {
    if (text.empty())
      fail(place, "a transition has an empty condition");
    else if (hasStatements(text))
      fail(place, "the condition of a transition is more than an expression");
    return negated ? fmt::format(" := NOT ({});", text) : fmt::format(" := {};", text);
  }

  /// The value at the end of these lines: of variables and of contacts in rows.
  std::string valueOf(const std::vector<std::string> &inputs, const Node &place, size_t depth) {
    constexpr size_t kDeepest = 200;
    constexpr size_t kMostVisited = 1000; // lines that meet again double the text each time
    std::string text;
    for (const std::string &each : inputs) {
      const auto found = elements_.find(each);
      const Node node = found == elements_.end() ? Node() : found->second;
      const std::string_view kind = localName(node);
      const std::string negation = isTrue(node, "negated") ? "NOT " : "";
      std::string one;
      if (depth == kDeepest) {
        fail(place, "the condition of a transition leads in a circle");
      } else if (++visited_ > kMostVisited) {
        fail(place,
             fmt::format("the condition of a transition has more than {} contacts", kMostVisited));
      } else if (kind == "leftPowerRail") {
        one = "TRUE";
      } else if (kind == "inVariable") {
        one = std::string(trimmed(textOf(child(node, "expression"))));
        if (!negation.empty())
          one = fmt::format("NOT ({})", one);
      } else if (kind == "contact" && attribute(node, "edge").size() < 5) {
        one = negation + std::string(trimmed(textOf(child(node, "variable"))));
        const std::vector<std::string> left = inputsOf(node);
        if (left.empty())
          fail(place, "the condition of a transition has a contact that no line leads to");
        const std::string before = valueOf(left, place, depth + 1);
        if (before != "TRUE")
          one = fmt::format("{} AND {}", isName(before) ? before : "(" + before + ")", one);
      } else {
        fail(place, fmt::format("the condition of a transition is drawn with a {}", kind));
      }
      text += (text.empty() ? "" : " OR ") + one;
      if (problem_)
        return {};
    }
    return text;
  }

  Context &context_;
  const Node sfc_;
  const Node pou_;
  const std::string object_;
  std::string &members_;
  DrawnConditions drawn_;
  std::optional<Problem> problem_;
  ChartElements elements_;
  std::map<std::string, std::vector<std::string>> targets_;    ///< of transitions
  std::map<std::string, std::vector<Transition>> transitions_; ///< by their first step
  std::map<std::string, std::vector<Node>> blocks_; ///< of actions, by the step's localId
  size_t ownActions_ = 0;
  size_t visited_ = 0; ///< elements of the condition that is read
};

} // namespace

std::string chartText(Context &context, const Node &sfc, const Node &pou, const std::string &object,
                      std::string &members) {
  return Chart(context, sfc, pou, object, members).text();
}

} // namespace stc::import::plcopen
