#include "compiler/import/networks/text.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace stc::import::networks {

using stride::common::upperCase;

namespace {

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Past blanks, comments and pragmas.
size_t skipped(std::string_view text, size_t at) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kPassed = {
      {{"//", "\n"}, {"(*", "*)"}, {"/*", "*/"}, {"{", "}"}}};
  while (at < text.size()) {
    const auto *passed = std::ranges::find_if(
        kPassed, [&](const auto &each) { return text.substr(at).starts_with(each.first); });
    if (passed != kPassed.end()) {
      const size_t end = text.find(passed->second, at + passed->first.size());
      at = end == std::string_view::npos ? text.size() : end + passed->second.size();
    } else if (isBlank(text[at])) {
      ++at;
    } else {
      break;
    }
  }
  return at;
}

/// End of a name, or of a literal that begins like one (`INT#5`, `T#1h2m`).
size_t endOfName(std::string_view text, size_t at) {
  while (at < text.size() && (isLetter(text[at]) || isDigit(text[at])))
    ++at;
  return at;
}

size_t endOfLiteral(std::string_view text, size_t at) {
  while (at < text.size()) {
    const char c = text[at];
    const bool exponent = (c == '+' || c == '-') && at > 0 &&
                          (text[at - 1] == 'e' || text[at - 1] == 'E') && at > 1 &&
                          isDigit(text[at - 2]);
    const bool fraction = c == '.' && at + 1 < text.size() && isDigit(text[at + 1]);
    if (!isLetter(c) && !isDigit(c) && c != '#' && !exponent && !fraction)
      break;
    ++at;
  }
  return at;
}

/// `D#2026-11-28`, `TOD#12:30:15`, `INT#-5`: what follows the `#` of a typed literal.
size_t endOfTyped(std::string_view text, size_t at) {
  if (at < text.size() && (text[at] == '-' || text[at] == '+'))
    ++at;
  while (at < text.size() && (isLetter(text[at]) || isDigit(text[at]) || text[at] == '#' ||
                              ((text[at] == '.' || text[at] == '-' || text[at] == ':') &&
                               at + 1 < text.size() && isDigit(text[at + 1]))))
    ++at;
  return at;
}

size_t endOfText(std::string_view text, size_t at) {
  const char quote = text[at++];
  while (at < text.size() && text[at] != quote)
    at += text[at] == '$' ? 2 : 1;
  return std::min(at + 1, text.size());
}

constexpr std::array<std::string_view, 7> kLongSymbols = {":=", "=>", "<=", ">=", "<>", "**", ".."};

constexpr std::array<std::pair<std::string_view, Precedence>, 17> kOperators = {{
    {"OR", kOr},
    {"OR_ELSE", kOr},
    {"XOR", kXor},
    {"AND", kAnd},
    {"AND_THEN", kAnd},
    {"&", kAnd},
    {"=", kEqual},
    {"<>", kEqual},
    {"<", kCompare},
    {">", kCompare},
    {"<=", kCompare},
    {">=", kCompare},
    {"+", kSum},
    {"-", kSum},
    {"*", kProduct},
    {"/", kProduct},
    {"MOD", kProduct},
}};

} // namespace

std::string_view trim(std::string_view text) {
  while (!text.empty() && isBlank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back()))
    text.remove_suffix(1);
  return text;
}

std::vector<Word> wordsOf(std::string_view text) {
  std::vector<Word> words;
  for (size_t at = skipped(text, 0); at < text.size(); at = skipped(text, at)) {
    size_t end = at + 1;
    Word::Kind kind = Word::Kind::Symbol;
    if (isLetter(text[at])) {
      end = endOfName(text, at);
      kind = Word::Kind::Name;
      if (end < text.size() && text[end] == '#') {
        end = endOfTyped(text, end + 1);
        kind = Word::Kind::Literal;
      }
    } else if (isDigit(text[at])) {
      end = endOfLiteral(text, at);
      kind = Word::Kind::Literal;
    } else if (text[at] == '\'' || text[at] == '"') {
      end = endOfText(text, at);
      kind = Word::Kind::Literal;
    } else if (text[at] == '%') {
      end = endOfLiteral(text, at + 1);
      kind = Word::Kind::Name;
    } else if (std::ranges::find(kLongSymbols, text.substr(at, 2)) != kLongSymbols.end()) {
      end = at + 2;
    }
    words.push_back({kind, std::string(text.substr(at, end - at)), at});
    at = end;
  }
  return words;
}

Precedence precedenceOf(std::string_view text) {
  int depth = 0;
  Precedence weakest = kPrimary;
  bool operand = false; // whether the last word ends an operand
  for (const Word &word : wordsOf(text)) {
    const std::string upper = upperCase(word.text);
    if (word.kind == Word::Kind::Symbol && (upper == "(" || upper == "["))
      ++depth;
    else if (word.kind == Word::Kind::Symbol && (upper == ")" || upper == "]"))
      --depth;
    if (depth == 0 && word.kind != Word::Kind::Literal) {
      Precedence own = kPrimary;
      if (upper == "NOT" || (!operand && (upper == "-" || upper == "+")))
        own = kUnary;
      else if (upper == "**")
        own = kPower;
      else if (upper == ":=" || upper == ",")
        own = kOr;
      for (const auto &[name, precedence] : kOperators)
        if (own == kPrimary && upper == name)
          own = precedence;
      weakest = std::min(weakest, own);
      operand = own == kPrimary;
      continue;
    }
    operand = true;
  }
  return weakest;
}

std::set<std::string> rootsOf(std::string_view text) {
  std::set<std::string> roots;
  bool member = false;
  for (const Word &word : wordsOf(text)) {
    if (word.kind == Word::Kind::Name && !member)
      roots.insert(stride::common::lowerCase(word.text));
    member = word.text == ".";
  }
  return roots;
}

bool isIdentifier(std::string_view text) {
  return !text.empty() && isLetter(text.front()) && endOfName(text, 0) == text.size();
}

bool isVariable(std::string_view text) {
  const std::vector<Word> words = wordsOf(text);
  if (words.empty() || words.front().kind != Word::Kind::Name)
    return false;
  int depth = 0;
  for (const Word &word : words) {
    depth += word.text == "[" ? 1 : 0;
    if (depth == 0 && word.kind == Word::Kind::Symbol && word.text != "." && word.text != "^")
      return false;
    depth -= word.text == "]" ? 1 : 0;
  }
  const std::string first = upperCase(words.front().text);
  return depth == 0 && first != "TRUE" && first != "FALSE" && first != "NOT" &&
         precedenceOf(text) == kPrimary;
}

} // namespace stc::import::networks
