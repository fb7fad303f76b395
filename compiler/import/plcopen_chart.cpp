// Sequential function charts of PLCopen XML as textual SFC. The file has steps, transitions and
// lines between them: which steps a transition leaves and enters is followed along the lines.
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/plcopen_context.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace stc::import::plcopen {

namespace {

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
  char quote = 0;
  size_t depth = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const std::string_view two = text.substr(i, 2);
    if (quote != 0)
      quote = text[i] == quote ? '\0' : quote;
    else if (two == "(*")
      ++depth;
    else if (two == "*)")
      depth -= depth > 0 ? 1 : 0;
    else if (depth == 0 && (text[i] == '\'' || text[i] == '"'))
      quote = text[i];
    else if (depth == 0 && text[i] == ';')
      return true;
  }
  return false;
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
      : context_(context), sfc_(sfc), pou_(pou), object_(std::move(object)), members_(members) {}

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
    context_.leaveOutUnknown(
        sfc_, {"step", "transition", "jumpStep", "selectionDivergence", "selectionConvergence",
               "simultaneousDivergence", "simultaneousConvergence", "actionBlock", "inVariable",
               "leftPowerRail", "contact", "comment", "macroStep", "block", "rightPowerRail"});
    if (problem_)
      return {};
    for (const Node &each : all)
      if (localName(each) == "macroStep")
        fail(each, "macro steps are not imported");
    readTargets(all);
    std::string result;
    for (const Node &each : all) {
      const std::string_view kind = localName(each);
      if (kind == "step")
        result += step(each, all);
      else if (kind == "comment")
        result += commentLines(linesOf(child(each, "content")), {}, "//");
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
    } else if (kind != "leftPowerRail") {
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

  std::string step(const Node &node, const std::vector<Node> &all) {
    const std::string id = attribute(node, "localId");
    const std::string name = attribute(node, "name");
    std::string text = documentationLines(node);
    reportProperties(node, name);
    text += fmt::format("{} {}:\n", isTrue(node, "initialStep") ? "INITIAL_STEP" : "STEP", name);
    for (const Node &each : all) {
      if (localName(each) != "actionBlock")
        continue;
      const std::vector<std::string> inputs = inputsOf(each);
      if (std::find(inputs.begin(), inputs.end(), id) != inputs.end())
        for (const Node &action : children(each, "action"))
          text += "  " + actionText(action, name) + "\n";
    }
    return text + "END_STEP\n" + transitionsOf(name, all);
  }

  /// Entry and exit actions and times of CODESYS's steps, of which the file says only numbers.
  void reportProperties(const Node &node, const std::string &name) {
    for (const Node &each : children(extra(node, "attributes"), "attribute")) {
      const std::string value = textOf(each);
      constexpr std::string_view kName = "38391c6d-6d4a-42f8-8ee7-9f45e5adafa8";
      const bool usual = value.empty() || value == "FALSE" || value == "TRUE" || value == "0";
      if (!usual && attribute(each, "guid") != kName)
        context_.leftOut(each, fmt::format("{}: step {}", object_, name),
                         fmt::format("its property {} = `{}`: an action or a time of the step",
                                     attribute(each, "guid"), value));
    }
  }

  std::string actionText(const Node &action, const std::string &stepName) {
    std::string name = attribute(child(action, "reference"), "name");
    const std::string qualifier = attribute(action, "qualifier");
    const std::string time = attribute(action, "duration");
    const std::string indicator = attribute(action, "indicator");
    if (const Node body = child(action, "inline")) {
      name = fmt::format("{}_action{}", stepName, ++ownActions_);
      std::string inner;
      members_ += fmt::format("\nACTION {}:\n{}END_ACTION\n", name,
                              bodyText(context_, body, {}, object_ + "." + name, inner));
      leaveOutMembers(context_, body, object_ + "." + name, inner);
    }
    if (name.empty())
      fail(action, fmt::format("an action of the step `{}` has no name", stepName));
    if (!indicator.empty())
      context_.leftOut(action, fmt::format("{}: action {}", object_, name),
                       fmt::format("its indicator variable `{}`", indicator));
    return fmt::format("{}({}{}{});", name, qualifier.empty() ? "N" : qualifier,
                       time.empty() ? "" : ", ", time);
  }

  /// The transitions whose first step it is: by priority, then from left to right.
  std::string transitionsOf(const std::string &name, const std::vector<Node> &all) {
    if (transitions_.empty())
      for (const Node &each : all)
        if (localName(each) == "transition") {
          std::vector<std::string> sources = sourcesOf(each);
          if (sources.empty())
            fail(each, "a transition comes from no step");
          transitions_.push_back({each, std::move(sources), horizontal(each)});
        }
    std::vector<const Transition *> own;
    for (const Transition &each : transitions_)
      if (!each.sources.empty() && each.sources.front() == name)
        own.push_back(&each);
    std::stable_sort(own.begin(), own.end(), [](const Transition *a, const Transition *b) {
      return a->horizontal < b->horizontal;
    });
    std::string text;
    for (const Transition *each : own)
      text += transitionText(*each);
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
    return fmt::format("{}TRANSITION{}{} FROM {} TO {}{}\nEND_TRANSITION\n",
                       documentationLines(transition.node), name.empty() ? "" : " " + name,
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
          return ofBody(child(each, "body"), each, negated);
        }
      return ofText(wanted, reference, negated);
    }
    if (const Node body = child(condition, "inline"))
      return ofBody(body, transition, negated);
    const std::vector<std::string> inputs = inputsOf(condition);
    if (inputs.empty()) {
      fail(transition, "a transition has no condition");
      return {};
    }
    visited_ = 0;
    return ofText(valueOf(inputs, transition, 0), transition, negated);
  }

  std::string ofBody(const Node &body, const Node &place, bool negated) {
    const Node text = firstElement(body);
    const std::string_view kind = localName(text);
    if (kind == "ST")
      return ofText(bare(textOf(text)), place, negated);
    if (kind == "IL" && !negated)
      return ":\n" + linesOf(text);
    fail(place, fmt::format("the condition of a transition is drawn ({})", kind));
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
  std::optional<Problem> problem_;
  std::map<std::string, Node> elements_;                    ///< by localId
  std::map<std::string, std::vector<std::string>> targets_; ///< of transitions
  std::vector<Transition> transitions_;
  size_t ownActions_ = 0;
  size_t visited_ = 0; ///< elements of the condition that is read
};

} // namespace

std::string chartText(Context &context, const Node &sfc, const Node &pou, const std::string &object,
                      std::string &members) {
  return Chart(context, sfc, pou, object, members).text();
}

} // namespace stc::import::plcopen
