#include "compiler/semantics/builtins.hpp"

#include "compiler/semantics/type_table.hpp"
#include "compiler/syntax/ast.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>

namespace stc {

using ast::Builtin;

namespace {

constexpr size_t kAny = SIZE_MAX;

/// DOES(…) of a row, which may be empty.
constexpr unsigned effectsOf(std::initializer_list<unsigned> does) {
  return does.size() == 0 ? 0 : *does.begin();
}

constexpr auto kRows = [] {
  using enum BuiltinTakes;
  using enum BuiltinRow::Effect;
  return std::to_array<BuiltinRow>({
#define STC_BUILTIN(enumerator, name, signature, takes, check, fold, does, emit, text)             \
  {name, takes, effectsOf(does)},
#include "compiler/semantics/builtins.def"
  });
}();

constexpr BuiltinName kAllNames[] = {
#define STC_BUILTIN(enumerator, name, ...) {name, Builtin::enumerator},
#define STC_BUILTIN_ALIAS(enumerator, name, ...) {name, Builtin::enumerator},
#include "compiler/semantics/builtins.def"
};

constexpr size_t kNameCount = static_cast<size_t>(std::count_if(
    std::begin(kAllNames), std::end(kAllNames), [](const auto &n) { return !n.name.empty(); }));

constexpr auto kNames = [] {
  std::array<BuiltinName, kNameCount> names{};
  std::copy_if(std::begin(kAllNames), std::end(kAllNames), names.begin(),
               [](const BuiltinName &n) { return !n.name.empty(); });
  return names;
}();

constexpr bool isEachNameOnce() {
  for (size_t i = 0; i < kNames.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (kNames[i].name == kNames[j].name)
        return false;
  return true;
}
static_assert(isEachNameOnce(), "two rows of builtins.def have the same name");

constexpr bool isCounted(const BuiltinRow &row) {
  const BuiltinRow::Arguments &takes = row.takes;
  return takes.least <= takes.most && (takes.most == 0) == takes.formals.empty();
}
static_assert(
    std::all_of(kRows.begin(), kRows.end(), isCounted),
    "a row of builtins.def needs more arguments than it takes, or takes some without names");

} // namespace

const BuiltinRow &builtinRow(Builtin function) { return kRows[static_cast<size_t>(function)]; }

std::span<const BuiltinName> builtinNames() { return kNames; }

std::optional<size_t> formalPosition(ast::Builtin function, std::string_view lowerName) {
  std::string_view rest = builtinRow(function).takes.formals;
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

ast::Expr *addressed(const ast::Expr *value) {
  if (value == nullptr || value->kind != ast::ExprKind::Call)
    return nullptr;
  const auto *call = ast::as<ast::CallExpr>(value);
  return call->resolved == ast::Callee::Builtin && call->builtin == Builtin::Adr &&
                 !call->arguments.empty()
             ? call->arguments[0].value
             : nullptr;
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
  for (const std::string_view ofAny : {"to_", "any_to_"}) {
    if (!text.starts_with(ofAny))
      continue;
    if (const Type *to = findElementaryType(text.substr(ofAny.size())))
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
