#include "compiler/import/dialect.hpp"

#include "compiler/import/st_words.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stc::import {

namespace {

bool isDecimal(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return (c >= '0' && c <= '9') || c == '_'; });
}

/// Whether what comes after the point makes it something else: a fraction, a range, a member.
bool goesOn(std::string_view rest) {
  if (rest.empty())
    return false;
  const char c = rest.front();
  return c == '.' || c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
         (c >= 'A' && c <= 'Z');
}

/// Puts a 0 after points that end a number; how many.
size_t completeFractions(std::string &text) {
  std::string result;
  size_t done = 0;
  size_t count = 0;
  size_t before = 0; // the end of the last word
  bool afterPoint = false;
  for (const StWord &word : wordsOf(text)) {
    const bool touches = word.begin == before && before != 0;
    // `1.5`: the 5 is no number of its own; `a.5`: it is a bit.
    if (word.kind == StWord::Kind::Number && !(touches && afterPoint) && word.end < text.size() &&
        text[word.end] == '.' &&
        isDecimal(std::string_view(text).substr(word.begin, word.end - word.begin)) &&
        !goesOn(std::string_view(text).substr(word.end + 1))) {
      result += text.substr(done, word.end + 1 - done);
      result += '0';
      done = word.end + 1;
      ++count;
    }
    afterPoint = text[word.begin] == '.';
    before = word.end;
  }
  if (count != 0)
    text = result + text.substr(done);
  return count;
}

} // namespace

void settleDialect(Model &model) {
  for (Object &object : model.objects)
    if (const size_t count = completeFractions(object.text); count != 0)
      model.changed.push_back({object.origin, object.name,
                               fmt::format("a 0 was added to {} {} with a point at the end", count,
                                           count == 1 ? "number" : "numbers")});
}

} // namespace stc::import
