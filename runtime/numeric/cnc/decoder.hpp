// Makes path objects of the sentences of a G-code program, one sentence a call. What a sentence
// says and what is modal: docs/cnc.md. Free of the C++ standard library: linked into every
// application.
//
// An object is held back until the next sentence that makes one: marks that end something
// (G40, G50, G60) belong to the last object before them, and a spline (G5, G10) takes the direction
// of its end from what follows.
// Source: SoftMotion V2.3 manual, section 3.2 and 6.2.1; SoftMotion 3's functions.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_DECODER_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_DECODER_HPP

#include "runtime/numeric/cnc/gcode_error.hpp"
#include "runtime/numeric/cnc/gcode_word.hpp"
#include "runtime/numeric/cnc/orientation.hpp"
#include "runtime/numeric/cnc/path_object.hpp"

namespace stride::cnc {

/// Acceleration and deceleration of a program that says none. [u/s^2]
inline constexpr double kDefaultAcceleration = 100.0;
/// Words of a sentence at most.
inline constexpr int32_t kMostWords = 128;
/// Objects that a sentence gives at most, with the one that was held back.
inline constexpr int32_t kMostObjects = 4;

/// What is the matter with the object that is held back.
enum class Held : uint8_t {
  None,
  Ready,
  Spline,   ///< G5: its end has no direction yet.
  Spline3d, ///< G10: likewise.
};

/// All that a decoder keeps between sentences; in ST SMC_DECODER_STATE. Made by startDecoder.
struct Decoder {
  Position here;               ///< Where the path has come to, in machine coordinates.
  PathObject held;             ///< The last object, see `state`.
  double shift[kAxes];         ///< Where the coordinates begin (G54 to G56), for the machine. [u]
  double period[kLimitedAxes]; ///< Of axes that turn, in the order of PathObject::limits. [u]
  double velocity;             ///< F [u/s]
  double acceleration;         ///< E > 0 [u/s^2]
  double deceleration;         ///< E < 0, here positive. [u/s^2]
  double rapidVelocity;        ///< FF, of G0; 0: F. [u/s]
  double rapidAcceleration;    ///< EF > 0; 0: E. [u/s^2]
  double rapidDeceleration;    ///< EF < 0; 0: E. [u/s^2]
  double radius;               ///< D of the tool. [u]
  double cornerDistance;       ///< D of smoothing and rounding. [u]
  double additional[kAdditionalParameters]; ///< Of G38.
  double switches[kMostSwitches]; ///< Of a spline that is held: parts or, by ways, lengths.
  double parameters[8];           ///< Of M functions without O, which the user may set.
  Vector3 planeX;                 ///< The frame of arcs.
  Vector3 planeY;
  Vector3 normal;
  Vector3 direction; ///< In which the last motion ended; length 1.
  Vector3 systemX;   ///< Axes of the program's coordinates (G54 to G56), seen by the machine.
  Vector3 systemY;
  Vector3 systemZ;
  double turn[3];  ///< The same as angles, by `orientation`. [degrees]
  double scale[3]; ///< Of the program's X, Y, Z: machine's units by the program's.
  Vector3 tool;    ///< G43 [u]
  AxisLimits limits[kLimitedAxes];
  int32_t objects;     ///< How many there have been.
  uint32_t features;   ///< G38
  int16_t counter;     ///< The implicit variable of G20, G36 and G37.
  uint16_t axes;       ///< Which ones have been named, by AxisBit.
  uint16_t profile;    ///< S, by AxisBit.
  uint16_t smoothAxes; ///< G71, of the next object.
  uint16_t program;    ///< Of PathObject: the user sets it, 0 as long as nobody does.
  int16_t motion;      ///< The G function of sentences without one; -1: none yet.
  Held state;
  uint8_t ways;        ///< Which of `switches` are lengths.
  uint8_t marks;       ///< Of the next object.
  uint8_t modes;       ///< See PathObject.
  bool relative;       ///< G91
  bool centreAbsolute; ///< G98
  bool planar;         ///< G15
  bool directed;       ///< There is a `direction`.
  bool jumping;        ///< G92 has been, and its object is not out yet.
  bool turned;         ///< The program's axes are not the machine's: systemX to systemZ.
  bool scaled;         ///< Its units are not the machine's: scale.
  // The user sets these after startDecoder:
  bool softMotion3; ///< D of G41 and G42 is the tool's, other ones are not, as in SoftMotion 3
                    ///< from 4.18 on, else each D is both; I, J, K of G54 to G56 scale.
  Orientation orientation;
};

/// What comes after a sentence.
enum class Next : uint8_t {
  Sentence,
  Jump,        ///< To the sentence with the number `target`.
  Synchronise, ///< The next sentence when the path is done so far.
};

/// What a sentence has given.
struct Decoded {
  PathObject objects[kMostObjects];
  int32_t count;
  int32_t target; ///< Next::Jump
  int32_t word;   ///< Error: index of the word that it is about.
  Next next;
  GCodeError error; ///< Not None: the program ends here; there are no objects.
  uint16_t notes;   ///< By Note.
  uint8_t noteWord; ///< Index of the word that the notes are about.
};

/// The beginning of a program. Where the path begins, and which axes it has besides those that the
/// program names, is what `start` says.
void startDecoder(Decoder &decoder, const Position &start) noexcept;

/// Decodes a sentence of at most kMostWords words without kEndOfSentence; kSkip is passed over.
/// `line` stands for the number of a sentence without N.
void decodeSentence(Decoder &decoder, const GCodeWord *words, int32_t count, int32_t line,
                    Decoded &result) noexcept;

/// The end of the program: what is still held back.
void decodeEnd(Decoder &decoder, Decoded &result) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_DECODER_HPP
