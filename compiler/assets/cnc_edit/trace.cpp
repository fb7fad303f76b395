// What a CNC program that is edited does.

#include "compiler/assets/cnc_edit/trace.hpp"

#include "compiler/assets/cnc/internal.hpp"
#include "compiler/assets/cnc_edit/word_edits.hpp"

#include "runtime/numeric/cnc/decoder.hpp"

#include <algorithm>
#include <memory>

namespace stc::gcode {

namespace {

using namespace stride::cnc;

constexpr uint16_t kSpace = 7; ///< X, Y, Z

class Tracer {
public:
  Tracer(const CncProgram &program, Diagnostics &diagnostics)
      : program_(program), diagnostics_(diagnostics), sentences_(program) {
    trace_.sentences = sentencesOf(program);
    trace_.origins.push_back({});
  }

  std::optional<CncTrace> run() {
    startDecoder(*decoder_, program_.settings.start);
    decoder_->softMotion3 = program_.settings.softMotion3;
    index();
    for (int64_t at = 0; at < sentences_.size();) {
      const int64_t begin = at;
      at = sentences_.at(begin, words_);
      watch_.pass(words_);
      if (!step(indexAt_[static_cast<size_t>(begin)]))
        return std::nullopt;
      if (decoded_->next != Next::Jump)
        continue;
      trace_.endless = watch_.jumpsForEver(begin, decoder_->counter);
      at = sentences_.find(decoded_->target);
      if (trace_.endless || at < 0)
        break;
    }
    decodeEnd(*decoder_, *decoded_);
    take();
    trace_.visitOf.resize(trace_.objects.size(), static_cast<int32_t>(trace_.visits.size()) - 1);
    for (size_t i = 0; i < trace_.objects.size(); ++i)
      if (CncVisit &visit = trace_.visits[static_cast<size_t>(trace_.visitOf[i])];
          isMotion(trace_.objects[i]) && visit.object < 0)
        visit.object = static_cast<int32_t>(i);
    return std::move(trace_);
  }

private:
  /// Which sentence begins at which word.
  void index() {
    indexAt_.resize(static_cast<size_t>(sentences_.size()));
    int32_t count = 0;
    for (int64_t at = 0; at < sentences_.size(); ++count) {
      indexAt_[static_cast<size_t>(at)] = count;
      at = sentences_.at(at, words_);
    }
  }

  void take() {
    trace_.objects.insert(trace_.objects.end(), decoded_->objects,
                          decoded_->objects + decoded_->count);
  }

  bool refuse(const CncWord &word, const char *message, const char *label, const char *help) {
    refuseEdit(word.span, message, label, help, diagnostics_);
    return false;
  }

  bool step(int32_t sentence) {
    const std::span<const CncWord> words = trace_.sentences[static_cast<size_t>(sentence)].words;
    CncVisit visit;
    visit.sentence = sentence;
    visit.unknown = unknown_;
    visit.relative = decoder_->relative;
    visit.centreAbsolute = decoder_->centreAbsolute;
    visit.origin = static_cast<int32_t>(trace_.origins.size()) - 1;
    if (!words.empty() && !check(words))
      return false;
    decodeSentence(*decoder_, words_.words, words_.count, words_.line, *decoded_);
    if (decoded_->error != GCodeError::None) {
      gcode::report(decoded_->error, words[static_cast<size_t>(decoded_->word)].span, diagnostics_);
      return false;
    }
    take();
    trace_.visitOf.resize(static_cast<size_t>(decoder_->objects),
                          static_cast<int32_t>(trace_.visits.size()));
    const CncWord *g = wordOf(words, 'G');
    visit.function = wordOf(words, 'M') != nullptr ? -1
                     : g != nullptr                ? g->word.integer
                                                   : decoder_->motion;
    trace_.visits.push_back(visit);
    noteUnknown(words, visit);
    noteOrigin();
    return checkSize(words);
  }

  /// What makes the way through the program unknown.
  bool check(std::span<const CncWord> words) {
    const CncWord *g = wordOf(words, 'G');
    if (g == nullptr)
      return true;
    if (!g->variable.empty())
      return refuse(*g, "a variable says what this sentence does", "not known now",
                    "write the number of the function");
    if (g->word.integer == 20)
      for (const char letter : {'K', 'L'})
        if (const CncWord *word = wordOf(words, static_cast<uint8_t>(letter));
            word != nullptr && !word->variable.empty())
          return refuse(*word, "a variable decides about this jump", "not known now",
                        "the counter (G36, G37 without O) and numbers can decide, too");
    return g->word.integer < 54 || g->word.integer > 56 || checkOrigin(words);
  }

  bool checkOrigin(std::span<const CncWord> words) {
    for (const CncWord &word : words)
      if (!word.variable.empty())
        return refuse(word, "a variable says where the coordinates begin", "not known now",
                      "write a number");
    for (const char letter : {'A', 'B', 'C', 'I', 'J', 'K'})
      if (const CncWord *word = wordOf(words, static_cast<uint8_t>(letter)))
        return refuse(*word, "the program may turn or scale its coordinates",
                      "what this means is up to the application",
                      "change the words of the path instead");
    return true;
  }

  /// Which places are not known, because variables say them.
  void noteUnknown(std::span<const CncWord> words, const CncVisit &visit) {
    const int32_t function = visit.function;
    if (function == 36 || function == 37 || function == 38 || function == 39 || function == 4 ||
        wordOf(words, 'M') != nullptr)
      return;
    for (size_t axis = 0; axis < kAxisWords.size(); ++axis) {
      const CncWord *word = wordOf(words, static_cast<uint8_t>(kAxisWords[axis]));
      if (word == nullptr)
        continue;
      const auto bit = static_cast<uint16_t>(1U << axis);
      if (!word->variable.empty())
        unknown_ = static_cast<uint16_t>(unknown_ | bit);
      else if (!visit.relative && (function < 53 || function == 92))
        unknown_ = static_cast<uint16_t>(unknown_ & ~bit);
    }
    const CncWord *turn = wordOf(words, 'T');
    for (const char letter : {'I', 'J', 'K', 'T'})
      if (const CncWord *word = wordOf(words, static_cast<uint8_t>(letter));
          turn != nullptr && word != nullptr && !word->variable.empty())
        unknown_ = static_cast<uint16_t>(unknown_ | kSpace);
  }

  void noteOrigin() {
    CncTrace::Origin origin;
    std::copy(std::begin(decoder_->shift), std::end(decoder_->shift), origin.begin());
    if (origin != trace_.origins.back())
      trace_.origins.push_back(origin);
  }

  bool checkSize(std::span<const CncWord> words) {
    return words.empty() ||
           (trace_.objects.size() < kMostCncObjects &&
            trace_.visits.size() < 20 * kMostCncObjects) ||
           refuse(words.front(), "the path of this program is too long", "reached up to here",
                  "paths of up to 1,000,000 objects can be changed so");
  }

  const CncProgram &program_;
  Diagnostics &diagnostics_;
  Sentences sentences_;
  JumpWatch watch_;
  std::unique_ptr<Decoder> decoder_ = std::make_unique<Decoder>();
  std::unique_ptr<Decoded> decoded_ = std::make_unique<Decoded>();
  std::vector<int32_t> indexAt_; ///< By word.
  SentenceWords words_{};
  uint16_t unknown_ = 0;
  CncTrace trace_;
};

} // namespace

void assumeVariables(CncProgram &program) {
  for (CncWord &word : program.words)
    if (!word.variable.empty())
      word.initial = CncInitial{word.word.letter == 'S' ? 3.0 : 1.0, {}};
}

std::optional<CncProgram> readForTrace(const SourceFile &file, Diagnostics &diagnostics) {
  std::optional<CncProgram> program = readForEdit(file, diagnostics);
  if (program)
    assumeVariables(*program);
  return program;
}

std::optional<CncTrace> traceCnc(const CncProgram &program, Diagnostics &diagnostics) {
  return Tracer(program, diagnostics).run();
}

} // namespace stc::gcode
