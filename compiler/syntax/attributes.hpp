#ifndef STRIDE_COMPILER_SYNTAX_ATTRIBUTES_HPP
#define STRIDE_COMPILER_SYNTAX_ATTRIBUTES_HPP
// `{attribute 'name' := 'value'}`: the table of those that mean something, and how to ask for one.

#include "compiler/syntax/ast_node.hpp"

#include <span>
#include <string_view>

namespace stc {

/// Whose documentation has an attribute.
enum class AttributeAudience : uint8_t { Users, Testers, Library };

/// A row of attributes.def.
struct AttributeRow {
  std::string_view name;    ///< in lower case
  std::string_view example; ///< of a value; empty: it takes none
  AttributeAudience audience;
  std::string_view before; ///< what it stands before
  std::string_view text;   ///< what it does there
};
/// All of them, in the order of AttributeId without `Unknown`.
[[nodiscard]] std::span<const AttributeRow> attributeRows();
/// The row of an attribute other than `Unknown`.
[[nodiscard]] const AttributeRow &attributeRow(ast::AttributeId id);

/// Which attribute has that name, whatever its case.
[[nodiscard]] ast::AttributeId findAttribute(std::string_view name);

/// The first one of that kind, or null.
[[nodiscard]] const ast::Attribute *attributeOf(const ast::Attributes &attributes,
                                                ast::AttributeId id);
[[nodiscard]] inline bool hasAttribute(const ast::Attributes &attributes, ast::AttributeId id) {
  return attributeOf(attributes, id) != nullptr;
}
/// The value of the first one of that kind; empty when there is none.
[[nodiscard]] std::string_view attributeValue(const ast::Attributes &attributes,
                                              ast::AttributeId id);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_ATTRIBUTES_HPP
