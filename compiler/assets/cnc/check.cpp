// What is wrong with the sentences of a CNC program: the decoder of the runtime says it.

#include "compiler/assets/cnc/internal.hpp"

#include "runtime/numeric/cnc/decoder.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace stc {

using namespace stride::cnc;

namespace {

struct ErrorRow {
  GCodeError error;
  Code code;
  const char *message;
  const char *label;
  const char *help;
};

constexpr ErrorRow kErrors[] = {
    {GCodeError::UnknownFunction, Code::CncFunction, "there is no such G function",
     "not a function of this language", "docs/cnc.md lists the G functions"},
    {GCodeError::NoFunction, Code::CncFunction, "a motion needs a G function",
     "no sentence before this one has one", "begin with G0, G1, G2 or G3"},
    {GCodeError::TwoInstructions, Code::CncFunction, "a sentence has one G or M function",
     "one more", "write a sentence for each"},
    {GCodeError::MissingWord, Code::CncSentence, "a word is missing",
     "this function needs one more word", "docs/cnc.md says which words a function has"},
    {GCodeError::NotWhole, Code::CncSentence, "this word needs a whole number", "it has a fraction",
     ""},
    {GCodeError::Acceleration, Code::CncSentence, "an acceleration is 1 at least", "less than 1",
     "E100 is an acceleration, E-100 a deceleration"},
    {GCodeError::Deceleration, Code::CncSentence, "a deceleration is -1 at most",
     "between -1 and 0", "E100 is an acceleration, E-100 a deceleration"},
    {GCodeError::NotInThisPlane, Code::CncSentence,
     "this function works in the plane of X and Y only", "another plane is chosen",
     "choose it with G15 or G17"},
    {GCodeError::NegativePeriod, Code::CncSentence, "the period of an axis is not negative",
     "less than 0", ""},
    {GCodeError::TurnOfEllipse, Code::CncSentence, "an ellipse has no opening angle",
     "a word of G2 and G3", "say where G8 and G9 end by X and Y"},
    {GCodeError::PartOfTurn, Code::CncSentence, "A, B and C turn the coordinates together",
     "some of them are missing", "angles that stay as they are: write them, too"},
    {GCodeError::Tilted, Code::CncSentence, "after G15 the program's Z is the machine's",
     "it would be tilted", "choose G17, or another plane, before"},
    {GCodeError::Distorted, Code::CncSentence, "X, Y and Z are scaled by different factors",
     "makes another curve of this one", "the axes of its plane need the same factor"},
    {GCodeError::TurnOfScale, Code::CncSentence, "X, Y and Z are scaled by different factors",
     "they cannot be turned now", "G54 says angles and factors at once"},
    {GCodeError::PartOfScale, Code::CncSentence, "I, J and K scale the coordinates together",
     "some of them are missing", "a factor of 1 leaves an axis as it is"},
    {GCodeError::BadScale, Code::CncSentence, "factors of X, Y and Z are positive", "0 or less",
     ""},
    {GCodeError::UnknownJump, Code::CncJump, "no sentence has the number of this jump",
     "the jump leads nowhere", "L is the number N of the sentence to go on with"},
    {GCodeError::NotANumber, Code::CncSentence, "the value of this variable is no number",
     "infinite, or none", ""},
    {GCodeError::NoVariable, Code::CncSentence, "this word needs a variable", "a number",
     "variables stand between dollar signs: O$g_iCount$"},
    {GCodeError::WrongVariable, Code::CncVariable, "a variable of this type is not possible here",
     "this variable", ""},
};

} // namespace

gcode::SentenceError gcode::describe(GCodeError error) {
  if (error == GCodeError::TooManySwitches)
    return {Code::CncSentence, fmt::format("an object has {} switch points at most", kMostSwitches),
            "one more", ""};
  const auto *const row = std::find_if(std::begin(kErrors), std::end(kErrors),
                                       [&](const ErrorRow &each) { return each.error == error; });
  if (row != std::end(kErrors))
    return {row->code, row->message, row->label, row->help};
  return {Code::CncSentence, "the value of this word is out of range", "not allowed here", ""};
}

void gcode::report(GCodeError error, Span span, Diagnostics &diagnostics) {
  const SentenceError words = describe(error);
  Diagnostic &diagnostic = diagnostics.report(words.code, span, words.message, words.label);
  if (!words.help.empty())
    diagnostic.help(words.help);
}

namespace {

class Checker {
public:
  Checker(const CncProgram &program, Diagnostics &diagnostics)
      : program_(program), diagnostics_(diagnostics), sentences_(program) {}

  void check() {
    startDecoder(*decoder_, program_.settings.start);
    decoder_->softMotion3 = program_.settings.softMotion3;
    follow();
    // What has not been reached: where the path is there, nobody knows.
    uncertain_ = velocityReported_ = true;
    for (int64_t at = 0; at < sentences_.size();) {
      const int64_t begin = at;
      at = sentences_.at(begin, sentence_);
      if (!seen_[static_cast<size_t>(begin)])
        step();
    }
  }

private:
  /// Goes through the sentences as they follow each other, jumps included.
  void follow() {
    constexpr size_t kLeast = 100'000;
    size_t left = std::max(kLeast, program_.words.size());
    for (int64_t at = 0; at < sentences_.size() && left > 0; --left) {
      const int64_t begin = at;
      at = sentences_.at(begin, sentence_);
      watch_.pass(sentence_);
      if (seen_[static_cast<size_t>(begin)])
        decode();
      else
        step();
      seen_[static_cast<size_t>(begin)] = true;
      if (decoded_->error != GCodeError::None || decoded_->next != Next::Jump)
        continue;
      if (watch_.jumpsForEver(begin, decoder_->counter)) {
        reportEndless();
        return;
      }
      const int64_t target = sentences_.find(decoded_->target);
      at = target >= 0 ? target : at;
    }
  }

  [[nodiscard]] const CncWord *wordAt(int32_t index) const {
    return sentences_.source(sentence_, index);
  }

  void decode() {
    decodeSentence(*decoder_, sentence_.words, sentence_.count, sentence_.line, *decoded_);
    uncertain_ = uncertain_ || gcode::hasVariable(sentence_);
  }

  /// A sentence for the first time.
  void step() {
    decode();
    if (decoded_->error != GCodeError::None) {
      const CncWord *word = wordAt(decoded_->word);
      if (word != nullptr && (word->variable.empty() || !isValue(decoded_->error)))
        gcode::report(decoded_->error, word->span, diagnostics_);
      return;
    }
    checkJump();
    if (const CncWord *word = wordAt(decoded_->noteWord); decoded_->notes != 0 && word != nullptr)
      reportNotes(word->span);
  }

  /// Whether it depends on the value of a variable, which is not known.
  static bool isValue(GCodeError error) {
    return error != GCodeError::NoVariable && error != GCodeError::TooManySwitches;
  }

  [[nodiscard]] const CncWord *find(char letter) const {
    for (int32_t i = 0; i < sentence_.count; ++i)
      if (sentence_.words[i].letter == letter)
        return wordAt(i);
    return nullptr;
  }

  void checkJump() {
    const CncWord *target = find('L');
    if (!gcode::isFunction(sentence_, 20) || target == nullptr || !target->variable.empty() ||
        sentences_.find(target->word.integer) >= 0)
      return;
    diagnostics_
        .report(Code::CncJump, target->span,
                fmt::format("no sentence has the number N{}", target->word.integer),
                "the jump leads nowhere")
        .help("L is the number N of the sentence to go on with");
  }

  void reportEndless() {
    const CncCompile compile = program_.settings.compile;
    const bool queue = compile == CncCompile::Queue || compile == CncCompile::QueueFile;
    const CncWord *place = find('L');
    diagnostics_
        .report(queue ? Code::CncJump : Code::CncEndless,
                place != nullptr ? place->span : program_.span,
                "the jumps of this program do not end", "goes on here for ever")
        .help(queue ? "a queue needs an end: let K or the counter (G36, G37) become 0"
                    : "the application has to end it; if there is no motion between the jumps, "
                      "SMC_NCDecoder does, with SMC_DEC_ENDLESS_JUMPS");
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
  gcode::Sentences sentences_;
  gcode::JumpWatch watch_;
  std::vector<bool> seen_ = std::vector<bool>(static_cast<size_t>(sentences_.size())); ///< By word.
  std::unique_ptr<Decoder> decoder_ = std::make_unique<Decoder>();
  std::unique_ptr<Decoded> decoded_ = std::make_unique<Decoded>();
  SentenceWords sentence_{};
  bool uncertain_ = false; ///< Where the path is depends on variables.
  bool velocityReported_ = false;
};

} // namespace

void checkCnc(const CncProgram &program, Diagnostics &diagnostics) {
  if (program.words.empty()) {
    diagnostics
        .report(Code::CncNoEffect, program.span, "this program has no sentence", "nothing moves")
        .help("a sentence is a line with words, as N10 G1 X100 F50");
    return;
  }
  Checker(program, diagnostics).check();
}

} // namespace stc
