// What the words of a sentence say.
#include "runtime/numeric/cnc/decoder_internal.hpp"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cnc {
namespace {

constexpr double kLeastAcceleration = 1.0; // [u/s^2]; ERR_DEC_ACC_TOO_LITTLE
constexpr int32_t kFirstProfile = 3;       // S
constexpr int32_t kLastProfile = 11;

/// What is being read, from right to left.
struct Reading {
  Decoder &decoder;
  Sentence &sentence;
  Decoded &result;
  int32_t index; ///< Of the word.
  double value;
  double position; ///< The last L or O: what the next H takes.
  bool hasPosition;
  bool way;
};

bool bad(Reading &in, GCodeError error) noexcept { return fail(in.result, error, in.index); }

/// E and EF, and those of an axis: the sign says which of the two.
template <class Number>
bool readAcceleration(Reading &in, Number &acceleration, Number &deceleration) noexcept {
  if (in.value >= kLeastAcceleration) {
    acceleration = static_cast<Number>(in.value);
    return true;
  }
  if (in.value <= -kLeastAcceleration) {
    deceleration = static_cast<Number>(-in.value);
    return true;
  }
  return bad(in, in.value < 0 ? GCodeError::Deceleration : GCodeError::Acceleration);
}

bool readVelocity(Reading &in, double &velocity) noexcept {
  if (in.value < 0)
    return bad(in, GCodeError::OutOfRange);
  velocity = in.value;
  return true;
}

/// Words of an axis: FZ …, EZ …, PA …
bool readAxisWord(Reading &in, uint8_t code) noexcept {
  note(in.result, kNoteNoProcessor, in.index);
  if (code < kFirstAccelerationLimit) {
    double velocity = 0.0;
    if (!readVelocity(in, velocity))
      return false;
    in.decoder.limits[code - kFirstVelocityLimit].velocity = static_cast<float>(velocity);
    return true;
  }
  AxisLimits &limits = in.decoder.limits[code - kFirstAccelerationLimit];
  if (in.value != 0.0)
    return readAcceleration(in, limits.acceleration, limits.deceleration);
  limits.acceleration = limits.deceleration = 0.0F;
  return true;
}

bool readPeriod(Reading &in, uint8_t code) noexcept {
  if (in.value < 0.0)
    return bad(in, GCodeError::NegativePeriod);
  in.decoder.period[code - kFirstPeriod] = in.value;
  return true;
}

/// Words of more than one letter.
bool readLongWord(Reading &in, uint8_t code) noexcept {
  Decoder &d = in.decoder;
  if (code == kRapidVelocity)
    return readVelocity(in, d.rapidVelocity);
  if (code == kRapidAcceleration) {
    if (in.value != 0.0)
      return readAcceleration(in, d.rapidAcceleration, d.rapidDeceleration);
    d.rapidAcceleration = d.rapidDeceleration = 0.0;
    return true;
  }
  if (code == kProbe) {
    if (!(in.value >= 1.0 && in.value <= 65535.0))
      return bad(in, GCodeError::OutOfRange);
    in.sentence.probe = static_cast<int32_t>(in.value);
    return true;
  }
  return code >= kFirstPeriod ? readPeriod(in, code) : readAxisWord(in, code);
}

bool readSwitch(Reading &in) noexcept {
  Sentence &s = in.sentence;
  if (!(in.value >= -32768.0 && in.value <= 32767.0) || in.value == 0.0)
    return bad(in, GCodeError::OutOfRange);
  if (!in.hasPosition)
    return bad(in, GCodeError::MissingWord);
  if (s.switchCount == kMostSwitches)
    return bad(in, GCodeError::TooManySwitches);
  // From right to left: the first one of the text shall be the first.
  for (int32_t i = s.switchCount; i > 0; --i)
    s.switches[i] = s.switches[i - 1];
  ++s.switchCount;
  s.switches[0] = {in.position, static_cast<int16_t>(in.value), in.way};
  in.hasPosition = false;
  return true;
}

bool readProfile(Reading &in) noexcept {
  const double axis = exact::fabs(in.value);
  if (!(axis >= kFirstProfile && axis <= kLastProfile))
    return bad(in, GCodeError::OutOfRange);
  const auto bit = static_cast<uint16_t>(1U << (static_cast<uint32_t>(axis) - 1));
  in.decoder.profile =
      in.value > 0.0 ? in.decoder.profile | bit : static_cast<uint16_t>(in.decoder.profile & ~bit);
  return true;
}

bool readFunction(Reading &in, bool isM) noexcept {
  Sentence &s = in.sentence;
  if (s.function >= 0)
    return bad(in, GCodeError::TwoInstructions);
  if (!(in.value >= (isM ? 1.0 : 0.0) && in.value <= 65532.0))
    return bad(in, isM ? GCodeError::OutOfRange : GCodeError::UnknownFunction);
  s.function = static_cast<int32_t>(in.value);
  s.functionAt = static_cast<int8_t>(in.index);
  s.isM = isM;
  return true;
}

/// What letters do besides having a value.
bool readLetter(Reading &in, char letter) noexcept {
  Decoder &d = in.decoder;
  switch (letter) {
  case 'N':
    in.sentence.number = wholePart(in.value);
    return true;
  case 'G':
  case 'M':
    return readFunction(in, letter == 'M');
  case 'F':
    return readVelocity(in, d.velocity);
  case 'E':
    return readAcceleration(in, d.acceleration, d.deceleration);
  case 'H':
    return readSwitch(in);
  case 'S':
    return readProfile(in);
  case 'L':
  case 'O':
    in.position = in.value;
    in.way = letter == 'L';
    in.hasPosition = true;
    return true;
  default:
    return true;
  }
}

bool readWord(Reading &in, const GCodeWord &word) noexcept {
  if (word.letter == kSkip)
    return true;
  in.value = valueOf(word);
  const bool structure = word.letter == 'O' && word.address != nullptr &&
                         static_cast<VariableType>(word.variables) == VariableType::Structure;
  if (!exact::isfinite(in.value) && !structure)
    return bad(in, GCodeError::NotANumber);
  if (word.letter < 'A' || word.letter > 'Z')
    return isWord(word.letter) ? readLongWord(in, word.letter) : bad(in, GCodeError::UnknownWord);
  if (wantsWhole(word.letter) && static_cast<double>(wholePart(in.value)) != in.value)
    return bad(in, GCodeError::NotWhole);
  in.sentence.value[word.letter - 'A'] = in.value;
  in.sentence.at[word.letter - 'A'] = static_cast<int8_t>(in.index);
  return readLetter(in, static_cast<char>(word.letter));
}

} // namespace

bool fail(Decoded &result, GCodeError error, int32_t index) noexcept {
  result.error = error;
  result.word = index;
  return false;
}

void note(Decoded &result, Note what, int32_t index) noexcept {
  if (result.notes == 0)
    result.noteWord = static_cast<uint8_t>(index < 0 ? 0 : index);
  result.notes = static_cast<uint16_t>(result.notes | what);
}

bool readSentence(Decoder &decoder, const GCodeWord *words, int32_t count, int32_t line,
                  Sentence &sentence, Decoded &result) noexcept {
  sentence.words = words;
  __builtin_memset(sentence.at, -1, sizeof sentence.at);
  sentence.switchCount = 0;
  sentence.number = line;
  sentence.function = -1;
  sentence.functionAt = -1;
  sentence.probe = 0;
  sentence.isM = false;
  if (count > kMostWords)
    return fail(result, GCodeError::SentenceTooLong, 0);
  Reading in{decoder, sentence, result, 0, 0.0, 0.0, false, false};
  for (in.index = count - 1; in.index >= 0; --in.index)
    if (!readWord(in, words[in.index]))
      return false;
  return true;
}

} // namespace stride::cnc
