// The commands below `stride library`.

#include "compiler/cli/command_line.hpp"

namespace stc::cli {

void declareLibraries(CLI::App &app, Invocation &call) {
  CLI::App *library = app.add_subcommand("library", "Install libraries of your own, list them");
  library->require_subcommand(1);
  CLI::App *install =
      library->add_subcommand("install", "Install a library for the projects of this user");
  addProjectOptions(*install, call.project, false);
  install->add_flag("--replace", call.replace, "Also when this version is installed");
  install->callback([&call] { call.exitCode = installLibraryCommand(call.project, call.replace); });
  CLI::App *list = library->add_subcommand("list", "Name the libraries that are installed");
  list->callback([&call] { call.exitCode = listLibrariesCommand(); });
}

} // namespace stc::cli
