// Days since 1970 and the dates of the Gregorian calendar.
#ifndef STRIDE_RUNTIME_BLOCKS_CIVIL_DATE_HPP
#define STRIDE_RUNTIME_BLOCKS_CIVIL_DATE_HPP

#include <stdint.h>

namespace stride::system {

inline constexpr int64_t kDayMs = 86'400'000;

struct CivilDate {
  int64_t year;
  int64_t month; ///< 1 to 12
  int64_t day;   ///< 1 to 31
};

// The calendar in eras of 400 years that begin on a 1st of March, so that a leap day is the last
// day of its year.

/// `days` since 1970-01-01, which must not lie before the year 0.
inline CivilDate civilDateOf(int64_t days) {
  const int64_t shifted = days + 719'468; // 0000-03-01
  const int64_t era = shifted / 146'097;
  const int64_t day = shifted - era * 146'097;
  const int64_t year = (day - day / 1'460 + day / 36'524 - day / 146'096) / 365;
  const int64_t ofYear = day - (365 * year + year / 4 - year / 100);
  const int64_t month = (5 * ofYear + 2) / 153; // from March on
  return {era * 400 + year + (month < 10 ? 0 : 1), month < 10 ? month + 3 : month - 9,
          ofYear - (153 * month + 2) / 5 + 1};
}

/// Days since 1970-01-01 of a date that exists and does not lie before the year 1.
inline int64_t daysOf(const CivilDate &date) {
  const int64_t year = date.month > 2 ? date.year : date.year - 1;
  const int64_t month = date.month > 2 ? date.month - 3 : date.month + 9; // from March on
  return year * 365 + year / 4 - year / 100 + year / 400 + (153 * month + 2) / 5 + date.day - 1 -
         719'468;
}

} // namespace stride::system

#endif
