// Values as JSON.
#ifndef STRIDE_RUNTIME_MONITOR_VALUE_JSON_HPP
#define STRIDE_RUNTIME_MONITOR_VALUE_JSON_HPP

#include "runtime/app/symbols.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace stride::monitor {

/// BOOL as true and false, numbers as numbers (infinities and NaN as texts), texts as texts,
/// everything else (enumerators, times, dates) as its ST literal.
nlohmann::json valueToJson(const StrideAppV1 &app, const TypeDesc &type, const void *value);

/// The ST literal for a JSON value that is to be written to a variable of the type. A text is the
/// content of a STRING, and the literal of everything else. Throws app::Error for arrays, objects
/// and null.
std::string literalOfJson(const TypeDesc &type, const nlohmann::json &value);

} // namespace stride::monitor

#endif
