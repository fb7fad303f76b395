#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_XML_NODES_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_XML_NODES_HPP
// Looking at elements of XML whose prefixes do not count.

#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace stc::import {

/// The element's name without a namespace's prefix; empty for what is no element.
[[nodiscard]] std::string_view localName(const pugi::xml_node &node);
/// The first child element of this local name; null: there is none.
[[nodiscard]] pugi::xml_node child(const pugi::xml_node &node, std::string_view name);
/// All text in the element. Lines that xhtml sets apart (p, br, div) are lines.
[[nodiscard]] std::string textOf(const pugi::xml_node &node);
/// `true`, `True`, `TRUE` or 1.
[[nodiscard]] bool isTrue(const pugi::xml_node &node, const char *attribute);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_XML_NODES_HPP
