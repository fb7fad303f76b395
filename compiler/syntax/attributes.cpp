#include "compiler/syntax/attributes.hpp"

#include <algorithm>
#include <iterator>

namespace stc {

using ast::AttributeId;

namespace {

constexpr AttributeRow kAttributes[] = {
#define STC_ATTRIBUTE(enumerator, name, value, audience, before, text)                             \
  {name, value, AttributeAudience::audience, before, text},
#include "compiler/syntax/attributes.def"
};

constexpr bool isWhole(const AttributeRow &row) {
  return !row.name.empty() && !row.before.empty() && !row.text.empty() &&
         std::none_of(row.name.begin(), row.name.end(), [](char c) { return lowerCase(c) != c; }) &&
         std::count_if(std::begin(kAttributes), std::end(kAttributes),
                       [&](const AttributeRow &other) { return other.name == row.name; }) == 1;
}
static_assert(std::all_of(std::begin(kAttributes), std::end(kAttributes), isWhole),
              "a row of attributes.def lacks something, or its name stands twice");

} // namespace

std::span<const AttributeRow> attributeRows() { return kAttributes; }

const AttributeRow &attributeRow(AttributeId id) {
  return kAttributes[static_cast<size_t>(id) - 1];
}

AttributeId findAttribute(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kAttributes), std::end(kAttributes),
                   [&](const AttributeRow &row) { return equalIgnoringCase(row.name, name); });
  return found == std::end(kAttributes)
             ? AttributeId::Unknown
             : static_cast<AttributeId>(found - std::begin(kAttributes) + 1);
}

const ast::Attribute *attributeOf(const ast::Attributes &attributes, AttributeId id) {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const ast::Attribute &a) { return a.id == id; });
  return found == attributes.end() ? nullptr : &*found;
}

std::string_view attributeValue(const ast::Attributes &attributes, AttributeId id) {
  const ast::Attribute *found = attributeOf(attributes, id);
  return found == nullptr ? std::string_view() : found->value;
}

} // namespace stc
