// Values to text.
#include "runtime/iec/text.h"

#include <charconv>
#include <cstring>

namespace stride::text {

namespace {

/// Writes into a caller's buffer of kBufferSize.
class Writer {
public:
  explicit Writer(char *out) : begin_(out), at_(out) {}
  Writer &text(const char *s) {
    const size_t n = std::strlen(s);
    std::memcpy(at_, s, n);
    at_ += n;
    return *this;
  }
  template <class T> Writer &number(T value) {
    at_ = std::to_chars(at_, begin_ + kBufferSize, value).ptr;
    return *this;
  }
  /// With leading zeros.
  Writer &digits(uint64_t value, int width) {
    for (int i = width - 1; i >= 0; --i) {
      at_[i] = static_cast<char>('0' + value % 10);
      value /= 10;
    }
    at_ += width;
    return *this;
  }
  uint32_t finish() {
    *at_ = 0;
    return static_cast<uint32_t>(at_ - begin_);
  }

private:
  char *begin_;
  char *at_;
};

template <class T> uint32_t formatFloating(char *out, T value) {
  if (value != value)
    return Writer(out).text("NaN").finish();
  if (value - value != 0)
    return Writer(out).text(value < 0 ? "-Infinity" : "Infinity").finish();
  char *end = std::to_chars(out, out + kBufferSize, value).ptr;
  // ST wants a decimal: 100 -> 100.0, 1e+20 -> 1.0e+20.
  char *exponent = out;
  while (exponent != end && *exponent != 'e' && *exponent != '.')
    ++exponent;
  if (exponent == end || *exponent == 'e') {
    std::memmove(exponent + 2, exponent, static_cast<size_t>(end - exponent));
    exponent[0] = '.';
    exponent[1] = '0';
    end += 2;
  }
  *end = 0;
  return static_cast<uint32_t>(end - out);
}

void durationParts(Writer &w, uint64_t ns) {
  struct Unit {
    const char *name;
    uint64_t ns;
  };
  static constexpr Unit kUnits[] = {
      {"d", 86400000000000}, {"h", 3600000000000}, {"m", 60000000000}, {"s", 1000000000},
      {"ms", 1000000},       {"us", 1000},         {"ns", 1}};
  if (ns == 0) {
    w.text("0ms");
    return;
  }
  for (const Unit &unit : kUnits) {
    if (ns >= unit.ns)
      w.number(ns / unit.ns).text(unit.name);
    ns %= unit.ns;
  }
}

void civilDate(Writer &w, int64_t days) {
  // Days since 1970-01-01 to year-month-day in the Gregorian calendar, counting years from March.
  days += 719468;
  const int64_t era = (days >= 0 ? days : days - 146096) / 146097;
  const int64_t dayOfEra = days - era * 146097;
  const int64_t yearOfEra =
      (dayOfEra - dayOfEra / 1460 + dayOfEra / 36524 - dayOfEra / 146096) / 365;
  const int64_t dayOfYear = dayOfEra - (365 * yearOfEra + yearOfEra / 4 - yearOfEra / 100);
  const int64_t shifted = (5 * dayOfYear + 2) / 153;
  const int64_t day = dayOfYear - (153 * shifted + 2) / 5 + 1;
  const int64_t month = shifted < 10 ? shifted + 3 : shifted - 9;
  const int64_t year = yearOfEra + era * 400 + (month <= 2 ? 1 : 0);
  w.digits(static_cast<uint64_t>(year), 4).text("-");
  w.digits(static_cast<uint64_t>(month), 2).text("-");
  w.digits(static_cast<uint64_t>(day), 2);
}

void timeOfDay(Writer &w, int64_t ns) {
  const uint64_t seconds = static_cast<uint64_t>(ns / 1000000000);
  uint64_t fraction = static_cast<uint64_t>(ns % 1000000000);
  w.digits(seconds / 3600, 2).text(":").digits(seconds / 60 % 60, 2).text(":");
  w.digits(seconds % 60, 2);
  if (fraction == 0)
    return;
  int width = 9;
  while (fraction % 1000 == 0) {
    fraction /= 1000;
    width -= 3;
  }
  w.text(".").digits(fraction, width);
}

uint32_t dateText(char *out, const char *prefix, int64_t ns) {
  Writer w(out);
  w.text(prefix);
  civilDate(w, floorDivide(ns, detail::kDayNs));
  return w.finish();
}

uint32_t timeOfDayText(char *out, const char *prefix, int64_t ns) {
  Writer w(out);
  w.text(prefix);
  timeOfDay(w, ns - floorDivide(ns, detail::kDayNs) * detail::kDayNs);
  return w.finish();
}

uint32_t dateAndTimeText(char *out, const char *prefix, int64_t ns) {
  const int64_t days = floorDivide(ns, detail::kDayNs);
  Writer w(out);
  w.text(prefix);
  civilDate(w, days);
  w.text("-");
  timeOfDay(w, ns - days * detail::kDayNs);
  return w.finish();
}

template <class T> T load(const void *p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

} // namespace

uint32_t formatSigned(char *out, int64_t value) { return Writer(out).number(value).finish(); }
uint32_t formatUnsigned(char *out, uint64_t value) { return Writer(out).number(value).finish(); }
uint32_t formatLreal(char *out, LREAL value) { return formatFloating(out, value); }
uint32_t formatReal(char *out, REAL value) { return formatFloating(out, value); }

uint32_t formatTime(char *out, TIME value) {
  Writer w(out);
  w.text("T#");
  durationParts(w, uint64_t{value} * 1000000);
  return w.finish();
}

uint32_t formatLtime(char *out, LTIME value) {
  Writer w(out);
  w.text(value < 0 ? "LTIME#-" : "LTIME#");
  const uint64_t bits = static_cast<uint64_t>(value);
  durationParts(w, value < 0 ? uint64_t{0} - bits : bits);
  return w.finish();
}

uint32_t formatDate(char *out, DATE value) {
  return dateText(out, "D#", int64_t{value} * 1000000000);
}
uint32_t formatLdate(char *out, LDATE value) { return dateText(out, "LDATE#", value); }
uint32_t formatTod(char *out, TOD value) {
  return timeOfDayText(out, "TOD#", int64_t{value} * 1000000);
}
uint32_t formatLtod(char *out, LTOD value) { return timeOfDayText(out, "LTOD#", value); }
uint32_t formatDt(char *out, DT value) {
  return dateAndTimeText(out, "DT#", int64_t{value} * 1000000000);
}
uint32_t formatLdt(char *out, LDT value) { return dateAndTimeText(out, "LDT#", value); }

uint32_t formatValue(char *out, Kind kind, const void *value) {
  switch (kind) {
  case Kind::BOOL:
    return Writer(out).text(load<BOOL>(value) != 0 ? "TRUE" : "FALSE").finish();
  case Kind::SINT:
    return formatSigned(out, load<SINT>(value));
  case Kind::INT:
    return formatSigned(out, load<INT>(value));
  case Kind::DINT:
    return formatSigned(out, load<DINT>(value));
  case Kind::LINT:
    return formatSigned(out, load<LINT>(value));
  case Kind::USINT:
  case Kind::BYTE:
    return formatUnsigned(out, load<USINT>(value));
  case Kind::UINT:
  case Kind::WORD:
    return formatUnsigned(out, load<UINT>(value));
  case Kind::UDINT:
  case Kind::DWORD:
    return formatUnsigned(out, load<UDINT>(value));
  case Kind::ULINT:
  case Kind::LWORD:
    return formatUnsigned(out, load<ULINT>(value));
  case Kind::REAL:
    return formatReal(out, load<REAL>(value));
  case Kind::LREAL:
    return formatLreal(out, load<LREAL>(value));
  case Kind::TIME:
    return formatTime(out, load<TIME>(value));
  case Kind::LTIME:
    return formatLtime(out, load<LTIME>(value));
  case Kind::DATE:
    return formatDate(out, load<DATE>(value));
  case Kind::LDATE:
    return formatLdate(out, load<LDATE>(value));
  case Kind::TOD:
    return formatTod(out, load<TOD>(value));
  case Kind::LTOD:
    return formatLtod(out, load<LTOD>(value));
  case Kind::DT:
    return formatDt(out, load<DT>(value));
  case Kind::LDT:
    return formatLdt(out, load<LDT>(value));
  default:
    return Writer(out).finish();
  }
}

} // namespace stride::text
