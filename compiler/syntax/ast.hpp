#pragma once
// The typed syntax tree. Nodes live in an Arena and are trivially destructible; children are
// pointers and spans into the same arena. Fields marked [sema] are empty after parsing and filled
// in by compiler/semantics.

#include "compiler/source/identifier.hpp"
#include "compiler/source/span.hpp"

#include <cassert>
#include <cstdint>
#include <span>
#include <string_view>

namespace stc {

struct Type;       // semantics/types.hpp
struct ConstValue; // semantics/constant.hpp
struct Symbol;     // semantics/symbols.hpp
struct VarSymbol;
struct PouSymbol;
struct TypeSymbol;
struct Location;

namespace ast {

/// An identifier as written.
struct Name {
  Ident id = nullptr;
  std::string_view text; ///< spelling in the source
  Span span;
  explicit operator bool() const { return id != nullptr; }
};
/// `Lib.Block`, the names from left to right.
using NamePath = std::span<Name>;

/// `%IX0.0`, `%QW2`, `%MD4`, `%I*`: where a located variable lies.
struct DirectAddress {
  char area = 'M';                  ///< I, Q or M
  char size = 'X';                  ///< X (bit), B, W, D or L; a missing letter means X
  bool incomplete = false;          ///< `%I*`: VAR_CONFIG gives the place
  std::span<std::uint32_t> numbers; ///< `%IX3.7` gives 3, 7
  std::string_view text;            ///< as written
  Span span;
};

// ----------------------------------------------------------------------------------------------------
// attributes

/// `{attribute 'name' := 'value'}`
struct Attribute {
  std::string_view name;
  std::string_view value;
  Span span;
};
using Attributes = std::span<const Attribute>;

/// A node of one kind (the first), or of one of several that it is given after it has been made.
template <class Base, auto First, auto... Others> struct Node : Base {
  constexpr Node() : Base{} { this->kind = First; }
  [[nodiscard]] static constexpr bool holds(decltype(First) kind) {
    return kind == First || (... || (kind == Others));
  }
};

// ---------------------------------------------------------------------------------------------------
// expressions

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

// ------------------------------------------------------------------------------------------------
// types as written

enum class TypeExprKind : std::uint8_t {
  named,
  array,
  string,
  pointer,
  reference,
  subrange,
  enumeration,
  error
};

struct TypeExpr {
  TypeExprKind kind = TypeExprKind::error;
  Span span;
};

/// `INT`, `Lib.Type`, `Block(a := 1)` with arguments for FB_Init
struct NamedTypeExpr : Node<TypeExpr, TypeExprKind::named> {
  std::span<Name> path;
  bool hasArguments = false;     ///< `Block(…)`, also with nothing between the parentheses
  std::span<Argument> arguments; ///< of `Block(…)`
  /// Of `ARRAY[…] OF Block[(…), (…)]`: the arguments of each element; empty otherwise.
  std::span<std::span<Argument>> elements;
  Symbol *symbol = nullptr; ///< [sema] the type or block; null: an elementary type, or unknown
};

struct ArrayRange {
  Expr *low = nullptr; ///< null: `*`
  Expr *high = nullptr;
  Span span;
};

struct ArrayTypeExpr : Node<TypeExpr, TypeExprKind::array> {
  std::span<ArrayRange> ranges;
  TypeExpr *element = nullptr;
};

/// STRING, STRING(n), STRING[n], WSTRING…
struct StringTypeExpr : Node<TypeExpr, TypeExprKind::string> {
  bool wide = false;
  Expr *length = nullptr; ///< null: 80
};

/// POINTER TO / REFERENCE TO / REF_TO
struct PointerTypeExpr : Node<TypeExpr, TypeExprKind::pointer, TypeExprKind::reference> {
  TypeExpr *pointee = nullptr;
  bool refTo =
      false; ///< edition 3's REF_TO: a pointer that is only assigned, compared and followed
};

/// `INT(0..10)`
struct SubrangeTypeExpr : Node<TypeExpr, TypeExprKind::subrange> {
  TypeExpr *base = nullptr;
  Expr *low = nullptr;
  Expr *high = nullptr;
};

struct EnumeratorDecl {
  Name name;
  Expr *value = nullptr;
  std::string_view doc;
};

/// `(a, b := 5, c) BYTE := a`, in a TYPE or in line in a variable declaration.
struct EnumTypeExpr : Node<TypeExpr, TypeExprKind::enumeration> {
  std::span<EnumeratorDecl> enumerators;
  TypeExpr *base = nullptr; ///< null: INT
};

// ----------------------------------------------------------------------------------------------------
// statements

enum class StmtKind : std::uint8_t {
  empty,
  assign,
  call,
  ifS,
  caseS,
  forS,
  whileS,
  repeatS,
  exit,
  continueS,
  returnS,
  jump,
  label,
  tryS,
};

struct Stmt {
  StmtKind kind = StmtKind::empty;
  Span span;
};
using Block = std::span<Stmt *>;

enum class AssignOp : std::uint8_t { assign, set, reset, reference };

/// `a := b`, `a := b := c`, `a S= b`, `a R= b`, `a REF= b`
struct AssignStmt : Node<Stmt, StmtKind::assign> {
  AssignOp op = AssignOp::assign;
  Span opSpan;
  std::span<Expr *> targets; ///< from left to right; the value goes to the last first
  Expr *value = nullptr;
};

/// A call as a statement. `expr` is a CallExpr (sema reports anything else).
struct CallStmt : Node<Stmt, StmtKind::call> {
  Expr *expr = nullptr;
};

struct IfBranch {
  Expr *condition = nullptr;
  Block body;
};

struct IfStmt : Node<Stmt, StmtKind::ifS> {
  std::span<IfBranch> branches; ///< IF, then each ELSIF
  bool hasElse = false;
  Block elseBody;
};

/// `1`, `1..5`, `color.green`
struct CaseLabel {
  Expr *low = nullptr;
  Expr *high = nullptr; ///< null: one value
  Span span;
};

struct CaseBranch {
  std::span<CaseLabel> labels;
  Block body;
};

struct CaseStmt : Node<Stmt, StmtKind::caseS> {
  Expr *selector = nullptr;
  std::span<CaseBranch> branches;
  bool hasElse = false;
  Block elseBody;
};

struct ForStmt : Node<Stmt, StmtKind::forS> {
  Expr *variable = nullptr;
  Expr *from = nullptr;
  Expr *to = nullptr;
  Expr *by = nullptr; ///< null: 1
  Block body;
};

struct WhileStmt : Node<Stmt, StmtKind::whileS> {
  Expr *condition = nullptr;
  Block body;
};

struct RepeatStmt : Node<Stmt, StmtKind::repeatS> {
  Block body;
  Expr *until = nullptr;
};

/// `JMP name;`
struct JumpStmt : Node<Stmt, StmtKind::jump> {
  Name label;
  struct LabelStmt *target = nullptr; ///< [sema]
};

/// `name:` in front of a statement.
struct LabelStmt : Node<Stmt, StmtKind::label> {
  Name label;
  bool used = false; ///< [sema] some JMP leads here
};

/// `__TRY … __CATCH (exc) … __FINALLY … __ENDTRY`
struct TryStmt : Node<Stmt, StmtKind::tryS> {
  Block body;
  bool hasCatch = false;
  Expr *exception = nullptr; ///< the variable in parentheses; null: none
  Block catchBody;
  bool hasFinally = false;
  Block finallyBody;
};

// ---------------------------------------------------------------------------------------------------
// declarations

enum class Section : std::uint8_t {
  local,    ///< VAR
  input,    ///< VAR_INPUT
  output,   ///< VAR_OUTPUT
  inOut,    ///< VAR_IN_OUT
  temp,     ///< VAR_TEMP
  stat,     ///< VAR_STAT
  external, ///< VAR_EXTERNAL
  global,   ///< VAR_GLOBAL
  config,   ///< VAR_CONFIG
  access,   ///< VAR_ACCESS
  instance, ///< VAR_INST: of a METHOD, kept in the block's instance
};

enum Qualifier : std::uint8_t {
  qualConstant = 1,
  qualRetain = 2,
  qualPersistent = 4,
  qualNonRetain = 8,
};

enum class Access : std::uint8_t { none, publicA, privateA, protectedA, internalA };

/// One declared variable (`a, b : INT` gives two, sharing type and init).
struct VarDecl {
  Name name;
  Section section = Section::local;
  std::uint8_t qualifiers = 0; ///< Qualifier bits
  TypeExpr *type = nullptr;
  Expr *init = nullptr;
  DirectAddress *address = nullptr; ///< of an AT clause; null: none
  Expr *path =
      nullptr; ///< VAR_CONFIG, VAR_ACCESS: the variable that is meant (`Main.fb.x`, `%IX0.0`)
  bool readOnly = false;        ///< VAR_ACCESS: READ_ONLY
  bool readWrite = false;       ///< VAR_ACCESS: READ_WRITE
  Access access = Access::none; ///< `VAR PUBLIC`
  Attributes attributes;
  std::string_view doc;        ///< text of the `///` lines above
  VarSymbol *symbol = nullptr; ///< [sema]
};

enum class DeclKind : std::uint8_t {
  program,
  function,
  functionBlock,
  classD,    ///< CLASS: a function block without body
  interface, ///< INTERFACE: methods and properties without bodies
  method,    ///< only inside of a block, class, interface or program
  action,    ///< only inside of a block or program
  property,  ///< only inside of a block, class or interface
  structure, ///< STRUCT, UNION
  enumeration,
  alias,
  globals,
  config,        ///< VAR_CONFIG outside of everything
  access,        ///< VAR_ACCESS outside of everything
  configuration, ///< CONFIGURATION … END_CONFIGURATION
};

/// Bits of Decl::modifiers.
enum Modifier : std::uint8_t { modAbstract = 1, modFinal = 2, modOverride = 4 };

struct Decl {
  DeclKind kind = DeclKind::program;
  Name name; ///< globals: empty unless the file names the list
  Span span;
  Attributes attributes;
  std::string_view doc;
  Access access = Access::none;
  std::uint8_t modifiers = 0; ///< Modifier bits
  NamePath space;             ///< the NAMESPACE around it; empty: none
  std::span<NamePath> usings; ///< USING directives that hold here
};

struct PropertyDecl;

/// PROGRAM, FUNCTION, FUNCTION_BLOCK, CLASS, INTERFACE, METHOD, ACTION, and the GET and SET of a
/// property (a method without parameters, with a result; with the one input named as the property).
struct PouDecl : Node<Decl, DeclKind::program, DeclKind::function, DeclKind::functionBlock,
                      DeclKind::classD, DeclKind::interface, DeclKind::method, DeclKind::action> {
  std::span<VarDecl *> variables; ///< of all sections in the order of the text
  TypeExpr *returnType = nullptr; ///< FUNCTION, METHOD; null: none
  Block body;
  bool external = false;          ///< `{external}`: the body is C++
  NamePath base;                  ///< EXTENDS of a block or class; empty: none
  std::span<NamePath> interfaces; ///< IMPLEMENTS; of an INTERFACE: EXTENDS
  std::span<PouDecl *> methods;
  std::span<PouDecl *> actions;
  std::span<PropertyDecl *> properties;
  Span endSpan; ///< of END_…; empty where the end of the file closes it
};

/// PROPERTY n : T … GET … END_GET SET … END_SET END_PROPERTY
struct PropertyDecl : Node<Decl, DeclKind::property> {
  TypeExpr *type = nullptr;
  PouDecl *get = nullptr; ///< kind method; null: write-only
  PouDecl *set = nullptr; ///< kind method; null: read-only
};

/// TYPE n : STRUCT … END_STRUCT END_TYPE, UNION … END_UNION
struct StructDecl : Node<Decl, DeclKind::structure> {
  NamePath base; ///< EXTENDS; empty: none
  bool isUnion = false;
  std::span<VarDecl *> fields;
};

/// TYPE n : (a, b, c) BYTE := a; END_TYPE
struct EnumDecl : Node<Decl, DeclKind::enumeration> {
  EnumTypeExpr *type = nullptr;
  Expr *init = nullptr;
};

/// TYPE n : INT := 5; END_TYPE, also arrays, strings, subranges, pointers
struct AliasDecl : Node<Decl, DeclKind::alias> {
  TypeExpr *type = nullptr;
  Expr *init = nullptr;
};

/// One VAR_GLOBAL, VAR_CONFIG or VAR_ACCESS block.
struct PouDecl;
struct GlobalsDecl : Node<Decl, DeclKind::globals, DeclKind::config, DeclKind::access> {
  std::span<VarDecl *> variables;
  const PouDecl *program = nullptr; ///< VAR_ACCESS: the PROGRAM that it stands in; null: none
};

/// `TASK name (SINGLE := x, INTERVAL := T#10ms, PRIORITY := 1);`
struct TaskDecl {
  Name name;
  std::span<Argument> arguments;
  Span span;
};

/// `PROGRAM name WITH task : Type (in := x, out => y);`
struct ProgramInstanceDecl {
  Name name;
  std::uint8_t qualifiers = 0; ///< RETAIN, NON_RETAIN
  Name task;                   ///< empty: none
  NamePath type;               ///< empty: the program called `name`
  std::span<Argument> arguments;
  Span span;
};

/// `RESOURCE name ON processor … END_RESOURCE`
struct ResourceDecl {
  Name name; ///< empty: the configuration has tasks and programs without a resource
  Name processor;
  std::span<TaskDecl> tasks;
  std::span<ProgramInstanceDecl> programs;
  Span span;
};

/// CONFIGURATION. Its VAR_GLOBAL, VAR_CONFIG and VAR_ACCESS blocks (its resources' too) follow as
/// declarations of their own.
struct ConfigurationDecl : Node<Decl, DeclKind::configuration> {
  std::span<ResourceDecl> resources;
};

/// A method, action (PouDecl) or property (PropertyDecl) whose block is not in its file.
struct StrayMember {
  Name owner;
  Decl *member = nullptr;
  std::uint16_t kind = 0; ///< token type of its keyword
};

/// One parsed file.
struct File {
  FileId id = 0;
  std::span<Decl *> declarations;
  std::span<StrayMember> strayMembers; ///< for attachMembers()
};

/// Downcast of a node whose kind is known: `as<CallExpr>(expr)`.
template <class T, class Base> T *as(Base *node) {
  assert(T::holds(node->kind));
  return static_cast<T *>(node);
}
template <class T, class Base> const T *as(const Base *node) {
  assert(T::holds(node->kind));
  return static_cast<const T *>(node);
}

} // namespace ast
} // namespace stc
