#ifndef STRIDE_COMPILER_ASSETS_CNC_CNC_SOURCE_HPP
#define STRIDE_COMPILER_ASSETS_CNC_CNC_SOURCE_HPP
// CNC programs, *.cnc: G-code as the CNC editor of SoftMotion has it (V2.3 manual, chapter 3).

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/syntax/ast.hpp"
#include "runtime/numeric/cnc/gcode_error.hpp"
#include "runtime/numeric/cnc/gcode_word.hpp"
#include "runtime/numeric/cnc/path_object.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// The suffix of CNC files.
inline constexpr std::string_view kCncSuffix = ".cnc";

/// What a program becomes: `compile` of its section [[cnc]].
enum class CncCompile : uint8_t {
  None,
  Program,   ///< A variable SMC_CNC_REF.
  Queue,     ///< A variable SMC_OUTQUEUE with the path.
  TextFile,  ///< Its text, in the folder for files.
  QueueFile, ///< Its path as a queue file, in the folder for files.
};

/// Path processors that a path goes through when it is compiled, in this order: `preprocess` of
/// [[cnc]]. What the CNC editor shows as options (V2.3 manual, section 3.6).
enum class CncProcessor : uint8_t {
  Tool,   ///< SMC_ToolCorr
  Loops,  ///< SMC_AvoidLoop
  Smooth, ///< SMC_SmoothPath
  Round,  ///< SMC_RoundPath
};

/// A processor by its name in stride.toml; nothing if there is none.
[[nodiscard]] std::optional<CncProcessor> cncProcessor(std::string_view name);

/// Why processors cannot be used together in this order.
struct CncOrderFault {
  size_t at = 0; ///< The first one that does not fit to those before it.
  std::string message;
  std::string label;
  std::string help;
};
[[nodiscard]] std::optional<CncOrderFault> findOrderFault(std::span<const CncProcessor> processors);

/// What stride.toml says about a program: a section [[cnc]].
struct CncSettings {
  std::string file; ///< As stride.toml names it.
  Span span;
  CncCompile compile = CncCompile::Program;
  std::optional<double> angleTolerance; ///< Of queues: corners up to it are none; 0. [degrees]
  uint32_t queueBytes = 0;       ///< Of queues: their memory; 0: as much as they need. [bytes]
  Span queueBytesSpan;           ///< Where stride.toml says that.
  bool stepSuppress = false;     ///< Of queues: sentences that begin with `/` are left out.
  stride::cnc::Position start{}; ///< piStartPosition
  bool softMotion3 = false;      ///< D as `softmotion` of the project says.
  std::vector<CncProcessor> preprocess; ///< Of queues.
  double toolRadius = 0;                ///< Of CncProcessor::Tool: is added to D. [u]
  std::optional<double> velocity;       ///< Of programs that begin without F. [u/s]
  std::optional<double> acceleration;   ///< [u/s²]
  std::optional<double> deceleration;   ///< [u/s²]
};

/// The value of a variable when the application begins.
struct CncInitial {
  double number = 0;
  std::array<double, 8> parameters{}; ///< Of an SMC_M_PARAMETERS.
};

/// A word of a program, or the end of a sentence.
struct CncWord {
  stride::cnc::GCodeWord word{};     ///< Without an address.
  std::string variable;              ///< What stands between `$`; empty: a number.
  Span span;                         ///< Of all of it.
  std::optional<CncInitial> initial; ///< Of the variable; nothing: it counts as 0.
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

/// Decodes a whole program, with 0 for its variables, and measures the path, as the processors of
/// the settings leave it. What they cannot change is reported.
[[nodiscard]] CncInfo infoOf(const CncProgram &program, Diagnostics &diagnostics);

/// How decoding a whole program has ended.
enum class CncEnd : uint8_t {
  Complete,
  Endless, ///< Jumps lead on and on; what has been given is of the first sentences.
  Wrong,   ///< A sentence cannot be carried out.
  Refused, ///< Who takes the objects has had enough.
};
struct CncDecoded {
  CncEnd end = CncEnd::Complete;
  stride::cnc::GCodeError error{}; ///< Wrong: of what kind.
  const CncWord *word = nullptr;   ///< Where it has ended; null: at the end, or in the settings.
};

/// Where the objects of a path come from: of that with the number n (PathObject::number) a word of
/// its sentence is [n - 1]; null: in the settings.
using CncOrigins = std::vector<const CncWord *>;

/// Where the sentence of an object is; the program, if nothing is known of that.
Span cncSpanOf(const CncProgram &program, const CncOrigins &origins,
               const stride::cnc::PathObject &object);

/// Decodes a program from its beginning to its end, jumps included, and gives each object of the
/// path to `take`, until that returns false. Variables have their initial values.
[[nodiscard]] CncDecoded decodeCnc(const CncProgram &program,
                                   const std::function<bool(const stride::cnc::PathObject &)> &take,
                                   CncOrigins *origins = nullptr);

/// Objects of a path at most: about 870 MB.
inline constexpr size_t kMostCncObjects = 1'000'000;

/// What the processors of the settings make of a decoded path: the same as their blocks with queues
/// that hold all of it. Nothing if one of them cannot, which is reported.
[[nodiscard]] std::optional<std::vector<stride::cnc::PathObject>>
preprocessCnc(const CncProgram &program, std::vector<stride::cnc::PathObject> objects,
              const CncOrigins &origins, Diagnostics &diagnostics);

/// The path of a program as compiled queues have it: decoded, put through the processors of the
/// settings, and its end velocities lowered as by SMC_CheckVelocities. Nothing if it is wrong,
/// which is reported.
[[nodiscard]] std::optional<std::vector<stride::cnc::PathObject>>
cncQueueOf(const CncProgram &program, Diagnostics &diagnostics);

/// The bytes of a queue file with this path.
[[nodiscard]] std::string cncQueueFile(const CncProgram &program,
                                       std::span<const stride::cnc::PathObject> objects);

/// A variable of the project as G-code can use it.
struct CncVariable {
  stride::cnc::VariableType type{};
  std::optional<CncInitial> initial; ///< Nothing: only the running application knows.
};

/// Where types of libraries are declared: the declaration of a name in lower case, or null.
using CncTypes = std::function<const ast::Decl *(std::string_view)>;

/// The variable that G-code calls `name`; nothing if there is none, or it is of no type that G-code
/// can use. `Main.x` is x of the program Main, `List.x` of a list of globals, `stData.aPos[3]` an
/// element of a member.
[[nodiscard]] std::optional<CncVariable> cncVariable(const std::vector<ast::File *> &files,
                                                     const CncTypes &types, std::string_view name);

/// Gives the variables of a program their initial values. What is not known is reported.
void freezeCnc(CncProgram &program, const std::vector<ast::File *> &files, const CncTypes &types,
               Diagnostics &diagnostics);

/// A program and what it becomes.
struct CncAsset {
  CncProgram program;
  std::vector<stride::cnc::PathObject> objects; ///< Of CncCompile::Queue.
};

/// The programs as ST: global variables SMC_CNC_REF and SMC_OUTQUEUE. May be empty. Programs named
/// like something in `files` and unknown variables are reported.
[[nodiscard]] SyntheticSource cncDeclarations(const std::vector<CncAsset> &programs,
                                              const std::vector<ast::File *> &files,
                                              const CncTypes &types, Diagnostics &diagnostics);

/// The text with upper-case letters, one blank between words, numbers without leading zeros.
[[nodiscard]] std::string formatCnc(std::string_view text);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CNC_CNC_SOURCE_HPP
