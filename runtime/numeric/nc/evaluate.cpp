#include "runtime/numeric/nc/evaluate.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/nc/symbols.hpp"

namespace stride::nc {
namespace {

constexpr double kPi = 3.14159265358979323846;

Error push(Evaluation &e, const Value &value) noexcept {
  if (e.count == kMostValues)
    return Error::StackOverflow;
  e.values[e.count++] = value;
  return Error::None;
}

Error pushNumber(Evaluation &e, double number) noexcept {
  if (!exact::isfinite(number))
    return Error::NotANumber;
  return push(e, {number, 0, 0, ValueType::Real});
}

Error pushBool(Evaluation &e, bool value) noexcept {
  return push(e, {value ? 1.0 : 0.0, 0, 0, ValueType::Bool});
}

Error pushText(Evaluation &e, const char *text, int32_t length) noexcept {
  if (e.used + length > kTextBytes)
    return Error::StackOverflow;
  __builtin_memcpy(e.texts + e.used, text, static_cast<uint64_t>(length));
  const Value value{0.0, e.used, length, ValueType::Text};
  e.used += length;
  return push(e, value);
}

int32_t lengthOf(const char *text, int32_t most) noexcept {
  int32_t length = 0;
  while (length < most && text[length] != 0)
    ++length;
  return length;
}

Error pushLocal(Evaluation &e, const Surroundings &around, int32_t index) noexcept {
  if (index >= around.localCount)
    return Error::NoLocal;
  const Local &local = around.locals[index];
  if (local.type == ValueType::Text) {
    const char *const text = reinterpret_cast<const char *>(local.place);
    return pushText(e, text, lengthOf(text, kMostText));
  }
  const auto number = load<double>(local.place);
  return local.type == ValueType::Bool ? pushBool(e, number != 0.0) : pushNumber(e, number);
}

Error pushVariable(Evaluation &e, const Surroundings &around, uint8_t type,
                   int32_t index) noexcept {
  cnc::GCodeWord word{};
  if (!variableAt(around.variables, index, type, word))
    return Error::ReadType;
  if (type == kBoolVariable)
    return pushBool(e, *word.address != 0);
  if (type == kTextVariable) {
    const char *const text = reinterpret_cast<const char *>(word.address);
    return pushText(e, text, lengthOf(text, kMostText));
  }
  return pushNumber(e, cnc::valueOf(word));
}

Error applyOne(Evaluation &e, Op op) noexcept {
  if (e.count < 1)
    return Error::Syntax;
  const double x = e.values[--e.count].number;
  switch (op) {
  case Op::Negate:
    return pushNumber(e, -x);
  case Op::Not:
    return pushBool(e, x == 0.0);
  case Op::Sin:
    return pushNumber(e, stride::sin(x));
  case Op::Cos:
    return pushNumber(e, stride::cos(x));
  case Op::Tan:
    return pushNumber(e, stride::tan(x));
  case Op::Asin:
    return pushNumber(e, stride::asin(x));
  case Op::Acos:
    return pushNumber(e, stride::acos(x));
  case Op::Atan:
    return pushNumber(e, stride::atan(x));
  case Op::Abs:
    return pushNumber(e, exact::fabs(x));
  case Op::Sqrt:
    return pushNumber(e, stride::sqrt(x));
  case Op::Exp:
    return pushNumber(e, stride::exp(x));
  case Op::Ln:
    return pushNumber(e, stride::ln(x));
  case Op::Log:
    return pushNumber(e, stride::log10(x));
  case Op::Trunc:
    return pushNumber(e, stride::trunc(x));
  default:
    return Error::Syntax;
  }
}

bool same(const Evaluation &e, const Value &a, const Value &b) noexcept {
  if (a.type != ValueType::Text)
    return a.number == b.number;
  return a.length == b.length &&
         __builtin_memcmp(e.texts + a.text, e.texts + b.text, static_cast<uint64_t>(a.length)) == 0;
}

/// Both texts in a row, 255 characters at most.
Error concatenate(Evaluation &e, const Value &a, const Value &b) noexcept {
  char text[kMostText];
  const int32_t rest = kMostText - a.length;
  const int32_t second = b.length < rest ? b.length : rest;
  __builtin_memcpy(text, e.texts + a.text, static_cast<uint64_t>(a.length));
  __builtin_memcpy(text + a.length, e.texts + b.text, static_cast<uint64_t>(second));
  e.used = a.text;
  return pushText(e, text, a.length + second);
}

Error compute(Evaluation &e, Op op, double a, double b) noexcept {
  switch (op) {
  case Op::Add:
    return pushNumber(e, a + b);
  case Op::Subtract:
    return pushNumber(e, a - b);
  case Op::Multiply:
    return pushNumber(e, a * b);
  case Op::Divide:
    return b == 0.0 ? Error::DivisionByZero : pushNumber(e, a / b);
  case Op::Modulo:
    return b == 0.0 ? Error::DivisionByZero : pushNumber(e, stride::fmod(a, b));
  case Op::Greater:
    return pushBool(e, a > b);
  case Op::Less:
    return pushBool(e, a < b);
  case Op::GreaterEqual:
    return pushBool(e, a >= b);
  case Op::LessEqual:
    return pushBool(e, a <= b);
  case Op::And:
    return pushBool(e, a != 0.0 && b != 0.0);
  case Op::Or:
    return pushBool(e, a != 0.0 || b != 0.0);
  case Op::Xor:
    return pushBool(e, (a != 0.0) != (b != 0.0));
  case Op::Expt:
    return pushNumber(e, stride::pow(a, b));
  case Op::Min:
    return pushNumber(e, a < b ? a : b);
  case Op::Max:
    return pushNumber(e, a > b ? a : b);
  default:
    return Error::Syntax;
  }
}

Error applyTwo(Evaluation &e, Op op) noexcept {
  if (e.count < 2)
    return Error::Syntax;
  const Value b = e.values[--e.count];
  const Value a = e.values[--e.count];
  if (op == Op::Concat)
    return concatenate(e, a, b);
  if (op == Op::Equal || op == Op::Unequal) {
    const bool equal = same(e, a, b);
    if (a.type == ValueType::Text)
      e.used = a.text;
    return pushBool(e, equal == (op == Op::Equal));
  }
  return compute(e, op, a.number, b.number);
}

/// SEL: the second value if the condition is FALSE, else the third one.
Error select(Evaluation &e) noexcept {
  if (e.count < 3)
    return Error::Syntax;
  e.count -= 3;
  const Value *const v = e.values + e.count;
  return push(e, v[0].number == 0.0 ? v[1] : v[2]);
}

bool isUnary(Op op) noexcept {
  return op == Op::Negate || op == Op::Not || (op >= Op::Sin && op <= Op::Trunc);
}

/// Bytes that stand behind an instruction.
int32_t operandsOf(Op op, const uint8_t *at, int32_t left) noexcept {
  switch (op) {
  case Op::Number:
    return sizeof(double);
  case Op::Text:
    return left > 0 ? 1 + at[0] : 1;
  case Op::Local:
    return 1;
  case Op::Variable:
    return 3;
  default:
    return 0;
  }
}

Error step(Evaluation &e, Op op, const uint8_t *operands, const Surroundings &around) noexcept {
  switch (op) {
  case Op::Number:
    return pushNumber(e, load<double>(operands));
  case Op::True:
  case Op::False:
    return pushBool(e, op == Op::True);
  case Op::Text:
    return pushText(e, reinterpret_cast<const char *>(operands + 1), operands[0]);
  case Op::Local:
    return pushLocal(e, around, operands[0]);
  case Op::Variable:
    return pushVariable(e, around, operands[0], load<uint16_t>(operands + 1));
  case Op::Pi:
    return pushNumber(e, kPi);
  case Op::Select:
    return select(e);
  default:
    return isUnary(op) ? applyOne(e, op) : applyTwo(e, op);
  }
}

} // namespace

bool variableAt(const cnc::VariableList *list, int32_t index, uint8_t type,
                cnc::GCodeWord &word) noexcept {
  if (list == nullptr || list->first == nullptr || index >= list->count)
    return false;
  cnc::NamedVariable &variable = list->first[index];
  if (variable.type != type)
    return false;
  word.variables = type;
  word.address = variable.address;
  if (word.address != nullptr)
    return true;
  if (typeOfVariable(type) != ValueType::Real)
    return false;
  const auto of = static_cast<cnc::VariableType>(type);
  const bool real = of == cnc::VariableType::Real || of == cnc::VariableType::Lreal;
  word.variables = static_cast<uint8_t>(real ? cnc::VariableType::Real : cnc::VariableType::Dint);
  word.address = real ? reinterpret_cast<uint8_t *>(&variable.real)
                      : reinterpret_cast<uint8_t *>(&variable.integer);
  return true;
}

Error evaluate(Evaluation &evaluation, const uint8_t *code, int32_t size,
               const Surroundings &surroundings) noexcept {
  int32_t at = 0;
  while (at < size) {
    const auto op = static_cast<Op>(code[at++]);
    const int32_t operands = operandsOf(op, code + at, size - at);
    if (at + operands > size)
      return Error::Syntax;
    if (const Error error = step(evaluation, op, code + at, surroundings); error != Error::None)
      return error;
    at += operands;
  }
  return Error::None;
}

} // namespace stride::nc
