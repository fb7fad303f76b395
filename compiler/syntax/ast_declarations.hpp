#ifndef STRIDE_COMPILER_SYNTAX_AST_DECLARATIONS_HPP
#define STRIDE_COMPILER_SYNTAX_AST_DECLARATIONS_HPP
// Types as they are written, and declarations.

#include "compiler/syntax/ast_statements.hpp"

namespace stc::ast {

enum class TypeExprKind : uint8_t {
  Named,
  Array,
  String,
  Pointer,
  Reference,
  Subrange,
  Enumeration,
  Inferred, ///< of the current result of an instruction list: the type of its first value
  Error
};

struct TypeExpr {
  TypeExprKind kind = TypeExprKind::Error;
  Span span;
};

/// `INT`, `Lib.Type`, `Block(a := 1)` with arguments for FB_Init
struct NamedTypeExpr : Node<TypeExpr, TypeExprKind::Named> {
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

struct ArrayTypeExpr : Node<TypeExpr, TypeExprKind::Array> {
  std::span<ArrayRange> ranges;
  TypeExpr *element = nullptr;
};

/// STRING, STRING(n), STRING[n], WSTRING…
struct StringTypeExpr : Node<TypeExpr, TypeExprKind::String> {
  bool wide = false;
  Expr *length = nullptr; ///< null: 80
};

/// POINTER TO / REFERENCE TO / REF_TO
struct PointerTypeExpr : Node<TypeExpr, TypeExprKind::Pointer, TypeExprKind::Reference> {
  TypeExpr *pointee = nullptr;
  bool refTo =
      false; ///< edition 3's REF_TO: a pointer that is only assigned, compared and followed
};

/// `INT(0..10)`
struct SubrangeTypeExpr : Node<TypeExpr, TypeExprKind::Subrange> {
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
struct EnumTypeExpr : Node<TypeExpr, TypeExprKind::Enumeration> {
  std::span<EnumeratorDecl> enumerators;
  TypeExpr *base = nullptr; ///< null: INT
};

enum class Section : uint8_t {
  Local,    ///< VAR
  Input,    ///< VAR_INPUT
  Output,   ///< VAR_OUTPUT
  InOut,    ///< VAR_IN_OUT
  Temp,     ///< VAR_TEMP
  Stat,     ///< VAR_STAT
  External, ///< VAR_EXTERNAL
  Global,   ///< VAR_GLOBAL
  Config,   ///< VAR_CONFIG
  Access,   ///< VAR_ACCESS
  Instance, ///< VAR_INST: of a METHOD, kept in the block's instance
};

enum Qualifier : uint8_t {
  kQualConstant = 1,
  kQualRetain = 2,
  kQualPersistent = 4,
  kQualNonRetain = 8,
};

enum class Access : uint8_t { None, Public, Private, Protected, Internal };

/// What an input is TRUE for in the block's body: that it has become TRUE, or FALSE.
enum class Edge : uint8_t { None, Rising, Falling };

/// One declared variable (`a, b : INT` gives two, sharing type and init).
struct VarDecl {
  Name name;
  Section section = Section::Local;
  uint8_t qualifiers = 0; ///< Qualifier bits
  TypeExpr *type = nullptr;
  Expr *init = nullptr;
  DirectAddress *address = nullptr; ///< of an AT clause; null: none
  Expr *path =
      nullptr; ///< VAR_CONFIG, VAR_ACCESS: the variable that is meant (`Main.fb.x`, `%IX0.0`)
  bool readOnly = false;        ///< VAR_ACCESS: READ_ONLY
  bool readWrite = false;       ///< VAR_ACCESS: READ_WRITE
  Access access = Access::None; ///< `VAR PUBLIC`
  Edge edge = Edge::None;       ///< `x : BOOL R_EDGE`
  VarDecl *lastCall = nullptr;  ///< of an edge: the variable with the value of the last call
  Attributes attributes;
  std::string_view doc;        ///< text of the `///` lines above
  VarSymbol *symbol = nullptr; ///< [sema]
};

enum class DeclKind : uint8_t {
  Program,
  Function,
  FunctionBlock,
  Class,     ///< CLASS: a function block without body
  Interface, ///< INTERFACE: methods and properties without bodies
  Method,    ///< only inside of a block, class, interface or program
  Action,    ///< only inside of a block or program
  Property,  ///< only inside of a block, class or interface
  Structure, ///< STRUCT, UNION
  Enumeration,
  Alias,
  Globals,
  Config,        ///< VAR_CONFIG outside of everything
  Access,        ///< VAR_ACCESS outside of everything
  Configuration, ///< CONFIGURATION … END_CONFIGURATION
};

/// Bits of Decl::modifiers.
enum Modifier : uint8_t { kModAbstract = 1, kModFinal = 2, kModOverride = 4 };

struct Decl {
  DeclKind kind = DeclKind::Program;
  Name name; ///< globals: empty unless the file names the list
  Span span;
  Attributes attributes;
  std::string_view doc;
  Access access = Access::None;
  uint8_t modifiers = 0;      ///< Modifier bits
  NamePath space;             ///< the NAMESPACE around it; empty: none
  std::span<NamePath> usings; ///< USING directives that hold here
};

struct PropertyDecl;

/// PROGRAM, FUNCTION, FUNCTION_BLOCK, CLASS, INTERFACE, METHOD, ACTION, and the GET and SET of a
/// property (a method without parameters, with a result; with the one input named as the property).
struct PouDecl : Node<Decl, DeclKind::Program, DeclKind::Function, DeclKind::FunctionBlock,
                      DeclKind::Class, DeclKind::Interface, DeclKind::Method, DeclKind::Action> {
  std::span<VarDecl *> variables; ///< of all sections in the order of the text
  TypeExpr *returnType = nullptr; ///< FUNCTION, METHOD; null: none
  Block body;
  bool external = false;          ///< `{external}`: the body is C++
  bool hasGenerics = false;       ///< it has generic constants, which are not read (reported)
  NamePath base;                  ///< EXTENDS of a block or class; empty: none
  std::span<NamePath> interfaces; ///< IMPLEMENTS; of an INTERFACE: EXTENDS
  std::span<PouDecl *> methods;
  std::span<PouDecl *> actions;
  std::span<PropertyDecl *> properties;
  Span endSpan; ///< of END_…; empty where the end of the file closes it
};

/// PROPERTY n : T … GET … END_GET SET … END_SET END_PROPERTY
struct PropertyDecl : Node<Decl, DeclKind::Property> {
  TypeExpr *type = nullptr;
  PouDecl *get = nullptr; ///< kind method; null: write-only
  PouDecl *set = nullptr; ///< kind method; null: read-only
};

/// TYPE n : STRUCT … END_STRUCT END_TYPE, UNION … END_UNION
struct StructDecl : Node<Decl, DeclKind::Structure> {
  NamePath base; ///< EXTENDS; empty: none
  bool isUnion = false;
  std::span<VarDecl *> fields;
};

/// TYPE n : (a, b, c) BYTE := a; END_TYPE
struct EnumDecl : Node<Decl, DeclKind::Enumeration> {
  EnumTypeExpr *type = nullptr;
  Expr *init = nullptr;
};

/// TYPE n : INT := 5; END_TYPE, also arrays, strings, subranges, pointers
struct AliasDecl : Node<Decl, DeclKind::Alias> {
  TypeExpr *type = nullptr;
  Expr *init = nullptr;
};

/// One VAR_GLOBAL, VAR_CONFIG or VAR_ACCESS block.
struct PouDecl;
struct GlobalsDecl : Node<Decl, DeclKind::Globals, DeclKind::Config, DeclKind::Access> {
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
  uint8_t qualifiers = 0; ///< RETAIN, NON_RETAIN
  Name task;              ///< empty: none
  NamePath type;          ///< empty: the program called `name`
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
struct ConfigurationDecl : Node<Decl, DeclKind::Configuration> {
  std::span<ResourceDecl> resources;
};

/// A method, action (PouDecl) or property (PropertyDecl) whose block is not in its file.
struct StrayMember {
  Name owner;
  Decl *member = nullptr;
  uint16_t kind = 0; ///< token type of its keyword
};

/// One parsed file.
struct File {
  FileId id = 0;
  std::span<Decl *> declarations;
  std::span<StrayMember> strayMembers; ///< for attachMembers()
  bool hasInstructions = false;        ///< some body is an instruction list
  bool hasChart = false;               ///< some body is a sequential function chart
};

} // namespace stc::ast

#endif // STRIDE_COMPILER_SYNTAX_AST_DECLARATIONS_HPP
