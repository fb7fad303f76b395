// What the reference says of the functions that the compiler implements itself. They take several
// types, which no ST declaration can say.

#include "compiler/semantics/builtins.hpp"
#include "compiler/doc/reference.hpp"
#include "compiler/semantics/type_table.hpp"

#include <algorithm>

namespace stc::doc {

namespace {

struct BuiltinText {
  std::string_view name; ///< empty: conversions
  std::string_view signature;
  std::string_view text;
};

constexpr bool isWhole(const BuiltinText &row) {
  return row.name.empty() == row.text.empty() && row.name.empty() == row.signature.empty();
}

constexpr BuiltinText kTexts[] = {
#define STC_BUILTIN(enumerator, name, signature, takes, check, fold, does, emit, text)             \
  {name, signature, text},
#define STC_BUILTIN_ALIAS(enumerator, name, signature, text) {name, signature, text},
#define STC_BUILTIN_FAMILY(name, signature, text) {name, signature, text},
#include "compiler/semantics/builtins.def"
};

static_assert(std::all_of(std::begin(kTexts), std::end(kTexts), isWhole),
              "what has a name in builtins.def needs a signature and a text");

/// INT_TO_REAL, TO_STRING, TRUNC_INT, BYTE_BCD_TO_USINT …
std::vector<std::string> conversionNames() {
  std::vector<std::string> types = {"TOD", "LTOD", "DT", "LDT"}; // beside their long names
  for (auto kind = TypeKind::Boolean; kind <= TypeKind::Wchar;
       kind = static_cast<TypeKind>(static_cast<int>(kind) + 1))
    types.push_back(typeName(elementaryType(kind)));
  std::vector<std::string> names;
  Interner interner;
  const auto add = [&](const std::string &name) {
    const std::optional<ConversionName> found = findConversion(interner.intern(name));
    if (found && found->from != found->to)
      names.push_back(name);
  };
  for (const std::string &to : types)
    for (const char *verb : {"TO_", "TRUNC_", "BCD_TO_", "TO_BCD_"}) {
      add(verb + to);
      for (const std::string &from : types)
        add(from + "_" + verb + to);
    }
  return names;
}

} // namespace

Module builtinFunctions() {
  Module module{
      "Operators",
      "Functions and operators that the compiler knows without a library. ANY_NUM stands "
      "for integers and reals, ANY_INT for integers, ANY_REAL for REAL and LREAL, ANY_BIT "
      "for BOOL and bit strings, ANY_STRING for STRING and WSTRING of any length, ANY for "
      "every type. The result has the type of the arguments marked so.",
      {}};
  for (const BuiltinText &row : kTexts)
    if (!row.name.empty())
      module.entries.push_back({"Function",
                                std::string(row.name),
                                std::string(row.signature),
                                std::string(row.text),
                                {},
                                {},
                                {}});
  std::stable_sort(module.entries.begin(), module.entries.end(),
                   [](const Entry &a, const Entry &b) { return a.name < b.name; });
  const auto conversions = std::find_if(module.entries.begin(), module.entries.end(),
                                        [](const Entry &entry) { return entry.name == "TO_INT"; });
  conversions->aliases = conversionNames();
  std::erase(conversions->aliases, conversions->name);
  return module;
}

} // namespace stc::doc
