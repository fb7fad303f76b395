#include "compiler/import/networks/exp_networks.hpp"

#include "compiler/import/networks/exp_pins.hpp"
#include "compiler/import/networks/print.hpp"
#include "compiler/import/networks/text.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace stc::import::networks {

namespace {

constexpr std::array<std::string_view, 3> kBodies = {"_LD_BODY", "_FBD_BODY", "_CFC_BODY"};
constexpr size_t kTreeDepth = 200;  // of trees
constexpr size_t kOperands = 10000; // of one box

/// Thrown inside this file at the first line that cannot be understood.
struct Refusal {
  size_t line;
  std::string text;
};

/// Reads the trees of networks. A line is a word, a word with a number, or an operand's text.
class NetworkReader {
public:
  NetworkReader(const std::vector<NumberedLine> &lines, const Scope &scope)
      : lines_(lines), scope_(scope) {}

  Body read() {
    ++at_; // _LD_BODY or _FBD_BODY
    (void)count("_NETWORKS");
    while (!atEnd())
      readNetwork();
    return std::move(body_);
  }

private:
  [[noreturn]] void refuse(std::string text) {
    const size_t place = std::min(at_, lines_.size() - 1);
    throw Refusal{lines_[place].line, std::move(text)};
  }

  void skipBlank() {
    while (at_ < lines_.size() && trim(lines_[at_].text).empty())
      ++at_;
  }
  [[nodiscard]] bool atEnd() {
    skipBlank();
    return at_ >= lines_.size();
  }
  [[nodiscard]] std::string_view peek() {
    if (atEnd())
      refuse("the body ends in the middle of a network");
    return trim(lines_[at_].text);
  }
  [[nodiscard]] size_t line() { return atEnd() ? 0 : lines_[at_].line; }

  /// Whether the next line is a word of the format, as such or before a number.
  [[nodiscard]] bool next(std::string_view word) {
    if (atEnd())
      return false;
    std::string_view text = peek();
    text = trim(text.substr(0, std::min(text.find(':'), text.size())));
    return text == word;
  }
  bool accept(std::string_view word) {
    if (!next(word))
      return false;
    ++at_;
    return true;
  }
  void expect(std::string_view word) {
    if (!accept(word))
      refuse(fmt::format("`{}` where `{}` is expected", peek(), word));
  }

  /// `_OUTPUTS : 2`
  size_t count(std::string_view word) {
    if (!next(word))
      refuse(fmt::format("`{}` where `{}` is expected", peek(), word));
    std::string_view text = peek();
    const size_t colon = text.find(':');
    text = trim(text.substr(std::min(colon, text.size() - 1) + 1));
    if (text.ends_with(';'))
      text = trim(text.substr(0, text.size() - 1));
    const std::optional<long> number = numberIn(text);
    if (!number || *number < 0 || static_cast<size_t>(*number) > kOperands)
      refuse(fmt::format("`{}`: no number of something", peek()));
    ++at_;
    return static_cast<size_t>(*number);
  }

  std::string operand() {
    const std::string text(peek());
    if (text.front() == '_' && text.find_first_of(".[(") == std::string::npos &&
        std::ranges::find(kWords, text) != kWords.end())
      refuse(fmt::format("`{}` where an operand is expected", text));
    ++at_;
    return text;
  }

  /// _POSITIV or _NEGATIV: whether it negates.
  bool sign() {
    if (accept("_POSITIV"))
      return false;
    expect("_NEGATIV");
    return true;
  }
  bool expressionSign() {
    expect("_EXPRESSION");
    return sign();
  }

  void readNetwork() {
    rung_.reset();
    body_.networks.emplace_back();
    network_ = &body_.networks.back();
    network_->line = line();
    expect("_NETWORK");
    if (!atEnd() && isIdentifier(peek()) && peek().front() != '_') {
      network_->label = peek();
      ++at_;
    }
    if (accept("_COMMENT"))
      readComment();
    while (!atEnd() && !next("_NETWORK"))
      readStatement();
  }

  void readComment() {
    std::string text;
    for (; at_ < lines_.size() && trim(lines_[at_].text) != "_END_COMMENT"; ++at_)
      text += lines_[at_].text + "\n";
    expect("_END_COMMENT");
    std::string_view inside = trim(text);
    if (inside.starts_with('\''))
      inside.remove_prefix(1);
    if (inside.ends_with('\''))
      inside.remove_suffix(1);
    network_->comment = inside;
  }

  void readStatement() {
    if (accept("_ASSIGN")) {
      const Wire value = readOnce(readExpression(0, {}), false);
      const bool negated = expressionSign();
      readOutputs(value, negated);
    } else if (accept("_LD_ASSIGN")) {
      readRung();
    } else if (next("_FUNCTION") || next("_FUNCTIONBLOCK") || next("_OPERATOR")) {
      (void)readExpression(0, {});
    } else {
      refuse(fmt::format("`{}`: no published export shows what it means; change the body to ST or "
                         "IL there and export it again",
                         peek()));
    }
  }

  NodeIndex add(NodeKind kind, std::string text) {
    Node node;
    node.kind = kind;
    node.text = std::move(text);
    node.line = at_ == 0 ? lines_.front().line : lines_[std::min(at_, lines_.size()) - 1].line;
    body_.nodes.push_back(std::move(node));
    network_->nodes.push_back(body_.nodes.size() - 1);
    return body_.nodes.size() - 1;
  }

  InPin pinOf(const Wire &wire, bool negated = false) const {
    InPin pin;
    pin.wires = {wire};
    pin.negated = negated;
    return pin;
  }

  void readRung() {
    if (rung_)
      refuse("a rung inside the ENABLELIST of another one");
    Wire rung = readOnce(readExpression(0, {.boolean = true}), true);
    const bool negated = expressionSign();
    if (negated) { // so that coils and boxes with EN read the same value
      const NodeIndex inverse = add(NodeKind::Value, "NOT");
      body_.nodes[inverse].boolean = true;
      body_.nodes[inverse].inputs = {pinOf(rung)};
      body_.nodes[inverse].outputs.resize(1);
      rung = {inverse, 0};
    }
    rung_ = rung;
    const size_t boxes = count("ENABLELIST");
    for (size_t i = 0; i < boxes; ++i)
      readStatement();
    expect("ENABLELIST_END");
    rung_.reset();
    readOutputs(rung, false);
  }

  /// Several outputs and boxes read an operand's value as it was when the network began.
  Wire readOnce(const Wire &value, bool boolean) {
    if (body_.nodes[value.node].kind != NodeKind::Input)
      return value;
    const NodeIndex index = add(NodeKind::Value, "MOVE");
    body_.nodes[index].boolean = boolean;
    body_.nodes[index].inputs = {pinOf(value)};
    body_.nodes[index].outputs.resize(1);
    return {index, 0};
  }

  struct Store {
    bool negated = false;
    Storage storage = Storage::None;
    std::string variable;
  };

  Store readOutput() {
    expect("_OUTPUT");
    Store store;
    store.negated = sign();
    if (accept("_SET"))
      store.storage = store.negated ? Storage::Reset : Storage::Set;
    else if (accept("_RESET"))
      store.storage = Storage::Reset;
    else
      expect("_NO_SET");
    if (store.storage != Storage::None)
      store.negated = false; // the sign tells set from reset
    if (!accept("_EMPTY"))
      store.variable = operand();
    return store;
  }

  void readOutputs(const Wire &value, bool negated) {
    const size_t outputs = count("_OUTPUTS");
    for (size_t i = 0; i < outputs; ++i) {
      const Store store = readOutput();
      if (isBlankOperand(store.variable))
        continue;
      const NodeIndex index = add(NodeKind::Output, store.variable);
      Node &node = body_.nodes[index];
      node.storage = store.storage;
      node.negated = store.negated;
      node.inputs = {pinOf(value, negated)};
    }
  }

  /// What the parent has said about the operand that follows.
  struct Place {
    bool boolean = false; ///< it is part of a rung
  };

  Wire readExpression(size_t depth, Place place) {
    if (depth == kTreeDepth)
      refuse("the network is nested too deep");
    if (accept("_OPERAND")) {
      const bool negated = expressionSign();
      return leaf(operand(), negated);
    }
    if (accept("_LD_CONTACT")) {
      std::string variable = operand();
      const bool negated = expressionSign();
      return leaf(std::move(variable), negated);
    }
    if (accept("_EMPTY"))
      return {add(NodeKind::Rail, ""), 0};
    if (next("_LD_AND") || next("_LD_OR"))
      return readLadder(depth);
    if (accept("_OPERATOR"))
      return readBox(depth, NodeKind::Value, {}, place);
    if (accept("_FUNCTION"))
      return readBox(depth, NodeKind::Value, {}, place);
    if (accept("_FUNCTIONBLOCK")) {
      std::string instance = operand();
      return readBox(depth, NodeKind::Call, std::move(instance), place);
    }
    refuse(fmt::format("`{}`: no published export shows what it means here; change the body to ST "
                       "or IL and export it again",
                       peek()));
  }

  Wire leaf(std::string text, bool negated) {
    const NodeIndex index = add(NodeKind::Input, std::move(text));
    body_.nodes[index].negated = negated;
    return {index, 0};
  }

  Wire readLadder(size_t depth) {
    const std::string_view name = next("_LD_AND") ? "AND" : "OR";
    ++at_;
    const size_t operands = count("_LD_OPERATOR");
    std::vector<InPin> pins;
    for (size_t i = 0; i < operands; ++i)
      pins.push_back(pinOf(readExpression(depth + 1, {.boolean = true})));
    const bool negated = expressionSign();
    const NodeIndex index = add(NodeKind::Value, std::string(name));
    Node &node = body_.nodes[index];
    node.boolean = true;
    node.inputs = std::move(pins);
    node.outputs.resize(1);
    node.outputs.front().negated = negated;
    return {index, 0};
  }

  /// Operands, sign and name of a box; for a block also its outputs from the second one on.
  Wire readBox(size_t depth, NodeKind kind, std::string instance, Place place) {
    const size_t operands = count("_BOX_EXPR");
    std::vector<InPin> pins;
    if (accept("_ENABLED")) {
      if (!rung_)
        refuse("`_ENABLED` outside the ENABLELIST of a rung");
      pins.push_back(pinOf(*rung_));
      pins.back().enable = true;
    }
    for (size_t i = 0; i < operands; ++i)
      pins.push_back(pinOf(readExpression(depth + 1, {})));
    const bool negated = expressionSign();
    std::string name = operand();
    const NodeIndex index =
        add(kind, kind == NodeKind::Call ? std::move(instance) : std::string(name));
    Node &node = body_.nodes[index];
    for (InPin &pin : pins)
      if (body_.nodes[pin.wires.front().node].kind == NodeKind::Input &&
          isBlankOperand(body_.nodes[pin.wires.front().node].text))
        pin.wires.clear();
    node.inputs = std::move(pins);
    node.outputs.resize(1);
    node.outputs.front().negated = negated;
    node.boolean = place.boolean && kind == NodeKind::Value;
    if (kind == NodeKind::Call)
      finishCall(index, std::move(name));
    return {index, 0};
  }

  void finishCall(NodeIndex index, std::string type) {
    const size_t outputs = count("_OUTPUTS");
    Node &node = body_.nodes[index];
    node.type = std::move(type);
    for (size_t i = 0; i < outputs; ++i) {
      const Store store = readOutput();
      OutPin pin;
      pin.negated = store.negated;
      pin.storage = store.storage;
      pin.target = isBlankOperand(store.variable) ? std::string() : store.variable;
      node.outputs.push_back(std::move(pin));
    }
    const Interface *declared = scope_.interfaceOf(node.type);
    // The first output is where the network goes on; a block may have none.
    if (declared != nullptr && declared->outputs.empty() && outputs == 0)
      node.outputs.clear();
    if (!namePins(node, declared))
      refuse(fmt::format("`{}` has more pins than its declaration", node.type));
  }

  static constexpr std::array<std::string_view, 22> kWords = {
      "_NETWORK",    "_COMMENT",  "_END_COMMENT", "_ASSIGN",     "_LD_ASSIGN",     "_OPERAND",
      "_OPERATOR",   "_FUNCTION", "_BOX_EXPR",    "_EXPRESSION", "_FUNCTIONBLOCK", "_POSITIV",
      "_NEGATIV",    "_OUTPUT",   "_OUTPUTS",     "_NO_SET",     "_SET",           "_RESET",
      "_LD_CONTACT", "_LD_AND",   "_LD_OR",       "_ENABLED"};

  const std::vector<NumberedLine> &lines_;
  const Scope &scope_;
  Body body_;
  Network *network_ = nullptr;
  std::optional<Wire> rung_; ///< whose ENABLELIST is being read
  size_t at_ = 0;
};

} // namespace

bool isTranslatedBody(std::string_view line) {
  return std::ranges::find(kBodies, trim(line)) != kBodies.end();
}

Body readExpNetworks(const std::vector<NumberedLine> &lines, const Scope &scope,
                     std::vector<Problem> &problems) {
  try {
    return NetworkReader(lines, scope).read();
  } catch (const Refusal &refusal) {
    problems.push_back({refusal.line, refusal.text});
    return {};
  }
}

Translation translatedExpBody(const std::vector<NumberedLine> &lines, Scope &scope) {
  Translation result;
  const bool chart = !lines.empty() && trim(lines.front().text) == "_CFC_BODY";
  if (lines.empty() || !isTranslatedBody(lines.front().text)) {
    result.problems.push_back(
        {lines.empty() ? 0 : lines.front().line,
         "no published export shows a body of this kind; change it to ST or IL "
         "there and export it again"});
    return result;
  }
  Body body = chart ? readExpChart(lines, scope, result.problems)
                    : readExpNetworks(lines, scope, result.problems);
  return result.ok() ? translated(std::move(body), scope) : result;
}

} // namespace stc::import::networks
