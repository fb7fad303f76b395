#include "compiler/assets/eds/xml.hpp"

#include "compiler/assets/eds/ini.hpp"

#include <algorithm>

namespace stc::eds {
namespace {

std::string_view withoutPrefix(std::string_view name) {
  const size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

bool isElement(const pugi::xml_node &node) { return node.type() == pugi::node_element; }

pugi::xml_node elementFrom(pugi::xml_node node) {
  while (node && !isElement(node))
    node = node.next_sibling();
  return node;
}

} // namespace

std::string_view XmlTag::operator[](std::string_view attribute) const {
  for (const pugi::xml_attribute one : node.attributes())
    if (withoutPrefix(one.name()) == attribute)
      return one.value();
  return {};
}

XmlTags::XmlTags(std::string_view text)
    : text_(text), result_(document_.load_buffer(text_.data(), text_.size())) {
  if (!result_)
    problemLine_ =
        1 + static_cast<size_t>(std::count(
                text_.begin(),
                text_.begin() +
                    std::clamp<ptrdiff_t>(result_.offset, 0, static_cast<ptrdiff_t>(text_.size())),
                '\n'));
}

const char *XmlTags::problem() const { return result_ ? nullptr : result_.description(); }

/// Tags come in the order of the text.
size_t XmlTags::lineAt(ptrdiff_t offset) {
  const size_t end = std::clamp<size_t>(static_cast<size_t>(std::max<ptrdiff_t>(offset, 0)),
                                        counted_, text_.size());
  line_ += static_cast<size_t>(std::count(text_.begin() + static_cast<ptrdiff_t>(counted_),
                                          text_.begin() + static_cast<ptrdiff_t>(end), '\n'));
  counted_ = end;
  return line_;
}

bool XmlTags::next(XmlTag &tag) {
  pugi::xml_node node;
  bool closing = false;
  if (!begun_) {
    node = elementFrom(document_.first_child());
  } else if (last_.opens && !last_.closes) {
    node = elementFrom(last_.node.first_child());
    closing = !node;
    node = closing ? last_.node : node;
  } else if (last_.node) {
    node = elementFrom(last_.node.next_sibling());
    closing = !node && isElement(last_.node.parent());
    node = closing ? last_.node.parent() : node;
  }
  begun_ = true;
  last_ = {};
  if (!node)
    return false;
  last_.node = node;
  last_.name = withoutPrefix(node.name());
  last_.opens = !closing;
  last_.closes = closing || !node.first_child();
  last_.line = closing ? line_ : lineAt(node.offset_debug());
  tag = last_;
  return true;
}

std::string XmlTags::text() const {
  const pugi::xml_node text =
      last_.opens && !last_.closes ? last_.node.first_child() : last_.node.next_sibling();
  const bool isText = text.type() == pugi::node_pcdata || text.type() == pugi::node_cdata;
  return isText ? inUtf8(trimmed(std::string_view(text.value()))) : std::string();
}

} // namespace stc::eds
