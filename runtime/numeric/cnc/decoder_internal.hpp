// What the sources of the decoder share.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_DECODER_INTERNAL_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_DECODER_INTERNAL_HPP

#include "runtime/numeric/cnc/decoder.hpp"
#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {

/// A switch point of a sentence.
struct Switch {
  double position; ///< L or O.
  int16_t id;      ///< H
  bool way;        ///< L: a length, from the end if negative.
};

/// What the words of a sentence say.
struct Sentence {
  const GCodeWord *words; ///< As the text has them.
  double value[26];       ///< Of A to Z.
  int8_t at[26];          ///< Index of the word; -1: there is none.
  Switch switches[kMostSwitches];
  int32_t switchCount;
  int32_t number;   ///< N, or the line.
  int32_t function; ///< G, or M; -1: none.
  int32_t probe;    ///< PROBE; 0: none.
  int8_t functionAt;
  bool isM;
};

inline bool has(const Sentence &sentence, char letter) noexcept {
  return sentence.at[letter - 'A'] >= 0;
}
inline double get(const Sentence &sentence, char letter) noexcept {
  return sentence.value[letter - 'A'];
}

/// A sentence being decoded.
struct Work {
  Decoder &decoder;
  const Sentence &sentence;
  Decoded &result;
};

/// Sets the error, about the word with the letter or else the function. Always false.
bool refuse(const Work &work, GCodeError error, char letter) noexcept;

/// The frame of arcs, in the program's coordinates.
void setFrame(Decoder &decoder, const Vector3 &x, const Vector3 &y, const Vector3 &normal,
              bool planar) noexcept;

/// G38 and G39.
bool decodeFeature(const Work &work, bool on) noexcept;

/// G54 to G56: where the program's coordinates have their origin, and how they are turned and
/// scaled.
bool decodeSystem(const Work &work, int32_t function) noexcept;

/// G53: the program's coordinates are the machine's.
void resetSystem(Decoder &decoder) noexcept;

/// Says in an object where its program's coordinates are.
void putSystem(const Decoder &decoder, PathObject &object) noexcept;

/// A way in X, Y and Z that the program says, as the machine sees it.
Vector3 machineWay(const Decoder &decoder, const Vector3 &way) noexcept;

/// Where the path is in X, Y and Z, as the program sees it.
Vector3 programPlace(const Decoder &decoder) noexcept;

/// X, Y and Z of a place that the program says, as the machine sees it.
Vector3 machinePlace(const Decoder &decoder, const Vector3 &place) noexcept;

/// Whether the program's Z is not the machine's.
bool isTilted(const Decoder &decoder) noexcept;

/// The frame of arcs, as the machine sees it.
struct Frame {
  Vector3 x, y, normal;
};
Frame machineFrame(const Decoder &decoder) noexcept;

/// Whether arcs of circles in the present plane are arcs of circles for the machine, too.
bool keepsCircles(const Decoder &decoder) noexcept;

/// The length of 1 in the present plane, for the machine.
double scaleOfPlane(const Decoder &decoder) noexcept;

/// How far the program's X is turned about Z, counterclockwise. [degrees]
double turnAboutZ(const Decoder &decoder) noexcept;

/// A, B and C, where they are angles of the program's coordinates, become those for the machine.
/// `value`: what the sentence says; `named`: which of them.
void turnOrientation(const Decoder &decoder, const double (&value)[3], const bool (&named)[3],
                     Position &target) noexcept;

/// G16: the plane whose normal is I, J, K.
bool decodePlane(const Work &work) noexcept;

/// Functions that only change what follows.
bool decodeMode(const Work &work, int32_t function) noexcept;

/// Sets the error, about the word at `index`. Always false.
bool fail(Decoded &result, GCodeError error, int32_t index) noexcept;

/// Notes something about a word of the sentence.
void note(Decoded &result, Note what, int32_t index) noexcept;

/// Reads the words and sets what is modal. False: an error.
bool readSentence(Decoder &decoder, const GCodeWord *words, int32_t count, int32_t line,
                  Sentence &sentence, Decoded &result) noexcept;

/// Where a motion leads, in machine coordinates; axes named are noted in the decoder. With
/// `periodic` axes that turn take the shortest way.
Position targetOf(Decoder &decoder, const Sentence &sentence, bool periodic) noexcept;

/// Whether the sentence names an axis.
bool namesAxis(const Sentence &sentence) noexcept;

/// An object from `here` to `end`, with all that is modal.
PathObject beginObject(Decoder &decoder, const Sentence &sentence, MoveType type,
                       const Position &end) noexcept;

/// A straight line: G0, G1, G31, and what could not be what it should be.
void makeLine(PathObject &object) noexcept;

/// An arc of a circle or, with `ellipse`, of an ellipse; a line where it cannot be one.
void makeArc(const Decoder &decoder, const Sentence &sentence, bool ellipse, PathObject &object,
             Decoded &result) noexcept;

/// Where an arc with an opening angle (T) ends: the target with the place in the plane set.
void turnTarget(const Decoder &decoder, const Sentence &sentence, bool clockwise,
                Position &target) noexcept;

/// Where I, J and K put the centre, or with `inPlane` I and J alone, as the machine sees it.
Vector3 centreOf(const Decoder &decoder, const Sentence &sentence, const Vector3 &start,
                 bool inPlane) noexcept;

/// A parabola: G6; a line where it is none.
void makeParabola(const Decoder &decoder, const Sentence &sentence, PathObject &object,
                  Decoded &result) noexcept;

/// Gives a spline that is held back the directions of its ends. `next` leads on at its end, or is
/// null where nothing follows.
void finishSpline(Decoder &decoder, const Vector3 *next) noexcept;

/// Puts the switch points of the sentence onto an object whose length is known.
void placeSwitches(const Switch *switches, int32_t count, PathObject &object) noexcept;

/// The direction of a curve at its start or end, length 1; kZero where there is none.
Vector3 directionOf(const PathObject &object, bool atEnd) noexcept;

/// The same vector with the length 1; kZero if it is too short to have a direction.
Vector3 unit(const Vector3 &vector) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_DECODER_INTERNAL_HPP
