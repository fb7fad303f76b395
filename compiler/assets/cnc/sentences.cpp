// The sentences of a CNC program as a decoder takes them, and which of them follow each other.

#include "compiler/assets/cnc/internal.hpp"

#include "runtime/numeric/cnc/decoder.hpp"

#include <algorithm>
#include <memory>

namespace stc {

using namespace stride::cnc;

namespace gcode {

Sentences::Sentences(const CncProgram &program) : program_(program) {
  words_.reserve(program.words.size() + 4);
  settings();
  added_ = words_.size();
  bool isM = false;
  int64_t begin = 0;
  for (const CncWord &word : program.words) {
    if (word.word.letter == kEndOfSentence) {
      isM = false;
      begin = size() + 1;
    }
    isM = isM || word.word.letter == 'M';
    if (word.word.letter == 'N')
      numbers_.try_emplace(word.word.integer, std::max(begin, static_cast<int64_t>(added_)));
    words_.push_back(placed(word, isM && word.word.letter == 'O'));
  }
}

void Sentences::settings() {
  const auto number = [this](uint8_t letter, double value) {
    GCodeWord word{};
    word.letter = letter;
    word.value = value;
    word.integer = wholePart(value);
    words_.push_back(word);
  };
  const CncSettings &settings = program_.settings;
  if (settings.velocity)
    number('F', *settings.velocity);
  if (settings.acceleration)
    number('E', *settings.acceleration);
  if (settings.deceleration)
    number('E', -*settings.deceleration);
  if (!words_.empty())
    number(kEndOfSentence, 0);
}

GCodeWord Sentences::placed(const CncWord &source, bool structure) {
  GCodeWord word = source.word;
  if (source.variable.empty())
    return word;
  const auto [found, isNew] = places_.try_emplace(lowerCase(source.variable));
  Place &place = found->second;
  if (isNew && source.initial) {
    place.number = source.initial->number;
    std::copy(source.initial->parameters.begin(), source.initial->parameters.end(),
              std::begin(place.parameters));
  }
  word.address = reinterpret_cast<uint8_t *>(structure ? place.parameters : &place.number);
  word.variables = static_cast<uint8_t>(structure ? VariableType::Structure : VariableType::Lreal);
  return word;
}

int64_t Sentences::find(int32_t number) const {
  const auto found = numbers_.find(number);
  return found != numbers_.end() ? found->second : -1;
}

const CncWord *Sentences::source(const SentenceWords &sentence, int32_t word) const {
  const auto first = static_cast<size_t>(sentence.words - words_.data());
  if (first < added_ || sentence.count == 0)
    return nullptr;
  const int32_t inside = std::min(std::max(word, 0), sentence.count - 1);
  return &program_.words[first - added_ + static_cast<size_t>(inside)];
}

bool isFunction(const SentenceWords &sentence, int32_t function) {
  return std::any_of(sentence.words, sentence.words + sentence.count, [=](const GCodeWord &word) {
    return word.letter == 'G' && word.address == nullptr && word.integer == function;
  });
}

bool hasVariable(const SentenceWords &sentence) {
  return std::any_of(sentence.words, sentence.words + sentence.count,
                     [](const GCodeWord &word) { return word.address != nullptr; });
}

void JumpWatch::pass(const SentenceWords &sentence) {
  if (decided_ && hasVariable(sentence) &&
      (isFunction(sentence, 20) || isFunction(sentence, 36) || isFunction(sentence, 37)))
    decided_ = false;
}

bool JumpWatch::jumpsForEver(int64_t position, int16_t counter) {
  constexpr size_t kMost = 1'000'000;
  constexpr uint32_t kBits = 16;
  const uint64_t state = static_cast<uint64_t>(position) << kBits | static_cast<uint16_t>(counter);
  return decided_ && seen_.size() < kMost && !seen_.insert(state).second;
}

} // namespace gcode

namespace {

/// So many sentences are gone through for each of the program, in loops.
constexpr size_t kRounds = 1000;
constexpr size_t kLeastSentences = 100'000;
constexpr size_t kMostSentences = 20'000'000;

} // namespace

CncDecoded decodeCnc(const CncProgram &program, const std::function<bool(const PathObject &)> &take,
                     CncOrigins *origins) {
  const gcode::Sentences sentences(program);
  const auto decoder = std::make_unique<Decoder>();
  const auto decoded = std::make_unique<Decoded>();
  startDecoder(*decoder, program.settings.start);
  decoder->softMotion3 = program.settings.softMotion3;
  const auto takeAll = [&] {
    return std::all_of(decoded->objects, decoded->objects + decoded->count, take);
  };
  gcode::JumpWatch watch;
  size_t left = std::clamp(program.words.size() * kRounds, kLeastSentences, kMostSentences);
  SentenceWords sentence{};
  for (int64_t at = 0; at < sentences.size();) {
    const int64_t begin = at;
    at = sentences.at(begin, sentence);
    if (sentence.skip && program.settings.stepSuppress)
      continue;
    const auto end = [&](CncEnd how, GCodeError error) {
      return CncDecoded{how, error, sentences.source(sentence, decoded->word)};
    };
    watch.pass(sentence);
    decodeSentence(*decoder, sentence.words, sentence.count, sentence.line, *decoded);
    if (origins != nullptr) // a spline comes out later than it gets its number
      origins->resize(static_cast<size_t>(decoder->objects), sentences.source(sentence, 0));
    if (decoded->error != GCodeError::None)
      return end(CncEnd::Wrong, decoded->error);
    if (!takeAll())
      return end(CncEnd::Refused, GCodeError::None);
    if (decoded->next == Next::Jump) {
      if (watch.jumpsForEver(begin, decoder->counter))
        return end(CncEnd::Endless, GCodeError::None);
      at = sentences.find(decoded->target);
      if (at < 0)
        return end(CncEnd::Wrong, GCodeError::UnknownJump);
    }
    if (--left == 0)
      return end(CncEnd::Endless, GCodeError::None);
  }
  decodeEnd(*decoder, *decoded);
  if (!takeAll())
    return {CncEnd::Refused, GCodeError::None, nullptr};
  return {CncEnd::Complete, GCodeError::None, nullptr};
}

} // namespace stc
