// What can be wrong with a G-code program. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_GCODE_ERROR_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_GCODE_ERROR_HPP

#include <stdint.h>

namespace stride::cnc {

/// Errors end a program; notes say what is done instead.
enum class GCodeError : uint8_t {
  None,
  // Of the text:
  UnknownWord,         ///< No such word.
  MissingValue,        ///< Neither number nor variable after the letters.
  BadNumber,           ///< A sign or a point without digits, or too many digits.
  Exponent,            ///< A number as 1e-05, which would be two words.
  NotWhole,            ///< A fraction where only whole numbers are.
  UnexpectedCharacter, ///< No letter where a word should begin.
  UnclosedComment,     ///< No `)` in the line.
  UnclosedVariable,    ///< No `$` in the line.
  BadVariable,         ///< No name, or one that is too long.
  SentenceTooLong,     ///< More words than kMostWords.
  // Of the sentence:
  UnknownFunction, ///< No such G function.
  NoFunction,      ///< Coordinates, but no G function yet.
  TwoInstructions, ///< Two G functions, or a G and an M function.
  MissingWord,     ///< The function needs a word that is not there.
  OutOfRange,      ///< The value of a word is not allowed there.
  NotANumber,      ///< A variable has no value that is one.
  NoVariable,      ///< The word needs a variable.
  WrongVariable,   ///< The variable is of a type that does not fit.
  Acceleration,    ///< Of the word E: less than 1.
  Deceleration,    ///< Of the word E: less than 1.
  TooManySwitches, ///< More than kMostSwitches words H in a sentence.
  NotInThisPlane,  ///< Ellipses, parabolas and splines in the plane are in X and Y.
  NegativePeriod,  ///< Of an axis.
  TurnOfEllipse,   ///< T of G8 and G9: only arcs of circles have an opening angle.
  PartOfTurn,      ///< Of A, B, C of G54 to G56 some are missing, where they are angles.
  Tilted,          ///< The program's Z is not the machine's, and the path is planar (G15).
  Distorted,       ///< Axes scaled by different factors make no circle of a circle.
  TurnOfScale,     ///< G55 turns axes that are scaled by different factors.
  PartOfScale,     ///< Of I, J, K of G54 to G56 some are missing.
  BadScale,        ///< A factor of an axis is not positive.
  UnknownJump,     ///< No sentence has that number.
};

/// What has been done instead of what the sentence says, or is worth a question.
enum Note : uint16_t {
  kNoteCentreOff = 1 << 0,      ///< A centre that does not fit: a line instead of the arc.
  kNoteRadiusTooSmall = 1 << 1, ///< A radius that reaches nothing: likewise.
  kNoteEmptyArc = 1 << 2,       ///< An arc of no length: likewise.
  kNoteNoVelocity = 1 << 3,     ///< A motion before F has said a velocity.
  kNoteNoProcessor = 1 << 4,    ///< A function that no block carries out.
  kNoteSwitchOutside = 1 << 5,  ///< A switch point outside of its object: at the end next to it.
  kNoteLostSwitch = 1 << 6,     ///< A switch point without an object.
};

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_GCODE_ERROR_HPP
