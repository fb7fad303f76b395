#include "compiler/source/sources.hpp"

#include "compiler/source/read_source.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace stc {

namespace {

/// Length of the valid UTF-8 sequence at the start, 0 when there is none.
size_t sequenceLength(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80)
    return 1;
  const size_t length = lead >= 0xC2 && lead < 0xE0   ? 2
                        : lead >= 0xE0 && lead < 0xF0 ? 3
                        : lead >= 0xF0 && lead < 0xF5 ? 4
                                                      : 0;
  if (length == 0 || text.size() < length)
    return 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80)
      return 0;
  if ((lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xED && byte(1) > 0x9F) ||
      (lead == 0xF0 && byte(1) < 0x90) || (lead == 0xF4 && byte(1) > 0x8F))
    return 0;
  return length;
}

/// How many bytes at the start are ASCII, in steps of eight.
size_t asciiPrefix(std::string_view text) {
  constexpr uint64_t kHigh = 0x8080808080808080U;
  size_t place = 0;
  for (uint64_t eight = 0; place + sizeof(eight) <= text.size(); place += sizeof(eight)) {
    std::memcpy(&eight, text.data() + place, sizeof(eight));
    if ((eight & kHigh) != 0)
      break;
  }
  return place;
}

bool isAscii(std::string_view text) {
  text.remove_prefix(asciiPrefix(text));
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    if (const size_t plain = asciiPrefix(text); plain != 0) {
      text.remove_prefix(plain);
      continue;
    }
    const size_t length = sequenceLength(text);
    if (length == 0)
      return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string latin1ToUtf8(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size() + bytes.size() / 16);
  for (char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xC0 | (byte >> 6));
      out += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return out;
}

} // namespace

SourceFile::SourceFile(FileId id, std::string name, std::string text)
    : id_(id), name_(std::move(name)), text_(std::move(text)) {
  lineStarts_.push_back(0);
  const char *begin = text_.data();
  const char *end = begin + text_.size();
  for (const char *at = begin; at != end;) {
    at = static_cast<const char *>(std::memchr(at, '\n', static_cast<size_t>(end - at)));
    if (at == nullptr)
      break;
    lineStarts_.push_back(static_cast<uint32_t>(++at - begin));
  }
  ascii_ = isAscii(text_);
}

uint32_t SourceFile::lineNumber(uint32_t offset) const {
  return static_cast<uint32_t>(std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset) -
                               lineStarts_.begin());
}

LineColumn SourceFile::position(uint32_t offset) const {
  offset = std::min(offset, static_cast<uint32_t>(text_.size()));
  const uint32_t number = lineNumber(offset);
  if (ascii_)
    return {number, offset - lineStart(number) + 1};
  const auto characters =
      std::count_if(text_.begin() + lineStart(number), text_.begin() + offset,
                    [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  return {number, static_cast<uint32_t>(characters) + 1};
}

std::string_view SourceFile::line(uint32_t number) const {
  if (number == 0 || number > lineStarts_.size())
    return {};
  const size_t begin = lineStarts_[number - 1];
  size_t end = number < lineStarts_.size() ? lineStarts_[number] - 1 : text_.size();
  if (end > begin && text_[end - 1] == '\r')
    --end;
  return std::string_view(text_).substr(begin, end - begin);
}

FileId Sources::add(std::string name, std::string text) {
  const auto id = static_cast<FileId>(files_.size() + 1);
  files_.push_back(std::make_unique<SourceFile>(id, std::move(name), std::move(text)));
  return id;
}

FileId Sources::addBytes(std::string name, std::string bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF"))
    bytes.erase(0, 3);
  if (!isUtf8(bytes))
    bytes = latin1ToUtf8(bytes);
  // Lines of old Macintosh files end with CR only. As LF they are lines for all who read the text.
  if (bytes.find('\r') != std::string::npos && bytes.find('\n') == std::string::npos)
    std::replace(bytes.begin(), bytes.end(), '\r', '\n');
  return add(std::move(name), std::move(bytes));
}

FileId Sources::add(const SyntheticSource &source) {
  const FileId id = add(source.name(), source.text());
  files_.back()->synthetic_ = true;
  files_.back()->parts_ = source.parts();
  return id;
}

std::optional<std::string> Sources::read(const std::filesystem::path &path, size_t most) const {
  const std::string *unsaved = overlay_ != nullptr ? overlay_->find(path) : nullptr;
  if (unsaved == nullptr)
    return readSource(path, most);
  if (unsaved->size() > most) {
    errno = EFBIG;
    return std::nullopt;
  }
  return *unsaved;
}

std::optional<FileId> Sources::load(const std::filesystem::path &path, std::string name,
                                    size_t most) {
  std::optional<std::string> bytes = read(path, most);
  if (!bytes)
    return std::nullopt;
  return addBytes(std::move(name), std::move(*bytes));
}

std::string_view Sources::text(Span span) const {
  return span.valid() ? file(span.file).text().substr(span.begin, span.end - span.begin)
                      : std::string_view{};
}

Span Sources::origin(Span span) const {
  if (!span.valid() || !file(span.file).isSynthetic())
    return span;
  const std::vector<SyntheticSource::Part> &parts = file(span.file).parts_;
  const auto part = std::upper_bound(
      parts.begin(), parts.end(), span.begin,
      [](uint32_t place, const SyntheticSource::Part &one) { return place < one.end; });
  return part != parts.end() && part->begin <= span.begin ? part->origin : Span{};
}

LineColumn Sources::position(Span span) const {
  return span.valid() ? file(span.file).position(span.begin) : LineColumn{};
}

} // namespace stc
