#include "drivers/can/log/candump.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace stride::can::log {
namespace {

constexpr int64_t kSecond = 1'000'000'000;
constexpr size_t kInterface = 15;
constexpr size_t kShortId = 3; ///< Digits of an identifier with 11 bits …
constexpr size_t kLongId = 8;  ///< … and with 29, or of an error frame.
constexpr std::string_view kBlanks = " \t\r";

/// What is wrong with a line, or that it is not for us.
struct Verdict {
  const char *problem = nullptr;
  bool skip = false;
};

int digitOf(char c) {
  if (c >= '0' && c <= '9')
    return c - '0';
  if (c >= 'a' && c <= 'f')
    return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// The next word of the line, which is taken off it.
std::string_view nextWord(std::string_view &line) {
  const size_t from = std::min(line.find_first_not_of(kBlanks), line.size());
  line.remove_prefix(from);
  const size_t to = std::min(line.find_first_of(kBlanks), line.size());
  const std::string_view word = line.substr(0, to);
  line.remove_prefix(to);
  return word;
}

bool allDigits(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// "(sec.usec)", or with nine digits "(sec.nsec)".
std::optional<int64_t> timeOf(std::string_view word) {
  if (word.size() < 3 || word.front() != '(' || word.back() != ')')
    return std::nullopt;
  word = word.substr(1, word.size() - 2);
  const size_t dot = std::min(word.find('.'), word.size());
  const std::string_view seconds = word.substr(0, dot);
  std::string_view fraction = dot < word.size() ? word.substr(dot + 1) : std::string_view("0");
  constexpr size_t kMostDigits = 9; // of either part: more do not fit, or mean nothing
  if (!allDigits(seconds) || !allDigits(fraction) || seconds.size() > kMostDigits + 1)
    return std::nullopt;
  fraction = fraction.substr(0, kMostDigits);
  int64_t whole = 0;
  int64_t parts = 0;
  std::from_chars(seconds.data(), seconds.data() + seconds.size(), whole);
  std::from_chars(fraction.data(), fraction.data() + fraction.size(), parts);
  for (size_t i = fraction.size(); i < kMostDigits; ++i)
    parts *= 10;
  if (whole > INT64_MAX / kSecond - 1)
    return std::nullopt;
  return whole * kSecond + parts;
}

/// What stands after the identifier and "#".
Verdict readData(std::string_view data, Frame &frame) {
  if (!data.empty() && data.front() == '#')
    return {nullptr, true}; // CAN FD
  if (!data.empty() && (data.front() == 'R' || data.front() == 'r')) {
    frame.remote = true;
    data.remove_prefix(1);
    if (data.empty())
      return {};
    const int length = digitOf(data.front());
    if (data.size() != 1 || length < 0 || length > static_cast<int>(Frame::kMostBytes))
      return {"a remote frame has a length of 0 to 8"};
    frame.length = static_cast<uint8_t>(length);
    return {};
  }
  data = data.substr(0, data.find('_')); // after it a raw length beyond 8
  while (!data.empty()) {
    if (data.front() == '.') {
      data.remove_prefix(1);
      continue;
    }
    const int high = digitOf(data.front());
    const int low = data.size() > 1 ? digitOf(data[1]) : -1;
    if (high < 0 || low < 0)
      return {"bytes have two hexadecimal digits each"};
    if (frame.length == Frame::kMostBytes)
      return {"more than 8 bytes"};
    frame.data[frame.length++] = static_cast<uint8_t>(high * 16 + low);
    data.remove_prefix(2);
  }
  return {};
}

Verdict readFrame(std::string_view word, Frame &frame) {
  const size_t mark = word.find('#');
  if (mark == std::string_view::npos)
    return {"a frame looks like 182#2700"};
  const std::string_view id = word.substr(0, mark);
  if ((id.size() != kShortId && id.size() != kLongId) ||
      !std::all_of(id.begin(), id.end(), [](char c) { return digitOf(c) >= 0; }))
    return {"an identifier has 3 or 8 hexadecimal digits"};
  if (id.size() == kLongId)
    return {nullptr, true};
  unsigned value = 0;
  for (const char c : id)
    value = value * 16 + static_cast<unsigned>(digitOf(c));
  if (value > Frame::kLastId)
    return {"an identifier with 3 digits is 7FF at most"};
  frame.id = static_cast<uint16_t>(value);
  return readData(word.substr(mark + 1), frame);
}

Direction directionOf(std::string_view word) {
  if (word == "R" || word == "RX")
    return Direction::Received;
  return word == "T" || word == "TX" ? Direction::Sent : Direction::Unknown;
}

void note(Recording &recording, size_t line, const char *text) {
  ++recording.badLines;
  if (recording.problems.size() < Recording::kMostProblems)
    recording.problems.push_back({line, text});
}

void readLine(std::string_view line, size_t number, std::string_view wanted, Recording &to) {
  std::string_view rest = line;
  const std::string_view first = nextWord(rest);
  if (first.empty() || first.front() == '#' || first.front() == ';')
    return;
  const std::optional<int64_t> time = timeOf(first);
  if (!time) {
    note(to, number, "a line begins with the time, as (1436509052.249713)");
    return;
  }
  const std::string_view interface = nextWord(rest);
  const std::string_view word = nextWord(rest);
  if (word.empty()) {
    note(to, number, "after the time come the interface and a frame");
    return;
  }
  if (interface.size() > kInterface) {
    note(to, number, "the name of an interface has 15 characters at most");
    return;
  }
  Entry entry{.timeNs = *time, .frame = {}, .line = number};
  const Verdict verdict = readFrame(word, entry.frame);
  if (verdict.problem != nullptr) {
    note(to, number, verdict.problem);
    return;
  }
  if (to.interface.empty())
    to.interface = wanted.empty() ? interface : wanted;
  if (verdict.skip || interface != to.interface) {
    ++to.skipped;
    return;
  }
  entry.direction = directionOf(nextWord(rest));
  to.entries.push_back(entry);
}

/// Writes into a buffer that has room enough.
struct Writer {
  char *at;

  void put(char c) { *at++ = c; }
  void put(std::string_view text) { at = std::copy(text.begin(), text.end(), at); }
  void number(uint64_t value, unsigned digits, unsigned base) {
    for (unsigned i = digits; i-- > 0; value /= base)
      at[i] = "0123456789ABCDEF"[value % base];
    at += digits;
  }
};

} // namespace

Recording readRecording(std::string_view text, std::string_view interface) {
  Recording recording;
  size_t number = 0;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    readLine(text.substr(0, end), ++number, interface, recording);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return recording;
}

size_t formatLine(const Entry &entry, std::string_view interface, char *to, size_t room) {
  if (room < kLongestLine)
    return 0;
  constexpr int64_t kMicrosecond = 1000;
  const int64_t time = std::max<int64_t>(entry.timeNs, 0);
  const auto seconds = static_cast<uint64_t>(time / kSecond);
  Writer out{to};
  unsigned digits = 10;
  for (uint64_t most = 9'999'999'999; seconds > most && digits < 19; ++digits)
    most = most * 10 + 9;
  out.put('(');
  out.number(seconds, digits, 10);
  out.put('.');
  out.number(static_cast<uint64_t>(time % kSecond / kMicrosecond), 6, 10);
  out.put(") ");
  out.put(interface.substr(0, kInterface));
  out.put(' ');
  out.number(entry.frame.id, kShortId, 16);
  out.put('#');
  const size_t length = std::min<size_t>(entry.frame.length, Frame::kMostBytes);
  if (entry.frame.remote) {
    out.put('R');
    if (length > 0)
      out.number(length, 1, 10);
  }
  for (size_t i = 0; i < length && !entry.frame.remote; ++i)
    out.number(entry.frame.data[i], 2, 16);
  if (entry.direction != Direction::Unknown)
    out.put(entry.direction == Direction::Sent ? " T" : " R");
  out.put('\n');
  return static_cast<size_t>(out.at - to);
}

} // namespace stride::can::log
