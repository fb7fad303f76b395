#include "compiler/codegen/cpp/writer.hpp"

namespace stc::codegen {

Place Writer::place(Span span) {
  if (!span.valid())
    return {};
  const SourceFile &file = sources_->file(span.file);
  const std::string_view text = file.text();
  if (span.file != cachedFile_ || span.begin < cachedBegin_ || span.begin >= cachedEnd_) {
    const LineColumn at = file.position(span.begin);
    size_t begin = span.begin < text.size() ? span.begin : text.size();
    while (begin > 0 && text[begin - 1] != '\n')
      --begin;
    size_t end = text.find('\n', begin);
    if (end == std::string_view::npos)
      end = text.size();
    cachedFile_ = span.file;
    cachedBegin_ = static_cast<uint32_t>(begin);
    cachedEnd_ = static_cast<uint32_t>(end + 1);
    cachedOffset_ = span.begin;
    cached_ = {at.line, at.column};
    return cached_;
  }
  // Count on (or back) from there: lines may be megabytes long.
  const auto starts = [&](uint32_t i) { // not in the middle of a UTF-8 sequence
    return (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U ? 1U : 0U;
  };
  for (; cachedOffset_ < span.begin; ++cachedOffset_)
    cached_.column += starts(cachedOffset_);
  for (; cachedOffset_ > span.begin; --cachedOffset_)
    cached_.column -= starts(cachedOffset_ - 1);
  return cached_;
}

void Writer::from(Span span) {
  if (!span.valid() || form_ != Form::Mapped)
    return;
  const uint32_t line = place(span).line;
  if (mapped_ == span.file && believed_ == line)
    return;
  *this << "#line " << line;
  if (mapped_ != span.file)
    *this << " \"" << escaped(sources_->file(span.file).codeName()) << '"';
  endLine();
  mapped_ = span.file;
  believed_ = line;
}

void Writer::sameLine() {
  if (mapped_ == 0 || form_ != Form::Mapped)
    return;
  const uint32_t line = believed_ - 1;
  *this << "#line " << line;
  endLine();
  believed_ = line;
}

void Writer::fromGenerated(std::string_view path) {
  if (mapped_ == 0 && believed_ == count_)
    return;
  *this << "#line " << count_ + 1 << " \"" << escaped(path) << '"';
  endLine();
  mapped_ = 0;
  believed_ = count_;
}

void Writer::append(const Writer &other) {
  text_.append(other.text_);
  count_ += other.count_ - 1;
  if (other.mapped_ == 0) { // it holds no directive
    believed_ += other.count_ - 1;
    return;
  }
  believed_ = other.believed_;
  mapped_ = other.mapped_;
}

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out.push_back('\\');
    if (static_cast<unsigned char>(c) < 0x20) {
      const auto u = static_cast<unsigned char>(c);
      out.push_back('\\');
      out.push_back('0');
      out.push_back(static_cast<char>('0' + (u >> 3)));
      out.push_back(static_cast<char>('0' + (u & 7U)));
      continue;
    }
    out.push_back(c);
  }
  return out;
}

} // namespace stc::codegen
