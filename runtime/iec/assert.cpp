#include "runtime/iec/assert.h"

#include "runtime/iec/text.h"

namespace stride {

namespace {

/// Appends to a text of fixed size; what does not fit is cut.
class Line {
public:
  template <uint32_t N> explicit Line(char (&out)[N]) : at_(out), end_(out + N - 1) { *at_ = 0; }

  Line &operator<<(const char *text) {
    while (*text != 0)
      put(*text++);
    return *this;
  }
  Line &operator<<(uint64_t number) {
    char digits[text::kBufferSize];
    text::formatUnsigned(digits, number);
    return *this << static_cast<const char *>(digits);
  }
  void put(char c) {
    if (at_ == end_)
      return;
    *at_++ = c;
    *at_ = 0;
  }
  /// A character of Latin-1 or UTF-16, whole or not at all.
  void character(uint32_t c) {
    const uint32_t bytes = c < 0x80 ? 1 : c < 0x800 ? 2 : 3;
    if (static_cast<uint64_t>(end_ - at_) < bytes)
      return;
    if (bytes == 1) {
      put(static_cast<char>(c));
    } else if (bytes == 2) {
      put(static_cast<char>(0xC0 | (c >> 6)));
      put(static_cast<char>(0x80 | (c & 0x3F)));
    } else {
      put(static_cast<char>(0xE0 | (c >> 12)));
      put(static_cast<char>(0x80 | ((c >> 6) & 0x3F)));
      put(static_cast<char>(0x80 | (c & 0x3F)));
    }
  }
  /// As in an ST literal.
  void quoted(uint32_t c, char quote) {
    if (c == '$' || c == static_cast<uint32_t>(quote)) {
      put('$');
    } else if (c < 0x20 || c == 0x7F) {
      put('$');
      put("0123456789ABCDEF"[(c >> 4) & 15]);
      put("0123456789ABCDEF"[c & 15]);
      return;
    } else if (c >= 0xD800 && c < 0xE000) { // half of a pair
      c = '?';
    }
    character(c);
  }

private:
  char *at_;
  char *end_;
};

/// More of a text is not shown.
constexpr uint32_t kShownCharacters = 96;

template <class C> void quote(Line &line, const C *text, uint32_t capacity, char mark) {
  line.put(mark);
  uint32_t i = 0;
  for (; i < capacity && i < kShownCharacters && text[i] != 0; ++i)
    line.quoted(sizeof(C) == 1 ? static_cast<unsigned char>(text[i])
                               : static_cast<uint32_t>(static_cast<char16_t>(text[i])),
                mark);
  line.put(mark);
  if (i == kShownCharacters && i < capacity && text[i] != 0)
    line << " ...";
}

void show(Line &line, const AssertionValue &value) {
  if (value.spelling != nullptr) {
    line << value.spelling;
    return;
  }
  switch (value.kind) {
  case Kind::STRING:
    return quote(line, static_cast<const char *>(value.value), value.capacity, '\'');
  case Kind::WSTRING:
    return quote(line, static_cast<const char16_t *>(value.value), value.capacity, '"');
  case Kind::CHAR:
    return quote(line, static_cast<const char *>(value.value), 1, '\'');
  case Kind::WCHAR:
    return quote(line, static_cast<const char16_t *>(value.value), 1, '"');
  default: {
    char digits[text::kBufferSize];
    text::formatValue(digits, value.kind, value.value);
    line << static_cast<const char *>(digits);
  }
  }
}

void tell(Ctx &ctx, FailedAssertion &failure, const AssertionPlace &place) {
  failure.function = place.function;
  failure.file = place.file;
  failure.line = place.line;
  failure.col = place.col;
  Line message(failure.message);
  for (const char *c = place.message; c != nullptr && *c != 0; ++c)
    message.character(static_cast<unsigned char>(*c));
  Line summary(failure.summary);
  summary << place.function << " failed at " << place.file << ":" << place.line << ":" << place.col;
  if (failure.expected[0] != 0)
    summary << ": expected " << failure.expected << ", is " << failure.actual;
  if (failure.message[0] != 0)
    summary << ": " << failure.message;
  if (ctx.host != nullptr)
    ctx.host->log(&ctx, kAssertionFailed, failure.summary);
}

} // namespace

void assertionFailed(Ctx &ctx, Demand demand, const AssertionValue &actual,
                     const AssertionValue &expected, const AssertionPlace &place) {
  FailedAssertion failure;
  Line is(failure.actual);
  show(is, actual);
  Line wanted(failure.expected);
  static constexpr const char *kWords[] = {"", "anything but ", "> ", ">= ", "< ", "<= "};
  wanted << kWords[static_cast<uint32_t>(demand)];
  show(wanted, expected);
  tell(ctx, failure, place);
}

void nearFailed(Ctx &ctx, LREAL actual, LREAL expected, LREAL tolerance,
                const AssertionPlace &place) {
  FailedAssertion failure;
  Line is(failure.actual);
  show(is, {Kind::LREAL, &actual, 0, nullptr});
  Line wanted(failure.expected);
  show(wanted, {Kind::LREAL, &expected, 0, nullptr});
  wanted << " within ";
  show(wanted, {Kind::LREAL, &tolerance, 0, nullptr});
  tell(ctx, failure, place);
}

BOOL failTest(Ctx &ctx, const AssertionPlace &place) {
  FailedAssertion failure;
  failure.actual[0] = failure.expected[0] = 0;
  tell(ctx, failure, place);
  return false;
}

} // namespace stride
