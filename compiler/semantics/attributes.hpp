#pragma once
// `{attribute 'name' := 'value'}` where one is looked for.

#include "compiler/syntax/ast.hpp"

#include <algorithm>
#include <string_view>

namespace stc {

[[nodiscard]] inline bool hasAttribute(const ast::Attributes &attributes, std::string_view name) {
  return std::any_of(attributes.begin(), attributes.end(),
                     [&](const ast::Attribute &a) { return a.name == name; });
}

} // namespace stc
