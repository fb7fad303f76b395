// What can be wrong with a program of SoftMotion 3's language. The numbers are those of SMC_ERROR.
// Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_NC_ERROR_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_NC_ERROR_HPP

#include <stdint.h>

namespace stride::nc {

enum class Error : int16_t {
  None = 0,
  // Of characters:
  UnexpectedEnd = 1130, ///< The line ends within a text, a variable or a comment.
  UnknownToken = 1131,  ///< No token begins so.
  TextTooLong = 1133,   ///< A text in quotes has more than 255 characters.
  BadNumber = 1134,     ///< A point without digits, or too many digits.
  // Of expressions:
  TooFewArguments = 1150,
  TooManyArguments = 1151,
  ArgumentType = 1152,
  NoLocal = 1153,       ///< There is no such local variable.
  OpenBracket = 1155,   ///< A bracket is not closed.
  UnknownPrefix = 1158, ///< There is no such function.
  TermExpected = 1160,
  SurplusTerms = 1162, ///< More than one value where one is wanted.
  TooDeep = 1163,      ///< Too many brackets within each other.
  // Of sentences:
  DuplicateParameter = 1164,
  Incomplete = 1165,
  SymbolsFull = 1167, ///< The names of local variables do not fit.
  TooManyParameters = 1168,
  NoVariable = 1170,  ///< The list of variables does not have it.
  UnknownWord = 1171, ///< There is no such word or instruction.
  MissingValue = 1172,
  BadType = 1173, ///< The value is of a type that the word does not take.
  WrongToken = 1174,
  NameTooShort = 1175,
  NameTooLong = 1176,
  AddressExpected = 1177, ///< No letter where a word should begin.
  NumberRange = 1179,     ///< N is no whole number from 0 to 16#FFFFFFFF.
  NumberLiteral = 1180,   ///< N is no number.
  ReservedWord = 1181,
  Conflict = 1182, ///< Two declarations of a name.
  InitialType = 1183,
  TooManyLocals = 1184,
  DeclarationFirst = 1185, ///< SUBPROGRAM is not the first line.
  OneSubprogram = 1186,    ///< A second SUBPROGRAM in a file, or one in the main program.
  LateLet = 1187,
  EndWithoutSubprogram = 1188,
  TextAfterEnd = 1189,
  EndMissing = 1190,
  // When it is carried out:
  UnknownJump = 1203,
  Syntax = 1204,
  ReadType = 1250,      ///< A variable is of another type than when the program was read.
  WriteType = 1251,     ///< A variable is of another type than the value.
  StackOverflow = 1252, ///< An expression holds too many values at once.
  NotANumber = 1253,
  DivisionByZero = 1254,
  StackEmpty = 1256,
  StackTooSmall = 1257, ///< The values of all local variables do not fit.
  // Of subprograms:
  Nesting = 1450,
  ReturnInMain = 1451,
  NotDeclaredHere = 1452, ///< The file of a subprogram holds another one, or none.
  QueueFull = 1453,       ///< A sentence does not fit into the queue.
  // Of files:
  BufferTooSmall = 2002, ///< A line is too long, or has too many words.
};

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_NC_ERROR_HPP
