// The tags of an XML file, one after the other: enough for files that consist of attributes.
#ifndef STRIDE_COMPILER_ASSETS_EDS_XML_HPP
#define STRIDE_COMPILER_ASSETS_EDS_XML_HPP

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace stc::eds {

struct XmlTag {
  std::string name; ///< Without the prefix of its namespace.
  bool opens = false;
  bool closes = false; ///< Both: <one/>.
  std::map<std::string, std::string, std::less<>> attributes;
  size_t line = 0;

  [[nodiscard]] std::string_view operator[](std::string_view attribute) const;
};

/// Whatever the text is, it comes to an end. References to characters are resolved, other entities
/// stay as they are: none is ever expanded.
class XmlTags {
public:
  explicit XmlTags(std::string_view text) : rest_(text) {}

  /// The next tag. FALSE: there is none.
  bool next(XmlTag &tag);
  /// What stands between the last tag and the next one, without blanks around it.
  [[nodiscard]] std::string text() const;

private:
  void skip(size_t count);
  void readAttributes(std::string_view inside, XmlTag &tag);

  std::string_view rest_;
  size_t line_ = 1;
};

} // namespace stc::eds

#endif
