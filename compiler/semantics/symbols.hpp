#pragma once
// What names stand for.

#include "compiler/semantics/constant.hpp"
#include "compiler/semantics/types.hpp"
#include "compiler/syntax/ast.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stc {

enum class SymbolKind : std::uint8_t { variable, pou, type, enumerator, builtin, library, globals };

/// A library, or the user's project (whose name is empty).
struct Library;

struct Symbol {
  SymbolKind kind;
  ast::Name name;             ///< as declared
  Library *library = nullptr; ///< where it is declared
};

/// The areas of the process image.
enum class Area : std::uint8_t { input, output, memory };

/// Where a located variable or a direct address lies in the process image.
struct Location {
  Area area = Area::memory;
  std::uint32_t byte = 0; ///< within the area
  std::int8_t bit = -1;   ///< of that byte; -1: the variable begins with the byte
  bool isSlot = false; ///< `%I*`: each instance has a slot that holds its place (VAR_CONFIG); then
                       ///< bit >= 0 says that it is a single bit
};

/// A variable, parameter or structure field.
struct VarSymbol : Symbol {
  ast::VarDecl *decl = nullptr; ///< null only for a function's result
  const Type *type = nullptr;
  ast::Section section = ast::Section::local;
  PouSymbol *owner = nullptr; ///< the POU it belongs to; null: global or structure field
  struct GlobalsSymbol *globals = nullptr; ///< the list a global belongs to
  bool isConstant = false;
  bool hidden = false;                  ///< {attribute 'hide'}
  bool isResult = false;                ///< the variable of a FUNCTION that holds its result
  const ConstValue *constant = nullptr; ///< value of a CONSTANT of elementary type
  const Location *location = nullptr;   ///< of an AT clause; null: an ordinary variable
  bool typeRunning = false; ///< the type is being resolved: meeting it again is a circle
  bool initChecked = false; ///< the initial value has been checked (or is being checked)
  bool initRunning = false; ///< is being checked: meeting it again is a circle
};

/// PROGRAM, FUNCTION, FUNCTION_BLOCK
struct PouSymbol : Symbol {
  ast::PouDecl *decl = nullptr;
  const PouType *type = nullptr; ///< FUNCTION_BLOCK, PROGRAM
  VarSymbol *result = nullptr;   ///< FUNCTION with a result
  std::span<VarSymbol *>
      variables; ///< all sections in the order of the text (VAR_EXTERNAL not included)
  std::vector<VarSymbol *>
  parameters() const; ///< inputs, in-outs, outputs in the order of the text
  std::unordered_map<Ident, VarSymbol *> scope;
  bool declared = false;   ///< variables and types are resolved
  bool checked = false;    ///< the body has been checked
  bool isTemplate = false; ///< PROGRAM: only instances with names of their own exist
                           ///< (CONFIGURATION)
  [[nodiscard]] bool isFunction() const { return decl->kind == ast::DeclKind::function; }
};

/// A named type: structure, enumeration, alias.
struct TypeSymbol : Symbol {
  ast::Decl *decl = nullptr;  ///< null for the elementary types
  const Type *type = nullptr; ///< what it names; null until resolved
  bool resolving = false;
  std::unordered_map<Ident, VarSymbol *> fields; ///< structure: also inherited ones
  ast::Expr *init = nullptr;                     ///< default of an alias or enumeration
};

struct EnumeratorSymbol : Symbol {
  const EnumType *type = nullptr;
  std::int64_t value = 0;
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

/// `Standard.TON` on the left of the dot.
struct LibrarySymbol : Symbol {};

} // namespace stc
