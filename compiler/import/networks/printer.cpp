#include "compiler/import/networks/printer.hpp"

#include "compiler/import/networks/types.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stc::import::networks {

using stride::common::upperCase;

namespace {

constexpr size_t kLeavesRepeated = 12; // of an expression that stands several times in a statement
constexpr size_t kLeaves = 30;         // of an expression, for people's sake
constexpr size_t kReadableDepth = 12;  // of an expression, likewise
constexpr size_t kDepthAtMost = 60;    // where no variable can be declared
constexpr size_t kLeavesAtMost = 1000; // likewise
constexpr size_t kNodesLookedAt = 64;

size_t depthOf(const Expression &expression) {
  size_t deepest = 0;
  for (const Expression &each : expression.operands)
    deepest = std::max(deepest, depthOf(each));
  return deepest + 1;
}

bool isLeaf(const Expression &expression) {
  if (expression.kind == Expression::Kind::Operator && expression.precedence == kUnary)
    return isLeaf(expression.operands.front());
  return expression.kind == Expression::Kind::Text && expression.precedence >= kUnary &&
         !callsIn(expression);
}

/// What a text is about: its first variable.
std::string subjectOf(const std::string &text) {
  if (isVariable(text))
    return text;
  for (const Word &word : wordsOf(text)) {
    if (word.kind != Word::Kind::Name || upperCase(word.text) == "NOT")
      continue;
    for (const std::string_view suffix : {"_rising", "_falling"})
      if (word.text.ends_with(suffix))
        return word.text.substr(0, word.text.size() - suffix.size());
    return word.text;
  }
  return "edge";
}

/// Nodes whose value goes on inside an expression.
bool passesOn(const Node &node) {
  return node.kind == NodeKind::Contact ||
         (node.kind == NodeKind::Value && std::ranges::none_of(node.inputs, &InPin::enable));
}

} // namespace

void Writer::line(std::string_view text) {
  text_ += std::string(2 * indent_, ' ') + std::string(text) + "\n";
}

void Writer::open(const Expression &condition) {
  if (isTruth(condition))
    return;
  line(fmt::format("IF {} THEN", printed(condition)));
  ++indent_;
}

void Writer::close(const Expression &condition) {
  if (isTruth(condition))
    return;
  --indent_;
  line("END_IF");
}

void Writer::gap() {
  if (!text_.empty() && !text_.ends_with("\n\n"))
    text_ += "\n";
}

void Writer::declare(std::string name, std::string type) {
  declared_.push_back({std::move(name), std::move(type)});
}

std::string Writer::declarations() const {
  if (declared_.empty())
    return {};
  std::string text = "VAR\n";
  for (const Declared &each : declared_)
    text += fmt::format("  {} : {};\n", each.name, each.type);
  return text + "END_VAR\n";
}

Values::Values(const Body &body, Scope &scope, Writer &writer, Translation &result)
    : body_(body), scope_(scope), writer_(writer), result_(result) {
  for (NodeIndex i = 0; i < body.nodes.size(); ++i)
    for (const InPin &pin : body.nodes[i].inputs)
      for (const Wire &wire : pin.wires)
        readers_[portOf(wire)].push_back(i);
}

const std::vector<NodeIndex> &Values::readingNodes(Wire from) const {
  static const std::vector<NodeIndex> none;
  const auto found = readers_.find(portOf(from));
  return found == readers_.end() ? none : found->second;
}

size_t Values::readers(Wire from) const { return readingNodes(from).size(); }

std::string Values::typeOf(Wire from) const {
  std::string type = typeOfOutput(body_, from, scope_, false);
  for (const NodeIndex reader : readingNodes(from))
    if (type.empty())
      type = expectedBy(body_.nodes[reader], from);
  return type.empty() ? typeOfOutput(body_, from, scope_, true) : type;
}

/// Type of the variable or of the block's pin that an output is wired to.
std::string Values::expectedBy(const Node &reader, Wire from) const {
  if (reader.kind == NodeKind::Output)
    return scope_.typeOf(reader.text);
  const Interface *declared =
      reader.kind == NodeKind::Call ? scope_.interfaceOf(reader.type) : nullptr;
  if (declared == nullptr)
    return {};
  for (const InPin &pin : reader.inputs)
    for (const Wire &wire : pin.wires)
      for (const Declared &each : declared->inputs)
        if (portOf(wire) == portOf(from) && upperCase(each.name) == upperCase(pin.name))
          return each.type;
  return {};
}

std::optional<Expression> Values::read(const InPin &pin, size_t line) {
  if (pin.wires.empty())
    return std::nullopt;
  std::vector<Expression> values;
  for (const Wire &wire : pin.wires)
    values.push_back(wireValue(wire));
  Expression value =
      values.size() == 1 ? std::move(values.front()) : disjunction(std::move(values));
  if (pin.negated)
    value = negation(std::move(value));
  return pin.edge == Edge::None ? value : edgeOf(pin.edge, value, line);
}

Expression Values::wireValue(Wire wire) {
  const Node &node = body_.nodes[wire.node];
  switch (node.kind) {
  case NodeKind::Input: {
    Expression text = textOf(node.text);
    return node.negated ? negation(std::move(text)) : text;
  }
  case NodeKind::InOut:
    return textOf(node.text);
  case NodeKind::Rail:
    return truth();
  default:
    break;
  }
  if (values_.contains(portOf(wire)))
    return take(wire);
  const bool output = node.kind == NodeKind::Call && wire.pin < node.outputs.size() &&
                      !node.outputs[wire.pin].enable;
  if (!output)
    return textOf(keptName(wire));
  // Not called yet in this cycle: its output is that of the last one.
  Expression value = textOf(node.text + "." + node.outputs[wire.pin].name);
  return node.outputs[wire.pin].negated ? negation(std::move(value)) : value;
}

Expression Values::edgeOf(Edge edge, const Expression &value, size_t line) {
  if (scope_.inFunction())
    result_.problems.push_back({line, "a function cannot detect edges: it has no memory"});
  const std::string text = printed(value);
  const std::string name =
      scope_.freshName(subjectOf(text) + (edge == Edge::Rising ? "_rising" : "_falling"));
  writer_.declare(name, edge == Edge::Rising ? "R_TRIG" : "F_TRIG");
  writer_.line(fmt::format("{}(CLK := {});", name, text));
  return textOf(name + ".Q");
}

Expression Values::take(Wire from) {
  const auto found = values_.find(portOf(from));
  if (found->second.uses > 1) {
    --found->second.uses;
    return found->second.expression;
  }
  Expression last = std::move(found->second.expression);
  values_.erase(found);
  return last;
}

std::string Values::wishFor(Wire from) const {
  const Node &node = body_.nodes[from.node];
  if (node.kind != NodeKind::Value && node.kind != NodeKind::Call)
    return "rung";
  std::string wish = stride::common::lowerCase(node.text);
  const bool eno = from.pin < node.outputs.size() && node.outputs[from.pin].enable;
  if (node.kind == NodeKind::Call && !eno && from.pin < node.outputs.size())
    return node.text + "_" + node.outputs[from.pin].name;
  return node.boolean ? "rung" : wish + (eno ? "_eno" : "_out");
}

std::string Values::keptName(Wire from) {
  const auto found = kept_.find(portOf(from));
  if (found != kept_.end())
    return found->second;
  const Node &node = body_.nodes[from.node];
  const std::string type = typeOf(from);
  const std::string name = scope_.freshName(wishFor(from));
  if (scope_.inFunction())
    result_.problems.push_back(
        {node.line, "a value of the last cycle is needed here, and a function has no memory"});
  if (type.empty())
    result_.problems.push_back(
        {node.line, fmt::format("the type of what `{}` gives is not known", node.text)});
  writer_.declare(name, type);
  return kept_[portOf(from)] = name;
}

Expression Values::stored(std::string_view wish, const Expression &value, const std::string &type) {
  const std::string name = scope_.freshName(wish);
  writer_.declare(name, type);
  writer_.line(fmt::format("{} := {};", name, printed(value)));
  return textOf(name);
}

bool Values::reachesOneStatement(Wire from) const {
  std::set<NodeIndex> statements;
  std::set<NodeIndex> seen;
  std::vector<Wire> open = {from};
  while (!open.empty()) {
    const Wire wire = open.back();
    open.pop_back();
    for (const NodeIndex reader : readingNodes(wire)) {
      if (!passesOn(body_.nodes[reader]) || kept_.contains({reader, 0}))
        statements.insert(reader);
      else if (seen.insert(reader).second)
        open.push_back({reader, 0});
    }
    if (statements.size() > 1 || seen.size() > kNodesLookedAt)
      return false;
  }
  return true;
}

bool Values::mustBeStored(Wire from, const Expression &value, size_t uses) const {
  const size_t leaves = leavesOf(value);
  const size_t depth = depthOf(value);
  if (leaves > kLeaves || depth > kReadableDepth)
    return leaves > kLeavesAtMost || depth > kDepthAtMost || !typeOf(from).empty();
  if (uses < 2 || isLeaf(value))
    return false;
  if (callsIn(value))
    return true;
  return leaves * uses > kLeavesRepeated || !reachesOneStatement(from);
}

void Values::set(Wire from, Expression value, size_t further) {
  const Node &node = body_.nodes[from.node];
  if (node.kind == NodeKind::Value && from.pin < node.outputs.size() &&
      node.outputs[from.pin].negated)
    value = negation(std::move(value));
  const size_t uses = readers(from) + further;
  const auto kept = kept_.find(portOf(from));
  if (kept != kept_.end()) {
    beforeWriting({stride::common::lowerCase(kept->second)});
    writer_.line(fmt::format("{} := {};", kept->second, printed(value)));
    values_[portOf(from)] = {textOf(kept->second), uses, true};
    return;
  }
  if (uses == 0)
    return;
  const bool store = mustBeStored(from, value, uses);
  const auto place =
      values_.insert_or_assign(portOf(from), Value{std::move(value), uses, false}).first;
  if (store)
    this->store(place->first, place->second);
}

void Values::setKept(Wire from) {
  values_[portOf(from)] = {textOf(keptName(from)), readers(from), true};
}

void Values::setVariable(Wire from, const Expression &value, const std::string &type) {
  if (type.empty())
    result_.problems.push_back(
        {body_.nodes[from.node].line,
         fmt::format("the type of what `{}` gives is not known", body_.nodes[from.node].text)});
  values_[portOf(from)] = {stored(wishFor(from), value, type), readers(from), true};
}

/// Assigns the value to a variable of its own.
bool Values::store(Port port, Value &value) {
  const std::string type = typeOf({port.first, port.second});
  if (type.empty()) {
    const Node &node = body_.nodes[port.first];
    result_.problems.push_back(
        {node.line, fmt::format("the type of what `{}` gives is not known, and its value is needed "
                                "in several places; import its declaration, too",
                                node.text)});
    value.expression = textOf("unknown"); // nothing is printed any more: it must not grow
    return false;
  }
  value.expression = stored(wishFor({port.first, port.second}), value.expression, type);
  value.stored = true;
  return true;
}

void Values::beforeWriting(const std::set<std::string> &written) {
  for (auto &[port, value] : values_) {
    const std::set<std::string> reads = readsOf(value.expression);
    if (std::ranges::any_of(reads, [&](const std::string &each) { return written.contains(each); }))
      store(port, value);
  }
}

void Values::storeAll() {
  for (auto &[port, value] : values_)
    if (body_.nodes[port.first].kind != NodeKind::Call && !isTruth(value.expression) &&
        !value.stored)
      store(port, value);
}

} // namespace stc::import::networks
