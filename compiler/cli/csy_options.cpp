// The commands below `stride csy`.

#include "compiler/cli/command_line.hpp"

namespace stc::cli {

void declareCsy(CLI::App &app, Invocation &call) {
  CLI::App *csy = app.add_subcommand("csy", "Check and draw paths for the module TSX CSY 85");
  csy->require_subcommand(1);
  CLI::App *path = csy->add_subcommand(
      "path", "Show what TrjCompute makes of a path: positions of the master, speeds, points of "
              "cams; or what is wrong with it");
  path->add_option("FILE", call.csyPath.file, "Path file (*.path.toml)")->required()->type_name("");
  path->add_option("--plot", call.csyPath.plot, "SVG file to draw the path to")->type_name("FILE");
  addOutputOptions(*path, call.csyPath.output);
  path->callback([&call] { call.exitCode = csyPathCommand(call.csyPath); });
}

} // namespace stc::cli
