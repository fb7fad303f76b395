#include "compiler/import/networks/print.hpp"

#include "compiler/import/networks/expression.hpp"
#include "compiler/import/networks/order.hpp"
#include "compiler/import/networks/printer.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace stc::import::networks {

using stride::common::upperCase;

namespace {

using stride::common::lowerCase;

/// The root of what is assigned: `a.b[i]` changes a.
std::set<std::string> rootOf(std::string_view variable) {
  const std::vector<Word> words = wordsOf(variable);
  return words.empty() ? std::set<std::string>() : std::set{lowerCase(words.front().text)};
}

class Translator {
public:
  Translator(Body body, Scope &scope)
      : body_(std::move(body)), scope_(scope), values_(body_, scope_, writer_, result_) {}

  Translation run(const std::vector<std::vector<NodeIndex>> &schedule) {
    for (size_t i = 0; i < schedule.size(); ++i) {
      const Network &network = body_.networks[i];
      writer_.gap();
      comment(network.title);
      comment(network.comment);
      if (!network.label.empty())
        label(network.label, network.line);
      for (size_t step = 0; step < schedule[i].size(); ++step) {
        next_ = step + 1 < schedule[i].size() ? schedule[i][step + 1] : body_.nodes.size();
        if (!done_.contains(schedule[i][step]))
          execute(schedule[i][step]);
      }
    }
    result_.declarations = writer_.declarations();
    result_.statements = writer_.statements();
    if (!result_.ok())
      result_.declarations = result_.statements = {};
    return std::move(result_);
  }

private:
  void problem(const Node &node, std::string text) {
    result_.problems.push_back({node.line, std::move(text)});
  }
  void note(const Node &node, std::string text) {
    result_.notes.push_back({node.line, std::move(text)});
  }

  void comment(std::string_view text) {
    while (!text.empty()) {
      const size_t end = std::min(text.find('\n'), text.size());
      std::string_view line = trim(text.substr(0, end));
      if (line.starts_with("//"))
        line = trim(line.substr(2));
      if (!line.empty())
        writer_.line(fmt::format("// {}", line));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  void label(const std::string &name, size_t line) {
    values_.storeAll();
    if (!isIdentifier(name))
      result_.problems.push_back({line, fmt::format("`{}` cannot be a label", name)});
    writer_.line(name + ":");
  }

  void execute(NodeIndex index) {
    const Node &node = body_.nodes[index];
    switch (node.kind) {
    case NodeKind::Contact:
      return contact(index, node);
    case NodeKind::Coil:
    case NodeKind::Output:
    case NodeKind::InOut:
      return output(index, node);
    case NodeKind::Value:
      return value(index, node);
    case NodeKind::Call:
      return call(index, node);
    case NodeKind::Code:
      return code(index, node);
    case NodeKind::Jump:
    case NodeKind::Return:
      return jump(node);
    case NodeKind::Label:
      return label(node.text, node.line);
    case NodeKind::Comment:
      return comment(node.text);
    case NodeKind::Input:
    case NodeKind::Rail:
    case NodeKind::Link:
      return;
    }
  }

  void contact(NodeIndex index, const Node &node) {
    std::optional<Expression> left =
        node.inputs.empty() ? std::nullopt : values_.read(node.inputs.front(), node.line);
    if (!left)
      return problem(node,
                     fmt::format("contact `{}` is connected to nothing on its left", node.text));
    Expression variable = textOf(node.text);
    if (node.edge != Edge::None)
      variable = values_.edgeOf(node.edge, variable, node.line);
    if (node.negated)
      variable = negation(std::move(variable));
    std::vector<Expression> both;
    both.push_back(std::move(*left));
    both.push_back(std::move(variable));
    values_.set({index, 0}, conjunction(std::move(both)));
  }

  /// `target := value`, or S= and R=.
  void assign(const std::string &target, const Expression &value, Storage storage) {
    const std::string_view symbol = storage == Storage::Set     ? "S="
                                    : storage == Storage::Reset ? "R="
                                                                : ":=";
    writer_.line(fmt::format("{} {} {};", target, symbol, printed(value)));
  }

  void output(NodeIndex index, const Node &node) {
    std::optional<Expression> read =
        node.inputs.empty() ? std::nullopt : values_.read(node.inputs.front(), node.line);
    if (!read)
      return note(node, fmt::format("`{}` is connected to nothing: dropped", node.text));
    Expression value = std::move(*read);
    if (node.kind == NodeKind::Coil && values_.readers({index, 0}) > 0) {
      if (leavesOf(value) > 1)
        value = values_.stored("rung", value, "BOOL");
      values_.set({index, 0}, value);
    }
    if (node.edge != Edge::None)
      value = values_.edgeOf(node.edge, value, node.line);
    if (node.negated)
      value = negation(std::move(value));
    values_.beforeWriting(rootOf(node.text));
    assign(node.text, value, node.storage);
  }

  /// The condition at EN; TRUE where there is none. What reads ENO gets it.
  Expression enabled(NodeIndex index, const Node &node) {
    Expression condition = truth();
    for (const InPin &pin : node.inputs)
      if (pin.enable)
        condition = values_.read(pin, node.line).value_or(truth());
    size_t readers = 0;
    for (size_t i = 0; i < node.outputs.size(); ++i)
      if (node.outputs[i].enable)
        readers += values_.readers({index, i}) + (node.outputs[i].target.empty() ? 0 : 1);
    if (readers > 0 && leavesOf(condition) > 1)
      condition = values_.stored("rung", condition, "BOOL");
    for (size_t i = 0; i < node.outputs.size(); ++i)
      if (node.outputs[i].enable) {
        values_.set({index, i}, condition);
        // Values keep what a write would change; the condition itself must be kept with them.
        if (!node.outputs[i].target.empty()) {
          values_.beforeWriting(rootOf(node.outputs[i].target));
          assign(node.outputs[i].target, condition, node.outputs[i].storage);
        }
      }
    return condition;
  }

  [[nodiscard]] static size_t resultPin(const Node &node) {
    for (size_t i = 0; i < node.outputs.size(); ++i)
      if (!node.outputs[i].enable)
        return i;
    return node.outputs.size();
  }

  /// The operator or the call with its operands.
  std::optional<Expression> operationOf(NodeIndex index, const Node &node) {
    std::vector<Expression> operands;
    std::vector<std::string> names;
    bool missing = false;
    const Interface *function = scope_.interfaceOf(node.text);
    size_t at = 0;
    for (const InPin &pin : node.inputs) {
      if (pin.enable)
        continue;
      const size_t position = at++;
      std::optional<Expression> operand = values_.read(pin, node.line);
      if (!operand) {
        missing = true;
        continue;
      }
      operands.push_back(std::move(*operand));
      names.push_back(!pin.name.empty() ? pin.name
                      : function != nullptr && position < function->inputs.size()
                          ? function->inputs[position].name
                          : std::string());
    }
    const std::vector<std::string> outputs = furtherOutputs(index, node);
    const bool named = missing || !outputs.empty();
    if (missing && (function == nullptr || isInfix(node.text))) {
      problem(node, fmt::format("an input of `{}` is not connected", node.text));
      return std::nullopt;
    }
    if (named && std::ranges::find(names, std::string()) != names.end()) {
      problem(node, fmt::format("the inputs of `{}` are not known by name", node.text));
      return std::nullopt;
    }
    if (!named && isComparison(node.text) && operands.size() > 2)
      return chained(node, operands);
    Expression result = operands.empty() && isInfix(node.text)
                            ? truth()
                            : operation(node.text, std::move(operands));
    if (named && result.kind == Expression::Kind::Call) {
      result.names = std::move(names);
      result.outputs = outputs;
    }
    return result;
  }

  /// `GT(a, b, c)` is `a > b AND b > c`.
  std::optional<Expression> chained(const Node &node, const std::vector<Expression> &operands) {
    std::vector<Expression> pairs;
    for (size_t i = 0; i + 1 < operands.size(); ++i) {
      if (callsIn(operands[i]))
        problem(node,
                fmt::format("`{}` compares more than two values, one of them a call", node.text));
      pairs.push_back(operation(node.text, {operands[i], operands[i + 1]}));
    }
    return conjunction(std::move(pairs));
  }

  /// Outputs of a function beside its result: `name => variable`.
  std::vector<std::string> furtherOutputs(NodeIndex index, const Node &node) {
    std::vector<std::string> result;
    for (size_t i = resultPin(node) + 1; i < node.outputs.size(); ++i) {
      const OutPin &pin = node.outputs[i];
      const Wire wire{index, i};
      if (pin.enable || (pin.target.empty() && values_.readers(wire) == 0))
        continue;
      if (pin.name.empty() || pin.negated || pin.storage != Storage::None) {
        problem(node, fmt::format("output {} of the function `{}` cannot be translated", i + 1,
                                  node.text));
        continue;
      }
      result.push_back(fmt::format("{} => {}", pin.name,
                                   pin.target.empty() ? values_.keptName(wire) : pin.target));
    }
    return result;
  }

  /// Whether an output is read by nothing but variables that are assigned next.
  [[nodiscard]] bool onlyAssigned(Wire from) const {
    return std::ranges::all_of(values_.readingNodes(from), [&](NodeIndex reader) {
      const Node &node = body_.nodes[reader];
      return node.kind == NodeKind::Output && node.inputs.front().wires.size() == 1 &&
             node.inputs.front().edge == Edge::None && node.edge == Edge::None &&
             (body_.sequence != Sequence::Explicit || reader == next_);
    });
  }

  void value(NodeIndex index, const Node &node) {
    const size_t pin = resultPin(node);
    const Wire wire{index, pin};
    const bool target = pin < node.outputs.size() && !node.outputs[pin].target.empty();
    const size_t readers = values_.readers(wire);
    const Expression condition = enabled(index, node);
    std::optional<Expression> result = operationOf(index, node);
    if (!result)
      return;
    if (!isTruth(condition))
      return conditional(index, node, condition, *result);
    if (readers == 0 && !target) {
      if (result->kind == Expression::Kind::Call)
        writer_.line(printed(*result) + ";");
      else
        note(node, fmt::format("nothing uses what `{}` gives: dropped", node.text));
      return;
    }
    if (!result->outputs.empty())
      values_.setVariable(wire, *result, values_.typeOf(wire));
    else
      values_.set(wire, std::move(*result), target ? 1 : 0);
    if (target)
      assignTarget(node.outputs[pin], values_.take(wire));
  }

  void assignTarget(const OutPin &pin, const Expression &value) {
    values_.beforeWriting(rootOf(pin.target));
    assign(pin.target, value, pin.storage);
  }

  /// An operator or a function with EN.
  void conditional(NodeIndex index, const Node &node, const Expression &condition,
                   Expression result) {
    const Wire wire{index, resultPin(node)};
    const bool target = wire.pin < node.outputs.size() && !node.outputs[wire.pin].target.empty();
    const std::vector<NodeIndex> readers = values_.readingNodes(wire);
    const bool negated = wire.pin < node.outputs.size() && node.outputs[wire.pin].negated;
    if (negated)
      result = negation(std::move(result));
    std::set<std::string> written;
    if (target)
      written = rootOf(node.outputs[wire.pin].target);
    const bool assigned = onlyAssigned(wire) && readers.size() + (target ? 1 : 0) <= 1;
    for (const NodeIndex reader : readers)
      written.merge(rootOf(body_.nodes[reader].text));
    if (!assigned && !target && values_.typeOf(wire) == "BOOL") {
      std::vector<Expression> both = {condition, negated ? negation(result) : result};
      values_.set(wire, conjunction(std::move(both)));
      return note(node, fmt::format("`{}` gives FALSE while its EN is FALSE", node.text));
    }
    values_.beforeWriting(written);
    const std::string kept = assigned ? std::string() : values_.keptName(wire);
    writer_.open(condition);
    if (!kept.empty()) {
      writer_.line(fmt::format("{} := {};", kept, printed(result)));
      result = textOf(kept);
    }
    if (target)
      assign(node.outputs[wire.pin].target, result, node.outputs[wire.pin].storage);
    if (kept.empty() && !target && readers.empty())
      writer_.line(printed(result) + ";");
    if (kept.empty())
      for (const NodeIndex reader : readers) {
        const Node &output = body_.nodes[reader];
        const bool inverted = output.negated != output.inputs.front().negated;
        assign(output.text, inverted ? negation(result) : result, output.storage);
        done_.insert(reader);
      }
    writer_.close(condition);
    if (!kept.empty())
      values_.setKept(wire);
  }

  /// Arguments of a call; what it writes is added to `written`.
  std::vector<std::string> argumentsOf(const Node &node, std::set<std::string> &written) {
    std::vector<std::string> arguments;
    bool missing = false;
    for (const InPin &pin : node.inputs) {
      if (pin.enable)
        continue;
      const std::optional<Expression> value = values_.read(pin, node.line);
      if (!value) {
        missing = true;
        continue;
      }
      if (pin.inOut && !isVariable(printed(*value)))
        problem(node, fmt::format("`{}` of `{}` needs a variable, not `{}`", pin.name, node.text,
                                  printed(*value)));
      if (pin.inOut)
        written.merge(rootOf(printed(*value)));
      if (pin.name.empty() && missing)
        problem(node, fmt::format("the inputs of `{}` are not known by name, and one of them is "
                                  "not connected; import its declaration, too",
                                  node.type));
      arguments.push_back((pin.name.empty() ? std::string() : pin.name + " := ") + printed(*value));
    }
    for (const OutPin &pin : node.outputs)
      if (!pin.target.empty()) {
        written.merge(rootOf(pin.target));
        if (!pin.enable && !pin.name.empty() && !pin.negated && pin.storage == Storage::None)
          arguments.push_back(pin.name + " => " + pin.target);
      }
    return arguments;
  }

  void call(NodeIndex index, const Node &node) {
    std::set<std::string> written = rootOf(node.text);
    const Expression condition = enabled(index, node);
    const std::vector<std::string> arguments = argumentsOf(node, written);
    values_.beforeWriting(written);
    writer_.open(condition);
    writer_.line(fmt::format("{}({});", node.text, fmt::join(arguments, ", ")));
    for (size_t i = 0; i < node.outputs.size(); ++i) {
      const OutPin &pin = node.outputs[i];
      if (pin.enable)
        continue;
      if (pin.name.empty() && (!pin.target.empty() || values_.readers({index, i}) > 0)) {
        problem(node, fmt::format("the outputs of `{}` are not known by name; import its "
                                  "declaration, too",
                                  node.type.empty() ? node.text : node.type));
        continue;
      }
      Expression value = textOf(node.text + "." + pin.name);
      if (pin.negated)
        value = negation(std::move(value));
      if (!pin.target.empty() && (pin.negated || pin.storage != Storage::None))
        assign(pin.target, value, pin.storage);
    }
    writer_.close(condition);
    for (size_t i = 0; i < node.outputs.size(); ++i)
      if (!node.outputs[i].enable && values_.readers({index, i}) > 0) {
        Expression value = textOf(node.text + "." + node.outputs[i].name);
        values_.set({index, i},
                    node.outputs[i].negated ? negation(std::move(value)) : std::move(value));
      }
  }

  void code(NodeIndex index, const Node &node) {
    const Expression condition = enabled(index, node);
    values_.beforeWriting(rootsOf(node.text));
    writer_.open(condition);
    std::string_view rest = trim(node.text);
    while (!rest.empty()) {
      const size_t end = std::min(rest.find('\n'), rest.size());
      std::string_view line = rest.substr(0, end);
      while (!line.empty() && (line.back() == '\r' || line.back() == ' '))
        line.remove_suffix(1);
      writer_.line(line);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    writer_.close(condition);
  }

  void jump(const Node &node) {
    const Expression condition =
        node.inputs.empty() ? truth()
                            : values_.read(node.inputs.front(), node.line).value_or(truth());
    const Expression taken = node.negated ? negation(condition) : condition;
    if (node.kind == NodeKind::Jump && !isIdentifier(node.text))
      problem(node, fmt::format("`{}` cannot be a label", node.text));
    values_.storeAll();
    writer_.open(taken);
    writer_.line(node.kind == NodeKind::Return ? "RETURN;" : fmt::format("JMP {};", node.text));
    writer_.close(taken);
  }

  Body body_;
  Scope &scope_;
  Writer writer_;
  Translation result_;
  Values values_;
  std::set<NodeIndex> done_;
  NodeIndex next_ = 0; ///< what is executed after the node at hand
};

/// Whether a block has a pin of that name of its own.
bool declares(const Interface &declared, const std::vector<Declared> &pins, std::string_view name) {
  return declared.kind == Interface::Kind::FunctionBlock &&
         std::ranges::any_of(pins, [&](const Declared &d) { return upperCase(d.name) == name; });
}

/// What a file does not say, the declarations may: that a box is a program, that a block has an
/// input EN like any other.
void adopt(Body &body, const Scope &scope) {
  for (Node &node : body.nodes) {
    const Interface *declared = scope.interfaceOf(node.type.empty() ? node.text : node.type);
    if (declared == nullptr || (node.kind != NodeKind::Value && node.kind != NodeKind::Call))
      continue;
    if (declared->kind == Interface::Kind::Program && node.type.empty())
      node.kind = NodeKind::Call;
    if (node.kind != NodeKind::Call)
      continue;
    for (InPin &pin : node.inputs)
      pin.enable = pin.enable && (pin.name.empty() || !declares(*declared, declared->inputs, "EN"));
    for (OutPin &pin : node.outputs)
      pin.enable =
          pin.enable && (pin.name.empty() || !declares(*declared, declared->outputs, "ENO"));
  }
}

} // namespace

Translation translated(Body body, Scope &scope) {
  Translation result;
  adopt(body, scope);
  resolveLinks(body, result.problems);
  if (!result.ok())
    return result;
  const std::vector<std::vector<NodeIndex>> schedule = scheduleOf(body);
  return Translator(std::move(body), scope).run(schedule);
}

} // namespace stc::import::networks
