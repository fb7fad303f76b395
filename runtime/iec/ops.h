// Operators of ST on elementary values, and the checks that generated code makes.
// Free of the C++ standard library; see types.h. This is the one header a generated body includes
// besides the layouts it uses: it brings convert.h, strings.h, text.h and math.h along.
#ifndef STRIDE_RUNTIME_IEC_OPS_H
#define STRIDE_RUNTIME_IEC_OPS_H

#include "runtime/iec/consistent.h"
#include "runtime/iec/convert.h"
#include "runtime/iec/ctx.h"
#include "runtime/iec/data_stack.h"
#include "runtime/iec/edge.h"
#include "runtime/iec/image.h"
#include "runtime/iec/math.h"
#include "runtime/iec/memory.h"
#include "runtime/iec/open_array.h"
#include "runtime/iec/pool.h"
#include "runtime/iec/shared.h"
#include "runtime/iec/strings.h"
#include "runtime/iec/text.h"
#include "runtime/iec/types.h"

namespace stride {

// --- integer arithmetic: two's complement, wrapping in T whatever the compiler flags ------------

template <class T> constexpr T wrapAdd(T a, T b) {
  T r{};
  __builtin_add_overflow(a, b, &r);
  return r;
}
template <class T> constexpr T wrapSub(T a, T b) {
  T r{};
  __builtin_sub_overflow(a, b, &r);
  return r;
}
template <class T> constexpr T wrapMul(T a, T b) {
  T r{};
  __builtin_mul_overflow(a, b, &r);
  return r;
}
template <class T> constexpr T wrapNeg(T a) { return wrapSub(static_cast<T>(0), a); }

/// a / b for b <> 0, towards zero; MIN / -1 = MIN.
template <class T> constexpr T quotient(T a, T b) {
  if constexpr (detail::Number<T>::kSigned) {
    if (b == static_cast<T>(-1))
      return wrapNeg(a);
  }
  return static_cast<T>(a / b);
}
/// a MOD b for b <> 0: the sign of a; MIN MOD -1 = 0.
template <class T> constexpr T remainder(T a, T b) {
  if constexpr (detail::Number<T>::kSigned) {
    if (b == static_cast<T>(-1))
      return 0;
  }
  return static_cast<T>(a % b);
}

/// Integer a / b; raises DivisionByZero at the position.
template <class T, class C>
constexpr T divide(C &ctx, T a, T b, const char *file, uint32_t line, uint32_t col) {
  if (b == 0) [[unlikely]]
    raise(ctx, ExceptionCode::DivisionByZero, file, line, col);
  return quotient(a, b);
}
/// Integer a MOD b; raises DivisionByZero at the position.
template <class T, class C>
constexpr T modulo(C &ctx, T a, T b, const char *file, uint32_t line, uint32_t col) {
  if (b == 0) [[unlikely]]
    raise(ctx, ExceptionCode::DivisionByZero, file, line, col);
  return remainder(a, b);
}

/// EXPT with an integer base and a non-negative integer exponent, wrapping; a negative exponent
/// gives the truncated 1 / a^n (0 for |a| > 1 and for a = 0).
template <class T> constexpr T power(T a, int64_t n) {
  if (n < 0) {
    if (a == static_cast<T>(1))
      return 1;
    if constexpr (detail::Number<T>::kSigned) {
      if (a == static_cast<T>(-1))
        return static_cast<T>((n & 1) != 0 ? -1 : 1);
    }
    return 0;
  }
  T result = 1;
  for (; n > 0; n >>= 1) {
    if ((n & 1) != 0)
      result = wrapMul(result, a);
    a = wrapMul(a, a);
  }
  return result;
}

// --- shifts: in the width of T, any count
// ---------------------------------------------------------

namespace detail {
template <class T> struct UnsignedOf { using Type = T; };
template <> struct UnsignedOf<int8_t> { using Type = uint8_t; };
template <> struct UnsignedOf<int16_t> { using Type = uint16_t; };
template <> struct UnsignedOf<int32_t> { using Type = uint32_t; };
template <> struct UnsignedOf<int64_t> { using Type = uint64_t; };
template <class T> using Unsigned = typename UnsignedOf<T>::Type;
template <class T> inline constexpr uint64_t kBits = sizeof(T) * 8;
} // namespace detail

/// SHL: zeros come in; a count of the width or more (or a negative one) gives 0.
template <class T, class N> constexpr T shl(T x, N count) {
  const uint64_t n = static_cast<uint64_t>(count);
  if (n >= detail::kBits<T>)
    return 0;
  return static_cast<T>(static_cast<uint64_t>(x) << n);
}
/// SHR: zeros come in, for signed types copies of the sign; a count of the width or more (or a
/// negative one) shifts everything out.
template <class T, class N> constexpr T shr(T x, N count) {
  const uint64_t n = static_cast<uint64_t>(count);
  if (n >= detail::kBits<T>)
    return static_cast<T>(x < 0 ? -1 : 0);
  return static_cast<T>(x >> n);
}
/// ROL, ROR: rotation in the width of T, the count modulo that width.
template <class T, class N> constexpr T rol(T x, N count) {
  using U = detail::Unsigned<T>;
  const uint64_t n = static_cast<uint64_t>(count) % detail::kBits<T>;
  const U u = static_cast<U>(x);
  if (n == 0)
    return x;
  return static_cast<T>(
      static_cast<U>((uint64_t{u} << n) | (uint64_t{u} >> (detail::kBits<T> - n))));
}
template <class T, class N> constexpr T ror(T x, N count) {
  const uint64_t n = static_cast<uint64_t>(count) % detail::kBits<T>;
  return rol(x, (detail::kBits<T> - n) % detail::kBits<T>);
}

// --- bits ---------------------------------------------------------------------------------------

/// Bit n of an integer or bit string as a BOOL; n is within the width (checked by the compiler).
template <class T> constexpr BOOL getBit(T x, uint32_t n) {
  return static_cast<BOOL>((static_cast<uint64_t>(x) >> n) & 1U);
}
/// Sets or clears bit n of a variable.
template <class T> constexpr void setBit(T &x, uint32_t n, BOOL value) {
  const uint64_t mask = uint64_t{1} << n;
  const uint64_t old = static_cast<uint64_t>(x);
  x = static_cast<T>(value != 0 ? old | mask : old & ~mask);
}

/// Part n of a variable, a T of its width: `w.%B1`.
template <class T, class V> constexpr T getPart(V x, uint32_t n) {
  return static_cast<T>(static_cast<uint64_t>(x) >> (n * sizeof(T) * 8));
}
template <class T, class V> constexpr void setPart(V &x, uint32_t n, T value) {
  const uint64_t shift = uint64_t{n} * sizeof(T) * 8;
  const uint64_t mask = uint64_t{static_cast<T>(~T{})} << shift;
  x = static_cast<V>((static_cast<uint64_t>(x) & ~mask) | (uint64_t{value} << shift));
}

// --- selection ----------------------------------------------------------------------------------

/// ABS; of the smallest signed value: that value.
template <class T> constexpr T abs(T x) {
  if constexpr (detail::Number<T>::kReal) {
    return x < 0 ? -x : (x == 0 ? static_cast<T>(0) : x);
  } else if constexpr (detail::Number<T>::kSigned) {
    return x < 0 ? wrapNeg(x) : x;
  } else {
    return x;
  }
}
template <class T> constexpr T min(T a, T b) { return b < a ? b : a; }
template <class T> constexpr T max(T a, T b) { return a < b ? b : a; }
/// LIMIT(lo, x, hi).
template <class T> constexpr T limit(T lo, T x, T hi) { return min(max(x, lo), hi); }
/// SEL(g, a, b): a when g is FALSE. Both were evaluated.
template <class T> constexpr T sel(BOOL g, T a, T b) { return g != 0 ? b : a; }

/// MIN and MAX of strings, by comparison of code units.
template <class S> inline S minText(const S &a, const S &b) { return compare(b, a) < 0 ? b : a; }
template <class S> inline S maxText(const S &a, const S &b) { return compare(a, b) < 0 ? b : a; }

// --- comparisons of more than two values: GT(a, b, c) -------------------------------------------

template <class F, class A, class B> constexpr bool inOrder(F order, const A &a, const B &b) {
  return order(a, b);
}
/// Each value stands in the relation to the next one.
template <class F, class A, class B, class... R>
constexpr bool inOrder(F order, const A &a, const B &b, const R &...rest) {
  return order(a, b) && inOrder(order, b, rest...);
}

// --- decimal digits and byte order --------------------------------------------------------------

/// IS_VALID: neither NaN nor infinite.
template <class R, class T> constexpr R isValid(T x) { return static_cast<R>(x - x == 0); }
/// IS_VALID_BCD: every group of four bits is a decimal digit.
template <class R, class T> constexpr R isValidBcd(T x) {
  for (uint64_t rest = x; rest != 0; rest >>= 4U) {
    if ((rest & 15U) > 9)
      return 0;
  }
  return 1;
}
/// BCD_TO_Y: the number that the digits are, 0 when one of them is none; wraps to the type.
template <class T> constexpr T fromBcd(uint64_t digits) {
  if (!isValidBcd<bool>(digits))
    return 0;
  uint64_t value = 0;
  for (int shift = 60; shift >= 0; shift -= 4)
    value = value * 10 + (digits >> shift & 15U);
  return static_cast<T>(value);
}
/// TO_BCD_Y: the last digits of the number, as many as there is room for.
template <class T> constexpr T toBcd(uint64_t value) {
  uint64_t digits = 0;
  for (unsigned shift = 0; shift < sizeof(T) * 8; shift += 4, value /= 10)
    digits |= value % 10 << shift;
  return static_cast<T>(digits);
}
/// The bytes in the opposite order: between the little-endian order of every target and the other.
template <class T> constexpr T swapBytes(T x) {
  if constexpr (sizeof(T) == 1)
    return x;
  else if constexpr (sizeof(T) == 2)
    return __builtin_bit_cast(T, __builtin_bswap16(__builtin_bit_cast(uint16_t, x)));
  else if constexpr (sizeof(T) == 4)
    return __builtin_bit_cast(T, __builtin_bswap32(__builtin_bit_cast(uint32_t, x)));
  else
    return __builtin_bit_cast(T, __builtin_bswap64(__builtin_bit_cast(uint64_t, x)));
}

// --- FOR ----------------------------------------------------------------------------------------
// The variable moves by the step and wraps; the result says whether the loop goes on. The distance
// to the end is compared before the step, so that loops end at the limits of the type as well.

template <class T> constexpr bool forUp(T &i, T end, ULINT step) {
  const bool more = i <= end && static_cast<ULINT>(end) - static_cast<ULINT>(i) >= step;
  i = static_cast<T>(static_cast<ULINT>(i) + step);
  return more;
}
template <class T> constexpr bool forDown(T &i, T end, ULINT step) {
  const bool more = i >= end && static_cast<ULINT>(i) - static_cast<ULINT>(end) >= step;
  i = static_cast<T>(static_cast<ULINT>(i) - step);
  return more;
}
/// The same for a step of 1.
template <class T> constexpr bool forUp(T &i, T end) {
  const bool more = i < end;
  ++i;
  return more;
}
template <class T> constexpr bool forDown(T &i, T end) {
  const bool more = i > end;
  --i;
  return more;
}
/// For a step known at run time only. A step of 0 goes on until the loop budget ends it.
template <class T> constexpr bool forFirst(T i, T end, LINT step) {
  return step < 0 ? i >= end : i <= end;
}
template <class T> constexpr bool forNext(T &i, T end, LINT step) {
  return step < 0 ? forDown(i, end, ULINT{0} - static_cast<ULINT>(step))
                  : forUp(i, end, static_cast<ULINT>(step));
}

/// How often a loop runs that counts from `at` by the step and ends where `stop` is reached or
/// passed; the step is not 0.
constexpr DINT roundsTo(DINT at, DINT stop, DINT step) {
  if (step > 0)
    return at < stop ? (stop - 1 - at) / step + 1 : 0;
  return at > stop ? (at - stop - 1) / -step + 1 : 0;
}

/// The same real, of which the compiler does not know that it lies beside another one.
template <class T> __attribute__((always_inline)) inline T single(T value) {
#if defined(__x86_64__)
  __asm__("" : "+x"(value));
#elif defined(__aarch64__)
  __asm__("" : "+w"(value));
#endif
  return value;
}

// --- checks -------------------------------------------------------------------------------------
// The context is a Ctx or a LoopContext.

/// Zero-based place of index i in bounds Lo..Hi; raises IndexOutOfRange at the position.
template <int64_t Lo, int64_t Hi, class C, class I>
constexpr uint64_t index(C &ctx, I i, const char *file, uint32_t line, uint32_t col) {
  constexpr uint64_t kSpan = static_cast<uint64_t>(Hi) - static_cast<uint64_t>(Lo);
  const uint64_t place = static_cast<uint64_t>(static_cast<int64_t>(i)) - static_cast<uint64_t>(Lo);
  bool bad = place > kSpan;
  if constexpr (sizeof(I) == 8 && !detail::Number<I>::kSigned)
    bad = bad || i > static_cast<uint64_t>(INT64_MAX);
  if (bad) [[unlikely]]
    raiseIndex(ctx, static_cast<int64_t>(i), Lo, Hi, file, line, col);
  return place;
}
/// As above for bounds known at run time only (ARRAY[*]).
template <class C, class I>
constexpr uint64_t index(C &ctx, I i, int64_t lo, int64_t hi, const char *file, uint32_t line,
                         uint32_t col) {
  const uint64_t place = static_cast<uint64_t>(static_cast<int64_t>(i)) - static_cast<uint64_t>(lo);
  if (hi < lo || place > static_cast<uint64_t>(hi) - static_cast<uint64_t>(lo)) [[unlikely]]
    raiseIndex(ctx, static_cast<int64_t>(i), lo, hi, file, line, col);
  return place;
}
/// Zero-based place without a check (--unchecked).
template <int64_t Lo, class I> constexpr uint64_t place(I i) {
  return static_cast<uint64_t>(static_cast<int64_t>(i)) - static_cast<uint64_t>(Lo);
}

/// The object behind a POINTER TO or REFERENCE TO; raises NullPointer (or AccessViolation, for the
/// addresses after 0 that are nobody's) at the position.
template <class C, class T>
inline T &deref(C &ctx, T *p, const char *file, uint32_t line, uint32_t col) {
  if (detail::addressOf(p) < detail::kFirstAddress) [[unlikely]]
    raisePointer(ctx, p, file, line, col);
  return *p;
}
/// The actual of a VAR_IN_OUT; raises UnboundInOut at the position.
template <class C, class T>
constexpr T &bound(C &ctx, T *p, const char *file, uint32_t line, uint32_t col) {
  if (p == nullptr) [[unlikely]]
    raise(ctx, ExceptionCode::UnboundInOut, file, line, col);
  return *p;
}

/// The instance behind an interface; raises NullPointer at the position.
constexpr Interface used(Ctx &ctx, Interface i, const char *file, uint32_t line, uint32_t col) {
  if (i == nullptr) [[unlikely]]
    raise(ctx, ExceptionCode::NullPointer, file, line, col);
  return i;
}

/// Runs something when a call ends: FB_Exit of an instance that lives as long as the call.
template <class F> struct AtEnd {
  F run;
  ~AtEnd() { run(); }
};
template <class F> AtEnd(F) -> AtEnd<F>;

/// A value on its way into a subrange type Lo..Hi; raises RangeViolation at the position.
template <int64_t Lo, int64_t Hi, class C, class T>
constexpr T subrange(C &ctx, T value, const char *file, uint32_t line, uint32_t col) {
  const int64_t v = static_cast<int64_t>(value);
  bool bad = v < Lo || v > Hi;
  if constexpr (sizeof(T) == 8 && !detail::Number<T>::kSigned)
    bad = bad || value > static_cast<uint64_t>(INT64_MAX);
  if (bad) [[unlikely]]
    raiseRange(ctx, v, Lo, Hi, file, line, col);
  return value;
}

} // namespace stride

#endif
