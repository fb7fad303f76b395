// The commands below `stride export`.

#include "compiler/cli/command_line.hpp"

namespace stc::cli {

void declareExports(CLI::App &app, Invocation &call) {
  CLI::App *exports = app.add_subcommand("export", "Write the project for other tools");
  exports->require_subcommand(1);
  CLI::App *plcOpen = exports->add_subcommand("plcopen", "As PLCopen XML (TC6)");
  addProjectOptions(*plcOpen, call.project, false);
  plcOpen
      ->add_option("-o,--out", call.exporting.out,
                   "File to write (default: the project's name with .xml)")
      ->type_name("FILE");
  plcOpen
      ->add_option("--schema", call.exporting.schema,
                   "Version: 2.01 (default), or 2.0 as CODESYS writes it")
      ->check(CLI::IsMember({"2.0", "2.01"}).description(""))
      ->type_name("VERSION");
  plcOpen->callback(
      [&call] { call.exitCode = exportPlcOpenCommand(call.project, call.exporting); });
}

} // namespace stc::cli
