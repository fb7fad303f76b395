#include "compiler/semantics/builtins.hpp"

#include "compiler/semantics/type_table.hpp"

#include <algorithm>
#include <charconv>

namespace stc {

const std::vector<std::pair<std::string_view, ast::Builtin>> &builtins() {
  using enum ast::Builtin;
  static const std::vector<std::pair<std::string_view, ast::Builtin>> kTable = {
      {"abs", Abs},
      {"sqrt", Sqrt},
      {"ln", Ln},
      {"log", Log},
      {"exp", Exp},
      {"sin", Sin},
      {"cos", Cos},
      {"tan", Tan},
      {"asin", Asin},
      {"acos", Acos},
      {"atan", Atan},
      {"atan2", Atan2},
      {"expt", Expt},
      {"trunc", Trunc},
      {"min", Min},
      {"max", Max},
      {"limit", Limit},
      {"sel", Sel},
      {"mux", Mux},
      {"move", Move},
      {"add", Add},
      {"sub", Subtract},
      {"mul", Multiply},
      {"div", Divide},
      {"gt", Greater},
      {"ge", GreaterEqual},
      {"eq", Equal},
      {"le", LessEqual},
      {"lt", Less},
      {"ne", NotEqual},
      {"mul_time", MultiplyTime},
      {"multime", MultiplyTime},
      {"mul_ltime", MultiplyLtime},
      {"div_time", DivideTime},
      {"divtime", DivideTime},
      {"div_ltime", DivideLtime},
      {"and", LogicalAnd},
      {"or", LogicalOr},
      {"xor", LogicalXor},
      {"mod", Modulo},
      {"shl", Shl},
      {"shr", Shr},
      {"rol", Rol},
      {"ror", Ror},
      {"is_valid", IsValid},
      {"is_valid_bcd", IsValidBcd},
      {"to_big_endian", BigEndian},
      {"from_big_endian", BigEndian},
      {"to_little_endian", LittleEndian},
      {"from_little_endian", LittleEndian},
      {"len", Len},
      {"left", Left},
      {"right", Right},
      {"mid", Mid},
      {"concat", Concat},
      {"insert", Insert},
      {"delete", Delete},
      {"replace", Replace},
      {"find", Find},
      {"wlen", Len},
      {"wleft", Left},
      {"wright", Right},
      {"wmid", Mid},
      {"wconcat", Concat},
      {"winsert", Insert},
      {"wdelete", Delete},
      {"wreplace", Replace},
      {"wfind", Find},
      {"time", Time},
      {"ltime", Ltime},
      {"adr", Adr},
      {"bitadr", Bitadr},
      {"sizeof", Sizeof},
      {"__queryinterface", QueryInterface},
      {"__querypointer", QueryPointer},
      {"xsizeof", Sizeof},
      {"ref", Adr},
      {"__new", NewObject},
      {"indexof", IndexOf},
      {"__delete", DeleteObject},
      {"ini", Ini},
      {"__isvalidref", IsValidRef},
      {"lower_bound", LowerBound},
      {"upper_bound", UpperBound},
      {"assert_true", AssertTrue},
      {"assert_false", AssertFalse},
      {"assert_eq", AssertEq},
      {"assert_ne", AssertNe},
      {"assert_gt", AssertGt},
      {"assert_ge", AssertGe},
      {"assert_lt", AssertLt},
      {"assert_le", AssertLe},
      {"assert_near", AssertNear},
      {"fail", FailTest},
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
  case Limit:
    return "mn in mx";
  case Sel:
    return "g in0 in1";
  case Mux:
    return "k in#0";
  case Min:
  case Max:
  case Add:
  case Multiply:
  case Greater:
  case GreaterEqual:
  case Equal:
  case LessEqual:
  case Less:
  case LogicalAnd:
  case LogicalOr:
  case LogicalXor:
    return "in#1";
  case Subtract:
  case Divide:
  case NotEqual:
  case MultiplyTime:
  case MultiplyLtime:
  case DivideTime:
  case DivideLtime:
  case Modulo:
  case Expt:
    return "in1 in2";
  case Atan2:
    return "y x";
  case Shl:
  case Shr:
  case Rol:
  case Ror:
    return "in n";
  case Len:
    return "in|str";
  case Left:
  case Right:
    return "in|str l|size";
  case Mid:
  case Delete:
    return "in|str l|len p|pos";
  case Concat:
    return "in#1|str#1";
  case Find:
    return "in1|str1 in2|str2";
  case Insert:
    return "in1|str1 in2|str2 p|pos";
  case Replace:
    return "in1|str1 in2|str2 l p";
  case LowerBound:
  case UpperBound:
    return "arr dim";
  default:
    return "in";
  }
}

} // namespace

std::optional<size_t> formalPosition(ast::Builtin function, std::string_view lowerName) {
  std::string_view rest = formalNames(function);
  for (size_t position = 0; !rest.empty(); ++position) {
    std::string_view names = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(rest.size(), names.size() + 1));
    while (!names.empty()) {
      const std::string_view name = names.substr(0, names.find('|'));
      names.remove_prefix(std::min(names.size(), name.size() + 1));
      const size_t hash = name.find('#');
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
  const size_t at = text.find(word);
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
  if (const auto cut = findSpecial(text, "trunc_", Trunc, isReal, isWhole))
    return cut;
  if (const auto bcd = findSpecial(text, "bcd_to_", FromBcd, isBitString, isUnsignedInteger))
    return bcd;
  if (const auto bcd = findSpecial(text, "to_bcd_", ToBcd, isUnsignedInteger, isBitString))
    return bcd;
  if (text.starts_with("to_")) {
    if (const Type *to = findElementaryType(text.substr(3)))
      return ConversionName{nullptr, to, Convert};
    return std::nullopt;
  }
  // Type names contain underscores too (TIME_OF_DAY), so try every place.
  for (size_t at = text.find("_to_"); at != std::string_view::npos;
       at = text.find("_to_", at + 1)) {
    const Type *from = findElementaryType(text.substr(0, at));
    const Type *to = findElementaryType(text.substr(at + 4));
    if (from != nullptr && to != nullptr && from != to)
      return ConversionName{from, to, Convert};
  }
  return std::nullopt;
}

} // namespace stc
