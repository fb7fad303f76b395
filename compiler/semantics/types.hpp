#ifndef STRIDE_COMPILER_SEMANTICS_TYPES_HPP
#define STRIDE_COMPILER_SEMANTICS_TYPES_HPP
// The type system. Types are unique: equal types are the same pointer. Aliases resolve to what they
// name.

#include "compiler/source/identifier.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace stc {

struct TypeSymbol;
struct PouSymbol;
struct VarSymbol;
struct EnumeratorSymbol;

enum class TypeKind : uint8_t {
  Error, ///< something was wrong and has been reported; silences what follows from it
  None,  ///< a FUNCTION without result
  Boolean,
  Sint,
  Int,
  Dint,
  Lint,
  Usint,
  Uint,
  Udint,
  Ulint,
  Byte,
  Word,
  Dword,
  Lword,
  Real,
  Lreal,
  Time,
  Ltime,
  Date,
  Ldate,
  Tod,
  Ltod,
  Dt,
  Ldt,
  String,
  Wstring,
  Char, ///< CHAR: one character of a STRING
  Wchar,
  Enumeration,
  Subrange,
  Array,
  OpenArray, ///< ARRAY[*], only of a VAR_IN_OUT
  Structure,
  FunctionBlock, ///< FUNCTION_BLOCK, CLASS
  Program,
  Interface, ///< INTERFACE: a variable of it stands for an instance, or for none
  Pointer,
  Reference,
  AnyInteger, ///< an integer constant whose type the context decides (literal 5, SIZEOF)
  AnyReal,    ///< a real constant whose type the context decides
};

struct Type {
  TypeKind kind;
};

/// STRING(length) / WSTRING(length)
struct StringType : Type {
  uint32_t length;
};

struct EnumType : Type {
  const Type *base;   ///< an integer or bit-string type
  TypeSymbol *symbol; ///< its declaration; for an in-line enumeration a synthesized one
  std::span<EnumeratorSymbol *> enumerators;
  bool strict = false;        ///< {attribute 'strict'}
  bool qualifiedOnly = false; ///< {attribute 'qualified_only'}, once it is declared
  EnumeratorSymbol *initial =
      nullptr;        ///< the default value (the first one unless declared otherwise)
  bool named = false; ///< {attribute 'to_string'}: TO_STRING gives the enumerator's name
};

/// An integer type with bounds, checked when assigned.
struct SubrangeType : Type {
  const Type *base;
  int64_t low;
  int64_t high;
};

/// One dimension; more dimensions are nested arrays.
struct ArrayType : Type {
  const Type *element;
  int64_t low;
  int64_t high;
  [[nodiscard]] uint64_t count() const { return static_cast<uint64_t>(high - low + 1); }
};

/// ARRAY[*, …]: the bounds are those of the caller's array.
struct OpenArrayType : Type {
  const Type *element;
  uint32_t dimensions;
  const Type *rest; ///< what one index gives: the element, or an array of the other dimensions
};

/// STRUCT or UNION
struct StructType : Type {
  TypeSymbol *symbol;
  const StructType *base = nullptr; ///< EXTENDS
  unsigned bases = 0;               ///< structures that it extends, directly or not
  std::span<VarSymbol *> fields;    ///< own fields
  unsigned pack = 0; ///< {attribute 'pack_mode'}: members are aligned to this at most; 0: naturally
  bool isUnion = false;           ///< the fields share their memory
  mutable unsigned alignment = 0; ///< alignmentOf() keeps its result here; 0: not asked for yet
};

/// FUNCTION_BLOCK, CLASS or PROGRAM as the type of its instances; INTERFACE.
struct PouType : Type {
  PouSymbol *symbol;
  unsigned pack = 0; ///< as in StructType
};

/// POINTER TO / REFERENCE TO
struct PointerType : Type {
  const Type *pointee;
};

[[nodiscard]] inline bool isError(const Type *t) { return t->kind == TypeKind::Error; }
[[nodiscard]] bool isSignedInteger(const Type *t);   ///< SINT … LINT
[[nodiscard]] bool isUnsignedInteger(const Type *t); ///< USINT … ULINT
[[nodiscard]] bool isBitString(const Type *t);       ///< BYTE … LWORD (not BOOL)
[[nodiscard]] bool
isInteger(const Type *t); ///< signed, unsigned, bit string (no enumerations, subranges)
[[nodiscard]] bool isReal(const Type *t); ///< REAL, LREAL
[[nodiscard]] bool isTimeOrDate(const Type *t);
[[nodiscard]] bool isString(const Type *t);    ///< STRING, WSTRING
[[nodiscard]] bool isCharacter(const Type *t); ///< CHAR, WCHAR
[[nodiscard]] bool isElementary(const Type *t);
[[nodiscard]] bool isUntyped(const Type *t); ///< a constant whose type the context decides
[[nodiscard]] bool
isNumber(const Type *t); ///< integer, real, subrange, enumeration, untyped constant
[[nodiscard]] bool isDuration(const Type *t); ///< TIME, LTIME
[[nodiscard]] bool isInstance(const Type *t); ///< FUNCTION_BLOCK or PROGRAM
[[nodiscard]] unsigned
bitWidth(const Type *t); ///< of numbers, bit strings, times, enumerations, subranges; 1 for BOOL
/// Subranges and enumerations give their base; others themselves.
[[nodiscard]] const Type *underlying(const Type *t);
/// ULINT or LWORD, whose values do not fit a signed 64-bit integer.
[[nodiscard]] bool isUnsigned64(const Type *t);
/// As diagnostics show it: `INT`, `ARRAY [1..3] OF REAL`, `STRING(20)`, `MC_Direction`.
[[nodiscard]] std::string typeName(const Type *t);

/// Bytes without a type: what a pointer to them points to is not checked (BYTE, SINT, USINT, VOID).
[[nodiscard]] bool isByteView(const Type *pointee);

/// What one index of a value of the type gives: an array's element, a string's character (BYTE,
/// WORD), what lies behind a pointer; references are followed. Null when it cannot be indexed.
[[nodiscard]] const Type *indexStep(const Type *type);

template <class T> const T *typeAs(const Type *t) { return static_cast<const T *>(t); }

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_TYPES_HPP
