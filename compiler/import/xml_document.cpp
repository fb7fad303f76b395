#include "compiler/import/xml_document.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stc::import {

namespace {

constexpr size_t kDeepest = 200;

std::vector<size_t> lineStartsOf(std::string_view text) {
  std::vector<size_t> starts{0};
  for (size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
    starts.push_back(at + 1);
  return starts;
}

size_t lineAt(const std::vector<size_t> &starts, size_t offset) {
  return static_cast<size_t>(std::ranges::upper_bound(starts, offset) - starts.begin());
}

/// Walks without recursion: a hostile file may be nested as deep as it is long.
const char *refusalOf(const XmlDocument &document, size_t &line) {
  size_t depth = 0;
  for (pugi::xml_node node = document.tree.first_child(); node;) {
    line = document.lineOf(node);
    if (node.type() == pugi::node_doctype)
      return "it has a DOCTYPE, which may define entities; remove it";
    if (depth == kDeepest)
      return "its elements are nested deeper than 200; no project is";
    if (node.first_child()) {
      node = node.first_child();
      ++depth;
      continue;
    }
    while (node && !node.next_sibling() && depth > 0) {
      node = node.parent();
      --depth;
    }
    node = node.next_sibling();
  }
  return nullptr;
}

} // namespace

size_t XmlDocument::lineOf(const pugi::xml_node &node) const {
  const ptrdiff_t offset = node.offset_debug();
  return offset < 0 ? 1 : lineAt(lineStarts, static_cast<size_t>(offset));
}

std::unique_ptr<XmlDocument> readXml(std::string_view text) {
  auto document = std::make_unique<XmlDocument>();
  document->lineStarts = lineStartsOf(text);
  const pugi::xml_parse_result result = document->tree.load_buffer(
      text.data(), text.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  if (!result) {
    document->problem = fmt::format("it is not well-formed XML: {}", result.description());
    document->problemLine = lineAt(document->lineStarts, static_cast<size_t>(result.offset));
    return document;
  }
  if (const char *why = refusalOf(*document, document->problemLine)) {
    document->problem = why;
    document->tree.reset();
  }
  return document;
}

} // namespace stc::import
