#ifndef STRIDE_COMPILER_IMPORT_SCL_CONSTANTS_HPP
#define STRIDE_COMPILER_IMPORT_SCL_CONSTANTS_HPP
// Constants of SCL, and which variables may be seen as another type. Internal to compiler/import.

#include <optional>
#include <string>
#include <string_view>

namespace stc::import {

/// The type that a literal of Structured Text has as a constant; of an integer the smallest of INT,
/// DINT, UDINT, LINT and ULINT that holds it. Empty: it is no literal, or no type holds it.
[[nodiscard]] std::string_view sclConstantType(std::string_view value);

/// `DTL#2026-02-28-20:34:23.25` as a value of the structure DTL: `(YEAR := 2026, …)`, with the
/// weekday that the date has (1 is Sunday). Nothing when it is no date and time of the calendar.
[[nodiscard]] std::optional<std::string> sclDateValue(std::string_view literal);

/// Whether a variable of type `of` may be read and written as one of type `as` (AT): both consist
/// of elementary values of one size, and `as` has not more of them. A CPU of Siemens stores the
/// high byte first, so that with other sizes the same bytes are other values here.
[[nodiscard]] bool isSclViewKept(std::string_view as, std::string_view of);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_SCL_CONSTANTS_HPP
