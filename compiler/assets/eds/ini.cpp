#include "compiler/assets/eds/ini.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>

namespace stc::eds {
namespace {

using stride::common::lowerCase;

/// Bytes of the UTF-8 character that the text begins with; 0: it begins with none.
size_t characterAt(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const size_t size = first < 0x80 ? 1 : first >= 0xC2 && first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (first >= 0x80 && (first < 0xC2 || first > 0xF4))
    return 0;
  if (size > text.size())
    return 0;
  for (size_t i = 1; i < size; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80)
      return 0;
  return size;
}

class Reader {
public:
  explicit Reader(Device &notes) : notes_(notes) {}

  void line(std::string_view raw, size_t number) {
    const std::string_view text = trimmed(raw);
    if (text.empty() || text.front() == ';' || text.front() == '#')
      return;
    if (text.front() == '[')
      section(text, number);
    else
      key(text, number);
  }

  std::vector<IniSection> take() { return std::move(sections_); }

private:
  void section(std::string_view text, size_t number) {
    const size_t end = text.find(']');
    if (end == std::string_view::npos) {
      notes_.note(number, "a section has no ] at its end");
    } else if (!trimmed(text.substr(end + 1)).empty() &&
               trimmed(text.substr(end + 1)).front() != ';') {
      notes_.note(number, "what stands after the section's ] is left out");
    }
    const std::string name =
        lowerCase(trimmed(text.substr(1, end == std::string_view::npos ? end : end - 1)));
    const auto [found, isNew] = places_.try_emplace(name, sections_.size());
    if (isNew)
      sections_.push_back({inUtf8(name), number, {}});
    else
      notes_.note(number, "the section [" + inUtf8(name) + "] stands twice: both count");
    current_ = found->second;
  }

  void key(std::string_view text, size_t number) {
    const size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
      notes_.note(number, "neither a section nor a key with a value");
      return;
    }
    if (sections_.empty()) {
      notes_.note(number, "a key before the first section");
      return;
    }
    const std::string name = inUtf8(lowerCase(trimmed(text.substr(0, equals))));
    const bool isNew =
        sections_[current_]
            .keys.try_emplace(name, IniValue{inUtf8(trimmed(text.substr(equals + 1))), number})
            .second;
    if (!isNew)
      notes_.note(number, "the key " + name + " stands twice: the first one counts");
  }

  Device &notes_;
  std::vector<IniSection> sections_;
  std::map<std::string, size_t> places_;
  size_t current_ = 0;
};

} // namespace

const IniValue *IniSection::find(std::string_view key) const {
  const auto found = keys.find(key);
  return found == keys.end() ? nullptr : &found->second;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const size_t from = std::min(text.find_first_not_of(kBlanks), text.size());
  text.remove_prefix(from);
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

std::string inUtf8(std::string_view bytes) {
  std::string text;
  while (!bytes.empty()) {
    const size_t size = characterAt(bytes);
    if (size > 0) {
      text += bytes.substr(0, size);
    } else {
      const auto byte = static_cast<unsigned char>(bytes.front());
      text += static_cast<char>(0xC0U | byte >> 6U);
      text += static_cast<char>(0x80U | (byte & 0x3FU));
    }
    bytes.remove_prefix(std::max<size_t>(size, 1));
  }
  stride::common::hideControls(text);
  return text;
}

std::vector<IniSection> readIni(std::string_view text, Device &notes) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark))
    text.remove_prefix(kMark.size());
  Reader reader(notes);
  size_t number = 0;
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of("\n\r"), text.size());
    reader.line(text.substr(0, end), ++number);
    const bool two = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
    text.remove_prefix(std::min(end + (two ? 2U : 1U), text.size()));
  }
  return reader.take();
}

} // namespace stc::eds
