#include "runtime/numeric/nc/interpreter.hpp"

namespace stride::nc {
namespace {

constexpr int32_t kNumberBytes = sizeof(double);
constexpr int32_t kSlotTextBytes = kMostText + 1;
constexpr int32_t kLeastName = 3;

/// A sentence being carried out.
struct Work {
  Interpreter &interpreter;
  cnc::Decoder &decoder;
  SentenceQueue &queue;
  Carried &out;
  const SentenceHead &head;
  const uint8_t *body;
  Local locals[kMostLocals];
  Surroundings around;
};

bool fail(Work &work, Error error, int32_t column = 0) noexcept {
  work.out.error = error;
  work.out.column = column;
  return false;
}

const cnc::VariableList *variablesOf(const SentenceQueue &queue) noexcept {
  return reinterpret_cast<const cnc::VariableList *>(queue.variables);
}

/// What expressions of the present program can name.
void surround(Work &work) noexcept {
  Interpreter &in = work.interpreter;
  const Frame &frame = in.frames[in.level];
  for (int32_t i = 0; i < frame.count; ++i)
    work.locals[i] = {in.values + frame.slots[i].place, frame.slots[i].type};
  work.around = {work.locals, frame.count, variablesOf(work.queue)};
}

void setLocal(uint8_t *place, const Evaluation &evaluation, const Value &value) noexcept {
  if (value.type != ValueType::Text) {
    __builtin_memcpy(place, &value.number, sizeof value.number);
    return;
  }
  __builtin_memcpy(place, evaluation.texts + value.text, static_cast<uint64_t>(value.length));
  place[value.length] = 0;
}

/// A new local variable of a frame, with its default; null: there is no room.
uint8_t *addSlot(Interpreter &in, Frame &frame, ValueType type) noexcept {
  const int32_t size = type == ValueType::Text ? kSlotTextBytes : kNumberBytes;
  if (frame.count == kMostLocals || in.used + size > kValueBytes)
    return nullptr;
  frame.slots[frame.count++] = {static_cast<uint16_t>(in.used), type, 0};
  uint8_t *const place = in.values + in.used;
  __builtin_memset(place, 0, static_cast<uint64_t>(size));
  in.used += size;
  return place;
}

bool carryLet(Work &work, Evaluation &evaluation) noexcept {
  Interpreter &in = work.interpreter;
  const auto type = static_cast<ValueType>(work.body[0]);
  const auto size = static_cast<int32_t>(work.head.size - sizeof work.head) - 1;
  if (const Error error = evaluate(evaluation, work.body + 1, size, work.around);
      error != Error::None)
    return fail(work, error);
  uint8_t *const place = addSlot(in, in.frames[in.level], type);
  if (place == nullptr)
    return fail(work, Error::StackTooSmall);
  if (evaluation.count > 0)
    setLocal(place, evaluation, evaluation.values[0]);
  return true;
}

/// SUBPROGRAM: whether the arguments are what it takes.
bool carryHeader(Work &work) noexcept {
  const Frame &frame = work.interpreter.frames[work.interpreter.level];
  const int32_t count = work.body[0];
  if (frame.count != count)
    return fail(work, frame.count < count ? Error::TooFewArguments : Error::TooManyArguments);
  for (int32_t i = 0; i < count; ++i)
    if (frame.slots[i].type != static_cast<ValueType>(work.body[1 + i]))
      return fail(work, Error::ArgumentType);
  return true;
}

/// The arguments, whose types begin at `at`.
bool readArguments(Work &work, Evaluation &evaluation, int32_t at) noexcept {
  const int32_t code = at + kMostLocals + 2;
  const auto size = static_cast<int32_t>(work.head.size - sizeof work.head) - code;
  const Error error = evaluate(evaluation, work.body + code, size, work.around);
  return error == Error::None || fail(work, error);
}

/// Calls the subprogram SentenceQueue::name with the values from `first` on.
bool enter(Work &work, const Evaluation &evaluation, int32_t first) noexcept {
  Interpreter &in = work.interpreter;
  if (in.level == kMostNesting)
    return fail(work, Error::Nesting);
  Frame &frame = in.frames[in.level + 1];
  frame.place = in.used;
  frame.count = 0;
  for (int32_t i = first; i < evaluation.count; ++i) {
    uint8_t *const place = addSlot(in, frame, evaluation.values[i].type);
    if (place == nullptr) {
      in.used = frame.place;
      return fail(work,
                  frame.count == kMostLocals ? Error::TooManyArguments : Error::StackTooSmall);
    }
    setLocal(place, evaluation, evaluation.values[i]);
  }
  ++in.level;
  work.queue.resume = {work.head.next, work.head.line + 1, work.head.nextState};
  work.queue.request = Request::Call;
  emptySentences(work.queue);
  return true;
}

void setName(SentenceQueue &queue, const char *name, int32_t length) noexcept {
  __builtin_memcpy(queue.name, name, static_cast<uint64_t>(length));
  queue.name[length] = 0;
}

bool carryCall(Work &work, Evaluation &evaluation) noexcept {
  const int32_t length = work.body[0];
  if (!readArguments(work, evaluation, 1 + length))
    return false;
  setName(work.queue, reinterpret_cast<const char *>(work.body + 1), length);
  return enter(work, evaluation, 0);
}

bool carryDynamicCall(Work &work, Evaluation &evaluation) noexcept {
  if (!readArguments(work, evaluation, 0))
    return false;
  if (evaluation.count < 1)
    return fail(work, Error::TooFewArguments);
  const Value &name = evaluation.values[0];
  if (name.length < kLeastName || name.length > kMostName)
    return fail(work, name.length < kLeastName ? Error::NameTooShort : Error::NameTooLong);
  const char *const text = evaluation.texts + name.text;
  for (int32_t i = 0; i < name.length; ++i)
    if (!isLetter(text[i]) && text[i] != '_' && !(i > 0 && isDigit(text[i])))
      return fail(work, Error::WrongToken);
  setName(work.queue, text, name.length);
  return enter(work, evaluation, 1);
}

/// RETURN and END_SUBPROGRAM.
bool leave(Work &work) noexcept {
  Interpreter &in = work.interpreter;
  if (in.level == 0)
    return fail(work, Error::StackEmpty);
  in.used = in.frames[in.level].place;
  --in.level;
  work.queue.request = Request::Return;
  emptySentences(work.queue);
  return true;
}

/// What the words of a sentence are, besides those that the decoder gets.
struct Special {
  uint8_t *target; ///< Of G36: a variable that is no number.
  ValueType targetType;
  bool inList; ///< It is one of the list of variables.
  Value value; ///< D, if it is no number.
  bool hasValue;
  bool labelled; ///< The jump has a label.
  double label;
  uint16_t columns[cnc::kMostWords];
};

/// O with a variable.
Error readTarget(const Work &work, const WordHead &head, const uint8_t *code, cnc::GCodeWord &word,
                 Special &special, bool &isWord) noexcept {
  if (static_cast<Op>(code[0]) == Op::Local) {
    if (code[1] >= work.around.localCount)
      return Error::NoLocal;
    word.address = work.around.locals[code[1]].place;
    word.variables = static_cast<uint8_t>(cnc::VariableType::Lreal);
  } else if (!variableAt(work.around.variables, load<uint16_t>(code + 2), code[1], word)) {
    return Error::ReadType;
  }
  isWord = head.type == ValueType::Real || head.type == ValueType::Any;
  if (!isWord) {
    special.target = word.address;
    special.targetType = head.type;
    special.inList = static_cast<Op>(code[0]) == Op::Variable;
  }
  return Error::None;
}

/// The value of a word. `isWord`: the decoder gets it.
Error readValue(const Work &work, Evaluation &evaluation, const WordHead &head, const uint8_t *code,
                cnc::GCodeWord &word, Special &special, bool &isWord) noexcept {
  isWord = head.form != WordForm::Label;
  word = {};
  word.letter = head.code;
  if (head.form == WordForm::Variable)
    return readTarget(work, head, code, word, special, isWord);
  if (!isWord)
    return Error::None;
  evaluation.count = 0;
  if (const Error error = evaluate(evaluation, code, head.size, work.around); error != Error::None)
    return error;
  if (evaluation.count != 1)
    return Error::Syntax;
  const Value &value = evaluation.values[0];
  if (head.form == WordForm::LabelJump) {
    special.labelled = true;
    special.label = value.number;
  } else if (value.type == ValueType::Real || head.code == 'K') {
    word.value = value.number;
    word.integer = cnc::wholePart(value.number);
  } else {
    special.value = value;
    special.hasValue = true;
    isWord = false;
  }
  return Error::None;
}

/// Whether the sentence has this function.
bool isFunction(const Carried &out, double function) noexcept {
  for (int32_t i = 0; i < out.count; ++i)
    if (out.words[i].letter == 'G')
      return out.words[i].value == function;
  return false;
}

/// G36 with a variable that is no number: BOOL or STRING. Its words are taken away.
bool assign(Work &work, const Evaluation &evaluation, const Special &special) noexcept {
  Carried &out = work.out;
  if (special.target == nullptr || !special.hasValue || !isFunction(out, 36.0) ||
      special.value.type != special.targetType)
    return fail(work, Error::WriteType);
  if (!special.inList) {
    setLocal(special.target, evaluation, special.value);
  } else if (special.targetType == ValueType::Bool) {
    *special.target = special.value.number != 0.0 ? 1 : 0;
  } else {
    const int32_t length =
        special.value.length < kTextVariableLength ? special.value.length : kTextVariableLength;
    __builtin_memcpy(special.target, evaluation.texts + special.value.text,
                     static_cast<uint64_t>(length));
    special.target[length] = 0;
  }
  int32_t kept = 0;
  for (int32_t i = 0; i < out.count; ++i)
    if (out.words[i].letter != 'G')
      out.words[kept++] = out.words[i];
  out.count = kept;
  return true;
}

void addNumber(Work &work, Special &special) noexcept {
  if (!work.head.numbered)
    return;
  cnc::GCodeWord &word = work.out.words[work.out.count];
  word = {};
  word.letter = 'N';
  word.value = work.head.number;
  word.integer = cnc::wholePart(word.value);
  special.columns[work.out.count++] = 0;
}

/// The words with their values.
bool readWords(Work &work, Evaluation &evaluation, Special &special) noexcept {
  addNumber(work, special);
  const int32_t count = work.body[0];
  const uint8_t *at = work.body + 1;
  for (int32_t i = 0; i < count && work.out.count < cnc::kMostWords; ++i) {
    const auto head = load<WordHead>(at);
    at += sizeof head;
    bool isWord = false;
    const Error error =
        readValue(work, evaluation, head, at, work.out.words[work.out.count], special, isWord);
    if (error != Error::None)
      return fail(work, error, head.column);
    special.columns[work.out.count] = head.column;
    work.out.count += isWord ? 1 : 0;
    at += head.size;
  }
  return true;
}

/// Goes to a sentence with a number, or on to one with a label.
void jump(Work &work, const Special &special) noexcept {
  Interpreter &in = work.interpreter;
  if (special.labelled) {
    in.skipping = true;
    in.label = special.label;
    return;
  }
  in.looking = true;
  in.target = static_cast<uint32_t>(work.out.decoded.target);
  if (work.queue.whole) {
    work.queue.read = 0;
    return;
  }
  work.queue.request = Request::Rewind;
  emptySentences(work.queue);
}

bool carryWords(Work &work, Evaluation &evaluation) noexcept {
  Special special{};
  Carried &out = work.out;
  if (!readWords(work, evaluation, special))
    return false;
  if ((special.target != nullptr || special.hasValue) && !assign(work, evaluation, special))
    return false;
  cnc::decodeSentence(work.decoder, out.words, out.count, out.line + 1, out.decoded);
  if (out.decoded.error != cnc::GCodeError::None)
    return fail(work, Error::None,
                out.decoded.word >= 0 && out.decoded.word < out.count
                    ? special.columns[out.decoded.word]
                    : 0);
  if (out.decoded.next == cnc::Next::Jump)
    jump(work, special);
  return true;
}

/// Whether a sentence has the label that is looked for.
bool hasLabel(const Interpreter &in, const SentenceQueue &queue,
              const SentenceHead &head) noexcept {
  if (head.kind != SentenceKind::Words)
    return false;
  const uint8_t *at = bodyOf(queue);
  const int32_t count = *at++;
  const Surroundings around{nullptr, 0, variablesOf(queue)};
  for (int32_t i = 0; i < count; ++i) {
    const auto word = load<WordHead>(at);
    at += sizeof word;
    if (word.form == WordForm::Label) {
      Evaluation evaluation;
      evaluation.count = evaluation.used = 0;
      if (evaluate(evaluation, at, word.size, around) == Error::None && evaluation.count == 1 &&
          evaluation.values[0].number == in.label)
        return true;
    }
    at += word.size;
  }
  return false;
}

/// Passes sentences over that a jump leaves out. False: there is none left, or an error.
bool passOver(Interpreter &in, SentenceQueue &queue, SentenceHead &head, Carried &out) noexcept {
  while (frontSentence(queue, head)) {
    out.line = head.line;
    const bool end = head.kind == SentenceKind::End;
    if (in.looking && end) {
      out.error = Error::UnknownJump;
      return false;
    }
    if (in.looking && head.numbered && head.number == in.target)
      in.looking = false;
    if (in.skipping && (end || hasLabel(in, queue, head)))
      in.skipping = false;
    if (!in.looking && !in.skipping)
      return true;
    removeSentence(queue, head);
  }
  return false;
}

bool carry(Work &work, Evaluation &evaluation) noexcept {
  switch (work.head.kind) {
  case SentenceKind::Words:
    return carryWords(work, evaluation);
  case SentenceKind::Let:
    return carryLet(work, evaluation);
  case SentenceKind::Header:
    return carryHeader(work);
  case SentenceKind::Call:
    return carryCall(work, evaluation);
  case SentenceKind::DynamicCall:
    return carryDynamicCall(work, evaluation);
  case SentenceKind::Return:
  case SentenceKind::End:
    return leave(work);
  }
  return fail(work, Error::Syntax);
}

void clear(Carried &out) noexcept {
  out.decoded.count = 0;
  out.decoded.next = cnc::Next::Sentence;
  out.decoded.error = cnc::GCodeError::None;
  out.decoded.notes = 0;
  out.count = 0;
  out.column = 0;
  out.error = Error::None;
  out.skip = false;
}

} // namespace

void startInterpreter(Interpreter &interpreter) noexcept {
  __builtin_memset(&interpreter, 0, sizeof interpreter);
}

Outcome interpret(Interpreter &interpreter, cnc::Decoder &decoder, SentenceQueue &queue,
                  bool suppress, Carried &carried) noexcept {
  clear(carried);
  if (queue.request != Request::None && queue.error == Error::None)
    return Outcome::Idle;
  SentenceHead head{};
  if (!passOver(interpreter, queue, head, carried)) {
    if (carried.error != Error::None)
      queue.request = Request::Finish;
    else
      carried.error = queue.error;
    return carried.error == Error::None ? Outcome::Idle : Outcome::Wrong;
  }
  carried.skip = head.skip;
  if (head.kind == SentenceKind::End && interpreter.level == 0) {
    cnc::decodeEnd(decoder, carried.decoded);
    queue.request = Request::Finish;
    emptySentences(queue);
    return Outcome::Finished;
  }
  Work work{interpreter, decoder, queue, carried, head, bodyOf(queue), {}, {}};
  surround(work);
  removeSentence(queue, head);
  if (head.skip && suppress)
    return Outcome::Carried;
  Evaluation evaluation;
  evaluation.count = evaluation.used = 0;
  if (carry(work, evaluation))
    return Outcome::Carried;
  queue.request = Request::Finish;
  return Outcome::Wrong;
}

} // namespace stride::nc
