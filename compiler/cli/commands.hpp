#ifndef STRIDE_COMPILER_CLI_COMMANDS_HPP
#define STRIDE_COMPILER_CLI_COMMANDS_HPP
// The commands of `stride`. Each returns the exit code: 0 exactly when there was no error.

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/assets/cnc_edit/cnc_edit.hpp"
#include "compiler/assets/cnc_edit/split.hpp"
#include "compiler/assets/dxf/dxf.hpp"
#include "compiler/cli/terminal.hpp"
#include "compiler/semantics/program.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc::cli {

/// The last project, which is not destroyed when the process ends: its memory is given back as a
/// whole.
using Kept = std::shared_ptr<const void>;

/// Options that all commands on a project have.
struct ProjectOptions {
  std::string path; ///< folder, stride.toml or source file; empty: the current folder
  Output output;
  bool unchecked = false;           ///< no run-time checks in generated code
  bool debug = false;               ///< -O0 -g
  Levels levels;                    ///< -W
  std::vector<std::string> defines; ///< `NAME` or `NAME=VALUE` for `{IF defined (…)}`
  Kept *kept = nullptr;             ///< takes the project; null: it is destroyed
};

/// What they say of the project's compilation.
[[nodiscard]] Settings settingsOf(const ProjectOptions &options);

int checkCommand(const ProjectOptions &options);
/// The same again whenever a file of the project is saved. Returns only when that fails.
int watchCheckCommand(const ProjectOptions &options);

/// What `stride build` makes.
struct BuildKind {
  bool emitCpp = false;
  bool isStatic = false;
  std::string target; ///< another processor; empty: this one
};

/// `out`: where the shared object goes, the executable, or the sources.
int buildCommand(const ProjectOptions &options, const std::string &out, const BuildKind &kind);

/// Builds, then becomes stride-host with `command` (sim, run) and these arguments after the
/// application's path.
int hostCommand(const ProjectOptions &options, const std::string &command,
                const std::vector<std::string> &hostArguments);

/// As hostCommand with run; whenever a file of the project is saved, it is built, and the new build
/// takes over from the running one (online change). Errors are shown, and the old one goes on.
int watchRunCommand(const ProjectOptions &options, const std::vector<std::string> &hostArguments);

/// What gdb does after the application is loaded.
struct DebugSession {
  std::vector<std::string> scripts; ///< files of gdb commands
  bool batch = false;               ///< leave gdb after them
};

/// Builds with debug information, then becomes gdb on a simulation with these arguments.
int debugCommand(const ProjectOptions &options, const std::vector<std::string> &hostArguments,
                 const DebugSession &session);

/// `kind`: warm, cold, origin. Becomes stride-host with the project's file for retained data.
int resetCommand(const ProjectOptions &options, const std::string &kind);

/// Value of --listen that stands for the socket of the project itself.
inline constexpr std::string_view kOwnSocket = "project";

/// Becomes stride-host with `ctl` and these arguments. When the first one names no socket, that of
/// the project of the current folder is meant, or of the project that the first one names.
int controlCommand(std::vector<std::string> arguments);

/// Becomes stride-host with `command` and these arguments; nothing is built.
int hostOnlyCommand(const std::string &command, const std::vector<std::string> &hostArguments);

/// What `stride test` does.
struct TestOptions {
  std::string filter; ///< names of tests, with `*` and `?`; empty: all
  std::string junit;  ///< file for the results; empty: none
  bool list = false;  ///< only name the tests
  bool bless = false; ///< write what the traces of [[test]] are now where they are expected
};
/// Builds and runs the unit tests, then the simulations of [[test]].
int testCommand(const ProjectOptions &options, const TestOptions &test);

/// What `stride fmt` does with what it formats.
struct FormatOptions {
  std::vector<std::string> paths; ///< folders and source files; none: the current folder
  bool check = false;             ///< write nothing; fail when something is not formatted
  bool diff = false;              ///< write nothing; show what would change
  bool fromStdin = false;         ///< from standard input to standard output
  Output output;
};
int formatCommand(const FormatOptions &options);

/// Writes the reference of the project, or with `library` of the standard library, as HTML into
/// the folder `out` (empty: `doc`). With a folder `figures`, its pictures LIBRARY/NAME.svg (of a
/// project PROJECT/NAME.svg) stand in the sections of what they are named after, and a text beside
/// one, NAME.txt, below it.
int documentCommand(const ProjectOptions &options, bool library, const std::string &figures,
                    const std::string &out);

/// What `stride export plcopen` writes.
struct ExportOptions {
  std::string out;             ///< file; empty: NAME.xml of the project in the current folder
  std::string schema = "2.01"; ///< version of TC6: 2.0 or 2.01
};
/// Writes the project as PLCopen XML.
int exportPlcOpenCommand(const ProjectOptions &options, const ExportOptions &what);

/// What `stride plot` draws.
struct PlotOptions {
  std::string trace;               ///< CSV file
  std::string out;                 ///< .svg or .html; empty: the trace's name with .svg
  std::string title;               ///< above the picture
  std::optional<double> from;      ///< the first row [s]
  std::optional<double> to;        ///< the last row [s]
  std::vector<std::string> panels; ///< `TITLE=NAMES` or `NAMES` each; none: by quantity
  std::vector<std::string> xy;     ///< `X,Y` each: columns against each other instead of time
  std::string color;               ///< of xy: the column that colours the curves; empty: none
  std::string project; ///< where the trace comes from; empty: where it lies, or the current folder
};
int plotCommand(const PlotOptions &options);

/// Copies the library into the user's folder of libraries; `replace`: also over one of its version.
int installLibraryCommand(const ProjectOptions &options, bool replace);
int listLibrariesCommand();

/// stride csy path
struct CsyPathOptions {
  std::string file;
  std::string plot; ///< SVG file to write; empty: none
  Output output;
};
int csyPathCommand(const CsyPathOptions &options);

/// What `stride cam` does.
enum class CamAction { Check, Bounds, Plot, ExportTable, ImportTable, Reduce, Write, Read };

struct CamOptions {
  CamAction action = CamAction::Check;
  std::vector<std::string>
      files;                 ///< cam files, binary ones, tables of positions; only check: several
  std::string out;           ///< file to write; empty: named after the first
  double masterVelocity = 1; ///< bounds: greatest of the master [u/s]
  double masterAcceleration = 0; ///< bounds: the same [u/s²]
  size_t points = 361;           ///< export: at least 2
  double tolerance = 0;          ///< reduce, import: [slave u]; 0: keep all points
  std::string name;              ///< of the cam that is written; empty: its own
  bool periodic = false;         ///< import
  double interval = 0;           ///< import
  Output output;
};
/// Checks, draws, converts cams: their own curve, not the table that a cam file may want.
int camCommand(const CamOptions &options);

/// What `stride cnc` does.
enum class CncAction {
  Check,
  Info,
  Format,
  Run,
  Plot,
  Queue,
  Number,
  Rotate,
  Shift,
  Scale,
  Mirror,
  Reverse,
  Split,
  Expand,
  ImportDxf,
  ExportDxf
};

/// How `run` and `plot` drive a program. Arrays are of X, Y, Z, A, B, C, P, Q, U, V, W and one
/// more.
struct CncMotionOptions {
  double blend = 0; ///< Of corners: distance of the curve from the corner; 0: they stay. [u]
  double merge = 0; ///< Of lines: how far the result may be off; 0: all stay. [u]
  std::optional<double> angleTolerance;   ///< Up to there, corners are none; nothing: as the
                                          ///< project says, else 0.001. [degrees]
  std::string velocityMode = "trapezoid"; ///< or `sigmoid`, `quadratic`
  double jerk = 0;                        ///< of `quadratic` [u/s³]
  double velocity = 0;                    ///< of programs that begin without F; 0: none [u/s]
  double acceleration = 0;                ///< of programs that begin without E; 0: 100 [u/s²]
  double maxVelocity[12] = {};            ///< 0: no limit [u/s]
  double maxAcceleration[12] = {};        ///< 0: no limit [u/s²]
  double cycle = 0.001;                   ///< [s]
  double feed = 1;                        ///< Factor of the program's velocities.
};

/// How `queue` makes the path of a program.
struct CncQueueOptions {
  double start[12] = {};     ///< Where the path begins; by axis as above. [u]
  uint16_t axes = 0;         ///< Which of them have been named, by bit.
  double deceleration = 0;   ///< of programs that begin without a negative E; 0: 100 [u/s²]
  bool stepSuppress = false; ///< sentences that begin with `/` are left out
};

/// Path processors that `info`, `run`, `plot` and `queue` put the path through.
struct CncProcessorOptions {
  std::optional<std::vector<CncProcessor>> processors; ///< nothing: as the project says
  std::optional<double> toolRadius; ///< of tool correction, is added to D; likewise [u]
};

/// How a path is moved.
struct CncMoveOptions {
  double places[12] = {}; ///< What --about, --by and --at say, by axis. [u]
  uint16_t axes = 0;      ///< Which of them have been named, by bit.
  double angle = 0;       ///< [degrees]
  double factor = 1;
};

/// How drawings become programs, and programs drawings.
struct CncDrawingOptions {
  DxfImport import;
  DxfExport out;
  std::string base;     ///< Of the programs' names; empty: as the drawing.
  bool replace = false; ///< programs that are there
};

struct CncOptions {
  CncAction action = CncAction::Check;
  std::vector<std::string> files;
  bool check = false; ///< format: write nothing; fail when something is not formatted
  std::string out;
  /// Whose meanings words have: "2.3" or "3"; empty: as the project of the file says.
  std::string softMotion;
  CncMotionOptions motion;
  CncQueueOptions queue;
  CncProcessorOptions preprocess;
  std::vector<std::string> sets; ///< Values of variables: NAME=VALUE
  CncNumbering numbering;
  CncMoveOptions move; ///< reverse: `places` is where the path begins
  CncSplit split;
  CncExpansion expansion;
  bool inPlace = false; ///< edits: into the file itself
  CncDrawingOptions drawing;
  Output output;
};
/// Checks, describes, formats CNC programs, drives them, makes queue files of them.
int cncCommand(const CncOptions &options);

/// `what`: a diagnostic's code, or the number or name of a SoftMotion error.
int explainCommand(const std::string &what);
/// All codes with their titles, one a line.
int explainList();

int newCommand(const std::string &name, const std::string &projectTemplate);
/// Names of the templates that newCommand knows.
[[nodiscard]] std::vector<std::string> templateNames();

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_COMMANDS_HPP
