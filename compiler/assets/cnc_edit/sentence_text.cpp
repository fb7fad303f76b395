// Sentences and lines of a CNC program that is edited.

#include "compiler/assets/cnc_edit/sentence_text.hpp"

#include "compiler/assets/cnc_edit/word_edits.hpp"

#include <algorithm>

namespace stc::gcode {

namespace {

using namespace stride::cnc;

bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isEnd(char c) { return c == '\n' || c == '\r'; }

} // namespace

std::vector<TextLine> linesOf(std::string_view text) {
  std::vector<TextLine> lines;
  for (size_t at = 0; at < text.size();) {
    TextLine line{at, at, {}};
    while (line.end < text.size() && !isEnd(text[line.end]))
      ++line.end;
    const bool both = text.substr(line.end, 2) == "\r\n";
    line.ending = text.substr(line.end, both ? 2 : 1);
    at = line.end + line.ending.size();
    lines.push_back(line);
  }
  return lines;
}

std::vector<EditSentence> sentencesOf(const CncProgram &program) {
  std::vector<EditSentence> sentences;
  const std::span<const CncWord> words = program.words;
  size_t begin = 0;
  for (size_t i = 0; i < words.size(); ++i) {
    if (words[i].word.letter != kEndOfSentence)
      continue;
    const bool skip = i > begin && words[begin].word.letter == kSkip;
    begin += skip ? 1 : 0;
    sentences.push_back({words.subspan(begin, i - begin), skip, words[i].word.integer});
    begin = i + 1;
  }
  return sentences;
}

SentenceText::SentenceText(std::string_view text, const EditSentence &sentence)
    : text_(text), sentence_(sentence), begin_(sentence.words.front().span.begin), end_(begin_) {
  while (begin_ > 0 && !isEnd(text[begin_ - 1]))
    --begin_;
  while (end_ < text.size() && !isEnd(text[end_]))
    ++end_;
}

void SentenceText::setNumber(const CncWord &word, const std::string &number) {
  changes_.push_back({numberPlace(text_, word), word.span.end, number});
}

void SentenceText::replace(const CncWord &word, const std::string &words) {
  changes_.push_back({word.span.begin, word.span.end, words});
}

void SentenceText::remove(const CncWord &word) {
  size_t begin = word.span.begin;
  size_t end = word.span.end;
  while (begin > begin_ && isBlank(text_[begin - 1]))
    --begin;
  if (begin == begin_) { // the blanks in front of all stay
    begin = word.span.begin;
    while (end < end_ && isBlank(text_[end]))
      ++end;
  }
  changes_.push_back({begin, end, {}});
}

void SentenceText::append(const std::string &words) {
  const size_t at = sentence_.words.back().span.end;
  changes_.push_back({at, at, " " + words});
}

void SentenceText::insertPlace(const std::string &words) {
  for (const char letter : std::string_view("ZYXKJIGN"))
    if (wordOf(sentence_.words, static_cast<uint8_t>(letter)) != nullptr)
      return insertBehind(static_cast<uint8_t>(letter), words);
  insertBehind(0, words);
}

void SentenceText::insertBehind(uint8_t letter, const std::string &words) {
  const CncWord *word = wordOf(sentence_.words, letter);
  const size_t at = word != nullptr ? word->span.end : sentence_.words.front().span.begin;
  changes_.push_back({at, at, word != nullptr ? " " + words : words + " "});
}

std::string SentenceText::apply() const {
  std::vector<Change> changes = changes_;
  std::stable_sort(changes.begin(), changes.end(), [](const Change &a, const Change &b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
  });
  std::string line;
  size_t at = begin_;
  for (const Change &change : changes) {
    const size_t begin = std::max(at, change.begin);
    line += text_.substr(at, begin - at);
    line += change.text;
    at = std::max(begin, change.end);
  }
  line += text_.substr(at, end_ - at);
  return line;
}

std::string_view SentenceText::indent() const {
  size_t at = begin_;
  while (at < end_ && isBlank(text_[at]))
    ++at;
  return text_.substr(begin_, at - begin_);
}

} // namespace stc::gcode
