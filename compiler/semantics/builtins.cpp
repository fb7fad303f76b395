#include "compiler/semantics/builtins.hpp"

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
      {"add", add},
      {"sub", subtract},
      {"mul", multiply},
      {"div", divide},
      {"gt", greater},
      {"ge", greaterEqual},
      {"eq", equal},
      {"le", lessEqual},
      {"lt", less},
      {"ne", notEqual},
      {"mul_time", multiplyTime},
      {"multime", multiplyTime},
      {"mul_ltime", multiplyLtime},
      {"div_time", divideTime},
      {"divtime", divideTime},
      {"div_ltime", divideLtime},
      {"and", logicalAnd},
      {"or", logicalOr},
      {"xor", logicalXor},
      {"mod", modulo},
      {"shl", shl},
      {"shr", shr},
      {"rol", rol},
      {"ror", ror},
      {"is_valid", isValid},
      {"is_valid_bcd", isValidBcd},
      {"to_big_endian", bigEndian},
      {"from_big_endian", bigEndian},
      {"to_little_endian", littleEndian},
      {"from_little_endian", littleEndian},
      {"len", len},
      {"left", left},
      {"right", right},
      {"mid", mid},
      {"concat", concat},
      {"insert", insert},
      {"delete", deleteS},
      {"replace", replace},
      {"find", find},
      {"wlen", len},
      {"wleft", left},
      {"wright", right},
      {"wmid", mid},
      {"wconcat", concat},
      {"winsert", insert},
      {"wdelete", deleteS},
      {"wreplace", replace},
      {"wfind", find},
      {"time", time},
      {"ltime", ltime},
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
      {"assert_true", assertTrue},
      {"assert_false", assertFalse},
      {"assert_eq", assertEq},
      {"assert_ne", assertNe},
      {"assert_gt", assertGt},
      {"assert_ge", assertGe},
      {"assert_lt", assertLt},
      {"assert_le", assertLe},
      {"assert_near", assertNear},
      {"fail", failTest},
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
  case add:
  case multiply:
  case greater:
  case greaterEqual:
  case equal:
  case lessEqual:
  case less:
  case logicalAnd:
  case logicalOr:
  case logicalXor:
    return "in#1";
  case subtract:
  case divide:
  case notEqual:
  case multiplyTime:
  case multiplyLtime:
  case divideTime:
  case divideLtime:
  case modulo:
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
    return "in#1|str#1";
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

namespace {

/// `X_TRUNC_Y`, `X_BCD_TO_Y`, `X_TO_BCD_Y` and without X: the word between the types decides.
std::optional<ConversionName> findSpecial(std::string_view text, std::string_view word,
                                          ast::Builtin function, bool (*takes)(const Type *),
                                          bool (*gives)(const Type *)) {
  const std::size_t at = text.find(word);
  if (at == std::string_view::npos || (at > 0 && text[at - 1] != '_'))
    return std::nullopt;
  const Type *from = at > 0 ? findElementaryType(text.substr(0, at - 1)) : nullptr;
  const Type *to = findElementaryType(text.substr(at + word.size()));
  if (to == nullptr || !gives(to) || (at > 0 && (from == nullptr || !takes(from))))
    return std::nullopt;
  return ConversionName{from, to, function};
}

bool isWhole(const Type *t) { return isSignedInteger(t) || isUnsignedInteger(t); }

} // namespace

std::optional<ConversionName> findConversion(Ident name) {
  const std::string_view text = name->lower;
  using enum ast::Builtin;
  if (const auto cut = findSpecial(text, "trunc_", trunc, isReal, isWhole))
    return cut;
  if (const auto bcd = findSpecial(text, "bcd_to_", fromBcd, isBitString, isUnsignedInteger))
    return bcd;
  if (const auto bcd = findSpecial(text, "to_bcd_", toBcd, isUnsignedInteger, isBitString))
    return bcd;
  if (text.starts_with("to_")) {
    if (const Type *to = findElementaryType(text.substr(3)))
      return ConversionName{nullptr, to, convert};
    return std::nullopt;
  }
  // Type names contain underscores too (TIME_OF_DAY), so try every place.
  for (std::size_t at = text.find("_to_"); at != std::string_view::npos;
       at = text.find("_to_", at + 1)) {
    const Type *from = findElementaryType(text.substr(0, at));
    const Type *to = findElementaryType(text.substr(at + 4));
    if (from != nullptr && to != nullptr && from != to)
      return ConversionName{from, to, convert};
  }
  return std::nullopt;
}

} // namespace stc
