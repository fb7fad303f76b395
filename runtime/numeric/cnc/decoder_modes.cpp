// Functions that make no object but change those that follow.
#include "runtime/numeric/cnc/decoder_internal.hpp"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cnc {
namespace {

using numeric::cross;
using numeric::dot;

constexpr int32_t kMostFeature = 31;

/// Marks of what begins and what ends; `both` are those that begin the same kind.
void startMark(Decoder &d, uint8_t mark, uint8_t both) noexcept {
  d.modes = static_cast<uint8_t>((d.modes & ~both) | mark);
  d.marks = static_cast<uint8_t>((d.marks & ~both) | mark);
}

void endMark(Decoder &d, uint8_t mark, uint8_t both) noexcept {
  d.modes = static_cast<uint8_t>(d.modes & ~both);
  d.marks = static_cast<uint8_t>(d.marks & ~both);
  uint8_t &marks = d.state != Held::None ? d.held.marks : d.marks;
  marks = static_cast<uint8_t>(marks | mark);
}

} // namespace

bool refuse(const Work &work, GCodeError error, char letter) noexcept {
  const int8_t at = work.sentence.at[letter - 'A'];
  return fail(work.result, error, at >= 0 ? at : work.sentence.functionAt);
}

void setFrame(Decoder &d, const Vector3 &x, const Vector3 &y, const Vector3 &normal,
              bool planar) noexcept {
  d.planeX = x;
  d.planeY = y;
  d.normal = normal;
  d.planar = planar;
}

bool decodeFeature(const Work &work, bool on) noexcept {
  Decoder &d = work.decoder;
  const Sentence &s = work.sentence;
  if (!has(s, 'O'))
    return refuse(work, GCodeError::MissingWord, 'O');
  const double bit = get(s, 'O');
  if (!(bit >= 0.0 && bit <= kMostFeature) || static_cast<double>(wholePart(bit)) != bit)
    return refuse(work, GCodeError::OutOfRange, 'O');
  const uint32_t mask = 1U << static_cast<uint32_t>(bit);
  d.features = on ? d.features | mask : d.features & ~mask;
  for (int32_t i = 0; i < kAdditionalParameters; ++i)
    if (has(s, static_cast<char>('I' + i)))
      d.additional[i] = get(s, static_cast<char>('I' + i));
  note(work.result, kNoteNoProcessor, s.functionAt);
  return true;
}

/// G71 and G70: the axis L, 4 (A) to 11 (W), goes smoothly from the next object on, or not.
bool decodeSmoothAxis(const Work &work, bool on) noexcept {
  constexpr double kFirst = 4.0;
  Decoder &d = work.decoder;
  const Sentence &s = work.sentence;
  if (!has(s, 'L'))
    return refuse(work, GCodeError::MissingWord, 'L');
  const double axis = get(s, 'L') - kFirst;
  if (!(axis >= 0.0 && axis < kSmoothAxes) || static_cast<double>(wholePart(axis)) != axis)
    return refuse(work, GCodeError::OutOfRange, 'L');
  const auto number = static_cast<unsigned>(axis);
  const unsigned both = 1U << number | 1U << (kRangeBegins + number);
  d.smoothAxes = static_cast<uint16_t>(on ? d.smoothAxes | both : d.smoothAxes & ~both);
  return true;
}

/// G43: the tool's point, seen from where the path is meant to be; without words none.
void setTool(const Work &work) noexcept {
  const Sentence &s = work.sentence;
  const auto part = [&s](char letter) { return has(s, letter) ? get(s, letter) : 0.0; };
  work.decoder.tool = {part('I'), part('J'), part('K')};
}

bool decodePlane(const Work &work) noexcept {
  const Sentence &s = work.sentence;
  const auto part = [&s](char letter) { return has(s, letter) ? get(s, letter) : 0.0; };
  const Vector3 normal = unit({part('I'), part('J'), part('K')});
  if (!(dot(normal, normal) > 0.0))
    return refuse(work, GCodeError::OutOfRange, 'I');
  // X as it is seen in the plane; Y where the plane stands across X.
  const bool across = exact::fabs(normal.x) > 0.9;
  const Vector3 near = across ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
  const Vector3 x = unit(near - normal * dot(near, normal));
  setFrame(work.decoder, x, cross(normal, x), normal, false);
  return true;
}

bool decodeMode(const Work &work, int32_t function) noexcept {
  Decoder &d = work.decoder;
  constexpr uint8_t kTool = kToolLeft | kToolRight;
  constexpr uint8_t kCorner = kSmooth | kRound;
  switch (function) {
  case 15:
  case 17:
    if (function == 15 && isTilted(d))
      return fail(work.result, GCodeError::Tilted, work.sentence.functionAt);
    setFrame(d, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, function == 15);
    return true;
  case 18:
    setFrame(d, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, false);
    return true;
  case 19:
    setFrame(d, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, false);
    return true;
  case 40:
    endMark(d, kEndToolCorrection, kTool);
    return true;
  case 50:
    endMark(d, kEndSmoothing, kCorner);
    return true;
  case 60:
    endMark(d, kEndAvoidLoops, kAvoidLoops);
    return true;
  case 53:
    resetSystem(d);
    return true;
  case 90:
  case 91:
    d.relative = function == 91;
    return true;
  case 98:
  case 99:
    d.centreAbsolute = function == 98;
    return true;
  case 41:
  case 42:
    startMark(d, function == 41 ? kToolLeft : kToolRight, kTool);
    return true;
  case 51:
  case 52:
    startMark(d, function == 51 ? kSmooth : kRound, kCorner);
    return true;
  case 61:
    startMark(d, kAvoidLoops, kAvoidLoops);
    return true;
  case 70:
  case 71:
    return decodeSmoothAxis(work, function == 71);
  case 43:
    setTool(work);
    break;
  default:
    return fail(work.result, GCodeError::UnknownFunction, work.sentence.functionAt);
  }
  note(work.result, kNoteNoProcessor, work.sentence.functionAt);
  return true;
}

} // namespace stride::cnc
