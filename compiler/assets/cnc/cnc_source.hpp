#ifndef STRIDE_COMPILER_ASSETS_CNC_CNC_SOURCE_HPP
#define STRIDE_COMPILER_ASSETS_CNC_CNC_SOURCE_HPP
// CNC programs, *.cnc: G-code as the CNC editor of SoftMotion has it (V2.3 manual, chapter 3).

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/syntax/ast.hpp"
#include "runtime/numeric/cnc/gcode_error.hpp"
#include "runtime/numeric/cnc/gcode_word.hpp"
#include "runtime/numeric/cnc/path_object.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// The suffix of CNC files.
inline constexpr std::string_view kCncSuffix = ".cnc";

/// What stride.toml says about a program: a section [[cnc]].
struct CncSettings {
  std::string file; ///< As stride.toml names it.
  Span span;
  bool compile = true;                ///< It becomes a variable.
  stride::cnc::Position start{};      ///< piStartPosition
  std::optional<double> velocity;     ///< Of programs that begin without F. [u/s]
  std::optional<double> acceleration; ///< [u/s²]
  std::optional<double> deceleration; ///< [u/s²]
};

/// A word of a program, or the end of a sentence.
struct CncWord {
  stride::cnc::GCodeWord word{}; ///< Without an address.
  std::string variable;          ///< What stands between `$`; empty: a number.
  Span span;                     ///< Of all of it.
};

/// A CNC program as its file has it.
struct CncProgram {
  std::string name; ///< Of the variable: the file's, without its suffix.
  Span span;        ///< The beginning of the file.
  std::string title;
  std::vector<CncWord> words; ///< Sentences end with kEndOfSentence.
  uint32_t lines = 0;         ///< Of the text.
  CncSettings settings;
};

/// Reads a CNC file. What is wrong with its text is reported; with errors nothing is returned.
[[nodiscard]] std::optional<CncProgram> readCnc(const SourceFile &file, Diagnostics &diagnostics);

/// Reports what is wrong with the sentences of a program, and what is done otherwise than it says.
void checkCnc(const CncProgram &program, Diagnostics &diagnostics);

/// What `stride cnc info` shows.
struct CncInfo {
  size_t sentences = 0;
  size_t objects = 0;   ///< Of the path; of loops as often as they are gone through.
  size_t functions = 0; ///< M, dwell, synchronisation: among the objects.
  double length = 0;    ///< Of motions with G1 to G10. [u]
  double rapidLength = 0;
  double least[stride::cnc::kAxes]{}; ///< Bounds of the path. [u]
  double most[stride::cnc::kAxes]{};
  double leastVelocity = 0; ///< Of motions. [u/s]
  double mostVelocity = 0;
  uint16_t axes = 0;     ///< Which ones there are, by AxisBit.
  bool endless = false;  ///< Jumps lead on and on; what is shown is of the first sentences.
  bool complete = false; ///< No error ended it.
};

/// Decodes a whole program, with 0 for its variables, and measures the path.
[[nodiscard]] CncInfo infoOf(const CncProgram &program);

/// The words of the program with the settings' velocities before them, for a decoder. Variables
/// have the addresses of `storage`, one for each word.
struct CncVariable {
  double number = 0;
  double parameters[8]{};
};
[[nodiscard]] std::vector<stride::cnc::GCodeWord> wordsOf(const CncProgram &program,
                                                          std::vector<CncVariable> &storage);

/// The type of a variable of the project as G-code can use it; nothing if there is none of this
/// name, or of another type. `Main.x` is x of the program Main, `List.x` of a list of globals.
[[nodiscard]] std::optional<stride::cnc::VariableType>
cncVariableType(const std::vector<ast::File *> &files, std::string_view name);

/// The programs as ST: global variables SMC_CNC_REF. May be empty. Programs named like something in
/// `files` and unknown variables are reported.
[[nodiscard]] SyntheticSource cncDeclarations(const std::vector<CncProgram> &programs,
                                              const std::vector<ast::File *> &files,
                                              Diagnostics &diagnostics);

/// The text with upper-case letters, one blank between words, numbers without leading zeros.
[[nodiscard]] std::string formatCnc(std::string_view text);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CNC_CNC_SOURCE_HPP
