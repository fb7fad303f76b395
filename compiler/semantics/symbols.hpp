#ifndef STRIDE_COMPILER_SEMANTICS_SYMBOLS_HPP
#define STRIDE_COMPILER_SEMANTICS_SYMBOLS_HPP
// What names stand for.

#include "compiler/semantics/any_inputs.hpp"
#include "compiler/semantics/constant.hpp"
#include "compiler/semantics/types.hpp"
#include "compiler/syntax/ast.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stc {

enum class SymbolKind : uint8_t {
  Variable,
  Pou,
  Type,
  Enumerator,
  Builtin,
  Library,
  Globals,
  Property,
  Self, ///< THIS, SUPER
  Space,
};

/// A library, or the user's project (whose name is empty).
struct Library;
struct NamespaceSymbol;

struct Symbol {
  SymbolKind kind;
  ast::Name name;                   ///< as declared
  Library *library = nullptr;       ///< where it is declared
  NamespaceSymbol *space = nullptr; ///< the NAMESPACE it is declared in; null: none
};

/// The areas of the process image.
enum class Area : uint8_t { Input, Output, Memory };

/// Where a located variable or a direct address lies in the process image.
struct Location {
  Area area = Area::Memory;
  uint32_t byte = 0;   ///< within the area
  int8_t bit = -1;     ///< of that byte; -1: the variable begins with the byte
  bool isSlot = false; ///< `%I*`: each instance has a slot that holds its place (VAR_CONFIG); then
                       ///< bit >= 0 says that it is a single bit
};

/// Bits of VarSymbol::uses.
enum Use : uint8_t {
  kUseRead = 1,
  kUseWritten = 2,
  kUseAddress = 4, ///< ADR, REF=, passed to a VAR_IN_OUT: anything may happen to it
  kUseCalled = 8,  ///< an instance is called
};

/// A variable, parameter or structure field.
struct VarSymbol : Symbol {
  ast::VarDecl *decl = nullptr; ///< null only for a function's result
  const Type *type = nullptr;
  const Type *common = nullptr; ///< of an inferred type: Expr::common of the value it is from
  ast::Section section = ast::Section::Local;
  PouSymbol *owner = nullptr;      ///< the POU it belongs to; null: global or structure field
  const ast::Decl *home = nullptr; ///< of a global or a field: the declaration around it
  struct GlobalsSymbol *globals = nullptr; ///< the list a global belongs to
  bool isConstant = false;
  bool hidden = false;       ///< {attribute 'hide'}
  bool isConsistent = false; ///< {attribute 'consistent'}, and it can have it
  bool isBit = false;        ///< declared as BIT: a BOOL that shares its byte with its neighbours
  bool isResult = false;     ///< the variable of a FUNCTION that holds its result
  AnyGroup any = AnyGroup::None; ///< an input declared ANY: what it takes; its type is AnyType
  const ConstValue *constant = nullptr; ///< value of a CONSTANT of elementary type
  const Location *location = nullptr;   ///< of an AT clause; null: an ordinary variable
  std::string_view storage;             ///< VAR_INST: the field's name in the instance; else empty
  bool typeRunning = false; ///< the type is being resolved: meeting it again is a circle
  bool initChecked = false; ///< the initial value has been checked (or is being checked)
  bool initRunning = false; ///< is being checked: meeting it again is a circle
  // Of the lints (lint/lint.hpp).
  uint8_t uses = 0;                     ///< bits of Use: in the POU that it belongs to
  uint8_t usesElsewhere = 0;            ///< and in others; several threads set them (atomic_ref)
  const ast::Expr *earlyRead = nullptr; ///< the first read, when nothing can have written before
  uint32_t earlyLoop = 0;               ///< the outermost loop of that read; 0: none
  uint32_t lastWrite = 0;               ///< the number of the last write
  uint32_t lintBody = 0;                ///< the body that declares it
};

struct PropertySymbol;

/// PROGRAM, FUNCTION, FUNCTION_BLOCK, CLASS, INTERFACE; METHOD, ACTION and the accessors of a
/// PROPERTY, which have an owner.
struct PouSymbol : Symbol {
  ast::PouDecl *decl = nullptr;
  const PouType *type = nullptr; ///< FUNCTION_BLOCK, CLASS, PROGRAM, INTERFACE
  VarSymbol *result = nullptr;   ///< FUNCTION, METHOD with a result
  std::span<VarSymbol *>
      variables; ///< own ones of all sections in the order of the text (VAR_EXTERNAL not included),
                 ///< then the VAR_INST of the methods
  /// Inputs, in-outs, outputs in the order of the text, those of the base first.
  std::vector<VarSymbol *> parameters() const;
  std::unordered_map<Ident, VarSymbol *> scope;
  bool declared = false;   ///< variables and types are resolved
  bool checked = false;    ///< the body has been checked
  bool isTemplate = false; ///< PROGRAM: only instances with names of their own exist
                           ///< (CONFIGURATION)

  PouSymbol *owner = nullptr;          ///< METHOD, ACTION, accessor: what it belongs to
  PropertySymbol *property = nullptr;  ///< accessor: of this
  PouSymbol *base = nullptr;           ///< EXTENDS of a block or class
  unsigned bases = 0;                  ///< length of the longest way through bases and interfaces
  std::vector<PouSymbol *> interfaces; ///< IMPLEMENTS; of an INTERFACE: EXTENDS
  std::vector<PouSymbol *> methods;    ///< own methods, actions and accessors
  std::vector<PropertySymbol *> properties;    ///< own properties
  std::unordered_map<Ident, Symbol *> members; ///< own methods, actions, properties
  PouSymbol *overrides = nullptr; ///< method: the one of the nearest base that it replaces
  bool overridden = false;        ///< method: a block of the program replaces it
  bool extended = false;          ///< a block of the program extends it
  bool lacksParts = false; ///< a base or interface that it names is none, or its head was not read
                           ///< in full (reported): what is not found may have been there
  bool linking = false;    ///< its base is being looked up: meeting it is a circle
  bool linked = false;     ///< base, interfaces and members are known

  [[nodiscard]] bool isFunction() const { return decl->kind == ast::DeclKind::Function; }
  /// METHOD, ACTION, accessor
  [[nodiscard]] bool isMethod() const { return owner != nullptr; }
  [[nodiscard]] bool isInterface() const { return decl->kind == ast::DeclKind::Interface; }
  /// FUNCTION_BLOCK, CLASS
  [[nodiscard]] bool isBlock() const {
    return decl->kind == ast::DeclKind::FunctionBlock || decl->kind == ast::DeclKind::Class;
  }
  [[nodiscard]] bool isAbstract() const { return (decl->modifiers & ast::kModAbstract) != 0; }
  [[nodiscard]] bool isFinal() const { return (decl->modifiers & ast::kModFinal) != 0; }
};

/// PROPERTY
struct PropertySymbol : Symbol {
  ast::PropertyDecl *decl = nullptr;
  PouSymbol *owner = nullptr;
  const Type *type = nullptr; ///< null until the owner is declared
  PouSymbol *get = nullptr;   ///< null: write-only
  PouSymbol *set = nullptr;   ///< null: read-only
};

/// THIS and SUPER inside of a block: pointers to it and to its base.
struct SelfSymbol : Symbol {
  PouSymbol *block = nullptr; ///< pointed to
  bool isSuper = false;
};

/// A named type: structure, enumeration, alias.
struct TypeSymbol : Symbol {
  ast::Decl *decl = nullptr;  ///< null for the elementary types
  const Type *type = nullptr; ///< what it names; null until resolved
  bool resolving = false;
  bool onDemand = false; ///< declared because the program names it: no header of the library has it
  std::unordered_map<Ident, VarSymbol *> fields; ///< structure: also inherited ones
  ast::Expr *init = nullptr;                     ///< default of an alias or enumeration
};

struct EnumeratorSymbol : Symbol {
  const EnumType *type = nullptr;
  int64_t value = 0;
};

/// A function the compiler implements itself; see builtins.hpp.
struct BuiltinSymbol : Symbol {
  ast::Builtin id{};
};

/// One VAR_GLOBAL list; `name` is the file's name without suffix (`GVL.x`), several blocks of a
/// file are one list.
struct GlobalsSymbol : Symbol {
  std::vector<VarSymbol *> variables;
  std::unordered_map<Ident, VarSymbol *> scope;
};

/// All parts of one NAMESPACE; `name` is the last of its names.
struct NamespaceSymbol : Symbol {
  std::string path; ///< `A.B`
  std::unordered_map<Ident, Symbol *> names;
  std::unordered_map<Ident, std::vector<EnumeratorSymbol *>> enumerators;
};
/// The type that the last index of `a[i, j]` reaches before a REFERENCE there is followed.
[[nodiscard]] const Type *elementBeforeReference(const ast::IndexExpr *expr);
/// A call of a function or method whose result is a REFERENCE.
[[nodiscard]] bool givesReference(const ast::Expr *expr);

/// `Standard.TON` on the left of the dot.
struct LibrarySymbol : Symbol {};

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_SYMBOLS_HPP
