#pragma once
// Expressions, and initial values.

#include "compiler/syntax/ast_node.hpp"

namespace stc::ast {

enum class ExprKind : std::uint8_t {
  literal,
  name,
  member,
  index,
  deref,
  call,
  unary,
  binary,
  aggregate,
  enumLiteral,
  direct,
  typeName,
  error, ///< stands where the text could not be parsed; never reported again
};

struct Expr {
  ExprKind kind = ExprKind::error;
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

enum class LiteralKind : std::uint8_t {
  boolean,
  integer,
  real,
  string,
  wstring,
  time,
  ltime,
  date,
  ldate,
  tod,
  ltod,
  dt,
  ldt
};

/// A literal, its value already read. `typeName` is the prefix of a typed literal (`INT#5`),
/// otherwise empty.
struct Literal : Node<Expr, ExprKind::literal> {
  LiteralKind literal = LiteralKind::integer;
  Name typeName;
  std::uint64_t integer = 0; ///< integer: magnitude; boolean: 0/1; time: ms (32 bit); ltime, ldate,
                             ///< ltod, ldt: ns; date, dt: s since 1970; tod: ms
  double real = 0;
  bool negative = false; ///< of a typed number, `INT#-5`: `integer` and `real` are the magnitude
  std::string_view text; ///< string: content, $-escapes resolved, UTF-8; others: as written
};

/// A plain identifier. A variable of REFERENCE type has the referenced type here (the symbol's type
/// is the reference).
/// THIS and SUPER are names too: sema resolves them inside of methods and blocks.
struct NameExpr : Node<Expr, ExprKind::name> {
  Name name;
  Symbol *symbol = nullptr; ///< [sema]
};

/// `base.name`, also `lib.Name`, `Enum.value`. Bit access `w.3` has an empty name and `bit` >= 0;
/// so has partial access `.%X3`, `.%B1`, `.%W0`, where `bit` counts parts of `width` bits.
struct MemberExpr : Node<Expr, ExprKind::member> {
  Expr *base = nullptr;
  Name name;
  std::int32_t bit = -1;    ///< of `w.cBit` too, after [sema]
  std::uint8_t width = 1;   ///< 1, 8, 16, 32 or 64
  Symbol *symbol = nullptr; ///< [sema] the member; null for a bit
};

/// `base[i, j]`; sema guarantees indices.size() <= number of dimensions reached from base's type.
struct IndexExpr : Node<Expr, ExprKind::index> {
  Expr *base = nullptr;
  std::span<Expr *> indices;
};

/// `base^`
struct DerefExpr : Node<Expr, ExprKind::deref> {
  Expr *base = nullptr;
};

/// One argument of a call or one field of an aggregate: `value`, `name := value`, `name => target`.
struct Argument {
  Name name;             ///< empty: positional
  Expr *value = nullptr; ///< null: `name =>` or `name :=` with nothing behind
  bool output = false;   ///< `=>`
  Span span;
  VarSymbol *parameter = nullptr; ///< [sema] the parameter or field it goes to
};

enum class Callee : std::uint8_t {
  unresolved,
  function,      ///< user or library FUNCTION: `pou`
  functionBlock, ///< instance call: callee expression is the instance, `pou` its block
  method,        ///< METHOD, ACTION: callee is its name or `instance.name`, `pou` the method as the
                 ///< instance's static type declares it
  program,       ///< call of a PROGRAM: `pou`
  builtin,       ///< operator-like function known to the compiler: `builtin`
};

enum class Builtin : std::uint16_t; // semantics/builtins.hpp

struct CallExpr : Node<Expr, ExprKind::call> {
  Expr *callee = nullptr;
  std::span<Argument> arguments;
  Callee resolved = Callee::unresolved; ///< [sema]
  PouSymbol *pou = nullptr;             ///< [sema]
  Builtin builtin{};                    ///< [sema]
};

enum class UnaryOp : std::uint8_t { negate, plus, logicalNot };

/// The operand is converted to the expression's `type`. NOT, AND, OR, XOR work on the type as it is
/// (NOT on a BYTE gives a BYTE: the complement is cut to 8 bits); arithmetic works on 32 or 64
/// bits.
struct UnaryExpr : Node<Expr, ExprKind::unary> {
  UnaryOp op = UnaryOp::negate;
  Expr *operand = nullptr;
};

enum class BinaryOp : std::uint8_t {
  add,
  subtract,
  multiply,
  divide,
  modulo,
  power,
  equal,
  notEqual,
  less,
  lessEqual,
  greater,
  greaterEqual,
  logicalAnd,
  logicalOr,
  logicalXor,
  andThen,
  orElse,
};

/// After sema both operands are converted (Expr::target) to `operandType`, on which the operator
/// works.
struct BinaryExpr : Node<Expr, ExprKind::binary> {
  BinaryOp op = BinaryOp::add;
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
struct AggregateExpr : Node<Expr, ExprKind::aggregate> {
  std::span<AggregateItem> items;
  bool isStruct = false; ///< fields by name
};

/// `%IX0.0` in a statement.
struct DirectExpr : Node<Expr, ExprKind::direct> {
  DirectAddress *address = nullptr;
  const Location *location = nullptr; ///< [sema]
};

struct TypeExpr;

/// A type that begins with a keyword as an argument: `SIZEOF(STRING(20))`, `__NEW(ARRAY[1..3] OF
/// INT)`. Other types are NameExpr.
struct TypeNameExpr : Node<Expr, ExprKind::typeName> {
  TypeExpr *name = nullptr;
};

/// `color#green`
struct EnumLiteralExpr : Node<Expr, ExprKind::enumLiteral> {
  Name typeName;
  Name enumerator;
  Symbol *symbol = nullptr; ///< [sema]
};

} // namespace stc::ast
