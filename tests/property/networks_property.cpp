// Drawn bodies against what their Structured Text does: the drawing is executed node by node, the
// text is parsed and executed by a small interpreter.
#include "compiler/import/networks/print.hpp"
#include "tests/property/networks_interpreter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace stc::import::networks {
namespace {

constexpr size_t kVariables = 5;
constexpr size_t kBlocks = 2;     ///< instances of each type that several boxes call
constexpr size_t kInstances = 20; ///< instances of each type

std::string variable(size_t number) { return "v" + std::to_string(number % kVariables); }

/// Executes a drawing as it stands: every node keeps what it gave last.
class Drawing {
public:
  explicit Drawing(const Body &body) : body_(body), values_(body.nodes.size()) {
    for (size_t i = 0; i < body.nodes.size(); ++i)
      values_[i].assign(2, false);
  }

  /// Nodes in explicit order.
  void runInOrder(Store &store) {
    std::vector<NodeIndex> order;
    for (NodeIndex i = 0; i < body_.nodes.size(); ++i)
      if (body_.nodes[i].order)
        order.push_back(i);
    std::sort(order.begin(), order.end(), [&](NodeIndex a, NodeIndex b) {
      return *body_.nodes[a].order < *body_.nodes[b].order;
    });
    for (size_t at = 0; at < order.size();) {
      const Node &node = body_.nodes[order[at++]];
      if (node.kind == NodeKind::Return && input(node, 0, store))
        return;
      if (node.kind == NodeKind::Jump && input(node, 0, store))
        at = static_cast<size_t>(std::find_if(order.begin(), order.end(),
                                              [&](NodeIndex i) {
                                                return body_.nodes[i].kind == NodeKind::Label &&
                                                       body_.nodes[i].text == node.text;
                                              }) -
                                 order.begin());
      else
        execute(static_cast<NodeIndex>(&node - body_.nodes.data()), store);
    }
  }

  /// Outputs in the file's order, each after what it needs and has not been executed yet.
  void runOnDemand(Store &store) {
    done_.assign(body_.nodes.size(), false);
    std::vector<bool> read(body_.nodes.size(), false);
    for (const Node &node : body_.nodes)
      for (const InPin &pin : node.inputs)
        for (const Wire &wire : pin.wires)
          read[wire.node] = true;
    for (NodeIndex i = 0; i < body_.nodes.size(); ++i)
      if (!read[i])
        demand(i, store);
  }

private:
  void demand(NodeIndex index, Store &store) {
    if (done_[index])
      return;
    done_[index] = true;
    for (const InPin &pin : body_.nodes[index].inputs)
      for (const Wire &wire : pin.wires)
        demand(wire.node, store);
    execute(index, store);
  }

  bool wire(const Wire &from, const Store &store) const {
    const Node &node = body_.nodes[from.node];
    if (node.kind == NodeKind::Rail)
      return true;
    if (node.kind == NodeKind::Input)
      return store.at(node.text) != node.negated;
    if (node.kind == NodeKind::Call && body_.sequence == Sequence::Explicit)
      return store.at(node.text + (node.type == "SR" ? ".Q1" : ".Q")) !=
             node.outputs.front().negated;
    return values_[from.node][from.pin];
  }

  bool input(const Node &node, size_t pin, const Store &store) {
    bool value = false;
    for (const Wire &each : node.inputs[pin].wires)
      value = value || wire(each, store);
    value = value != node.inputs[pin].negated;
    const NodeIndex index = static_cast<NodeIndex>(&node - body_.nodes.data());
    return edge(node.inputs[pin].edge, value, index, pin);
  }

  bool edge(Edge kind, bool value, NodeIndex index, size_t pin) {
    if (kind == Edge::None)
      return value;
    bool &before = before_[{index, pin}];
    const bool found = kind == Edge::Rising ? value && !before : !value && before;
    before = value;
    return found;
  }

  void execute(NodeIndex index, Store &store) {
    const Node &node = body_.nodes[index];
    std::vector<bool> &out = values_[index];
    if (node.kind == NodeKind::Contact) {
      const bool left = input(node, 0, store);
      const bool own = edge(node.edge, store.at(node.text), index, 9) != node.negated;
      out[0] = left && own;
    } else if (node.kind == NodeKind::Output || node.kind == NodeKind::Coil) {
      bool value = input(node, 0, store);
      out[0] = value;
      value = edge(node.edge, value, index, 9) != node.negated;
      if (node.storage == Storage::None)
        store[node.text] = value;
      else if (value)
        store[node.text] = node.storage == Storage::Set;
    } else if (node.kind == NodeKind::Value) {
      out[0] = combined(node, store) != node.outputs.front().negated;
    } else if (node.kind == NodeKind::Call) {
      const bool first = input(node, 0, store);
      const bool second = node.inputs.size() > 1 && input(node, 1, store);
      callBlock(store, node.text, node.type, first, second);
      out[0] =
          store[node.text + (node.type == "SR" ? ".Q1" : ".Q")] != node.outputs.front().negated;
    }
  }

  bool combined(const Node &node, const Store &store) {
    bool value = node.text == "AND";
    for (size_t i = 0; i < node.inputs.size(); ++i) {
      const bool each = input(node, i, store);
      value = node.text == "AND"   ? value && each
              : node.text == "XOR" ? value != each
                                   : value || each;
    }
    return value;
  }

  const Body &body_;
  std::vector<std::vector<bool>> values_;
  std::map<std::pair<NodeIndex, size_t>, bool> before_;
  std::vector<bool> done_;
};

/// Pulls small numbers out of a generated list; when it is used up, zeros.
class Choices {
public:
  explicit Choices(std::vector<uint16_t> values) : values_(std::move(values)) {}
  size_t below(size_t limit) { return at_ < values_.size() ? values_[at_++] % limit : 0; }
  bool oneIn(size_t n) { return below(n) == n - 1; }

private:
  std::vector<uint16_t> values_;
  size_t at_ = 0;
};

Edge someEdge(Choices &choices) {
  return choices.oneIn(8) ? (choices.oneIn(2) ? Edge::Rising : Edge::Falling) : Edge::None;
}

NodeIndex add(Body &body, Node node) {
  body.nodes.push_back(std::move(node));
  body.networks.front().nodes.push_back(body.nodes.size() - 1);
  return body.nodes.size() - 1;
}

InPin pinFrom(NodeIndex node, Choices &choices) {
  InPin pin;
  pin.wires = {{node, 0}};
  pin.negated = choices.oneIn(4);
  pin.edge = someEdge(choices);
  return pin;
}

/// A box, an output, or in charts a jump; `source` chooses where its inputs come from.
template <typename Source> Node someNode(Choices &choices, Source source, size_t number) {
  Node node;
  node.outputs.resize(1);
  node.outputs.front().negated = choices.oneIn(5);
  switch (choices.below(6)) {
  case 0:
  case 1:
  case 2: {
    node.kind = NodeKind::Value;
    const size_t which = choices.below(3);
    node.text = which == 0 ? "AND" : which == 1 ? "OR" : "XOR";
    const size_t inputs = 1 + choices.below(3);
    for (size_t i = 0; i < std::max<size_t>(inputs, which == 2 ? 2 : 1); ++i)
      node.inputs.push_back(pinFrom(source(), choices));
    return node;
  }
  case 3: {
    node.kind = NodeKind::Call;
    const size_t which = choices.below(3);
    node.type = which == 0 ? "R_TRIG" : which == 1 ? "F_TRIG" : "SR";
    node.text = (which == 0   ? "rise"
                 : which == 1 ? "fall"
                              : "latch") +
                std::to_string(choices.below(kBlocks));
    node.outputs.front().name = which == 2 ? "Q1" : "Q";
    node.inputs.push_back(pinFrom(source(), choices));
    node.inputs.back().name = which == 2 ? "SET1" : "CLK";
    if (which == 2) {
      node.inputs.push_back(pinFrom(source(), choices));
      node.inputs.back().name = "RESET";
    }
    return node;
  }
  default:
    node.kind = NodeKind::Output;
    node.text = variable(number + choices.below(kVariables));
    node.negated = choices.oneIn(3);
    node.edge = someEdge(choices);
    node.storage =
        choices.oneIn(3) ? (choices.oneIn(2) ? Storage::Set : Storage::Reset) : Storage::None;
    node.inputs.push_back(pinFrom(source(), choices));
    return node;
  }
}

/// Inputs of their own for about half of the pins.
NodeIndex someInput(Body &body, Choices &choices) {
  Node node;
  node.kind = NodeKind::Input;
  node.text = variable(choices.below(kVariables));
  node.negated = choices.oneIn(3);
  return add(body, std::move(node));
}

Body emptyBody(Sequence sequence) {
  Body body;
  body.networks.emplace_back();
  body.sequence = sequence;
  return body;
}

/// Boxes and outputs; each reads earlier ones.
Body someDiagram(Choices choices) {
  Body body = emptyBody(Sequence::Document);
  std::vector<NodeIndex> boxes;
  const size_t count = 2 + choices.below(14);
  for (size_t i = 0; i < count; ++i) {
    const auto source = [&] {
      return boxes.empty() || choices.oneIn(3) ? someInput(body, choices)
                                               : boxes[choices.below(boxes.size())];
    };
    Node node = someNode(choices, source, i);
    const bool box = node.kind != NodeKind::Output;
    const NodeIndex index = add(body, std::move(node));
    if (box)
      boxes.push_back(index);
  }
  return body;
}

/// Boxes and outputs in any order, wired in circles as it comes, with forward jumps and returns.
Body someChart(Choices choices) {
  Body body = emptyBody(Sequence::Explicit);
  const size_t count = 2 + choices.below(12);
  std::vector<NodeIndex> boxes;
  std::vector<NodeIndex> ordered;
  for (size_t i = 0; i < count; ++i) {
    Node node = someNode(
        choices, [] { return NodeIndex{0}; }, i);
    const bool box = node.kind != NodeKind::Output;
    if (node.kind == NodeKind::Call) // of its own: others would change what it gives
      node.text = node.text.substr(0, node.text.size() - 1) + std::to_string(kBlocks + i);
    ordered.push_back(add(body, std::move(node)));
    if (box)
      boxes.push_back(ordered.back());
  }
  if (choices.oneIn(2)) {
    for (const NodeKind kind :
         {NodeKind::Jump, choices.oneIn(3) ? NodeKind::Return : NodeKind::Jump}) {
      Node node;
      node.kind = kind;
      node.text = "skip";
      node.inputs = {pinFrom(0, choices)};
      node.inputs.front().edge = Edge::None;
      ordered.insert(ordered.begin() + static_cast<ptrdiff_t>(choices.below(ordered.size())),
                     add(body, std::move(node)));
    }
    Node label;
    label.kind = NodeKind::Label;
    label.text = "skip";
    size_t last = 0;
    for (size_t i = 0; i < ordered.size(); ++i)
      last = body.nodes[ordered[i]].kind == NodeKind::Jump ? i : last;
    ordered.insert(ordered.begin() +
                       static_cast<ptrdiff_t>(last + 1 + choices.below(ordered.size() - last)),
                   add(body, std::move(label)));
  }
  for (size_t i = 0; i < ordered.size(); ++i)
    body.nodes[ordered[i]].order = static_cast<long>(7 + 2 * i);
  for (const NodeIndex index : ordered)
    for (size_t pin = 0; pin < body.nodes[index].inputs.size(); ++pin) {
      const NodeIndex from = boxes.empty() || choices.oneIn(3) ? someInput(body, choices)
                                                               : boxes[choices.below(boxes.size())];
      body.nodes[index].inputs[pin].wires = {{from, 0}};
    }
  return body;
}

/// Contacts with branches, and coils.
Body someLadder(Choices choices) {
  Body body = emptyBody(Sequence::Document);
  Node rail;
  rail.kind = NodeKind::Rail;
  std::vector<NodeIndex> sources = {add(body, std::move(rail))};
  const size_t count = 2 + choices.below(14);
  for (size_t i = 0; i < count; ++i) {
    Node node;
    const bool coil = choices.oneIn(4) || i + 1 == count;
    node.kind = coil ? NodeKind::Coil : NodeKind::Contact;
    node.text = variable(choices.below(kVariables));
    node.edge = someEdge(choices);
    node.negated = node.edge == Edge::None && choices.oneIn(3);
    node.outputs.resize(1);
    if (coil && choices.oneIn(3))
      node.storage = choices.oneIn(2) ? Storage::Set : Storage::Reset;
    InPin pin;
    const size_t wires = 1 + choices.below(3);
    for (size_t w = 0; w < wires; ++w)
      pin.wires.push_back({sources[choices.below(sources.size())], 0});
    node.inputs = {pin};
    sources.push_back(add(body, std::move(node)));
  }
  return body;
}

std::map<std::string, std::string> instances() {
  std::map<std::string, std::string> result;
  for (size_t i = 0; i < kInstances; ++i) {
    result["rise" + std::to_string(i)] = "R_TRIG";
    result["fall" + std::to_string(i)] = "F_TRIG";
    result["latch" + std::to_string(i)] = "SR";
  }
  return result;
}

Scope scene() {
  Scope scope;
  scope.declare("FUNCTION_BLOCK R_TRIG VAR_INPUT CLK : BOOL; END_VAR VAR_OUTPUT Q : BOOL; END_VAR\n"
                "END_FUNCTION_BLOCK FUNCTION_BLOCK F_TRIG VAR_INPUT CLK : BOOL; END_VAR\n"
                "VAR_OUTPUT Q : BOOL; END_VAR END_FUNCTION_BLOCK\n"
                "FUNCTION_BLOCK SR VAR_INPUT SET1, RESET : BOOL; END_VAR\n"
                "VAR_OUTPUT Q1 : BOOL; END_VAR END_FUNCTION_BLOCK\n");
  std::string variables = "v0, v1, v2, v3, v4 : BOOL;";
  for (const auto &[name, type] : instances())
    variables += " " + name + " : " + type + ";";
  scope.enter("PROGRAM P VAR " + variables + " END_VAR");
  return scope;
}

void compare(const Body &body, const std::vector<uint16_t> &inputs) {
  Scope scope = scene();
  const Translation text = translated(body, scope);
  RC_ASSERT(text.ok());
  RC_LOG() << text.declarations << text.statements;
  std::map<std::string, std::string> all = declaredInstances(text.declarations);
  Store drawn;
  for (size_t i = 0; i < kVariables; ++i)
    drawn[variable(i)] = false;
  all.merge(instances());
  for (const auto &[name, type] : all)
    drawn[name + (type == "SR" ? ".Q1" : ".Q")] = false;
  Store written = drawn;
  Interpreter interpreter(text.statements, all);
  Drawing drawing(body);
  for (const uint16_t bits : inputs) {
    for (size_t i = 0; i < 3; ++i) // the others keep what was written
      drawn[variable(i)] = written[variable(i)] = (bits >> i & 1) != 0;
    if (body.sequence == Sequence::Explicit)
      drawing.runInOrder(drawn);
    else
      drawing.runOnDemand(drawn);
    interpreter.run(written);
    for (size_t i = 0; i < kVariables; ++i)
      RC_ASSERT(written[variable(i)] == drawn[variable(i)]);
  }
}

RC_GTEST_PROP(Networks, diagramsDoWhatTheirTextDoes,
              (const std::vector<uint16_t> &choices, const std::vector<uint16_t> &inputs)) {
  compare(someDiagram(Choices(choices)), inputs);
}

RC_GTEST_PROP(Networks, chartsWithCirclesAndJumpsDoWhatTheirTextDoes,
              (const std::vector<uint16_t> &choices, const std::vector<uint16_t> &inputs)) {
  compare(someChart(Choices(choices)), inputs);
}

RC_GTEST_PROP(Networks, laddersDoWhatTheirTextDoes,
              (const std::vector<uint16_t> &choices, const std::vector<uint16_t> &inputs)) {
  compare(someLadder(Choices(choices)), inputs);
}

} // namespace
} // namespace stc::import::networks
