// The elementary types of IEC 61131-3 as generated code sees them.
//
// This header and everything it includes is free of the C++ standard library: generated sources
// include it in every translation unit, and the budget for all of it is 3,000 preprocessed lines.
#ifndef STRIDE_RUNTIME_IEC_TYPES_H
#define STRIDE_RUNTIME_IEC_TYPES_H

#include <stddef.h>
#include <stdint.h>

namespace stride {

/// Boolean, one byte, always 0 or 1.
using BOOL = uint8_t;
using SINT = int8_t;
using INT = int16_t;
using DINT = int32_t;
using LINT = int64_t;
using USINT = uint8_t;
using UINT = uint16_t;
using UDINT = uint32_t;
using ULINT = uint64_t;
using BYTE = uint8_t;
using WORD = uint16_t;
using DWORD = uint32_t;
using LWORD = uint64_t;
/// One character of a STRING (Latin-1), of a WSTRING (UTF-16).
using CHAR = uint8_t;
using WCHAR = uint16_t;
using REAL = float;
using LREAL = double;
/// Duration in milliseconds, wraps after 49.7 days.
using TIME = uint32_t;
/// Duration in nanoseconds.
using LTIME = int64_t;
/// Seconds since 1970-01-01, always a multiple of a day.
using DATE = uint32_t;
/// Seconds since 1970-01-01.
using DT = uint32_t;
/// Milliseconds since midnight.
using TOD = uint32_t;
/// Nanoseconds since 1970-01-01 (LDATE: a multiple of a day), since midnight (LTOD).
using LDATE = int64_t;
using LDT = int64_t;
using LTOD = int64_t;
/// Address-sized integers: pointers have 64 bits on every target.
using XWORD = uint64_t;
using XINT = int64_t;
using UXINT = uint64_t;

static_assert(sizeof(REAL) == 4 && sizeof(LREAL) == 8, "IEEE 754 binary32 and binary64");
static_assert(sizeof(void *) == 8, "Stride's applications are 64-bit");

/// STRING(N): at most N Latin-1 characters, NUL-terminated, no stored length.
template <uint32_t N> struct STRING {
  static constexpr uint32_t kLength = N;
  char s[size_t{N} + 1];
};

/// WSTRING(N): at most N UTF-16 code units, NUL-terminated.
template <uint32_t N> struct WSTRING {
  static constexpr uint32_t kLength = N;
  char16_t s[size_t{N} + 1];
};

/// One dimension of an ARRAY[Lo..Hi] OF T; further dimensions nest in T.
template <class T, int64_t Lo, int64_t Hi> struct Array {
  static_assert(Lo <= Hi, "an array has at least one element");
  static constexpr int64_t kLo = Lo;
  static constexpr int64_t kHi = Hi;
  static constexpr uint64_t kSize =
      static_cast<uint64_t>(Hi) - static_cast<uint64_t>(Lo) + uint64_t{1};
  T v[kSize];
};

/// A variable of an interface type: points to the type id (`type__`) of an instance; null: none.
using Interface = UDINT *;

/// The kinds of types that exist at run time. The values are part of the application ABI.
/// The elementary kinds also select conversions (see convert.h), because several ST types share
/// one C++ type (BOOL, USINT and BYTE; UDINT, TIME and DATE).
enum class Kind : uint32_t {
  None = 0,
  BOOL = 1,
  SINT = 2,
  INT = 3,
  DINT = 4,
  LINT = 5,
  USINT = 6,
  UINT = 7,
  UDINT = 8,
  ULINT = 9,
  BYTE = 10,
  WORD = 11,
  DWORD = 12,
  LWORD = 13,
  REAL = 14,
  LREAL = 15,
  TIME = 16,
  LTIME = 17,
  DATE = 18,
  LDATE = 19,
  TOD = 20,
  LTOD = 21,
  DT = 22,
  LDT = 23,
  STRING = 24,
  WSTRING = 25,
  CHAR = 26,
  WCHAR = 27,
  Enum = 32,
  Struct = 33,
  Union = 34,
  FunctionBlock = 35,
  Program = 36,
  Array = 37,
  Pointer = 40,   ///< POINTER TO: an address slot.
  Reference = 41, ///< REFERENCE TO: an address slot.
  InOut = 42,     ///< VAR_IN_OUT of an instance: an address slot bound at each call.
  Interface = 43, ///< An interface variable: an address slot.
};

} // namespace stride

#endif
