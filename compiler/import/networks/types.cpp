#include "compiler/import/networks/types.hpp"
#include "runtime/common/text.hpp"

#include "compiler/import/networks/expression.hpp"
#include "compiler/import/networks/text.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace stc::import::networks {

using stride::common::upperCase;

namespace {

/// Literals without a type take that of what they meet.
constexpr std::string_view kAnyInteger = "an integer";
constexpr std::string_view kAnyReal = "a real";
/// AND, OR, XOR, NOT of nothing that is known.
constexpr std::string_view kAnyBit = "a bit";

/// Numeric types from the narrowest to the widest.
constexpr std::array<std::string_view, 17> kRanks = {
    "BOOL",  "SINT", "USINT", "BYTE",  "INT",  "UINT",  "WORD", "DINT", "UDINT",
    "DWORD", "LINT", "ULINT", "LWORD", "REAL", "LREAL", "TIME", "LTIME"};

std::string common(const std::string &a, const std::string &b) {
  if (a.empty() || b.empty() || a == b)
    return a.empty() ? b : a;
  if (a == kAnyBit || (a == kAnyInteger && b != kAnyBit))
    return b;
  if (b == kAnyBit || b == kAnyInteger)
    return a;
  const std::string upperA = upperCase(a);
  const std::string upperB = upperCase(b);
  if (a == kAnyReal || b == kAnyReal)
    return (a == kAnyReal ? upperB : upperA) == "LREAL" ? "LREAL" : "REAL";
  const auto rankA = std::ranges::find(kRanks, std::string_view(upperA));
  const auto rankB = std::ranges::find(kRanks, std::string_view(upperB));
  return rankA != kRanks.end() && (rankB == kRanks.end() || rankA > rankB) ? a : b;
}

std::string concrete(const std::string &type) {
  return type == kAnyInteger ? "DINT" : type == kAnyReal ? "REAL" : type == kAnyBit ? "BOOL" : type;
}

/// Where a function's result has the type of its operands, from which operand on.
constexpr std::array<std::pair<std::string_view, size_t>, 17> kOfOperands = {{
    {"MIN", 0},
    {"MAX", 0},
    {"LIMIT", 0},
    {"SEL", 1},
    {"MUX", 1},
    {"ABS", 0},
    {"NEG", 0},
    {"MOVE", 0},
    {"NOT", 0},
    {"SHL", 0},
    {"SHR", 0},
    {"ROL", 0},
    {"ROR", 0},
    {"EXPT", 0},
    {"SQRT", 0},
    {"LN", 0},
    {"LOG", 0},
}};

constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kResults = {{
    {"LEN", "INT"},
    {"FIND", "INT"},
    {"CONCAT", "STRING"},
    {"LEFT", "STRING"},
    {"RIGHT", "STRING"},
    {"MID", "STRING"},
    {"INSERT", "STRING"},
    {"DELETE", "STRING"},
    {"REPLACE", "STRING"},
    {"SIN", "LREAL"},
    {"COS", "LREAL"},
    {"TAN", "LREAL"},
    {"EXP", "LREAL"},
    {"TRUNC", "DINT"},
    {"TIME", "TIME"},
}};

/// Type of what an operator or function gives; `operand(i)` is the type of an operand.
template <typename Operand>
std::string resultOf(std::string_view name, size_t count, const Scope &scope, Operand operand) {
  const std::string upper = upperCase(name);
  if (isComparison(upper))
    return "BOOL";
  const auto fixed = std::ranges::find(kResults, std::string_view(upper),
                                       &std::pair<std::string_view, std::string_view>::first);
  if (fixed != kResults.end())
    return std::string(fixed->second);
  const size_t to = upper.find("TO_");
  if (to != std::string::npos && (to == 0 || upper[to - 1] == '_'))
    return upper.substr(to + 3);
  const auto generic = std::ranges::find(kOfOperands, std::string_view(upper),
                                         &std::pair<std::string_view, size_t>::first);
  if (!isInfix(upper) && generic == kOfOperands.end()) {
    const Interface *function = scope.interfaceOf(name);
    return function == nullptr ? std::string() : function->returnType;
  }
  std::string result;
  for (size_t i = generic == kOfOperands.end() ? 0 : generic->second; i < count; ++i)
    result = common(result, operand(i));
  return result;
}

std::string typeOfLiteral(const std::string &text) {
  const size_t mark = text.find('#');
  if (mark != std::string::npos && (text.front() < '0' || text.front() > '9')) {
    const std::string prefix = upperCase(std::string_view(text).substr(0, mark));
    return prefix == "T"     ? "TIME"
           : prefix == "D"   ? "DATE"
           : prefix == "DT"  ? "DT"
           : prefix == "TOD" ? "TOD"
                             : prefix;
  }
  if (text.front() == '\'')
    return "STRING";
  const bool real = mark == std::string::npos && text.find_first_of(".eE") != std::string::npos;
  return std::string(real ? kAnyReal : kAnyInteger);
}

constexpr size_t kBracketDepth = 30; // of brackets in an expression of the file
constexpr size_t kTracedNodes = 300; // that are looked at for one type

std::string typeOfWords(std::string_view text, const Scope &scope, size_t depth);

/// A text without operators: a literal, a variable, a call, or something in brackets.
std::string typeOfPrimary(std::string_view text, const Scope &scope, size_t depth) {
  const std::vector<Word> words = wordsOf(text);
  if (words.empty())
    return {};
  if (words.front().text == "(" && words.back().text == ")")
    return typeOfWords(text.substr(words.front().at + 1, words.back().at - words.front().at - 1),
                       scope, depth + 1);
  if (words.size() == 1 && words.front().kind == Word::Kind::Literal)
    return typeOfLiteral(words.front().text);
  const std::string upper = upperCase(words.front().text);
  if (words.size() == 1 && (upper == "TRUE" || upper == "FALSE"))
    return "BOOL";
  if (words.size() < 2 || words[1].text != "(")
    return scope.typeOf(text);
  std::vector<std::string> operands;
  size_t begin = words[1].at + 1;
  int brackets = 0;
  for (size_t i = 1; i < words.size(); ++i) {
    brackets += words[i].text == "(" || words[i].text == "[" ? 1 : 0;
    brackets -= words[i].text == ")" || words[i].text == "]" ? 1 : 0;
    if (brackets == 0 || (brackets == 1 && words[i].text == ",")) {
      operands.push_back(typeOfWords(text.substr(begin, words[i].at - begin), scope, depth + 1));
      begin = words[i].at + 1;
    }
    if (brackets == 0)
      break;
  }
  return resultOf(upper, operands.size(), scope, [&](size_t i) { return operands[i]; });
}

std::string typeOfWords(std::string_view text, const Scope &scope, size_t depth) {
  text = trim(text);
  if (depth == kBracketDepth || text.empty())
    return {};
  const Precedence weakest = precedenceOf(text);
  if (weakest == kPrimary)
    return typeOfPrimary(text, scope, depth);
  if (weakest == kEqual || weakest == kCompare)
    return "BOOL";
  const std::vector<Word> words = wordsOf(text);
  std::string result;
  size_t begin = 0;
  int brackets = 0;
  const auto take = [&](size_t end) {
    const std::string_view part = trim(text.substr(begin, end - begin));
    if (!part.empty())
      result = common(result, typeOfWords(part, scope, depth + 1));
  };
  for (const Word &word : words) {
    brackets += word.text == "(" || word.text == "[" ? 1 : 0;
    brackets -= word.text == ")" || word.text == "]" ? 1 : 0;
    if (brackets != 0 || word.kind == Word::Kind::Literal)
      continue;
    const std::string upper = upperCase(word.text);
    if (upper == "NOT" || upper == "-" || upper == "+" || upper == "**" ||
        precedenceOf("a " + upper + " b") < kPrimary) {
      take(word.at);
      begin = word.at + word.text.size();
    }
  }
  if (begin == 0)
    return {};
  take(text.size());
  return result;
}

/// Follows wires backwards.
class Tracer {
public:
  Tracer(const Body &body, const Scope &scope) : body_(body), scope_(scope) {}

  std::string output(Wire from) {
    const Node &node = body_.nodes[from.node];
    if (node.boolean || node.kind == NodeKind::Contact || node.kind == NodeKind::Coil ||
        node.kind == NodeKind::Rail)
      return "BOOL";
    if (node.kind == NodeKind::Input || node.kind == NodeKind::InOut)
      return typeOfWords(node.text, scope_, 0);
    if (from.pin >= node.outputs.size())
      return {};
    const OutPin &pin = node.outputs[from.pin];
    if (pin.enable)
      return "BOOL";
    if (node.kind == NodeKind::Call)
      return scope_.typeOf(node.text + "." + pin.name);
    if (node.kind != NodeKind::Value || visited_.size() == kTracedNodes ||
        !visited_.insert(from.node).second)
      return {};
    if (const Interface *function = scope_.interfaceOf(node.text); function != nullptr)
      for (const Declared &each : function->outputs)
        if (upperCase(each.name) == upperCase(pin.name))
          return each.type;
    std::vector<const InPin *> operands;
    for (const InPin &each : node.inputs)
      if (!each.enable)
        operands.push_back(&each);
    const std::string result =
        resultOf(node.text, operands.size(), scope_, [&](size_t i) { return input(*operands[i]); });
    const std::string upper = upperCase(node.text);
    const bool bits = upper == "AND" || upper == "OR" || upper == "XOR" || upper == "NOT";
    return result.empty() && bits ? std::string(kAnyBit) : result;
  }

private:
  std::string input(const InPin &pin) {
    if (pin.wires.size() > 1 || pin.edge != Edge::None)
      return "BOOL";
    return pin.wires.empty() ? std::string() : output(pin.wires.front());
  }

  const Body &body_;
  const Scope &scope_;
  std::set<NodeIndex> visited_;
};

} // namespace

std::string typeOfText(std::string_view text, const Scope &scope) {
  return concrete(typeOfWords(text, scope, 0));
}

std::string typeOfOutput(const Body &body, Wire from, const Scope &scope, bool guess) {
  const std::string type = Tracer(body, scope).output(from);
  return !guess && concrete(type) != type ? std::string() : concrete(type);
}

} // namespace stc::import::networks
