#pragma once
// Types as they are written, and declarations.

#include "compiler/syntax/ast_statements.hpp"

namespace stc::ast {

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

} // namespace stc::ast
