// The tags of an XML file, one after the other: enough for files that consist of attributes.
#ifndef STRIDE_COMPILER_ASSETS_EDS_XML_HPP
#define STRIDE_COMPILER_ASSETS_EDS_XML_HPP

#include <pugixml.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace stc::eds {

struct XmlTag {
  std::string_view name; ///< Without the prefix of its namespace.
  bool opens = false;
  bool closes = false; ///< Both: it has nothing in it.
  size_t line = 0;

  /// The value of an attribute, of any namespace, as in the file; empty: there is none.
  [[nodiscard]] std::string_view operator[](std::string_view attribute) const;

  pugi::xml_node node;
};

/// Whatever the text is, it comes to an end: what stands before an error is read. Entities besides
/// those of XML itself stay as they are: none is ever expanded.
class XmlTags {
public:
  explicit XmlTags(std::string_view text);

  /// The next tag. FALSE: there is none.
  bool next(XmlTag &tag);
  /// What stands right after the last tag, without blanks around it.
  [[nodiscard]] std::string text() const;
  /// What is wrong with the text, and in which line; null: nothing.
  [[nodiscard]] const char *problem() const;
  [[nodiscard]] size_t problemLine() const { return problemLine_; }

private:
  size_t lineAt(ptrdiff_t offset);

  std::string text_;
  pugi::xml_document document_;
  pugi::xml_parse_result result_;
  XmlTag last_;
  bool begun_ = false;
  size_t line_ = 1;
  size_t counted_ = 0; ///< Up to here lines have been counted.
  size_t problemLine_ = 0;
};

} // namespace stc::eds

#endif
