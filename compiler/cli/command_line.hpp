#ifndef STRIDE_COMPILER_CLI_COMMAND_LINE_HPP
#define STRIDE_COMPILER_CLI_COMMAND_LINE_HPP
// The command line of `stride`: a function for each group of commands declares them and what they
// do. Everything here needs CLI11.

#include "compiler/cli/can_command.hpp"
#include "compiler/cli/commands.hpp"
#include "compiler/cli/import_command.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace stc::cli {

/// What a call of `stride` says: options of all commands, of which one is given.
struct Invocation {
  int exitCode = 0;
  ProjectOptions project;
  bool watch = false;            ///< again whenever a file is saved
  std::vector<std::string> host; ///< for stride-host
  std::string name;              ///< of a new project
  std::string projectTemplate = "axis";
  std::string out;
  std::string emit;
  BuildKind kind;
  DebugSession session;
  std::string resetKind;
  bool library = false;
  bool replace = false;
  std::string figures;
  TestOptions tests;
  FormatOptions formatting;
  PlotOptions plot;
  ExportOptions exporting;
  CamOptions cams;
  CsyPathOptions csyPath;
  CncOptions cnc;
  CanOptions can;
  ImportOptions import;
  std::string code;
  bool listCodes = false;
  std::string topic;
  std::string overview; ///< what `stride help` shows
};

/// How diagnostics are shown.
void addOutputOptions(CLI::App &command, Output &output);
/// Options that all commands on a project have; `build`: those of its C++ as well.
void addProjectOptions(CLI::App &command, ProjectOptions &options, bool build);

/// sim, run, debug, reset, ctl: what becomes stride-host.
void declareRuns(CLI::App &app, Invocation &call);
/// stride completion
void declareCompletion(CLI::App &app, Invocation &call);
/// stride import
void declareImports(CLI::App &app, Invocation &call);
/// The commands below `stride export`.
void declareExports(CLI::App &app, Invocation &call);
/// The commands below `stride library`.
void declareLibraries(CLI::App &app, Invocation &call);
/// The commands below `stride cam`.
void declareCams(CLI::App &app, Invocation &call);
/// The commands below `stride csy`.
void declareCsy(CLI::App &app, Invocation &call);
void declareCnc(CLI::App &app, Invocation &call);
/// The commands below `stride can`.
void declareCan(CLI::App &app, Invocation &call);
/// Those of them that read and write drawings.
void declareCncDrawings(CLI::App &cnc, Invocation &call);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_COMMAND_LINE_HPP
