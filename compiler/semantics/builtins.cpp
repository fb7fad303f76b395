#include "compiler/semantics/builtins.hpp"

#include "compiler/semantics/assertions.hpp"
#include "compiler/semantics/type_table.hpp"

#include <algorithm>
#include <charconv>

namespace stc {

const std::vector<std::pair<std::string_view, ast::Builtin>> &builtins() {
  using enum ast::Builtin;
  static const std::vector<std::pair<std::string_view, ast::Builtin>> kTable = {
      {"abs", abs},
      {"sqrt", sqrt},
      {"ln", ln},
      {"log", log},
      {"exp", exp},
      {"sin", sin},
      {"cos", cos},
      {"tan", tan},
      {"asin", asin},
      {"acos", acos},
      {"atan", atan},
      {"atan2", atan2},
      {"expt", expt},
      {"trunc", trunc},
      {"min", min},
      {"max", max},
      {"limit", limit},
      {"sel", sel},
      {"mux", mux},
      {"move", move},
      {"shl", shl},
      {"shr", shr},
      {"rol", rol},
      {"ror", ror},
      {"len", len},
      {"left", left},
      {"right", right},
      {"mid", mid},
      {"concat", concat},
      {"insert", insert},
      {"delete", deleteS},
      {"replace", replace},
      {"find", find},
      {"time", time},
      {"adr", adr},
      {"bitadr", bitadr},
      {"sizeof", sizeofT},
      {"__queryinterface", queryInterface},
      {"__querypointer", queryPointer},
      {"xsizeof", sizeofT},
      {"ref", adr},
      {"__new", newT},
      {"indexof", indexOf},
      {"__delete", deleteT},
      {"ini", ini},
      {"__isvalidref", isValidRef},
      {"lower_bound", lowerBound},
      {"upper_bound", upperBound},
      {"assert_true", ast::kAssertTrue},
      {"assert_false", ast::kAssertFalse},
      {"assert_eq", ast::kAssertEq},
      {"assert_ne", ast::kAssertNe},
      {"assert_gt", ast::kAssertGt},
      {"assert_ge", ast::kAssertGe},
      {"assert_lt", ast::kAssertLt},
      {"assert_le", ast::kAssertLe},
      {"assert_near", ast::kAssertNear},
      {"fail", ast::kFail},
  };
  return kTable;
}

namespace {

/// The formal names of each position, alternatives separated by `|`, positions by blanks; a `#`
/// stands for a number that counts on, from the one given.
std::string_view formalNames(ast::Builtin function) {
  if (isAssertion(function)) {
    static constexpr std::string_view kNames[] = {"message", "condition message",
                                                  "actual expected message",
                                                  "actual expected tolerance message"};
    return kNames[assertedValues(function)];
  }
  using enum ast::Builtin;
  switch (function) {
  case limit:
    return "mn in mx";
  case sel:
    return "g in0 in1";
  case mux:
    return "k in#0";
  case min:
  case max:
    return "in#1";
  case expt:
    return "in1 in2";
  case atan2:
    return "y x";
  case shl:
  case shr:
  case rol:
  case ror:
    return "in n";
  case len:
    return "in|str";
  case left:
  case right:
    return "in|str l|size";
  case mid:
  case deleteS:
    return "in|str l|len p|pos";
  case concat:
  case find:
    return "in1|str1 in2|str2";
  case insert:
    return "in1|str1 in2|str2 p|pos";
  case replace:
    return "in1|str1 in2|str2 l p";
  case lowerBound:
  case upperBound:
    return "arr dim";
  default:
    return "in";
  }
}

} // namespace

std::optional<std::size_t> formalPosition(ast::Builtin function, std::string_view lowerName) {
  std::string_view rest = formalNames(function);
  for (std::size_t position = 0; !rest.empty(); ++position) {
    std::string_view names = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(rest.size(), names.size() + 1));
    while (!names.empty()) {
      const std::string_view name = names.substr(0, names.find('|'));
      names.remove_prefix(std::min(names.size(), name.size() + 1));
      const std::size_t hash = name.find('#');
      if (hash == std::string_view::npos) {
        if (name == lowerName)
          return position;
        continue;
      }
      unsigned number = 0;
      const unsigned first = static_cast<unsigned>(name.back() - '0');
      if (!lowerName.starts_with(name.substr(0, hash)))
        continue;
      const std::string_view digits = lowerName.substr(hash);
      const auto [end, error] =
          std::from_chars(digits.data(), digits.data() + digits.size(), number);
      if (error == std::errc{} && end == digits.data() + digits.size() && number >= first &&
          number < first + 64)
        return position + number - first;
    }
  }
  return std::nullopt;
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
