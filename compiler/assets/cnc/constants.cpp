// Constant expressions that initial values of variables are: those of numbers, as the compiler
// folds them later.

#include "compiler/assets/cnc/internal.hpp"
#include "runtime/iec/math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stc::gcode {

using stride::cnc::VariableType;

namespace {

struct TypeName {
  std::string_view name;
  VariableType type;
};
constexpr std::array<TypeName, 12> kTypes = {{{"int", VariableType::Int},
                                              {"byte", VariableType::Byte},
                                              {"word", VariableType::Word},
                                              {"dint", VariableType::Dint},
                                              {"dword", VariableType::Dword},
                                              {"real", VariableType::Real},
                                              {"smc_m_parameters", VariableType::Structure},
                                              {"sint", VariableType::Sint},
                                              {"usint", VariableType::Usint},
                                              {"uint", VariableType::Uint},
                                              {"udint", VariableType::Udint},
                                              {"lreal", VariableType::Lreal}}};

} // namespace

std::optional<VariableType> typeNamed(std::string_view lower) {
  for (const TypeName &type : kTypes)
    if (type.name == lower)
      return type.type;
  return std::nullopt;
}

namespace {

/// How far constants may lead to others.
constexpr int kDeepest = 32;

/// A number, and whether it is of an integer type: their quotients have no fraction.
struct Number {
  double value = 0;
  bool whole = false;
};

struct Function {
  std::string_view name;
  size_t arguments;
  double (*of)(double, double);
};
constexpr std::array kFunctions = {
    Function{"abs", 1, [](double x, double) { return std::fabs(x); }},
    Function{"sqrt", 1, [](double x, double) { return std::sqrt(x); }},
    Function{"ln", 1, [](double x, double) { return stride::ln(x); }},
    Function{"log", 1, [](double x, double) { return stride::log10(x); }},
    Function{"exp", 1, [](double x, double) { return stride::exp(x); }},
    Function{"sin", 1, [](double x, double) { return stride::sin(x); }},
    Function{"cos", 1, [](double x, double) { return stride::cos(x); }},
    Function{"tan", 1, [](double x, double) { return stride::tan(x); }},
    Function{"asin", 1, [](double x, double) { return stride::asin(x); }},
    Function{"acos", 1, [](double x, double) { return stride::acos(x); }},
    Function{"atan", 1, [](double x, double) { return stride::atan(x); }},
    Function{"expt", 2, [](double x, double y) { return stride::pow(x, y); }},
    Function{"min", 2, [](double x, double y) { return std::min(x, y); }},
    Function{"max", 2, [](double x, double y) { return std::max(x, y); }},
};
/// Their result is an integer where their arguments are.
bool keepsWhole(std::string_view function) {
  return function == "abs" || function == "min" || function == "max";
}

class Folder {
public:
  explicit Folder(const FindConstant &find) : find_(find) {}

  std::optional<Number> fold(const ast::Expr *expression, int depth = 0) {
    if (expression == nullptr || depth == kDeepest)
      return std::nullopt;
    switch (expression->kind) {
    case ast::ExprKind::Literal:
      return literal(*ast::as<ast::Literal>(expression));
    case ast::ExprKind::Unary:
      return unary(*ast::as<ast::UnaryExpr>(expression), depth);
    case ast::ExprKind::Binary:
      return binary(*ast::as<ast::BinaryExpr>(expression), depth);
    case ast::ExprKind::Name:
      return constant(*ast::as<ast::NameExpr>(expression), depth);
    case ast::ExprKind::Call:
      return call(*ast::as<ast::CallExpr>(expression), depth);
    default:
      return std::nullopt;
    }
  }

private:
  static std::optional<Number> literal(const ast::Literal &literal) {
    const double sign = literal.negative ? -1 : 1;
    const std::optional<VariableType> type = typeNamed(lowerCase(literal.typeName.text));
    const bool real = type == VariableType::Real || type == VariableType::Lreal;
    if (literal.literal == ast::LiteralKind::Integer)
      return Number{sign * static_cast<double>(literal.integer), !real};
    if (literal.literal == ast::LiteralKind::Real)
      return Number{sign * literal.real, false};
    return std::nullopt;
  }

  std::optional<Number> unary(const ast::UnaryExpr &unary, int depth) {
    std::optional<Number> operand = fold(unary.operand, depth + 1);
    if (!operand || unary.op == ast::UnaryOp::LogicalNot)
      return std::nullopt;
    if (unary.op == ast::UnaryOp::Negate)
      operand->value = -operand->value;
    return operand;
  }

  /// A global constant of a type that G-code knows.
  std::optional<Number> constant(const ast::NameExpr &name, int depth) {
    const ast::VarDecl *const found = find_(lowerCase(name.name.text));
    std::optional<Number> number = found != nullptr ? fold(found->init, depth + 1) : std::nullopt;
    if (!number || found->type == nullptr || found->type->kind != ast::TypeExprKind::Named)
      return number;
    const auto *const type = ast::as<ast::NamedTypeExpr>(found->type);
    const std::optional<VariableType> known =
        type->path.empty() ? std::nullopt : typeNamed(lowerCase(type->path.back().text));
    if (known)
      number->whole = known != VariableType::Real && known != VariableType::Lreal;
    return number;
  }

  std::optional<Number> binary(const ast::BinaryExpr &binary, int depth) {
    const std::optional<Number> left = fold(binary.left, depth + 1);
    const std::optional<Number> right = fold(binary.right, depth + 1);
    if (!left || !right)
      return std::nullopt;
    const double a = left->value;
    const double b = right->value;
    const bool whole = left->whole && right->whole;
    switch (binary.op) {
    case ast::BinaryOp::Add:
      return Number{a + b, whole};
    case ast::BinaryOp::Subtract:
      return Number{a - b, whole};
    case ast::BinaryOp::Multiply:
      return Number{a * b, whole};
    case ast::BinaryOp::Divide:
      if (b == 0)
        return std::nullopt;
      return Number{whole ? std::trunc(a / b) : a / b, whole};
    case ast::BinaryOp::Modulo:
      if (b == 0 || !whole)
        return std::nullopt;
      return Number{std::fmod(a, b), true};
    case ast::BinaryOp::Power:
      return Number{stride::pow(a, b), false};
    default:
      return std::nullopt;
    }
  }

  std::optional<Number> call(const ast::CallExpr &call, int depth) {
    if (call.callee == nullptr || call.callee->kind != ast::ExprKind::Name)
      return std::nullopt;
    const std::string name = lowerCase(ast::as<ast::NameExpr>(call.callee)->name.text);
    const auto *const function =
        std::find_if(kFunctions.begin(), kFunctions.end(),
                     [&](const Function &row) { return row.name == name; });
    if (function == kFunctions.end() || call.arguments.size() != function->arguments)
      return std::nullopt;
    std::array<Number, 2> value{};
    bool whole = keepsWhole(name);
    for (size_t i = 0; i < function->arguments; ++i) {
      // Names of arguments may change their order.
      const std::optional<Number> one = call.arguments[i].name.text.empty()
                                            ? fold(call.arguments[i].value, depth + 1)
                                            : std::nullopt;
      if (!one)
        return std::nullopt;
      value.at(i) = *one;
      whole = whole && one->whole;
    }
    return Number{function->of(value[0].value, value[1].value), whole};
  }

  const FindConstant &find_;
};

} // namespace

std::optional<double> constantOf(const ast::Expr *expression, const FindConstant &find) {
  const std::optional<Number> number = Folder(find).fold(expression);
  return number && std::isfinite(number->value) ? std::optional(number->value) : std::nullopt;
}

} // namespace stc::gcode
