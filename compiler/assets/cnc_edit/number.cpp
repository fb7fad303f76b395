// New numbers of sentences.

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/assets/cnc/nc_source.hpp"
#include "compiler/assets/cnc_edit/cnc_edit.hpp"
#include "compiler/assets/cnc_edit/text_edits.hpp"
#include "compiler/assets/cnc_edit/word_edits.hpp"
#include "runtime/numeric/cnc/decoder.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <unordered_map>

namespace stc {

namespace {

using namespace stride::cnc;

/// The words of a sentence without its end.
using Words = std::span<const CncWord>;

std::vector<Words> sentencesOf(const CncProgram &program) {
  std::vector<Words> sentences;
  size_t begin = 0;
  for (size_t i = 0; i < program.words.size(); ++i)
    if (program.words[i].word.letter == kEndOfSentence) {
      sentences.push_back(Words(program.words).subspan(begin, i - begin));
      begin = i + 1;
    }
  return sentences;
}

using gcode::wordOf;

class Numberer {
public:
  Numberer(const CncProgram &program, const CncNumbering &numbering, Diagnostics &diagnostics)
      : sentences_(sentencesOf(program)), numbering_(numbering), diagnostics_(diagnostics) {}

  std::vector<Edit> edits() {
    const int64_t last =
        numbering_.first + static_cast<int64_t>(sentences_.size()) * numbering_.step;
    if (last - numbering_.step > std::numeric_limits<int32_t>::max()) {
      const Span span = sentences_.back().empty() ? Span{} : sentences_.back().front().span;
      diagnostics_
          .report(Code::CncSentence, span, "the numbers of sentences go up to 2147483647",
                  fmt::format("this one would have {}", last - numbering_.step))
          .help("begin with a lower number, or take a smaller step");
      return {};
    }
    for (size_t i = 0; i < sentences_.size(); ++i)
      if (const CncWord *word = wordOf(sentences_[i], 'N'); word != nullptr)
        numbers_.try_emplace(word->word.integer, numberOf(i));
    for (size_t i = 0; i < sentences_.size(); ++i) {
      number(sentences_[i], numberOf(i));
      follow(sentences_[i]);
    }
    std::sort(edits_.begin(), edits_.end(),
              [](const Edit &a, const Edit &b) { return a.span.begin < b.span.begin; });
    return std::move(edits_);
  }

private:
  [[nodiscard]] int32_t numberOf(size_t sentence) const {
    return static_cast<int32_t>(numbering_.first +
                                static_cast<int64_t>(sentence) * numbering_.step);
  }

  void number(Words sentence, int32_t number) {
    const std::string text = fmt::format("N{}", number);
    if (wordOf(sentence, 'N') != nullptr) {
      // The left one counts; another one shall not look as if it did.
      for (const CncWord &word : sentence)
        if (word.word.letter == 'N')
          edits_.push_back({word.span, text});
      return;
    }
    const bool skips = sentence.front().word.letter == kSkip;
    Span place = sentence.front().span;
    if (sentence.size() == kMostWords)
      diagnostics_.report(Code::CncSentence, place, "this sentence has no room for a number",
                          fmt::format("it has {} words", kMostWords));
    (skips ? place.begin : place.end) = skips ? place.end : place.begin;
    edits_.push_back({place, skips ? text : text + " "});
    if (skips && sentence.size() > 1 && sentence[1].span.begin == place.begin)
      edits_.back().text += " ";
  }

  /// A jump leads to the new number of its target.
  void follow(Words sentence) {
    const CncWord *function = wordOf(sentence, 'G');
    const CncWord *target = wordOf(sentence, 'L');
    if (function == nullptr || target == nullptr)
      return;
    if (!function->variable.empty()) {
      report(*function, "a variable may make this sentence a jump", "20 is a jump to N of L");
      return;
    }
    if (function->word.integer != 20)
      return;
    if (!target->variable.empty()) {
      report(*target, "this jump leads to a number that only the running program knows",
             "would lead to an old number");
      return;
    }
    const auto found = numbers_.find(target->word.integer);
    if (found == numbers_.end() || target->word.value != target->word.integer) {
      diagnostics_.report(Code::CncJump, target->span, "no sentence has the number of this jump",
                          "the jump leads nowhere");
      return;
    }
    edits_.push_back({target->span, fmt::format("L{}", found->second)});
  }

  void report(const CncWord &word, const char *message, const char *label) {
    diagnostics_.report(Code::CncJump, word.span, message, label)
        .help("write a sentence G20 with a number for each target and K as its condition");
  }

  std::vector<Words> sentences_;
  CncNumbering numbering_;
  Diagnostics &diagnostics_;
  std::unordered_map<int32_t, int32_t> numbers_; ///< New by old ones.
  std::vector<Edit> edits_;
};

} // namespace

std::optional<std::string> numberCnc(const SourceFile &file, const CncNumbering &numbering,
                                     Diagnostics &diagnostics) {
  const size_t errors = diagnostics.errorCount();
  if (needsNcLanguage(file.text())) {
    diagnostics
        .report(Code::CncText, {file.id(), 0, 0},
                "programs with expressions and subprograms cannot be edited yet", "left as it is")
        .help("change its text");
    return std::nullopt;
  }
  const std::optional<CncProgram> program = readCnc(file, diagnostics);
  if (!program)
    return std::nullopt;
  const std::vector<Edit> edits = Numberer(*program, numbering, diagnostics).edits();
  if (diagnostics.errorCount() != errors)
    return std::nullopt;
  return gcode::editedText(file.text(), edits);
}

} // namespace stc
