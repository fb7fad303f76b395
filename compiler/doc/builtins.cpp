// What the reference says of the functions that the compiler implements itself. They take several
// types, which no ST declaration can say.

#include "compiler/doc/reference.hpp"

#include <algorithm>

namespace stc::doc {

namespace {

struct BuiltinText {
  const char *name;
  const char *parameters; ///< with the result
  const char *text;
};

constexpr BuiltinText kTexts[] = {
#define STC_BUILTIN_TEXT(name, parameters, text) {name, parameters, text},
#include "compiler/doc/builtin_texts.def"
#undef STC_BUILTIN_TEXT
};

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
    module.entries.push_back({"Function", row.name, row.parameters, row.text, {}, {}});
  std::stable_sort(module.entries.begin(), module.entries.end(),
                   [](const Entry &a, const Entry &b) { return a.name < b.name; });
  return module;
}

} // namespace stc::doc
