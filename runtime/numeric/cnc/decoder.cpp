#include "runtime/numeric/cnc/decoder.hpp"

#include "runtime/numeric/cnc/decoder_internal.hpp"

namespace stride::cnc {
namespace {

using numeric::dot;

constexpr uint16_t kSpace = 7; // X, Y and Z

void give(Decoded &result, const PathObject &object) noexcept {
  result.objects[result.count++] = object;
}

/// Lets the object go that is held back. `next`: the direction that follows it, or null.
void release(Decoder &decoder, const Vector3 *next, Decoded &result) noexcept {
  if (decoder.state == Held::Spline || decoder.state == Held::Spline3d) {
    finishSpline(decoder, next);
    Switch switches[kMostSwitches];
    int32_t count = 0;
    for (int32_t i = 0; i < kMostSwitches && decoder.held.switchId[i] != 0; ++i, ++count)
      switches[i] = {decoder.switches[i], decoder.held.switchId[i], (decoder.ways >> i & 1) != 0};
    placeSwitches(switches, count, decoder.held);
    const Vector3 direction = directionOf(decoder.held, true);
    decoder.directed = dot(direction, direction) > 0.0;
    decoder.direction = direction;
  }
  if (decoder.state != Held::None)
    give(result, decoder.held);
  decoder.state = Held::None;
}

/// The object of G92, from wherever the path is, when something follows it.
void releaseJump(const Work &work) noexcept {
  Decoder &d = work.decoder;
  if (!d.jumping)
    return;
  d.jumping = false;
  const uint8_t marks = d.marks;
  d.marks = 0;
  PathObject object = beginObject(d, work.sentence, MoveType::Jump, d.here);
  d.marks = marks;
  object.marks = 0;
  object.probe = 0;
  release(d, nullptr, work.result);
  d.directed = false;
  give(work.result, object);
}

/// Holds an object back; what was held goes.
void hold(const Work &work, const PathObject &object, Held state, const Vector3 *start) noexcept {
  release(work.decoder, start, work.result);
  work.decoder.held = object;
  work.decoder.state = state;
}

/// A motion is complete, but for the end of a spline.
void holdMotion(const Work &work, PathObject &object, Held state) noexcept {
  Decoder &d = work.decoder;
  const Sentence &s = work.sentence;
  if (object.velocity == 0.0)
    note(work.result, kNoteNoVelocity, s.functionAt);
  if (state == Held::Ready) {
    const Vector3 start = directionOf(object, false);
    placeSwitches(s.switches, s.switchCount, object);
    const Vector3 end = directionOf(object, true);
    hold(work, object, state, &start);
    d.directed = dot(end, end) > 0.0;
    d.direction = end;
  } else {
    // The spline before this one ends in the direction from its start to the end of this one.
    const Vector3 across = unit(placeOf(object.end) - placeOf(d.held.start));
    for (int32_t i = 0; i < s.switchCount; ++i)
      object.switchId[i] = s.switches[i].id;
    hold(work, object, state, &across);
    d.ways = 0;
    for (int32_t i = 0; i < s.switchCount; ++i) {
      d.switches[i] = s.switches[i].position;
      d.ways = static_cast<uint8_t>(d.ways | (s.switches[i].way ? 1U << i : 0U));
    }
  }
  d.here = object.end;
}

/// Goes on when the path is done so far.
void synchronise(const Work &work) noexcept {
  Decoder &d = work.decoder;
  const uint8_t marks = d.marks;
  PathObject object = beginObject(d, work.sentence, MoveType::Function, d.here);
  d.marks = marks;
  object.marks = 0;
  object.probe = 0;
  object.switchId[0] = kSynchronise;
  hold(work, object, Held::Ready, nullptr);
  release(d, nullptr, work.result);
  work.result.next = Next::Synchronise;
}

MoveType typeOf(int32_t function) noexcept {
  switch (function) {
  case 0:
    return MoveType::Positioning;
  case 2:
    return MoveType::Clockwise;
  case 3:
    return MoveType::Counterclockwise;
  case 8:
    return MoveType::EllipseClockwise;
  case 9:
    return MoveType::EllipseCounterclockwise;
  default:
    return MoveType::Line;
  }
}

bool inXY(const Decoder &decoder) noexcept { return decoder.normal.z == 1.0 && !isTilted(decoder); }

bool isMotion(int32_t function) noexcept {
  return (function >= 0 && function <= 3) || function == 5 || function == 6 ||
         (function >= 8 && function <= 10) || function == 31;
}

/// What a motion needs besides a target.
bool checkMotion(const Work &work, int32_t function) noexcept {
  const Sentence &s = work.sentence;
  const bool ellipse = function == 8 || function == 9;
  if ((ellipse || function == 5 || function == 6) && !inXY(work.decoder))
    return fail(work.result, GCodeError::NotInThisPlane, s.functionAt);
  // It would turn the target about the centre, away from the ellipse.
  if (ellipse && has(s, 'T'))
    return refuse(work, GCodeError::TurnOfEllipse, 'T');
  if (ellipse && !has(s, 'R'))
    return refuse(work, GCodeError::MissingWord, 'R');
  if (ellipse && !(get(s, 'R') > 0.0 && get(s, 'R') <= 1.0))
    return refuse(work, GCodeError::OutOfRange, 'R');
  const bool centre = has(s, 'I') || has(s, 'J') || has(s, 'K');
  if ((function == 2 || function == 3) && !centre && !has(s, 'R'))
    return refuse(work, GCodeError::MissingWord, 'R');
  // An arc leads to its end on the way that is not longer than a turn.
  if ((function == 2 || function == 3) && has(s, 'T') &&
      !(get(s, 'T') > 0.0 && get(s, 'T') <= 360.0))
    return refuse(work, GCodeError::OutOfRange, 'T');
  if (function == 6 && !centre)
    return refuse(work, GCodeError::MissingWord, 'I');
  if ((ellipse || function == 2 || function == 3) && !keepsCircles(work.decoder))
    return fail(work.result, GCodeError::Distorted, s.functionAt);
  return true;
}

bool decodeMotion(const Work &work, int32_t function) noexcept {
  Decoder &d = work.decoder;
  const Sentence &s = work.sentence;
  if (function != 31)
    d.motion = static_cast<int16_t>(function);
  const bool arc = function == 2 || function == 3 || function == 8 || function == 9;
  const bool centre = arc && (has(s, 'I') || has(s, 'J') || has(s, 'K'));
  if (!namesAxis(s) && !centre) {
    if (s.switchCount > 0)
      note(work.result, kNoteLostSwitch, s.functionAt);
    if (arc && has(s, 'R'))
      note(work.result, kNoteEmptyArc, s.functionAt);
    return true;
  }
  if (!checkMotion(work, function))
    return false;
  releaseJump(work);
  Position target = targetOf(d, s, true);
  if (arc && has(s, 'T'))
    turnTarget(d, s, function == 2, target);
  PathObject object = beginObject(d, s, typeOf(function), target);
  const bool probes = function == 31 || s.probe != 0;
  if (function == 31 && s.probe == 0)
    object.probe = 1;
  if (probes)
    note(work.result, kNoteNoProcessor, s.functionAt);
  if (function == 5 || function == 10) {
    object.moveType = function == 5 ? MoveType::Spline : MoveType::Spline3d;
    holdMotion(work, object, function == 5 ? Held::Spline : Held::Spline3d);
  } else {
    if (arc)
      makeArc(d, s, function >= 8, object, work.result);
    else if (function == 6)
      makeParabola(d, s, object, work.result);
    else
      makeLine(object);
    holdMotion(work, object, Held::Ready);
  }
  if (probes)
    synchronise(work);
  return true;
}

/// M, and G4: something at a place.
void holdFunction(const Work &work, int16_t id, double first, double second,
                  const void *parameters) noexcept {
  Decoder &d = work.decoder;
  releaseJump(work);
  PathObject object = beginObject(d, work.sentence, MoveType::Function, d.here);
  object.switchId[0] = id;
  object.parameterRange[0] = first;
  object.parameterRange[1] = second;
  if (parameters != nullptr)
    __builtin_memcpy(object.shape, parameters, sizeof object.shape);
  hold(work, object, Held::Ready, nullptr);
}

bool decodeM(const Work &work) noexcept {
  const Sentence &s = work.sentence;
  const void *parameters = work.decoder.parameters;
  if (has(s, 'O') && s.switchCount == 0) {
    const GCodeWord &word = s.words[s.at['O' - 'A']];
    if (word.address == nullptr)
      return refuse(work, GCodeError::NoVariable, 'O');
    if (static_cast<VariableType>(word.variables) != VariableType::Structure)
      return refuse(work, GCodeError::WrongVariable, 'O');
    parameters = word.address;
  }
  holdFunction(work, static_cast<int16_t>(static_cast<uint16_t>(s.function)),
               has(s, 'K') ? get(s, 'K') : 0.0, has(s, 'L') ? get(s, 'L') : 0.0, parameters);
  return true;
}

bool decodeDwell(const Work &work) noexcept {
  const Sentence &s = work.sentence;
  if (!has(s, 'T'))
    return refuse(work, GCodeError::MissingWord, 'T');
  if (get(s, 'T') < 0.0)
    return refuse(work, GCodeError::OutOfRange, 'T');
  holdFunction(work, kDwell, get(s, 'T'), 0.0, nullptr);
  return true;
}

/// G20.
bool decodeJump(const Work &work) noexcept {
  const Sentence &s = work.sentence;
  if (!has(s, 'L'))
    return refuse(work, GCodeError::MissingWord, 'L');
  const double target = get(s, 'L');
  if (static_cast<double>(wholePart(target)) != target)
    return refuse(work, GCodeError::NotWhole, 'L');
  const double condition = has(s, 'K') ? get(s, 'K') : work.decoder.counter;
  if (condition != 0.0) {
    work.result.next = Next::Jump;
    work.result.target = wholePart(target);
    work.result.word = s.at['L' - 'A'];
  }
  return true;
}

/// G36 and G37.
bool decodeVariable(const Work &work, bool add) noexcept {
  const Sentence &s = work.sentence;
  if (!has(s, 'D'))
    return refuse(work, GCodeError::MissingWord, 'D');
  const double value = get(s, 'D');
  if (!has(s, 'O')) {
    const double sum = value + (add ? work.decoder.counter : 0);
    const int32_t whole = wholePart(sum + (sum < 0.0 ? -0.5 : 0.5));
    work.decoder.counter = static_cast<int16_t>(whole < -32768  ? -32768
                                                : whole > 32767 ? 32767
                                                                : whole);
    return true;
  }
  const GCodeWord &variable = s.words[s.at['O' - 'A']];
  if (variable.address == nullptr)
    return refuse(work, GCodeError::NoVariable, 'O');
  if (!assignTo(variable, value + (add ? valueOf(variable) : 0.0)))
    return refuse(work, GCodeError::WrongVariable, 'O');
  return true;
}

bool decodeG(const Work &work, int32_t function) noexcept {
  if (isMotion(function))
    return decodeMotion(work, function);
  switch (function) {
  case 4:
    return decodeDwell(work);
  case 16:
    return decodePlane(work);
  case 20:
    return decodeJump(work);
  case 36:
  case 37:
    return decodeVariable(work, function == 37);
  case 38:
  case 39:
    return decodeFeature(work, function == 38);
  case 54:
  case 55:
  case 56:
    return decodeSystem(work, function);
  case 75:
    releaseJump(work);
    synchronise(work);
    return true;
  case 92:
    work.decoder.here = targetOf(work.decoder, work.sentence, false);
    work.decoder.jumping = true;
    return true;
  default:
    return decodeMode(work, function);
  }
}

/// D, unless G36 and G37 mean a value by it: the radius of the tool, the distance of smoothing and
/// rounding, or both.
void readDistance(Decoder &decoder, const Sentence &sentence) noexcept {
  const int32_t function = sentence.isM ? -1 : sentence.function;
  if (!has(sentence, 'D') || function == 36 || function == 37)
    return;
  const double value = get(sentence, 'D');
  const bool ofTool = function == 41 || function == 42;
  if (!decoder.softMotion3 || ofTool)
    decoder.radius = value;
  if (!decoder.softMotion3 || (!ofTool && function != 40))
    decoder.cornerDistance = value;
}

void clear(Decoded &result) noexcept {
  result.count = 0;
  result.target = 0;
  result.word = 0;
  result.next = Next::Sentence;
  result.error = GCodeError::None;
  result.notes = 0;
  result.noteWord = 0;
}

} // namespace

void startDecoder(Decoder &decoder, const Position &start) noexcept {
  __builtin_memset(&decoder, 0, sizeof decoder);
  decoder.here = start;
  decoder.axes = static_cast<uint16_t>(start.axes | kSpace);
  decoder.profile = start.sProfile;
  decoder.acceleration = decoder.deceleration = kDefaultAcceleration;
  decoder.counter = -1;
  decoder.motion = -1;
  setFrame(decoder, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, false);
  resetSystem(decoder);
}

void decodeSentence(Decoder &decoder, const GCodeWord *words, int32_t count, int32_t line,
                    Decoded &result) noexcept {
  clear(result);
  Sentence sentence;
  if (!readSentence(decoder, words, count, line, sentence, result))
    return;
  readDistance(decoder, sentence);
  const Work work{decoder, sentence, result};
  bool good = true;
  if (sentence.isM)
    good = decodeM(work);
  else if (sentence.function >= 0)
    good = decodeG(work, sentence.function);
  else if (namesAxis(sentence) && decoder.motion < 0)
    good = fail(result, GCodeError::NoFunction, 0);
  else if (decoder.motion >= 0)
    good = decodeMotion(work, decoder.motion);
  if (!good)
    result.count = 0;
}

void decodeEnd(Decoder &decoder, Decoded &result) noexcept {
  clear(result);
  Sentence sentence;
  if (!readSentence(decoder, nullptr, 0, 0, sentence, result))
    return;
  releaseJump({decoder, sentence, result});
  release(decoder, nullptr, result);
}

} // namespace stride::cnc
