#ifndef STRIDE_COMPILER_IMPORT_XML_DOCUMENT_HPP
#define STRIDE_COMPILER_IMPORT_XML_DOCUMENT_HPP
// XML of other tools, read with pugixml. Hostile files are refused before anything is made of them.

#include <cstddef>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace stc::import {

/// A parsed file. Nodes live as long as it does.
struct XmlDocument {
  pugi::xml_document tree;
  std::vector<size_t> lineStarts; ///< offsets in the text that was parsed
  std::string problem;            ///< why the file was refused; empty: it was read
  size_t problemLine = 1;         ///< from 1

  /// Line of a node in the file, from 1.
  [[nodiscard]] size_t lineOf(const pugi::xml_node &node) const;
};

/// Reads UTF-8 text. Refused, with the line and a way out: what is not well-formed, a DOCTYPE (and
/// so every entity that a file declares), elements nested deeper than 200.
[[nodiscard]] std::unique_ptr<XmlDocument> readXml(std::string_view text);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_XML_DOCUMENT_HPP
