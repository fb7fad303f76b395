// What is wrong with the sentences of a CNC program: the decoder of the runtime says it.

#include "compiler/assets/cnc/cnc_source.hpp"

#include "runtime/numeric/cnc/decoder.hpp"
#include "runtime/numeric/cnc/gcode_program.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <unordered_map>

namespace stc {

namespace {

using namespace stride::cnc;

struct Words {
  Code code;
  std::string message;
  std::string label;
  std::string help;
};

Words describe(GCodeError error) {
  switch (error) {
  case GCodeError::UnknownFunction:
    return {Code::CncFunction, "there is no such G function", "not a function of this language",
            "docs/cnc.md lists the G functions"};
  case GCodeError::NoFunction:
    return {Code::CncFunction, "a motion needs a G function", "no sentence before this one has one",
            "begin with G0, G1, G2 or G3"};
  case GCodeError::TwoInstructions:
    return {Code::CncFunction, "a sentence has one G or M function", "one more",
            "write a sentence for each"};
  case GCodeError::MissingWord:
    return {Code::CncSentence, "a word is missing", "this function needs one more word",
            "docs/cnc.md says which words a function has"};
  case GCodeError::NotWhole:
    return {Code::CncSentence, "this word needs a whole number", "it has a fraction", ""};
  case GCodeError::Acceleration:
    return {Code::CncSentence, "an acceleration is 1 at least", "less than 1",
            "E100 is an acceleration, E-100 a deceleration"};
  case GCodeError::Deceleration:
    return {Code::CncSentence, "a deceleration is -1 at most", "between -1 and 0",
            "E100 is an acceleration, E-100 a deceleration"};
  case GCodeError::TooManySwitches:
    return {Code::CncSentence, fmt::format("an object has {} switch points at most", kMostSwitches),
            "one more", ""};
  case GCodeError::NotInThisPlane:
    return {Code::CncSentence, "this function works in the plane of X and Y only",
            "another plane is chosen", "choose it with G15 or G17"};
  case GCodeError::NegativePeriod:
    return {Code::CncSentence, "the period of an axis is not negative", "less than 0", ""};
  case GCodeError::NoVariable:
    return {Code::CncSentence, "this word needs a variable", "a number",
            "variables stand between dollar signs: O$g_iCount$"};
  case GCodeError::WrongVariable:
    return {Code::CncVariable, "a variable of this type is not possible here", "this variable", ""};
  default:
    return {Code::CncSentence, "the value of this word is out of range", "not allowed here", ""};
  }
}

class Checker {
public:
  Checker(const CncProgram &program, Diagnostics &diagnostics)
      : program_(program), diagnostics_(diagnostics) {}

  void check() {
    collectNumbers();
    words_ = wordsOf(program_, storage_);
    const auto added = words_.size() - program_.words.size();
    startDecoder(*decoder_, program_.settings.start);
    SentenceWords sentence;
    const auto count = static_cast<int64_t>(words_.size());
    for (int64_t at = 0; at < count;) {
      at = sentenceAt(words_.data(), count, at, sentence);
      const auto first = static_cast<size_t>(sentence.words - words_.data());
      // The sentence of the settings has no place in the text.
      first_ = first < added ? nullptr : &program_.words[first - added];
      count_ = static_cast<size_t>(sentence.count);
      step(sentence);
    }
  }

private:
  void collectNumbers() {
    for (const CncWord &word : program_.words)
      if (word.word.letter == 'N')
        numbers_.try_emplace(word.word.integer, word.span);
  }

  [[nodiscard]] const CncWord *wordAt(int32_t index) const {
    if (first_ == nullptr || count_ == 0)
      return nullptr;
    return first_ + std::min(static_cast<size_t>(std::max(index, 0)), count_ - 1);
  }

  void step(const SentenceWords &sentence) {
    decodeSentence(*decoder_, sentence.words, sentence.count, sentence.line, *decoded_);
    for (size_t i = 0; first_ != nullptr && i < count_; ++i)
      uncertain_ = uncertain_ || !first_[i].variable.empty();
    if (decoded_->error != GCodeError::None) {
      const CncWord *word = wordAt(decoded_->word);
      if (word == nullptr || (!word->variable.empty() && isValue(decoded_->error)))
        return;
      const Words words = describe(decoded_->error);
      Diagnostic &diagnostic =
          diagnostics_.report(words.code, word->span, words.message, words.label);
      if (!words.help.empty())
        diagnostic.help(words.help);
      return;
    }
    checkJump();
    if (decoded_->notes != 0 && first_ != nullptr)
      reportNotes(wordAt(decoded_->noteWord)->span);
  }

  /// Whether it depends on the value of a variable, which is not known.
  static bool isValue(GCodeError error) {
    return error != GCodeError::NoVariable && error != GCodeError::TooManySwitches;
  }

  void checkJump() {
    const auto find = [this](char letter) -> const CncWord * {
      for (size_t i = 0; first_ != nullptr && i < count_; ++i)
        if (first_[i].word.letter == letter)
          return first_ + i;
      return nullptr;
    };
    const CncWord *function = find('G');
    const CncWord *target = find('L');
    if (function == nullptr || target == nullptr || !function->variable.empty() ||
        function->word.integer != 20 || !target->variable.empty() ||
        numbers_.contains(target->word.integer))
      return;
    diagnostics_
        .report(Code::CncJump, target->span,
                fmt::format("no sentence has the number N{}", target->word.integer),
                "the jump leads nowhere")
        .help("L is the number N of the sentence to go on with");
  }

  void reportNotes(Span span) {
    const uint16_t notes = decoded_->notes;
    if ((notes & kNoteCentreOff) != 0 && !uncertain_)
      diagnostics_
          .report(Code::CncArc, span, "a line is made of this curve", "its centre does not fit")
          .help("start and end must be equally far from the centre; G98 makes I and J absolute, "
                "G99 relative to the start");
    if ((notes & kNoteRadiusTooSmall) != 0 && !uncertain_)
      diagnostics_
          .report(Code::CncArc, span, "a line is made of this arc",
                  "its radius does not reach the end")
          .help("the radius is half the way from start to end at least");
    if ((notes & kNoteEmptyArc) != 0 && !uncertain_)
      diagnostics_
          .report(Code::CncArc, span, "this arc has no length",
                  "start and end are the same, or the centre")
          .help("a full circle needs its centre: I and J");
    if ((notes & kNoteNoProcessor) != 0)
      diagnostics_.report(Code::CncNoEffect, span, "nothing carries this out yet",
                          "only marks the objects");
    if ((notes & kNoteLostSwitch) != 0)
      diagnostics_.report(Code::CncNoEffect, span, "a switch point needs a motion",
                          "this sentence moves nothing");
    if ((notes & kNoteNoVelocity) != 0 && !velocityReported_) {
      velocityReported_ = true;
      diagnostics_
          .report(Code::CncNoVelocity, span, "no velocity has been programmed yet",
                  "this motion has the velocity 0")
          .help("say it with F, or in stride.toml: `default_velocity` of its [[cnc]]");
    }
  }

  const CncProgram &program_;
  Diagnostics &diagnostics_;
  std::unordered_map<int32_t, Span> numbers_;
  std::vector<CncVariable> storage_;
  std::vector<GCodeWord> words_;
  std::unique_ptr<Decoder> decoder_ = std::make_unique<Decoder>();
  std::unique_ptr<Decoded> decoded_ = std::make_unique<Decoded>();
  const CncWord *first_ = nullptr; ///< Of the sentence; null: not of the text.
  size_t count_ = 0;
  bool uncertain_ = false; ///< Where the path is depends on variables.
  bool velocityReported_ = false;
};

} // namespace

std::vector<GCodeWord> wordsOf(const CncProgram &program, std::vector<CncVariable> &storage) {
  std::vector<GCodeWord> words;
  const auto number = [&words](uint8_t letter, double value) {
    GCodeWord word{};
    word.letter = letter;
    word.value = value;
    word.integer = wholePart(value);
    words.push_back(word);
  };
  const CncSettings &settings = program.settings;
  if (settings.velocity)
    number('F', *settings.velocity);
  if (settings.acceleration)
    number('E', *settings.acceleration);
  if (settings.deceleration)
    number('E', -*settings.deceleration);
  if (!words.empty())
    number(kEndOfSentence, 0);
  storage.assign(program.words.size(), {});
  bool isM = false;
  for (size_t i = 0; i < program.words.size(); ++i) {
    GCodeWord word = program.words[i].word;
    if (word.letter == kEndOfSentence)
      isM = false;
    isM = isM || word.letter == 'M';
    if (!program.words[i].variable.empty()) {
      const bool structure = word.letter == 'O' && isM;
      word.address =
          reinterpret_cast<uint8_t *>(structure ? storage[i].parameters : &storage[i].number);
      word.variables =
          static_cast<uint8_t>(structure ? VariableType::Structure : VariableType::Lreal);
    }
    words.push_back(word);
  }
  return words;
}

void checkCnc(const CncProgram &program, Diagnostics &diagnostics) {
  Checker(program, diagnostics).check();
}

} // namespace stc
