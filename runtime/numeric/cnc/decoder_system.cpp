// The coordinates of a program: shifted, turned and scaled against the machine's (G53 to G56). A
// place p of the program is the place origin + R S p of the machine: first scaled, then turned.
// Source: SoftMotion V2.3 manual, section 3.2 (shifts); SoftMotion 3's help on G53 to G56, and the
// meanings of its errors 1210 to 1214.
#include "runtime/numeric/cnc/decoder_internal.hpp"
#include "runtime/numeric/cnc/orientation.hpp"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cnc {
namespace {

using numeric::cross;
using numeric::dot;
using numeric::norm;

/// Directions and factors as close as this are the same.
constexpr double kSame = 1e-12; // of directions
constexpr double kSameScale = 1e-9;

Turn turnOf(const Decoder &d) noexcept { return {d.systemX, d.systemY, d.systemZ}; }

void setTurn(Decoder &d, const Turn &turn) noexcept {
  d.systemX = turn.x;
  d.systemY = turn.y;
  d.systemZ = turn.z;
  const Vector3 x = turn.x - kNoTurn.x;
  const Vector3 y = turn.y - kNoTurn.y;
  d.turned = norm(x) > kSame || norm(y) > kSame;
  constexpr double kNear[3] = {0.0, 0.0, 0.0};
  anglesOf(d.orientation, turn, kNear, d.turn);
}

void setScale(Decoder &d, const double (&scale)[3]) noexcept {
  d.scaled = false;
  for (int32_t i = 0; i < 3; ++i) {
    d.scale[i] = scale[i];
    d.scaled = d.scaled || scale[i] != 1.0;
  }
}

Vector3 scaledBy(const double (&scale)[3], const Vector3 &v) noexcept {
  return {v.x * scale[0], v.y * scale[1], v.z * scale[2]};
}

/// What a sentence with G54, G55 or G56 says.
struct Said {
  double coordinate[kAxes]; ///< 0 where `named` says no.
  bool named[kAxes];
  bool turns;
  double angle[3];
  bool scales;
  double scale[3]; ///< 1 where nothing is said.
};

/// All three words from `first` on, or none. False: some.
bool readThree(const Sentence &s, char first, double (&value)[3], bool &there) noexcept {
  int32_t count = 0;
  for (int32_t i = 0; i < 3; ++i)
    if (const auto letter = static_cast<char>(first + i); has(s, letter)) {
      value[i] = get(s, letter);
      ++count;
    }
  there = count == 3;
  return there || count == 0;
}

bool readSaid(const Work &work, Said &said) noexcept {
  const Decoder &d = work.decoder;
  const Sentence &s = work.sentence;
  __builtin_memset(&said, 0, sizeof said);
  said.scale[0] = said.scale[1] = said.scale[2] = 1.0;
  constexpr char kLetters[] = "XYZABCPQUVW";
  const bool angles = d.orientation != Orientation::Axes;
  for (int32_t axis = 0; axis < kAxisSixth; ++axis) {
    said.named[axis] = has(s, kLetters[axis]) && !(angles && axis >= kAxisA && axis <= kAxisC);
    if (said.named[axis])
      said.coordinate[axis] = get(s, kLetters[axis]);
  }
  if (angles && !readThree(s, 'A', said.angle, said.turns))
    return fail(work.result, GCodeError::PartOfTurn, s.functionAt);
  if (!d.softMotion3) {
    if (has(s, 'I') || has(s, 'J') || has(s, 'K'))
      note(work.result, kNoteNoProcessor, s.functionAt);
    return true;
  }
  if (!readThree(s, 'I', said.scale, said.scales))
    return fail(work.result, GCodeError::PartOfScale, s.functionAt);
  for (const double scale : said.scale)
    if (!exact::isPositive(scale))
      return fail(work.result, GCodeError::BadScale, s.functionAt);
  return true;
}

/// Where X, Y and Z begin.
void setOrigin(Decoder &d, const Vector3 &origin) noexcept {
  d.shift[kAxisX] = origin.x;
  d.shift[kAxisY] = origin.y;
  d.shift[kAxisZ] = origin.z;
}

Vector3 originOf(const Decoder &d) noexcept {
  return {d.shift[kAxisX], d.shift[kAxisY], d.shift[kAxisZ]};
}

Vector3 placeSaid(const Said &said) noexcept {
  return {said.coordinate[kAxisX], said.coordinate[kAxisY], said.coordinate[kAxisZ]};
}

/// G54: all anew.
bool setSystem(const Work &work, const Said &said) noexcept {
  Decoder &d = work.decoder;
  for (int32_t axis = 0; axis < kAxes; ++axis)
    d.shift[axis] = said.coordinate[axis];
  setTurn(d, turnBy(d.orientation, said.angle));
  setScale(d, said.scale);
  return true;
}

/// G55: within the present coordinates.
bool moveSystem(const Work &work, const Said &said) noexcept {
  Decoder &d = work.decoder;
  const Turn more = turnBy(d.orientation, said.angle);
  // Scaling and then turning has to be the same as turning and then scaling.
  const Vector3 axes[3] = {more.x, more.y, more.z};
  const Vector3 units[3] = {kNoTurn.x, kNoTurn.y, kNoTurn.z};
  for (int32_t i = 0; i < 3; ++i) {
    const Vector3 differ = scaledBy(d.scale, axes[i]) - apply(more, scaledBy(d.scale, units[i]));
    if (said.turns && norm(differ) > kSameScale * exact::larger(1.0, d.scale[i]))
      return fail(work.result, GCodeError::TurnOfScale, work.sentence.functionAt);
  }
  setOrigin(d, originOf(d) + machineWay(d, placeSaid(said)));
  for (int32_t axis = kAxisA; axis < kAxes; ++axis)
    d.shift[axis] += said.coordinate[axis];
  if (said.turns)
    setTurn(d, turnOf(d) * more);
  const double scale[3] = {d.scale[0] * said.scale[0], d.scale[1] * said.scale[1],
                           d.scale[2] * said.scale[2]};
  setScale(d, scale);
  return true;
}

/// G56: so that the path has these coordinates, and angles, where it is; others as they were.
bool fitSystem(const Work &work, const Said &said) noexcept {
  Decoder &d = work.decoder;
  const double *const here = d.here.coordinate;
  Vector3 place = programPlace(d);
  double *const parts[3] = {&place.x, &place.y, &place.z};
  for (int32_t axis = kAxisX; axis <= kAxisZ; ++axis)
    if (said.named[axis])
      *parts[axis] = said.coordinate[axis];
  for (int32_t axis = kAxisA; axis < kAxes; ++axis)
    if (said.named[axis])
      d.shift[axis] = here[axis] - said.coordinate[axis];
  if (said.turns) {
    const double now[3] = {here[kAxisA], here[kAxisB], here[kAxisC]};
    setTurn(d, turnBy(d.orientation, now) * inverse(turnBy(d.orientation, said.angle)));
  }
  if (said.scales)
    setScale(d, said.scale);
  setOrigin(d, placeOf(d.here) - machineWay(d, place));
  return true;
}

} // namespace

void resetSystem(Decoder &decoder) noexcept {
  constexpr double kNoScale[3] = {1.0, 1.0, 1.0};
  for (double &shift : decoder.shift)
    shift = 0.0;
  setTurn(decoder, kNoTurn);
  setScale(decoder, kNoScale);
}

bool decodeSystem(const Work &work, int32_t function) noexcept {
  Decoder &d = work.decoder;
  Said said;
  if (!readSaid(work, said))
    return false;
  const bool good = function == 54   ? setSystem(work, said)
                    : function == 55 ? moveSystem(work, said)
                                     : fitSystem(work, said);
  if (good && d.planar && isTilted(d))
    return fail(work.result, GCodeError::Tilted, work.sentence.functionAt);
  return good;
}

Vector3 machineWay(const Decoder &decoder, const Vector3 &way) noexcept {
  const Vector3 scaled = decoder.scaled ? scaledBy(decoder.scale, way) : way;
  return decoder.turned ? apply(turnOf(decoder), scaled) : scaled;
}

Vector3 machinePlace(const Decoder &decoder, const Vector3 &place) noexcept {
  return originOf(decoder) + machineWay(decoder, place);
}

Vector3 programPlace(const Decoder &decoder) noexcept {
  Vector3 place = placeOf(decoder.here) - originOf(decoder);
  if (decoder.turned)
    place = apply(inverse(turnOf(decoder)), place);
  if (decoder.scaled)
    place = {place.x / decoder.scale[0], place.y / decoder.scale[1], place.z / decoder.scale[2]};
  return place;
}

void putSystem(const Decoder &decoder, PathObject &object) noexcept {
  object.orientation = static_cast<int16_t>(decoder.orientation);
  for (int32_t axis = 0; axis < kSystemAxes; ++axis)
    object.system[axis] = decoder.shift[axis];
  if (decoder.orientation != Orientation::Axes)
    for (int32_t i = 0; i < 3; ++i)
      object.system[kAxisA + i] = decoder.turn[i];
}

bool isTilted(const Decoder &decoder) noexcept {
  return decoder.turned && norm(decoder.systemZ - kNoTurn.z) > kSameScale;
}

Frame machineFrame(const Decoder &d) noexcept {
  const bool level = d.normal.z == 1.0 && !isTilted(d);
  if (level || !(d.turned || d.scaled))
    return {d.planeX, d.planeY, d.normal};
  const Vector3 x = unit(machineWay(d, d.planeX));
  const Vector3 normal = unit(cross(x, machineWay(d, d.planeY)));
  return {x, cross(normal, x), normal};
}

bool keepsCircles(const Decoder &decoder) noexcept {
  if (!decoder.scaled)
    return true;
  const Vector3 x = scaledBy(decoder.scale, decoder.planeX);
  const Vector3 y = scaledBy(decoder.scale, decoder.planeY);
  const double length = norm(x);
  return exact::fabs(length - norm(y)) <= kSameScale * length &&
         exact::fabs(dot(x, y)) <= kSameScale * length * length;
}

double scaleOfPlane(const Decoder &decoder) noexcept {
  return decoder.scaled ? norm(scaledBy(decoder.scale, decoder.planeX)) : 1.0;
}

double turnAboutZ(const Decoder &decoder) noexcept {
  return degreesOf(decoder.systemX.y, decoder.systemX.x);
}

void turnOrientation(const Decoder &decoder, const double (&value)[3], const bool (&named)[3],
                     Position &target) noexcept {
  const double *const here = decoder.here.coordinate;
  const double now[3] = {here[kAxisA], here[kAxisB], here[kAxisC]};
  const Turn system = turnOf(decoder);
  // The present angles in the program's coordinates, if they are not all said anew.
  double angle[3];
  anglesOf(decoder.orientation, inverse(system) * turnBy(decoder.orientation, now), now, angle);
  for (int32_t i = 0; i < 3; ++i)
    if (named[i])
      angle[i] = value[i] + (decoder.relative ? angle[i] : 0.0);
  double found[3];
  anglesOf(decoder.orientation, system * turnBy(decoder.orientation, angle), now, found);
  for (int32_t i = 0; i < 3; ++i)
    target.coordinate[kAxisA + i] = found[i];
}

} // namespace stride::cnc
