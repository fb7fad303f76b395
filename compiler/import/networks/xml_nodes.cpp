#include "compiler/import/networks/xml_nodes.hpp"

namespace stc::import {

namespace {

/// Elements of xhtml that stand on lines of their own.
bool isBlock(std::string_view name) {
  return name == "p" || name == "div" || name == "pre" || name == "li";
}

void appendText(const pugi::xml_node &node, std::string &text) {
  for (const pugi::xml_node &part : node.children()) {
    if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) {
      text += part.value();
      continue;
    }
    const std::string_view name = localName(part);
    if (name == "br")
      text += '\n';
    appendText(part, text);
    if (isBlock(name) && !text.empty() && text.back() != '\n')
      text += '\n';
  }
}

} // namespace

std::string_view localName(const pugi::xml_node &node) {
  if (node.type() != pugi::node_element)
    return {};
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);
}

pugi::xml_node child(const pugi::xml_node &node, std::string_view name) {
  for (const pugi::xml_node &each : node.children())
    if (localName(each) == name)
      return each;
  return {};
}

std::string textOf(const pugi::xml_node &node) {
  std::string text;
  appendText(node, text);
  return text;
}

bool isTrue(const pugi::xml_node &node, const char *attribute) {
  const std::string_view value = node.attribute(attribute).value();
  return value == "true" || value == "1" || value == "True" || value == "TRUE";
}

} // namespace stc::import
