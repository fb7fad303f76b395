#include "compiler/semantics/builtins.hpp"

#include "compiler/semantics/type_table.hpp"

#include <unordered_map>

namespace stc {

std::optional<ast::Builtin> findBuiltin(Ident name) {
  using enum ast::Builtin;
  static const std::unordered_map<std::string_view, ast::Builtin> kNames = {
      {"abs", abs},       {"sqrt", sqrt},     {"ln", ln},          {"log", log},
      {"exp", exp},       {"sin", sin},       {"cos", cos},        {"tan", tan},
      {"asin", asin},     {"acos", acos},     {"atan", atan},      {"atan2", atan2},
      {"expt", expt},     {"trunc", trunc},   {"min", min},        {"max", max},
      {"limit", limit},   {"sel", sel},       {"mux", mux},        {"move", move},
      {"shl", shl},       {"shr", shr},       {"rol", rol},        {"ror", ror},
      {"len", len},       {"left", left},     {"right", right},    {"mid", mid},
      {"concat", concat}, {"insert", insert}, {"delete", deleteS}, {"replace", replace},
      {"find", find},     {"time", time},     {"adr", adr},        {"sizeof", sizeofT},
  };
  const auto it = kNames.find(name->lower);
  if (it == kNames.end())
    return std::nullopt;
  return it->second;
}

std::optional<ConversionName> findConversion(Ident name) {
  const std::string_view text = name->lower;
  if (text.starts_with("to_")) {
    if (const Type *to = findElementaryType(text.substr(3)))
      return ConversionName{nullptr, to};
    return std::nullopt;
  }
  // Type names contain underscores too (TIME_OF_DAY), so try every place.
  for (std::size_t at = text.find("_to_"); at != std::string_view::npos;
       at = text.find("_to_", at + 1)) {
    const Type *from = findElementaryType(text.substr(0, at));
    const Type *to = findElementaryType(text.substr(at + 4));
    if (from != nullptr && to != nullptr && from != to)
      return ConversionName{from, to};
  }
  return std::nullopt;
}

} // namespace stc
