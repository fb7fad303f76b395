#include "compiler/codegen/calls/assertions.hpp"

#include "compiler/codegen/cpp/names.hpp"
#include "compiler/semantics/symbols.hpp"
#include "compiler/semantics/type_table.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// A function that spells the values of an enumeration.
std::string spellings(const EnumType *enumeration) {
  std::string out = "[](::stride::LINT value__) -> const char * { switch (value__) { ";
  std::vector<int64_t> seen;
  for (const EnumeratorSymbol *one : enumeration->enumerators) {
    if (std::find(seen.begin(), seen.end(), one->value) != seen.end())
      continue;
    seen.push_back(one->value);
    // Its smallest number cannot be written as a literal.
    out += "case " +
           (one->value == INT64_MIN ? std::string("(-9223372036854775807 - 1)")
                                    : std::to_string(one->value)) +
           ": return \"" + std::string(one->name.text) + "\"; ";
  }
  return out + "default: return nullptr; } }";
}

} // namespace

const Type *assertedType(const CallExpr *call) {
  const size_t values = assertedValues(call->builtin);
  if (values == 0)
    return nullptr;
  if (values != 2)
    return elementaryType(values == 1 ? TypeKind::Boolean : TypeKind::Lreal);
  const Expr *first = call->arguments[0].value;
  const Type *own = first->target != nullptr ? first->target : first->type;
  return own->kind == TypeKind::Enumeration ? own : underlying(own);
}

std::string assertionText(const CallExpr *call, std::string_view demand, const std::string &context,
                          const std::vector<std::string> &arguments, const std::string &position) {
  const size_t values = assertedValues(call->builtin);
  const std::string place =
      "{\"" + std::string(builtinRow(call->builtin).name) + "\", " +
      (arguments.size() > values ? "(" + arguments[values] + ").s" : std::string("nullptr")) +
      ", " + position + "})";
  if (values == 0)
    return "::stride::failTest(" + context + ", " + place;
  if (values == 3)
    return "::stride::assertNear(" + context + ", " + arguments[0] + ", " + arguments[1] + ", " +
           arguments[2] + ", " + place;
  const Type *type = assertedType(call);
  const auto *enumeration = type->kind == TypeKind::Enumeration ? typeAs<EnumType>(type) : nullptr;
  const TypeKind shown = enumeration != nullptr ? TypeKind::Lint : type->kind;
  std::string out = std::string("::stride::") + (isString(type) ? "assertTexts" : "assertValues") +
                    "<::stride::Kind::" + std::string(Names::elementary(shown)) + ">(" + context +
                    ", ::stride::Demand::" + std::string(values == 2 ? demand : "Equal") + ", " +
                    arguments[0] + ", ";
  out += values == 2 ? arguments[1] : std::string(demand);
  if (!isString(type))
    out += ", " + (enumeration != nullptr ? spellings(enumeration) : std::string("nullptr"));
  return out + ", " + place;
}

} // namespace stc::codegen
