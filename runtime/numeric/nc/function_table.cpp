#include "runtime/numeric/nc/function_table.hpp"

namespace stride::nc {
namespace {

constexpr ValueType kBool = ValueType::Bool;
constexpr ValueType kReal = ValueType::Real;
constexpr ValueType kText = ValueType::Text;
constexpr ValueType kAny = ValueType::Any;

constexpr Function kFunctions[] = {
    {"NOT", Op::Not, kBool, 1, {kBool}},
    {"PI", Op::Pi, kReal, 0, {}},
    {"SIN", Op::Sin, kReal, 1, {kReal}},
    {"ABS", Op::Abs, kReal, 1, {kReal}},
    {"EXPT", Op::Expt, kReal, 2, {kReal, kReal}},
    {"CONCAT", Op::Concat, kText, 2, {kText, kText}},
    {"TRUE", Op::True, kBool, 0, {}},
    {"FALSE", Op::False, kBool, 0, {}},
    // Stride's own, as in ST:
    {"COS", Op::Cos, kReal, 1, {kReal}},
    {"TAN", Op::Tan, kReal, 1, {kReal}},
    {"ASIN", Op::Asin, kReal, 1, {kReal}},
    {"ACOS", Op::Acos, kReal, 1, {kReal}},
    {"ATAN", Op::Atan, kReal, 1, {kReal}},
    {"SQRT", Op::Sqrt, kReal, 1, {kReal}},
    {"EXP", Op::Exp, kReal, 1, {kReal}},
    {"LN", Op::Ln, kReal, 1, {kReal}},
    {"LOG", Op::Log, kReal, 1, {kReal}},
    {"TRUNC", Op::Trunc, kReal, 1, {kReal}},
    {"MIN", Op::Min, kReal, 2, {kReal, kReal}},
    {"MAX", Op::Max, kReal, 2, {kReal, kReal}},
    {"SEL", Op::Select, kAny, 3, {kBool, kAny, kAny}},
};

/// An operator that is a symbol or a word.
struct InfixRow {
  uint16_t symbol;
  const char *word;
  Infix infix;
};

constexpr InfixRow kInfixes[] = {
    {0, "MOD", {14, Op::Modulo, kReal, kReal}},
    {symbol('*'), nullptr, {13, Op::Multiply, kReal, kReal}},
    {symbol('/'), nullptr, {13, Op::Divide, kReal, kReal}},
    {symbol('+'), nullptr, {12, Op::Add, kReal, kReal}},
    {symbol('-'), nullptr, {12, Op::Subtract, kReal, kReal}},
    {symbol('='), nullptr, {10, Op::Equal, kBool, kAny}},
    {symbol('<', '>'), nullptr, {10, Op::Unequal, kBool, kAny}},
    {symbol('>'), nullptr, {10, Op::Greater, kBool, kReal}},
    {symbol('<'), nullptr, {10, Op::Less, kBool, kReal}},
    {symbol('>', '='), nullptr, {10, Op::GreaterEqual, kBool, kReal}},
    {symbol('<', '='), nullptr, {10, Op::LessEqual, kBool, kReal}},
    {0, "AND", {6, Op::And, kBool, kBool}},
    {0, "XOR", {5, Op::Xor, kBool, kBool}},
    {0, "OR", {4, Op::Or, kBool, kBool}},
};

constexpr const char *kKeywords[] = {"LET",     "SUBPROGRAM", "END_SUBPROGRAM", "RETURN",
                                     "DYNCALL", "LREAL",      "BOOL",           "STRING"};

} // namespace

const Function *functionOf(const ProgramLine &line, const Token &name) noexcept {
  for (const Function &function : kFunctions)
    if (isWordText(line, name, function.name))
      return &function;
  return nullptr;
}

const Infix *infixOf(const ProgramLine &line, const Token &token) noexcept {
  for (const InfixRow &row : kInfixes) {
    const bool same = row.word != nullptr
                          ? isWordText(line, token, row.word)
                          : token.kind == TokenKind::Symbol && token.symbol == row.symbol;
    if (same)
      return &row.infix;
  }
  return nullptr;
}

bool isReserved(const ProgramLine &line, const Token &name) noexcept {
  for (const char *word : kKeywords)
    if (isWordText(line, name, word))
      return true;
  return functionOf(line, name) != nullptr || infixOf(line, name) != nullptr;
}

} // namespace stride::nc
