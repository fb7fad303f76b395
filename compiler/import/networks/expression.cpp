#include "compiler/import/networks/expression.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

namespace stc::import::networks {

using stride::common::upperCase;

namespace {

struct Infix {
  std::string_view box;
  std::string_view symbol;
  Precedence precedence;
};

constexpr std::array<Infix, 27> kInfix = {{
    {"AND", "AND", kAnd},     {"&", "AND", kAnd},    {"OR", "OR", kOr},      {"XOR", "XOR", kXor},
    {"ADD", "+", kSum},       {"+", "+", kSum},      {"SUB", "-", kSum},     {"-", "-", kSum},
    {"MUL", "*", kProduct},   {"*", "*", kProduct},  {"DIV", "/", kProduct}, {"/", "/", kProduct},
    {"MOD", "MOD", kProduct}, {"GT", ">", kCompare}, {">", ">", kCompare},   {"GE", ">=", kCompare},
    {">=", ">=", kCompare},   {"LT", "<", kCompare}, {"<", "<", kCompare},   {"LE", "<=", kCompare},
    {"<=", "<=", kCompare},   {"EQ", "=", kEqual},   {"=", "=", kEqual},     {"NE", "<>", kEqual},
    {"<>", "<>", kEqual},     {">=1", "OR", kOr},    {"=1", "XOR", kXor},
}};

const Infix *infixOf(std::string_view name) {
  const std::string upper = upperCase(name);
  const auto found = std::ranges::find(kInfix, std::string_view(upper), &Infix::box);
  return found == kInfix.end() ? nullptr : &*found;
}

Expression infix(std::string_view symbol, Precedence precedence, std::vector<Expression> operands) {
  Expression result;
  result.kind = Expression::Kind::Operator;
  result.text = symbol;
  result.precedence = precedence;
  result.operands = std::move(operands);
  return result;
}

bool isOperator(const Expression &expression, std::string_view symbol) {
  return expression.kind == Expression::Kind::Operator && expression.text == symbol;
}

/// The operands with those of nested operators of the same kind in their places.
std::vector<Expression> joined(std::string_view symbol, std::vector<Expression> operands) {
  std::vector<Expression> result;
  for (Expression &each : operands)
    if (isOperator(each, symbol))
      std::ranges::move(each.operands, std::back_inserter(result));
    else
      result.push_back(std::move(each));
  return result;
}

using Factors = std::vector<Expression>;

Factors factorsOf(const Expression &expression) {
  return isOperator(expression, "AND") ? expression.operands : Factors{expression};
}

Expression factored(std::span<const Factors> terms);

/// Neighbours that begin alike become one term.
std::vector<Expression> grouped(std::span<const Factors> terms) {
  std::vector<Expression> result;
  for (size_t first = 0; first < terms.size();) {
    size_t last = first + 1;
    while (last < terms.size() && !terms[first].empty() && !terms[last].empty() &&
           terms[last].front() == terms[first].front())
      ++last;
    result.push_back(last - first == 1 ? conjunction(terms[first])
                                       : factored(terms.subspan(first, last - first)));
    first = last;
  }
  return result;
}

Expression factored(std::span<const Factors> terms) {
  size_t shortest = terms.front().size();
  for (const Factors &term : terms)
    shortest = std::min(shortest, term.size());
  const Factors &model = terms.front();
  const auto all = [&](auto &&test) { return std::ranges::all_of(terms, test); };
  size_t front = 0;
  while (front < shortest && all([&](const Factors &t) { return t[front] == model[front]; }))
    ++front;
  size_t back = 0;
  while (front + back < shortest && all([&](const Factors &t) {
           return t[t.size() - 1 - back] == model[model.size() - 1 - back];
         }))
    ++back;
  if (front + back == 0) {
    std::vector<Expression> operands = grouped(terms);
    return operands.size() == 1 ? std::move(operands.front())
                                : infix("OR", kOr, joined("OR", std::move(operands)));
  }
  Factors result(model.begin(), model.begin() + static_cast<ptrdiff_t>(front));
  std::vector<Factors> rests;
  for (const Factors &term : terms)
    rests.emplace_back(term.begin() + static_cast<ptrdiff_t>(front),
                       term.end() - static_cast<ptrdiff_t>(back));
  // A branch with nothing in it is a wire: the others do not matter.
  if (std::ranges::none_of(rests, &Factors::empty))
    result.push_back(factored(rests));
  result.insert(result.end(), model.end() - static_cast<ptrdiff_t>(back), model.end());
  return conjunction(std::move(result));
}

} // namespace

Expression textOf(std::string_view text) {
  Expression result;
  result.text = trim(text);
  result.precedence = precedenceOf(result.text);
  return result;
}

Expression truth() { return textOf("TRUE"); }

bool isTruth(const Expression &expression) {
  return expression.kind == Expression::Kind::Text && upperCase(expression.text) == "TRUE";
}

Expression negation(Expression operand) {
  if (isOperator(operand, "NOT")) {
    Expression inner = std::move(operand.operands.front());
    return inner;
  }
  return infix("NOT", kUnary, {std::move(operand)});
}

Expression conjunction(std::vector<Expression> operands) {
  std::vector<Expression> all = joined("AND", std::move(operands));
  std::erase_if(all, isTruth);
  if (all.empty())
    return truth();
  return all.size() == 1 ? std::move(all.front()) : infix("AND", kAnd, std::move(all));
}

Expression disjunction(std::vector<Expression> operands) {
  const std::vector<Expression> all = joined("OR", std::move(operands));
  std::vector<Factors> terms;
  for (const Expression &each : all) {
    if (isTruth(each))
      return truth();
    Factors factors = factorsOf(each);
    if (std::ranges::find(terms, factors) == terms.end())
      terms.push_back(std::move(factors));
  }
  return factored(terms);
}

bool isInfix(std::string_view name) { return infixOf(name) != nullptr; }

bool isComparison(std::string_view name) {
  const Infix *found = infixOf(name);
  return found != nullptr && (found->precedence == kCompare || found->precedence == kEqual);
}

Expression operation(std::string_view name, std::vector<Expression> operands) {
  const std::string upper = upperCase(name);
  if (upper == "NOT" && operands.size() == 1)
    return negation(std::move(operands.front()));
  if (upper == "MOVE" && operands.size() == 1)
    return std::move(operands.front());
  const Infix *found = infixOf(name);
  if (found != nullptr && operands.size() > 1) {
    if (found->precedence <= kAnd)
      operands = joined(found->symbol, std::move(operands));
    return infix(found->symbol, found->precedence, std::move(operands));
  }
  if (found != nullptr && found->precedence <= kAnd)
    return std::move(operands.front()); // AND of one
  Expression result;
  result.kind = Expression::Kind::Call;
  result.text = name;
  result.operands = std::move(operands);
  return result;
}

std::string printed(const Expression &expression) {
  if (expression.kind == Expression::Kind::Text)
    return expression.text;
  std::string result;
  if (expression.kind == Expression::Kind::Call) {
    std::vector<std::string> arguments;
    for (size_t i = 0; i < expression.operands.size(); ++i)
      arguments.push_back(
          (i < expression.names.size() ? expression.names[i] + " := " : std::string()) +
          printed(expression.operands[i]));
    arguments.insert(arguments.end(), expression.outputs.begin(), expression.outputs.end());
    return fmt::format("{}({})", expression.text, fmt::join(arguments, ", "));
  }
  for (size_t i = 0; i < expression.operands.size(); ++i) {
    const Expression &operand = expression.operands[i];
    const Precedence own = operand.kind == Expression::Kind::Call ? kPrimary : operand.precedence;
    const bool unary = expression.precedence == kUnary;
    const bool comparison = expression.precedence == kCompare || expression.precedence == kEqual;
    // a - (b - c) needs its brackets, (a - b) - c and a AND b AND c do not.
    const bool same = unary || (i > 0 && expression.precedence > kAnd);
    const bool bracket = own < expression.precedence || (own == expression.precedence && same) ||
                         (comparison && (own == kEqual || own == kCompare));
    if (unary || i > 0)
      result += i == 0 ? expression.text + " " : " " + expression.text + " ";
    result += bracket ? "(" + printed(operand) + ")" : printed(operand);
  }
  return result;
}

std::set<std::string> readsOf(const Expression &expression) {
  if (expression.kind == Expression::Kind::Text)
    return rootsOf(expression.text);
  std::set<std::string> result;
  for (const Expression &each : expression.operands)
    result.merge(readsOf(each));
  return result;
}

size_t leavesOf(const Expression &expression) {
  if (expression.kind == Expression::Kind::Text)
    return expression.precedence >= kUnary ? 1 : wordsOf(expression.text).size();
  size_t sum = 0;
  for (const Expression &each : expression.operands)
    sum += leavesOf(each);
  return sum;
}

bool callsIn(const Expression &expression) {
  if (expression.kind == Expression::Kind::Text)
    return expression.text.find('(') != std::string::npos;
  return expression.kind == Expression::Kind::Call ||
         std::ranges::any_of(expression.operands, callsIn);
}

} // namespace stc::import::networks
