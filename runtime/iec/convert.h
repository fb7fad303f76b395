// Conversions between the elementary types, with the meaning of IEC's X_TO_Y functions.
// Free of the C++ standard library; see types.h.
//
// Numbers:            convert<LREAL>(i), convert<INT>(r) — the target type alone decides.
// Everything else:    convert<Kind::TIME, Kind::LTIME>(t) — both kinds, because BOOL, BYTE and
//                     USINT (or UDINT, TIME and DATE) are the same C++ type.
#ifndef STRIDE_RUNTIME_IEC_CONVERT_H
#define STRIDE_RUNTIME_IEC_CONVERT_H

#include "runtime/iec/types.h"

namespace stride {

constexpr int64_t floorDivide(int64_t a, int64_t b) { // b > 0
  const int64_t q = a / b;
  return q - (a % b < 0 ? 1 : 0);
}

namespace detail {

template <class T> struct Number {
  static constexpr bool kReal = false;
  static constexpr bool kSigned = static_cast<T>(-1) < static_cast<T>(0);
  static constexpr T kMax = kSigned ? static_cast<T>((uint64_t{1} << (sizeof(T) * 8 - 1)) - 1)
                                    : static_cast<T>(~uint64_t{0});
  static constexpr T kMin = kSigned ? static_cast<T>(static_cast<T>(-1) - kMax) : static_cast<T>(0);
};
template <> struct Number<REAL> { static constexpr bool kReal = true; };
template <> struct Number<LREAL> { static constexpr bool kReal = true; };

template <class T> constexpr T clampTo(int64_t value) {
  if constexpr (sizeof(T) == 8) {
    if constexpr (!Number<T>::kSigned) {
      if (value < 0)
        return 0;
    }
    return static_cast<T>(value);
  } else {
    if (value < static_cast<int64_t>(Number<T>::kMin))
      return Number<T>::kMin;
    if (value > static_cast<int64_t>(Number<T>::kMax))
      return Number<T>::kMax;
    return static_cast<T>(value);
  }
}

/// A real to an integer: half away from zero when kRound, else towards zero; saturates; NaN is 0.
template <class T, bool kRound> constexpr T realToInteger(LREAL x) {
  if (!(x == x))
    return 0;
  if (x >= 9223372036854775808.0) { // 2^63; such values are whole
    if constexpr (sizeof(T) == 8 && !Number<T>::kSigned) {
      return x >= 18446744073709551616.0 ? Number<T>::kMax : static_cast<T>(x);
    } else {
      return Number<T>::kMax;
    }
  }
  if (x < -9223372036854775808.0)
    return Number<T>::kMin;
  int64_t whole = static_cast<int64_t>(x);
  if constexpr (kRound) {
    const LREAL rest = x - static_cast<LREAL>(whole); // exact
    if (rest >= 0.5)
      ++whole;
    else if (rest <= -0.5)
      --whole;
  }
  return clampTo<T>(whole);
}

template <Kind K> struct KindTypeOf;
// clang-format off
template <> struct KindTypeOf<Kind::BOOL> { using Type = BOOL; };
template <> struct KindTypeOf<Kind::SINT> { using Type = SINT; };
template <> struct KindTypeOf<Kind::INT> { using Type = INT; };
template <> struct KindTypeOf<Kind::DINT> { using Type = DINT; };
template <> struct KindTypeOf<Kind::LINT> { using Type = LINT; };
template <> struct KindTypeOf<Kind::USINT> { using Type = USINT; };
template <> struct KindTypeOf<Kind::UINT> { using Type = UINT; };
template <> struct KindTypeOf<Kind::UDINT> { using Type = UDINT; };
template <> struct KindTypeOf<Kind::ULINT> { using Type = ULINT; };
template <> struct KindTypeOf<Kind::BYTE> { using Type = BYTE; };
template <> struct KindTypeOf<Kind::WORD> { using Type = WORD; };
template <> struct KindTypeOf<Kind::DWORD> { using Type = DWORD; };
template <> struct KindTypeOf<Kind::LWORD> { using Type = LWORD; };
template <> struct KindTypeOf<Kind::CHAR> { using Type = CHAR; };
template <> struct KindTypeOf<Kind::WCHAR> { using Type = WCHAR; };
template <> struct KindTypeOf<Kind::REAL> { using Type = REAL; };
template <> struct KindTypeOf<Kind::LREAL> { using Type = LREAL; };
template <> struct KindTypeOf<Kind::TIME> { using Type = TIME; };
template <> struct KindTypeOf<Kind::LTIME> { using Type = LTIME; };
template <> struct KindTypeOf<Kind::DATE> { using Type = DATE; };
template <> struct KindTypeOf<Kind::LDATE> { using Type = LDATE; };
template <> struct KindTypeOf<Kind::TOD> { using Type = TOD; };
template <> struct KindTypeOf<Kind::LTOD> { using Type = LTOD; };
template <> struct KindTypeOf<Kind::DT> { using Type = DT; };
template <> struct KindTypeOf<Kind::LDT> { using Type = LDT; };
// clang-format on

/// Nanoseconds per unit of a time or date kind; 0 for the others.
constexpr int64_t unitNs(Kind kind) {
  switch (kind) {
  case Kind::TIME:
  case Kind::TOD:
    return 1000000;
  case Kind::DATE:
  case Kind::DT:
    return 1000000000;
  case Kind::LTIME:
  case Kind::LDATE:
  case Kind::LTOD:
  case Kind::LDT:
    return 1;
  default:
    return 0;
  }
}

constexpr int64_t kDayNs = int64_t{86400} * 1000000000;

/// A day in the units of a type.
constexpr int64_t dayOf(Kind kind) { return kDayNs / unitNs(kind); }

/// Kinds of 32 bits, which have no values below 0.
constexpr bool isShort(Kind kind) {
  return kind == Kind::TIME || kind == Kind::DATE || kind == Kind::TOD || kind == Kind::DT;
}
constexpr bool isDateAndTime(Kind kind) { return kind == Kind::DT || kind == Kind::LDT; }
constexpr bool isDate(Kind kind) { return kind == Kind::DATE || kind == Kind::LDATE; }
constexpr bool isTimeOfDay(Kind kind) { return kind == Kind::TOD || kind == Kind::LTOD; }

} // namespace detail

/// The C++ type of an elementary kind.
template <Kind K> using KindType = typename detail::KindTypeOf<K>::Type;

/// Number to number. Integer to integer wraps; real to integer rounds half away from zero and
/// saturates (NaN is 0); anything to real rounds to nearest.
template <class To, class From> constexpr To convert(From value) {
  if constexpr (detail::Number<From>::kReal && !detail::Number<To>::kReal)
    return detail::realToInteger<To, true>(static_cast<LREAL>(value));
  else
    return static_cast<To>(value);
}

/// TRUNC: real to integer, towards zero, saturating (NaN is 0).
template <class To, class From> constexpr To truncate(From value) {
  return detail::realToInteger<To, false>(static_cast<LREAL>(value));
}

/// Modulo a day, never below 0; both in the same unit.
constexpr int64_t withinDay(int64_t value, int64_t day) {
  const int64_t rest = value % day;
  return rest < 0 ? rest + day : rest;
}

namespace detail {

/// A number of a kind's units as the kind holds it. A DATE is cut to the day, and a TOD is less
/// than a day, so that those which look alike are equal; TIME and others wrap. LDATE begins within
/// a day: what lies there counts to the first whole one.
constexpr int64_t settled(Kind kind, int64_t units) {
  const int64_t held = isShort(kind) ? static_cast<int64_t>(static_cast<uint32_t>(units)) : units;
  if (isTimeOfDay(kind))
    return withinDay(units, dayOf(kind));
  if (!isDate(kind))
    return held;
  const int64_t day = dayOf(kind);
  return held < INT64_MIN + day ? INT64_MIN / day * day : floorDivide(held, day) * day;
}

/// Between times and dates, in their units.
constexpr int64_t timeToTime(Kind to, Kind from, int64_t units) {
  const auto ns =
      static_cast<int64_t>(static_cast<uint64_t>(units) * static_cast<uint64_t>(unitNs(from)));
  return settled(to, floorDivide(ns, unitNs(to)));
}

/// An integer to a time or date; the bits of an ULINT say more than LINT can.
constexpr int64_t integerToTime(Kind to, int64_t value, bool isUnsigned64) {
  if (isUnsigned64 && isTimeOfDay(to))
    return static_cast<int64_t>(static_cast<uint64_t>(value) % static_cast<uint64_t>(dayOf(to)));
  return settled(to, value);
}

/// A real to a time or date: rounded, and limited to what its type can hold.
constexpr int64_t realToTime(Kind to, LREAL value) {
  return settled(to, isShort(to) ? static_cast<int64_t>(realToInteger<uint32_t, true>(value))
                                 : realToInteger<int64_t, true>(value));
}

} // namespace detail

/// A duration for sums with a time of day, in its own units. A TIME has no values below 0: less
/// than a day below its wrap it is the difference of a time of day and a later one.
template <Kind K> constexpr int64_t signedDuration(KindType<K> value) {
  const auto wide = static_cast<int64_t>(value);
  if constexpr (K == Kind::TIME)
    return wide > (int64_t{1} << 32) - detail::dayOf(K) ? wide - (int64_t{1} << 32) : wide;
  else
    return wide;
}

/// TOD + TIME, LTOD + LTIME and the like (Sign 1), TOD - TIME … (-1): the time of day then,
/// whatever day it is; fractions of the unit are rounded down.
template <Kind Clock, Kind Duration, int Sign>
constexpr KindType<Clock> turnClock(KindType<Clock> clock, KindType<Duration> duration) {
  constexpr int64_t kFine = detail::unitNs(Clock) < detail::unitNs(Duration)
                                ? detail::unitNs(Clock)
                                : detail::unitNs(Duration);
  constexpr int64_t kDay = detail::kDayNs / kFine;
  const int64_t start = static_cast<int64_t>(clock) * (detail::unitNs(Clock) / kFine);
  const int64_t way =
      signedDuration<Duration>(duration) * (detail::unitNs(Duration) / kFine) % kDay;
  return static_cast<KindType<Clock>>(withinDay(start % kDay + Sign * way, kDay) /
                                      (detail::unitNs(Clock) / kFine));
}

/// Any elementary kind to any other. To BOOL: anything but zero is TRUE. Between times and dates:
/// units are converted. Between a time or date and a number: the number of the type's own units
/// (ms, s or ns). A DATE is always cut to the day, a TOD always less than a day, so that those
/// which look alike are equal.
template <Kind To, Kind From> constexpr KindType<To> convert(KindType<From> value) {
  using T = KindType<To>;
  if constexpr (To == From) {
    return value;
  } else if constexpr (To == Kind::BOOL) {
    return static_cast<T>(value != 0 ? 1 : 0);
  } else if constexpr (detail::unitNs(To) == 0) {
    return convert<T>(value);
  } else if constexpr (detail::unitNs(From) != 0) {
    return static_cast<T>(detail::timeToTime(To, From, static_cast<int64_t>(value)));
  } else if constexpr (detail::Number<KindType<From>>::kReal) {
    return static_cast<T>(detail::realToTime(To, static_cast<LREAL>(value)));
  } else {
    constexpr bool kUnsigned64 = sizeof(value) == 8 && !detail::Number<KindType<From>>::kSigned;
    return static_cast<T>(detail::integerToTime(To, static_cast<int64_t>(value), kUnsigned64));
  }
}

} // namespace stride

#endif
