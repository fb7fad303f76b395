#ifndef STRIDE_COMPILER_SYNTAX_AST_EXPRESSIONS_HPP
#define STRIDE_COMPILER_SYNTAX_AST_EXPRESSIONS_HPP
// Expressions, and initial values.

#include "compiler/syntax/ast_node.hpp"

namespace stc::ast {

enum class ExprKind : uint8_t {
  Literal,
  Name,
  Member,
  Index,
  Deref,
  Call,
  Unary,
  Binary,
  Aggregate,
  EnumLiteral,
  Direct,
  TypeName,
  Error, ///< stands where the text could not be parsed; never reported again
};

struct Expr {
  ExprKind kind = ExprKind::Error;
  bool parenthesized = false;
  Span span;
  const Type *type = nullptr; ///< [sema] the expression's own type
  const Type *target =
      nullptr; ///< [sema] the type it is implicitly converted to; null = no conversion
  const Type *common =
      nullptr; ///< [sema] arithmetic: the operands' common type before widening, to which an
               ///< assignment is silent (`i := i + 1` on INT); null = same as `type`
  const ConstValue *constant =
      nullptr; ///< [sema] its value (of type `type`) when it is known at compile time
};

enum class LiteralKind : uint8_t {
  Boolean,
  Integer,
  Real,
  String,
  Wstring,
  Time,
  Ltime,
  Date,
  Ldate,
  Tod,
  Ltod,
  Dt,
  Ldt
};

/// A literal, its value already read. `typeName` is the prefix of a typed literal (`INT#5`),
/// otherwise empty.
struct Literal : Node<Expr, ExprKind::Literal> {
  LiteralKind literal = LiteralKind::Integer;
  Name typeName;
  uint64_t integer = 0; ///< integer: magnitude; boolean: 0/1; time: ms (32 bit); ltime, ldate,
                        ///< ltod, ldt: ns; date, dt: s since 1970; tod: ms
  double real = 0;
  bool negative = false; ///< of a typed number, `INT#-5`: `integer` and `real` are the magnitude
  std::string_view text; ///< string: content, $-escapes resolved, UTF-8; others: as written
};

/// A plain identifier. A variable of REFERENCE type has the referenced type here (the symbol's type
/// is the reference).
/// THIS and SUPER are names too: sema resolves them inside of methods and blocks.
struct NameExpr : Node<Expr, ExprKind::Name> {
  Name name;
  Symbol *symbol = nullptr; ///< [sema]
};

/// `base.name`, also `lib.Name`, `Enum.value`. Bit access `w.3` has an empty name and `bit` >= 0;
/// so has partial access `.%X3`, `.%B1`, `.%W0`, where `bit` counts parts of `width` bits.
struct MemberExpr : Node<Expr, ExprKind::Member> {
  Expr *base = nullptr;
  Name name;
  int32_t bit = -1;         ///< of `w.cBit` too, after [sema]
  uint8_t width = 1;        ///< 1, 8, 16, 32 or 64
  Symbol *symbol = nullptr; ///< [sema] the member; null for a bit
};

/// `base[i, j]`; sema guarantees indices.size() <= number of dimensions reached from base's type.
struct IndexExpr : Node<Expr, ExprKind::Index> {
  Expr *base = nullptr;
  std::span<Expr *> indices;
};

/// `base^`
struct DerefExpr : Node<Expr, ExprKind::Deref> {
  Expr *base = nullptr;
};

/// One argument of a call or one field of an aggregate: `value`, `name := value`, `name => target`.
struct Argument {
  Name name;             ///< empty: positional
  Expr *value = nullptr; ///< null: `name =>` or `name :=` with nothing behind
  bool output = false;   ///< `=>`
  Span span;
  VarSymbol *parameter = nullptr; ///< [sema] the parameter or field it goes to
  /// [sema] The VAR_IN_OUT gets a copy of its own type; what the call changes in it goes back.
  bool copied = false;
};

enum class Callee : uint8_t {
  Unresolved,
  Function,      ///< user or library FUNCTION: `pou`
  FunctionBlock, ///< instance call: callee expression is the instance, `pou` its block
  Method,        ///< METHOD, ACTION: callee is its name or `instance.name`, `pou` the method as the
                 ///< instance's static type declares it
  Program,       ///< call of a PROGRAM: `pou`
  Builtin,       ///< operator-like function known to the compiler: `builtin`
};

enum class Builtin : uint16_t; // semantics/builtins.hpp

struct CallExpr : Node<Expr, ExprKind::Call> {
  Expr *callee = nullptr;
  std::span<Argument> arguments;
  Callee resolved = Callee::Unresolved; ///< [sema]
  PouSymbol *pou = nullptr;             ///< [sema]
  Builtin builtin{};                    ///< [sema]
};

enum class UnaryOp : uint8_t { Negate, Plus, LogicalNot };

/// The operand is converted to the expression's `type`. NOT, AND, OR, XOR work on the type as it is
/// (NOT on a BYTE gives a BYTE: the complement is cut to 8 bits); arithmetic works on 32 or 64
/// bits.
struct UnaryExpr : Node<Expr, ExprKind::Unary> {
  UnaryOp op = UnaryOp::Negate;
  Expr *operand = nullptr;
};

enum class BinaryOp : uint8_t {
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Power,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  LogicalAnd,
  LogicalOr,
  LogicalXor,
  AndThen,
  OrElse,
};
constexpr bool isComparison(BinaryOp op) {
  return op >= BinaryOp::Equal && op <= BinaryOp::GreaterEqual;
}

/// After sema both operands are converted (Expr::target) to `operandType`, on which the operator
/// works.
struct BinaryExpr : Node<Expr, ExprKind::Binary> {
  BinaryOp op = BinaryOp::Add;
  Span opSpan;
  Expr *left = nullptr;
  Expr *right = nullptr;
  const Type *operandType = nullptr; ///< [sema]
};

/// One element of an initial value: `value`, `count(value, …)` or `field := value`.
struct AggregateItem {
  Name field;             ///< structure field; empty in arrays
  Expr *repeat = nullptr; ///< repetition count; null: once
  Expr *value = nullptr;  ///< null only together with `repeat`: count() = defaults
  std::span<AggregateItem>
      values; ///< more than one value inside a repetition: `2(1, 2)`; then value is null
  Span span;
  VarSymbol *symbol = nullptr; ///< [sema] the field
};

/// `[1, 2, 3(0)]`, `(a := 1, b := 2)`, V2.3's bracket-less `1, 2, 3(0)` and `(a := 1), (a := 2)`.
struct AggregateExpr : Node<Expr, ExprKind::Aggregate> {
  std::span<AggregateItem> items;
  bool isStruct = false; ///< fields by name
};

/// `%IX0.0` in a statement.
struct DirectExpr : Node<Expr, ExprKind::Direct> {
  DirectAddress *address = nullptr;
  const Location *location = nullptr; ///< [sema]
};

struct TypeExpr;

/// A type that begins with a keyword as an argument: `SIZEOF(STRING(20))`, `__NEW(ARRAY[1..3] OF
/// INT)`. Other types are NameExpr.
struct TypeNameExpr : Node<Expr, ExprKind::TypeName> {
  TypeExpr *name = nullptr;
};

/// `color#green`
struct EnumLiteralExpr : Node<Expr, ExprKind::EnumLiteral> {
  Name typeName;
  Name enumerator;
  Symbol *symbol = nullptr; ///< [sema]
};

} // namespace stc::ast

#endif // STRIDE_COMPILER_SYNTAX_AST_EXPRESSIONS_HPP
