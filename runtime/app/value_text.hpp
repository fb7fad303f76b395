// Values of variables as ST literals, as CSV fields, and back.
#ifndef STRIDE_RUNTIME_APP_VALUE_TEXT_HPP
#define STRIDE_RUNTIME_APP_VALUE_TEXT_HPP

#include "runtime/app/symbols.hpp"

#include <string>
#include <string_view>

namespace stride::app {

/// True for texts and single characters, narrow and wide.
bool isText(Kind kind);

/// The value as an ST literal: TRUE, 50, 100.0, T#1s500ms, 'it$'s', an enumerator's name (its
/// number where it has none). Texts come out as UTF-8. Only for elementary kinds.
std::string formatLiteral(const StrideAppV1 &app, const TypeDesc &type, const void *value);

/// Appends the value as a CSV field: BOOL as 0/1, enumerations as numbers, reals in the shortest
/// text that reads back the same, times and dates as the number of their own units (TIME and TOD
/// ms, DATE and DT s, long forms ns), texts in double quotes.
/// Allocates only when `out` has no capacity left.
void appendCsv(const StrideAppV1 &app, const TypeDesc &type, const void *value, std::string &out);

/// Longest CSV field of a type, in bytes.
size_t csvWidth(const TypeDesc &type);

/// Writes the value of an ST literal: 50, -3, 16#FF, INT#5, TRUE, 1.5e3, T#3s, 'abc', an
/// enumerator's name with or without its type. Throws Error when the text is no literal of the
/// type or out of its range, also that of a subrange; then nothing is written.
void parseLiteral(const StrideAppV1 &app, const TypeDesc &type, std::string_view text, void *value);

} // namespace stride::app

#endif
